// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace tunica::search {

/// Why a search ended before its optimiser converged.
enum class StopReason {
  none,               ///< it did not
  target,             ///< the best objective is at or below stop.target
  stall,              ///< stop.stall evaluations without a better one
  max_evaluations,    ///< the budget is spent
  max_time,           ///< so is the time
  interrupted,        ///< by the user
  failure,            ///< the first failed evaluation under on_failure: stop
  failure_rate,       ///< too many evaluations failed
  nothing_succeeded,  ///< all of the first evaluations failed
  optimizer_failure,  ///< the optimiser threw
  not_needed          ///< a start behind the one that ended the search
};

inline constexpr std::array<std::pair<StopReason, std::string_view>, 11> stop_reason_codes{
    {{StopReason::none, "none"},
     {StopReason::target, "target"},
     {StopReason::stall, "stall"},
     {StopReason::max_evaluations, "max_evaluations"},
     {StopReason::max_time, "max_time"},
     {StopReason::interrupted, "interrupted"},
     {StopReason::failure, "failure"},
     {StopReason::failure_rate, "failure_rate"},
     {StopReason::nothing_succeeded, "nothing_succeeded"},
     {StopReason::optimizer_failure, "optimizer_failure"},
     {StopReason::not_needed, "not_needed"}}};

/// The stable name of a reason in files: "max_evaluations".
constexpr std::string_view code(StopReason reason) {
  for (const auto& [candidate, code] : stop_reason_codes)
    if (candidate == reason) return code;
  return "";
}

/// None for an unknown code.
constexpr std::optional<StopReason> stop_reason_from_code(std::string_view code) {
  for (const auto& [reason, candidate] : stop_reason_codes)
    if (candidate == code) return reason;
  return std::nullopt;
}

}  // namespace tunica::search
