// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "text/codes.hpp"

namespace tunica::data {

/// What about a record does not go together with itself or with physics.
enum class FindingKind {
  record_broken,     ///< rows after the specimen broke
  record_softening,  ///< a stiffness that rises and then falls
  record_jump,       ///< a load at rest
  record_repeated,   ///< a block of rows that stands in the file twice
  record_coarse,     ///< few different values
  record_sign,       ///< tension and compression may be exchanged
  record_time,       ///< a duration or a rate that no such test has
  record_short,      ///< hardly any deformation
  record_percent,    ///< percent where a fraction is read
  record_size,       ///< the unloaded specimen is not the one of the file
  record_angle,      ///< radians where degrees are read
  record_noise,      ///< a noise as large as what is measured
  header_measure,    ///< the header speaks of another stress measure
  header_strain      ///< the header speaks of another strain
};
inline constexpr text::Codes<FindingKind, 14> finding_codes{{{FindingKind::record_broken, "record_broken"},
                                                             {FindingKind::record_softening, "record_softening"},
                                                             {FindingKind::record_jump, "record_jump"},
                                                             {FindingKind::record_repeated, "record_repeated"},
                                                             {FindingKind::record_coarse, "record_coarse"},
                                                             {FindingKind::record_sign, "record_sign"},
                                                             {FindingKind::record_time, "record_time"},
                                                             {FindingKind::record_short, "record_short"},
                                                             {FindingKind::record_percent, "record_percent"},
                                                             {FindingKind::record_size, "record_size"},
                                                             {FindingKind::record_angle, "record_angle"},
                                                             {FindingKind::record_noise, "record_noise"},
                                                             {FindingKind::header_measure, "header_measure"},
                                                             {FindingKind::header_strain, "header_strain"}}};

/// One of them, with the rows, the figures and what to do.
struct Finding {
  FindingKind kind;
  std::string text;
};

}  // namespace tunica::data
