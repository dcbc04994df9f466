// SPDX-License-Identifier: Apache-2.0
// A strip whose rest length grows, against what its formula says of the bare strip: λ = m/p, p = 1 + s (Λ − 1), force
// over the section of before.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subject.hpp"

namespace tunica::testing::permanent_set_test {
namespace {

using Values = std::vector<double>;
using ::testing::HasSubstr;

constexpr double s = 0.2;
/// Up, down beyond what is left of the slack, and up beyond the first turn.
const Values loop{1.05, 1.2, 1.5, 1.3, 1.15, 1.08, 1.02, 1.4, 1.6, 1.3};
const Values largest{1.05, 1.2, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.6, 1.6};

Values values_of(const Test& test, const Values& own) {
  const auto material = make_model("gho");
  Values values(test.rows().channels.size() * test.rows().count);
  const Status status = test.predict({*material, set_s, own}, {values, {}, {}, {}});
  EXPECT_TRUE(status.ok()) << status.reason();
  return values;
}

class PermanentSet : public ::testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(PermanentSet, IsTheStripAtTheStretchThatTheMaterialFeels) {
  const auto& [measure, power] = GetParam();
  Values felt;
  for (std::size_t i = 0; i < loop.size(); ++i) felt.push_back(std::max(1.0, loop[i] / (1 + s * (largest[i] - 1))));
  const std::vector<std::string> channels{"stress", "transverse_stretch"};
  const Values bare = values_of(*make_strip(felt, {.channels = channels, .measure = measure}), {0});
  const auto test = wrapped_test("permanent_set", make_strip(loop, {.channels = channels, .measure = measure}));
  const Values found = values_of(*test, {0, s});
  std::size_t slack = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const double rest = 1 + s * (largest[i] - 1);
    slack += loop[i] < rest;
    EXPECT_NEAR(found[i], loop[i] < rest ? 0 : bare[i] * std::pow(rest, power), 1e-10 * std::abs(bare[i])) << i;
    const std::size_t across = loop.size() + i;
    EXPECT_NEAR(found[across], bare[across] / std::sqrt(rest), 1e-10) << i;
  }
  EXPECT_EQ(slack, 2u);
}

/// d/ds by central differences of what it predicts; slack rows stay slack.
TEST_P(PermanentSet, HasTheDerivativeOfItsPredictionAlongALoop) {
  const auto test = wrapped_test(
      "permanent_set", make_strip(loop, {.channels = {"transverse_stretch", "stress"}, .measure = GetParam().first}));
  const auto material = make_model("gho");
  const std::size_t size = 2 * loop.size(), columns = set_s.size() + 2;
  Values values(size), jacobian(columns * size);
  ASSERT_TRUE(test->predict({*material, set_s, Values{0, s}}, {values, jacobian, {}, {}}).ok());
  constexpr double h = 1e-5;
  const Values up = values_of(*test, {0, s + h}), down = values_of(*test, {0, s - h});
  for (std::size_t i = 0; i < size; ++i) {
    const double difference = (up[i] - down[i]) / (2 * h);
    EXPECT_NEAR(jacobian[(columns - 1) * size + i], difference, 1e-6 * (1 + std::abs(difference))) << i;
  }
  for (std::size_t j = 0; j < set_s.size(); ++j) {
    Values moved = set_s;
    const double step = 1e-6 * set_s[j];
    moved[j] += step;
    Values there(size);
    ASSERT_TRUE(test->predict({*material, moved, Values{0, s}}, {there, {}, {}, {}}).ok());
    for (std::size_t i = 0; i < size; ++i)
      EXPECT_NEAR(jacobian[j * size + i], (there[i] - values[i]) / step,
                  1e-3 * (1e-3 + std::abs(jacobian[j * size + i])))
          << j << ' ' << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Measures, PermanentSet,
                         ::testing::Values(std::pair{"cauchy", 0.0}, std::pair{"first_piola_kirchhoff", -1.0},
                                           std::pair{"second_piola_kirchhoff", -2.0}),
                         [](const auto& at) { return std::string(at.param.first); });

/// At its null it is the bare strip along a loop too, bit for bit; and at 0 the derivative is that from the right.
TEST(PermanentSetOfALoop, VanishesAtItsNull) {
  const auto test = wrapped_test("permanent_set", make_strip(loop)), bare = make_strip(loop);
  EXPECT_EQ(values_of(*test, {0, 0}), values_of(*bare, {0}));
  const auto material = make_model("gho");
  Values values(loop.size()), jacobian((set_s.size() + 2) * loop.size());
  ASSERT_TRUE(test->predict({*material, set_s, Values{0, 0}}, {values, jacobian, {}, {}}).ok());
  constexpr double h = 1e-6;
  const Values at = values_of(*test, {0, h});
  for (std::size_t i = 0; i < loop.size(); ++i)
    EXPECT_NEAR(jacobian[(set_s.size() + 1) * loop.size() + i], (at[i] - values[i]) / h, 1e-3 * std::abs(values[i]));
}

/// A strip pushed below its first length, never stretched, has no set.
TEST(PermanentSetOfALoop, LeavesCompressionAlone) {
  const Values pushed{0.95, 0.9, 0.97};
  EXPECT_EQ(values_of(*wrapped_test("permanent_set", make_strip(pushed)), {0, s}), values_of(*make_strip(pushed), {0}));
}

TEST(PermanentSetOfALoop, NeedsAStretch) {
  try {
    static_cast<void>(wrapped_test("permanent_set", make_tube({1, 8})));
    FAIL();
  } catch (const InputError& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("permanent_set: the test's data have no 'stretch', which the mechanism "
                                          "corrects; map a column to 'stretch', or take the mechanism out"));
  }
}

}  // namespace
}  // namespace tunica::testing::permanent_set_test
