// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "conformance/test_properties.hpp"
#include "support/strip.hpp"
#include "support/tensors_only.hpp"
#include "support/tube.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

const std::vector<std::string> all_channels{"axial_force", "outer_diameter_stretch", "inner_diameter", "outer_diameter",
                                            "inner_diameter_stretch"};

struct Case {
  const char* name;
  std::vector<double> own;
};

class TubeConformance : public ::testing::TestWithParam<std::tuple<Case, bool, TestProperty>> {};

/// The opening angle at its null has a kink where fibres switch on at rest: its derivative there is tested apart.
TEST_P(TubeConformance, Holds) {
  const auto& [at, force_length, property] = GetParam();
  TubeSetup setup{.channels = all_channels};
  std::vector<double> pressure = evenly(0.5, 21, 12);
  if (force_length) {
    pressure = {2, 2, 2, 2, 12, 12, 12, 12, 5, 5, 8, 8};
    setup.axial_stretches = {1.05, 1.1, 1.15, 1.2, 1.2, 1.15, 1.1, 1.25, 1.3, 1.2, 1.1, 1.3};
  }
  const auto tube = make_tube(pressure, setup);
  EXPECT_EQ(property.check({*tube, *make_model("gho"), set_s, at.own}).counter_example, "");
  EXPECT_EQ(property.check({*tube, *make_model("hgo"), {15, 12, 0.6, 40}, at.own}).counter_example, "");
  EXPECT_EQ(property.check({*tube, *make_model("neo_hooke"), {150}, at.own}).counter_example, "");
}

INSTANTIATE_TEST_SUITE_P(All, TubeConformance,
                         ::testing::Combine(::testing::Values(Case{"Opened", {70, 0.01, 2, 0.04, 1.1}},
                                                              Case{"Tethered", {-30, 0.01, 8, -0.03, 0.9}},
                                                              Case{"Layered", {90, -0.02, 1, 0.02, 2.5}},
                                                              Case{"Thin", {15, -0.02, 4, -0.2, 0.6}}),
                                            ::testing::Bool(), ::testing::ValuesIn(test_properties())));

/// Every own parameter's column against differences of fourth order, with a step that suits it.
std::string own_columns_match_differences(const Test& tube, const Model& model, const std::vector<double>& p,
                                          const std::vector<double>& own) {
  const std::size_t rows = tube.rows().count * tube.rows().channels.size(), n = tube.rows().count;
  std::vector<double> jacobian((p.size() + own.size()) * rows);
  if (const Status status = tube.predict({model, p, own}, {{}, jacobian, {}, {}}); !status.ok()) return status.reason();
  constexpr double steps[] = {0.05, 1e-4, 1e-3, 1e-4, 1e-4};
  for (std::size_t j = 0; j < own.size(); ++j) {
    const auto at = [&](double steps_away) {
      std::vector<double> moved = own;
      moved[j] += steps_away * steps[j];
      return inflate(tube, model, p, moved).values;
    };
    const auto up = at(1), down = at(-1), up2 = at(2), down2 = at(-2);
    for (std::size_t i = 0; i < rows; ++i) {
      const double expected = (8 * (up[i] - down[i]) - (up2[i] - down2[i])) / (12 * steps[j]);
      double scale = 0;  // the largest entry of the column in the channel
      for (std::size_t k = i / n * n; k < i / n * n + n; ++k)
        scale = std::max(scale, std::abs(jacobian[(p.size() + j) * rows + k]));
      const double given = jacobian[(p.size() + j) * rows + i];
      if (!(std::abs(given - expected) <= 1e-6 * scale))
        return fmt::format("own parameter {}, value {}: {:.12g}, differences give {:.12g}", j, i, given, expected);
    }
  }
  return {};
}

TEST(Tube, HasExactDerivativesAtTheNullsToo) {
  // Walls whose fibres never switch, so that nothing has a kink at rest.
  Options always;
  always.set("fibre_switch", std::string("none"));
  for (const auto& stretches : {std::vector<double>{}, std::vector<double>{1.1, 1.15, 1.2, 1.25, 1.2}}) {
    const auto tube = make_tube({0.5, 4, 9, 13, 20}, {.channels = all_channels, .axial_stretches = stretches});
    EXPECT_EQ(own_columns_match_differences(*tube, *make_model("gho", always), set_s, bare_tube), "");
    EXPECT_EQ(own_columns_match_differences(*tube, *make_model("neo_hooke"), {150}, bare_tube), "");
  }
}

TEST(Tube, HasExactDerivativesWithASectorAsThickAsTheWall) {
  Options same;
  same.set("sector", std::string("same_thickness"));
  const auto tube = make_tube({0.5, 4, 9, 13, 20}, {.channels = all_channels, .options = same});
  for (const std::vector<double>& own : {bare_tube, {60, 0.01, 3, 0.05, 1.4}}) {
    EXPECT_EQ(own_columns_match_differences(*tube, *make_model("gho"), set_s, own), "");
    EXPECT_EQ(
        jacobian_matches_differences({*tube, *make_model("gho"), set_s, {60, 0.01, 3, 0.05, 1.4}}).counter_example, "");
  }
}

class TubeOpening : public ::testing::TestWithParam<double> {};

TEST_P(TubeOpening, GivesTheMeanOfBothSidesWhereTheAngleHasAKink) {
  const double ratio = GetParam();
  const auto model = make_model("gho");
  const auto tube = make_tube({5, 16});
  std::vector<double> jacobian(10 * 4);
  const std::vector<double> closed{0, 0, 0, 0, ratio};
  ASSERT_TRUE(tube->predict({*model, set_s, closed}, {{}, jacobian, {}, {}}).ok());
  const auto at = [&](double angle) { return inflate(*tube, *model, set_s, {angle, 0, 0, 0, ratio}).values; };
  const auto centre = at(0), above = at(1e-3), below = at(-1e-3), twice_above = at(2e-3), twice_below = at(-2e-3);
  bool kink = false;
  for (std::size_t i = 0; i < 4; ++i) {
    const double right = (4 * above[i] - twice_above[i] - 3 * centre[i]) / 2e-3;
    const double left = (3 * centre[i] - 4 * below[i] + twice_below[i]) / 2e-3;
    EXPECT_NEAR(jacobian[5 * 4 + i], 0.5 * (left + right), 1e-5 * std::abs(right)) << i;
    kink |= std::abs(right - left) > 1e-3 * std::abs(right);
  }
  EXPECT_TRUE(kink);
}

INSTANTIATE_TEST_SUITE_P(Layers, TubeOpening, ::testing::Values(1, 2.5, 0.4));

TEST(Tube, TensorsGiveWhatTheAxesGive) {
  const auto model = make_model("gho");
  const TensorsOnly tensors(make_model("gho"));
  const auto tube = make_tube(evenly(0, 22, 9), {.channels = all_channels});
  std::vector<double> values[2], jacobian[2], derivative[2];
  for (const std::size_t k : {0u, 1u}) {
    values[k].resize(45);
    jacobian[k].resize(10 * 45);
    derivative[k].resize(45);
    const Model& either = k == 0 ? *model : static_cast<const Model&>(tensors);
    const Status status =
        tube->predict({either, set_s, {{40, 0.01, 2, 0.05, 1.5}}}, {values[k], jacobian[k], derivative[k], {}});
    ASSERT_TRUE(status.ok()) << status.reason();
  }
  for (std::size_t i = 0; i < 45; ++i) EXPECT_NEAR(values[0][i], values[1][i], 1e-9 * (1 + std::abs(values[0][i])));
  for (std::size_t i = 0; i < 450; ++i)
    EXPECT_NEAR(jacobian[0][i], jacobian[1][i], 1e-7 * (1 + std::abs(jacobian[0][i]))) << i;
  for (std::size_t i = 0; i < 45; ++i)
    EXPECT_NEAR(derivative[0][i], derivative[1][i], 1e-7 * (1 + std::abs(derivative[0][i])));
}

}  // namespace
}  // namespace tunica::testing
