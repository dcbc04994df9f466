// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "diagnosis/naming/claims.hpp"

namespace tunica::diagnosis {

/// The fault and its explanation.
struct Explanation {
  Verdict verdict = Verdict::nothing_detected;
  std::vector<Reason> reasons;  ///< of the verdict
  Claim claim;
  double p_after = 1;                    ///< of the residuals with the causes added
  std::optional<double> noise_factor;    ///< times the stated noise at which what is left would be clean
  std::vector<RankedMechanism> ranking;  ///< likeliest first; empty without an alarm
  /// Of each candidate the direction that explains these data best; none where it leaves no trace.
  std::vector<std::optional<std::size_t>> best_direction;
  bool unlisted = false;        ///< an effect that no mechanism lists may look like the causes together
  std::vector<GrossRow> gross;  ///< rows that are gross and that no fit leaves out: nothing else is wrong
  std::vector<Cause> left_out;  ///< gross rows that the extension takes out beside its causes
  std::vector<Misfit> misfit;
  Admissibility admissibility;
  FileFindings file;  ///< possible mistakes in the file
  /// Where a mistake is near or ahead: the experiment with the likeliest one mended, its data in memory.
  std::shared_ptr<const experiment::Experiment> mended = {};
};

/// What the probability of one of its causes is worth.
Standing standing_of(const Cause& cause, const Explanation& explanation);

/// The subject of the alarm and its explanation. `gross`: gross rows, if nothing else is wrong.
Explanation explain(const Inquiry& inquiry, const Analysis& analysis, const std::vector<GrossRow>& gross);

}  // namespace tunica::diagnosis
