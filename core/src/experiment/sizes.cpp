// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>

#include "experiment/reader.hpp"

namespace tunica::experiment {
namespace {

/// Lengths of specimens, mm: from a tenth of a membrane of 10 nm to the length of a leg.
constexpr double smallest = 1e-6, largest = 1000;

/// `power`: 1 for a length, 2 for an area.
void look_at_size(const Node& node, const std::string& what, std::string_view owner, double size, int power,
                  std::vector<data::Finding>& findings) {
  const double length = power == 1 ? std::abs(size) : std::sqrt(std::abs(size));
  if (length == 0 || !std::isfinite(length) || (length >= smallest && length <= largest)) return;
  findings.push_back(
      {data::FindingKind::record_size,
       fmt::format("{}: the {} of {} is {:.4g} {}. Hardly a specimen is so {}. Is its unit right?", node.place(), what,
                   owner, size, power == 1 ? "mm" : "mm2", length < smallest ? "small" : "large")});
}

void look_along(const Node& node, const data::Sizes& sizes, std::string_view owner,
                std::vector<data::Finding>& findings) {
  const auto look = [&](const char* what, const std::optional<double>& length) {
    if (length) look_at_size(node.child_or_self(what), what, owner, *length, 1, findings);
  };
  look("width", sizes.width);
  look("gauge_length", sizes.gauge_length);
  look("grip_distance", sizes.grip_distance);
}

/// The smaller side of a section is its thickness; rods and square specimens are measured in any order.
void look_at_section(const Node& node, const data::Specimen& specimen, const data::Sizes& sizes, std::string_view owner,
                     std::vector<data::Finding>& findings) {
  if (!specimen.thickness || !sizes.width || *specimen.thickness <= 2 * *sizes.width) return;
  if (*specimen.thickness > largest || *sizes.width < smallest) return;  // said above
  findings.push_back(
      {data::FindingKind::record_size,
       fmt::format("{}: {} is {:.4g} mm thick and {:.4g} mm wide. Is the unit of the thickness right, or "
                   "are the two exchanged?",
                   node.place(), owner, *specimen.thickness, *sizes.width)});
}

}  // namespace

std::vector<data::Finding> odd_sizes(const Node& entry, const TestEntry& test, const std::vector<Option>& options,
                                     std::string_view owner) {
  std::vector<data::Finding> findings;
  for (const Option& option : options)
    if (const auto node = entry.find(option.name); node && option.unit == "mm" && test.options.has(option.name))
      look_at_size(*node, option.name, owner, test.options.number(option.name), 1, findings);
  if (const auto layers = entry.find("layers"))
    for (std::size_t k = 0; k < test.layers.size(); ++k)
      look_at_size(layers->element(k), "thickness of a layer", owner, test.layers[k].thickness, 1, findings);
  const auto data = entry.find("data");
  const auto node = data ? data->find("specimen") : std::nullopt;
  if (!node) return findings;
  const data::Specimen& specimen = test.data.specimen;
  const auto look = [&](const char* what, const std::optional<double>& size, int power) {
    if (size) look_at_size(node->child_or_self(what), what, owner, *size, power, findings);
  };
  look("thickness", specimen.thickness, 1);
  look("height", specimen.height, 1);
  look("area", specimen.area, 2);
  look_along(*node, specimen.all, owner, findings);
  look_at_section(node->child_or_self("thickness"), specimen, specimen.all, owner, findings);
  for (const auto& [direction, sizes] : specimen.directions) {
    look_along(node->child_or_self(direction), sizes, owner, findings);
    look_at_section(node->child_or_self(direction), specimen, sizes, owner, findings);
  }
  return findings;
}

}  // namespace tunica::experiment
