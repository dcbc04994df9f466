// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "population/simulated.hpp"

/// What intervals, tests and spreads do over many simulated cohorts: bench/cohorts prints all of it, a test a part.
namespace simulated {

struct Setting {
  const Curve* curve;
  std::string name;
  std::size_t specimens;
  double spread;            ///< of every log θ
  bool correlated = false;  ///< 0.5 between all, else none
  double effect = 0.3;      ///< of the second half of the specimens, on every log θ, in cohorts with an effect
};

struct Share {
  double hits = 0, of = 0;
  double value() const { return hits / of; }
};

struct Outcome {
  std::vector<Share> means;          ///< by parameter: intervals of the population mean that cover
  std::vector<Share> effects;        ///< intervals of the group effect that cover
  std::vector<Share> spreads;        ///< profile intervals that cover
  std::vector<double> spread_ratio;  ///< mean of estimate/truth
  std::vector<double> borrowed;      ///< mean share
  Share false_whole;                 ///< permutation p ≤ 0.05 of the factor where it does nothing
  Share false_any;                   ///< any parameter with Westfall–Young p ≤ 0.05 where it does nothing
  Share found_any;                   ///< the same where every parameter changes
  std::size_t unconverged = 0;
};

/// Cohort k has the seed first_seed + k: half of the specimens in each group. Each cohort is simulated twice with the
/// same draws, without and with the effect. The means of a cohort without groups are of the same specimens.
Outcome study(const Setting& setting, std::size_t cohorts, std::uint64_t first_seed, std::size_t permutations);

}  // namespace simulated
