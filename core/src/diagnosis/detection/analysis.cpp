// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/detection/analysis.hpp"

#include <utility>

namespace tunica::diagnosis {

Analysis analyse(const Inquiry& inquiry, const std::vector<GrossRow>& gross) {
  Evidence evidence = evidence_of(inquiry, gross);
  Hypotheses hypotheses = hypotheses_of(inquiry, evidence);
  Alarm alarm = alarm_of(inquiry, evidence, hypotheses);
  return {std::move(evidence), std::move(hypotheses), std::move(alarm)};
}

}  // namespace tunica::diagnosis
