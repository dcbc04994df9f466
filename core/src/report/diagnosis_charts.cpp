// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "report/diagnosis_pieces.hpp"
#include "report/lines.hpp"
#include "text/units.hpp"

namespace tunica::report {

namespace {

constexpr std::string_view signature = "signature_";

/// A column with one value a row; empty where the table has none.
Series along(const Table& table, const ResidualCurve& curve, std::string_view column, Series series) {
  const auto values = table.find(column);
  if (!values) return series;
  for (const std::size_t row : curve.rows) {
    series.x.push_back(table.number(row, "abscissa"));
    series.y.push_back(table.number(row, *values));
  }
  return series;
}

/// Adds the lines of a series, and to the note what was left out.
void add(Chart& chart, const ResidualCurve& curve, const Series& whole, std::size_t& left_out) {
  if (whole.x.empty()) return;
  for (Series& part : by_line(whole, curve.lines, most_points, left_out)) chart.series.push_back(std::move(part));
}

std::string note_of(std::size_t left_out) {
  return left_out == 0 ? "" : "Long curves are thinned, peaks kept; the table has all rows. ";
}

using Range = std::pair<double, double>;

Range range_of(const std::vector<double>& values) {
  Range range{INFINITY, -INFINITY};
  for (const double value : values)
    if (std::isfinite(value)) range = {std::min(range.first, value), std::max(range.second, value)};
  return range;
}

/// A signature may run far beyond the residuals that it is held against. Where it goes further beyond them than they
/// range, the axis ends a little beyond the residuals, and the words say how far the signature goes.
std::string cut_to_residuals(Chart& chart, Range residuals, const std::vector<std::pair<std::string, Range>>& lines) {
  constexpr double room = 0.25, margin = 0.04;  // of the range of the residuals
  const double span = residuals.second - residuals.first;
  const Range limits{residuals.first - span, residuals.second + span};
  std::string text;
  for (const auto& [cause, range] : lines)
    if (range.first < limits.first || range.second > limits.second)
      text += fmt::format("{} {} runs from {} to {} σ", text.empty() ? "Cut off: what" : ", what", cause,
                          figure(range.first), figure(range.second));
  if (text.empty()) return "";
  const auto reaches = [&](auto beyond) { return std::any_of(lines.begin(), lines.end(), beyond); };
  const bool below = reaches([&](const auto& line) { return line.second.first < residuals.first; });
  const bool above = reaches([&](const auto& line) { return line.second.second > residuals.second; });
  chart.y.range = {residuals.first - (below ? room : margin) * span, residuals.second + (above ? room : margin) * span};
  return text + ". ";
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
  std::size_t left_out = 0;
  const Series residual = along(table, curve, "residual", {"residual", "points", -1});
  add(chart, curve, residual, left_out);
  chart.note = (chart.bands.empty() ? "" : "Shaded: where the model misses the data. ") + tag(chart.series);
  std::vector<std::pair<std::string, Range>> signatures;
  int style = 0;
  for (const auto& column : table.columns()) {
    if (!column.name.starts_with(signature)) continue;
    const std::string cause = column.name.substr(signature.size());
    Series series = along(table, curve, column.text, {"what " + cause + " changes", "line", style});
    series.hidden = style++ >= 3;
    signatures.emplace_back(cause, range_of(series.y));
    add(chart, curve, series, left_out);
  }
  Series after = along(table, curve, "residual_extended", {"residual with the cause", "points", 2});
  after.hidden = true;
  add(chart, curve, after, left_out);
  std::vector<double> seen{-3, 3};
  seen.insert(seen.end(), residual.y.begin(), residual.y.end());
  seen.insert(seen.end(), after.y.begin(), after.y.end());
  chart.note += cut_to_residuals(chart, range_of(seen), signatures) + note_of(left_out);
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
  mark_misfit(chart, diagnosis, curve);
  std::size_t left_out = 0;
  Series band = along(table, curve, "measured", {"measured ± 2 σ", "bars", 6});
  const Series sigma = along(table, curve, "sigma", {"", "line", 0});
  if (sigma.x.size() == band.x.size() && range_of(sigma.y).second > 0) {
    for (std::size_t k = 0; k < band.y.size(); ++k) {
      band.low.push_back(band.y[k] - 2 * sigma.y[k]);
      band.high.push_back(band.y[k] + 2 * sigma.y[k]);
    }
    add(chart, curve, band, left_out);
  }
  const auto measured = static_cast<std::ptrdiff_t>(chart.series.size());
  add(chart, curve, along(table, curve, "measured", {"measured", "points", -1}), left_out);
  std::vector<Series> parts(chart.series.begin() + measured, chart.series.end());
  const std::string tags = tag(parts);
  std::move(parts.begin(), parts.end(), chart.series.begin() + measured);
  add(chart, curve, along(table, curve, "predicted", {"model as given", "line", 1}), left_out);
  add(chart, curve, along(table, curve, "extended", {"with the cause", "line", 0}), left_out);
  chart.note = tags + note_of(left_out);
  return chart;
}

/// The mechanisms that these data cannot show, whatever their amplitude.
std::set<std::string> absent_of(const Json& diagnosis) {
  std::set<std::string> ids;
  for (const Json& one : list(diagnosis, key::detectable))
    if (!word(one, key::absent).empty()) ids.insert(word(one, key::id));
  return ids;
}

void add_confusability(Page& page, const Folder& folder) {
  const auto table = folder.table("confusability.csv");
  if (!table || table->columns().size() < 2) return;
  Chart chart;
  chart.kind = "heat";
  chart.id = "confusability";
  chart.title = "Confusability of the candidates in these data";
  chart.about = "How alike the traces of two causes are, from 0 for unlike to 1 for the same";
  chart.note = "1: these data cannot tell the two apart. Only causes that would leave a trace in these data.";
  chart.legend_title = "likeness";
  chart.files = {table->file_name()};
  // Tables of older diagnoses list every mechanism.
  const std::set<std::string> absent = absent_of(member(folder.result(), key::diagnosis));
  std::vector<std::size_t> columns;
  for (std::size_t k = 1; k < table->columns().size(); ++k)
    if (absent.count(table->columns()[k].name) == 0) columns.push_back(k);
  if (columns.size() < 2) return;  // nothing to confuse it with
  for (const std::size_t k : columns) chart.columns.push_back(table->columns()[k].name);
  for (std::size_t row = 0; row < table->rows(); ++row) {
    if (absent.count(table->text(row, std::size_t{0})) > 0) continue;
    chart.labels.push_back(table->text(row, std::size_t{0}));
    std::vector<double> line;
    for (const std::size_t k : columns) line.push_back(table->number(row, k));
    chart.values.push_back(std::move(line));
  }
  page.chart(chart, folder.address());
}

/// "1 ± 0.4", "3.2 kPa"; in words where no plausible amplitude is so large.
std::string least_amplitude(const Json& one, results::Key of) {
  const double distance = number(one, of), null = number(one, key::null), reach = number(one, key::reach);
  if (std::isfinite(reach) && distance > reach) return "beyond what is plausible";
  const std::string text = amount(distance, word(one, key::unit));
  return std::isfinite(distance) && std::isfinite(null) && null != 0 ? figure(null) + " ± " + text : text;
}

}  // namespace

std::vector<ResidualCurve> residual_curves(const Table& table) {
  std::vector<ResidualCurve> curves;
  const std::string abscissa_name = table.find("abscissa_name") ? "abscissa_name" : "value";
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string &test = table.text(row, "test"), &channel = table.text(row, "channel");
    auto at = std::find_if(curves.begin(), curves.end(),
                           [&](const auto& curve) { return curve.test == test && curve.channel == channel; });
    if (at == curves.end())
      at = curves.insert(curves.end(), {test,
                                        channel,
                                        text::titled(table.text(row, abscissa_name), table.text(row, "abscissa_unit")),
                                        table.text(row, "unit"),
                                        {},
                                        {}});
    at->rows.push_back(row);
  }
  for (ResidualCurve& curve : curves) {
    std::vector<double> abscissa;
    std::vector<std::string> members;
    for (const std::size_t row : curve.rows) {
      abscissa.push_back(table.number(row, "abscissa"));
      members.push_back(table.text(row, "curve"));
    }
    curve.lines = data::lines_of(abscissa, members);
  }
  return curves;
}

void mark_misfit(Chart& chart, const Json& diagnosis, const ResidualCurve& curve) {
  for (const Json& misfit : list(diagnosis, key::misfit)) {
    const double from = number(misfit, key::from), to = number(misfit, key::to);
    if (word(misfit, key::test) == curve.test && word(misfit, key::channel) == curve.channel && std::isfinite(from) &&
        from <= to)
      chart.band(from, to);
  }
}

void add_misfit(Page& page, const Folder& folder) {
  const auto table = folder.table("residuals.csv");
  if (!table || !table->find("residual")) return;
  const Json& diagnosis = member(folder.result(), key::diagnosis);
  auto curves = residual_curves(*table);
  // Where something is wrong comes first, in the order of the verdict.
  const auto& misfits = list(diagnosis, key::misfit);
  const auto place = [&](const ResidualCurve& curve) {
    return std::find_if(misfits.begin(), misfits.end(),
                        [&](const Json& misfit) {
                          return word(misfit, key::test) == curve.test && word(misfit, key::channel) == curve.channel;
                        }) -
           misfits.begin();
  };
  std::stable_sort(curves.begin(), curves.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  const bool clean = misfits.empty() && word(diagnosis, key::verdict) == "nothing_detected";
  page.section(table->find("extended") ? "Before and after" : "Data and fit");
  page.begin_pair();
  for (const auto& curve : curves) page.chart(before_and_after(*table, diagnosis, curve), folder.address());
  page.end_pair();
  page.section(clean ? "What the fit leaves over" : "Where the simulation is wrong");
  page.begin_pair();
  for (const auto& curve : curves) page.chart(residual_chart(*table, diagnosis, curve), folder.address());
  page.end_pair();
}

void add_reach(Page& page, const Folder& folder) {
  const Json& diagnosis = member(folder.result(), key::diagnosis);
  page.section("Reach");
  std::vector<std::vector<Cell>> rows;
  std::vector<std::string> unseen;
  for (const Json& one : list(diagnosis, key::detectable)) {
    if (const std::string absent = word(one, key::absent); !absent.empty()) {
      unseen.push_back(word(one, key::id) + ": " + absent);
      continue;
    }
    rows.push_back({{word(one, key::id) + place_words(member(one, key::target))},
                    {least_amplitude(one, key::detectable), true},
                    {least_amplitude(one, key::identifiable), true},
                    {word(one, key::closest)},
                    {figure(number(one, key::correlation)), true}});
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
