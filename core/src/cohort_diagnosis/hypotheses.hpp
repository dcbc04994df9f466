// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "cohort_diagnosis/marginal.hpp"
#include "cohort_diagnosis/specimen_evidence.hpp"

namespace tunica::cohort_diagnosis {

/// The specimens in the order of their ids: the order in which they come must not matter.
using Specimens = std::vector<const SpecimenEvidence*>;
Specimens in_order(std::span<const SpecimenEvidence> specimens);

/// A mechanism in one place with one setting, common to the cohort.
struct Hypothesis {
  std::vector<Profile> seen;  ///< by specimen, where it sees the mechanism there
  std::vector<bool> sees;     ///< by specimen
  std::vector<Population> populations;
  Eigen::MatrixXd log_likelihood;  ///< specimens × populations, strangers allowed for; 0 where it does not see it
  double log_share = 0;            ///< ln of its share among those of its mechanism

  [[nodiscard]] const std::string& id() const { return like().id; }
  /// Any specimen that sees it.
  [[nodiscard]] const Profile& like() const;
  /// ln of the evidence of those specimens for which `counts` holds, over that of the base.
  [[nodiscard]] double log_evidence(const std::vector<bool>& counts) const;
  /// The likeliest population by these specimens.
  [[nodiscard]] const Population& likeliest(const std::vector<bool>& counts) const;
};

/// All hypotheses of all specimens, in the order of their keys. A specimen whose settings differ, because its clock
/// does, takes part with the setting that is nearest in logarithms. A row that is not listed, because it scores little
/// there, counts as one of score 0; a row of few specimens is left out.
std::vector<Hypothesis> hypotheses_of(const Specimens& specimens);

double log_sum_exp(std::span<const double> logs);

}  // namespace tunica::cohort_diagnosis
