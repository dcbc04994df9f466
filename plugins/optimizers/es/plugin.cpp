// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

#include <fmt/core.h>

#include "evolution_strategy.hpp"
#include "search_options.hpp"

namespace tunica::es {
namespace {

std::vector<Option> declared() {
  std::vector<Option> options{
      Option::integer("parents", 10, {1, 1e6}, "Number of parents, μ."),
      Option::integer("offspring", 40, {1, 1e6}, "Number of offspring a generation, λ."),
      Option::choice("selection", {"plus", "comma"}, "plus",
                     "Who the next parents are: the best of parents and offspring (plus, elitist) or the best of the "
                     "offspring (comma)."),
      Option::choice("adaptation", {"isotropic", "axes", "covariance"}, "covariance",
                     "What mutations adapt: one step size (isotropic), one an axis (axes), or one step size and the "
                     "covariance of successful mutations (covariance). Only covariance follows valleys oblique to the "
                     "axes."),
      Option::choice("step_control", {"automatic", "self_adaptive", "cumulative"}, "automatic",
                     "How steps are found: each is inherited and mutated (self_adaptive), or all follow the path of "
                     "the parents' mean (cumulative, as in CMA-ES). Cumulative needs covariance and global "
                     "recombination; automatic chooses it where it can."),
      Option::choice("recombination", {"global", "intermediate", "discrete", "none"}, "global",
                     "What an offspring descends from: the rank-weighted mean of all parents (global), the mean of two "
                     "(intermediate), every coordinate from one of two (discrete), or one parent (none)."),
      Option::choice("bounds", {"reflect", "clamp", "resample"}, "reflect",
                     "A mutation that leaves the bounds is folded back (reflect), set on the bound (clamp), or drawn "
                     "again (resample)."),
      Option::choice("infeasible", {"rank_by_violation", "constant_penalty"}, "rank_by_violation",
                     "How points that break a constraint are ranked: behind all others and by their violation "
                     "(rank_by_violation), or by their objective, as under a large constant penalty "
                     "(constant_penalty).")};
  const std::vector<Option> common = search_options(0.15);
  options.insert(options.end(), common.begin(), common.end());
  return options;
}

const std::vector<Option> options = declared();

/// Position of the chosen word, which is the value of the enumerator.
template <class Choice>
Choice chosen(const Options& given, const std::string& name) {
  const auto& option = *std::ranges::find(options, name, &Option::name);
  const auto found = std::ranges::find(option.choices, given.text(name));
  if (found == option.choices.end())
    throw InputError(fmt::format("'{}' is not a choice of '{}'", given.text(name), name));
  return static_cast<Choice>(found - option.choices.begin());
}

std::unique_ptr<Optimizer> create(const Options& given) {
  Settings settings{.parents = given.count("parents"),
                    .offspring = given.count("offspring"),
                    .selection = chosen<Selection>(given, "selection"),
                    .adaptation = chosen<Adaptation>(given, "adaptation"),
                    .step_control = chosen<StepControl>(given, "step_control"),
                    .recombination = chosen<Recombination>(given, "recombination"),
                    .bounds = chosen<Bounds>(given, "bounds"),
                    .infeasible = chosen<Infeasible>(given, "infeasible")};
  set_search_options(given, settings);
  if (settings.selection == Selection::comma && settings.offspring <= settings.parents) {
    throw InputError(
        fmt::format("'offspring' is {} and 'parents' {}: with 'selection' \"comma\" the parents are chosen among the "
                    "offspring, so there must be more of these; about four times as many is usual",
                    settings.offspring, settings.parents));
  }
  const bool possible =
      settings.adaptation == Adaptation::covariance && settings.recombination == Recombination::global;
  if (settings.step_control == StepControl::cumulative && !possible) {
    throw InputError(
        "'step_control' \"cumulative\" follows the mean of the parents: it needs 'adaptation' \"covariance\" and "
        "'recombination' \"global\"; choose these, or \"automatic\"");
  }
  if (settings.step_control == StepControl::automatic) {
    settings.step_control = possible ? StepControl::cumulative : StepControl::self_adaptive;
  }
  return std::make_unique<EvolutionStrategy>(settings);
}

}  // namespace
}  // namespace tunica::es

TUNICA_PLUGIN("es", "0.1.0") {
  registry.add(
      tunica::OptimizerFactory{.type = "es",
                               .doc = "Evolution strategy with self-adapted mutation steps and covariance, for "
                                      "objectives with valleys, noise or several minima; needs no derivatives.",
                               .reference = "H.-G. Beyer, H.-P. Schwefel, Evolution strategies: a comprehensive "
                                            "introduction, Natural Computing 1 (2002) 3-52; "
                                            "H.-G. Beyer, B. Sendhoff, Covariance matrix adaptation revisited: the "
                                            "CMSA evolution strategy, PPSN X, LNCS 5199 (2008) 123-132; "
                                            "C. Canales et al., Mathematics 11(4) (2023) 922.",
                               .options = tunica::es::options,
                               .create = tunica::es::create});
}
