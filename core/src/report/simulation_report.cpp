// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "report/lines.hpp"
#include "report/sections.hpp"
#include "text/lists.hpp"

namespace tunica::report {

namespace {

/// Of which model at which parameters the curves are; older folders do not say.
void add_words(Page& page, const Folder& folder) {
  const Json& said = folder.result();
  if (word(said, key::model).empty()) return;
  page.section("Summary");
  if (const auto warnings = words(list(said, key::warnings)); !warnings.empty())
    page.box("bad", warnings.size() == 1 ? "Warning" : fmt::format("{} warnings", warnings.size()), warnings);
  std::vector<std::string> values;
  // Imperfections of a test at zero are not worth listing.
  for (const auto& [name, estimate] : member(said, key::parameters).items())
    if (name.find('.') == std::string::npos || number(estimate, key::value) != 0)
      values.push_back(fmt::format("{} = {}", name, amount(number(estimate, key::value), word(estimate, key::unit))));
  const std::string source = word(said, key::source);
  const double noise = number(said, key::noise);
  page.words({{"What was simulated",
               fmt::format("{} in {}", word(said, key::model), text::joined(words(list(said, key::tests))))},
              {"Parameters", text::joined(values)},
              {"Where from", source.empty() ? word(said, key::origin) : source},
              {"Noise",
               noise > 0 ? fmt::format("{:.3g} % of every value, seed {}", 100 * noise, figure(number(said, key::seed)))
                         : "none"},
              {"What to do next", "Lay it beside a calibration: tunica report DIR THIS_FOLDER -o FILE."}});
}

/// What a column is drawn over, and which rows are one curve: as the folder says. Older folders do not; their columns
/// are drawn over the first.
struct Over {
  std::size_t column = 0;
  std::vector<data::Line> lines;
};

Over over_of(const Json& record, const Table& table, const std::string& test, const std::string& column) {
  std::vector<double> x;
  Over drawn;
  std::vector<std::string> curves;
  for (const Json& one : list(record, key::curves)) {
    if (word(one, key::test) != test || word(one, key::column) != column) continue;
    const std::vector<std::string> prescribed = words(list(one, key::prescribed));
    if (const auto time = table.find(word(one, key::over));
        time && std::find(prescribed.begin(), prescribed.end(), word(one, key::over)) == prescribed.end()) {
      drawn.column = *time;
      continue;
    }
    std::vector<std::size_t> columns;
    std::vector<data::Prescribed> quantities;
    for (const std::string& name : prescribed)
      if (const auto k = table.find(name)) {
        columns.push_back(*k);
        auto& quantity = quantities.emplace_back(data::Prescribed{name, table.columns()[*k].unit.value_or(""), {}});
        for (std::size_t row = 0; row < table.rows(); ++row) quantity.values.push_back(table.number(row, *k));
      }
    if (quantities.empty()) continue;
    data::Abscissa chosen = data::abscissa_of(quantities, word(one, key::over));
    drawn.column = columns[chosen.column];
    curves = std::move(chosen.curves);
  }
  for (std::size_t row = 0; row < table.rows(); ++row) x.push_back(table.number(row, drawn.column));
  drawn.lines = data::lines_of(x, curves);
  return drawn;
}

/// The curves that lie over a prescribed quantity; each member of a family is a series of its own.
Chart predicted_chart(const Table& table, const std::string& test, std::size_t column, const Over& drawn) {
  Chart chart;
  chart.id = test + '_' + table.columns()[column].name;
  chart.title = test + ": " + table.columns()[column].name;
  chart.x.title = table.title(drawn.column);
  chart.y.title = table.title(column);
  chart.about = fmt::format("{} over {}", chart.y.title, chart.x.title);
  chart.files = {table.file_name()};
  Series whole{table.columns()[column].name, "line", 0};
  for (std::size_t row = 0; row < table.rows(); ++row) {
    whole.x.push_back(table.number(row, drawn.column));
    whole.y.push_back(table.number(row, column));
  }
  std::size_t left_out = 0;
  std::vector<std::string> members;
  for (Series& part : by_line(whole, drawn.lines, 600, left_out)) {
    if (!part.label.empty()) {
      auto at = std::find(members.begin(), members.end(), part.label);
      if (at == members.end()) at = members.insert(members.end(), part.label);
      part.style = static_cast<int>(at - members.begin());
      part.name = std::exchange(part.label, "");
    }
    chart.series.push_back(std::move(part));
  }
  if (left_out > 0)
    chart.note = fmt::format("{} of {} rows are drawn, peaks kept.", table.rows() - left_out, table.rows());
  return chart;
}

}  // namespace

/// Every column of every table over its abscissa.
void add_simulation(Page& page, const Folder& folder) {
  add_words(page, folder);
  page.section("Predicted curves");
  page.begin_pair();
  const Json& said = folder.result();
  for (const std::string& file : folder.tables("")) {
    const auto table = folder.table(file);
    if (!table || file.ends_with("_section.csv")) continue;  // those are drawn with the wall
    const std::string test = file.substr(0, file.size() - 4);
    std::set<std::string> prescribed;
    for (const Json& one : list(said, key::curves))
      if (word(one, key::test) == test)
        for (const std::string& name : words(list(one, key::prescribed))) prescribed.insert(name);
    for (std::size_t k = prescribed.empty() ? 1 : 0; k < table->columns().size(); ++k) {
      const std::string& name = table->columns()[k].name;
      if (prescribed.count(name) == 0)
        page.chart(predicted_chart(*table, test, k, over_of(said, *table, test, name)), folder.address());
    }
  }
  page.end_pair();
  add_walls(page, folder);
}

}  // namespace tunica::report
