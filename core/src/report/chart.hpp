// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

/// Charts as the page's script takes them: data and words, no drawing.
namespace tunica::report {

using Json = nlohmann::ordered_json;

/// A number as short as the eye needs (six digits), null where it is none.
Json short_number(double value);

struct Axis {
  std::string title;
  bool log = false;
  std::vector<double> include;                     ///< values the range must hold
  std::optional<std::pair<double, double>> range;  ///< exactly this, whatever the data
};

struct Series {
  std::string name;
  std::string mark;  ///< line, step, points, both (line and points), band (low to high), bars (a bar a point)
  int style = 0;     ///< colour, dash and symbol; -1 = as measured data
  std::vector<double> x = {}, y = {}, low = {}, high = {};
  bool hidden = false;     ///< switched off until someone asks for it
  bool faint = false;      ///< one of many
  std::string label = {};  ///< which of those of the same name; the legend switches them together
  std::string tag = {};    ///< written where the curve reaches its largest x
};

/// One category of a chart of rows: a value, an interval or both.
struct Row {
  double value, low, high;
  std::string note;  ///< instead of the value under the pointer
};

struct RowSeries {
  std::string name;
  int style = 0;
  std::vector<Row> rows;
};

struct Chart {
  std::string kind = "xy";  ///< xy, rows, heat, mesh
  std::string id, title, about;
  std::string note;                ///< under the title: what was left out, how to read it
  std::vector<std::string> files;  ///< tables beside the report with all of it
  Axis x, y;
  std::vector<Series> series;
  Json bands = Json::array(), rules = Json::array();
  bool low_height = false, legend = false;
  // kind rows and heat
  std::vector<std::string> labels, columns;
  std::vector<RowSeries> rows;
  bool bars = false;  ///< intervals are bars from zero
  std::vector<std::vector<double>> values;
  std::string legend_title;
  std::pair<double, double> domain{0, 1};
  bool numeric = false;  ///< categories are numbers along an axis
  Json field;            ///< a grid whose isocontours lie under the series, see specs.js
  Json mesh;             ///< kind mesh: points x, y; cells of four points in turn; a value of each; a title

  void band(double from, double to, char axis = 'x');
  void rule(double at, const std::string& label, char axis = 'y');
  [[nodiscard]] bool empty() const;
  [[nodiscard]] Json json() const;
};

}  // namespace tunica::report
