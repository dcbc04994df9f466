// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "diagnosis/evidence/least_squares.hpp"
#include "diagnosis/evidence/preparation.hpp"

namespace tunica::diagnosis {

/// The base model could not be evaluated from any start, or comes to no optimum.
class BaseFitFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct BaseFit {
  Fit fit;
  std::vector<Warning> warnings;
};

/// The base model fitted from its initial values and from random points, and from what the optimizer of the request
/// finds unless it is quick; the best of all, checked: a gradient that is not zero is no optimum to test from. Throws
/// BaseFitFailure, also where one more step promises to take half of |r|².
BaseFit fit_base(const Inquiry& inquiry, const Preparation& prepared);

/// The fit under the noise that it settles.
struct SettledFit {
  experiment::Experiment experiment;
  std::shared_ptr<const assembly::Assembly> base;
  Fit fit;
};

/// Relative noise is a share of the true value, not of the measured one: rows that happen to be measured low would seem
/// better known than those measured high, and pull the fit down. Here it becomes a share of what the base fit predicts
/// and its residuals say, averaged over seven rows, and the model is fitted again. Without relative noise nothing
/// changes.
SettledFit settle_noise(const Inquiry& inquiry, const Preparation& prepared, const Fit& fit);

}  // namespace tunica::diagnosis
