// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "diagnosis/evidence/tolerance.hpp"

namespace tunica::cohort_diagnosis {

/// How far a fit misses one observable of one test, and the curve that was measured: its first loading at evenly spaced
/// abscissae.
struct Outline {
  std::string test, channel;
  std::size_t rows = 0;
  double range = 0;         ///< of the observable, in its unit
  double rms = 0;           ///< of the misfit beyond noise, as a share of the range
  double from = 0, to = 0;  ///< abscissae of the first and the last value
  std::vector<double> values;
  bool operator==(const Outline&) const = default;
};

/// Of every curve that is fitted.
std::vector<Outline> outlines_of(const diagnosis::Evidence& evidence);

/// What specimens differ by, as a share of the range: the standard deviation between their curves where all of them
/// have been, averaged as squares over curves that three specimens have at least. None where there is no such curve.
std::optional<double> spread_between(std::span<const std::vector<Outline>* const> specimens);

}  // namespace tunica::cohort_diagnosis
