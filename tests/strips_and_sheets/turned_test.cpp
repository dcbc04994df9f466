// SPDX-License-Identifier: Apache-2.0
// Strips and sheets that are cut at an angle to the axes of the material, and kept from shearing.
#include <cmath>

#include <gtest/gtest.h>

#include "conformance/test_properties.hpp"
#include "support/sheet.hpp"
#include "support/strip.hpp"

namespace tunica::testing::turned_test {
using namespace conformance;
namespace {

const std::vector<double> four_fibres{10, 20, 0.5, 40, 5, 0.3, 8, 0.7};
const std::vector<double> yeoh{150, -2, 0.1};
const std::vector<double> around{1.05, 1.2, 1.35, 1.5}, less{1.3, 1.1, 1.25, 1.02};

Columns both(const std::vector<double>& circumferential, const std::vector<double>& axial) {
  return {{"stretch_circumferential", circumferential}, {"stretch_axial", axial}};
}

/// A matrix and one family at the last parameter from the axial direction: m_mu, f_k, f_theta.
std::unique_ptr<Model> one_family() {
  Options options;
  options.set("terms", R"([{"name": "m", "invariant": "I1", "law": "linear"},
    {"name": "f", "invariant": "fibre", "family": "single", "law": "quadratic", "fibre_switch": "none"}])");
  return make_model("composed", options);
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], tolerance * (1 + std::abs(expected[i]))) << i;
}

TEST(TurnedBiaxial, SwapsItsAxesAtARightAngle) {
  const auto model = make_model("four_fibre");
  const auto turned = stresses(*make_sheet("general", both(around, less), {.angle = 90}), *model, four_fibres),
             straight = stresses(
                 *make_sheet("general", both(less, around), {.channels = {"stress_axial", "stress_circumferential"}}),
                 *model, four_fibres);
  expect_near(turned, straight, 1e-12);
  EXPECT_GT(std::abs(straight[1] - straight[5]), 1);  // the axes differ
}

TEST(TurnedBiaxial, IsTheSameSheetOfAnIsotropicMaterial) {
  const auto model = make_model("yeoh");
  for (const char* protocol : {"equibiaxial", "pure_shear"}) {
    const Columns columns{{"stretch", around}};
    expect_near(stresses(*make_sheet(protocol, columns, {.angle = 37}), *model, yeoh),
                stresses(*make_sheet(protocol, columns), *model, yeoh), 1e-12);
  }
}

// One family at θ − angle from the axial axis of the sheet: F M = (λt sin, λz cos), and with ψ = k/2 (|F M|² − 1)²
//   σ_a = μ (λ_a² − λ_r²) + 2 k (|F M|² − 1) (F M)_a²,   σ_tz = 2 k (|F M|² − 1) (F M)_t (F M)_z.
TEST(TurnedBiaxial, OfOneFamilyHasItsClosedForm) {
  const double mu = 12, k = 30, theta = 65, angle = 25, relative = (theta - angle) * M_PI / 180;
  const auto sheet = make_sheet("general", both(around, less), {.angle = angle});
  ASSERT_EQ(sheet->describe().diagnostics, (std::vector<std::string>{"normal_stretch", "shear_stress"}));
  std::vector<double> values(8), diagnostics(8);
  const std::vector<double> p{mu, k, theta};
  ASSERT_TRUE(sheet->predict({*one_family(), p, {}}, {values, {}, {}, diagnostics}).ok());
  for (std::size_t i = 0; i < 4; ++i) {
    const double t = around[i] * std::sin(relative), z = less[i] * std::cos(relative), r = 1 / (around[i] * less[i]),
                 pull = 2 * k * (t * t + z * z - 1);
    EXPECT_NEAR(values[i], mu * (around[i] * around[i] - r * r) + pull * t * t, 1e-11);
    EXPECT_NEAR(values[4 + i], mu * (less[i] * less[i] - r * r) + pull * z * z, 1e-11);
    EXPECT_NEAR(diagnostics[i], r, 1e-14);
    EXPECT_NEAR(diagnostics[4 + i], pull * t * z, 1e-11);
  }
}

TEST(TurnedBiaxial, RelaxesAsTheStraightSheetOfAnIsotropicMaterialDoes) {
  const auto viscous = plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), make_model("neo_hooke"), {});
  const std::vector<double> p{12, 0.8, 5}, held(5, 1.4), time{0, 0.5, 2, 10, 200};
  const auto turned = make_sheet("equibiaxial", {{"stretch", held}}, {.time = time, .angle = 50});
  expect_near(stresses(*turned, *viscous, p),
              stresses(*make_sheet("equibiaxial", {{"stretch", held}}, {.time = time}), *viscous, p), 1e-12);
  EXPECT_FALSE(turned->describe().path_derivatives);
}

TEST(TurnedStrip, SwapsItsAxesAtARightAngle) {
  const auto model = make_model("four_fibre");
  for (const double angle : {90., -90., 270.})
    expect_near(predict(*make_strip(around, {.direction = "axial", .angle = angle}), *model, four_fibres).values,
                predict(*make_strip(around, {.direction = "circumferential"}), *model, four_fibres).values, 1e-9);
}

TEST(TurnedStrip, IsTheSameStripOfAnIsotropicMaterial) {
  const auto model = make_model("yeoh");
  const StripSetup turned{.channels = {"stress", "transverse_stretch"}, .angle = 37};
  const StripSetup straight{.channels = turned.channels};
  expect_near(predict(*make_strip(around, turned), *model, yeoh).values,
              predict(*make_strip(around, straight), *model, yeoh).values, 1e-10);
}

// The family seen from the strip is at θ − angle, whichever axis the strip was cut along before it was turned.
TEST(TurnedStrip, SeesOneFamilyAtTheDifferenceOfTheAngles) {
  const auto model = one_family();
  for (const char* direction : {"circumferential", "axial"}) {
    const StripSetup straight{.direction = direction, .channels = {"stress", "transverse_stretch"}};
    StripSetup turned = straight;
    turned.angle = 25;
    const Prediction found = predict(*make_strip(around, turned), *model, {12, 30, 65}),
                     expected = predict(*make_strip(around, straight), *model, {12, 30, 40}),
                     other = predict(*make_strip(around, straight), *model, {12, 30, 90});
    ASSERT_TRUE(found.status.ok()) << found.status.reason();
    expect_near(found.values, expected.values, 1e-9);
    EXPECT_GT(std::abs(found.values[3] - other.values[3]), 1) << "the sense of the turn matters";
  }
}

TEST(TurnedStrip, AddsItsAngleToTheMisalignment) {
  const auto model = make_model("four_fibre");
  // A misalignment turns the axial strip from z towards t as the angle does.
  expect_near(predict(*make_strip(around, {.direction = "axial", .angle = 8}), *model, four_fibres, 4).values,
              predict(*make_strip(around, {.direction = "axial"}), *model, four_fibres, 12).values, 1e-10);
  expect_near(
      predict(*make_strip(around, {.direction = "circumferential", .angle = -8}), *model, four_fibres, 4).values,
      predict(*make_strip(around, {.direction = "circumferential"}), *model, four_fibres, 12).values, 1e-10);
}

// One family at an angle makes no mirror images of misalignments to both sides: the derivative is there at 0.
TEST(TurnedStrip, KnowsTheDerivativeByAMisalignmentOfOneFamily) {
  for (const char* direction : {"circumferential", "axial"}) {
    const auto strip = make_strip(around, {.direction = direction, .channels = {"stress", "transverse_stretch"}});
    const auto model = one_family();
    const Simulation simulation{*strip, *model, {12, 30, 65}, {0}};
    EXPECT_EQ(jacobian_matches_differences(simulation).counter_example, "");
    EXPECT_EQ(values_do_not_depend_on_the_other_outputs(simulation).counter_example, "");
  }
  const Prediction found = predict(*make_strip(around), *one_family(), {12, 30, 65}, 0, true);
  EXPECT_GT(std::abs(found.jacobian[3 * around.size()]), 0.1);
}

TEST(TurnedStrip, LeavesTransverseStabilityToStripsAlongAnAxis) {
  EXPECT_TRUE(make_strip(around)->describe().free_strip_axis.has_value());
  EXPECT_FALSE(make_strip(around, {.angle = 20})->describe().free_strip_axis.has_value());
  EXPECT_FALSE(make_strip(around, {.angle = 20})->describe().path_derivatives);
}

/// Every property of a test, for materials with fibres in one direction, in two, and across the wall.
class Turned : public ::testing::TestWithParam<TestProperty> {};

TEST_P(Turned, KeepsEveryPropertyOfATest) {
  const auto gho = make_model("gho"), single = one_family(), heart = make_model("holzapfel_ogden");
  const std::vector<double> of_gho{18.668, 0.1367, 24.905, 0.2912, 46.44}, of_single{12, 30, 65},
      of_heart{2, 1, 5, 1.5, 2, 1, 0.5, 1, 70};
  const auto sheet = make_sheet("general", both(evenly(1.05, 1.4, 9), evenly(1.3, 1.02, 9)),
                                {.measure = "first_piola_kirchhoff", .angle = 25});
  const auto shear = make_sheet("pure_shear", {{"stretch", evenly(1.05, 1.4, 9)}},
                                {.channels = {"stress"}, .measure = "second_piola_kirchhoff", .angle = -130});
  const auto strip = make_strip(evenly(1.05, 1.4, 9), {.channels = {"stress", "transverse_stretch"}, .angle = 25});
  for (const tunica::Test* test : {sheet.get(), shear.get(), strip.get()}) {
    const std::vector<double> own(test->describe().parameters.size(), 2.0);
    EXPECT_EQ(GetParam().check({*test, *gho, of_gho, own}).counter_example, "");
    EXPECT_EQ(GetParam().check({*test, *single, of_single, own}).counter_example, "");
    EXPECT_EQ(GetParam().check({*test, *heart, of_heart, own}).counter_example, "");
  }
}

INSTANTIATE_TEST_SUITE_P(All, Turned, ::testing::ValuesIn(test_properties()),
                         [](const auto& at) { return std::string(at.param.name); });

}  // namespace
}  // namespace tunica::testing::turned_test
