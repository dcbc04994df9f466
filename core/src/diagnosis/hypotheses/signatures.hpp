// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/hypotheses/extension.hpp"

namespace tunica::diagnosis {

/// The effect of an amplitude near the null, one entry per admissible side.
struct Slope {
  Eigen::VectorXd signature;
  MechanismFactory::Side side;
  double sign = 1;
};

/// The signature of an extension at the base fit, in whitened rows.
///
/// Two-sided: exact where the Jacobian is, unless the simulation has a kink at the null (an opening angle, where fibres
/// only pull): then one for each side. Else from simulations: with f(δ) even, the parabola of δ² through f(0), f(δ),
/// f(2δ); with one side only, [f(δ) − f(0)]/δ at a thousandth of a plausible amplitude (`quick`), or to second order at
/// what changes the residuals by no more than a tenth of σ in all: good to 1e-6.
std::vector<Slope> slopes_of(const Extension& extended, const MechanismFactory& mechanism,
                             const std::vector<double>& null, const Eigen::VectorXd& bare, const Eigen::MatrixXd& J,
                             assembly::Workspace& workspace, bool quick);

}  // namespace tunica::diagnosis
