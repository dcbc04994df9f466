// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "report/sections.hpp"

namespace tunica::report {

namespace {

/// Warnings that are said of several runs: once, with the runs.
std::vector<std::string> merged(const Json& result) {
  struct Said {
    std::vector<std::string> runs;
    std::string what;
  };
  std::vector<Said> all;
  for (const std::string& warning : words(list(result, "warnings"))) {
    std::string run;
    for (const Json& one : list(result, "runs"))
      if (const std::string label = word(one, "run"); !label.empty() && warning.starts_with(label + ": ")) run = label;
    const std::string what = run.empty() ? warning : warning.substr(run.size() + 2);
    const auto same =
        std::find_if(all.begin(), all.end(), [&](const Said& said) { return !said.runs.empty() && said.what == what; });
    if (run.empty())
      all.push_back({{}, what});
    else if (same == all.end())
      all.push_back({{run}, what});
    else
      same->runs.push_back(run);
  }
  std::vector<std::string> lines;
  constexpr std::size_t named = 3;
  for (Said& said : all) {
    if (said.runs.size() > named + 1)
      said.runs = {said.runs[0], said.runs[1], said.runs[2], fmt::format("{} more runs", said.runs.size() - named)};
    lines.push_back(said.runs.empty() ? said.what : joined(said.runs) + ": " + said.what);
  }
  return lines;
}

}  // namespace

void add_warnings(Page& page, const Folder& folder) {
  const auto warnings = merged(folder.result());
  if (!warnings.empty())
    page.box("bad", warnings.size() == 1 ? "Warning" : fmt::format("{} warnings", warnings.size()), warnings, 3);
}

void add_ranking(Page& page, const Folder& folder, const Order& order) {
  if (list(folder.result(), "ranking").empty()) return;
  page.section("Ranking");
  const auto groups = order.groups();
  for (const std::string& group : groups) {
    if (groups.size() > 1) page.heading(group.empty() ? "Without rank" : order.title(group));
    std::vector<std::vector<Cell>> rows;
    std::vector<bool> first;
    for (const Json& entry : list(folder.result(), "ranking")) {
      if (word(entry, "group") != group) continue;
      const std::size_t place = order.place(word(entry, "run"));
      const Json& run = place < order.runs().size() ? *order.runs()[place].run : entry;
      const Json& best = member(run, "best");
      const Json& stable = member(best, "stable");
      const double rank = number(entry, "rank");
      rows.push_back(
          {{std::isfinite(rank) ? figure(rank) : "–", true},
           {word(entry, "run")},
           {figure(number(entry, "objective")), true},
           {figure(number(entry, "delta_aicc")), true},
           {fmt::format("{} / {}", figure(number(entry, "successes")), figure(number(run, "realisations"))), true},
           {figure(number(entry, "expected_running_time")), true},
           {figure(number(run, "evaluations")), true},
           {figure(number(run, "failures")), true, number(run, "failures") > 0},
           {figure(number(run, "seconds")), true},
           {stable.is_boolean() ? (stable == true ? "yes" : "NO") : "–", false, stable == false},
           {word(entry, "reason").empty() ? word(best, "status") : word(entry, "reason")}});
      first.push_back(rank == 1);
    }
    page.html(table_html({"rank", "run", "objective", "ΔAICc", "successes", "per success", "evaluations", "failed",
                          "seconds", "stable", "status"},
                         rows, first));
  }
  page.html(
      "<p class=\"muted\">Per success: evaluations spent for one success, failed searches included. All columns: <a "
      "href=\"" +
      (folder.address().empty() ? "" : folder.address() + "/") + "ranking.csv\">ranking.csv</a></p>\n");
}

void add_provenance(Page& page, const Folder& folder) {
  const Json& provenance = member(folder.result(), "provenance");
  if (!provenance.is_object()) return;
  page.section("Provenance");
  std::vector<std::pair<std::string, std::string>> lines;
  for (const auto& [key, value] : provenance.items()) {
    std::vector<std::string> parts = words(value);
    if (value.is_object())
      for (const auto& [name, version] : value.items())
        parts.push_back(name + ' ' + (version.is_string() ? version.get<std::string>() : version.dump()));
    lines.emplace_back(key, value.is_string()      ? value.get<std::string>()
                            : value.is_primitive() ? value.dump()
                                                   : fmt::format("{}", fmt::join(parts, ", ")));
  }
  page.words(lines);
  if (!folder.problems().empty()) page.box("bad", "Tables that could not be read", folder.problems());
}

}  // namespace tunica::report
