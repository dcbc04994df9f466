// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "diagnosis/naming/singles.hpp"

namespace tunica::diagnosis {

/// Two or three mechanisms together, each of which loses significantly when it is taken out.
struct Group {
  std::vector<std::size_t> directions;  ///< of each member
  std::vector<Addition> additions;
  std::vector<double> amplitudes;  ///< as the linearisation has them
  double linear_gain = 0;
  double log_weight = 0;  ///< gain of |r|²/2, and the prior shares of its hypotheses
  std::optional<Refit> refit;
  std::vector<double> losses;               ///< of |r|², when a member is taken out and the others are fitted again
  std::shared_ptr<const Refit> begun_from;  ///< with all members but the last; or none
};

/// All pairs in the linearisation, the best of them at finite amplitude; best first. A forward search would stay with
/// the best single mechanism, which often belongs to no pair. Pairs that by their scores stay well below the weight
/// `floor` are not fitted.
std::vector<Group> fit_pairs(const Inquiry& inquiry, const Analysis& analysis, const std::vector<Single>& singles,
                             double floor);

/// The best pairs with a third that explains most of what they leave, and what could stand for each of the three; best
/// first, empty where no third is needed.
std::vector<Group> fit_triples(const Inquiry& inquiry, const Analysis& analysis, std::span<const Group> pairs);

/// ln of the prior odds of each pair against each single mechanism among C candidates. One data set in ten has two
/// mechanisms, and there are (C − 1)/2 times as many pairs.
double log_odds_of_pair(std::size_t candidates);

}  // namespace tunica::diagnosis
