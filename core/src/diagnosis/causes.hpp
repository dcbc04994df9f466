// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// Addition `which` of a refit in words and numbers: amplitude with its interval from the refit's Jacobian, what it has
/// to do with the parameters, the sentence for a person.
Cause cause_of(const Diagnosis& diagnosis, const Refitted& refitted, std::size_t which, const Direction& direction,
               const plugins::Catalogue& catalogue);

/// The sentence, from the numbers of the cause.
void explain(Cause& cause, const MechanismFactory& mechanism);

/// Plausible amplitudes: as declared; of a mechanism that acts on a channel, whose unit it cannot know, what the
/// channel spans.
std::pair<double, double> plausible_range(const Diagnosis& diagnosis, const MechanismFactory& mechanism,
                                          const Target& target);

/// The Jacobian of a fit without the variables that lie at a bound.
Eigen::MatrixXd interior(const Fit& fit);

/// Where an effect that several tests should show is carried by one of them: its name. Leaving one test out, amplitude
/// δ becomes δ₋ with standard errors s and s₋; δ₋ − δ has variance s₋² − s² if the effect is what it is said to be.
/// More than 3.5 of its standard deviations, with δ₋ no longer significant where it should be, is no chance.
std::string carrier(const Diagnosis& diagnosis, const Direction& direction, const Eigen::VectorXd& residuals);

}  // namespace tunica::diagnosis
