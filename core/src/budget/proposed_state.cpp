// SPDX-License-Identifier: Apache-2.0
#include "budget/proposed_state.hpp"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "diagnosis/evidence/least_squares.hpp"
#include "tunica/error.hpp"

namespace tunica::budget {
namespace {

constexpr double enough_of_it = 0.9;
constexpr std::size_t most_named = 3;

using Names = std::vector<std::string>;

/// Free parameters of the models, but those that share a value under another name.
Names of_the_models(const assembly::Assembly& base) {
  Names names;
  for (std::size_t m = 0; m < base.models().in_one_state(); ++m)
    for (const assembly::Link& link : base.models().vector(m).links) {
      const std::string& name = base.layout().parameters[link.index].name;
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  return names;
}

/// A name that begins no other name of the experiment.
std::string free_name(const experiment::Experiment& experiment, const std::string& test) {
  std::string name = test + "_state";
  const auto taken = [&] {
    const auto is = [&](const auto& one) { return one.name == name; };
    return std::any_of(experiment.models.begin(), experiment.models.end(), is) ||
           std::any_of(experiment.tests.begin(), experiment.tests.end(), is) ||
           std::any_of(experiment.states.begin(), experiment.states.end(), is);
  };
  while (taken()) name += "_2";
  return name;
}

/// The fit where these parameters differ in the test; none where one of them cannot, or it fails.
std::optional<ProposedState> fitted(const diagnosis::Evidence& evidence, const diagnosis::MisfitSize& size,
                                    const std::string& test, const Names& differ, const plugins::Catalogue& catalogue) {
  ProposedState found;
  found.test = test;
  found.experiment = evidence.experiment;
  found.name = free_name(found.experiment, test);
  experiment::StateEntry state{found.name, {}, {}};
  for (const std::string& name : differ) state.differs.emplace(name, experiment::ParameterSetting{});
  found.experiment.states.push_back(std::move(state));
  for (auto& entry : found.experiment.tests)
    if (entry.name == test) entry.state = found.name;
  try {
    found.assembly = std::make_shared<const assembly::Assembly>(found.experiment, evidence.run, catalogue);
  } catch (const InputError&) {
    return std::nullopt;
  }
  const auto& layout = found.assembly->layout();
  if (layout.differing.size() != differ.size()) return std::nullopt;
  const auto& known = evidence.base->layout().parameters;
  const auto value_of = [&](const std::string& name, double otherwise) {
    for (std::size_t i = 0; i < known.size(); ++i)
      if (known[i].name == name) return evidence.fit.free[i];
    return otherwise;
  };
  const auto place_of = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find_if(layout.parameters.begin(), layout.parameters.end(),
                                                 [&](const auto& one) { return one.name == name; }) -
                                    layout.parameters.begin());
  };
  std::vector<double> start;
  for (const auto& parameter : layout.parameters) {
    std::string name = parameter.name;
    for (const assembly::Differing& one : layout.differing)
      if (one.own == name) name = one.name;
    start.push_back(std::clamp(value_of(name, parameter.initial), parameter.min, parameter.max));
  }
  const auto workspace = found.assembly->evaluator().make_workspace();
  found.fit = diagnosis::least_squares(*found.assembly, diagnosis::all_variables(*found.assembly), start, *workspace,
                                       60, {.negligible = diagnosis::says_nothing});
  if (!found.fit.status.ok()) return std::nullopt;
  found.share = 1 - size.squares(found.fit) / std::max(size.squares(evidence.fit), 1e-300);
  for (const assembly::Differing& one : layout.differing) {
    const std::size_t from = place_of(one.name), own = place_of(one.own);
    if (from == layout.parameters.size() || own == layout.parameters.size()) return std::nullopt;
    found.changes.push_back({one.name, layout.parameters[own].unit, found.fit.free[from], found.fit.free[own]});
  }
  return found;
}

}  // namespace

std::optional<ProposedState> proposed_state(const diagnosis::Evidence& evidence, const diagnosis::MisfitSize& size,
                                            const std::string& test, double whole,
                                            const plugins::Catalogue& catalogue) {
  if (!evidence.experiment.test(test).state.empty()) return std::nullopt;
  const Names all = of_the_models(*evidence.base);
  Names differ;
  std::optional<ProposedState> best;
  while (differ.size() < std::min(most_named, all.size())) {
    std::vector<std::optional<ProposedState>> tried(all.size());
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
      if (std::find(differ.begin(), differ.end(), all[k]) != differ.end()) return;
      Names more = differ;
      more.push_back(all[k]);
      tried[k] = fitted(evidence, size, test, more, catalogue);
    });
    std::size_t chosen = all.size();
    for (std::size_t k = 0; k < all.size(); ++k)
      if (tried[k] && (chosen == all.size() || tried[k]->share > tried[chosen]->share)) chosen = k;
    if (chosen == all.size()) break;
    differ.push_back(all[chosen]);
    best = std::move(tried[chosen]);
    if (best->share >= enough_of_it * whole) return best;
  }
  if (auto every = fitted(evidence, size, test, all, catalogue)) return every;
  return best;
}

}  // namespace tunica::budget
