// SPDX-License-Identifier: Apache-2.0
#include "conformance/test_cases.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conformance/handout.hpp"
#include "conformance/option_values.hpp"
#include "conformance/predictions.hpp"
#include "plugins/guarded.hpp"

namespace tunica::conformance {
namespace {

using Role = Observable::Role;
using Kind = Option::Kind;

/// Moderate values of something prescribed: growing, so that rows are in loading order.
std::vector<double> rising(const Observable& observable, std::size_t rows, double size) {
  const double largest = observable.unit == "kPa"             ? 10
                         : observable.unit == "mN"            ? 20
                         : observable.unit.starts_with("deg") ? 20  // also over a length
                         : observable.unit == "s"             ? 10
                                                              : 0.2;
  const double from = observable.kind == Observable::Kind::stretch ? 1 : 0;
  std::vector<double> values(rows);
  for (std::size_t i = 0; i < rows; ++i)
    values[i] = from + size * largest * static_cast<double>(i + 1) / static_cast<double>(rows);
  return values;
}

/// The setups of a search, the most likely first.
class SetupSampler {
 public:
  /// The choices in `pinned` are made in every setup.
  SetupSampler(const TestFactory& factory, Choices pinned, std::uint64_t seed)
      : factory_(factory), pinned_(std::move(pinned)), engine_(seed) {}

  OwnedSetup next() {
    const std::size_t attempt = attempt_++;
    OwnedSetup guess;
    guess.options = plausible_options(factory_.options);
    const bool plain = attempt < 16;  // first with options as they are
    for (const Option& option : factory_.options) {
      if (plain) break;
      const bool number = option.kind == Kind::number || option.kind == Kind::quantity;
      // A default at the least value often stands for "not given".
      if (number && (!option.fallback || std::get<double>(*option.fallback) == option.min.value_or(0)) && coin())
        guess.options.set(option.name, std::clamp(size_at(attempt), option.min.value_or(0), option.max.value_or(2)));
      if (option.kind == Kind::choice && !option.choices.empty() && coin())
        guess.options.set(option.name, option.choices[engine_() % option.choices.size()]);
    }
    for (const auto& [name, word] : pinned_) guess.options.set(name, word);
    for (const Option& option : factory_.options)
      if (option.kind == Kind::choice) guess.choices.emplace_back(option.name, guess.options.text(option.name));
    std::vector<const Observable*> channels;
    std::size_t optional = 0;
    // Smaller and smaller where larger ones do not suit: limits of materials are not known here.
    const double size = attempt % 3 == 0 ? 1 : attempt % 3 == 1 ? 0.3 : 0.1;
    constexpr std::size_t rows = 6;
    for (const Observable& observable : factory_.observables) {
      if (observable.role == Role::channel) {
        channels.push_back(&observable);
        continue;
      }
      const bool map = observable.required || (plain ? ((attempt >> optional) & 1) != 0 : coin());
      if (!observable.required) ++optional;
      if (!map) continue;
      if (observable.role == Role::abscissa)
        guess.abscissae.emplace_back(observable.name, rising(observable, rows, size));
      else if (observable.required || no_abscissa())
        guess.time = rising(observable, rows, 1);
    }
    const bool all = attempt % 2 == 0;
    for (std::size_t k = 0; k < channels.size(); ++k)
      if (all || channels[k]->required || k == attempt / 2 % channels.size())
        guess.channels.push_back(channels[k]->name);
    return guess;
  }

 private:
  /// Whether time is all that rows can have.
  [[nodiscard]] bool no_abscissa() const {
    return std::none_of(factory_.observables.begin(), factory_.observables.end(),
                        [](const Observable& observable) { return observable.role == Role::abscissa; });
  }
  bool coin() { return (engine_() & 1) != 0; }
  /// Of a length, for example. Where equal ones do not go together, some are smaller.
  double size_at(std::size_t attempt) {
    constexpr std::size_t equal = 64;
    return attempt < equal || coin() ? 1.1 : 0.1;
  }
  const TestFactory& factory_;
  Choices pinned_;
  std::mt19937_64 engine_;
  std::size_t attempt_ = 0;
};

using Candidates = std::vector<Material>;

/// What came of a guess. One that is no case is refused with a reason; one that breaks a promise is a case, which the
/// properties then fail.
struct Attempt {
  std::shared_ptr<Test> test;
  std::size_t material = 0;  ///< of the candidates
  std::string refusal;       ///< empty = the guess is a case
  bool no_number = false;    ///< refused since a value is no number under the status ok
};
Attempt attempt_with(const plugins::Catalogue::Entry<TestFactory>& entry, const OwnedSetup& guess,
                     const Candidates& kept, const Candidates& changing) {
  Attempt one;
  try {
    one.test = plugins::create_bare(entry, guess.setup());
    const std::vector<double> own = own_values(one.test->describe());
    const bool free = one.test->describe().volume == TestDescription::Volume::free;
    std::string first;
    for (const Material& material : free ? changing : kept) {
      const Prediction found = predict(*one.test, {*material.model, material.parameters, own});
      one.no_number = false;
      if (!found.status.ok()) {
        one.refusal = found.status.reason().empty() ? "it fails without a reason" : found.status.reason();
      } else if (!std::all_of(found.values.begin(), found.values.end(), [](double x) { return std::isfinite(x); })) {
        one.refusal = "it predicts numbers that are not finite, under the status ok";
        one.no_number = true;
        return one;
      } else {
        one.refusal.clear();
        return one;
      }
      if (first.empty()) first = one.refusal;
      ++one.material;
    }
    one.material = 0;
    one.refusal = first;
  } catch (const InputError& problem) {
    one.refusal = problem.what();
  } catch (const MemoryFault&) {
  }
  return one;
}

/// As synthetic_case(), with these choices made.
TestCase found_case(const plugins::Catalogue::Entry<TestFactory>& entry, const Choices& pinned, int patience,
                    std::uint64_t seed) {
  // Fibres show more than a rubber, and some tests carry no directions.
  const Candidates kept{materials().front(), materials().back()},
      changing{{"a compressible rubber", compressible_rubber(), {30}}};
  SetupSampler guesses(entry.factory, pinned, seed);
  std::string last = "it declares no channel";
  std::optional<TestCase> no_number;
  const auto made = [&](OwnedSetup guess, const Attempt& of) -> TestCase {
    std::vector<double> own = own_values(of.test->describe());
    const bool free = of.test->describe().volume == TestDescription::Volume::free;
    return {"", of.test, std::move(guess), std::move(own), (free ? changing : kept)[of.material]};
  };
  for (int attempt = 0; attempt < patience; ++attempt) {
    OwnedSetup guess = guesses.next();
    if (guess.channels.empty()) continue;
    Attempt one = attempt_with(entry, guess, kept, changing);
    if (!one.refusal.empty()) {
      last = std::move(one.refusal);
      if (one.no_number && !no_number) no_number = made(guess, one);
      continue;
    }
    // As many channels as go together.
    for (const Observable& observable : entry.factory.observables) {
      const auto& have = guess.channels;
      if (observable.role != Role::channel || std::find(have.begin(), have.end(), observable.name) != have.end())
        continue;
      OwnedSetup more = guess;
      more.channels.push_back(observable.name);
      if (Attempt larger = attempt_with(entry, more, kept, changing); larger.refusal.empty()) {
        guess = more;
        one = std::move(larger);
      }
    }
    return made(std::move(guess), one);
  }
  if (no_number) return std::move(*no_number);
  throw NothingSuits(last);
}

}  // namespace

TestSetup OwnedSetup::setup() const {
  TestSetup made;
  made.options = options;
  made.stress_measure = stress_measure;
  made.rows.count = count();
  for (const auto& [name, values] : abscissae) made.rows.abscissae.push_back({name, values});
  made.rows.channels = channels;
  made.rows.time = time;
  return made;
}

std::string OwnedSetup::words() const {
  std::vector<std::string> prescribed;
  for (const auto& [name, values] : abscissae)
    prescribed.push_back(fmt::format("{} from {:.3g} to {:.3g}", name, values.front(), values.back()));
  if (prescribed.empty() && !time.empty())
    prescribed.push_back(fmt::format("time from {:.3g} to {:.3g}", time.front(), time.back()));
  return fmt::format("{}, channels {}{}{}", fmt::join(prescribed, ", "), fmt::join(channels, ", "),
                     choices.empty() ? "" : "; ", words_of(choices));
}

std::vector<double> own_values(const TestDescription& description) {
  std::vector<double> own = initial_values(description.parameters);
  for (std::size_t k = 0; k < std::min(own.size(), description.nulls.size()); ++k)
    if (!std::isnan(description.nulls[k])) own[k] = description.nulls[k];
  return own;
}

TestCase synthetic_case(const plugins::Catalogue::Entry<TestFactory>& entry, std::uint64_t seed) {
  constexpr int patience = 4000;
  try {
    return found_case(entry, {}, patience, seed);
  } catch (const NothingSuits& problem) {
    throw NothingSuits(
        fmt::format("no rows could be made up that suit it ({}); give --experiment with a test of it", problem.what()));
  }
}

ChoiceCases choice_cases(const plugins::Catalogue::Entry<TestFactory>& entry, const TestCase& base,
                         std::uint64_t seed) {
  constexpr int patience = 400;
  const Choices& made = base.from->choices;
  const std::vector<Option>& options = entry.factory.options;
  ChoiceCases found;
  std::set<std::pair<std::string, std::string>> seen(made.begin(), made.end());
  const auto look_for = [&](const Choices& choices) -> std::string {
    try {
      TestCase one = found_case(entry, choices, patience, seed);
      seen.insert(one.from->choices.begin(), one.from->choices.end());
      found.cases.push_back(std::move(one));
      return {};
    } catch (const NothingSuits& problem) {
      return problem.what();
    }
  };
  if (combination_count(options) <= many_combinations && !base.test->describe().costly)
    for (const Choices& choices : combinations(options))
      if (choices != made) look_for(choices);
  // What no combination has: one word at a time, whatever goes with it.
  for (const Option& option : options)
    for (const std::string& word : option.choices) {
      if (seen.contains({option.name, word})) continue;
      if (const std::string why = look_for({{option.name, word}}); !why.empty())
        found.missed.push_back(fmt::format("{} = {} ({})", option.name, word, why));
    }
  return found;
}

}  // namespace tunica::conformance
