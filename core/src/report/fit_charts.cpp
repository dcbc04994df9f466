// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "report/lines.hpp"
#include "report/sections.hpp"

namespace tunica::report {

namespace {

/// The quantities that were prescribed: the columns before the first measured one. Time is one only where it is alone,
/// and the only one where the run draws over it.
std::vector<std::size_t> prescribed_columns(const Table& table, std::size_t first_measured, const std::string& own) {
  std::vector<std::size_t> columns;
  if (const auto time = table.find("time"); own == "time" && time) return {*time};
  for (std::size_t column = 1; column < first_measured; ++column)
    if (table.columns()[column].name != "time" || first_measured <= 2) columns.push_back(column);
  return columns.empty() ? std::vector<std::size_t>{1} : columns;
}

/// What the run says that a channel is drawn over; older results do not. The file name holds the test in short.
std::string own_abscissa(const Json& result, const std::string& test, const std::string& channel) {
  const auto same = [&](const std::string& name) {
    return std::equal(name.begin(), name.end(), test.begin(), test.end(), [](char of_name, char of_file) {
      return of_name == of_file || of_file == '-';  // see comparison::file_stem
    });
  };
  for (const Json& run : list(result, key::runs))
    for (const auto& [name, fit] : member(member(run, key::best), key::per_test).items())
      for (const Json& one : list(fit, key::channels))
        if (same(name) && word(one, key::channel) == channel) return word(one, key::over);
  return "";
}

/// One observable of one test, and where its table has what about it.
struct Channel {
  const Table& table;
  std::string test;
  std::size_t over = 1, measured, predicted;
  std::vector<std::string> curves;  ///< one a row of a run; empty where they are one curve
  std::optional<std::size_t> ci95, lowest, highest, posterior_low, posterior_high, measured_low, measured_high;

  Channel(const Table& of, std::string name, const std::vector<std::size_t>& prescribed, std::size_t column,
          std::size_t fit, const std::string& own)
      : table(of), test(std::move(name)), measured(column), predicted(fit) {
    const std::string& observable = table.columns()[measured].name;
    ci95 = table.find(observable + ".ci95");
    lowest = table.find(observable + ".lowest");
    highest = table.find(observable + ".highest");
    posterior_low = table.find(observable + ".posterior_low");
    posterior_high = table.find(observable + ".posterior_high");
    measured_low = table.find(observable + ".measured_low");
    measured_high = table.find(observable + ".measured_high");
    const std::vector<std::size_t> rows = table.groups("run").front().second;
    std::vector<data::Prescribed> quantities;
    for (const std::size_t k : prescribed) {
      auto& quantity =
          quantities.emplace_back(data::Prescribed{table.columns()[k].name, table.columns()[k].unit.value_or(""), {}});
      for (const std::size_t row : rows) quantity.values.push_back(table.number(row, k));
    }
    data::Abscissa chosen = data::abscissa_of(quantities, own);
    over = prescribed[chosen.column];
    curves = std::move(chosen.curves);
  }

  /// A series with one value a row.
  [[nodiscard]] Series along(const std::vector<std::size_t>& rows, Series series) const {
    for (const std::size_t row : rows) {
      series.x.push_back(table.number(row, over));
      series.y.push_back(NAN);
    }
    return series;
  }

  [[nodiscard]] std::vector<data::Line> lines(const std::vector<std::size_t>& rows) const {
    std::vector<double> x;
    for (const std::size_t row : rows) x.push_back(table.number(row, over));
    return data::lines_of(x, curves.size() == x.size() ? curves : std::vector<std::string>{});
  }
};

std::string thinning_note(std::size_t left_out) {
  return left_out == 0 ? ""
                       : fmt::format("Of each long curve {} points are drawn that keep its peaks; the table has all. ",
                                     most_points);
}

/// Adds the lines of a series to a chart; returns how many points that leaves out.
std::size_t add_lines(Chart& chart, const Series& whole, const std::vector<data::Line>& lines) {
  std::size_t left_out = 0;
  for (Series& part : by_line(whole, lines, most_points, left_out)) chart.series.push_back(std::move(part));
  return left_out;
}

/// The measured values, with held-out values shown separately.
std::size_t add_measured(Chart& chart, const Channel& channel, const std::vector<std::size_t>& rows) {
  Series data = channel.along(rows, {"measured", "points", -1}),
         held = channel.along(rows, {"measured, held out", "points", 6});
  for (std::size_t k = 0; k < rows.size(); ++k)
    (channel.table.number(rows[k], "held_out") > 0 ? held : data).y[k] =
        channel.table.number(rows[k], channel.measured);
  const auto lines = channel.lines(rows);
  std::size_t left_out = add_lines(chart, data, lines) + add_lines(chart, held, lines);
  chart.note += tag(chart.series);
  return left_out;
}

/// The curve with its interval, by the posterior where there is one. Before it the range of the realisations, and where
/// measurements lie by the posterior.
std::size_t add_curve(Chart& chart, const Channel& channel, const std::vector<std::size_t>& rows, Series curve) {
  Series range{curve.name, "range", curve.style};
  Series measurements{curve.name + ", measurements", "band", curve.style};
  range.hidden = measurements.hidden = curve.hidden;
  bool interval = false, spread = false, predicted = false;
  for (const std::size_t row : rows) {
    const auto at = [&](const std::optional<std::size_t>& column) {
      return column ? channel.table.number(row, *column) : NAN;
    };
    const double x = channel.table.number(row, channel.over), y = channel.table.number(row, channel.predicted);
    const double half = at(channel.ci95), low = at(channel.lowest), high = at(channel.highest);
    curve.x.push_back(x);
    curve.y.push_back(y);
    const double below = at(channel.posterior_low), above = at(channel.posterior_high);
    curve.low.push_back(std::isfinite(below) ? below : y - half);
    curve.high.push_back(std::isfinite(above) ? above : y + half);
    measurements.x.push_back(x);
    measurements.y.push_back(y);
    measurements.low.push_back(at(channel.measured_low));
    measurements.high.push_back(at(channel.measured_high));
    predicted |= std::isfinite(measurements.low.back());
    range.x.push_back(x);
    range.y.push_back(y);
    range.low.push_back(low);
    range.high.push_back(high);
    interval |= std::isfinite(half) || std::isfinite(below);
    spread |= high > low;
  }
  if (!interval) {
    curve.low.clear();
    curve.high.clear();
  }
  const auto lines = channel.lines(rows);
  std::size_t left_out = spread ? add_lines(chart, range, lines) : 0;
  if (predicted) left_out += add_lines(chart, measurements, lines);
  return left_out + add_lines(chart, curve, lines);
}

std::string bands_note(const Chart& chart) {
  const auto any = [&](auto condition) { return std::any_of(chart.series.begin(), chart.series.end(), condition); };
  std::string text;
  if (any([](const Series& series) { return series.mark == "line" && !series.low.empty(); }))
    text += "Shaded: where the noise of the data leaves the fitted curve, 95 %. ";
  if (any([](const Series& series) { return series.mark == "range"; }))
    text += "Thin lines: lowest and highest over the realisations. ";
  if (any([](const Series& series) { return series.mark == "band"; }))
    text += "Both by the posterior: the curve, and in the wide band 95 % of measurements. ";
  return text;
}

/// Measured and predicted values, with the residuals beside them.
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
    Series errors = channel.along(*rows, curve);
    errors.mark = "both";
    for (std::size_t k = 0; k < rows->size(); ++k)
      errors.y[k] = table.number((*rows)[k], channel.measured) - table.number((*rows)[k], channel.predicted);
    left_out += add_lines(rest, errors, channel.lines(*rows)) + add_curve(fit, channel, *rows, std::move(curve));
  }
  rest.legend = true;
  rest.note = hidden_note(groups.size()) + thinning_note(left_out);
  fit.note += bands_note(fit) + rest.note;
  page.begin_pair();
  page.chart(fit, folder.address());
  page.chart(rest, folder.address());
  page.end_pair();
}

/// How well the best run of every group fits and predicts, where there are more curves than the summary names.
void add_quality(Page& page, const Order& order) {
  for (const auto& run : order.runs()) {
    if (run.rank != 1) continue;
    std::vector<std::vector<Cell>> rows;
    const Json& tests = member(member(*run.run, key::best), key::per_test);
    for (const auto& [test, fit] : tests.items())
      for (const Json& channel : list(fit, key::channels)) {
        const bool held = member(channel, key::held_out) == true;
        const std::string r2 = figure(number(channel, key::r2)),
                          rmse = amount(number(channel, key::rmse), word(channel, key::unit));
        const bool bad = number(channel, key::r2) < 0;  // worse than the mean of the data
        rows.push_back({{test},
                        {word(channel, key::channel)},
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
    if (add_field(page, folder, order, *table, test)) continue;
    std::vector<std::size_t> prescribed;
    for (std::size_t k = 2; k < table->columns().size(); ++k)
      if (const auto predicted = table->find(table->columns()[k].name + ".predicted")) {
        const std::string own = own_abscissa(folder.result(), test, table->columns()[k].name);
        if (prescribed.empty()) prescribed = prescribed_columns(*table, k, own);
        add_channel(page, folder, order, {*table, test, prescribed, k, *predicted, own});
      }
  }
}

}  // namespace tunica::report
