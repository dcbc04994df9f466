// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::discovery {

/// Differences that no energy can explain: rows at the same strain, measured during loading and unloading or in tests
/// that are alike in everything an energy sees, that differ by more than noise.
struct PathDependence {
  double chi2 = 0;        ///< of the residuals: what such differences take
  double share = 0;       ///< of the misfit beyond noise
  double p_value = 1;     ///< of the differences where there are none
  bool branches = false;  ///< loading differs from unloading; else tests that are alike differ
  std::string where;      ///< "loading and unloading in the test 'cycle'"

  /// Whether the misfit is of this kind for the most part.
  [[nodiscard]] bool decides() const { return p_value < 1e-4 && share > 0.5; }
};

/// From the residuals of an elastic fit: smooth shapes along the abscissa that all branches of a curve, or all tests
/// that are alike, have in common, against shapes of each by itself.
PathDependence path_dependence(const diagnosis::Evidence& evidence, const diagnosis::Fit& fit);

}  // namespace tunica::discovery
