// SPDX-License-Identifier: Apache-2.0
#include "comparison/wall_tables.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "comparison/fit_table.hpp"
#include "comparison/snapshots.hpp"
#include "execution/evaluation_table.hpp"
#include "execution/files.hpp"
#include "text/csv.hpp"

namespace tunica::comparison {

namespace {

std::vector<std::size_t> telling_rows(const std::vector<double>& prescribed) {
  std::vector<std::size_t> by_size(prescribed.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  std::stable_sort(by_size.begin(), by_size.end(),
                   [&](std::size_t a, std::size_t b) { return prescribed[a] < prescribed[b]; });
  if (by_size.empty()) return {};
  std::vector<std::size_t> rows{by_size.front(), by_size[by_size.size() / 2], by_size.back()};
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

/// The best-ranked run with a result that used the test; the number of runs where there is none.
std::size_t best_run(const execution::Plan& plan, const Summary& summary, const std::string& test) {
  for (const Ranked& ranked : summary.ranking) {
    const auto& tests = plan.runs[ranked.run].entry->tests;
    if (ranked.rank && std::find(tests.begin(), tests.end(), test) != tests.end()) return ranked.run;
  }
  return plan.runs.size();
}

std::string table_of(const std::string& run, const std::vector<Snapshot>& snapshots) {
  std::string text;
  for (const Snapshot& snapshot : snapshots) {
    if (snapshot.section.empty()) continue;
    if (text.empty()) {
      text = "run,row";
      for (const auto& column : snapshot.section) text += fmt::format(",{} [{}]", column.name, column.unit);
      text += '\n';
    }
    for (std::size_t i = 0; i < snapshot.section.front().values.size(); ++i) {
      text += fmt::format("{},{}", text::csv_cell(run), snapshot.row + 1);
      for (const auto& column : snapshot.section)
        text += std::isfinite(column.values[i]) ? fmt::format(",{}", column.values[i]) : ",";
      text += '\n';
    }
  }
  return text;
}

}  // namespace

void write_wall_tables(const std::filesystem::path& directory, const execution::Plan& plan, const Summary& summary) {
  for (const auto& test : plan.experiment->tests) {
    const std::size_t run = best_run(plan, summary, test.name);
    if (run == plan.runs.size()) continue;
    const auto& assembly = *plan.runs[run].assembly;
    const auto& tests = plan.runs[run].entry->tests;
    const auto position = static_cast<std::size_t>(std::find(tests.begin(), tests.end(), test.name) - tests.begin());
    const auto channel = std::find_if(assembly.layout().channels.begin(), assembly.layout().channels.end(),
                                      [&](const auto& one) { return one.test == test.name; });
    if (channel == assembly.layout().channels.end()) continue;
    std::vector<double> free;
    for (const auto& parameter : summary.runs[run].parameters) free.push_back(parameter.value);
    std::vector<Snapshot> snapshots;
    if (!take_snapshots(assembly, position, *channel, free, telling_rows(channel->abscissa), snapshots).ok()) continue;
    const std::string stem = "wall_" + file_stem(test.name);
    if (const std::string text = table_of(summary.runs[run].label, snapshots); !text.empty())
      execution::write_atomically(directory / (stem + ".csv"), text);
    for (const Snapshot& snapshot : snapshots)
      if (!snapshot.cells.empty()) write_grid(directory / fmt::format("{}_{}.vtu", stem, snapshot.row + 1), snapshot);
  }
}

}  // namespace tunica::comparison
