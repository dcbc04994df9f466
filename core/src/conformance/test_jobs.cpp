// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "conformance/declarations.hpp"
#include "conformance/isolated.hpp"
#include "conformance/jobs.hpp"
#include "conformance/option_values.hpp"
#include "conformance/predictions.hpp"
#include "conformance/test_cases.hpp"
#include "plugins/guarded.hpp"

namespace tunica::conformance {
namespace {

using Volume = TestDescription::Volume;

const Material& foam() {
  static const Material material{"a compressible rubber", compressible_rubber(), {30}};
  return material;
}

/// The simulations that a property is checked with: other materials, and imperfections that are there.
std::vector<Simulation> simulations(const TestCase& test_case) {
  std::vector<const Model*> layers;
  for (const auto& layer : test_case.layers) layers.push_back(layer.get());
  std::vector<Simulation> all{
      {*test_case.test, *test_case.material.model, test_case.material.parameters, test_case.own, layers}};
  const TestDescription& description = test_case.test->describe();
  if (description.costly) return all;
  std::vector<double> moved = test_case.own;
  for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += 0.1 * (description.parameters[k].max - moved[k]);
  if (moved != test_case.own)
    all.push_back({*test_case.test, *test_case.material.model, test_case.material.parameters, moved, layers});
  if (test_case.from) {
    static const Material other = materials().back();
    if (description.volume != Volume::free)
      all.push_back({*test_case.test, *other.model, other.parameters, test_case.own, {}});
    if (description.volume == Volume::either)
      all.push_back({*test_case.test, *foam().model, foam().parameters, test_case.own, {}});
  }
  return all;
}

/// A test that says it carries both kinds of material simulates one that changes its volume.
Verdict carries_compressible_materials(const TestCase& test_case) {
  const std::string compared = "a compressible rubber with a prediction";
  const Prediction found = predict(*test_case.test, {*foam().model, foam().parameters, test_case.own});
  if (!found.status.ok())
    return broken(compared, fmt::format("the test says that it carries materials of any volume, and of this one: {}",
                                        found.status.reason()));
  return {.compared = compared};
}

/// The worst of the verdicts.
Verdict check_all(const TestProperty& property, const TestCase& test_case, std::uint64_t seed) {
  Verdict worst;
  bool first = true;
  for (const Simulation& simulation : simulations(test_case)) {
    // Where imperfections as large as these cannot be simulated, the test has said so.
    if (!first) {
      if (!predict(simulation.test, simulation.input()).status.ok()) continue;
    }
    Verdict one = property.check(simulation, seed);
    if (first || !one.counter_example.empty() || (one.held() && worst.held() && one.worst > worst.worst))
      worst = std::move(one);
    if (!worst.counter_example.empty()) return worst;
    first = false;
  }
  return worst;
}

/// Whether rows are found that suit the test. That none do is no fault; that it crashes or throws is one.
template <class Search>
Verdict able_to(const Search& search) {
  const std::string compared = "a test that is made and asked with an answer, or an InputError of its factory";
  try {
    search();
  } catch (const NothingSuits& why) {
    return not_checked(compared, why.what());
  }
  return {.compared = compared};
}

/// A test copies what it keeps, and gives it back as rows().
Verdict rows_are_kept(const plugins::Catalogue::Entry<TestFactory>& entry, const OwnedSetup& from) {
  const std::string compared = "rows() with the rows the test was made from, after these are gone";
  auto given = std::make_unique<OwnedSetup>(from);
  const auto test = plugins::create_bare(entry, given->setup());
  for (auto& [name, values] : given->abscissae) std::fill(values.begin(), values.end(), -1e9);
  given.reset();
  const TestRows& rows = test->rows();
  if (rows.count != from.count())
    return broken(compared, fmt::format("{} rows, {} were given", rows.count, from.count()));
  if (rows.channels != from.channels) return broken(compared, "other channels, or in another order");
  if (rows.abscissae.size() != from.abscissae.size())
    return broken(compared, fmt::format("{} abscissae, {} were given", rows.abscissae.size(), from.abscissae.size()));
  for (std::size_t k = 0; k < rows.abscissae.size(); ++k) {
    const auto& [name, values] = from.abscissae[k];
    if (rows.abscissae[k].observable != name ||
        !std::equal(values.begin(), values.end(), rows.abscissae[k].values.begin(), rows.abscissae[k].values.end()))
      return broken(compared,
                    fmt::format("the abscissa '{}' is not what was given: copy it when the test is made", name));
  }
  return {.compared = compared};
}

/// Properties of formulas, which another choice may lead to. State between calls and threads is looked for once.
bool is_of_formulas(const TestProperty& property) {
  return property.function != predictions_repeat_themselves && property.function != concurrent_predictions_agree;
}

/// Every word of every choice is in a case that is checked.
Verdict choices_are_exercised(const ChoiceCases& choices) {
  const std::string compared = "each word that an option may have with a test that is simulated with it";
  if (!choices.missed.empty())
    return not_checked(compared,
                       fmt::format("no rows could be made up that suit {}; give --experiment with a test of it",
                                   fmt::join(choices.missed, ", ")));
  return {.compared = compared, .note = fmt::format("{} other combinations", choices.cases.size())};
}

std::string words(const TestCase& test_case) {
  if (!test_case.from)
    return fmt::format("as '{}' in the experiment, with model '{}'", test_case.name, test_case.material.name);
  return fmt::format("with made-up rows: {}", test_case.from->words());
}

/// The same properties with the other choices of the options.
void add_choices(Jobs& jobs, Finding head, const plugins::Catalogue::Entry<TestFactory>& entry, const TestCase& base,
                 const CheckContext& context) {
  if (base.from->choices.empty()) return;
  const std::uint64_t seed = context.settings.seed;
  // In a process of its own first, as above.
  Verdict able =
      isolated([&] { return able_to([&] { choice_cases(entry, base, seed); }); }, context.settings.time_limit);
  constexpr const char* property_name = "every_choice_is_exercised";
  if (!able.held()) return add(jobs, head, property_name, [able] { return able; });
  const auto choices = std::make_shared<const ChoiceCases>(choice_cases(entry, base, seed));
  add(jobs, head, property_name, [choices] { return choices_are_exercised(*choices); });
  for (const TestCase& test_case : choices->cases) {
    head.with = words(test_case);
    for (const TestProperty& property : test_properties()) {
      if (!is_of_formulas(property)) continue;
      head.property = property.name;
      head.advisory = property.advisory;
      jobs.push_back({head, [choices, &test_case, property, seed] { return check_all(property, test_case, seed); }});
    }
  }
}

}  // namespace

Jobs test_jobs(const std::string& type, const CheckContext& context) {
  const auto& entry = context.catalogue.tests().find(type)->second;
  const std::uint64_t seed = context.settings.seed;
  Finding head{"test", type, "", ""};
  Jobs jobs;
  add(jobs, head, "declaration_is_complete", [&entry] { return declaration_is_complete(entry.factory); });

  std::vector<std::shared_ptr<const TestCase>> cases;
  std::string why = "the experiment has no test of this type";
  if (context.settings.experiment != nullptr) {
    for (TestCase& test_case : experiment_cases(*context.settings.experiment, {type}, context.catalogue))
      cases.push_back(std::make_shared<const TestCase>(std::move(test_case)));
  } else {
    // First in a process of its own: what a wrong test does while it is made and asked is not known yet.
    Verdict able = isolated([&] { return able_to([&] { synthetic_case(entry, seed); }); }, context.settings.time_limit);
    if (!able.counter_example.empty()) {
      add(jobs, head, "predictions_are_numbers", [able] { return able; });
      return jobs;
    }
    why = able.skipped;
    if (able.held()) cases.push_back(std::make_shared<const TestCase>(synthetic_case(entry, seed)));
  }
  if (cases.empty())
    add(jobs, head, "predictions_are_numbers", [why] { return not_checked("predictions of the test with data", why); });
  for (const auto& test_case : cases) {
    head.with = words(*test_case);
    add(jobs, head, "parameters_are_declared",
        [test_case, &entry] { return parameters_are_declared(test_case->test->describe(), entry.factory); });
    if (test_case->from) {
      add(jobs, head, "rows_are_kept", [test_case, &entry] { return rows_are_kept(entry, *test_case->from); });
      add(jobs, head, "is_made_with_every_option", [test_case, &entry] {
        return made_with_every_option(entry.factory.options, [&](const Options& options) {
          OwnedSetup from = *test_case->from;
          for (const auto& [name, value] : options.values()) from.options.set(name, value);
          plugins::create_bare(entry, from.setup());
        });
      });
    }
    const TestDescription& description = test_case->test->describe();
    if (test_case->from && description.volume == Volume::either && !description.costly)
      add(jobs, head, "carries_compressible_materials",
          [test_case] { return carries_compressible_materials(*test_case); });
    for (const TestProperty& property : test_properties()) {
      head.property = property.name;
      head.advisory = property.advisory;
      jobs.push_back({head, [test_case, property, seed] { return check_all(property, *test_case, seed); }});
    }
  }
  if (!cases.empty() && cases.front()->from) add_choices(jobs, head, entry, *cases.front(), context);
  return jobs;
}

}  // namespace tunica::conformance
