// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "report/sections.hpp"
#include "report/thinning.hpp"
#include "text/lists.hpp"
#include "text/units.hpp"

namespace tunica::report {

namespace {

/// The entries of a folder in one column: (row, text).
std::vector<std::pair<std::string, std::string>> column_of(const Folder& folder) {
  std::vector<std::pair<std::string, std::string>> lines;
  if (folder.kind() == Folder::Kind::simulation) return {{"kind", "simulation"}};
  lines.emplace_back("warnings", std::to_string(list(folder.result(), key::warnings).size()));
  const Json& diagnosis = member(folder.result(), key::diagnosis);
  if (folder.kind() == Folder::Kind::diagnosis) {
    lines.emplace_back("kind", "diagnosis");
    lines.emplace_back("verdict", word(diagnosis, key::verdict));
    std::vector<std::string> causes;
    for (const Json& cause : list(diagnosis, key::causes)) causes.push_back(word(cause, key::id));
    lines.emplace_back("causes", text::joined(causes));
    for (const auto& [name, estimate] : member(member(diagnosis, key::base), key::parameters).items())
      lines.emplace_back(text::titled(name, word(estimate, key::unit)), figure(number(estimate, key::value)));
    return lines;
  }
  lines.emplace_back("kind", "run");
  const Order order(folder.result());
  if (order.runs().empty()) return lines;
  const auto& first = order.runs().front();
  const Json& best = member(*first.run, key::best);
  lines.emplace_back("best run", first.label);
  lines.emplace_back("ranked on", first.group);
  lines.emplace_back("objective", figure(number(best, key::objective)));
  const Json& stable = member(best, key::stable);
  lines.emplace_back("stable", stable.is_boolean() ? (stable == true ? "yes" : "NO") : "–");
  for (const auto& [test, fit] : member(best, key::per_test).items())
    for (const Json& channel : list(fit, key::channels))
      lines.emplace_back(fmt::format("R², {} {}", test, word(channel, key::channel)), figure(number(channel, key::r2)));
  for (const auto& [name, estimate] : member(best, key::parameters).items())
    lines.emplace_back(text::titled(name, word(estimate, key::unit)), figure(number(estimate, key::value)));
  return lines;
}

/// The best run of every folder in one chart, for each observable of tests that several folders have.
void add_common_fits(Page& page, const std::vector<Folder>& folders, const std::vector<std::string>& names) {
  std::set<std::string> files;
  for (const Folder& folder : folders)
    for (const std::string& file : folder.tables("fit_")) files.insert(file);
  page.begin_pair();
  for (const std::string& file : files) {
    std::map<std::string, Chart> charts;
    std::map<std::string, std::size_t> users;
    for (std::size_t f = 0; f < folders.size(); ++f) {
      const auto table = folders[f].table(file);
      if (!table || table->columns().size() < 3) continue;
      const Order order(folders[f].result());
      auto runs = table->groups("run");
      const auto best = std::min_element(runs.begin(), runs.end(), [&](const auto& a, const auto& b) {
        return order.place(a.first) < order.place(b.first);
      });
      for (std::size_t k = 2; k < table->columns().size() && best != runs.end(); ++k) {
        const auto predicted = table->find(table->columns()[k].name + ".predicted");
        if (!predicted) continue;
        const std::string key = table->title(k);
        Chart& chart = charts[key];
        chart.id = "common_" + file.substr(4, file.size() - 8) + '_' + table->columns()[k].name;
        chart.title = file.substr(4, file.size() - 8) + ": " + table->columns()[k].name;
        chart.about = "Measured, and the best run of every folder";
        chart.x.title = table->title(1);
        chart.y.title = key;
        ++users[key];
        const auto take = [&](std::size_t column, Series series) {
          std::vector<double> y;
          for (const std::size_t row : best->second) y.push_back(table->number(row, column));
          for (const std::size_t i : shape_keeping(y, 400)) {
            series.x.push_back(table->number(best->second[i], 1));
            series.y.push_back(y[i]);
          }
          chart.series.push_back(std::move(series));
        };
        take(k, {"measured, " + names[f], "points", -1, {}, {}, {}, {}, users[key] > 1});
        take(*predicted, {names[f] + ": " + best->first, "line", static_cast<int>(f), {}, {}, {}, {}});
      }
    }
    for (auto& [key, chart] : charts)
      if (users[key] > 1) page.chart(chart);
  }
  page.end_pair();
}

}  // namespace

void add_comparison(Page& page, const std::vector<Folder>& folders) {
  std::vector<std::string> names, head{""};
  for (const Folder& folder : folders) {
    const auto same = std::count(names.begin(), names.end(), folder.name());
    names.push_back(same > 0 ? fmt::format("{} ({})", folder.name(), folder.address()) : folder.name());
    head.push_back(names.back());
  }
  page.section("Side by side");
  std::vector<std::vector<std::pair<std::string, std::string>>> columns;
  std::vector<std::string> keys;
  for (const Folder& folder : folders) {
    columns.push_back(column_of(folder));
    for (const auto& line : columns.back())
      if (std::find(keys.begin(), keys.end(), line.first) == keys.end()) keys.push_back(line.first);
  }
  std::vector<std::vector<Cell>> rows;
  for (const std::string& key : keys) {
    std::vector<Cell> row{{key}};
    for (const auto& column : columns) {
      const auto at = std::find_if(column.begin(), column.end(), [&](const auto& line) { return line.first == key; });
      row.push_back({at == column.end() ? "" : at->second});
    }
    rows.push_back(std::move(row));
  }
  page.html(table_html(head, rows));
  add_common_fits(page, folders, names);
}

}  // namespace tunica::report
