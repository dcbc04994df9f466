// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "report/diagnosis_pieces.hpp"
#include "report/thinning.hpp"
#include "text/units.hpp"

namespace tunica::report {

namespace {

constexpr std::size_t most_points = 400;
constexpr std::string_view signature = "signature_";

std::string long_curve_note(const ResidualCurve& curve) {
  return curve.rows.size() <= most_points
             ? ""
             : fmt::format("{} of {} rows are drawn, peaks kept. ", most_points, curve.rows.size());
}

/// Residuals over the noise, the region of misfit, and what each candidate would leave.
Chart residual_chart(const Table& table, const Json& diagnosis, const ResidualCurve& curve) {
  Chart chart;
  chart.id = fmt::format("residuals_{}_{}", curve.test, curve.channel);
  chart.title = fmt::format("{}: {}", curve.test, curve.channel);
  chart.about = "Residuals in units of the noise over the abscissa, with what candidate causes change";
  chart.x.title = curve.abscissa;
  chart.y = {"residual / noise", false, {-3, 3}, {}};
  chart.files = {table.file_name()};
  chart.rule(0, "");
  chart.rule(2, "2 σ");
  chart.rule(-2, "");
  mark_misfit(chart, diagnosis, curve);
  chart.note = (chart.bands.empty() ? "" : "Shaded: where the model misses the data. ") + long_curve_note(curve);
  chart.series.push_back(curve_series(table, curve, "residual", "residual", "points", -1));
  int style = 0;
  for (const auto& column : table.columns()) {
    if (!column.name.starts_with(signature)) continue;
    Series series = curve_series(table, curve, column.text, "what " + column.name.substr(signature.size()) + " changes",
                                 "line", style);
    series.hidden = style++ >= 3;
    chart.series.push_back(std::move(series));
  }
  Series after = curve_series(table, curve, "residual_extended", "residual with the cause", "points", 2);
  after.hidden = true;
  if (!after.x.empty()) chart.series.push_back(std::move(after));
  return chart;
}

/// Data with their noise, the base model, the extended model.
Chart before_and_after(const Table& table, const Json& diagnosis, const ResidualCurve& curve) {
  Chart chart;
  chart.id = fmt::format("before_after_{}_{}", curve.test, curve.channel);
  chart.title = fmt::format("{}: {}", curve.test, curve.channel);
  chart.about = "Data, the model as given, and the model with the cause added";
  chart.x.title = curve.abscissa;
  chart.y.title = text::titled(curve.channel, curve.unit);
  chart.files = {table.file_name()};
  chart.note = long_curve_note(curve);
  mark_misfit(chart, diagnosis, curve);
  Series band = curve_series(table, curve, "measured", "measured ± 2 σ", "band", 6);
  const Series sigma = curve_series(table, curve, "sigma", "", "line", 0);
  if (sigma.x == band.x) {
    for (std::size_t k = 0; k < band.y.size(); ++k) {
      band.low.push_back(band.y[k] - 2 * sigma.y[k]);
      band.high.push_back(band.y[k] + 2 * sigma.y[k]);
    }
    chart.series.push_back(std::move(band));
  }
  chart.series.push_back(curve_series(table, curve, "measured", "measured", "points", -1));
  chart.series.push_back(curve_series(table, curve, "predicted", "model as given", "line", 1));
  Series extended = curve_series(table, curve, "extended", "with the cause", "line", 0);
  if (!extended.x.empty()) chart.series.push_back(std::move(extended));
  return chart;
}

void add_confusability(Page& page, const Folder& folder) {
  const auto table = folder.table("confusability.csv");
  if (!table || table->columns().size() < 2) return;
  Chart chart;
  chart.kind = "heat";
  chart.id = "confusability";
  chart.title = "Confusability of the candidates in these data";
  chart.about = "How alike the traces of two causes are, from 0 for unlike to 1 for the same";
  chart.note = "1: these data cannot tell the two apart.";
  chart.legend_title = "likeness";
  chart.files = {table->file_name()};
  for (std::size_t k = 1; k < table->columns().size(); ++k) chart.columns.push_back(table->columns()[k].name);
  for (std::size_t row = 0; row < table->rows(); ++row) {
    chart.labels.push_back(table->text(row, std::size_t{0}));
    std::vector<double> line;
    for (std::size_t k = 1; k < table->columns().size(); ++k) line.push_back(table->number(row, k));
    chart.values.push_back(std::move(line));
  }
  page.chart(std::move(chart), folder.address());
}

/// "1 ± 0.4", "3.2 kPa"; in words where no plausible amplitude is so large.
std::string least_amplitude(const Json& one, const char* key) {
  const double distance = number(one, key), null = number(one, "null"), reach = number(one, "reach");
  if (std::isfinite(reach) && distance > reach) return "beyond what is plausible";
  const std::string text = amount(distance, word(one, "unit"));
  return std::isfinite(distance) && std::isfinite(null) && null != 0 ? figure(null) + " ± " + text : text;
}

}  // namespace

std::vector<ResidualCurve> residual_curves(const Table& table) {
  std::vector<ResidualCurve> curves;
  const std::string abscissa_name = table.find("abscissa_name") ? "abscissa_name" : "value";
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string test = table.text(row, "test"), channel = table.text(row, "channel");
    auto at = std::find_if(curves.begin(), curves.end(),
                           [&](const auto& curve) { return curve.test == test && curve.channel == channel; });
    if (at == curves.end())
      at = curves.insert(curves.end(), {test,
                                        channel,
                                        text::titled(table.text(row, abscissa_name), table.text(row, "abscissa_unit")),
                                        table.text(row, "unit"),
                                        {}});
    at->rows.push_back(row);
  }
  return curves;
}

Series curve_series(const Table& table, const ResidualCurve& curve, std::string_view column, std::string name,
                    std::string mark, int style) {
  Series series{std::move(name), std::move(mark), style, {}, {}, {}, {}};
  const auto values = table.find(column);
  if (!values) return series;
  // The rows that are kept are those of the measured curve, the same for every column.
  std::vector<double> measured;
  for (const std::size_t row : curve.rows) measured.push_back(table.number(row, "measured"));
  for (const std::size_t k : shape_keeping(measured, most_points)) {
    const double y = table.number(curve.rows[k], *values);
    if (!std::isfinite(y)) continue;
    series.x.push_back(table.number(curve.rows[k], "abscissa"));
    series.y.push_back(y);
  }
  return series;
}

void mark_misfit(Chart& chart, const Json& diagnosis, const ResidualCurve& curve) {
  for (const Json& misfit : list(diagnosis, "misfit")) {
    const double from = number(misfit, "from"), to = number(misfit, "to");
    if (word(misfit, "test") == curve.test && word(misfit, "channel") == curve.channel && std::isfinite(from) &&
        from <= to)
      chart.band(from, to);
  }
}

void add_misfit(Page& page, const Folder& folder) {
  const auto table = folder.table("residuals.csv");
  if (!table || !table->find("residual")) return;
  const Json& diagnosis = member(folder.result(), "diagnosis");
  auto curves = residual_curves(*table);
  // Where something is wrong comes first, in the order of the verdict.
  const auto& misfits = list(diagnosis, "misfit");
  const auto place = [&](const ResidualCurve& curve) {
    return std::find_if(misfits.begin(), misfits.end(),
                        [&](const Json& misfit) {
                          return word(misfit, "test") == curve.test && word(misfit, "channel") == curve.channel;
                        }) -
           misfits.begin();
  };
  std::stable_sort(curves.begin(), curves.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  const bool clean = misfits.empty() && word(diagnosis, "verdict") == "nothing_detected";
  page.section(clean ? "What the fit leaves over" : "Where the simulation is wrong");
  page.begin_pair();
  for (const auto& curve : curves) page.chart(residual_chart(*table, diagnosis, curve), folder.address());
  page.end_pair();
  page.section(table->find("extended") ? "Before and after" : "Data and fit");
  page.begin_pair();
  for (const auto& curve : curves) page.chart(before_and_after(*table, diagnosis, curve), folder.address());
  page.end_pair();
}

void add_reach(Page& page, const Folder& folder) {
  const Json& diagnosis = member(folder.result(), "diagnosis");
  page.section("Reach");
  std::vector<std::vector<Cell>> rows;
  std::vector<std::string> unseen;
  for (const Json& one : list(diagnosis, "detectable")) {
    const std::string absent = word(one, "absent");
    rows.push_back({{word(one, "id") + place_words(member(one, "target"))},
                    {least_amplitude(one, "detectable"), true},
                    {least_amplitude(one, "identifiable"), true},
                    {word(one, "closest")},
                    {figure(number(one, "correlation")), true}});
    if (!absent.empty()) unseen.push_back(word(one, "id") + ": " + absent);
  }
  if (!rows.empty()) {
    page.heading("What these data would show");
    page.paragraph("The least amplitude of each cause that would be detected, and that would be told from the others.");
    page.html(table_html({"cause", "detected from", "told apart from", "most like", "likeness"}, rows));
  }
  if (!unseen.empty()) page.box("", "What these data cannot show", unseen);
  add_confusability(page, folder);
}

}  // namespace tunica::report
