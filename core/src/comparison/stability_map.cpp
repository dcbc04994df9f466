// SPDX-License-Identifier: Apache-2.0
#include "comparison/stability_map.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "data/nearest.hpp"
#include "execution/evaluation_table.hpp"
#include "stability/transverse.hpp"
#include "tunica/error.hpp"

namespace tunica::comparison {
namespace {

std::size_t index_of(const calibration::Assembly& assembly, const std::string& name) {
  std::vector<std::string> known;
  for (std::size_t j = 0; j < assembly.parameters().size(); ++j) {
    known.push_back(assembly.parameters()[j].name);
    if (known.back() == name) return j;
  }
  for (const auto& fixed : assembly.fixed_parameters())
    if (fixed.name == name)
      throw InputError(
          fmt::format("stability map: '{}' is fixed at {:.6g}; free it, so that it has bounds to draw the map between",
                      name, fixed.value));
  throw InputError(
      fmt::format("stability map: there is no free parameter '{}'. {}", name, data::suggestion(name, known)));
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value) : ""; }

}  // namespace

std::string stability_map(const calibration::Assembly& assembly, std::span<const double> free,
                          const std::array<std::string, 2>& names, std::size_t points, double limit) {
  const std::array<std::size_t, 2> index{index_of(assembly, names[0]), index_of(assembly, names[1])};
  if (index[0] == index[1])
    throw InputError(fmt::format("stability map: '{}' is named twice; a map has two parameters", names[0]));
  std::vector<double> unit(free.size());
  assembly.to_unit(free, unit);
  std::vector<std::string> rows(points * points);
  tbb::parallel_for(std::size_t{0}, points * points, [&](std::size_t at) {
    std::vector<double> x = unit, p(free.size());
    x[index[0]] = static_cast<double>(at / points) / static_cast<double>(points - 1);
    x[index[1]] = static_cast<double>(at % points) / static_cast<double>(points - 1);
    assembly.from_unit(x, p);
    const auto parameters = assembly.model_parameters(p);
    std::array<stability::TransverseVerdict, 2> verdict;
    for (const std::size_t axis : {std::size_t{0}, std::size_t{1}})
      verdict[axis] = stability::judge(assembly.model(), parameters, axis, {}, limit);
    const auto first = [&](std::size_t axis) {
      return verdict[axis].first_unstable ? number(*verdict[axis].first_unstable) : std::string();
    };
    rows[at] = fmt::format("{},{},{},{},{},{}\n", number(p[index[0]]), number(p[index[1]]),
                           verdict[0].first_unstable || verdict[1].first_unstable ? 0 : 1, first(0), first(1),
                           number(std::max(verdict[0].worst_slope, verdict[1].worst_slope)));
  });
  const auto header = [&](std::size_t k) {
    return execution::csv_cell(fmt::format("{} [{}]", names[k], assembly.parameters()[index[k]].unit));
  };
  std::string text = fmt::format(
      "# Transverse stability of free strips from rest to stretch {:g}.\n{},{},stable,"
      "first_unstable_circumferential [1],first_unstable_axial [1],worst_slope [1]\n",
      limit, header(0), header(1));
  for (const std::string& row : rows) text += row;
  return text;
}

}  // namespace tunica::comparison
