// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>

#include "support/tube.hpp"

namespace tunica::testing {

struct FeSetup {
  std::string element = "quadrilateral_4", elements = "null", ends = "clamped";
  std::vector<std::string> channels = {"outer_diameter_stretch", "axial_force"};
  double axial_stretch = 1.2;  ///< held; ignored where `axial_stretches` is given
  std::vector<double> axial_stretches = {};
  Options options = {};  ///< beyond those above
  std::vector<double> layers = {};
  std::vector<double> time = {};
};
/// Parameters of the test at which the tube is as recorded: those of the long tube.
inline const std::vector<double> bare_fe = bare_tube;

/// The lamb aorta of Canales et al. 2023 as finite elements.
inline std::unique_ptr<Test> make_fe_tube(const std::vector<double>& pressure, const FeSetup& tube = {}) {
  const auto& entry = catalogue().tests().at("fe_pressurisation");
  TestSetup setup;
  setup.options = defaults(entry.factory.options);
  setup.options.set("inner_radius", 3.71);
  setup.options.set("thickness", 2.06);
  setup.options.set("length", 14.);
  if (tube.axial_stretches.empty()) setup.options.set("axial_stretch", tube.axial_stretch);
  setup.options.set("element", tube.element);
  setup.options.set("elements", tube.elements);
  setup.options.set("ends", tube.ends);
  for (const auto& [name, value] : tube.options.values()) setup.options.set(name, value);
  setup.rows.count = pressure.size();
  setup.rows.abscissae = {{"pressure", pressure}};
  if (!tube.axial_stretches.empty()) setup.rows.abscissae.push_back({"axial_stretch", tube.axial_stretches});
  setup.rows.channels = tube.channels;
  setup.rows.time = tube.time;
  setup.layers = tube.layers;
  return plugins::create(entry, setup);
}

/// Columns of a table of numbers with one header line; lines that begin with # are comments.
inline std::vector<std::vector<double>> columns_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::vector<double>> columns;
  bool header = true;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (header) {
      header = false;
      continue;
    }
    std::stringstream cells(line);
    std::size_t k = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++k) {
      if (k == columns.size()) columns.emplace_back();
      columns[k].push_back(std::stod(cell));
    }
  }
  return columns;
}

}  // namespace tunica::testing
