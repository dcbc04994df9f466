// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "figures.hpp"

namespace blind::score {

/// The figures as a table in Markdown, and one row an effect; `heading` tells of date and seeds.
std::string markdown(const std::string& heading, const std::vector<Figure>& figures,
                     const std::vector<EffectRow>& effects);
nlohmann::ordered_json as_json(const std::vector<Figure>& figures, const std::vector<EffectRow>& effects);

}  // namespace blind::score
