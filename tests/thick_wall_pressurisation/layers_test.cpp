// SPDX-License-Identifier: Apache-2.0
// Layers with models of their own: against one layer, against closed forms, and in what they refuse.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "conformance/test_properties.hpp"
#include "support/strip.hpp"
#include "support/tube.hpp"

namespace tunica::testing::layers_test {
using namespace conformance;
namespace {

constexpr double inner = 3.71, wall = 2.06, outer = inner + wall;
const std::vector<double> bare_layers{0, 0, 0, 0};
const std::vector<std::string> all_channels{"axial_force", "outer_diameter_stretch", "inner_diameter", "outer_diameter",
                                            "inner_diameter_stretch"};

std::vector<double> joined(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], tolerance * std::max(1., std::abs(b[i]))) << i;
}

TEST(TubeLayers, OfOneMaterialAreOneWall) {
  const std::vector<std::vector<double>> imperfections{bare_layers, {70, 0.01, 2, 0.04}, {-30, 0, 0, -0.1}};
  for (const auto& stretches : {std::vector<double>{}, std::vector<double>{1.1, 1.3, 1.25, 1.2}})
    for (const auto& own : imperfections)
      for (const char* type : {"gho", "hgo"}) {
        const auto model = make_model(type);
        const std::vector<double> p = type[0] == 'g' ? set_s : std::vector<double>{15, 12, 0.6, 40};
        const TubeSetup one{.channels = all_channels, .axial_stretches = stretches};
        TubeSetup two = one;
        two.layers = {0.7, wall - 0.7};
        TubeSetup three = one;
        three.layers = {0.3, 0.9, wall - 1.2};
        const std::vector<double> pressure{0, 5, 13, 20};
        const Inflation bare = inflate(*make_tube(pressure, one), *model, p, joined(own, {1}));
        const std::vector<const Model*> twice{model.get(), model.get()}, thrice{model.get(), model.get(), model.get()};
        const Inflation halves = inflate(*make_tube(pressure, two), *model, joined(p, p), own, twice);
        const Inflation thirds = inflate(*make_tube(pressure, three), *model, joined(p, joined(p, p)), own, thrice);
        ASSERT_TRUE(bare.status.ok() && halves.status.ok() && thirds.status.ok()) << halves.status.reason();
        expect_near(halves.values, bare.values, 1e-12);
        expect_near(thirds.values, bare.values, 1e-12);
        expect_near(halves.diagnostics, bare.diagnostics, 1e-12);
      }
}

TEST(TubeLayers, ASingleOneIsTheWall) {
  const auto model = make_model("gho");
  const std::vector<const Model*> only{model.get()};
  const std::vector<double> pressure{0, 9, 18};
  expect_near(inflate(*make_tube(pressure, {.layers = {wall}}), *model, set_s, bare_layers, only).values,
              inflate(*make_tube(pressure), *model, set_s).values, 1e-12);
}

/// Pressure and reduced axial force of a neo-Hookean shell R1 … R2 of a closed tube whose inner face is at r1:
///
///   p = μ ∫ (λt² − λr²) dr/r,   F = π μ ∫ (2 λz² − λt² − λr²) r dr,   λt = r/R, λr = R/(λz r), R² = λz r² + A.
struct Shell {
  double p, F, r2;
};
Shell neo_hookean_shell(double mu, double R1, double R2, double r1, double lz) {
  const double A = R1 * R1 - lz * r1 * r1, r2 = std::sqrt((R2 * R2 - A) / lz), area = r2 * r2 - r1 * r1;
  const double lnr = std::log(r2 / r1), lnR = std::log(R2 / R1);
  const double p = mu / lz * (lnR - lnr - A / (2 * lz) * (1 / (r1 * r1) - 1 / (r2 * r2)));
  const double by_t = (R2 * R2 - R1 * R1 - 2 * A * lnR) / (2 * lz * lz), by_r = area / (2 * lz) + A / (lz * lz) * lnr;
  return {p, std::numbers::pi * mu * (lz * lz * area - by_t - by_r), r2};
}

TEST(TubeLayers, OfNeoHookeMatchTheirClosedForm) {
  const auto media = make_model("neo_hooke"), adventitia = make_model("neo_hooke");
  const std::vector<const Model*> layers{media.get(), adventitia.get()};
  constexpr double inside = 1.3, interface = inner + inside;
  const std::vector<double> pressure = evenly(0, 12, 7);
  for (const double lz : {1.0, 1.2, 1.5}) {
    const auto tube = make_tube(pressure, {.channels = {"inner_diameter", "axial_force", "outer_diameter"},
                                           .axial_stretch = lz,
                                           .layers = {inside, wall - inside}});
    const Inflation out = inflate(*tube, *media, {35, 140}, bare_layers, layers);
    ASSERT_TRUE(out.status.ok()) << out.status.reason();
    for (std::size_t i = 0; i < pressure.size(); ++i) {
      const Shell first = neo_hookean_shell(35, inner, interface, out.values[i] / 2, lz);
      const Shell second = neo_hookean_shell(140, interface, outer, first.r2, lz);
      EXPECT_NEAR(first.p + second.p, pressure[i], 1e-10 * (1 + pressure[i])) << lz;
      EXPECT_NEAR(first.F + second.F, out.values[7 + i], 1e-9 * (1 + std::abs(out.values[7 + i]))) << lz;
      EXPECT_NEAR(2 * second.r2, out.values[14 + i], 1e-12) << lz;
    }
  }
}

/// Pressure of two neo-Hookean layers in an opened sector with squared inner radius S, from scratch: Simpson's rule in
/// R² in each layer. A material radius Rf of the unloaded wall was at R² = S + K (Rf² − Ri²).
double opened_pressure(double S, double K, double ro, double lz, double interface, double mu_inner, double mu_outer) {
  const double edges[3] = {S, S + K * (interface * interface - inner * inner), S + K * (outer * outer - inner * inner)};
  double p = 0;
  for (int layer = 0; layer < 2; ++layer) {
    constexpr int intervals = 2000;
    const double h = (edges[layer + 1] - edges[layer]) / intervals, mu = layer == 0 ? mu_inner : mu_outer;
    for (int k = 0; k <= intervals; ++k) {
      const double R2 = edges[layer] + k * h, r2 = ro * ro - (edges[2] - R2) / (K * lz), c = K * K * r2 / R2;
      const double T = mu * (c - 1 / (c * lz * lz));
      p += (k == 0 || k == intervals ? 1 : k % 2 == 1 ? 4 : 2) * h / 3 * T / (2 * K * lz * r2);
    }
  }
  return p;
}

TEST(TubeLayers, InAnOpenedTubeAgreeWithAnIndependentBisection) {
  const double K = 360. / (360 - 120), interface = inner + 0.8;
  double low = 1, high = 400;  // the sector's R_i²: a larger one is compressed by closing it
  for (int k = 0; k < 80; ++k) {
    const double middle = (low + high) / 2;
    (opened_pressure(middle, K, outer, 1, interface, 30, 120) > 0 ? low : high) = middle;
  }
  const auto model = make_model("neo_hooke");
  const std::vector<const Model*> layers{model.get(), model.get()};
  const auto tube = make_tube({6, 11}, {.layers = {0.8, wall - 0.8}});
  const Inflation out = inflate(*tube, *model, {30, 120}, {120, 0, 0, 0}, layers);
  ASSERT_TRUE(out.status.ok()) << out.status.reason();
  for (const std::size_t i : {0u, 1u})
    EXPECT_NEAR(opened_pressure((low + high) / 2, K, out.values[i] * outer, 1.2, interface, 30, 120), i == 0 ? 6 : 11,
                1e-8);
  const Inflation closed = inflate(*tube, *model, {30, 120}, bare_layers, layers);
  EXPECT_GT(std::abs(out.values[0] - closed.values[0]), 1e-4);
}

TEST(TubeLayers, DoNotRememberTheTubeBefore) {
  // The same thread, other materials in each place: cuts and states of the one must not appear in the other.
  const auto fibres = make_model("gho"), matrix = make_model("neo_hooke");
  const std::vector<const Model*> one{matrix.get(), fibres.get()}, other{fibres.get(), matrix.get()};
  const auto tube =
      make_tube({1, 6, 12}, {.channels = all_channels, .axial_stretch = 1.05, .layers = {0.9, wall - 0.9}});
  const auto first = inflate(*tube, *matrix, joined({60}, set_s), bare_layers, one).values;
  ASSERT_TRUE(inflate(*tube, *fibres, joined(set_s, {60}), bare_layers, other).status.ok());
  EXPECT_EQ(inflate(*tube, *matrix, joined({60}, set_s), bare_layers, one).values, first);
}

TEST(TubeLayers, TheirOrderMatters) {
  const auto model = make_model("neo_hooke");
  const std::vector<const Model*> layers{model.get(), model.get()};
  const auto tube = make_tube({8}, {.layers = {wall / 2, wall / 2}});
  const auto stiff_inside = inflate(*tube, *model, {120, 40}, bare_layers, layers).values[0];
  const auto stiff_outside = inflate(*tube, *model, {40, 120}, bare_layers, layers).values[0];
  EXPECT_LT(stiff_inside, stiff_outside - 1e-3);  // the inner half strains more, and carries more where it is stiffer
}

TEST(TubeLayers, ScaleWithTheThicknessErrorInProportion) {
  const auto model = make_model("neo_hooke");
  const std::vector<const Model*> layers{model.get(), model.get()};
  const auto recorded = make_tube({3, 8}, {.channels = {"outer_diameter", "axial_force"}, .layers = {0.5, wall - 0.5}});
  const TubeSetup thinner{.channels = {"outer_diameter", "axial_force"},
                          .inner_radius = outer - 0.9 * wall,
                          .thickness = 0.9 * wall,
                          .layers = {0.9 * 0.5, 0.9 * (wall - 0.5)}};
  expect_near(inflate(*recorded, *model, {40, 120}, {0, 0, 0, -0.1}, layers).values,
              inflate(*make_tube({3, 8}, thinner), *model, {40, 120}, bare_layers, layers).values, 1e-11);
}

class LayeredTubeConformance : public ::testing::TestWithParam<std::tuple<std::vector<double>, TestProperty>> {};

/// Different models with different numbers of parameters, fibres that switch within a layer, a model that stands twice.
TEST_P(LayeredTubeConformance, Holds) {
  const auto& [own, property] = GetParam();
  const auto fibres = make_model("gho"), weave = make_model("hgo"), matrix = make_model("neo_hooke");
  const std::vector<double> of_weave{15, 12, 0.6, 40};
  for (const auto& stretches : {std::vector<double>{}, std::vector<double>{1.05, 1.1, 1.2, 1.15, 1.3, 1.25}}) {
    const TubeSetup setup{.channels = all_channels, .axial_stretches = stretches, .layers = {0.9, wall - 0.9}};
    const auto tube = make_tube({0.5, 3, 8, 12, 16, 20}, setup);
    EXPECT_EQ(
        property.check({*tube, *fibres, joined(set_s, of_weave), own, {fibres.get(), weave.get()}}).counter_example,
        "");
    EXPECT_EQ(property.check({*tube, *matrix, joined({30}, set_s), own, {matrix.get(), fibres.get()}}).counter_example,
              "");
  }
  const auto sandwich = make_tube({0.5, 4, 9}, {.channels = all_channels, .layers = {0.5, 1, wall - 1.5}});
  EXPECT_EQ(property
                .check({*sandwich,
                        *matrix,
                        joined({30}, joined(of_weave, {30})),
                        own,
                        {matrix.get(), weave.get(), matrix.get()}})
                .counter_example,
            "");
}

INSTANTIATE_TEST_SUITE_P(All, LayeredTubeConformance,
                         ::testing::Combine(::testing::Values(std::vector<double>{70, 0.01, 2, 0.04},
                                                              std::vector<double>{-30, 0.01, 8, -0.03},
                                                              std::vector<double>{15, -0.02, 0, -0.2}),
                                            ::testing::ValuesIn(test_properties())));

TEST(TubeLayers, AJacobianRowOfALayerIsThatOfItsModel) {
  // Rows of two layers of one material add up to those of the wall.
  const auto model = make_model("gho");
  const auto one = make_tube({4, 12}), two = make_tube({4, 12}, {.layers = {0.8, wall - 0.8}});
  const std::vector<const Model*> layers{model.get(), model.get()};
  std::vector<double> whole(10 * 4), parts(14 * 4);
  ASSERT_TRUE(one->predict({*model, set_s, bare_tube}, {{}, whole, {}, {}}).ok());
  ASSERT_TRUE(two->predict({*model, joined(set_s, set_s), bare_layers, {}, layers}, {{}, parts, {}, {}}).ok());
  for (std::size_t k = 0; k < 5 * 4; ++k)
    EXPECT_NEAR(parts[k] + parts[5 * 4 + k], whole[k], 1e-9 * (1 + std::abs(whole[k]))) << k;
  for (std::size_t k = 0; k < 4 * 4; ++k)  // the imperfections but layer_ratio
    EXPECT_NEAR(parts[10 * 4 + k], whole[5 * 4 + k], 1e-9 * (1 + std::abs(whole[5 * 4 + k]))) << k;
}

TEST(TubeLayers, MayRememberTheirHistory) {
  const auto viscous = plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), make_model("neo_hooke"), {});
  const auto elastic = make_model("gho");
  const std::vector<double> memory{60, 0.8, 5}, pressure{2, 8, 8, 8, 3};
  const TubeSetup timed{.time = {0.1, 0.2, 2, 1e7, 1e7 + 0.1}};
  TubeSetup halves = timed;
  halves.layers = {0.8, wall - 0.8};
  const std::vector<const Model*> twice{viscous.get(), viscous.get()}, mixed{elastic.get(), viscous.get()};
  const Inflation whole = inflate(*make_tube(pressure, timed), *viscous, memory);
  const Inflation same = inflate(*make_tube(pressure, halves), *viscous, joined(memory, memory), bare_layers, twice);
  ASSERT_TRUE(whole.status.ok() && same.status.ok()) << same.status.reason();
  expect_near(same.values, whole.values, 1e-9);
  // Beside fibres without memory the other layer creeps, until it is at equilibrium, as without time.
  const Inflation creep = inflate(*make_tube(pressure, halves), *elastic, joined(set_s, memory), bare_layers, mixed);
  halves.time = {};
  const Inflation slow = inflate(*make_tube(pressure, halves), *elastic, joined(set_s, memory), bare_layers, mixed);
  ASSERT_TRUE(creep.status.ok() && slow.status.ok()) << creep.status.reason() << slow.status.reason();
  EXPECT_LT(creep.values[1], creep.values[2] - 1e-4);
  EXPECT_LT(creep.values[2], creep.values[3] - 1e-6);
  EXPECT_NEAR(creep.values[3], slow.values[3], 1e-6);
  std::vector<double> jacobian((8 + 4) * 2 * 5);
  EXPECT_NE(make_tube(pressure, halves)
                ->predict({*elastic, joined(set_s, memory), bare_layers, {}, mixed}, {{}, jacobian, {}, {}})
                .reason()
                .find("no exact Jacobian along the path of a model with history"),
            std::string::npos);
}

std::string refusal(const TubeSetup& setup) {
  try {
    make_tube({1}, setup);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}
Options with(const char* name, double value) {
  Options options;
  options.set(name, value);
  return options;
}
#define EXPECT_SAYS(text, part) EXPECT_NE(std::string(text).find(part), std::string::npos) << (text)

TEST(TubeLayers, MustBeAsThickAsTheWall) {
  EXPECT_SAYS(refusal({.layers = {0.97, 1}}),
              "the layers are 1.97 mm thick together, and the wall is 2.06 mm; make them agree, or leave \"thickness\" "
              "out");
  EXPECT_EQ(refusal({.layers = {0.97, 1.09}}), "");
  Options both = with("outer_radius", outer);
  both.set("thickness", 0.);
  EXPECT_SAYS(refusal({.options = both, .layers = {0.97, 1.1}}), "the layers are 2.07 mm thick together");
}

TEST(TubeLayers, MakeTheThickness) {
  const auto model = make_model("neo_hooke");
  const std::vector<const Model*> layers{model.get(), model.get()};
  const TubeSetup left_out{.options = with("thickness", 0.), .layers = {0.97, 1.09}}, given{.layers = {0.97, 1.09}};
  EXPECT_EQ(inflate(*make_tube({4}, left_out), *model, {40, 80}, bare_layers, layers).values,
            inflate(*make_tube({4}, given), *model, {40, 80}, bare_layers, layers).values);
  Options no_radius = with("thickness", 0.);
  no_radius.set("inner_radius", 0.);
  EXPECT_SAYS(refusal({.options = no_radius, .layers = {0.97, 1.09}}), "give two of");
}

TEST(TubeLayers, ReplaceTheRatioOfTwoLayersOfOneModel) {
  const auto tube = make_tube({1}, {.layers = {0.97, 1.09}});
  ASSERT_EQ(tube->describe().parameters.size(), 4u);
  EXPECT_EQ(tube->describe().parameters.back().name, "thickness_error");
  EXPECT_EQ(tube->describe().nulls, bare_layers);
  EXPECT_SAYS(refusal({.options = with("layer_interface", 0.4), .layers = {0.97, 1.09}}),
              "\"layer_interface\" says where layer_ratio parts a wall of one model, and \"layers\" are given too");
}

}  // namespace
}  // namespace tunica::testing::layers_test
