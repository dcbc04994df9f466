// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>

#include "experiment/reader.hpp"

namespace tunica::experiment {
namespace {

/// A bare number that is a common angle in radians and an odd one in degrees.
void look_at_angle(const Node& node, const std::string& name, std::string_view owner,
                   std::vector<data::Finding>& findings) {
  constexpr double right_angle = 1.6;
  if (!node.is_number()) return;
  const double value = node.number("");
  if (value == 0 || !(std::abs(value) < right_angle)) return;
  findings.push_back({data::FindingKind::record_angle,
                      fmt::format("{}: '{}' of {} is {:g} without a unit, which is read in degrees. Is it in radians? "
                                  "Write \"{:g} rad\" or \"{:g} deg\"",
                                  node.place(), name, owner, value, value, value)});
}

}  // namespace

std::vector<data::Finding> bare_angles(const Node& entry, const std::vector<Option>& options,
                                       const std::vector<Parameter>& parameters, std::string_view owner) {
  std::vector<data::Finding> findings;
  for (const Option& option : options)
    if (const auto value = entry.find(option.name); value && option.unit == "deg")
      look_at_angle(*value, option.name, owner, findings);
  const auto block = entry.find("parameters");
  for (const Parameter& parameter : parameters)
    if (const auto setting = block ? block->find(parameter.name) : std::nullopt; setting && parameter.unit == "deg")
      for (const char* key : {"fixed", "initial", "max"})
        if (const auto value = setting->find(key)) look_at_angle(*value, parameter.name, owner, findings);
  return findings;
}

}  // namespace tunica::experiment
