// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "report/sections.hpp"
#include "report/thinning.hpp"

namespace tunica::report {

/// Every column of every table over the first.
void add_simulation(Page& page, const Folder& folder) {
  page.section("Predicted curves");
  for (const std::string& file : folder.tables("")) {
    const auto table = folder.table(file);
    if (!table) continue;
    page.heading(file.substr(0, file.size() - 4));
    page.begin_pair();
    for (std::size_t k = 1; k < table->columns().size(); ++k) {
      Chart chart;
      chart.id = file.substr(0, file.size() - 4) + '_' + table->columns()[k].name;
      chart.title = table->columns()[k].name;
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
    page.end_pair();
  }
}

}  // namespace tunica::report
