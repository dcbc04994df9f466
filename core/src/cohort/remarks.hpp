// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cohort/collection.hpp"
#include "text/codes.hpp"

namespace tunica::cohort {

/// The kind of a warning about a cohort. Scripts and the report use it, so the sentences may change.
enum class RemarkKind {
  not_fitted,
  factor_not_compared,
  few_specimens,
  few_animals,
  same_data,
  far_off,
  often_at_bound
};
inline constexpr text::Codes<RemarkKind, 7> remark_codes{{{RemarkKind::not_fitted, "not_fitted"},
                                                          {RemarkKind::factor_not_compared, "factor_not_compared"},
                                                          {RemarkKind::few_specimens, "few_specimens"},
                                                          {RemarkKind::few_animals, "few_animals"},
                                                          {RemarkKind::same_data, "same_data"},
                                                          {RemarkKind::far_off, "far_off"},
                                                          {RemarkKind::often_at_bound, "often_at_bound"}}};

struct Remark {
  RemarkKind kind;
  std::string sentence;
  std::vector<std::string> specimens = {};
};

/// How many times its cohort's median a parameter may be, or a part of it, before a unit is suspected.
constexpr double suspicious_ratio = 100;

/// What should be known of the specimens before anything is concluded from all of them.
std::vector<Remark> remarks_of(const SpecimenTable& table, const Collection& found);

}  // namespace tunica::cohort
