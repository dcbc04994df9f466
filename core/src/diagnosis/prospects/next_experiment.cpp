// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/prospects/next_experiment.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/prospects/separation.hpp"
#include "diagnosis/prospects/undetermined.hpp"

namespace tunica::diagnosis {
namespace {

/// What switches mechanisms by themselves, of the first `most_listed` of them.
std::string isolating(const Inquiry& inquiry, const std::vector<std::string>& ids) {
  constexpr std::size_t most_listed = 3;
  std::vector<std::string> switches;
  for (const std::string& id : ids)
    if (switches.size() < most_listed) switches.push_back(fmt::format("{}: {}", id, inquiry.mechanism(id).isolated_by));
  if (ids.size() > most_listed) switches.emplace_back("for the others see `tunica describe`");
  return fmt::format("{}", fmt::join(switches, "; "));
}

/// The causes of a claim that the data leave open, and errors of the rig, which an inspection of the rig settles.
std::vector<std::string> unconfirmed(const Claim& claim) {
  constexpr double sure = 0.99;
  std::vector<std::string> ids;
  for (const std::string& id : claim.ambiguity_set) {
    const bool open = std::any_of(claim.causes.begin(), claim.causes.end(), [&id](const Cause& cause) {
      return cause.id == id && (cause.probability < sure || cause.group == CauseGroup::rig);
    });
    if (open) ids.push_back(id);
  }
  return ids;
}

/// With one cause.
std::optional<NextExperiment> confirming(const Inquiry& inquiry, const Evidence& evidence, const Claim& claim) {
  NextExperiment next;
  next.separates = claim.ambiguity_set;
  if (const std::vector<std::string> open = unconfirmed(claim); !open.empty())
    next.description = fmt::format("To confirm {}.", isolating(inquiry, open));
  if (const auto more = determining_experiment(inquiry, evidence, claim.rivals.front())) {
    next.description += (next.description.empty() ? "" : " ") + more->description;
    next.repeats = more->repeats;
  }
  return next.description.empty() ? std::nullopt : std::optional(next);
}

std::vector<std::string> members_of(const Refit& rival) {
  std::vector<std::string> ids;
  for (const Addition& addition : rival.additions) ids.push_back(addition.id);
  return ids;
}

/// What is measured next is decided by explanations with amplitudes that are believed; by all where these are no two.
std::vector<const Refit*> deciding(const Claim& claim) {
  std::vector<const Refit*> all, believed;
  for (const Refit& rival : claim.rivals) {
    all.push_back(&rival);
    if (!claim.doubted.contains(members_of(rival))) believed.push_back(&rival);
  }
  return believed.size() > 1 ? believed : all;
}

/// The set without what only explanations have that are not believed.
std::vector<std::string> worth_switching(const Claim& claim) {
  std::set<std::string> doubted;
  for (const Refit& rival : claim.rivals)
    if (const auto ids = members_of(rival); claim.doubted.contains(ids)) doubted.insert(ids.begin(), ids.end());
  for (const Refit& rival : claim.rivals)
    if (const auto ids = members_of(rival); !claim.doubted.contains(ids))
      for (const std::string& id : ids) doubted.erase(id);
  std::vector<std::string> ids = claim.ambiguity_set;
  std::erase_if(ids, [&](const std::string& id) { return doubted.contains(id); });
  return ids.empty() ? claim.ambiguity_set : ids;
}

/// With several.
NextExperiment separating(const Inquiry& inquiry, const Evidence& evidence, const Claim& claim) {
  NextExperiment next;
  next.separates = claim.ambiguity_set;
  const std::string switches = isolating(inquiry, worth_switching(claim));
  std::vector<FittedRival> rivals;
  for (const Refit* rival : deciding(claim))
    rivals.push_back({rival->extension->assembly(), rival->extension->variables(), rival->fit});
  const auto found = separating_design(inquiry, evidence, rivals);
  if (!found) {
    next.description = fmt::format(
        "No strip, sheet or inflation of the library tells them apart in {} repeats. A test that switches "
        "one of them alone does: {}.",
        most_repeats, switches);
    return next;
  }
  next.repeats = found->repeats;
  next.description = fmt::format(
      "{}, {} (the rivals differ by {:.1f} σ there); or a test that switches one of them alone: {}.", found->design,
      *next.repeats == 1 ? "once" : fmt::format("{} times", *next.repeats), found->sigmas, switches);
  return next;
}

}  // namespace

std::optional<NextExperiment> next_experiment(const Inquiry& inquiry, const Evidence& evidence,
                                              const Explanation& explanation) {
  const Claim& claim = explanation.claim;
  if (claim.rivals.size() > 1) return separating(inquiry, evidence, claim);
  if (claim.rivals.size() == 1) return confirming(inquiry, evidence, claim);
  if (explanation.verdict != Verdict::nothing_detected || !evidence.base) return std::nullopt;
  return determining_experiment(inquiry, evidence, bare_refit(inquiry, evidence));
}

}  // namespace tunica::diagnosis
