// SPDX-License-Identifier: Apache-2.0
#include "report/data_page.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "data/curves.hpp"
#include "report/lines.hpp"
#include "report/page.hpp"
#include "text/units.hpp"

namespace tunica::report {

namespace {

constexpr std::size_t points_drawn = 800;

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : fmt::format("{} [{}]", name, unit);
}

/// The rows of the least and the largest value of as many stretches of rows as are drawn, in their order.
std::vector<std::size_t> peaks_kept(const std::vector<double>& values) {
  const std::size_t step = std::max<std::size_t>(1, 2 * values.size() / points_drawn);
  std::vector<std::size_t> rows;
  for (std::size_t begin = 0; begin < values.size(); begin += step) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = values.begin() + static_cast<std::ptrdiff_t>(std::min(begin + step, values.size()));
    const auto [low, high] = std::minmax_element(first, last);
    const auto one = static_cast<std::size_t>(std::min(low, high) - values.begin());
    const auto other = static_cast<std::size_t>(std::max(low, high) - values.begin());
    rows.push_back(one);
    if (other != one) rows.push_back(other);
  }
  return rows;
}

/// A column of the file over time, overlaid by the rows that the test uses.
Chart signal_chart(const TestData& test, const data::Signal& signal, std::size_t column) {
  const data::Signal::Column& values = signal.columns[column];
  Chart chart;
  chart.id = fmt::format("{}_signal_{}", test.name, column + 1);
  chart.title = fmt::format("{}: {} as the file has it", test.name, values.title);
  chart.about = fmt::format("{} over {} in {}", values.title, signal.clock.title, signal.file.filename().string());
  chart.x.title = signal.clock.title;
  chart.y.title = values.title;
  chart.legend = true;
  chart.low_height = true;
  const auto used = static_cast<std::size_t>(std::count(signal.used.begin(), signal.used.end(), true));
  chart.note = fmt::format("{}: {} of {} rows are used.", signal.file.filename().string(), used, signal.used.size());
  Series all{"in the file", "line", 1}, kept{"used", "points", 0};
  for (const std::size_t row : peaks_kept(values.values)) {
    all.x.push_back(signal.clock.values[row]);
    all.y.push_back(values.values[row]);
  }
  const std::size_t step = std::max<std::size_t>(1, used / points_drawn);
  std::size_t seen = 0;
  for (std::size_t row = 0; row < signal.used.size(); ++row) {
    if (!signal.used[row] || seen++ % step != 0) continue;
    kept.x.push_back(signal.clock.values[row]);
    kept.y.push_back(values.values[row]);
  }
  chart.series = {std::move(all), std::move(kept)};
  return chart;
}

/// A channel over the abscissa that reports draw it over.
Chart curve_chart(const TestData& test, const data::Channel& channel) {
  const data::Dataset& dataset = test.dataset;
  const auto unit_of = [&](const std::string& name) {
    for (const auto& [observable, unit] : test.units)
      if (observable == name) return unit;
    return std::string();
  };
  std::vector<data::Prescribed> prescribed;
  for (const auto& [name, values] : dataset.abscissae) prescribed.push_back({name, unit_of(name), values});
  Chart chart;
  chart.id = test.name + "_" + channel.observable;
  chart.title = fmt::format("{}: the curve that is fitted", test.name);
  chart.y.title = with_unit(channel.observable, channel.unit);
  Series curve{channel.observable, "both", -1};
  std::vector<double> x;
  if (data::is_over_time(prescribed, dataset.time)) {
    chart.x.title = with_unit("time", "s");
    x = dataset.time;
  } else if (prescribed.empty()) {
    chart.x.title = "row";
    for (std::size_t row = 0; row < dataset.count; ++row) x.push_back(static_cast<double>(row));
  } else {
    const data::Abscissa chosen = data::abscissa_of(prescribed, "");
    chart.x.title = with_unit(prescribed[chosen.column].name, prescribed[chosen.column].unit);
    x = prescribed[chosen.column].values;
  }
  curve.x = x;
  curve.y = channel.values;
  chart.about = fmt::format("{} over {}", chart.y.title, chart.x.title);
  std::size_t left_out = 0;
  const auto lines = data::lines_of(x, {});
  for (Series& part : by_line(curve, lines, points_drawn, left_out)) chart.series.push_back(std::move(part));
  chart.note = fmt::format("{} rows.", dataset.count);
  return chart;
}

}  // namespace

std::string data_page(const std::string& title, const std::vector<TestData>& tests) {
  Page page(title + ": data");
  for (const TestData& test : tests) {
    page.section(test.name);
    std::vector<std::string> warnings;
    for (const data::Finding& finding : test.dataset.findings) warnings.push_back(finding.text);
    warnings.insert(warnings.end(), test.dataset.warnings.begin(), test.dataset.warnings.end());
    if (!warnings.empty()) page.box("bad", warnings.size() == 1 ? "Warning" : "Warnings", warnings);
    page.paragraph(test.words);
    for (const std::string& line : test.dataset.understood) page.paragraph(line);
    page.begin_pair();
    for (const data::Signal& signal : test.signals)
      for (std::size_t column = 0; column < signal.columns.size(); ++column)
        page.chart(signal_chart(test, signal, column));
    for (const data::Channel& channel : test.dataset.channels) page.chart(curve_chart(test, channel));
    page.end_pair();
  }
  return page.document();
}

}  // namespace tunica::report
