// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>

#include "experiment/reader.hpp"

namespace tunica::experiment {
namespace {

/// Lengths of specimens, mm: from a hundredth of a red blood cell's wall to the length of a leg.
constexpr double smallest = 1e-4, largest = 1000;

void look_at_size(const Node& node, const std::string& what, std::string_view owner, double length,
                  std::vector<data::Finding>& findings) {
  const double size = std::abs(length);
  if (size == 0 || !std::isfinite(size) || (size >= smallest && size <= largest)) return;
  findings.push_back({data::FindingKind::record_size,
                      fmt::format("{}: the {} of {} is {:.4g} mm. No specimen is so {}. Is its unit right?",
                                  node.place(), what, owner, length, size < smallest ? "small" : "large")});
}

}  // namespace

std::vector<data::Finding> odd_sizes(const Node& entry, const TestEntry& test, const std::vector<Option>& options,
                                     std::string_view owner) {
  std::vector<data::Finding> findings;
  for (const Option& option : options)
    if (const auto node = entry.find(option.name); node && option.unit == "mm" && test.options.has(option.name))
      look_at_size(*node, option.name, owner, test.options.number(option.name), findings);
  const auto data = entry.find("data");
  const auto node = data ? data->find("specimen") : std::nullopt;
  if (!node) return findings;
  const data::Specimen& specimen = test.data.specimen;
  const auto look = [&](const char* what, const std::optional<double>& length) {
    if (length) look_at_size(node->child_or_self(what), what, owner, *length, findings);
  };
  look("thickness", specimen.thickness);
  look("height", specimen.height);
  if (specimen.area && (*specimen.area < smallest * smallest || *specimen.area > largest * largest))
    findings.push_back({data::FindingKind::record_size,
                        fmt::format("{}: the area of {} is {:.4g} mm2. No specimen is so {}. Is its unit right?",
                                    node->child_or_self("area").place(), owner, *specimen.area,
                                    *specimen.area < 1 ? "small" : "large")});
  const auto look_along = [&](const data::Sizes& sizes) {
    look("width", sizes.width);
    look("gauge_length", sizes.gauge_length);
    look("grip_distance", sizes.grip_distance);
  };
  look_along(specimen.all);
  for (const auto& [direction, sizes] : specimen.directions) look_along(sizes);
  return findings;
}

}  // namespace tunica::experiment
