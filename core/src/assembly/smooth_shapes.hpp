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

/// Fits a polynomial to every branch of the measured path, and takes what is left for noise:
///
///   σ² = Σ_b ‖y_b − P_b y_b‖² / (N − Σ_b k_b).
///
/// A branch ends where an abscissa turns by more than a twentieth of its range and a hundredth of its largest value:
/// loading and unloading, and the members of a family of curves, are smooth by themselves. An abscissa that would leave
/// branches of fewer than 4 rows trembles, and ends none. The coordinate of a branch is the abscissa that comes nearest
/// to going one way along it. All branches have k terms, as far as half their rows allow, with 1 ≤ k ≤ 9 at the least
/// generalised cross-validation Σ‖e‖²/(N − Σk_b)² (G. H. Golub, M. Heath, G. Wahba, Technometrics 21:215, 1979). No
/// model takes part, so that a wrong one cannot pass for noise. Correlation of neighbouring rows makes it too small, a
/// kink within a branch or too few rows for its bend too large.
///
/// `fitted` and every abscissa have the length of `values`. None where fewer than 4 degrees of freedom are left.
std::optional<SmoothScatter> smooth_scatter(std::span<const double> values,
                                            const std::vector<std::pair<std::string, std::vector<double>>>& abscissae,
                                            const std::vector<bool>& fitted);

}  // namespace tunica::assembly
