// SPDX-License-Identifier: Apache-2.0
#include "tunica/plugin.hpp"

#include <fmt/core.h>

#include "evolution_strategy.hpp"

namespace tunica::es {
namespace {

using Kind = Option::Kind;

const std::vector<Option> options = {
    {.name = "parents",
     .kind = Kind::integer,
     .fallback = std::int64_t{10},
     .doc = "Number of parents, μ.",
     .min = 1,
     .max = 1e6},
    {.name = "offspring",
     .kind = Kind::integer,
     .fallback = std::int64_t{40},
     .doc = "Number of offspring a generation, λ.",
     .min = 1,
     .max = 1e7},
    {.name = "selection",
     .kind = Kind::choice,
     .fallback = "plus",
     .doc = "Parents of the next generation are the best of parents and offspring (plus, elitist) or of the offspring "
            "alone (comma).",
     .choices = {"plus", "comma"}},
    {.name = "adaptation",
     .kind = Kind::choice,
     .fallback = "covariance",
     .doc = "What mutations adapt: one step size (isotropic), one an axis (axes), or one step size and the covariance "
            "of successful mutations; only covariance follows valleys oblique to the axes.",
     .choices = {"isotropic", "axes", "covariance"}},
    {.name = "step_control",
     .kind = Kind::choice,
     .fallback = "automatic",
     .doc = "How steps are found: inherited and mutated (self_adaptive), or by the length of the path that the mean of "
            "the parents takes (cumulative, as in CMA-ES; needs covariance and global recombination); automatic is "
            "cumulative where that is possible.",
     .choices = {"automatic", "self_adaptive", "cumulative"}},
    {.name = "recombination",
     .kind = Kind::choice,
     .fallback = "global",
     .doc = "An offspring descends from the rank-weighted mean of all parents (global), the mean of two "
            "(intermediate), two with every coordinate from one of them (discrete), or one (none).",
     .choices = {"global", "intermediate", "discrete", "none"}},
    {.name = "bounds",
     .kind = Kind::choice,
     .fallback = "reflect",
     .doc = "A mutation that leaves the bounds is folded back (reflect), set on the bound (clamp), or drawn again "
            "(resample).",
     .choices = {"reflect", "clamp", "resample"}},
    {.name = "infeasible",
     .kind = Kind::choice,
     .fallback = "rank_by_violation",
     .doc =
         "Points that break a constraint rank behind all others, by how far they break it (rank_by_violation), or by "
         "their objective, as under a large constant penalty (constant_penalty).",
     .choices = {"rank_by_violation", "constant_penalty"}},
    {.name = "initial_step",
     .kind = Kind::number,
     .fallback = 0.15,
     .doc = "First standard deviation of the mutations, as a fraction of the range of each parameter.",
     .min = 1e-6,
     .max = 1},
    {.name = "restarts",
     .kind = Kind::integer,
     .fallback = std::int64_t{10},
     .doc = "Further searches from new random points after the first has converged or stalled, as far as the stop "
            "block allows.",
     .min = 0,
     .max = 1e6},
    {.name = "restart_growth",
     .kind = Kind::number,
     .fallback = 2.0,
     .doc = "Factor on parents and offspring at every restart; 1 keeps them.",
     .min = 1,
     .max = 10},
    {.name = "stall_generations",
     .kind = Kind::integer,
     .fallback = std::int64_t{30},
     .doc = "A search ends after so many generations without progress.",
     .min = 1,
     .max = 1e6},
    {.name = "tolerance",
     .kind = Kind::number,
     .fallback = 1e-9,
     .doc = "Relative improvement of the objective that counts as progress.",
     .min = 0,
     .max = 1},
    {.name = "step_tolerance",
     .kind = Kind::number,
     .fallback = 1e-12,
     .doc = "A search ends when the mean mutation is shorter than this fraction of the range.",
     .min = 0,
     .max = 1},
};

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
  Settings settings{.parents = static_cast<std::size_t>(given.integer("parents")),
                    .offspring = static_cast<std::size_t>(given.integer("offspring")),
                    .selection = chosen<Selection>(given, "selection"),
                    .adaptation = chosen<Adaptation>(given, "adaptation"),
                    .step_control = chosen<StepControl>(given, "step_control"),
                    .recombination = chosen<Recombination>(given, "recombination"),
                    .bounds = chosen<Bounds>(given, "bounds"),
                    .infeasible = chosen<Infeasible>(given, "infeasible"),
                    .initial_step = given.number("initial_step"),
                    .restarts = static_cast<std::size_t>(given.integer("restarts")),
                    .restart_growth = given.number("restart_growth"),
                    .stall_generations = static_cast<std::size_t>(given.integer("stall_generations")),
                    .tolerance = given.number("tolerance"),
                    .step_tolerance = given.number("step_tolerance")};
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
