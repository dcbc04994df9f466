// SPDX-License-Identifier: Apache-2.0
#include "budget/next_step.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "text/lists.hpp"

namespace tunica::budget {
namespace {

using diagnosis::Verdict;

/// "Say when the rows were measured (a time column), or in which order ("order"): then creep can be tried."
std::string what_the_file_lacks(const Budget& budget) {
  if (budget.not_looked_for.empty()) return "";
  std::vector<std::string> ids;
  for (const Budget::Untried& one : budget.not_looked_for) ids.push_back(one.id);
  const bool clock = std::any_of(budget.not_looked_for.begin(), budget.not_looked_for.end(),
                                 [](const Budget::Untried& one) { return one.no_clock; });
  const bool order = std::any_of(budget.not_looked_for.begin(), budget.not_looked_for.end(),
                                 [](const Budget::Untried& one) { return !one.no_clock; });
  const char* const what = !order   ? "Map a time column"
                           : !clock ? "Say in which order the rows were measured (\"order\")"
                                    : "Say in which order the rows were measured (\"order\"), or map a time column";
  return fmt::format("{}: then {} can be tried.", what, text::joined(ids));
}

std::string what_is_open(const Budget& budget) {
  if (budget.rough) return "Measure a test twice on one specimen: what does not come back is noise.";
  if (budget.base.rms <= budget.tolerance.share)
    return "The base is good enough for this tolerance; state a smaller one to go on.";
  return "Measure a test again with the specimen mounted anew: a misfit that comes back is the material's, and asks "
         "for another base model.";
}

}  // namespace

std::string next_step(const Budget& budget, Verdict verdict) {
  const bool open = verdict == Verdict::unknown;
  if (!open && verdict != Verdict::leading && verdict != Verdict::indistinguishable) return "";
  std::string text = what_the_file_lacks(budget);
  if (open) text += (text.empty() ? "" : " ") + what_is_open(budget);
  return text;
}

}  // namespace tunica::budget
