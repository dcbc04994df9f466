// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "figures.hpp"

namespace blind::score {

/// All verdicts.
struct Score {
  std::vector<Figure> figures, classes, times;
  std::vector<MistakeRow> mistakes;
  std::vector<EffectRow> effects;
};

/// Tables in Markdown; `heading` tells of date and seeds.
std::string markdown(const std::string& heading, const Score& score);
nlohmann::ordered_json as_json(const Score& score);

}  // namespace blind::score
