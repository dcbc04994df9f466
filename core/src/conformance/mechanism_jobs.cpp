// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "assembly/composition.hpp"
#include "conformance/declarations.hpp"
#include "conformance/isolated.hpp"
#include "conformance/jobs.hpp"
#include "conformance/mechanism_properties.hpp"
#include "conformance/option_values.hpp"
#include "plugins/default_options.hpp"
#include "plugins/guarded.hpp"

namespace tunica::conformance {
namespace {

using Entry = plugins::Catalogue::Entry<MechanismFactory>;

/// Options to try: as declared, with these choices made; then texts that are empty by default with the names a text may
/// stand for.
std::vector<Options> guesses(const std::vector<Option>& declared, const TestRows* rows, const Choices& choices) {
  std::vector<Options> all{with_choices(declared, choices)};
  std::vector<std::string> words{"1:3", "1"};
  if (rows != nullptr) {
    for (auto channel = rows->channels.rbegin(); channel != rows->channels.rend(); ++channel) words.push_back(*channel);
    for (const auto& column : rows->abscissae) words.push_back(column.observable);
  }
  for (const Option& option : declared) {
    if (option.kind != Option::Kind::text) continue;
    const std::vector<Options> before = all;
    for (const Options& one : before)
      for (const std::string& word : words) {
        all.push_back(one);
        all.back().set(option.name, word);
      }
  }
  return all;
}

/// There is nothing loaded that it can be checked with.
class NotApplicable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The mechanism around a model; throws InputError where it does not apply.
WrappedModel around_model(const Entry& entry, const std::function<std::unique_ptr<Model>()>& make,
                          const std::vector<double>& parameters, const Choices& choices) {
  std::string last;
  for (const Options& options : guesses(entry.factory.options, nullptr, choices)) try {
      MechanismFactory mechanism = entry.factory;
      mechanism.parameters = mechanism.parameters_with(options);
      return {std::move(mechanism), make(), plugins::wrap_bare(entry, make(), options), parameters};
    } catch (const InputError& problem) {
      last = problem.what();
    }
  throw InputError(last);
}

/// Around the first of our own materials that it applies to, or else of the models that are loaded.
WrappedModel around_some_model(const Entry& entry, const CheckContext& context, const Choices& choices) {
  std::string last;
  const std::vector<double> wall = materials().front().parameters, soft = materials().back().parameters;
  const std::vector<std::pair<std::unique_ptr<Model> (*)(), std::vector<double>>> own{
      {slack_fibrous, wall}, {fibrous, wall}, {rubber, soft}};
  for (const auto& [make, parameters] : own) try {
      return around_model(entry, make, parameters, choices);
    } catch (const InputError& problem) {
      last = problem.what();
    }
  for (const auto& [name, model] : context.catalogue.models()) try {
      const auto make = [&model = model] {
        return plugins::create_bare(model, plausible_options(model.factory.options));
      };
      return around_model(entry, make, initial_values(make()->describe().parameters), choices);
    } catch (const InputError& problem) {
      last = problem.what();
    }
  throw NotApplicable("it applies to none of the models that are loaded (" + last + ")");
}

/// A test of the experiment once more: one that is wrapped is owned.
std::unique_ptr<Test> composed_test(const std::string& name, const CheckContext& context) {
  return assembly::compose_test(context.settings.experiment->test(name), context.catalogue).test;
}

WrappedTest around_test(const Entry& entry, const std::string& type, const CheckContext& context,
                        const Choices& choices) {
  const MechanismFactory& mechanism = entry.factory;
  const auto& factory = context.catalogue.tests().find(type)->second;
  const auto made = [&]() -> TestCase {
    if (context.settings.experiment == nullptr) return synthetic_case(factory, context.settings.seed);
    auto all = experiment_cases(*context.settings.experiment, {type}, context.catalogue);
    if (all.empty()) throw NotApplicable("the experiment has no test of type '" + type + "'");
    return std::move(all.front());
  };
  TestCase bare = made();
  WrappedTest on{mechanism, bare.test, bare.test, 0, bare.own, bare.own, bare.material};
  if (!mechanism.native.empty()) {
    const auto& own = bare.test->describe().parameters;
    const auto found =
        std::find_if(own.begin(), own.end(), [&](const Parameter& p) { return p.name == mechanism.native; });
    if (found == own.end())
      throw NotApplicable(fmt::format("the test '{}' has no parameter '{}'", type, mechanism.native));
    on.amplitude = static_cast<std::size_t>(found - own.begin());
    return on;
  }
  Options of_test = bare.from ? bare.from->options : context.settings.experiment->test(bare.name).options;
  for (const std::string& size : mechanism.sizes)  // made-up tests leave out what they do not need themselves
    if (bare.from && of_test.has(size) && of_test.number(size) == 0) of_test.set(size, 1.0);
  std::string last;
  for (const Options& options : guesses(mechanism.options, &bare.test->rows(), choices)) try {
      on.with = plugins::wrap_bare(
          entry, bare.from ? plugins::create_bare(factory, bare.from->setup()) : composed_test(bare.name, context),
          plugins::with_options_of_test(options, of_test));
      on.mechanism.parameters = mechanism.parameters_with(options);
      on.amplitude = bare.own.size();
      on.own.push_back(mechanism.null);
      for (std::size_t k = 1; k < on.mechanism.parameters.size(); ++k)
        on.own.push_back(on.mechanism.parameters[k].initial);
      return on;
    } catch (const InputError& problem) {
      last = problem.what();
    }
  throw NotApplicable(last);
}

/// Adds the properties of what `wrap(choices)` makes with each choice of its options, or why it cannot be made.
template <class Subject, class Wrap>
void add_wrapped(Jobs& jobs, Finding head, const std::vector<PropertyOf<Subject>>& properties,
                 const std::vector<Option>& declared, const CheckContext& context, const Wrap& wrap) {
  const std::string what = "what it wraps with what it makes of that", on = head.with;
  std::vector<Choices> all = other_choices(declared);
  all.insert(all.begin(), Choices{});
  for (const Choices& choices : all) {
    Verdict able = isolated(
        [&]() -> Verdict {
          try {
            static_cast<void>(wrap(choices));
          } catch (const NotApplicable& why) {
            return not_checked(what, why.what());
          } catch (const NothingSuits& why) {
            return not_checked(what, why.what());
          }
          return {.compared = what};
        },
        context.settings.time_limit);
    head.with = choices.empty() ? on : fmt::format("{}{}with {}", on, on.empty() ? "" : ", ", words_of(choices));
    if (!able.held()) {
      add(jobs, head, properties.front().name, [able] { return able; });
      if (choices.empty()) return;  // then no choice helps
      continue;
    }
    add_properties(jobs, head, properties, context.settings.seed,
                   [wrap, choices](const auto& check) { return check(wrap(choices)); });
  }
}

}  // namespace

Jobs mechanism_jobs(const std::string& id, const CheckContext& context) {
  const auto& entry = context.catalogue.mechanisms().find(id)->second;
  Finding head{"mechanism", id, "", ""};
  Jobs jobs;
  add(jobs, head, "declaration_is_complete",
      [&entry, context] { return declaration_is_complete(entry.factory, context.catalogue); });
  if (entry.factory.stage < Stage::test) {
    add_wrapped(jobs, head, wrapped_model_properties(), entry.factory.options, context,
                [&entry, context](const Choices& choices) { return around_some_model(entry, context, choices); });
    return jobs;
  }
  std::vector<std::string> types = entry.factory.applies_to;
  if (types.empty())
    for (const auto& [type, factory] : context.catalogue.tests()) types.push_back(type);
  for (const std::string& type : types) {
    if (!context.catalogue.tests().contains(type)) continue;  // the declaration says so
    head.with = "on " + type;
    add_wrapped(jobs, head, wrapped_test_properties(), entry.factory.options, context,
                [&entry, type, context](const Choices& choices) { return around_test(entry, type, context, choices); });
  }
  return jobs;
}

}  // namespace tunica::conformance
