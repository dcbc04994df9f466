// SPDX-License-Identifier: Apache-2.0
#include "comparison/stability_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "data/nearest.hpp"
#include "execution/evaluation_table.hpp"
#include "stability/transverse.hpp"
#include "text/csv.hpp"
#include "tunica/error.hpp"

namespace tunica::comparison {
namespace {

std::size_t index_of(const assembly::Assembly& assembly, const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t j = 0; j < assembly.layout().parameters.size(); ++j) {
    known.push_back(assembly.layout().parameters[j].name);
    if (known.back() == name) return j;
  }
  for (const auto& fixed : assembly.layout().fixed_parameters)
    if (fixed.name == name)
      throw InputError(
          fmt::format("stability map: '{}' is fixed at {:.6g}; free it, so that it has bounds to draw the map between",
                      name, fixed.value));
  throw InputError(
      fmt::format("stability map: there is no free parameter '{}'. {}", name, data::suggestion(name, known)));
}

std::string map_cell(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value) : ""; }

/// Strips along both axes; of several models the one that is worst.
struct Strips {
  std::array<std::optional<double>, 2> first_unstable;
  double worst_slope = -std::numeric_limits<double>::infinity();
};

Strips judge_strips(const assembly::Assembly& assembly, std::span<const double> free, double limit) {
  Strips worst;
  for (std::size_t m = 0; m < assembly.models().count(); ++m) {
    const auto parameters = assembly.models().parameters(m, free);
    if (assembly.models().model(m).describe().compressible)
      throw InputError(fmt::format(
          "stability map: the model '{}' changes its volume, and transverse stability is that of an incompressible "
          "material; choose an incompressible model",
          assembly.models().name(m)));
    for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
      const auto verdict = stability::judge_transverse(assembly.models().model(m), parameters, axis, {}, limit);
      auto& first = worst.first_unstable[axis];
      if (verdict.first_unstable) first = std::min(first.value_or(*verdict.first_unstable), *verdict.first_unstable);
      worst.worst_slope = std::max(worst.worst_slope, verdict.worst_slope);
    }
  }
  return worst;
}

}  // namespace

std::string stability_map(const assembly::Assembly& assembly, std::span<const double> free,
                          const std::array<std::string, 2>& names, std::size_t points, double limit) {
  const std::array<std::size_t, 2> index{index_of(assembly, names[0]), index_of(assembly, names[1])};
  if (index[0] == index[1])
    throw InputError(fmt::format("stability map: '{}' is named twice; a map has two parameters", names[0]));
  std::vector<double> unit(free.size());
  assembly.box().to_unit(free, unit);
  std::vector<std::string> rows(points * points);
  tbb::parallel_for(std::size_t{0}, points * points, [&](std::size_t at) {
    std::vector<double> x = unit, p(free.size());
    const std::size_t row = at / points, column = at % points;
    x[index[0]] = static_cast<double>(row) / static_cast<double>(points - 1);
    x[index[1]] = static_cast<double>(column) / static_cast<double>(points - 1);
    assembly.box().from_unit(x, p);
    const Strips strips = judge_strips(assembly, p, limit);
    const auto first = [&](std::size_t axis) {
      return strips.first_unstable[axis] ? map_cell(*strips.first_unstable[axis]) : std::string();
    };
    rows[at] = fmt::format("{},{},{},{},{},{}\n", map_cell(p[index[0]]), map_cell(p[index[1]]),
                           strips.first_unstable[0] || strips.first_unstable[1] ? 0 : 1, first(0), first(1),
                           map_cell(strips.worst_slope));
  });
  const auto header = [&](std::size_t k) {
    return text::csv_cell(fmt::format("{} [{}]", names[k], assembly.layout().parameters[index[k]].unit));
  };
  std::string text = fmt::format(
      "# Transverse stability of free strips from rest to stretch {:g}.\n{},{},stable,"
      "first_unstable_circumferential [1],first_unstable_axial [1],worst_slope [1]\n",
      limit, header(0), header(1));
  for (const std::string& row : rows) text += row;
  return text;
}

}  // namespace tunica::comparison
