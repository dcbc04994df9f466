// SPDX-License-Identifier: Apache-2.0
// A ring between pins against the strip, the published length of its centreline, Ericksen's straightened sector and
// differences.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "data/written_file.hpp"
#include "rigs/rigs.hpp"
#include "support/strip.hpp"

namespace tunica::testing::ring_test {
namespace {

using std::numbers::pi;
using ::testing::HasSubstr;
using Sizes = std::vector<std::pair<std::string, Option::Value>>;

// A porcine aorta's sizes.
constexpr double Ri = 6.325, H = 1.84, w = 7.2, a = 2.4, Rc = Ri + H / 2;
const std::vector<double> distances{13, 16, 20, 25};
const std::vector<double> wall{18.7, 0.14, 24.9, 0.29, 46.4};

std::unique_ptr<Test> make_ring(const std::string& layers = "centreline", const std::vector<double>& at = distances) {
  return make_rig("ring", {{"inner_radius", Ri}, {"thickness", H}, {"width", w}, {"pin_radius", a}, {"wall", layers}},
                  {{"pin_distance", at}}, {"force", "stretch"});
}

// Of an isotropic wall λr² λ = 1, and the length is the root of a cubic: π H x³ + 2 (π a + d) x² − 2π Rc = 0 with x =
// λr (Mahutga, Schoephoerster, Barocas 2021).
TEST(Ring, OfAnIsotropicWallHasThePublishedLength) {
  const auto found = predicted(*make_ring(), *make_model("mooney_rivlin"), {30, 10});
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double x = 1 / std::sqrt(found[4 + i]);
    EXPECT_NEAR(pi * H * x * x * x + 2 * (pi * a + distances[i]) * x * x, 2 * pi * Rc, 1e-9);
  }
}

// Whatever the model: both legs are free strips at the stretch of the centreline, which is as long as the path around
// the pins.
TEST(Ring, IsTwoStrips) {
  for (const auto& [type, p] : {std::pair("gho", wall), std::pair("yeoh", std::vector<double>{20, 1, 0.2})}) {
    const auto model = make_model(type);
    const auto found = predicted(*make_ring(), *model, p);
    const std::vector<double> stretch(found.begin() + 4, found.end());
    const auto strip = predict(
        *make_strip(stretch, {"circumferential", {"stress", "normal_stretch"}, "first_piola_kirchhoff"}), *model, p);
    ASSERT_TRUE(strip.status.ok());
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(found[i] / (2 * w * H * strip.values[i]), 1, 1e-9);
      EXPECT_NEAR(2 * pi * Rc * stretch[i], 2 * distances[i] + 2 * pi * (a + 0.5 * H * strip.values[4 + i]), 1e-9);
    }
  }
}

// Ericksen (1954), a sector that is straightened: a layer at R is stretched by Λ/R with Λ = λ Rc. Neo-Hookean legs bear
// F = 2 w μ ∫ (Λ/R − R²/Λ²) dR.
TEST(Ring, StraightensAsASectorDoes) {
  const double mu = 60, Ro = Ri + H;
  const auto model = make_model("neo_hooke");
  const auto found = predicted(*make_ring("straightened"), *model, {mu}), thin = predicted(*make_ring(), *model, {mu});
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double L = found[4 + i] * Rc;
    EXPECT_NEAR(found[i] / (2 * w * mu * (L * std::log(Ro / Ri) - (Ro * Ro * Ro - Ri * Ri * Ri) / (3 * L * L))), 1,
                1e-9);
    EXPECT_EQ(found[4 + i], thin[4 + i]);
    EXPECT_NEAR(found[i], thin[i], 0.01 * thin[i]);
    EXPECT_NE(found[i], thin[i]);
  }
}

// The thickest wall, H/Rc = 0.5, at λ = 1.1, which the root of 2π Rc λ = 2 d + 2π (a + ½ H/√λ) is. The term of c01
// bears F = 4 w c01 ∫ (1 − R³/Λ³) dR.
TEST(Ring, StraightensATermByItsCurvature) {
  constexpr double stretch = 1.1, inner = 6, thick = 4, centre = 8, pin = 2;
  const double d = pi * (centre * stretch - pin - 0.5 * thick / std::sqrt(stretch));
  const auto gain = [&](const std::vector<double>& p) {
    const auto force = [&](const std::string& layers) {
      return predicted(
          *make_rig(
              "ring",
              {{"inner_radius", inner}, {"thickness", thick}, {"width", w}, {"pin_radius", pin}, {"wall", layers}},
              {{"pin_distance", {d}}}, {"force"}),
          *make_model("mooney_rivlin"), p)[0];
    };
    return force("straightened") / force("centreline") - 1;
  };
  const double L = stretch * centre, outer = inner + thick;
  const double first = (L * std::log(outer / inner) - (std::pow(outer, 3) - std::pow(inner, 3)) / (3 * L * L)) / thick,
               second = 1 - (std::pow(outer, 4) - std::pow(inner, 4)) / (4 * L * L * L * thick);
  EXPECT_NEAR(gain({30, 0}), first / (stretch - 1 / (stretch * stretch)) - 1, 1e-9);
  EXPECT_NEAR(gain({0, 30}), second / (1 - std::pow(stretch, -3)) - 1, 1e-9);
  EXPECT_NEAR(gain({30, 0}), 0.024, 5e-4);
  EXPECT_NEAR(gain({0, 30}), -0.19, 5e-3);
}

// At the length of its centreline the ring bears nothing.
TEST(Ring, BeginsWhereItIsTaut) {
  const double taut = pi * (Ri - a);
  const auto found = predicted(*make_ring("centreline", {taut, 20}), *make_model("gho"), wall);
  EXPECT_NEAR(found[0], 0, 1e-9);
  EXPECT_NEAR(found[2], 1, 1e-12);
}

TEST(Ring, HasExactDerivatives) {
  for (const char* layers : {"centreline", "straightened"})
    for (const auto& [type, p] : {std::pair("gho", wall), std::pair("mooney_rivlin", std::vector<double>{30, 10})})
      expect_exact_derivatives(*make_ring(layers), *make_model(type), p, {});
}

TEST(Ring, RefusesWhatIsNoRing) {
  const auto refusal = [](double inner, double thickness, double width, double pin, const RigColumns& columns) {
    return message_of<InputError>([&] {
      (void)make_rig("ring", {{"inner_radius", inner}, {"thickness", thickness}, {"width", width}, {"pin_radius", pin}},
                     columns, {"force"});
    });
  };
  const RigColumns far{{"pin_distance", {30}}};
  EXPECT_THAT(refusal(6, 1, 0, 2, far), HasSubstr("\"width\" is 0 mm, and it is above 0"));
  EXPECT_THAT(refusal(6, 1, 5, 7, far), HasSubstr("give radii, not diameters"));
  EXPECT_THAT(refusal(3, 2.5, 5, 1, far), HasSubstr("beyond a ratio of 0.5 bending decides"));
  EXPECT_THAT(refusal(6, 1, 5, 2, {{"pin_distance", {20, 8}}}),
              HasSubstr("row 2 (pin_distance 8 mm), and the ring is not straight before"));
  EXPECT_THAT(refusal(6, 1, 5, 2, {}), HasSubstr("no column is mapped to 'pin_distance'"));
}

}  // namespace
}  // namespace tunica::testing::ring_test
