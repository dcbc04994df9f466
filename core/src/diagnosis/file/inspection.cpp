// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/file/inspection.hpp"

#include <algorithm>
#include <array>

namespace tunica::diagnosis {
namespace {

/// Findings about the file, not about the specimen.
constexpr std::array bookkeeping{data::FindingKind::record_repeated, data::FindingKind::record_coarse,
                                 data::FindingKind::record_sign,     data::FindingKind::record_percent,
                                 data::FindingKind::record_angle,    data::FindingKind::record_time,
                                 data::FindingKind::header_measure,  data::FindingKind::header_strain};

}  // namespace

std::vector<Suspect> inspected(const Evidence& evidence) {
  std::vector<Suspect> found;
  for (const data::Finding& finding : evidence.base->layout().findings)
    if (std::find(bookkeeping.begin(), bookkeeping.end(), finding.kind) != bookkeeping.end())
      found.push_back({std::string(text::code_of(data::finding_codes, finding.kind)), finding.text});
  return found;
}

}  // namespace tunica::diagnosis
