// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "discovery/set_fit.hpp"

namespace tunica::discovery {

/// A term as a curve, dψ/dx over its invariant x with a 95 % band; of stretches dψ/dλ over λ. kPa.
struct TermCurve {
  std::vector<double> x, slope, low, high;
};

/// Of term `which` of a set, over the range of its invariant that the data reach.
TermCurve curve_of_term(const Subject& subject, const SetFit& fit, std::size_t which);

/// The same with a band that holds what other laws of the invariant say: the variance of the mixture of all sets of the
/// same invariants with one term in this one, each with the weight of its evidence.
TermCurve mixed_curve(const Subject& subject, const std::vector<SetFit>& sets, std::size_t which);

/// Free curves in the place of the laws of a set, one invariant at a time, and where `beside` is set in addition to
/// them; with 3, 5 and 8 pieces, of which the evidence chooses. `sets` are the fits that there are.
std::vector<SetFit> with_curves(const Fitter& fitter, const SetFit& best, const std::vector<KindPointer>& kinds,
                                bool beside);

/// Covariance of all free parameters of a fit; zero for those at a bound.
Eigen::MatrixXd covariance(const diagnosis::Fit& fit);

}  // namespace tunica::discovery
