// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "report/sections.hpp"
#include "report/thinning.hpp"

namespace tunica::report {

namespace {

constexpr std::size_t most_lines = 100;

bool all_positive(const Chart& chart) {
  for (const Series& series : chart.series)
    for (const double y : series.y)
      if (y <= 0) return false;
  return true;
}

std::string of_group(const Order& order, const std::string& group) {
  return order.groups().size() > 1 ? ": " + order.title(group) : "";
}

/// The search of every realisation, or of an even choice of them from the best to the worst.
void add_convergence(Page& page, const Folder& folder, const Order& order, const Table& table,
                     const std::string& group) {
  Chart chart;
  chart.id = "convergence";
  chart.title = "Convergence of the realisations" + of_group(order, group);
  chart.about = "Best objective so far over the number of evaluations, one line a realisation, one colour a run";
  chart.x = {"evaluations", true, {}, {}};
  chart.y.title = "best objective so far";
  chart.files = {table.file_name()};
  chart.legend = true;
  const auto runs = table.groups("run");
  std::vector<std::pair<std::size_t, const std::vector<std::size_t>*>> drawn;
  for (const auto& [run, rows] : runs)
    if (const std::size_t place = order.place(run); place < order.runs().size() && order.runs()[place].group == group)
      drawn.emplace_back(place, &rows);
  std::sort(drawn.begin(), drawn.end());
  std::size_t all = 0, shown = 0;
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    std::vector<Series> lines;
    std::string last;
    for (const std::size_t row : *drawn[k].second) {
      const std::string& realisation = table.text(row, "realisation");
      if (lines.empty() || realisation != last)
        lines.push_back({order.runs()[drawn[k].first].label,
                         "step",
                         static_cast<int>(drawn[k].first),
                         {},
                         {},
                         {},
                         {},
                         k >= shown_runs,
                         true,
                         "realisation " + realisation});
      last = realisation;
      lines.back().x.push_back(table.number(row, "evaluation"));
      lines.back().y.push_back(table.number(row, "objective"));
    }
    std::stable_sort(lines.begin(), lines.end(),
                     [](const Series& a, const Series& b) { return a.y.back() < b.y.back(); });
    const auto chosen = evenly(lines.size(), std::max<std::size_t>(5, most_lines / drawn.size()));
    all += lines.size();
    shown += chosen.size();
    for (const std::size_t i : chosen) {
      lines[i].faint = lines.size() > 3;
      chart.series.push_back(std::move(lines[i]));
    }
  }
  chart.y.log = all_positive(chart);
  chart.note = hidden_note(drawn.size());
  if (shown < all)
    chart.note += fmt::format(
        "{} of {} realisations are drawn: of each run the best, the worst, and evenly between them by final "
        "objective. ",
        shown, all);
  chart.note += "At most 20 counts a decade are kept of every search.";
  page.chart(chart, folder.address());
}

/// Realisations sorted by their final objective: a flat left end means that they agree.
void add_waterfall(Page& page, const Folder& folder, const Order& order, const Table& table, const std::string& group) {
  Chart chart;
  chart.id = "waterfall";
  chart.title = "Waterfall of the realisations" + of_group(order, group);
  chart.about = "Final objective of the realisations of each run, sorted; a flat left end means that they agree";
  chart.x.title = "realisation, sorted by objective";
  chart.y.title = "final objective";
  chart.files = {table.file_name()};
  chart.legend = true;
  std::size_t longest = 0;
  for (const auto& [run, rows] : table.groups("run")) {
    const std::size_t place = order.place(run);
    if (place >= order.runs().size() || order.runs()[place].group != group) continue;
    Series series{run, "both", static_cast<int>(place), {}, {}, {}, {}};
    for (const std::size_t row : rows)
      if (const double value = table.number(row, "objective"); std::isfinite(value)) series.y.push_back(value);
    std::sort(series.y.begin(), series.y.end());
    for (std::size_t k = 0; k < series.y.size(); ++k) series.x.push_back(static_cast<double>(k + 1));
    longest = std::max(longest, series.y.size());
    chart.series.push_back(std::move(series));
  }
  if (longest < 2) return;  // one realisation each: the ranking says it
  std::stable_sort(chart.series.begin(), chart.series.end(),
                   [](const Series& a, const Series& b) { return a.style < b.style; });
  for (std::size_t k = shown_runs; k < chart.series.size(); ++k) chart.series[k].hidden = true;
  chart.note = hidden_note(chart.series.size());
  chart.y.log = all_positive(chart);
  page.chart(chart, folder.address());
}

void add_profile(Page& page, const Folder& folder, const char* file, const char* column, const char* title,
                 const char* about) {
  const auto table = folder.table(file);
  if (!table) return;
  Chart chart;
  chart.id = file;
  chart.title = title;
  chart.about = about;
  chart.x = {
      column == std::string("tau") ? "τ: cost relative to the cheapest optimizer" : "evaluations / (parameters + 1)",
      true,
      {},
      {}};
  chart.y = {"share of realisations", false, {}, {{0, 1.02}}};
  chart.files = {file};
  int style = 0;
  double least = INFINITY, most = 0;
  for (std::size_t row = 0; row < table->rows(); ++row)
    if (const double x = table->number(row, column); x > 0) {
      least = std::min(least, x);
      most = std::max(most, x);
    }
  for (const auto& [optimizer, rows] : table->groups("optimizer")) {
    Series series{optimizer, "step", style++};
    for (const std::size_t row : rows) {
      series.x.push_back(table->number(row, column));
      series.y.push_back(table->number(row, "fraction"));
    }
    // A step has a beginning and goes on: from nothing, and to the end of the axis.
    series.x.insert(series.x.begin(), std::min(least, series.x.front()));
    series.y.insert(series.y.begin(), series.x[1] > least ? 0 : series.y.front());
    series.x.push_back(1.3 * most);
    series.y.push_back(series.y.back());
    chart.series.push_back(std::move(series));
  }
  if (chart.series.size() > 1) page.chart(chart, folder.address());
}

}  // namespace

void add_searches(Page& page, const Folder& folder, const Order& order) {
  const auto convergence = folder.table("convergence.csv"), realisations = folder.table("realisations.csv");
  if (!convergence && !realisations) return;
  page.section("Searches");
  for (const std::string& group : order.groups()) {
    page.begin_pair();
    if (convergence) add_convergence(page, folder, order, *convergence, group);
    if (realisations) add_waterfall(page, folder, order, *realisations, group);
    page.end_pair();
  }
  page.begin_pair();
  add_profile(page, folder, "performance_profile.csv", "tau", "Performance profile",
              "Share of realisations that succeed within τ times the least cost, for each optimizer (Dolan and Moré)");
  add_profile(page, folder, "data_profile.csv", "evaluations_per_n_plus_1", "Data profile",
              "Share of realisations that succeed within so many evaluations, for each optimizer (Moré and Wild)");
  page.end_pair();
}

}  // namespace tunica::report
