// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/sections.hpp"
#include "text/lists.hpp"

namespace tunica::report {

namespace {

/// Warnings that concern several runs stand once, with the runs. A result that is older than `warning_details` has
/// sentences only.
std::vector<std::string> merged(const Json& result) {
  struct Merged {
    std::vector<std::string> runs;
    std::string sentence;
  };
  std::vector<Merged> all;
  for (const Json& warning : list(result, key::warning_details)) {
    const std::string run = word(warning, key::run), sentence = word(warning, key::sentence);
    const auto same = std::find_if(all.begin(), all.end(), [&](const Merged& one) {
      return !run.empty() && !one.runs.empty() && one.sentence == sentence;
    });
    if (same != all.end())
      same->runs.push_back(run);
    else
      all.push_back({run.empty() ? std::vector<std::string>{} : std::vector{run}, sentence});
  }
  if (all.empty()) return words(list(result, key::warnings));
  std::vector<std::string> lines;
  constexpr std::size_t named = 3;
  for (Merged& one : all) {
    if (one.runs.size() > named + 1)
      one.runs = {one.runs[0], one.runs[1], one.runs[2], fmt::format("{} more runs", one.runs.size() - named)};
    lines.push_back(one.runs.empty() ? one.sentence : text::joined(one.runs) + ": " + one.sentence);
  }
  return lines;
}

/// " (h = 0.7)": the difference between a run and others with its model and optimizer.
std::string differences(const Json& run) {
  const auto parts = words(list(run, key::differs_by));
  return parts.empty() ? "" : fmt::format(" ({})", fmt::join(parts, ", "));
}

}  // namespace

void add_warnings(Page& page, const Folder& folder) {
  const auto warnings = merged(folder.result());
  if (!warnings.empty())
    page.box("bad", warnings.size() == 1 ? "Warning" : fmt::format("{} warnings", warnings.size()), warnings, 3);
}

void add_ranking(Page& page, const Folder& folder, const Order& order) {
  if (list(folder.result(), key::ranking).empty()) return;
  page.section("Ranking");
  const auto groups = order.groups();
  for (const std::string& group : groups) {
    if (groups.size() > 1) page.heading(group.empty() ? "Without rank" : order.title(group));
    std::vector<std::vector<Cell>> rows;
    std::vector<bool> first;
    for (const Json& entry : list(folder.result(), key::ranking)) {
      if (word(entry, key::group) != group) continue;
      const std::size_t place = order.place(word(entry, key::run));
      const Json& run = place < order.runs().size() ? *order.runs()[place].run : entry;
      const Json& best = member(run, key::best);
      const Json& stable = member(best, key::stable);
      const double rank = number(entry, key::rank);
      rows.push_back(
          {{std::isfinite(rank) ? figure(rank) : "–", true},
           {word(entry, key::run) + differences(run)},
           {figure(number(entry, key::objective)), true},
           {figure(number(entry, key::delta_aicc)), true},
           {figure(number(member(best, key::misfit), key::reduced_chi_square)), true,
            member(member(best, key::misfit), key::contradicts_noise) == true},
           {fmt::format("{} / {}", figure(number(entry, key::successes)), figure(number(run, key::realisations))),
            true},
           {figure(number(entry, key::expected_running_time)), true},
           {figure(number(run, key::evaluations)), true},
           {figure(number(run, key::jacobians)), true},
           {figure(number(member(run, key::full_simulations), key::count)), true},
           {figure(number(run, key::failures)), true, number(run, key::failures) > 0},
           {figure(number(run, key::seconds)), true},
           {stable.is_boolean() ? (stable == true ? "yes" : "NO") : "–", false, stable == false},
           {word(entry, key::reason).empty() ? word(best, key::status) : word(entry, key::reason)}});
      first.push_back(rank == 1);
    }
    page.html(table_html({"rank", "run", "objective", "ΔAICc", "χ²/ν", "successes", "per success", "evaluations",
                          "Jacobians", "full simulations", "failed", "seconds", "stable", "status"},
                         rows, first));
  }
  page.html(
      "<p class=\"muted\">Per success: evaluations spent for one success, failed searches included. All columns: <a "
      "href=\"" +
      (folder.address().empty() ? "" : folder.address() + "/") + "ranking.csv\">ranking.csv</a></p>\n");
}

void add_provenance(Page& page, const Folder& folder) {
  const Json& provenance = member(folder.result(), key::provenance);
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
