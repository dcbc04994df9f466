// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "budget/output/outputs.hpp"
#include "text/lists.hpp"
#include "text/wrapping.hpp"

namespace tunica::budget {
namespace {

/// What a step adds: "a second viscoelasticity in the material", "I2 (linear)".
std::string added(const std::vector<Step>& steps, std::size_t which) {
  const Step& step = steps[which];
  const auto before = std::count_if(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(which),
                                    [&](const Step& other) { return other.id == step.id; });
  const char* const ordinal = before == 0 ? "" : before == 1 ? "a second " : "one more ";
  return fmt::format("{}{}{}", ordinal, step.id, place_words(step.place));
}

/// "viscoelasticity (needs a time column); stress_softening (needs the order of the rows)"
std::string untried(const std::vector<Budget::Untried>& all) {
  constexpr std::array<std::pair<Budget::Lack, const char*>, 7> needs{
      {{Budget::Lack::clock, "needs a time column"},
       {Budget::Lack::order, "needs the order of the rows"},
       {Budget::Lack::loading, "needs the loading before the first row"},
       {Budget::Lack::volume, "needs a measured lateral stretch or volume"},
       {Budget::Lack::size, "needs the length and width of the specimen in the file"},
       {Budget::Lack::time, "take hours beside a costly simulation; try a richer base model"},
       {Budget::Lack::group, "left out by \"groups\""}}};
  std::vector<std::string> parts;
  for (const auto& [lack, what] : needs) {
    std::vector<std::string> ids;
    for (const Budget::Untried& one : all)
      if (one.lack == lack) ids.push_back(one.id);
    if (!ids.empty()) parts.push_back(fmt::format("{} ({})", fmt::join(ids, ", "), what));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

std::string place_words(const diagnosis::Place& place) { return place.tests.empty() ? "" : " " + place.words(); }

std::string the_misfit(const Budget& budget) {
  return budget.base.rms <= budget.tolerance.share ? "a misfit that is within the tolerance" : "the misfit";
}

std::string price(const Contender& contender) {
  if (!contender.is_state()) return {};
  const std::string probability =
      contender.probability < 0.005 ? "below 0.01" : fmt::format("{:.2f}", contender.probability);
  return fmt::format(" (with {} of its own, probability {})",
                     text::counted(contender.parameters, "parameter", "parameters"), probability);
}

const char* origin_words(const Tolerance& tolerance) {
  switch (tolerance.origin) {
    case Tolerance::Origin::stated:
      return "stated";
    case Tolerance::Origin::repeats:
      return "scatter between the repeats";
    case Tolerance::Origin::cohort:
      return "spread between specimens";
    case Tolerance::Origin::standard:
      break;
  }
  return "default";
}

std::string remains(const Size& rest, const Tolerance& tolerance) {
  if (rest.rms < 5e-4)
    return fmt::format("nothing beyond noise is left, at most {} of the range (tolerance {}, {})", percent(rest.upper),
                       percent(tolerance.share), origin_words(tolerance));
  return fmt::format("{} of the range remains (tolerance {}, {}), for which no cause is claimed", percent(rest.rms),
                     percent(tolerance.share), origin_words(tolerance));
}

text::StyledText same_model_line(const Budget& budget, const std::string& base) {
  text::StyledText line;
  if (!budget.same_model.empty())
    line += text::hanging("Model:    ", fmt::format("{} with {} is the model `{}` on these data", base,
                                                    fmt::join(budget.same_with, " and "), budget.same_model)) +
            '\n';
  return line;
}

text::StyledText summary(const Budget& budget, const std::string& base) {
  text::StyledText lines;
  std::string text = fmt::format("{} {}", base, text::misses_by(budget.base.rms));
  for (std::size_t k = 0; k < budget.steps.size(); ++k)
    text += fmt::format("; + {}: {} ({})", added(budget.steps, k),
                        budget.steps[k].rest.rms > 0 ? percent(budget.steps[k].rest.rms) : "noise only",
                        percent(budget.steps[k].share));
  text += "; " + text::against_tolerance(budget.rest().rms, budget.rest().upper, budget.tolerance.share,
                                         origin_words(budget.tolerance));
  lines += text::hanging("Budget:   ", text) + '\n';
  if (!budget.rest_channels.empty())
    lines += text::hanging("Left:     ", assembly::where_most(budget.rest_channels)) + '\n';
  lines += same_model_line(budget, base);
  std::vector<std::string> others;
  bool state = false;
  for (const Contender& one : budget.contenders) {
    const bool step =
        std::any_of(budget.steps.begin(), budget.steps.end(), [&](const Step& own) { return own.id == one.id; });
    // Of several tests each may be the other state: one stands for them.
    if (step || one.share < 0.1 || others.size() >= 3 || (state && one.is_state())) continue;
    state = state || one.is_state();
    others.push_back(fmt::format("{}{} {}{}{}", one.id, place_words(one.place), percent(one.share), price(one),
                                 one.belief == Belief::beyond ? " (beyond belief)" : ""));
  }
  if (!others.empty()) lines += text::hanging("Alone:    ", fmt::format("{}", fmt::join(others, ", "))) + '\n';
  if (!budget.not_looked_for.empty()) lines += text::hanging("Untried:  ", untried(budget.not_looked_for)) + '\n';
  return lines;
}

}  // namespace tunica::budget
