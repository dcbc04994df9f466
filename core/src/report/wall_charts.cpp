// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "report/sections.hpp"
#include "report/thinning.hpp"

namespace tunica::report {

namespace {

constexpr std::size_t most_walls = 2, most_cells = 6000;
constexpr std::array<const char*, 5> through{"circumferential_stress", "axial_stress", "radial_stress",
                                             "circumferential_stretch", "least_wave_stiffness"};
constexpr std::array<const char*, 4> over{"circumferential_stress", "axial_stress", "shear_stress",
                                          "least_wave_stiffness"};

/// The wall of one test at one row: some rows of a table.
struct State {
  Table table;
  std::vector<std::size_t> rows;
  std::string row;   ///< its number
  std::string grid;  ///< file of the mesh

  [[nodiscard]] std::vector<double> column(std::string_view name) const {
    std::vector<double> values;
    for (const std::size_t at : rows) values.push_back(table.number(at, name));
    return values;
  }
  /// The prescribed quantity of the row: its value, and "pressure = 13.3 kPa".
  [[nodiscard]] std::pair<double, std::string> load() const {
    for (std::size_t c = 0; c < table.columns().size(); ++c) {
      const auto& column = table.columns()[c];
      if (!column.name.starts_with("prescribed_")) continue;
      const double value = table.number(rows.front(), c);
      return {value, fmt::format("{} = {}", column.name.substr(11), amount(value, column.unit.value_or("1")))};
    }
    return {0, "row " + row};
  }
};

struct Wall {
  std::string test, run;
  std::vector<State> states;
  std::vector<std::string> files;
};

/// "tube", "18" of "tube_18_section.csv"; the second is "" where it is no such name.
std::pair<std::string, std::string> test_and_row(const std::string& file) {
  constexpr std::string_view end = "_section.csv";
  if (!file.ends_with(end)) return {file, ""};
  const std::string stem = file.substr(0, file.size() - end.size());
  const auto cut = stem.rfind('_');
  if (cut == std::string::npos) return {file, ""};
  return {stem.substr(0, cut), stem.substr(cut + 1)};
}

std::vector<Wall> walls_of(const Folder& folder) {
  std::vector<Wall> walls;
  const auto of = [&](const std::string& test) -> Wall& {
    for (Wall& wall : walls)
      if (wall.test == test) return wall;
    return walls.emplace_back(Wall{test, "", {}, {}});
  };
  for (const std::string& file : folder.tables(folder.kind() == Folder::Kind::run ? "wall_" : "")) {
    const auto table = folder.table(file);
    if (!table || !table->find("radius") || !table->find("unloaded_radius")) continue;
    if (folder.kind() == Folder::Kind::run) {
      const std::string stem = file.substr(0, file.size() - 4);
      Wall& wall = of(stem.substr(5));
      wall.run = table->text(0, "run");
      wall.files.push_back(file);
      for (auto& [row, rows] : table->groups("row")) {
        std::string grid = fmt::format("{}_{}.vtu", stem, row);
        wall.states.push_back({*table, std::move(rows), row, std::move(grid)});
      }
    } else if (const auto [test, row] = test_and_row(file); !row.empty()) {
      Wall& wall = of(test);
      wall.files.push_back(file);
      std::vector<std::size_t> rows(table->rows());
      for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = k;
      wall.states.push_back({*table, std::move(rows), row, fmt::format("{}_{}.vtu", test, row)});
    }
  }
  for (Wall& wall : walls)
    std::stable_sort(wall.states.begin(), wall.states.end(),
                     [](const State& a, const State& b) { return a.load().first < b.load().first; });
  for (Wall& wall : walls) {
    if (wall.files.size() < 2) continue;
    wall.files.clear();  // one a state: in its order
    for (const State& state : wall.states) wall.files.push_back(state.table.file_name());
  }
  return walls;
}

Series arc(const std::string& name, double radius, int style) {
  Series line{name, "line", style};
  constexpr int steps = 48;
  for (int k = 0; k <= steps; ++k) {
    const double angle = std::numbers::pi / 2 * k / steps;
    line.x.push_back(radius * std::cos(angle));
    line.y.push_back(radius * std::sin(angle));
  }
  return line;
}

/// A quarter of the cross-section under the largest load, coloured, with the outlines of the other states.
Chart ring(const Wall& wall) {
  constexpr std::size_t sectors = 30, layers = 16;
  const State& loaded = wall.states.back();
  const auto radius = loaded.column("radius"), stress = loaded.column("circumferential_stress");
  Chart chart;
  const auto kept = evenly(radius.size(), layers);
  if (kept.size() < 2) return chart;
  Json points = Json::array(), cells = Json::array(), values = Json::array();
  for (const std::size_t i : kept)
    for (std::size_t s = 0; s <= sectors; ++s) {
      const double angle = std::numbers::pi / 2 * static_cast<double>(s) / sectors;
      points.push_back(short_number(radius[i] * std::cos(angle)));
      points.push_back(short_number(radius[i] * std::sin(angle)));
    }
  for (std::size_t i = 0; i + 1 < kept.size(); ++i)
    for (std::size_t s = 0; s < sectors; ++s) {
      const std::size_t first = i * (sectors + 1) + s, out = first + sectors + 1;
      for (const std::size_t corner : {first, first + 1, out + 1, out}) cells.push_back(corner);
      values.push_back(short_number(0.5 * (stress[kept[i]] + stress[kept[i + 1]])));
    }
  chart.kind = "mesh";
  chart.id = "deformed_wall_" + wall.test;
  chart.title = "Deformed wall at " + loaded.load().second;
  chart.about =
      "A quarter of the cross-section at mid-length, with the outlines of the unloaded wall and of other rows";
  chart.note = fmt::format("Colours: circumferential stress from face to face, {} layers.", layers - 1);
  chart.files = wall.files;
  chart.mesh = {
      {"points", std::move(points)}, {"cells", std::move(cells)}, {"values", std::move(values)}, {"title", "kPa"}};
  const auto unloaded = loaded.column("unloaded_radius");
  double largest = std::max(radius.back(), unloaded.back());
  for (const double r : {unloaded.front(), unloaded.back()}) chart.series.push_back(arc("unloaded", r, -1));
  int style = -1;
  for (const State& state : wall.states) {
    ++style;  // as in the charts through the wall
    if (&state == &loaded) continue;
    const auto outline = state.column("radius");
    largest = std::max(largest, outline.back());
    for (const double r : {outline.front(), outline.back()}) chart.series.push_back(arc(state.load().second, r, style));
  }
  chart.x = {"mm", false, {}, {{0, 1.03 * largest}}};
  chart.y = {"mm", false, {}, {{0, 1.03 * largest}}};
  return chart;
}

Chart through_wall(const Wall& wall, const char* quantity) {
  Chart chart;
  const auto column = wall.states.front().table.find(quantity);
  if (!column) return chart;
  chart.id = fmt::format("wall_{}_{}", wall.test, quantity);
  chart.title = std::string(quantity) + " through the wall";
  std::replace(chart.title.begin(), chart.title.end(), '_', ' ');
  chart.about = fmt::format("{} over the radius that each point had in the unloaded wall, inside left", chart.title);
  chart.x.title = "radius in the unloaded wall [mm]";
  chart.y.title = wall.states.front().table.title(*column);
  chart.files = wall.files;
  if (quantity == std::string("least_wave_stiffness")) {
    chart.rule(0, "below: no longer elliptic");
    chart.note = "How far the material is from losing ellipticity.";
  }
  int style = 0;
  for (const State& state : wall.states) {
    Series series{state.load().second, "line", style++};
    const auto radius = state.column("unloaded_radius"), values = state.column(quantity);
    for (const std::size_t i : shape_keeping(values, 200)) {
      series.x.push_back(radius[i]);
      series.y.push_back(values[i]);
    }
    if (!series.x.empty()) chart.series.push_back(std::move(series));
  }
  chart.legend = true;
  return chart;
}

/// Where the body was: the rectangle that half the section is before loading.
void add_outline(Chart& chart, const Grid& grid) {
  const auto moved = std::find_if(grid.of_points.begin(), grid.of_points.end(), [](const Grid::Field& field) {
    return field.title.starts_with("displacement") && field.components == 3;
  });
  auto [left, right] = std::minmax_element(grid.x.begin(), grid.x.end());
  auto [low, high] = std::minmax_element(grid.y.begin(), grid.y.end());
  double r0 = *left, r1 = *right, z0 = *low, z1 = *high;
  if (moved != grid.of_points.end()) {
    double a = INFINITY, b = -INFINITY, c = INFINITY, d = -INFINITY;
    for (std::size_t i = 0; i < grid.x.size(); ++i) {
      const double r = grid.x[i] - moved->values[3 * i], z = grid.y[i] - moved->values[3 * i + 1];
      a = std::min(a, r);
      b = std::max(b, r);
      c = std::min(c, z);
      d = std::max(d, z);
    }
    chart.series.push_back({"unloaded", "line", -1, {a, b, b, a, a}, {c, c, d, d, c}});
    r0 = std::min(r0, a);
    r1 = std::max(r1, b);
    z0 = std::min(z0, c);
    z1 = std::max(z1, d);
  }
  const double margin = 0.03 * std::max(r1 - r0, z1 - z0);
  chart.x = {"radius [mm]", false, {}, {{r0 - margin, r1 + margin}}};
  chart.y = {"height above mid-length [mm]", false, {}, {{z0 - margin, z1 + margin}}};
}

/// "kPa" of "axial_stress [kPa]"; nothing of a number.
std::string unit_of(const std::string& title) {
  const auto open = title.rfind('[');
  return open == std::string::npos ? "" : title.substr(open + 1, title.size() - open - 2);
}

void add_fields(Page& page, const Folder& folder, const Wall& wall) {
  const State& loaded = wall.states.back();
  const auto grid = folder.grid(loaded.grid);
  if (!grid) return;
  const std::size_t count = grid->cells.size() / 4;
  if (count > most_cells) {
    page.paragraph(
        fmt::format("The mesh has {} cells, too many to draw here; open {} in ParaView.", count, loaded.grid), "muted");
    return;
  }
  page.heading(fmt::format("{}: fields at {}", wall.test, loaded.load().second));
  page.begin_pair();
  for (const char* quantity : over) {
    const auto field = std::find_if(grid->of_cells.begin(), grid->of_cells.end(), [&](const Grid::Field& one) {
      return one.title.substr(0, one.title.find(" [")) == quantity;
    });
    if (field == grid->of_cells.end()) continue;
    Chart chart;
    chart.kind = "mesh";
    chart.id = fmt::format("field_{}_{}_{}", wall.test, loaded.row, quantity);
    chart.title = quantity;
    std::replace(chart.title.begin(), chart.title.end(), '_', ' ');
    chart.about = fmt::format("{} over half the section of the tube, the axis of the tube left", chart.title);
    chart.files = {loaded.grid};
    Json points = Json::array(), values = Json::array();
    for (std::size_t i = 0; i < grid->x.size(); ++i) {
      points.push_back(short_number(grid->x[i]));
      points.push_back(short_number(grid->y[i]));
    }
    for (const double value : field->values) values.push_back(short_number(value));
    chart.mesh = {{"points", std::move(points)},
                  {"cells", grid->cells},
                  {"values", std::move(values)},
                  {"title", unit_of(field->title)}};
    add_outline(chart, *grid);
    page.chart(chart, folder.address());
  }
  page.end_pair();
}

}  // namespace

void add_walls(Page& page, const Folder& folder) {
  const auto walls = walls_of(folder);
  if (walls.empty()) return;
  page.section("Wall of the tube");
  std::size_t drawn = 0;
  for (const Wall& wall : walls) {
    if (wall.states.empty() || drawn == most_walls) continue;
    ++drawn;
    page.heading(wall.run.empty() ? wall.test : fmt::format("{}, best point of {}", wall.test, wall.run));
    page.begin_pair();
    page.chart(ring(wall), folder.address());
    for (const char* quantity : through) page.chart(through_wall(wall, quantity), folder.address());
    page.end_pair();
    add_fields(page, folder, wall);
  }
  if (drawn < walls.size())
    page.paragraph(fmt::format("{} of {} tests are drawn; the other tables wall_….csv lie beside this report.", drawn,
                               walls.size()),
                   "muted");
}

}  // namespace tunica::report
