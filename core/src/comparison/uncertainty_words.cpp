// SPDX-License-Identifier: Apache-2.0
#include "comparison/uncertainty_words.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "text/lists.hpp"

namespace tunica::comparison {

namespace {

constexpr double disagreement = 0.25;  ///< of the linearised half width

using uncertainty::Profile;
using Kind = Profile::End::Kind;

std::string end_text(const Profile::End& end) {
  return end.kind == Kind::crossed ? fmt::format("{:.4g}", end.value) : "open";
}

void add_open_end(const std::string& name, const Profile::End& end, const char* bound, RunSummary& summary) {
  if (end.kind == Kind::open)
    summary.uncertainty.push_back(
        fmt::format("the profile of {} is open towards the {} bound: the data do not limit it there", name, bound));
  if (end.kind == Kind::failed)
    summary.uncertainty.push_back(fmt::format(
        "the profile of {} ends at {:.4g}, before the {} bound: beyond it no refit succeeded", name, end.value, bound));
}

/// A side at a bound has nowhere to go.
bool at(const Estimate& estimate, Estimate::Bound bound) { return estimate.at_bound == bound; }

}  // namespace

void add_linearised_words(RunSummary& summary) {
  std::vector<std::string> names;
  bool profiled = true;
  for (const auto& estimate : summary.parameters) {
    if (!estimate.ci95 || estimate.straight) continue;
    names.push_back(estimate.name);
    profiled = profiled && estimate.profile.has_value();
  }
  if (names.empty()) return;
  const bool one = names.size() == 1;
  std::string sentence = fmt::format(
      "the linearised {} of {} may be far off: the likelihood is not quadratic over {}, or a bound cuts {} "
      "off; ",
      one ? "interval" : "intervals", text::joined(names), one ? "this interval" : "these intervals",
      one ? "it" : "them");
  sentence += profiled
                  ? "take the profile"
                  : fmt::format("--profiles {} gives {}", fmt::join(names, ","), one ? "a better one" : "better ones");
  summary.uncertainty.insert(summary.uncertainty.begin(), std::move(sentence));
}

void add_widening_words(RunSummary& summary) {
  if (!summary.misfit || !summary.misfit->contradicts()) return;
  summary.uncertainty.insert(
      summary.uncertainty.begin(),
      fmt::format("the intervals of parameters and curves are {:.2g} times as wide as the stated noise makes them, by "
                  "√(χ²/ν): misfit is not noise, so {}",
                  summary.misfit->times(),
                  summary.bootstrap ? "take the bootstrap" : "they are rough; --bootstrap 200 gives better ones"));
}

void add_profile_words(const assembly::Assembly& assembly, const std::vector<Profile>& profiles, RunSummary& summary) {
  for (const Profile& profile : profiles) {
    const auto& estimate = summary.parameters[profile.parameter];
    const std::string& name = assembly.layout().parameters[profile.parameter].name;
    if (!at(estimate, Estimate::Bound::lower)) add_open_end(name, profile.lower, "lower", summary);
    if (!at(estimate, Estimate::Bound::upper)) add_open_end(name, profile.upper, "upper", summary);
    if (const double missed = profile.gain - profile.lowest; missed > 1e-2 * profile.threshold)
      summary.uncertainty.push_back(
          fmt::format("the profile of {} found a better point (-2 ln L lower by {:.3g}), so the best point is not the "
                      "optimum; search longer or from more starts",
                      name, missed));
    if (!estimate.ci95) continue;
    const double half = (estimate.ci95->second - estimate.ci95->first) / 2;
    // An end that stays open agrees with a linearised one that the bound has cut off.
    const auto differs = [&](const Profile::End& end, double linear, double bound) {
      const double value = end.kind == Kind::crossed ? end.value : bound;
      return std::abs(value - linear) > disagreement * half;
    };
    if (differs(profile.lower, estimate.ci95->first, estimate.min) ||
        differs(profile.upper, estimate.ci95->second, estimate.max))
      summary.uncertainty.push_back(fmt::format(
          "{}: the profile ({} … {}) and the linearised interval ({:.4g} … {:.4g}) disagree: the objective is not "
          "quadratic there; take the profile",
          name, end_text(profile.lower), end_text(profile.upper), estimate.ci95->first, estimate.ci95->second));
  }
}

void add_bootstrap_words(const assembly::Assembly& assembly, const uncertainty::Bootstrap& bootstrap,
                         RunSummary& summary) {
  summary.bootstrap = {bootstrap.draws.size(), bootstrap.failures};
  if (bootstrap.draws.empty()) {
    summary.uncertainty.emplace_back("no bootstrap: the best point cannot be linearised");
    return;
  }
  if (bootstrap.failures > 0)
    summary.uncertainty.push_back(fmt::format("{} of {} bootstrap draws could not be fitted and are left out",
                                              bootstrap.failures, bootstrap.draws.size()));
  std::size_t channel = 0;
  for (const auto& view : assembly.layout().channels) {
    const bool counted =
        view.weight > 0 && std::find(view.fitted.begin(), view.fitted.end(), true) != view.fitted.end();
    if (!counted || channel >= bootstrap.blocks.size()) continue;
    const std::size_t length = bootstrap.blocks[channel];
    if (length > 1)
      summary.uncertainty.push_back(fmt::format(
          "neighbouring residuals of {}, {} are correlated ({:.2f}), so the bootstrap drew blocks of {} rows; "
          "intervals that treat rows as independent are too narrow",
          view.test, view.observable, bootstrap.correlation[channel], length));
    ++channel;
  }
}

}  // namespace tunica::comparison
