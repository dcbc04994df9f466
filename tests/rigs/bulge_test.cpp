// SPDX-License-Identifier: Apache-2.0
// The inflated membrane against equilibrium at its pole, another way of solving it, published values and differences.
#include <array>
#include <cmath>

#include <gmock/gmock.h>

#include "data/written_file.hpp"
#include "rigs/rigs.hpp"
#include "support/sheet.hpp"

namespace tunica::testing::bulge_test {
namespace {

using ::testing::HasSubstr;

const std::vector<std::string> all{"pressure", "apex_stretch", "apex_curvature"};
constexpr double radius = 10, thickness = 0.5;

std::unique_ptr<Test> make_bulge(const std::vector<double>& heights, std::int64_t elements = 4) {
  return make_rig("bulge", {{"radius", radius}, {"thickness", thickness}, {"elements", elements}},
                  {{"height", heights}}, all);
}

struct Rubber {
  std::string type;
  std::vector<double> p;
};
const std::vector<Rubber> rubbers{{"neo_hooke", {100}}, {"mooney_rivlin", {40, 10}}, {"yeoh", {40, 1, 0.2}}};

// p = 2 κ T, T = σ H/λ² the tension at the pole, where both curvatures and both stresses are alike. The stress is that
// of an equibiaxial sheet at the stretch of the pole, whatever the rest of the membrane does.
TEST(Bulge, IsInEquilibriumAtItsPole) {
  const std::vector<double> heights{2, 6, 10, 15};
  for (const Rubber& rubber : rubbers) {
    const auto model = make_model(rubber.type);
    const auto found = predicted(*make_bulge(heights, 16), *model, rubber.p);
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const double pressure = found[i], stretch = found[4 + i], curvature = found[8 + i];
      const auto sheet = make_sheet("equibiaxial", {{"stretch", {stretch}}}, {{"stress"}});
      const double stress = stresses(*sheet, *model, rubber.p)[0];
      EXPECT_NEAR(pressure / (2 * curvature * stress * thickness / (stretch * stretch)), 1, 1e-7)
          << rubber.type << heights[i];
    }
  }
}

/// The meridian as an initial-value problem from the pole, by Runge and Kutta: the equations of Adkins and Rivlin
/// (1952) for a neo-Hookean membrane, with T1 and T2 the tensions per deformed length.
///
///   dr/dR = λ1 cos φ,  dz/dR = −λ1 sin φ,  dφ/dR = λ1 (p − T2 sin φ/r)/T1,  dT1/dR = (T2 − T1) λ1 cos φ/r
struct Meridian {
  double mu, pole, pressure;

  [[nodiscard]] double tension(double along, double across) const {
    return mu * thickness * (along / across - 1 / std::pow(along * across, 3));
  }
  [[nodiscard]] double stretch_at(double T1, double across) const {
    double along = pole;
    for (int k = 0; k < 12; ++k) {
      const double slope = mu * thickness * (1 / across + 3 / (std::pow(across, 3) * std::pow(along, 4)));
      along -= (tension(along, across) - T1) / slope;
    }
    return along;
  }
  /// r and the fall of z at the rim.
  [[nodiscard]] std::array<double, 2> rim() const {
    constexpr int steps = 1600;
    const double h = radius / steps;
    const double T = tension(pole, pole);
    // One step off the pole, where the cap is a sphere of curvature p/2T.
    std::array<double, 4> y{pole * h, 0.5 * pressure / (2 * T) * pole * pole * h * h, pressure / (2 * T) * pole * h, T};
    const auto slope = [this](double R, const std::array<double, 4>& at) -> std::array<double, 4> {
      const auto [r, z, phi, T1] = at;
      const double across = r / R, along = stretch_at(T1, across), T2 = tension(across, along);
      return {along * std::cos(phi), along * std::sin(phi), along * (pressure - T2 * std::sin(phi) / r) / T1,
              (T2 - T1) * along * std::cos(phi) / r};
    };
    const auto moved = [](std::array<double, 4> at, const std::array<double, 4>& k, double by) {
      for (std::size_t c = 0; c < 4; ++c) at[c] += by * k[c];
      return at;
    };
    for (int i = 1; i < steps; ++i) {
      const double R = h * i;
      const auto k1 = slope(R, y), k2 = slope(R + h / 2, moved(y, k1, h / 2)),
                 k3 = slope(R + h / 2, moved(y, k2, h / 2)), k4 = slope(R + h, moved(y, k3, h));
      for (std::size_t c = 0; c < 4; ++c) y[c] += h / 6 * (k1[c] + 2 * k2[c] + 2 * k3[c] + k4[c]);
    }
    return {y[0], y[1]};
  }
};

// The pressure at which the meridian that begins at the pole with the stretch of the finite elements ends at the rim,
// and the height that it has then. The largest height lies beyond the largest pressure.
TEST(Bulge, EndsWhereTheMeridianFromThePoleEnds) {
  const std::vector<double> heights{1, 5, 10, 18};
  const double mu = 100;
  const auto found = predicted(*make_bulge(heights, 8), *make_model("neo_hooke"), {mu});
  EXPECT_LT(found[3], found[2]);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    double low = 0.98 * found[i], high = 1.02 * found[i];
    for (int k = 0; k < 30; ++k) {
      const double middle = 0.5 * (low + high);
      // More pressure bends the meridian more, which then ends nearer to the axis.
      (Meridian{mu, found[4 + i], middle}.rim()[0] > radius ? low : high) = middle;
    }
    EXPECT_NEAR(low / found[i], 1, 2e-6) << heights[i];
    EXPECT_NEAR((Meridian{mu, found[4 + i], low}.rim()[1]) / heights[i], 1, 2e-6);
  }
}

// p = C E H h³/a⁴ of a shallow membrane without prestretch, C = 8/3 (1.015 − 0.247 ν)/(1 − ν) (Small, Nix, J. Mater.
// Res. 7:1553, 1992), a fit good to a thousandth; with a prestress σ0 also p = 4 σ0 H h/a², exactly.
TEST(Bulge, IsHenckysWhereItIsShallow) {
  const double mu = 100, h = 0.02, stiffness = 3 * mu * thickness / std::pow(radius, 4);
  const auto test = make_bulge({h});
  const auto model = make_model("neo_hooke");
  const double coefficient = 8. / 3 * (1.015 - 0.247 * 0.5) / 0.5;
  EXPECT_NEAR(predicted(*test, *model, {mu})[0] / (coefficient * stiffness * h * h * h), 1, 2e-3);
  const double stretch = 1.1, stress = mu * (stretch * stretch - std::pow(stretch, -4));
  EXPECT_NEAR(predicted(*test, *model, {mu}, {stretch})[0] /
                  (4 * stress * thickness / (stretch * stretch) * h / (radius * radius)),
              1, 1e-4);
}

// Degree 4 and a smooth solution: the pressure is good to the eighth power of the elements' size.
TEST(Bulge, ConvergesWithTheEighthPower) {
  const auto model = make_model("neo_hooke");
  std::vector<double> pressure;
  for (const std::int64_t elements : {1, 2, 4, 16})
    pressure.push_back(predicted(*make_bulge({8}, elements), *model, {100})[0]);
  const double coarse = std::abs(pressure[0] - pressure[3]), middle = std::abs(pressure[1] - pressure[3]),
               fine = std::abs(pressure[2] - pressure[3]);
  EXPECT_GT(std::log2(coarse / middle), 4);
  EXPECT_NEAR(std::log2(middle / fine), 8, 1.5);
}

TEST(Bulge, HasExactDerivatives) {
  for (const Rubber& rubber : rubbers)
    for (const double prestretch : {1.02, 1.2})
      expect_exact_derivatives(*make_bulge({3, 8, 6, 14}), *make_model(rubber.type), rubber.p, {prestretch});
  Options terms;
  terms.set("terms", std::int64_t{1});
  terms.set("poisson", std::string("shared"));
  expect_exact_derivatives(*make_bulge({3, 8}), *make_model("hyperfoam", terms), {25, 6, 0.3}, {1.05});
}

// A rubber keeps its volume, λ3 = 1/λ². A foam of Poisson's ratio ν with free faces has J = λ3 λ², and σ3 = 0 asks for
// λ3 = J^(−β) with β = ν/(1 − 2ν) (Storakers, J. Mech. Phys. Solids 34:125, 1986): λ3 = λ^(−2β/(1 + β)).
TEST(Bulge, ThinsAsItsMaterialDoes) {
  const auto test = make_bulge({0, 5, 9});
  const auto thinning = [&](const Model& model, const std::vector<double>& p) {
    const std::vector<double> own{1.05};
    std::vector<double> values(9), diagnostics(6);
    EXPECT_TRUE(test->predict({model, p, own}, {values, {}, {}, diagnostics}).ok());
    return std::pair(std::vector<double>(values.begin() + 3, values.begin() + 6), diagnostics);
  };
  const auto [rubber, of_rubber] = thinning(*make_model("neo_hooke"), {100});
  Options terms;
  terms.set("terms", std::int64_t{1});
  terms.set("poisson", std::string("shared"));
  constexpr double nu = 0.1, beta = nu / (1 - 2 * nu);
  const auto [foam, of_foam] = thinning(*make_model("hyperfoam", terms), {25, 6, nu});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(of_rubber[i] * rubber[i] * rubber[i], 1, 1e-12);
    EXPECT_NEAR(of_foam[i] / std::pow(foam[i], -2 * beta / (1 + beta)), 1, 1e-8);
  }
  EXPECT_GT(of_foam[2], 1.2 / (foam[2] * foam[2]));
}

// A flat membrane bears nothing; a data file may begin there.
TEST(Bulge, BeginsFlat) {
  const auto test = make_bulge({0, 5});
  const auto model = make_model("neo_hooke");
  const auto found = predicted(*test, *model, {100}, {1.1});
  EXPECT_EQ(found[0], 0);
  EXPECT_EQ(found[2], 1.1);
  EXPECT_EQ(found[4], 0);
  expect_exact_derivatives(*make_bulge({5}), *model, {100}, {1.1});
}

// Fibres in all directions of the plane are even there; two families are not.
TEST(Bulge, TakesFibresThatAreEvenInThePlane) {
  const auto model = make_model("gho");
  const auto test = make_bulge({4, 8});
  EXPECT_GT(predicted(*test, *model, {20, 1. / 3, 30, 1.2, 40})[0], 0);
  EXPECT_THAT(failure(*test, *model, {20, 0.1, 30, 1.2, 40}), HasSubstr("the material has directions in its plane"));
}

TEST(Bulge, RefusesWhatIsNoMembrane) {
  const auto refusal = [](double a, double t, double h) {
    return message_of<InputError>([&] {
      (void)make_rig("bulge", {{"radius", a}, {"thickness", t}}, {{"height", {h}}}, {"pressure"});
    });
  };
  EXPECT_THAT(refusal(0, 1, 1), HasSubstr("\"radius\" is 0 mm and \"thickness\" 1 mm, and both are above 0"));
  EXPECT_THAT(refusal(10, 3, 1), HasSubstr("a membrane is thinner than a fifth of its radius"));
  EXPECT_THAT(refusal(10, 1, 0.001), HasSubstr("row 1 has height 0.001 mm; expected 0, or from a thousandth"));
  EXPECT_THAT(refusal(10, 1, -2), HasSubstr("row 1 has height -2 mm"));
  EXPECT_THAT(message_of<InputError>([] {
                (void)make_rig("bulge", {{"radius", 10.}, {"thickness", 1.}}, {}, {"pressure"});
              }),
              HasSubstr("no column is mapped to 'height'"));
}

}  // namespace
}  // namespace tunica::testing::bulge_test
