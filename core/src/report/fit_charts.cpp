// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "report/sections.hpp"
#include "report/thinning.hpp"

namespace tunica::report {

namespace {

constexpr std::size_t most_points = 400;

/// The column that a test sweeps: of those before the first measured one, which are the prescribed quantities, the one
/// that wanders least on its way through its range. A pressure that was to be held still shows its noise.
std::size_t swept(const Table& table, const std::vector<std::size_t>& rows, std::size_t first_measured) {
  std::size_t best = 1;
  double least = INFINITY;
  for (std::size_t column = 1; column < first_measured; ++column) {
    if (table.columns()[column].name == "time" && first_measured > 2) continue;
    double low = INFINITY, high = -INFINITY, way = 0, last = NAN;
    for (const std::size_t row : rows) {
      const double value = table.number(row, column);
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
      way += std::isfinite(last) ? std::abs(value - last) : 0;
      last = value;
    }
    const double range = high - low, size = std::max(std::abs(low), std::abs(high));
    if (!(range > 1e-3 * size) || way / range > least / 1.5) continue;
    best = column;
    least = way / range;
  }
  return best;
}

/// One observable of one test, and where its table has what about it.
struct Channel {
  const Table& table;
  std::string test;
  std::size_t over, measured, predicted;
  std::optional<std::size_t> ci95, lowest, highest;

  Channel(const Table& of, std::string name, std::size_t abscissa, std::size_t column, std::size_t fit)
      : table(of), test(std::move(name)), over(abscissa), measured(column), predicted(fit) {
    const std::string& observable = table.columns()[measured].name;
    ci95 = table.find(observable + ".ci95");
    lowest = table.find(observable + ".lowest");
    highest = table.find(observable + ".highest");
  }
};

/// Keeps what the thinned curve keeps of everything beside it.
std::size_t thin(Series& series) {
  const auto kept = shape_keeping(series.y, most_points);
  const std::size_t left_out = series.y.size() - kept.size();
  for (auto* values : {&series.x, &series.y, &series.low, &series.high}) {
    if (values->empty()) continue;
    std::vector<double> few;
    for (const std::size_t i : kept) few.push_back((*values)[i]);
    *values = std::move(few);
  }
  return left_out;
}

std::string thinning_note(std::size_t left_out) {
  return left_out == 0 ? ""
                       : fmt::format("Of each long curve {} points are drawn that keep its peaks; the table has all. ",
                                     most_points);
}

/// What was measured, and apart from it what was held out.
std::size_t add_measured(Chart& chart, const Channel& channel, const std::vector<std::size_t>& rows) {
  Series data{"measured", "points", -1}, held{"measured, held out", "points", 6};
  for (const std::size_t row : rows) {
    Series& series = channel.table.number(row, "held_out") > 0 ? held : data;
    series.x.push_back(channel.table.number(row, channel.over));
    series.y.push_back(channel.table.number(row, channel.measured));
  }
  std::size_t left_out = 0;
  for (Series* series : {&data, &held}) {
    left_out += thin(*series);
    if (!series->x.empty()) chart.series.push_back(std::move(*series));
  }
  return left_out;
}

/// The curve with its interval, and before it the range of the realisations.
std::size_t add_curve(Chart& chart, const Channel& channel, const std::vector<std::size_t>& rows, Series curve) {
  Series range{curve.name, "range", curve.style};
  range.hidden = curve.hidden;
  bool interval = false, spread = false;
  for (const std::size_t row : rows) {
    const auto at = [&](const std::optional<std::size_t>& column) {
      return column ? channel.table.number(row, *column) : NAN;
    };
    const double x = channel.table.number(row, channel.over), y = channel.table.number(row, channel.predicted);
    const double half = at(channel.ci95), low = at(channel.lowest), high = at(channel.highest);
    curve.x.push_back(x);
    curve.y.push_back(y);
    curve.low.push_back(y - half);
    curve.high.push_back(y + half);
    range.x.push_back(x);
    range.y.push_back(y);
    range.low.push_back(low);
    range.high.push_back(high);
    interval |= std::isfinite(half);
    spread |= high > low;
  }
  if (!interval) {
    curve.low.clear();
    curve.high.clear();
  }
  std::size_t left_out = thin(curve);
  if (spread) {
    left_out += thin(range);
    chart.series.push_back(std::move(range));
  }
  chart.series.push_back(std::move(curve));
  return left_out;
}

std::string bands_note(const Chart& chart) {
  const auto any = [&](auto condition) { return std::any_of(chart.series.begin(), chart.series.end(), condition); };
  std::string text;
  if (any([](const Series& series) { return series.mark == "line" && !series.low.empty(); }))
    text += "Shaded: where the noise of the data leaves the fitted curve, 95 %. ";
  if (any([](const Series& series) { return series.mark == "range"; }))
    text += "Thin lines: lowest and highest over the realisations. ";
  return text;
}

/// Measured and predicted, and beside it what is left between them.
void add_channel(Page& page, const Folder& folder, const Order& order, const Channel& channel) {
  const Table& table = channel.table;
  const std::string what = table.title(channel.measured), over = table.title(channel.over);
  const std::string label = fmt::format("{}: {}", channel.test, table.columns()[channel.measured].name);
  Chart fit, rest;
  fit.id = table.file_name().substr(0, table.file_name().size() - 4) + '_' + table.columns()[channel.measured].name;
  fit.title = label;
  fit.about = fmt::format("{} over {}, measured and as each run predicts it", what, over);
  fit.x.title = rest.x.title = over;
  fit.y.title = what;
  fit.files = rest.files = {table.file_name()};
  rest.id = fit.id + "_residuals";
  rest.title = label + ", residuals";
  rest.about = fmt::format("Measured minus predicted {} over {} for each run", what, over);
  rest.y = {"measured − predicted, " + what, false, {0}, {}};
  rest.rule(0, "");
  const auto groups = table.groups("run");
  std::size_t left_out = 0, drawn = 0;
  std::vector<std::pair<std::size_t, const std::vector<std::size_t>*>> sorted;
  for (const auto& [run, rows] : groups) sorted.emplace_back(order.place(run), &rows);
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [place, rows] : sorted) {
    if (drawn == 0) left_out += add_measured(fit, channel, *rows);
    const bool hidden = drawn++ >= shown_runs;
    Series curve{table.text(rows->front(), "run"), "line", static_cast<int>(place), {}, {}, {}, {}, hidden};
    Series errors = curve;
    errors.mark = "both";
    for (const std::size_t row : *rows) {
      errors.x.push_back(table.number(row, channel.over));
      errors.y.push_back(table.number(row, channel.measured) - table.number(row, channel.predicted));
    }
    left_out += thin(errors) + add_curve(fit, channel, *rows, std::move(curve));
    rest.series.push_back(std::move(errors));
  }
  rest.legend = true;
  rest.note = hidden_note(groups.size()) + thinning_note(left_out);
  fit.note = bands_note(fit) + rest.note;
  page.begin_pair();
  page.chart(std::move(fit), folder.address());
  page.chart(std::move(rest), folder.address());
  page.end_pair();
}

/// How well the best run of every group fits and predicts, where there are more curves than the summary names.
void add_quality(Page& page, const Order& order) {
  for (const auto& run : order.runs()) {
    if (run.rank != 1) continue;
    std::vector<std::vector<Cell>> rows;
    const Json& tests = member(member(*run.run, "best"), "per_test");
    for (const auto& [test, fit] : tests.items())
      for (const Json& channel : list(fit, "channels")) {
        const bool held = member(channel, "held_out") == true;
        const std::string r2 = figure(number(channel, "r2")),
                          rmse = amount(number(channel, "rmse"), word(channel, "unit"));
        const bool bad = number(channel, "r2") < 0;  // worse than the mean of the data
        rows.push_back({{test},
                        {word(channel, "channel")},
                        {held ? "" : r2, true, bad},
                        {held ? "" : rmse, true},
                        {held ? r2 : "", true, bad},
                        {held ? rmse : "", true}});
      }
    if (rows.size() <= 3) continue;
    page.heading("How well " + run.label + " fits");
    page.html(table_html({"test", "curve", "R², fitted", "RMSE", "R², held out", "RMSE"}, rows));
  }
}

}  // namespace

void add_fits(Page& page, const Folder& folder, const Order& order) {
  bool begun = false;
  for (const std::string& file : folder.tables("fit_")) {
    const auto table = folder.table(file);
    if (!table || table->columns().size() < 3) continue;
    if (!std::exchange(begun, true)) {
      page.section("Data and fit");
      add_quality(page, order);
    }
    const std::string test = file.substr(4, file.size() - 8);
    std::size_t over = 0;
    for (std::size_t k = 2; k < table->columns().size(); ++k)
      if (const auto predicted = table->find(table->columns()[k].name + ".predicted")) {
        if (over == 0) over = swept(*table, table->groups("run").front().second, k);
        add_channel(page, folder, order, {*table, test, over, k, *predicted});
      }
  }
}

}  // namespace tunica::report
