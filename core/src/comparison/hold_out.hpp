// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "comparison/summary.hpp"
#include "execution/warning.hpp"
#include "text/codes.hpp"

namespace tunica::comparison {

/// Whether a run predicts held-out rows about as well as it fits the others: worse_than_fitted where they are missed by
/// more than twice the error in sample, and by more than 1 %.
enum class HoldOutVerdict { predicted, worse_than_fitted };

inline constexpr text::Codes<HoldOutVerdict, 2> hold_out_codes{
    {{HoldOutVerdict::predicted, "predicted"}, {HoldOutVerdict::worse_than_fitted, "worse_than_fitted"}}};

/// One observable over all tests of a run: root mean square errors of the fitted and of the held-out rows.
struct Transfer {
  std::string channel, unit;
  double in_sample = 0, held_out = 0;
  const Quality* worst = nullptr;  ///< of the held-out channels, by R² where there is one, else by error
  HoldOutVerdict verdict = HoldOutVerdict::predicted;
};

/// The observables of which some rows were fitted and others held out.
std::vector<Transfer> transfers(const std::vector<Quality>& quality);

/// Of the observables that are worse_than_fitted, where there are some.
std::optional<execution::Warning> transfer_warning(const std::string& label, const std::vector<Quality>& quality);

/// Errors in sample and held out side by side, a line a channel and one an observable; empty where nothing is held out.
std::string hold_out_table(const std::vector<Quality>& quality);

}  // namespace tunica::comparison
