// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tunica::diagnosis {

const char* code_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::nothing_detected:
      return "nothing_detected";
    case Verdict::named:
      return "named";
    case Verdict::indistinguishable:
      return "indistinguishable";
    case Verdict::suspect_data:
      return "suspect_data";
    case Verdict::discovered:
      return "discovered";
    case Verdict::leading:
      return "leading";
    case Verdict::unknown:
      break;
  }
  return "unknown";
}

const char* code_of(ReasonKind kind) {
  switch (kind) {
    case ReasonKind::residuals_like_noise:
      return "residuals_like_noise";
    case ReasonKind::rows_miss_the_model:
      return "rows_miss_the_model";
    case ReasonKind::leads:
      return "leads";
    case ReasonKind::several_lead:
      return "several_lead";
    case ReasonKind::unlisted_misfit:
      return "unlisted_misfit";
    case ReasonKind::anisotropy_seen:
      return "anisotropy_seen";
    case ReasonKind::rival_not_looked_for:
      return "rival_not_looked_for";
    case ReasonKind::terms_discovered:
      return "terms_discovered";
    case ReasonKind::no_trace:
      return "no_trace";
    case ReasonKind::no_trace_of_requested:
      return "no_trace_of_requested";
    case ReasonKind::no_fit:
      return "no_fit";
    case ReasonKind::many_explanations:
      return "many_explanations";
    case ReasonKind::shape_correction:
      return "shape_correction";
    case ReasonKind::single_place:
      return "single_place";
    case ReasonKind::at_bound:
      return "at_bound";
    case ReasonKind::implausible:
      return "implausible";
    case ReasonKind::single_carrier:
      return "single_carrier";
    case ReasonKind::gross_rows:
      return "gross_rows";
    case ReasonKind::not_clean:
      return "not_clean";
    case ReasonKind::larger_noise:
      return "larger_noise";
    case ReasonKind::lost_stability:
      return "lost_stability";
    case ReasonKind::stability_restored:
      return "stability_restored";
    case ReasonKind::file_suspected:
      return "file_suspected";
    case ReasonKind::file_as_likely:
      return "file_as_likely";
    case ReasonKind::restored_by_larger:
      break;
  }
  return "restored_by_larger";
}

const char* code_of(FileKind kind) {
  switch (kind) {
    case FileKind::stress_measure:
      return "stress_measure";
    case FileKind::strain_definition:
      return "strain_definition";
    case FileKind::exchange:
      return "exchange";
    case FileKind::sign:
      return "sign";
    case FileKind::unit:
      return "unit";
    case FileKind::geometry:
      return "geometry";
    case FileKind::angle:
      return "angle";
    case FileKind::clock:
      return "clock";
    case FileKind::calibration:
      break;
  }
  return "calibration";
}

const char* code_of(FileStanding standing) {
  switch (standing) {
    case FileStanding::not_looked_for:
      return "not_looked_for";
    case FileStanding::far:
      return "far";
    case FileStanding::near:
      return "near";
    case FileStanding::ahead:
      break;
  }
  return "ahead";
}

const char* code_of(CauseGroup group) { return group == CauseGroup::material ? "material" : "rig"; }

const char* code_of(Standing standing) {
  switch (standing) {
    case Standing::probable:
      return "probable";
    case Standing::at_bound:
      return "at_bound";
    case Standing::implausible:
      return "implausible";
    case Standing::rest_is_left:
      break;
  }
  return "rest_is_left";
}

const char* code_of(Absence absence) {
  switch (absence) {
    case Absence::none:
      return "none";
    case Absence::no_trace:
      return "no_trace";
    case Absence::absorbed:
      return "absorbed";
    case Absence::no_clock:
      return "no_clock";
    case Absence::already_there:
      return "already_there";
    case Absence::no_place:
      return "no_place";
    case Absence::not_applicable:
      return "not_applicable";
    case Absence::isotropic:
      return "isotropic";
    case Absence::no_volume:
      return "no_volume";
    case Absence::no_size:
      return "no_size";
    case Absence::no_past:
      break;
  }
  return "no_past";
}

bool can_hide(Absence absence) {
  return absence == Absence::none || absence == Absence::no_trace || absence == Absence::absorbed ||
         absence == Absence::no_clock || absence == Absence::no_past || absence == Absence::no_volume ||
         absence == Absence::no_size;
}

const char* code_of(WarningKind kind) {
  switch (kind) {
    case WarningKind::channel_without_weight:
      return "channel_without_weight";
    case WarningKind::constraints_not_applied:
      return "constraints_not_applied";
    case WarningKind::test_held_out:
      return "test_held_out";
    case WarningKind::noise_estimated:
      return "noise_estimated";
    case WarningKind::rows_correlated:
      return "rows_correlated";
    case WarningKind::gross_rows_left_out:
      return "gross_rows_left_out";
    case WarningKind::optimizer_has_stages:
      return "optimizer_has_stages";
    case WarningKind::optimizer_failed:
      return "optimizer_failed";
    case WarningKind::base_fit_not_optimal:
      return "base_fit_not_optimal";
    case WarningKind::base_fit_at_bound:
      return "base_fit_at_bound";
    case WarningKind::noise_too_large:
      return "noise_too_large";
    case WarningKind::noise_vanishes:
      return "noise_vanishes";
    case WarningKind::memory_not_looked_for:
      return "memory_not_looked_for";
    case WarningKind::order_assumed:
      return "order_assumed";
    case WarningKind::record:
      return "record";
    case WarningKind::run_differs_in_noise:
      return "run_differs_in_noise";
    case WarningKind::run_takes_file_order:
      return "run_takes_file_order";
    case WarningKind::run_keeps_gross_rows:
      return "run_keeps_gross_rows";
    case WarningKind::base_model:
      break;
  }
  return "base_model";
}

const char* code_of(BlockVerdict verdict) {
  switch (verdict) {
    case BlockVerdict::predicted:
      return "predicted";
    case BlockVerdict::not_predicted:
      return "not_predicted";
    case BlockVerdict::inconclusive:
      break;
  }
  return "inconclusive";
}

std::string Place::words() const {
  if (tests.empty()) return model.empty() ? "in the material" : fmt::format("in the material of '{}'", model);
  if (tests.size() > 1) return fmt::format("alike in the tests '{}'", fmt::join(tests, "', '"));
  const std::string where = row ? fmt::format(", row {}", file_row) : std::string();
  if (channel.empty()) return fmt::format("in the test '{}'{}", tests.front(), where);
  return fmt::format("in the channel '{}' of the test '{}'{}", channel, tests.front(), where);
}

}  // namespace tunica::diagnosis
