// SPDX-License-Identifier: Apache-2.0
// A term added to any model, against the model that is put together with it.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deformations.hpp"
#include "made_up_parts.hpp"
#include "models/composed.hpp"
#include "shelf.hpp"

namespace tunica::testing::added_term_test {
namespace {

using Values = std::vector<double>;
using Said = std::vector<std::pair<std::string, std::string>>;
using ::testing::Each;

std::unique_ptr<Model> with_term(std::unique_ptr<Model> base, const Said& said) {
  const auto& entry = catalogue().mechanisms().at("added_term");
  Options options = defaults(entry.factory.options);
  for (const auto& [key, value] : said) options.set(key, value);
  return plugins::wrap(entry, std::move(base), options);
}

void expect_same(const Model& a, const Model& b, const Values& parameters) {
  const Values C = random_deformations(20, 61);
  const auto found = evaluate(a, C, parameters, {.stress_dp = true});
  const auto expected = evaluate(b, C, parameters, {.stress_dp = true});
  EXPECT_LE(relative_difference(found.energy, expected.energy), 1e-12);
  EXPECT_LE(relative_difference(found.stress, expected.stress), 1e-12);
  EXPECT_LE(relative_difference(found.tangent, expected.tangent), 1e-12);
  EXPECT_LE(relative_difference(found.stress_dp, expected.stress_dp), 1e-12);
}

const std::string matrix = R"({"name": "m", "invariant": "I1", "law": "linear"})",
                  powers = R"({"name": "p", "invariant": "stretches"})";

/// To a sum of terms, and to one of principal stretches; a term of either kind.
TEST(AddedTermOfAModel, IsTheModelPutTogetherWithIt) {
  const auto expect_twin = [](const std::string& base, const std::string& term, const Said& said, Values parameters,
                              std::size_t parts) {
    const auto made = with_term(composed("[" + base + "]"), said);
    EXPECT_EQ(made->parts().size(), parts) << term;
    expect_same(*made, *composed("[" + base + ", " + term + "]"), parameters);
    parameters[parameters.size() - 2] = 1;  // as any other amplitude
    expect_same(*made, *composed("[" + base + ", " + term + "]"), parameters);
  };
  const std::string growing = R"({"name": "t", "invariant": "I2", "law": "exponential"})",
                    axial = R"({"name": "t", "invariant": "fibre", "family": "axial", "law": "exponential_square"})",
                    third = R"({"name": "t", "invariant": "stretches"})";
  const Said of_growing{{"invariant", "I2"}, {"law", "exponential"}},
      of_axial{{"invariant", "fibre"}, {"family", "axial"}, {"law", "exponential_square"}},
      of_third{{"invariant", "stretches"}};
  expect_twin(matrix, growing, of_growing, {20, 8, 0.7}, 2);
  expect_twin(matrix, axial, of_axial, {20, 8, 0.7}, 2);
  expect_twin(matrix, third, of_third, {20, 8, 3}, 0);
  expect_twin(powers, growing, of_growing, {20, 2.5, 8, 0.7}, 0);
  expect_twin(powers, third, of_third, {20, 2.5, 8, 3}, 0);
}

/// The base answers at the null, whether the term makes parts with it or not.
TEST(AddedTermOfAModel, IsNothingAtItsNull) {
  const Values C = random_deformations(2, 62);
  const auto base = [](bool parts) {
    return std::make_unique<MadeUpModel>(parts ? std::make_unique<MadeUpPart>() : nullptr);
  };
  for (const bool parts : {true, false}) {
    const auto made = with_term(base(parts), {{"invariant", "I2"}, {"law", "linear"}});
    EXPECT_THAT(evaluate(*made, C, {3, 5, 0}).energy, Each(42));
    EXPECT_THAT(evaluate(*made, C, {3, 5, 1}).energy, Each(::testing::Ne(42)));
  }
}

/// A curve is there though its slope at rest is nothing: C_rr from 1 to 1.3 with ψ'' rising from 0.
TEST(AddedTermOfAModel, IsACurveWhateverItsSlopeAtRest) {
  const std::string knots = "[0, 0.5, 1]";
  const auto made = with_term(composed("[" + matrix + "]"), {{"invariant", "I1"}, {"law", "spline"}, {"knots", knots}});
  const auto twin =
      composed("[" + matrix + R"(, {"name": "t", "invariant": "I1", "law": "spline", "knots": )" + knots + "}]");
  const Values C = random_deformations(5, 63), without{20, 0, 0, 0, 0}, bent{20, 0, 5, 10, 20};
  EXPECT_LE(relative_difference(evaluate(*made, C, bent).energy, evaluate(*twin, C, bent).energy), 1e-12);
  EXPECT_GT(relative_difference(evaluate(*made, C, bent).energy, evaluate(*twin, C, without).energy), 1e-3);
}

TEST(AddedTermOfAModel, IsDeclaredWithItsRange) {
  const MechanismFactory& mechanism = catalogue().mechanisms().at("added_term").factory;
  EXPECT_EQ(mechanism.plausible_max, 1e4);
  EXPECT_EQ(mechanism.plausible_effect, 2);
  ASSERT_EQ(mechanism.parameters.size(), 1u);
  EXPECT_EQ(mechanism.parameters[0].name, "mu");
  EXPECT_EQ(mechanism.parameters[0].min, 0);
}

}  // namespace
}  // namespace tunica::testing::added_term_test
