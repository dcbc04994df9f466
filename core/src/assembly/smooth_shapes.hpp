// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tunica::assembly {

/// The scatter of rows about smooth curves through them.
struct SmoothScatter {
  double variance = 0, freedom = 0;  ///< σ² and its degrees of freedom, N − Σ_b k_b
};

/// Fits a polynomial to every branch of the measured path, and takes the residual for noise:
///
///   σ² = Σ_b ‖y_b − P_b y_b‖² / (N − Σ_b k_b).
///
/// A branch ends where an abscissa reverses by more than a twentieth of its range and a hundredth of its largest value.
/// Loading, unloading and each member of a family of curves are smooth separately. An abscissa that would leave
/// branches of fewer than 4 rows only jitters, and ends no branch. The coordinate of a branch is the abscissa that is
/// closest to monotonic along it. All branches have k terms, as far as half their rows allow. 1 ≤ k ≤ 9 minimises the
/// generalised cross-validation Σ‖e‖²/(N − Σk_b)² (G. H. Golub, M. Heath, G. Wahba, Technometrics 21:215, 1979). No
/// model takes part, because the misfit of a wrong model would pass for noise. Correlation of neighbouring rows makes σ
/// too small. A kink within a branch, or too few rows for its curvature, makes σ too large.
///
/// `fitted` and every abscissa have the length of `values`. None if fewer than 4 degrees of freedom remain.
std::optional<SmoothScatter> smooth_scatter(std::span<const double> values,
                                            const std::vector<std::pair<std::string, std::vector<double>>>& abscissae,
                                            const std::vector<bool>& fitted);

}  // namespace tunica::assembly
