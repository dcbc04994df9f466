// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// The experiment as diagnosis sees it: every channel with its noise, weights of one, whitened least squares of one
/// model over all tests of the first run (all tests where there is none), no constraints. Fills experiment, run, noise,
/// base, curves. Channels of weight 0 take no part, nor do `gross` rows in an estimate of the noise.
void prepare(Diagnosis& diagnosis, const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
             const std::vector<GrossRow>& gross = {});

/// The base model fitted from its initial values and from random points, by the optimiser that the settings name
/// first unless it is quick; the best of all, checked: a gradient that is not zero is no optimum to judge from. Throws
/// std::runtime_error where nothing could be evaluated.
void fit_base(Diagnosis& diagnosis, const plugins::Catalogue& catalogue);

/// Relative noise is a share of the true value, not of the measured one: rows that happen to be measured low would seem
/// better known than those measured high, and pull the fit down. From here on it is a share of what the base fit
/// predicts and its residuals say in the mean of seven rows. Fits again; without relative noise it does nothing.
void settle_noise(Diagnosis& diagnosis, const plugins::Catalogue& catalogue);

/// The rows of the whitened residuals by channel.
std::vector<Curve> curves_of(const assembly::Assembly& assembly, const std::vector<NoiseSource>& noise);

}  // namespace tunica::diagnosis
