// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "comparison/summary.hpp"

namespace tunica::comparison {

/// One observable over all tests of a run: root mean square errors of the fitted and of the held-out rows.
struct Transfer {
  std::string channel, unit;
  double in_sample = 0, held_out = 0;
  const Quality* worst = nullptr;  ///< of the held-out channels, by R² where there is one, else by error
};

/// The observables of which some rows were fitted and others held out.
std::vector<Transfer> transfers(const std::vector<Quality>& quality);

/// Where held-out rows are missed by more than twice the error in sample, and by more than 1 %: a sentence; else empty.
std::string transfer_warning(const std::string& label, const std::vector<Quality>& quality);

/// Errors in sample and held out side by side, a line a channel and one an observable; empty where nothing is held out.
std::string hold_out_table(const std::vector<Quality>& quality);

}  // namespace tunica::comparison
