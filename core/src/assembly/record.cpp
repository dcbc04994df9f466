// SPDX-License-Identifier: Apache-2.0
#include "assembly/record.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data/header_words.hpp"
#include "experiment/materials.hpp"
#include "text/units.hpp"

namespace tunica::assembly {
namespace {

double option_of(const experiment::TestEntry& entry, const char* name) {
  return entry.options.has(name) ? entry.options.number(name) : 0;
}

const std::vector<double>* column_of(const data::Dataset& dataset, std::string_view name) {
  for (const auto& [observable, values] : dataset.abscissae)
    if (observable == name) return &values;
  for (const data::Channel& channel : dataset.channels)
    if (channel.observable == name) return &channel.values;
  return nullptr;
}

/// Two of the three lengths give the third: outer = inner + thickness. 0 where a type has other options.
double unloaded_diameter(const experiment::TestEntry& entry, bool outer) {
  const double outer_radius = option_of(entry, "outer_radius"), inner_radius = option_of(entry, "inner_radius");
  double thickness = option_of(entry, "thickness");
  for (const experiment::LayerEntry& layer : entry.layers) thickness += layer.thickness;
  const double given = outer ? outer_radius : inner_radius, other = outer ? inner_radius : outer_radius;
  if (given > 0) return 2 * given;
  return other > 0 && thickness > 0 ? 2 * (other + (outer ? thickness : -thickness)) : 0;
}

void look_at_diameter(const experiment::TestEntry& entry, const data::Dataset& dataset, const std::string& name,
                      double unloaded, std::vector<data::Finding>& findings) {
  constexpr double without_pressure = 0.02, tolerance = 0.1;
  const auto* const pressure = column_of(dataset, "pressure");
  const auto* const diameter = column_of(dataset, name);
  const auto* const stretch = column_of(dataset, "axial_stretch");
  if (pressure == nullptr || diameter == nullptr || !(unloaded > 0)) return;
  const double highest = *std::max_element(pressure->begin(), pressure->end());
  for (std::size_t row = 0; row < dataset.count; ++row) {
    if (!(std::abs((*pressure)[row]) <= without_pressure * highest) || !std::isfinite((*diameter)[row])) continue;
    const double axial = stretch != nullptr ? (*stretch)[row] : option_of(entry, "axial_stretch");
    if (!(axial > 0)) continue;
    const double held = unloaded / std::sqrt(axial);
    const double low = std::min(held, unloaded), high = std::max(held, unloaded);
    const double found = (*diameter)[row];
    if (found >= (1 - tolerance) * low && found <= (1 + tolerance) * high) continue;
    findings.push_back(
        {data::FindingKind::record_size,
         fmt::format(
             "line {}: without pressure '{}' is {:.4g}{}, and the unloaded tube of the file gives {:.4g}{} at an "
             "axial stretch of {:.3g}. Are the sizes those of this tube, and radii rather than diameters?",
             dataset.lines[row], name, found, name.ends_with("stretch") ? "" : " mm", held,
             name.ends_with("stretch") ? "" : " mm", axial)});
    return;
  }
}

}  // namespace

void look_at_unloaded_tube(const experiment::TestEntry& entry, const data::Dataset& dataset,
                           std::vector<data::Finding>& findings) {
  look_at_diameter(entry, dataset, "outer_diameter", unloaded_diameter(entry, true), findings);
  look_at_diameter(entry, dataset, "inner_diameter", unloaded_diameter(entry, false), findings);
}

void look_at_noise(const experiment::TestEntry& entry, const data::Dataset& dataset,
                   std::vector<data::Finding>& findings) {
  constexpr double too_much = 0.5;
  for (const auto& [name, noise] : entry.data.noise) {
    const auto* const values = column_of(dataset, name);
    double largest = 0;  // not the span: a channel that was held has next to none
    for (const double value : values == nullptr ? std::vector<double>() : *values)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
    if (noise.relative >= too_much)
      findings.push_back(
          {data::FindingKind::record_noise,
           fmt::format("the relative noise of '{}' is {:g}, which is {:g} % of each value. For {:g} % "
                       "write {:g}",
                       name, noise.relative, 100 * noise.relative, noise.relative, noise.relative / 100)});
    else if (largest > 0 && noise.absolute >= too_much * largest && noise.level.empty())
      findings.push_back({data::FindingKind::record_noise,
                          fmt::format("the absolute noise of '{}' is {:.3g}, and no value is beyond {:.3g}: so large a "
                                      "noise explains every fit. Is its unit right?",
                                      name, noise.absolute, largest)});
  }
}

void look_at_headers(const experiment::TestEntry& entry, std::vector<data::Finding>& findings) {
  for (const auto& [declared, header] : entry.data.columns) {
    const data::HeaderWords words = data::words_of_header(header);
    if (declared.starts_with("stress") && !words.measure.empty() && words.measure != entry.data.stress_measure)
      findings.push_back({data::FindingKind::header_measure,
                          fmt::format("the header '{}' speaks of \"{}\", and it is read as \"{}\". Which is it? Write "
                                      "\"stress_measure\": \"{}\" where the header is right",
                                      header, words.measure, entry.data.stress_measure, words.measure)});
    const bool strain = declared.find("strain") != std::string::npos || declared.starts_with("stretch");
    if (strain && !words.definition.empty() && !declared.starts_with(words.definition))
      findings.push_back({data::FindingKind::header_strain,
                          fmt::format("the header '{}' speaks of \"{}\", and the file maps it as \"{}\". Which is it? "
                                      "Map it as \"{}\" where the header is right",
                                      header, words.definition, declared, words.definition)});
  }
}

std::string stiffness_question(const experiment::TestEntry& entry, const data::Dataset& dataset,
                               const std::string& material) {
  const auto published = experiment::stiffness_of(material);
  if (!published) return {};
  constexpr double hardly = 0.01;
  double stress = 0, strain = 0;
  for (const data::Channel& channel : dataset.channels)
    for (const double value : channel.values)
      if (channel.observable.starts_with("stress") && std::isfinite(value)) stress = std::max(stress, std::abs(value));
  for (const auto& [name, values] : dataset.abscissae)
    for (const double value : values)
      if (name.starts_with("stretch") && std::isfinite(value)) strain = std::max(strain, std::abs(value - 1));
  if (!(stress > 0) || strain < hardly) return {};
  const double measured = stress / strain, ratio = measured / published->stiffness;
  if (ratio <= published->factor && ratio >= 1 / published->factor) return {};
  return fmt::format(
      "test '{}': {:.3g} kPa at a stretch of 1 ± {:.2g} is a stiffness of {:.3g} kPa, {} what is published of {} "
      "({:g} kPa: {}). Is the unit of the stress or of the stretch right? Where it is, take \"material\" out",
      entry.name, stress, strain, measured,
      ratio > 1 ? fmt::format("{:.3g} times", ratio) : fmt::format("1/{:.3g} of", 1 / ratio), material,
      published->stiffness, published->source);
}

}  // namespace tunica::assembly
