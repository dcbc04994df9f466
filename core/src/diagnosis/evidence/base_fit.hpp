// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stdexcept>
#include <vector>

#include "diagnosis/evidence/least_squares.hpp"
#include "diagnosis/evidence/preparation.hpp"

namespace tunica::diagnosis {

/// The base model could not be evaluated from any start, or does not reach an optimum.
class BaseFitFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct BaseFit {
  Fit fit;
  std::vector<Warning> warnings;
};

/// The best fit of the base model from its initial values and from random points. Unless the diagnosis is quick, the
/// end point of the requested optimizer is one more start. Its gradient must vanish, because the tests presuppose an
/// optimum. Throws BaseFitFailure, also if one more step would remove half of |r|².
BaseFit fit_base(const Inquiry& inquiry, const Preparation& prepared);

/// The fit, with the noise that it determines.
struct SettledFit {
  experiment::Experiment experiment;
  std::shared_ptr<const assembly::Assembly> base;
  Fit fit;
};

/// Relative noise is a share of the true value, not of the measured one. Otherwise rows that happen to be measured low
/// would seem more precise than those measured high, and would pull the fit down. Here it becomes a share of the base
/// fit plus its residuals averaged over seven rows, and the model is fitted again. Without relative noise nothing
/// changes.
SettledFit settle_noise(const Inquiry& inquiry, const Preparation& prepared, const Fit& fit);

}  // namespace tunica::diagnosis
