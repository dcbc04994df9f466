// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/sections.hpp"
#include "text/lists.hpp"

namespace tunica::report {

namespace {

/// λ3 over the stretch of a free strip; where it rises, the strip is unstable.
void add_strips(Page& page, const Folder& folder, const Order& order, const Table& table) {
  page.begin_pair();
  for (const auto& [direction, rows] : table.groups("direction")) {
    Chart chart;
    chart.id = "stability_" + direction;
    chart.title = "Transverse stretch of a strip, " + direction;
    chart.about =
        fmt::format("λ3 over the stretch of a free strip pulled along the {} axis; it must not rise", direction);
    chart.x.title = "stretch";
    chart.y.title = "λ3";
    chart.files = {table.file_name()};
    chart.note = "Where a curve rises the material is unstable. ";
    std::map<std::size_t, Series> by_place;
    for (const std::size_t row : rows) {
      const std::string& run = table.text(row, "run");
      const std::size_t place = order.place(run);
      Series& series =
          by_place.try_emplace(place, Series{run, "line", static_cast<int>(place), {}, {}, {}, {}}).first->second;
      series.x.push_back(table.number(row, "stretch"));
      series.y.push_back(table.number(row, "normal_stretch"));
    }
    for (auto& [place, series] : by_place) {
      series.hidden = !order.shown(place);
      chart.series.push_back(std::move(series));
    }
    chart.note += order.note();
    page.chart(chart, folder.address());
  }
  page.end_pair();
}

std::vector<Series> strip_paths(const Folder& folder, const std::string& run, double limit) {
  std::vector<Series> paths;
  const auto table = folder.table("stability.csv");
  if (!table) return paths;
  for (const auto& [label, rows] : table->groups("run")) {
    if (label != run) continue;
    for (const std::string direction : {"circumferential", "axial"}) {
      Series path{direction + " strip", "line", direction == "axial" ? 1 : 0, {}, {}, {}, {}};
      for (const std::size_t row : rows) {
        if (table->text(row, "direction") != direction) continue;
        const double along = table->number(row, "stretch"), across = table->number(row, "transverse_stretch");
        path.x.push_back(direction == "axial" ? across : along);
        path.y.push_back(direction == "axial" ? along : across);
      }
      paths.push_back(std::move(path));
    }
  }
  paths.push_back({"equibiaxial", "line", 2, {1, limit}, {1, limit}, {}, {}});
  return paths;
}

/// Isocontours of the energy over both stretches of a sheet, with the paths of the tests on them.
Chart energy_chart(const Folder& folder, const Table& table, const std::string& run,
                   const std::vector<std::size_t>& rows) {
  Chart chart;
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(rows.size()))));
  if (n < 5 || n * n != rows.size()) return chart;
  const double low = table.number(rows.front(), "circumferential_stretch"),
               high = table.number(rows.back(), "circumferential_stretch");
  const double half = (high - low) / static_cast<double>(n - 1) / 2;
  double largest = 0;
  Json values = Json::array();
  // Drawn from the top: the largest axial stretch first. A point without energy is far outside, like its neighbours.
  for (std::size_t j = n; j-- > 0;)
    for (std::size_t i = 0; i < n; ++i) {
      const double energy = table.number(rows[i * n + j], "energy");
      if (std::isfinite(energy)) largest = std::max(largest, energy);
      values.push_back(short_number(energy));
    }
  if (!(largest > 0)) return chart;
  for (Json& value : values)
    if (value.is_null()) value = largest;
  // Levels in equal ratios, up to the end of the equibiaxial path: a sheet pressed along both axes, which no test does,
  // may hold many decades more.
  if (const double end = table.number(rows.back(), "energy"); std::isfinite(end) && end > 0) largest = end;
  Json levels = Json::array();
  for (int k = 0; k <= 12; ++k) levels.push_back(short_number(largest * std::pow(10.0, -4 + k / 3.0) * 0.999));
  chart.id = "energy_" + run;
  chart.title = "Energy of a sheet, " + run;
  chart.about = "Isocontours of the strain energy over circumferential and axial stretch, with the paths of tests";
  chart.note = "Three contours a decade, four decades below the end of the equibiaxial path.";
  chart.x = {"circumferential stretch", false, {}, {{low - half, high + half}}};
  chart.y = {"axial stretch", false, {}, {{low - half, high + half}}};
  chart.files = {table.file_name()};
  const auto energy = table.find("energy");
  chart.field = {{"columns", n},
                 {"rows", n},
                 {"values", std::move(values)},
                 {"levels", std::move(levels)},
                 {"title", energy ? table.title(*energy) : "energy"}};
  chart.series = strip_paths(folder, run, high);
  return chart;
}

void add_energy(Page& page, const Folder& folder, const Order& order) {
  const auto table = folder.table("energy.csv");
  if (!table) return;
  constexpr std::size_t most = 4;
  auto groups = table->groups("run");
  std::stable_sort(groups.begin(), groups.end(),
                   [&](const auto& a, const auto& b) { return order.place(a.first) < order.place(b.first); });
  page.begin_pair();
  std::size_t made = 0;
  std::vector<std::string> models;  // one run a model: others of the same model look much alike
  for (const auto& [run, rows] : groups) {
    const std::size_t place = order.place(run);
    const std::string model = place < order.runs().size() ? order.runs()[place].model : run;
    const std::string key = place < order.runs().size() ? model + run.substr(order.runs()[place].label.size()) : run;
    if (made >= most || std::find(models.begin(), models.end(), key) != models.end()) continue;
    models.push_back(key);
    Chart chart = energy_chart(folder, *table, run, rows);
    if (chart.empty()) continue;
    page.chart(chart, folder.address());
    ++made;
  }
  page.end_pair();
  if (made < groups.size())
    page.paragraph(fmt::format("The best run of each model, {} of {} runs; energy.csv has all.", made, groups.size()),
                   "muted");
}

void add_map(Page& page, const Folder& folder, const std::string& file) {
  const auto table = folder.table(file);
  if (!table || table->columns().size() < 4 || !table->find("worst_slope")) return;
  Chart chart;
  chart.kind = "heat";
  chart.numeric = true;
  const auto across = table->groups(table->columns()[0].name), along = table->groups(table->columns()[1].name);
  chart.id = file.substr(0, file.size() - 4);
  chart.title = "Stability over two parameters";
  chart.about = "Largest slope of ln λ3 over ln stretch in free strips; above zero the material is unstable";
  chart.note =
      "Above zero, the middle of the colours, the material is unstable; what lies far above shares the last colour. " +
      file.substr(0, file.size() - 4);
  chart.x.title = table->title(0);
  chart.y.title = table->title(1);
  chart.files = {file};
  chart.legend_title = "worst slope";
  std::map<std::string, std::size_t> column;
  for (const auto& entry : across) column.emplace(entry.first, column.size());
  for (const auto& entry : across) chart.columns.push_back(figure(table->number(entry.second.front(), 0)));
  double low = INFINITY, high = -INFINITY;
  for (auto entry = along.rbegin(); entry != along.rend(); ++entry) {
    chart.labels.push_back(figure(table->number(entry->second.front(), 1)));
    std::vector<double> line(across.size(), NAN);
    for (const std::size_t row : entry->second) {
      const double value = table->number(row, "worst_slope");
      line[column.at(table->text(row, std::size_t{0}))] = value;
      if (std::isfinite(value)) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
    chart.values.push_back(std::move(line));
  }
  if (low < high) {
    const double reach = std::max(std::abs(low), 0.05);
    chart.domain = {-reach, reach};
    page.chart(chart, folder.address());
  }
}

}  // namespace

void add_stability(Page& page, const Folder& folder, const Order& order) {
  const auto strips = folder.table("stability.csv");
  const auto maps = folder.tables("stability_map");
  if (!strips && maps.empty() && !folder.has("energy.csv")) return;
  page.section("Stability");
  std::vector<std::pair<std::string, std::string>> lines;
  for (std::size_t k = 0; k < order.runs().size(); ++k) {
    const auto& run = order.runs()[k];
    if (!order.shown(k)) continue;
    const Json& stability = member(member(*run.run, key::best), key::stability);
    std::string said = fmt::format("{}", fmt::join(words(list(stability, key::sentences)), "; "));
    for (const auto& [model, one] : member(stability, key::models).items())
      said += fmt::format("{}: {}. ", model, text::joined(words(list(one, key::sentences))));
    if (!said.empty()) lines.emplace_back(run.label, said);
  }
  page.words(lines);
  if (strips) add_strips(page, folder, order, *strips);
  for (const std::string& file : maps) add_map(page, folder, file);
  add_energy(page, folder, order);
}

}  // namespace tunica::report
