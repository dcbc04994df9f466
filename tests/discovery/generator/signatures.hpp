// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects.hpp"
#include "noise.hpp"

namespace blind {

/// What every effect of the catalogue looks like in whitened observations about a fit, in each of its targets and on a
/// grid of its nuisances, with what the base model's parameters absorb taken out.
struct Signature {
  const Effect* effect;
  Target target;
  bool one_sided;
  Eigen::VectorXd shape;  ///< projected, of length 1
  double retained;        ///< |projected|/|whole|
};
std::vector<Signature> signatures(const Specimen& specimen, const Tissue& fitted, const Noise& noise,
                                  const Eigen::MatrixXd& jacobian);

/// The catalogue's best account of a misfit, to first order: its correlation c with the residual.
struct Explanation {
  const Effect* effect = nullptr;
  Target target;
  double correlation = 0;
};
Explanation best_account(const std::vector<Signature>& all, const Eigen::VectorXd& residual);

/// Removes the columns of the Jacobian from v.
Eigen::VectorXd projected(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& v);

}  // namespace blind
