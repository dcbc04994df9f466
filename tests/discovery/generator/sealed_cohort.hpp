// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sealed_case.hpp"

namespace blind {

/// Which cohort of the benchmark: the same order makes the same cohort, bit for bit.
struct CohortOrder {
  std::uint64_t seed = 0;
  std::string set;     ///< nulls, singles, pairs, groups (an effect in one of two groups only)
  std::string effect;  ///< of singles and groups
  double lambda = 0;   ///< asked of every effect alone, on average over the specimens that have it
  std::size_t index = 0, specimens = 8;
  std::vector<std::string> noise;  ///< kinds to draw from; one for the cohort
  Base base = Base::hgo;
  std::string protocol = "artery";
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string name() const;
};

/// Specimens of one tissue, on one rig, with the same effects in them:
///   tissue      every fitted parameter log-normal about the cohort's, spread 0.2 to 0.4 (angles: times 15 degrees)
///   geometry    the cohort's; stretches and pressures up to what each specimen bears
///   noise       of one kind, each specimen with levels of its own
///   effects     place and nuisances the cohort's; amplitudes spread by 30 % about a common one. Of effects that have
///               two sides, one cohort in two gives every specimen a side of its own: the mean is then about zero.
struct SealedCohort {
  CohortOrder order;
  std::vector<SealedCase> specimens;
  std::vector<std::string> group;   ///< "a" or "b" of each; half of them each
  std::vector<double> mean_lambda;  ///< of each effect, over the specimens that have it
  std::string affected;             ///< the group that has the effects; empty: both
  bool own_sides = false, reached = true;
};
SealedCohort make(const CohortOrder& order);

/// DIR/<name>/: specimens.csv (id, group), <id>/experiment.json and data, truth.sha256; and DIR/sealed/<name>.json.
/// True unless all was there already.
bool write(const CohortOrder& order, const std::filesystem::path& folder);

}  // namespace blind
