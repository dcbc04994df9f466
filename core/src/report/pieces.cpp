// SPDX-License-Identifier: Apache-2.0
#include "report/pieces.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "text/lists.hpp"
#include "text/units.hpp"

namespace tunica::report {

std::string figure(double value) {
  if (!std::isfinite(value)) return "–";
  const bool whole = value == std::round(value) && std::abs(value) < 1e9;    // counts are not rounded
  const bool long_enough = std::abs(value) >= 1e4 && std::abs(value) < 1e7;  // 11004 reads better than 1.1e+04
  return whole || long_enough ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string share(double p) { return std::isnan(p) ? "–" : p < 1e-4 ? "< 0.0001" : fmt::format("{:.3g}", p); }

std::string amount(double value, const std::string& unit) {
  return std::isfinite(value) ? figure(value) + text::unit_suffix(unit) : figure(value);
}

std::string chance(double p, bool bound) {
  if (std::isnan(p)) return "–";
  return p < 1e-4 ? "p < 0.0001" : fmt::format("p {} {:.2g}", bound ? "≤" : "=", p);
}

std::string count_of(std::size_t count, const std::string& one, const std::string& many) {
  return count == 1 ? "one " + one : fmt::format("{} {}", count, many);
}

Order::Order(const Json& result) {
  std::vector<const Json*> left;
  for (const Json& run : list(result, key::runs)) left.push_back(&run);
  const auto take = [&](const std::string& label, const std::string& group, int rank) {
    const auto at =
        std::find_if(left.begin(), left.end(), [&](const Json* run) { return word(*run, key::run) == label; });
    if (at == left.end()) return;
    runs_.push_back({label, word(**at, key::model), word(**at, key::optimizer), group, *at, rank});
    left.erase(at);
  };
  for (const Json& entry : list(result, key::ranking)) {
    const double rank = number(entry, key::rank);
    take(word(entry, key::run), word(entry, key::group), std::isfinite(rank) ? static_cast<int>(rank) : 0);
  }
  while (!left.empty()) {
    const Json& run = *left.front();
    runs_.push_back({word(run, key::run), word(run, key::model), word(run, key::optimizer), "", &run, 0});
    left.erase(left.begin());
  }
}

std::size_t Order::place(const std::string& label) const {
  std::size_t found = runs_.size(), length = 0;
  for (std::size_t k = 0; k < runs_.size(); ++k) {
    const std::string& known = runs_[k].label;
    if (label == known) return k;
    if (label.starts_with(known + ' ') && known.size() > length) {
      found = k;
      length = known.size();
    }
  }
  return found;
}

std::vector<std::string> Order::groups() const {
  std::vector<std::string> names;
  for (const Run& run : runs_)
    if (std::find(names.begin(), names.end(), run.group) == names.end()) names.push_back(run.group);
  return names;
}

std::string Order::title(const std::string& group) const {
  const auto at = std::find_if(runs_.begin(), runs_.end(), [&](const Run& run) { return run.group == group; });
  const std::string objective = at == runs_.end() ? "" : word(*at->run, key::objective_type);
  if (objective.empty()) return group;  // older than the key
  std::vector<std::string> fitted;
  std::size_t held_out = 0;
  for (const std::string& test : words(list(*at->run, key::tests))) {
    const Json& channels = list(entry(member(member(*at->run, key::best), key::per_test), test), key::channels);
    const bool held = !channels.empty() && std::all_of(channels.begin(), channels.end(), [](const Json& channel) {
      return member(channel, key::held_out) == true;
    });
    held_out += held ? 1 : 0;
    if (!held) fitted.push_back(test);
  }
  if (held_out == 0 || fitted.empty()) return group;
  return fmt::format("{} on {} ({} held out)", objective, text::joined(fitted), count_of(held_out, "test", "tests"));
}

bool Order::shown(std::size_t place) const {
  if (place >= runs_.size()) return true;
  const auto each = std::max<std::size_t>(1, shown_runs / groups().size());
  std::size_t better = 0;
  for (std::size_t k = 0; k < place; ++k) better += runs_[k].group == runs_[place].group ? 1 : 0;
  return better < each;
}

std::string Order::note() const {
  std::size_t count = 0;
  for (std::size_t k = 0; k < runs_.size(); ++k) count += shown(k) ? 1 : 0;
  return count == runs_.size() ? ""
                               : fmt::format(
                                     "The best of every group, {} of {} runs, are shown; switch on the others in "
                                     "the legend. ",
                                     count, runs_.size());
}

std::string hidden_note(std::size_t count) {
  return count <= shown_runs
             ? ""
             : fmt::format("The best {} of {} runs are shown; switch on the others in the legend. ", shown_runs, count);
}

}  // namespace tunica::report
