// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "conformance/partners.hpp"
#include "conformance/test_cases.hpp"
#include "conformance/verdict.hpp"
#include "tunica/mechanism.hpp"

/// What a mechanism promises: nothing at its null, the bare object there bit for bit, and derivatives that are those of
/// what it does. What each means for an author: docs/plugin-check.md.
namespace tunica::conformance {

/// An amplitude off the null whose effect is no larger than rounding.
inline double next_to_the_null(const MechanismFactory& mechanism) {
  return mechanism.null +
         std::max(1e-15 * (mechanism.plausible_max - mechanism.null), 1e-15 * std::abs(mechanism.null));
}

/// A model inside a mechanism, and the bare one.
struct WrappedModel {
  MechanismFactory mechanism;  ///< its parameters those of the options in question
  std::shared_ptr<const Model> bare, with;
  std::vector<double> base;  ///< parameters of the bare one

  /// Those, the amplitude, and nuisances at their initial values.
  [[nodiscard]] std::vector<double> at(double amplitude) const;
};

/// A test inside a mechanism, and the bare one; of a mechanism that stands for a parameter of the test twice the same.
struct WrappedTest {
  MechanismFactory mechanism;
  std::shared_ptr<const Test> bare, with;
  std::size_t amplitude = 0;     ///< its number among the parameters of `with`
  std::vector<double> bare_own;  ///< parameters of `bare` where nothing is wrong
  std::vector<double> own;       ///< of `with`, at the null
  Material material;

  [[nodiscard]] std::vector<double> at(double value) const;
};

/// What is wrapped has the properties of its kind, but for those that `skip` says; the first that it breaks, by name.
template <class Subject, class Check, class Skip>
Verdict has_properties(std::string compared, const std::vector<PropertyOf<Subject>>& properties, const Check& check,
                       const Skip& skip) {
  std::size_t held = 0;
  for (const PropertyOf<Subject>& property : properties) {
    if (skip(property)) continue;
    Verdict one = check(property);
    if (!one.counter_example.empty()) {
      one.counter_example = fmt::format("{}: {}", property.name, one.counter_example);
      one.skipped.clear();
      one.note.clear();
      return one;
    }
    held += one.held();
  }
  return {.compared = std::move(compared), .note = fmt::format("{} properties", held)};
}

Verdict parameters_stand_behind_those_of_the_base(const WrappedModel& on, std::uint64_t seed = 20);
Verdict null_is_the_bare_model(const WrappedModel& on, std::uint64_t seed = 20);
Verdict limit_is_the_bare_model(const WrappedModel& on, std::uint64_t seed = 20);
Verdict base_derivatives_at_the_null_are_those_of_the_base(const WrappedModel& on, std::uint64_t seed = 20);
Verdict derivative_at_the_null_matches_differences(const WrappedModel& on, std::uint64_t seed = 22);
Verdict amplitude_has_an_effect(const WrappedModel& on, std::uint64_t seed = 22);
Verdict wrapped_model_is_a_model(const WrappedModel& on, std::uint64_t seed = 20);

Verdict parameters_stand_behind_those_of_the_base(const WrappedTest& on, std::uint64_t seed = 0);
Verdict null_is_the_bare_test(const WrappedTest& on, std::uint64_t seed = 0);
Verdict limit_is_the_bare_test(const WrappedTest& on, std::uint64_t seed = 0);
Verdict derivative_at_the_null_matches_differences(const WrappedTest& on, std::uint64_t seed = 0);
Verdict amplitude_has_an_effect(const WrappedTest& on, std::uint64_t seed = 0);
Verdict wrapped_test_is_a_test(const WrappedTest& on, std::uint64_t seed = 0);

const std::vector<PropertyOf<WrappedModel>>& wrapped_model_properties();
const std::vector<PropertyOf<WrappedTest>>& wrapped_test_properties();

}  // namespace tunica::conformance
