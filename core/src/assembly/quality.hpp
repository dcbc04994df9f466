// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"

namespace tunica::assembly {

/// How well p predicts the measured e over some rows of a channel.
struct Agreement {
  std::size_t rows = 0;
  double rmse = 0;             ///< √⟨(e − p)²⟩, in the unit of the channel
  std::optional<double> r2;    ///< 1 − Σ(e − p)²/Σ(e − ⟨e⟩)²; none when the measured values do not vary
  std::optional<double> nmad;  ///< per cent: 100 ⟨|e − p|⟩/max(⟨|e|⟩, ⟨|p|⟩); none when both are zero
};

struct ChannelQuality {
  std::string test, observable, unit, over;   ///< over: the abscissa that it is drawn over
  std::optional<Agreement> fitted, held_out;  ///< none without such rows
};

/// Agreement of measured and predicted rows; both have the same length, at least one.
Agreement agreement(std::span<const double> measured, std::span<const double> predicted);

/// Per channel of the assembly, from all its predictions.
std::vector<ChannelQuality> quality(const Assembly& assembly, std::span<const double> predictions);

}  // namespace tunica::assembly
