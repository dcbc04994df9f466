// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "report/sections.hpp"
#include "report/thinning.hpp"

namespace tunica::report {

namespace {

constexpr std::size_t most_points = 400;

struct Thinned {
  std::vector<double> x, y;
  std::size_t left_out = 0;
};

Thinned thinned(const std::vector<double>& x, const std::vector<double>& y) {
  Thinned result;
  const auto kept = shape_keeping(y, most_points);
  for (const std::size_t i : kept) {
    result.x.push_back(x[i]);
    result.y.push_back(y[i]);
  }
  result.left_out = x.size() - kept.size();
  return result;
}

std::string thinning_note(std::size_t left_out) {
  return left_out == 0 ? ""
                       : fmt::format("Of each long curve {} points are drawn that keep its peaks; the table has all. ",
                                     most_points);
}

/// Measured and predicted, and beside it what is left between them.
void add_channel(Page& page, const Folder& folder, const Order& order, const Table& table, const std::string& test,
                 std::size_t measured, std::size_t predicted) {
  const std::string what = table.title(measured), over = table.title(1);
  const std::string label = fmt::format("{}: {}", test, table.columns()[measured].name);
  Chart fit, rest;
  fit.id = table.file_name().substr(0, table.file_name().size() - 4) + '_' + table.columns()[measured].name;
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
  Series data{"measured", "points", -1, {}, {}, {}, {}}, held{"measured, held out", "points", 6, {}, {}, {}, {}};
  std::vector<std::pair<std::size_t, const std::vector<std::size_t>*>> sorted;
  for (const auto& [run, rows] : groups) sorted.emplace_back(order.place(run), &rows);
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [place, rows] : sorted) {
    const std::string run = table.text(rows->front(), "run");
    std::vector<double> x, y, residual;
    for (const std::size_t row : *rows) {
      x.push_back(table.number(row, 1));
      y.push_back(table.number(row, predicted));
      residual.push_back(table.number(row, measured) - y.back());
      if (drawn > 0) continue;
      Series& series = table.number(row, "held_out") > 0 ? held : data;
      series.x.push_back(x.back());
      series.y.push_back(table.number(row, measured));
    }
    if (drawn == 0) {
      for (Series* series : {&data, &held}) {
        const Thinned few = thinned(series->x, series->y);
        left_out += few.left_out;
        series->x = few.x;
        series->y = few.y;
        if (!series->x.empty()) fit.series.push_back(*series);
      }
    }
    const int style = static_cast<int>(place);
    const bool hidden = drawn++ >= shown_runs;
    const Thinned curve = thinned(x, y), errors = thinned(x, residual);
    left_out += curve.left_out;
    fit.series.push_back({run, "line", style, curve.x, curve.y, {}, {}, hidden});
    rest.series.push_back({run, "both", style, errors.x, errors.y, {}, {}, hidden});
  }
  rest.legend = true;
  fit.note = rest.note = hidden_note(groups.size()) + thinning_note(left_out);
  page.begin_pair();
  page.chart(std::move(fit), folder.address());
  page.chart(std::move(rest), folder.address());
  page.end_pair();
}

}  // namespace

void add_fits(Page& page, const Folder& folder, const Order& order) {
  bool begun = false;
  for (const std::string& file : folder.tables("fit_")) {
    const auto table = folder.table(file);
    if (!table || table->columns().size() < 3) continue;
    if (!std::exchange(begun, true)) page.section("Data and fit");
    const std::string test = file.substr(4, file.size() - 8);
    for (std::size_t k = 2; k < table->columns().size(); ++k)
      if (const auto predicted = table->find(table->columns()[k].name + ".predicted"))
        add_channel(page, folder, order, *table, test, k, *predicted);
  }
}

}  // namespace tunica::report
