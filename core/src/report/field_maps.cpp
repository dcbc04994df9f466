// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "report/sections.hpp"

namespace tunica::report {
namespace {

constexpr std::size_t most_squares = 2500;
constexpr double microns = 1000;  ///< a mm

/// The rows of one run: points of its steps, and forces of its steps.
struct Field {
  const Table& table;
  std::string test, run;
  std::vector<std::size_t> rows;

  [[nodiscard]] double value(std::size_t row, const std::string& column) const { return table.number(row, column); }
  [[nodiscard]] std::map<double, std::vector<std::size_t>> steps() const {
    std::map<double, std::vector<std::size_t>> found;
    for (const std::size_t row : rows)
      if (std::isfinite(value(row, "x"))) found[value(row, "step")].push_back(row);
    return found;
  }
  [[nodiscard]] double rest(std::size_t row, const std::string& channel) const {
    return value(row, channel) - value(row, channel + ".predicted");
  }
  [[nodiscard]] double rms(const std::vector<std::size_t>& of, const std::string& channel) const {
    double sum = 0;
    std::size_t count = 0;
    for (const std::size_t row : of)
      if (const double r = rest(row, channel); std::isfinite(r)) {
        sum += r * r;
        ++count;
      }
    return count == 0 ? NAN : std::sqrt(sum / static_cast<double>(count));
  }
};

/// Squares that tile the box around the points, each with the mean of the values of its points.
Json squares(const std::vector<std::array<double, 3>>& points, const std::string& title, Chart& chart) {
  std::array<double, 4> box{1e300, -1e300, 1e300, -1e300};
  for (const auto& point : points)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      box[2 * axis] = std::min(box[2 * axis], point[axis]);
      box[2 * axis + 1] = std::max(box[2 * axis + 1], point[axis]);
    }
  const double width = std::max(box[1] - box[0], 1e-12), height = std::max(box[3] - box[2], 1e-12);
  const double wanted = static_cast<double>(std::clamp<std::size_t>(points.size() / 2, 1, most_squares));
  const double side = std::max(std::sqrt(width * height / wanted), std::max(width, height) / 400);
  std::map<std::pair<long, long>, std::pair<double, int>> sums;
  for (const auto& [x, y, value] : points) {
    auto& [sum, count] = sums[{std::lround((x - box[0]) / side), std::lround((y - box[2]) / side)}];
    sum += value;
    ++count;
  }
  Json corners = Json::array(), cells = Json::array(), values = Json::array();
  for (const auto& [at, sum] : sums) {
    // The square lies around its places.
    const double x = box[0] + side * (static_cast<double>(at.first) - 0.5),
                 y = box[2] + side * (static_cast<double>(at.second) - 0.5);
    for (const auto& [right, up] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      cells.push_back(corners.size() / 2);
      corners.push_back(short_number(x + right * side));
      corners.push_back(short_number(y + up * side));
    }
    values.push_back(short_number(sum.first / sum.second));
  }
  chart.x = {"x [mm]", false, {}, {{box[0] - side, box[1] + side}}};
  chart.y = {"y [mm]", false, {}, {{box[2] - side, box[3] + side}}};
  return {{"points", std::move(corners)}, {"cells", std::move(cells)}, {"values", std::move(values)}, {"title", title}};
}

Chart map_of(const Field& field, double step, const std::vector<std::size_t>& rows, const std::string& channel,
             bool rest) {
  Chart chart;
  chart.kind = "mesh";
  chart.id = fmt::format("map_{}_{}_{:g}{}", field.test, channel, step, rest ? "_residuals" : "");
  chart.title = fmt::format("{}: {}{} at step {:g}", field.test, channel, rest ? ", measured − predicted," : "", step);
  chart.about = fmt::format("{} of {} over the unloaded specimen at step {:g}",
                            rest ? "Measured minus predicted" : "Measured values", channel, step);
  chart.files = {field.table.file_name()};
  std::vector<std::array<double, 3>> points;
  for (const std::size_t row : rows) {
    const double shown = rest ? microns * field.rest(row, channel) : field.value(row, channel);
    if (std::isfinite(shown)) points.push_back({field.value(row, "x"), field.value(row, "y"), shown});
  }
  if (points.empty()) return chart;
  chart.mesh = squares(points, rest ? "µm" : "mm", chart);
  chart.note = fmt::format("{} points, run {}. A square shows the mean of its points.", points.size(), field.run);
  return chart;
}

/// How far each step is missed, and where most.
void add_steps(Page& page, const Field& field, const std::vector<std::string>& channels) {
  std::vector<std::vector<Cell>> rows;
  for (const auto& [step, of] : field.steps())
    for (const std::string& channel : channels) {
      if (!std::isfinite(field.rms(of, channel))) continue;  // not measured in this step
      const auto worst = std::ranges::max_element(of, {}, [&](std::size_t row) {
        const double r = field.rest(row, channel);
        return std::isfinite(r) ? std::abs(r) : -1;
      });
      rows.push_back({{figure(step)},
                      {channel},
                      {amount(microns * field.rms(of, channel), "µm"), true},
                      {amount(microns * field.rest(*worst, channel), "µm"), true},
                      {fmt::format("({}, {})", figure(field.value(*worst, "x")), figure(field.value(*worst, "y")))}});
    }
  page.html(table_html({"step", "displacement", "RMS of what is left", "largest", "at x, y [mm]"}, rows));
}

Chart forces(const Table& table, const Order& order, const std::string& test, const std::string& channel) {
  Chart chart;
  const auto column = table.find(channel);
  chart.id = fmt::format("{}_{}", test, channel);
  chart.title = fmt::format("{}: {}", test, channel);
  chart.about = fmt::format("{} over the steps, measured and as each run predicts it", channel);
  chart.x.title = "step";
  chart.y.title = table.title(*column);
  chart.files = {table.file_name()};
  const auto values = [&](const std::vector<std::size_t>& rows, const std::string& name, Series series) {
    std::map<double, double> of_steps;
    for (const std::size_t row : rows)
      if (std::isfinite(table.number(row, channel))) of_steps[table.number(row, "step")] = table.number(row, name);
    for (const auto& [step, value] : of_steps) {
      series.x.push_back(step);
      series.y.push_back(value);
    }
    return series;
  };
  for (const auto& [run, rows] : table.groups("run")) {
    if (chart.series.empty()) chart.series.push_back(values(rows, channel, {"measured", "points", -1}));
    Series curve{run, "line", static_cast<int>(order.place(run))};
    curve.hidden = chart.series.size() > shown_runs;
    chart.series.push_back(values(rows, channel + ".predicted", std::move(curve)));
  }
  chart.legend = true;
  return chart;
}

}  // namespace

bool add_field(Page& page, const Folder& folder, const Order& order, const Table& table, const std::string& test) {
  if (!table.find("step") || !table.find("x") || !table.find("y")) return false;
  std::vector<std::string> displacements, others;
  for (const auto& column : table.columns())
    if (table.find(column.name + ".predicted"))
      (column.name == "ux" || column.name == "uy" ? displacements : others).push_back(column.name);
  const auto groups = table.groups("run");
  if (displacements.empty() || groups.empty()) return false;
  const auto best = std::ranges::min_element(groups, {}, [&](const auto& group) { return order.place(group.first); });
  const Field field{table, test, best->first, best->second};
  const auto steps = field.steps();
  if (steps.empty()) return false;
  page.heading(fmt::format("{}: the measured field and what {} leaves of it", test, field.run));
  add_steps(page, field, displacements);
  const auto worst = std::ranges::max_element(steps, {}, [&](const auto& step) {
    double sum = 0;
    for (const std::string& channel : displacements)
      if (const double rms = field.rms(step.second, channel); std::isfinite(rms)) sum += rms;
    return sum;
  });
  const auto last = std::prev(steps.end());
  page.begin_pair();
  for (const auto& shown : worst->first == last->first ? std::vector{last} : std::vector{last, worst})
    for (const std::string& channel : displacements)
      for (const bool rest : {false, true})
        page.chart(map_of(field, shown->first, shown->second, channel, rest), folder.address());
  for (const std::string& channel : others) page.chart(forces(table, order, test, channel), folder.address());
  page.end_pair();
  return true;
}

}  // namespace tunica::report
