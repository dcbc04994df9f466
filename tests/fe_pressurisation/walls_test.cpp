// SPDX-License-Identifier: Apache-2.0
// Walls with layers, an opening angle and support from outside: against the long tube, which has them too, against each
// other at their nulls, and their derivatives against differences.
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include "conformance/test_properties.hpp"
#include "kernel.hpp"
#include "simulation.hpp"
#include "support/fe_tube.hpp"
#include "support/strip.hpp"

namespace tunica::testing::walls_test {
using namespace conformance;
namespace {

constexpr double wall = 2.06;
const std::vector<double> bare_layers{0, 0, 0, 0};
const std::vector<std::string> all_channels{"axial_force", "outer_diameter_stretch", "inner_diameter", "outer_diameter",
                                            "inner_diameter_stretch"};

std::vector<double> joined(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Fibres that always bear: the wall has no kinks, which would cost elements an order.
std::unique_ptr<Model> smooth_fibres() {
  Options options;
  options.set("fibre_switch", std::string("none"));
  return make_model("gho", options);
}

/// A wall as both tests take it.
struct Wall {
  const char* name;
  std::vector<double> own, thicknesses;  ///< imperfections; of layers, empty = one model
  double interface = 0.5;
  bool cut = false;  ///< the interface cuts a column of elements
};
const std::vector<Wall> walls{{"opened", {120, 0, 0, 0, 1}, {}},
                              {"turned over", {-60, 0.02, 0, 0.1, 1}, {}},
                              {"stiffer inside", {0, 0, 0, 0, 3}, {}},
                              {"stiffer inside of two thirds, opened", {90, 0, 0, -0.1, 2.5}, {}, 2. / 3, true},
                              {"two layers", {0, 0, 0, 0}, {0.9, wall - 0.9}},
                              {"three layers, opened", {100, 0.01, 0, 0.05}, {0.4, 1, wall - 1.4}},
                              {"supported", {0, 0, 8, 0, 1}, {}},
                              {"supported, two layers, opened", {70, 0.02, 15, 0.05}, {0.9, wall - 0.9}}};

struct Materials {
  std::unique_ptr<Model> fibres = smooth_fibres(), matrix = make_model("neo_hooke"),
                         rubber = make_model("mooney_rivlin");
  std::vector<const Model*> layers;
  std::vector<double> parameters;

  explicit Materials(const Wall& is) {
    if (is.thicknesses.empty()) {
      parameters = set_s;
    } else if (is.thicknesses.size() == 2) {
      layers = {fibres.get(), matrix.get()};
      parameters = joined(set_s, {90});
    } else {
      layers = {matrix.get(), rubber.get(), fibres.get()};
      parameters = joined(joined({50}, {20, 15}), set_s);
    }
  }
  [[nodiscard]] const Model& first() const { return layers.empty() ? *fibres : *layers.front(); }
};

Options interface_of(const Wall& is) {
  Options options;
  if (is.thicknesses.empty()) options.set("layer_interface", is.interface);
  return options;
}
FeSetup fe_setup(const Wall& is, const std::string& element, const std::string& elements, const std::string& ends) {
  return {.element = element,
          .elements = elements,
          .ends = ends,
          .channels = all_channels,
          .options = interface_of(is),
          .layers = is.thicknesses};
}

class FiniteElementWall : public ::testing::TestWithParam<Wall> {};

/// Ends that slide: nothing varies along the tube, and each doubling of the elements across the wall takes the error
/// down by 4 (four nodes) or by 16 (nine nodes).
TEST_P(FiniteElementWall, ConvergesToTheLongTube) {
  const Materials of(GetParam());
  const std::vector<double> pressure{0, 7, 16};
  const Inflation exact = inflate(
      *make_tube(pressure,
                 {.channels = all_channels, .options = interface_of(GetParam()), .layers = GetParam().thicknesses}),
      of.first(), of.parameters, GetParam().own, of.layers);
  ASSERT_TRUE(exact.status.ok()) << exact.status.reason();
  const auto error = [&](const char* element, std::size_t across) {
    const Inflation found = inflate(
        *make_fe_tube(pressure, fe_setup(GetParam(), element, "[" + std::to_string(across) + ", 2]", "sliding")),
        of.first(), of.parameters, GetParam().own, of.layers);
    EXPECT_TRUE(found.status.ok()) << found.status.reason();
    std::array<double, 2> worst{};
    for (std::size_t i = 0; i < 3; ++i) {
      worst[0] = std::max(worst[0], std::abs(found.values[3 + i] - exact.values[3 + i]));
      worst[1] = std::max(worst[1], std::abs(found.values[i] - exact.values[i]) / 1000);
    }
    return worst;
  };
  for (const char* element : {"quadrilateral_4", "quadrilateral_9"}) {
    const auto coarse = error(element, 12), fine = error(element, 24);
    const bool nine = std::string(element) == "quadrilateral_9";
    std::printf("  %s, %s: D/D0 %.1e, %.1e (order %.1f), force %.1e, %.1e (order %.1f)\n", GetParam().name, element,
                coarse[0], fine[0], std::log2(coarse[0] / fine[0]), coarse[1], fine[1], std::log2(coarse[1] / fine[1]));
    EXPECT_LT(fine[0], !nine ? 4e-5 : GetParam().cut ? 1e-6 : 1e-9);
    EXPECT_LT(fine[1], !nine ? 4e-5 : GetParam().cut ? 1e-6 : 2e-9);
    if (GetParam().cut) continue;
    EXPECT_GT(std::log2(coarse[0] / fine[0]), nine ? 3.5 : 1.8);
    EXPECT_GT(std::log2(coarse[1] / fine[1]), nine ? 3.5 : 1.8);
  }
}

/// The test's own comparison with the long tube, which `tunica check` prints; it leaves the support out.
TEST_P(FiniteElementWall, AgreesWithTheLongTubeInItsOwnCheck) {
  const Materials of(GetParam());
  const auto tube = make_fe_tube({4, 12}, fe_setup(GetParam(), "quadrilateral_4", "[16, 20]", "clamped"));
  std::vector<Agreement> found;
  const Status status = tube->agreement({of.first(), of.parameters, GetParam().own, {}, of.layers}, found);
  ASSERT_TRUE(status.ok()) << status.reason();
  EXPECT_EQ(found.size(), 3u);
  for (const Agreement& at : found) EXPECT_LE(at.difference, at.expected) << GetParam().name << ": " << at.with;
}

/// Of every parameter, at ends that are held.
TEST_P(FiniteElementWall, HasExactDerivatives) {
  const Materials of(GetParam());
  const std::vector<double> pressure{1, 8, 15};
  double worst = 0;
  for (const auto& [element, elements] : {std::pair{"quadrilateral_4", "[5, 7]"}, {"quadrilateral_9", "[3, 4]"}})
    for (const char* ends : {"clamped", "clamped_after_stretch"}) {
      const auto tube = make_fe_tube(pressure, fe_setup(GetParam(), element, elements, ends));
      const std::size_t models = of.parameters.size(), all = models + GetParam().own.size(), rows = 5 * 3;
      std::vector<double> jacobian(all * rows);
      const Status status =
          tube->predict({of.first(), of.parameters, GetParam().own, {}, of.layers}, {{}, jacobian, {}, {}});
      ASSERT_TRUE(status.ok()) << status.reason();
      for (std::size_t j = 0; j < all; ++j) {
        const double h = j < models                    ? 1e-3 * std::abs(of.parameters[j])
                         : j - models == opening_angle ? 0.05
                         : j - models == tethering     ? 0.01
                                                       : 2e-4;
        const auto at = [&](double steps) {
          std::vector<double> p = of.parameters, q = GetParam().own;
          (j < models ? p[j] : q[j - models]) += steps * h;
          const Inflation out = inflate(*tube, of.first(), p, q, of.layers);
          EXPECT_TRUE(out.status.ok()) << out.status.reason();
          return out.values;
        };
        const auto up = at(1), down = at(-1), up2 = at(2), down2 = at(-2);
        for (std::size_t c = 0; c < 5; ++c) {
          double scale = 0, off = 0;
          for (std::size_t i = c * 3; i < (c + 1) * 3; ++i) {
            const double expected = (8 * (up[i] - down[i]) - (up2[i] - down2[i])) / (12 * h);
            scale = std::max(scale, std::abs(expected));
            off = std::max(off, std::abs(jacobian[j * rows + i] - expected));
          }
          EXPECT_GT(scale, 0) << j;
          worst = std::max(worst, off / scale);
          EXPECT_LE(off, 2e-7 * scale) << GetParam().name << ", " << element << ", " << ends << ", parameter " << j
                                       << ", " << all_channels[c];
        }
      }
    }
  std::printf("  %s: %.1e\n", GetParam().name, worst);
}

INSTANTIATE_TEST_SUITE_P(All, FiniteElementWall, ::testing::ValuesIn(walls), [](const auto& at) {
  std::string name = at.param.name;
  std::erase_if(name, [](char c) { return c == ' ' || c == ','; });
  return name;
});

/// Lines of the mesh at 2/5 of the thickness: the layers' mesh is that of the one wall.
TEST(FiniteElementLayers, OfOneMaterialAreOneWall) {
  const auto model = make_model("gho");
  const std::vector<const Model*> twice{model.get(), model.get()};
  for (const std::vector<double>& own : {bare_layers, {80, 0.02, 0, 0.05}})
    for (const char* element : {"quadrilateral_4", "quadrilateral_9"}) {
      const std::vector<double> pressure{0, 6, 14};
      const FeSetup one{.element = element, .elements = "[5, 6]", .channels = all_channels};
      FeSetup two = one;
      two.layers = {0.4 * wall, 0.6 * wall};
      const Inflation whole = inflate(*make_fe_tube(pressure, one), *model, set_s, joined(own, {1}));
      const Inflation halves = inflate(*make_fe_tube(pressure, two), *model, joined(set_s, set_s), own, twice);
      ASSERT_TRUE(whole.status.ok() && halves.status.ok()) << halves.status.reason();
      for (std::size_t i = 0; i < whole.values.size(); ++i)
        EXPECT_NEAR(halves.values[i], whole.values[i], 1e-9 * (1 + std::abs(whole.values[i]))) << i;
      // Rows of the Jacobian of both layers add up to those of the wall.
      std::vector<double> of_whole(10 * 15), of_halves(14 * 15);
      ASSERT_TRUE(make_fe_tube(pressure, one)->predict({*model, set_s, joined(own, {1})}, {{}, of_whole, {}, {}}).ok());
      ASSERT_TRUE(make_fe_tube(pressure, two)
                      ->predict({*model, joined(set_s, set_s), own, {}, twice}, {{}, of_halves, {}, {}})
                      .ok());
      for (std::size_t k = 0; k < 5 * 15; ++k)
        EXPECT_NEAR(of_halves[k] + of_halves[5 * 15 + k], of_whole[k], 1e-6 * (1 + std::abs(of_whole[k]))) << k;
      for (std::size_t k = 0; k < 4 * 15; ++k)
        EXPECT_NEAR(of_halves[10 * 15 + k], of_whole[5 * 15 + k], 1e-6 * (1 + std::abs(of_whole[5 * 15 + k]))) << k;
    }
}

TEST(FiniteElementLayers, TakeTheElementsInProportion) {
  EXPECT_EQ(fe::columns_of(25, std::vector<double>{0.4}), (std::vector<std::size_t>{10, 15}));
  EXPECT_EQ(fe::columns_of(5, std::vector<double>{0.1, 0.2}), (std::vector<std::size_t>{1, 1, 3}));
  EXPECT_EQ(fe::columns_of(3, std::vector<double>{0.4, 0.6}), (std::vector<std::size_t>{1, 1, 1}));
  EXPECT_EQ(fe::columns_of(7, {}), (std::vector<std::size_t>{7}));
  const std::vector<double> interfaces{0.31, 0.77};
  for (const std::size_t order : {1u, 2u}) {
    const fe::Mesh mesh(order, 9, 4, 3, 5, 7, 1.5, fe::Ends::clamped, interfaces);
    EXPECT_EQ(mesh.radius(0), 3);
    EXPECT_EQ(mesh.radius(mesh.across() - 1), 5);
    EXPECT_NEAR(mesh.radius(order * mesh.columns[0]), 3.62, 1e-14);
    EXPECT_NEAR(mesh.radius(order * (mesh.columns[0] + mesh.columns[1])), 4.54, 1e-14);
    for (std::size_t i = 1; i < mesh.across(); ++i) EXPECT_GT(mesh.radius(i), mesh.radius(i - 1));
  }
}

/// dΠ = F dl − V dP, Π = W − P V: of a wall of layers that was an open sector, held at its ends.
TEST(FiniteElementWalls, TheWorkOfPressureAndEndForceIsTheChangeOfEnergy) {
  const auto fibres = smooth_fibres(), matrix = make_model("mooney_rivlin");
  const std::vector<const Model*> models{fibres.get(), matrix.get()};
  const std::vector<double> parameters = joined(set_s, {20, 15});
  for (const std::size_t order : {1u, 2u}) {
    fe::Tube plan;
    plan.order = order;
    plan.radial = 4;
    plan.axial = 6;
    plan.inner = 3.71;
    plan.outer = 5.77;
    plan.length = 14;
    plan.interfaces = {0.45};
    const fe::Mesh mesh = fe::mesh_of(plan);
    thick_wall::Tube unloaded;
    unloaded.inner_radius = 3.71;
    unloaded.outer_radius = 5.77;
    unloaded.layered = true;
    unloaded.interfaces = {0.45};
    const thick_wall::Wall opened(unloaded, std::vector<double>{110, 0, 0, 0});
    const fe::Closing closing(mesh, opened, 1, false);
    const fe::Material material(models, parameters, mesh.columns, &closing);
    fe::Solver solver(mesh);
    Kernel::expect(solver.begin(material));
    fe::Path path(solver, {});
    Kernel::expect(path.begin());
    double lumen = 0, stored = 0;
    const auto at = [&](double stretch, double pressure) {
      Kernel::expect(path.go({stretch, pressure}, fe::Aim::factor));
      Kernel::expect(solver.assembly().energies(material, path.state(), lumen, stored));
      return path.observed();
    };
    at(1.1, 2);
    const double start = stored - 2 * lumen, stored_before = stored;
    const double work = boost::math::quadrature::gauss<double, 20>::integrate(
        [&](double t) { return at(1.1 + 0.15 * t, 2 + 12 * t)[2] * 0.15 * 7 - lumen * 12; }, 0, 1);
    at(1.25, 14);
    EXPECT_NEAR(stored - 14 * lumen - start, work, 1e-6 * std::abs(stored - stored_before)) << order;
  }
}

/// Held ends and support: the reduced force is the resultant of the axial stress at mid-length, less pressure over the
/// lumen, although the support pushes along a wall that is not straight. Against Gauss's rule through the wall.
TEST(FiniteElementWalls, TheForceOfASupportedTubeIsThatOfItsMiddleSection) {
  const auto model = smooth_fibres();
  fe::Tube plan;
  plan.order = 2;
  plan.radial = 6;
  plan.axial = 20;
  plan.inner = 3.71;
  plan.outer = 5.77;
  plan.length = 14;
  fe::Simulation simulation(plan);
  const fe::Material material(*model, set_s);
  std::vector<fe::Sample> samples;
  std::size_t failed_at = 0;
  const std::vector<fe::Load> loads{{1.2, 18}};
  const double slope = 12 / plan.outer;
  ASSERT_TRUE(simulation.run(material, loads, {}, samples, failed_at, slope).ok());
  std::vector<fe::Point> points;
  ASSERT_TRUE(simulation.solver().assembly().points(material, simulation.last(), points).ok());
  constexpr double weights[] = {5. / 9, 8. / 9, 5. / 9};
  const double h = (plan.outer - plan.inner) / 6, inner = samples[0].value[1];
  double force = -std::numbers::pi * 18 * inner * inner;
  for (std::size_t e = 0; e < 6; ++e)
    for (std::size_t g = 0; g < 3; ++g) {
      const fe::Point& at = points[9 * e + g];
      force += 2 * std::numbers::pi * at.stress()[1] * at.R * at.f[4] * at.f[0] * weights[g] * h / 2;
    }
  EXPECT_NEAR(samples[0].value[2], force, 1e-3 * std::abs(force) + 0.5);
  // What the test would miss if the support pulled at the section: 2π h.
  const fe::Support& support = simulation.solver().assembly().support;
  EXPECT_GT(2 * std::numbers::pi * slope * fe::Support::stored(samples[0].value[0], support.free.front()), 20);
}

/// Far from clamps the wall is that of the long tube, but for what the clamped zones take of its stretch, which falls
/// with 1/length: with layers, an opening angle and support, and with memory.
TEST(FiniteElementWalls, FarFromTheClampIsTheLongTube) {
  const auto fibres = smooth_fibres(), matrix = make_model("neo_hooke");
  const auto viscous = plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), smooth_fibres(), {});
  struct Case {
    std::vector<const Model*> layers;
    std::vector<double> parameters, own, thicknesses, time;
  };
  const std::vector<Case> cases{
      {{fibres.get(), matrix.get()}, joined(set_s, {90}), {80, 0.01, 6, 0.02}, {0.9, wall - 0.9}, {}},
      {{viscous.get()}, joined(set_s, {0.6, 5}), {40, 0, 3, 0, 1}, {}, {1, 4, 30}}};
  const std::vector<double> pressure{4, 12, 12};
  for (const Case& is : cases) {
    const Inflation exact =
        inflate(*make_tube(pressure, {.time = is.time, .layers = is.thicknesses}), *is.layers.front(), is.parameters,
                is.own, is.thicknesses.empty() ? std::span<const Model* const>() : std::span(is.layers));
    ASSERT_TRUE(exact.status.ok()) << exact.status.reason();
    const auto off = [&](double length) {
      Options options;
      options.set("length", length);
      options.set("grading", 3.);
      const Inflation found = inflate(*make_fe_tube(pressure, {.element = "quadrilateral_9",
                                                               .elements = "[4, 40]",
                                                               .options = options,
                                                               .layers = is.thicknesses,
                                                               .time = is.time}),
                                      *is.layers.front(), is.parameters, is.own,
                                      is.thicknesses.empty() ? std::span<const Model* const>() : std::span(is.layers));
      EXPECT_TRUE(found.status.ok()) << found.status.reason();
      double worst = 0;
      for (std::size_t i = 0; i < pressure.size(); ++i)
        worst = std::max(worst, std::abs(found.values[i] - exact.values[i]));
      return worst;
    };
    const double shorter = off(80), longer = off(160);
    std::printf("  clamped: %.1e at 80 mm, %.1e at 160 mm\n", shorter, longer);
    EXPECT_LT(longer, 2e-3);
    EXPECT_NEAR(longer / shorter, 0.5, 0.1);
  }
}

/// The bare tube is computed without anything of this, and beside the null the numbers are the same to 1e-12.
TEST(FiniteElementWalls, AtTheirNullsAreTheBareTube) {
  const auto model = make_model("gho");
  const std::vector<double> pressure{0, 9, 18};
  const auto tube = make_fe_tube(pressure, {.elements = "[5, 8]"});
  const Inflation bare = inflate(*tube, *model, set_s, bare_fe);
  fe::Tube plan;
  plan.radial = 5;
  plan.axial = 8;
  plan.inner = 3.71;
  plan.outer = 5.77;
  plan.length = 14;
  std::vector<fe::Sample> samples;
  std::size_t failed_at = 0;
  const std::vector<fe::Load> loads{{1.2, 0}, {1.2, 9}, {1.2, 18}};
  ASSERT_TRUE(fe::Simulation(plan).run(fe::Material(*model, set_s), loads, {}, samples, failed_at).ok());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(bare.values[i], samples[i].value[0] / 5.77);
    EXPECT_EQ(bare.values[3 + i], samples[i].value[2]);
  }
  for (std::size_t k = 0; k < bare_fe.size(); ++k)
    for (const double beside : {1e-13, -1e-13}) {
      if (k == tethering && beside < 0) continue;
      std::vector<double> own = bare_fe;
      own[k] += beside * (k == opening_angle ? 10 : k == layer_ratio ? 10 : 1);
      const Inflation near = inflate(*tube, *model, set_s, own);
      ASSERT_TRUE(near.status.ok()) << k << near.status.reason();
      for (std::size_t i = 0; i < bare.values.size(); ++i)
        EXPECT_NEAR(near.values[i], bare.values[i], 2e-12 * (1 + std::abs(bare.values[i]))) << k;
    }
}

}  // namespace
}  // namespace tunica::testing::walls_test
