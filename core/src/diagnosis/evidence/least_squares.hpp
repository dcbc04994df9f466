// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "assembly/assembly.hpp"
#include "tunica/status.hpp"

namespace tunica::diagnosis {

/// Free parameters of an assembly that move together because they are one quantity in several tests.
using Variable = std::vector<std::size_t>;

struct Fit {
  Status status;
  std::vector<double> free;  ///< all parameters of the assembly, base units
  double chi2 = 0;           ///< |r|²
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;    ///< rows × variables, by the value of the variable in base units
  std::vector<bool> at_bound;  ///< by variable
  std::size_t evaluations = 0;
};

/// Other data than the measured ones.
struct DataVariant {
  const Eigen::VectorXd* added = nullptr;      ///< to the whitened residuals: simulated noise instead of the real one
  const std::vector<bool>* counted = nullptr;  ///< rows that are fitted; null = all
  /// A fit is useful only below this |r|². It stops above it if several steps in a row promise less than a hundredth of
  /// the remaining difference: the search is then in another minimum.
  double wanted = std::numeric_limits<double>::infinity();
  /// A fit ends where six steps down together lower |r|² by less than this, times |r|²/n where that is above 1, 0.5 at
  /// most.
  double negligible = 0;
};

/// Of |r|²: too small to affect any verdict or threshold.
inline constexpr double says_nothing = 0.01;

/// Minimises the whitened squares over some of the parameters, the others stay where `start` has them, within the
/// bounds: Levenberg–Marquardt in the unit box with Nielsen's damping (K. Madsen, H. B. Nielsen, O. Tingleff, Methods
/// for Non-Linear Least Squares Problems, 2004, algorithm 3.16); variables at a bound that the gradient presses against
/// it leave the step. Where Jacobians are differences of whole simulations, Broyden's update (algorithm 3.30 there)
/// stands in for most of them. It ends when a step promises to lower |r|² by less than 1e-6: far below the noise.
///
/// It is not an optimiser plugin because a diagnosis makes hundreds of fits of a few milliseconds, with some variables
/// tied and others held. One Jacobian of a model with history costs as much as twenty evaluations.
Fit least_squares(const assembly::Assembly& assembly, const std::vector<Variable>& variables,
                  std::span<const double> start, assembly::Workspace& workspace, std::size_t max_evaluations = 60,
                  const DataVariant& data = {});

/// Residuals, and unless `jacobian` is null the Jacobian by all free parameters in base units.
Status whitened(const assembly::Assembly& assembly, std::span<const double> free, assembly::Workspace& workspace,
                Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian);

/// Every free parameter by itself.
std::vector<Variable> all_variables(const assembly::Assembly& assembly);

/// The Jacobian of a fit without the variables that lie at a bound.
Eigen::MatrixXd interior(const Fit& fit);

bool at_a_bound(const Fit& fit);

}  // namespace tunica::diagnosis
