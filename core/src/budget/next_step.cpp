// SPDX-License-Identifier: Apache-2.0
#include "budget/next_step.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "text/lists.hpp"

namespace tunica::budget {
namespace {

using diagnosis::ReasonKind;
using diagnosis::Verdict;
using Lack = Budget::Lack;

std::vector<std::string> that_lack(const Budget& budget, Lack lack) {
  std::vector<std::string> ids;
  for (const Budget::Untried& one : budget.not_looked_for)
    if (one.lack == lack) ids.push_back(one.id);
  return ids;
}

/// A time column gives the order of the rows as well.
std::string what_the_file_lacks(const Budget& budget) {
  const std::vector<std::string> clock = that_lack(budget, Lack::clock), order = that_lack(budget, Lack::order),
                                 loading = that_lack(budget, Lack::loading), size = that_lack(budget, Lack::size);
  std::vector<std::string> sentences;
  if (!order.empty())
    sentences.push_back(fmt::format("Say in which order the rows were measured (\"order\"): then {} can be tried.",
                                    text::joined(order)));
  if (!clock.empty())
    sentences.push_back(fmt::format("Map a time column: then {} can be tried{}.", text::joined(clock),
                                    order.empty() ? "" : " as well"));
  if (!loading.empty())
    sentences.push_back(
        fmt::format("Record the loading before the first row too: then {} can be tried.", text::joined(loading)));
  if (!size.empty())
    sentences.push_back(
        fmt::format("Say how long and how wide the specimen is: then {} can be tried.", text::joined(size)));
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : " ") + sentence;
  return text;
}

/// Nothing that is said of such a fit is worth a step before the noise is known.
std::string noise_first(const Budget& budget) {
  if (budget.lopsided.empty()) return {};
  return fmt::format("State the noise: it is estimated, {}, so that the fit follows the one and lets the other go.",
                     budget.lopsided);
}

std::string what_is_open(const Budget& budget) {
  if (budget.rough) return "Measure a test twice on one specimen: what does not come back is noise, or softening.";
  if (budget.base.upper <= budget.tolerance.share)
    return "The base is good enough for this tolerance; state a smaller one to go on.";
  return "Measure a test again with the specimen mounted anew: a misfit that comes back is not of the mounting, but "
         "the material's or a steady error of the rig. The first asks for another base model.";
}

}  // namespace

std::string next_step(const Budget& budget, const diagnosis::Explanation& explanation) {
  const Verdict verdict = explanation.verdict;
  if (verdict != Verdict::unknown && verdict != Verdict::leading && verdict != Verdict::indistinguishable) return "";
  std::string text = noise_first(budget);
  if (const std::string lacks = what_the_file_lacks(budget); !lacks.empty()) text += (text.empty() ? "" : " ") + lacks;
  // Other reasons have a next step of their own, or none.
  const bool unlisted =
      std::any_of(explanation.reasons.begin(), explanation.reasons.end(),
                  [](const diagnosis::Reason& reason) { return reason.kind == ReasonKind::unlisted_misfit; });
  if (verdict == Verdict::unknown && unlisted) text += (text.empty() ? "" : " ") + what_is_open(budget);
  return text;
}

}  // namespace tunica::budget
