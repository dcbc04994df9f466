// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "diagnosis/evidence/misfit_size.hpp"
#include "diagnosis/request.hpp"
#include "text/codes.hpp"

namespace tunica::diagnosis {

/// The smallest misfit that matters. It is not the noise: real curves scatter by 0.2 % of their range, but no model of
/// a tissue follows them more closely than 1–3 %.
struct Tolerance {
  enum class Origin { stated, repeats, cohort, standard };
  double share = 0.02;  ///< of the range; of channels with their own, averaged as squares over rows
  Origin origin = Origin::standard;
};
inline constexpr text::Codes<Tolerance::Origin, 4> tolerance_origins{{{Tolerance::Origin::stated, "stated"},
                                                                      {Tolerance::Origin::repeats, "repeats"},
                                                                      {Tolerance::Origin::cohort, "cohort"},
                                                                      {Tolerance::Origin::standard, "default"}}};
inline std::string_view code_of(Tolerance::Origin origin) { return text::code_of(tolerance_origins, origin); }

/// As the request states it; else the scatter between the replicates of a curve; else 2 % of the range.
Tolerance tolerance_of(const Request& request, const Evidence& evidence);

}  // namespace tunica::diagnosis
