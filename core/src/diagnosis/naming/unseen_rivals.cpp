// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/unseen_rivals.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "assembly/memory.hpp"
#include "diagnosis/hypotheses/places.hpp"
#include "text/lists.hpp"

namespace tunica::diagnosis {
namespace {

bool is_declared(const MechanismFactory& mechanism, const std::string& look_alike) {
  return std::find(mechanism.look_alikes.begin(), mechanism.look_alikes.end(), look_alike) !=
         mechanism.look_alikes.end();
}

/// Whether the material of one of the tests is in one of the others.
template <class Tests, class Others>
bool share_a_model(const Evidence& evidence, const Tests& tests, const Others& others) {
  const auto models_of = [&](const auto& names) {
    std::set<std::string> models;
    for (const std::string& name : names)
      for (std::string& model : assembly::models_of_test(evidence.experiment.test(name), evidence.run))
        models.insert(std::move(model));
    return models;
  };
  const std::set<std::string> own = models_of(tests);
  return std::ranges::any_of(models_of(others), [&](const std::string& model) { return own.contains(model); });
}

}  // namespace

std::vector<std::string> unseen_rivals(const Inquiry& inquiry, const Analysis& analysis, const std::string& id,
                                       const Place& place) {
  std::vector<std::string> rivals;
  const MechanismFactory& mechanism = inquiry.mechanism(id);
  if (!assembly::has_memory(mechanism)) return rivals;
  const bool of_sensor = group_of(mechanism) == CauseGroup::rig;
  for (const Candidate& one : analysis.hypotheses.candidates) {
    const bool unseen = one.absence == Absence::no_clock || one.absence == Absence::no_past;
    // Tests of unknown order count as a first loading: what the material remembers there is a guess.
    const bool half_seen = of_sensor && group_of(*one.mechanism) == CauseGroup::material &&
                           share_a_model(analysis.evidence, place.tests, one.without_past);
    if ((unseen || half_seen) && is_declared(mechanism, one.id) && is_declared(*one.mechanism, id))
      rivals.push_back(one.id);
  }
  return rivals;
}

Reason not_looked_for(const std::vector<std::string>& rivals) {
  return {ReasonKind::rival_not_looked_for,
          fmt::format(
              "{} may act alike and {} not looked for in every test, because order or time of some rows is not known",
              text::joined(rivals), text::agreeing(rivals.size(), "was", "were"))};
}

void limit_by_unseen_rivals(const Inquiry& inquiry, const Analysis& analysis, Explanation& explanation) {
  if (explanation.verdict != Verdict::named) return;
  Claim& claim = explanation.claim;
  std::vector<std::string> unseen;
  for (std::size_t k = 0; k < claim.named; ++k)
    for (std::string& rival : unseen_rivals(inquiry, analysis, claim.causes[k].id, claim.causes[k].place))
      if (std::find(unseen.begin(), unseen.end(), rival) == unseen.end()) unseen.push_back(std::move(rival));
  if (unseen.empty()) return;
  explanation.verdict = Verdict::indistinguishable;
  explanation.reasons.insert(explanation.reasons.begin(), not_looked_for(unseen));
  for (const std::string& rival : unseen) {
    claim.ambiguity_set.push_back(rival);
    if (!claim.look_alikes.empty()) claim.look_alikes.push_back({rival});
  }
}

}  // namespace tunica::diagnosis
