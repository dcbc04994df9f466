// SPDX-License-Identifier: Apache-2.0
#include "report/chart.hpp"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace tunica::report {

namespace {

Json numbers(const std::vector<double>& values) {
  Json result = Json::array();
  for (const double value : values) result.push_back(short_number(value));
  return result;
}

Json axis_json(const Axis& axis) {
  Json result = {{"title", axis.title}};
  if (axis.log) result["log"] = true;
  if (!axis.include.empty()) result["include"] = numbers(axis.include);
  if (axis.range) result["domain"] = {axis.range->first, axis.range->second};
  return result;
}

Json series_json(const Series& series) {
  Json result = {{"name", series.name},
                 {"mark", series.mark},
                 {"style", series.style},
                 {"x", numbers(series.x)},
                 {"y", numbers(series.y)}};
  if (!series.low.empty()) {
    result["low"] = numbers(series.low);
    result["high"] = numbers(series.high);
  }
  if (series.hidden) result["hidden"] = true;
  if (series.faint) result["faint"] = true;
  if (!series.label.empty()) result["label"] = series.label;
  if (!series.tag.empty()) result["tag"] = series.tag;
  return result;
}

Json rows_json(const RowSeries& series) {
  Json rows = Json::array();
  for (const Row& row : series.rows) {
    Json one = {{"value", short_number(row.value)}, {"low", short_number(row.low)}, {"high", short_number(row.high)}};
    if (!row.note.empty()) one["note"] = row.note;
    rows.push_back(std::move(one));
  }
  return {{"name", series.name}, {"style", series.style}, {"rows", std::move(rows)}};
}

}  // namespace

Json short_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

void Chart::band(double from, double to, char axis) {
  bands.push_back({{"from", short_number(from)}, {"to", short_number(to)}, {"axis", std::string(1, axis)}});
}

void Chart::rule(double at, const std::string& label, char axis) {
  rules.push_back({{"at", short_number(at)}, {"label", label}, {"axis", std::string(1, axis)}});
}

bool Chart::empty() const {
  if (kind == "heat") return values.empty();
  if (kind == "mesh") return mesh.is_null();
  if (kind == "rows") return labels.empty() || rows.empty();
  for (const Series& one : series)
    if (!one.x.empty()) return false;
  return field.is_null();
}

Json Chart::json() const {
  Json result = {{"kind", kind}, {"id", id}, {"title", title}, {"about", about}};
  result["x"] = axis_json(x);
  result["y"] = axis_json(y);
  Json all = Json::array();
  for (const Series& one : series) all.push_back(series_json(one));
  for (const RowSeries& one : rows) all.push_back(rows_json(one));
  result["series"] = std::move(all);
  if (!bands.empty()) result["bands"] = bands;
  if (!rules.empty()) result["rules"] = rules;
  if (low_height) result["low"] = true;
  if (legend) result["legend"] = true;
  if (!labels.empty()) result["labels"] = labels;
  if (kind == "rows") result["bars"] = bars;
  if (kind == "heat") {
    Json lines = Json::array();
    for (const auto& line : values) lines.push_back(numbers(line));
    result["columns"] = columns;
    result["values"] = std::move(lines);
    result["legend"] = legend_title;
    result["domain"] = {domain.first, domain.second};
    result["numeric"] = numeric;
  }
  if (!field.is_null()) result["field"] = field;
  if (!mesh.is_null()) result["mesh"] = mesh;
  return result;
}

}  // namespace tunica::report
