// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conformance/declarations.hpp"
#include "conformance/isolated.hpp"
#include "conformance/jobs.hpp"
#include "conformance/model_properties.hpp"
#include "conformance/optimizer_properties.hpp"
#include "conformance/option_values.hpp"
#include "plugins/guarded.hpp"

namespace tunica::conformance {

namespace {

constexpr const char* choices_property = "every_choice_is_exercised";

/// Adds properties with each of the other choices that `make(choices)` accepts, and says which words none of them has.
template <class Make, class Add>
void add_choices(Jobs& jobs, Finding head, const std::vector<Option>& declared, std::size_t most,
                 const CheckContext& context, const Make& make, const Add& add_to) {
  std::vector<Choices> all = other_choices(declared, most);
  if (all.empty()) return;
  std::set<std::pair<std::string, std::string>> seen;
  const Options plausible = plausible_options(declared);
  for (const Option& option : declared)
    if (option.kind == Option::Kind::choice) seen.insert({option.name, plausible.text(option.name)});
  std::vector<std::string> missed;
  std::size_t made = 0;
  const std::size_t place = jobs.size();
  const std::string what = "each word that an option may have with what is made with it";
  for (const Choices& choices : all) {
    // First in a separate process, because a wrong factory may do anything.
    Verdict able = isolated(
        [&]() -> Verdict {
          try {
            make(choices);
          } catch (const InputError& refusal) {
            return not_checked(what, refusal.what());
          }
          return {.compared = what};
        },
        context.settings.time_limit);
    head.with = "with " + words_of(choices);
    if (!able.counter_example.empty()) add(jobs, head, choices_property, [able] { return able; });
    if (!able.held()) continue;
    seen.insert(choices.begin(), choices.end());
    ++made;
    add_to(head, choices);
  }
  for (const Option& option : declared)
    for (const std::string& word : option.choices)
      if (!seen.contains({option.name, word})) missed.push_back(fmt::format("{} = {}", option.name, word));
  head.with.clear();
  Jobs about;
  add(about, head, choices_property, [=]() -> Verdict {
    if (!missed.empty())
      return not_checked(what,
                         fmt::format("it refuses {} with the defaults of the other options", fmt::join(missed, ", ")));
    return {.compared = what, .note = fmt::format("{} other combinations", made)};
  });
  jobs.insert(jobs.begin() + static_cast<std::ptrdiff_t>(place), std::move(about.front()));
}

/// The promises of an optimiser under any options; the quality of its optima is tested separately.
bool is_of_conduct(const OptimizerProperty& property) {
  constexpr std::array all{evaluates_once_when_nothing_is_free,
                           keeps_the_budget,
                           stops_at_the_target,
                           asks_for_what_it_declares,
                           repeats_itself_with_the_same_seed,
                           does_not_depend_on_the_order_of_parallel_work,
                           gives_up_when_nothing_can_be_evaluated,
                           prints_nothing};
  return std::find(all.begin(), all.end(), property.function) != all.end();
}

}  // namespace

Jobs model_jobs(const std::string& type, const CheckContext& context) {
  const auto& entry = context.catalogue.models().find(type)->second;
  const Finding head{"model", type, "", ""};
  const auto made = [&entry] { return plugins::create_bare(entry, plausible_options(entry.factory.options)); };
  Jobs jobs;
  add(jobs, head, "declaration_is_complete", [&entry] { return declaration_is_complete(entry.factory); });
  add(jobs, head, "parameters_are_declared", [made, type] {
    const auto model = made();
    if (model->describe().type != type)
      return broken("the type of the description with that of the factory",
                    "the model calls itself '" + model->describe().type + "', and is registered as '" + type + "'");
    return parameters_are_declared(model->describe().parameters);
  });
  add(jobs, head, "is_made_with_every_option", [&entry] {
    return made_with_every_option(entry.factory.options, [&](const Options& o) { plugins::create_bare(entry, o); });
  });
  add_properties(jobs, head, model_properties(), context.settings.seed,
                 [made](const auto& check) { return check(*made()); });
  const auto add_card = [&](const Finding& of, const Options& options) {
    if (!entry.factory.card) return;
    add(jobs, of, "card_has_the_energy_of_the_model", [&entry, options, seed = context.settings.seed] {
      try {
        return card_has_the_energy_of_the_model(*plugins::create_bare(entry, options), entry.factory.card, options,
                                                seed);
      } catch (const InputError& refusal) {
        return not_checked("W with that of the declared card", refusal.what());
      }
    });
  };
  add_card(head, plausible_options(entry.factory.options));
  const auto make = [&entry](const Choices& choices) {
    return plugins::create_bare(entry, with_choices(entry.factory.options, choices));
  };
  std::vector<ModelProperty> properties = model_properties();
  // Threads, which take the longest, are tried once.
  std::erase_if(properties, [](const ModelProperty& one) { return one.function == concurrent_calls_agree; });
  add_choices(jobs, head, entry.factory.options, many_combinations, context, make,
              [&](const Finding& with, const Choices& choices) {
                add(jobs, with, "parameters_are_declared",
                    [make, choices] { return parameters_are_declared(make(choices)->describe().parameters); });
                add_properties(jobs, with, properties, context.settings.seed,
                               [make, choices](const auto& check) { return check(*make(choices)); });
                add_card(with, with_choices(entry.factory.options, choices));
              });
  return jobs;
}

Jobs optimizer_jobs(const std::string& type, const CheckContext& context) {
  const auto& entry = context.catalogue.optimizers().find(type)->second;
  const Finding head{"optimizer", type, "", ""};
  Jobs jobs;
  add(jobs, head, "declaration_is_complete", [&entry] { return declaration_is_complete(entry.factory); });
  add(jobs, head, "is_made_with_every_option", [&entry] {
    return made_with_every_option(entry.factory.options, [&](const Options& o) { plugins::create(entry, o); });
  });
  add_properties(jobs, head, optimizer_properties(), context.settings.seed, [&entry](const auto& check) {
    return check(Candidate{[&entry] { return plugins::create_bare(entry, plausible_options(entry.factory.options)); }});
  });
  const auto make = [&entry](const Choices& choices) {
    return plugins::create_bare(entry, with_choices(entry.factory.options, choices));
  };
  std::vector<OptimizerProperty> properties = optimizer_properties();
  std::erase_if(properties, [](const OptimizerProperty& one) { return !is_of_conduct(one); });
  // Each choice separately, because a search takes longer than a call of a model.
  add_choices(jobs, head, entry.factory.options, 0, context, make, [&](const Finding& with, const Choices& choices) {
    add_properties(jobs, with, properties, context.settings.seed, [make, choices](const auto& check) {
      return check(Candidate{[make, choices] { return make(choices); }});
    });
  });
  return jobs;
}

}  // namespace tunica::conformance
