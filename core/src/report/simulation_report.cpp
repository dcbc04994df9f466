// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>

#include "report/sections.hpp"
#include "report/thinning.hpp"
#include "text/lists.hpp"

namespace tunica::report {

namespace {

/// Of which model at which parameters the curves are; older folders do not say.
void add_words(Page& page, const Folder& folder) {
  const Json& said = folder.result();
  if (word(said, "model").empty()) return;
  page.section("Summary");
  if (const auto warnings = words(list(said, "warnings")); !warnings.empty())
    page.box("bad", warnings.size() == 1 ? "Warning" : fmt::format("{} warnings", warnings.size()), warnings);
  std::vector<std::string> values;
  // A test's imperfections at zero are no news.
  for (const auto& [name, estimate] : member(said, "parameters").items())
    if (name.find('.') == name.npos || number(estimate, "value") != 0)
      values.push_back(fmt::format("{} = {}", name, amount(number(estimate, "value"), word(estimate, "unit"))));
  const std::string source = word(said, "source");
  const double noise = number(said, "noise");
  page.words(
      {{"What was simulated", fmt::format("{} in {}", word(said, "model"), text::joined(words(list(said, "tests"))))},
       {"Parameters", text::joined(values)},
       {"Where from", source.empty() ? word(said, "origin") : source},
       {"Noise", noise > 0 ? fmt::format("{:.3g} % of every value, seed {}", 100 * noise, figure(number(said, "seed")))
                           : "none"},
       {"What to do next", "Lay it beside a calibration: tunica report DIR THIS_FOLDER -o FILE."}});
}

}  // namespace

/// Every column of every table over the first.
void add_simulation(Page& page, const Folder& folder) {
  add_words(page, folder);
  page.section("Predicted curves");
  page.begin_pair();
  for (const std::string& file : folder.tables("")) {
    const auto table = folder.table(file);
    if (!table || file.ends_with("_section.csv")) continue;  // those are drawn with the wall
    for (std::size_t k = 1; k < table->columns().size(); ++k) {
      Chart chart;
      chart.id = file.substr(0, file.size() - 4) + '_' + table->columns()[k].name;
      chart.title = file.substr(0, file.size() - 4) + ": " + table->columns()[k].name;
      chart.x.title = table->title(0);
      chart.y.title = table->title(k);
      chart.about = fmt::format("{} over {}", chart.y.title, chart.x.title);
      chart.files = {file};
      std::vector<double> y;
      for (std::size_t row = 0; row < table->rows(); ++row) y.push_back(table->number(row, k));
      Series series{table->columns()[k].name, "line", 0, {}, {}, {}, {}};
      const auto kept = shape_keeping(y, 600);
      for (const std::size_t row : kept) {
        series.x.push_back(table->number(row, std::size_t{0}));
        series.y.push_back(y[row]);
      }
      if (kept.size() < table->rows())
        chart.note = fmt::format("{} of {} rows are drawn, peaks kept.", kept.size(), table->rows());
      if (!series.x.empty()) chart.series.push_back(std::move(series));
      page.chart(std::move(chart), folder.address());
    }
  }
  page.end_pair();
  add_walls(page, folder);
}

}  // namespace tunica::report
