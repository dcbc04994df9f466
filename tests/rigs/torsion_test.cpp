// SPDX-License-Identifier: Apache-2.0
// Twisted cylinders against Rivlin's closed forms, the work that twisting does, the tube without twist, and
// differences.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "data/written_file.hpp"
#include "rigs/rigs.hpp"
#include "support/tube.hpp"

namespace tunica::testing::torsion_test {
namespace {

using std::numbers::pi;
using ::testing::HasSubstr;

constexpr double degree = pi / 180;
const std::vector<double> twists{0, 1, 3, -4};  // deg/mm
const std::vector<double> wall{18.7, 0.14, 24.9, 0.29, 46.4};

// A solid cylinder of Mooney's rubber: M = π Ro⁴ φ (c10 + c01), N = −½ π Ro⁴ φ² (c10 + 2 c01) at its unloaded length
// (Rivlin, Phil. Trans. R. Soc. A 242:173, 1949). Stretched and neo-Hookean: M = π Ro⁴ φ c10/λ,
// N = 2π c10 [(λ − 1/λ²) Ro² − φ² Ro⁴/(4λ²)].
TEST(Torsion, OfASolidRubberCylinderIsRivlins) {
  const double c10 = 40, c01 = 15, Ro = 4, lambda = 1.3;
  const auto channels = std::vector<std::string>{"torque", "axial_force", "outer_diameter"};
  const auto free = predicted(*make_rig("torsion", {{"outer_radius", Ro}}, {{"twist", twists}}, channels),
                              *make_model("mooney_rivlin"), {c10, c01});
  const auto stretched =
      predicted(*make_rig("torsion", {{"outer_radius", Ro}, {"axial_stretch", lambda}}, {{"twist", twists}}, channels),
                *make_model("neo_hooke"), {2 * c10});
  for (std::size_t i = 0; i < twists.size(); ++i) {
    const double phi = twists[i] * degree, R4 = std::pow(Ro, 4);
    EXPECT_NEAR(free[i], pi * R4 * phi * (c10 + c01), 1e-9);
    EXPECT_NEAR(free[4 + i], -0.5 * pi * R4 * phi * phi * (c10 + 2 * c01), 1e-9);
    EXPECT_NEAR(free[8 + i], 2 * Ro, 1e-12);
    EXPECT_NEAR(stretched[i], pi * R4 * phi * c10 / lambda, 1e-9);
    EXPECT_NEAR(stretched[4 + i],
                2 * pi * c10 * ((lambda - 1 / (lambda * lambda)) * Ro * Ro - phi * phi * R4 / (4 * lambda * lambda)),
                1e-8);
    EXPECT_NEAR(stretched[8 + i], 2 * Ro / std::sqrt(lambda), 1e-12);
  }
}

/// Energy per unloaded length less the work of the pressure, of a tube whose inner radius is ri.
double potential(const Model& model, const std::vector<double>& p, double Ri, double Ro, double ri, double lambda,
                 double phi, double pressure) {
  constexpr int steps = 400;
  double sum = 0;
  for (int k = 0; k <= steps; ++k) {  // Simpson's rule in R²
    const double R2 = Ri * Ri + (Ro * Ro - Ri * Ri) * k / steps, r2 = ri * ri + (R2 - Ri * Ri) / lambda;
    const std::vector<double> C{
        r2 / R2, lambda * lambda + r2 * phi * phi, R2 / (r2 * lambda * lambda), r2 * phi / std::sqrt(R2), 0, 0};
    double W = 0;
    EXPECT_TRUE(model.evaluate({1, C, p, {}, {}}, {{&W, 1}, {}, {}, {}, {}}).ok());
    sum += W * (k == 0 || k == steps ? 1 : k % 2 == 1 ? 4 : 2);
  }
  return pi * (Ro * Ro - Ri * Ri) * sum / (3 * steps) - pressure * pi * ri * ri * lambda;
}

// The tube is stationary in its inner radius; twisting and stretching it do the work that the potential gains: torque
// and reduced force are its slopes. Fibres in two families, and in one, which twists a tube that is inflated.
TEST(Torsion, DoesTheWorkThatThePotentialGains) {
  Options terms;
  terms.set("terms", std::string(R"([{"name": "m", "invariant": "I1", "law": "linear"},
    {"name": "f", "invariant": "fibre", "family": "single", "law": "exponential_square", "fibre_switch": "none"}])"));
  const double Ri = 3.71, Ro = 5.77, lambda = 1.2, pressure = 12, h = 2e-5;
  for (const auto& [model, p] : {std::pair(make_model("gho"), wall),
                                 std::pair(make_model("composed", terms), std::vector<double>{20, 25, 0.6, 35})}) {
    const auto test = make_rig("torsion",
                               {{"inner_radius", Ri},
                                {"outer_radius", Ro},
                                {"axial_stretch", lambda},
                                {"pressure", pressure},
                                {"gauss_points", std::int64_t{60}}},
                               {{"twist", twists}}, {"torque", "axial_force", "inner_diameter"});
    const auto found = predicted(*test, *model, p);
    for (std::size_t i = 0; i < twists.size(); ++i) {
      const double phi = twists[i] * degree, ri = found[8 + i] / 2;
      const auto at = [&](double dr, double dl, double dphi) {
        return potential(*model, p, Ri, Ro, ri + dr, lambda + dl, phi + dphi, pressure);
      };
      EXPECT_NEAR((at(h, 0, 0) - at(-h, 0, 0)) / (2 * h), 0, 5e-4) << twists[i];
      EXPECT_NEAR((at(0, 0, h) - at(0, 0, -h)) / (2 * h), found[i], 2e-6 * (1000 + std::abs(found[i])));
      EXPECT_NEAR((at(0, h, 0) - at(0, -h, 0)) / (2 * h), found[4 + i], 2e-6 * (1000 + std::abs(found[4 + i])));
    }
  }
}

TEST(Torsion, WithoutTwistIsTheLongTube) {
  const std::vector<double> pressures{0, 5, 12, 20};
  const auto channels = std::vector<std::string>{"axial_force", "outer_diameter", "inner_diameter_stretch"};
  const RigColumns columns{{"twist", {0, 0, 0, 0}}, {"pressure", pressures}};
  const std::vector<std::pair<std::string, Option::Value>> sizes{
      {"inner_radius", 3.71}, {"thickness", 2.06}, {"axial_stretch", 1.2}};
  const auto model = make_model("gho");
  const auto twisted = predicted(*make_rig("torsion", sizes, columns, channels), *model, wall);
  const auto tube =
      predicted(*make_rig("thick_wall_pressurisation", sizes, {{"pressure", pressures}}, channels), *model, wall);
  for (std::size_t i = 0; i < twisted.size(); ++i) EXPECT_NEAR(twisted[i] / tube[i], 1, 1e-8);
}

TEST(Torsion, HasExactDerivatives) {
  const std::vector<std::string> all{
      "torque", "axial_force", "outer_diameter", "inner_diameter", "outer_diameter_stretch", "inner_diameter_stretch"};
  const RigColumns columns{
      {"axial_stretch", {1.05, 1.1, 1.2, 1.3}}, {"twist", {1, 3, 5, -4}}, {"pressure", {0, 4, 8, 12}}};
  for (const auto& [type, p] : {std::pair("gho", wall), std::pair("mooney_rivlin", std::vector<double>{40, 15})})
    expect_exact_derivatives(*make_rig("torsion", {{"inner_radius", 3.}, {"thickness", 1.}}, columns, all),
                             *make_model(type), p, {0.02, 0.1});
  expect_exact_derivatives(
      *make_rig("torsion", {{"outer_radius", 3.}, {"length", 12.}},
                {{"twist_angle", {10, 30, 60}}, {"axial_stretch", {1.05, 1.1, 1.2}}}, {"torque", "axial_force"}),
      *make_model("gho"), wall, {0.02});
}

TEST(Torsion, RefusesWhatIsNoSpecimen) {
  using Sizes = std::vector<std::pair<std::string, Option::Value>>;
  const auto refusal = [](const Sizes& sizes, const RigColumns& columns, const char* channel) {
    return message_of<InputError>([&] { (void)make_rig("torsion", sizes, columns, {channel}); });
  };
  const RigColumns twist{{"twist", {1}}};
  const Sizes solid{{"outer_radius", 3.}};
  EXPECT_THAT(refusal({{"inner_radius", 3.}}, twist, "torque"), HasSubstr("give \"outer_radius\" alone"));
  EXPECT_THAT(refusal({{"inner_radius", 3.}, {"outer_radius", 2.}}, twist, "torque"), HasSubstr("leave no wall"));
  EXPECT_THAT(refusal(solid, {}, "torque"), HasSubstr("no column is mapped to 'twist'"));
  EXPECT_THAT(refusal(solid, {{"twist_angle", {1}}}, "torque"), HasSubstr("\"length\" is missing"));
  EXPECT_THAT(refusal(solid, {{"twist_angle", {1}}, {"twist", {1}}}, "torque"),
              HasSubstr("both 'twist' and 'twist_angle'"));
  EXPECT_THAT(refusal(solid, twist, "inner_diameter"), HasSubstr("the cylinder is solid"));
  EXPECT_THAT(refusal(solid, {{"twist", {1}}, {"pressure", {2}}}, "torque"),
              HasSubstr("row 1 has a pressure of 2 kPa"));
  EXPECT_THAT(
      refusal({{"outer_radius", 3.}, {"axial_stretch", 1.2}}, {{"twist", {1}}, {"axial_stretch", {1.1}}}, "torque"),
      HasSubstr("the axial stretch is given twice"));
  EXPECT_THAT(refusal({{"outer_radius", 3.}, {"thickness", 1.}, {"pressure", 2.}}, {{"twist", {1}}, {"pressure", {1}}},
                      "torque"),
              HasSubstr("the pressure is given twice"));
  EXPECT_THAT(refusal(solid, {{"twist", {1}}, {"axial_stretch", {-1}}}, "torque"),
              HasSubstr("row 1 has axial stretch -1; a stretch is positive"));
}

}  // namespace
}  // namespace tunica::testing::torsion_test
