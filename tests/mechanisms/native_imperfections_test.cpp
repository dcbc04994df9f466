// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "shelf.hpp"

namespace tunica::testing::native_imperfections_test {
namespace {

/// A file that fixes or bounds the amplitude is read with the mechanism's declaration, and bound to the test's.
TEST(NativeImperfections, DeclareTheirParameterAsTheTestsDo) {
  std::size_t compared = 0;
  for (const auto& [id, entry] : catalogue().mechanisms()) {
    const MechanismFactory& mechanism = entry.factory;
    if (mechanism.native.empty()) continue;
    for (const std::string& type : mechanism.applies_to) {
      const auto& of_test = catalogue().tests().at(type).factory.parameters;
      for (std::size_t k = 0; k < mechanism.parameters.size(); ++k) {
        const Parameter& declared = mechanism.parameters[k];
        const std::string name = k == 0 ? mechanism.native : mechanism.native + "_" + declared.name;
        const auto native = std::ranges::find(of_test, name, &Parameter::name);
        ASSERT_NE(native, of_test.end()) << id << " of " << type;
        EXPECT_EQ(declared.unit, native->unit) << id;
        EXPECT_EQ(declared.min, native->min) << id;
        EXPECT_EQ(declared.max, native->max) << id;
        EXPECT_EQ(declared.initial, native->initial) << id;
        EXPECT_EQ(declared.scale, native->scale) << id;
        EXPECT_EQ(native->initial, k == 0 ? mechanism.null : 0.0) << id;
        ++compared;
      }
    }
    for (const Option& option : mechanism.options) {
      const auto& of_test = catalogue().tests().at(mechanism.applies_to.front()).factory.options;
      const auto same =
          std::find_if(of_test.begin(), of_test.end(), [&](const Option& o) { return o.name == option.name; });
      ASSERT_NE(same, of_test.end()) << id;
      EXPECT_EQ(option.min, same->min);
      EXPECT_EQ(option.max, same->max);
      EXPECT_EQ(option.fallback, same->fallback);
    }
  }
  EXPECT_EQ(compared, 20u) << "six mechanisms, five of them of both tubes, two of twisted ones as well, and five of "
                              "fields, two of them with a direction";
}

/// Every test type's parameter with a null has a mechanism that stands for it.
TEST(NativeImperfections, LeaveNoneOfTheTestsOut) {
  // What a file may free, and nobody looks for: how a membrane was clamped, and where a sphere touched.
  const std::set<std::pair<std::string, std::string>> freed_by_hand{{"bulge", "prestretch"},
                                                                    {"indentation", "contact_point"}};
  for (const auto& [type, entry] : catalogue().tests()) {
    // The shift by the temperature is no imperfection, and the set of a strip under a load is asked for by an option.
    if (type == "dynamic_mechanical" || type == "creep" || type == "loading_segments") continue;
    for (const Parameter& parameter : entry.factory.parameters) {
      if (freed_by_hand.contains({type, parameter.name})) continue;
      const auto& shelf = catalogue().mechanisms();
      EXPECT_TRUE(std::any_of(shelf.begin(), shelf.end(),
                              [&, t = type](const auto& on_shelf) {
                                const auto& [mechanism, tests] =
                                    std::tie(on_shelf.second.factory, on_shelf.second.factory.applies_to);
                                const bool nuisance =
                                    std::ranges::any_of(mechanism.parameters, [&](const Parameter& own) {
                                      return mechanism.native + "_" + own.name == parameter.name;
                                    });
                                return (mechanism.native == parameter.name || nuisance) &&
                                       std::find(tests.begin(), tests.end(), t) != tests.end();
                              }))
          << parameter.name << " of " << type;
    }
  }
}

}  // namespace
}  // namespace tunica::testing::native_imperfections_test
