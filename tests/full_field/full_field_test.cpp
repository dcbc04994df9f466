// SPDX-License-Identifier: Apache-2.0
// Measured fields by finite elements: homogeneous states on any mesh, differences, meshes, and what is refused.
#include <array>
#include <cmath>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sheet.hpp"
#include "support/strip.hpp"

namespace tunica::testing::full_field {
namespace {

using ::testing::HasSubstr;

/// F = [[1 + 0.2, 0.1], [0.05, 1 − 0.08]] at the full load.
constexpr std::array<double, 4> strain{0.2, 0.1, 0.05, -0.08};
Point affine(const Point& at, double load) {
  return {load * (strain[0] * at[0] + strain[1] * at[1]) + 0.3, load * (strain[2] * at[0] + strain[3] * at[1]) - 0.1};
}

const std::vector<double> wall{20, 0.1, 30, 1.2, 40}, foam{25, 6, 0.18};

std::unique_ptr<Model> hyperfoam() {
  Options options;
  options.set("terms", std::int64_t{1});
  options.set("poisson", std::string("shared"));
  return make_model("hyperfoam", options);
}

/// First Piola–Kirchhoff stress of the sheet, xx and yy, by differences of the energy with free or held faces.
template <class Energy>
Point nominal_stress(const Energy& energy, std::array<double, 4> F) {
  const auto slope = [&](std::size_t k) {
    constexpr double h = 1e-5;
    auto ahead = F, behind = F;
    ahead[k] += h;
    behind[k] -= h;
    return (energy(ahead) - energy(behind)) / (2 * h);
  };
  return {slope(0), slope(3)};
}

double energy_of(const Model& model, const std::vector<double>& p, const std::array<double, 4>& F, double normal) {
  const auto [xx, xy, yx, yy] = F;
  const std::array<double, 6> C{xx * xx + yx * yx, xy * xy + yy * yy, normal, xx * xy + yx * yy, 0, 0};
  std::array<double, 1> W{};
  EXPECT_TRUE(model.evaluate({1, C, p, {}, {}}, {W, {}, {}, {}, {}}).ok());
  return W[0];
}

// All edges measured: a sheared homogeneous state, inside too.
TEST(FullField, AffineEdgesGiveTheHomogeneousState) {
  Measured measured = measure({0.5, 1}, affine, {-3, 1}, {7, 7});
  measured.channels = {"ux", "uy"};
  const auto test = make({}, measured);
  const std::size_t n = measured.step.size();
  std::vector<double> values(2 * n);
  const auto gho = make_model("gho");
  const Status status = test->predict({*gho, wall, test->describe().nulls}, {values, {}, {}, {}});
  ASSERT_TRUE(status.ok()) << status.reason();
  for (std::size_t i = 0; i + 2 < n; ++i) {
    EXPECT_NEAR(values[i], measured.ux[i], 1e-9);
    EXPECT_NEAR(values[n + i], measured.uy[i], 1e-9);
  }
}

constexpr const char* sliding = R"({"left": {"x": "measured"}, "right": {"x": "measured"},
                                   "bottom": {"y": "measured"}, "top": {"y": "measured"}})";

// x is the circumferential axis at an angle of 0, so that C in x and y is C in t and z.
TEST(FullField, ForcesAreThoseOfTheEnergy) {
  const auto stretched = [](const Point& at, double load) -> Point {
    return {load * strain[0] * at[0], load * strain[3] * at[1]};
  };
  const Measured measured = measure({0.5, 1}, stretched, {-3, 1}, {7, 7});
  const auto gho = make_model("gho");
  const auto foamed = hyperfoam();
  for (const bool held : {false, true}) {
    const Model& model = held ? *foamed : *gho;
    const std::vector<double>& p = held ? foam : wall;
    Plate setup;
    setup.state = held ? "plane_strain" : "plane_stress";
    setup.boundary = sliding;
    const auto test = make(setup, measured);
    const std::size_t n = measured.step.size();
    std::vector<double> values(6 * n);
    const Status status = test->predict({model, p, test->describe().nulls}, {values, {}, {}, {}});
    ASSERT_TRUE(status.ok()) << status.reason();
    for (std::size_t s = 0; s < 2; ++s) {
      const double load = measured.step[n - 2 + s];
      const auto stress = nominal_stress(
          [&](const std::array<double, 4>& at) {
            const double J = at[0] * at[3] - at[1] * at[2];
            return energy_of(model, p, at, held ? 1 : 1 / (J * J));
          },
          {1 + load * strain[0], 0, 0, 1 + load * strain[3]});
      // A side of 6 mm bears the stress along x, one of 10 mm that along y; the sheet is 2 mm thick.
      const std::array<double, 4> expected{12 * stress[0], 12 * stress[0], 20 * stress[1], 20 * stress[1]};
      for (std::size_t side = 0; side < 4; ++side)
        EXPECT_NEAR(values[(2 + side) * n + n - 2 + s], expected[side], 1e-6 * (1 + std::abs(expected[side])))
            << held << side;
    }
  }
}

/// Not affine: a bulge on top of it, so that the inside is solved for.
Point bulging(const Point& at, double load) {
  Point u = affine(at, load);
  u[0] += load * 0.1 * std::sin(0.4 * at[1]);
  u[1] += load * 0.008 * at[0] * at[0];
  return u;
}

/// The measurement with the displacements that a model has between its edges.
Measured simulated(const Plate& setup, const Measured& measured, const Model& model, const std::vector<double>& p) {
  Measured own = measured;
  const std::size_t n = own.step.size();
  std::vector<double> field(measured.channels.size() * n);
  const auto test = make(setup, measured);
  EXPECT_TRUE(test->predict({model, p, test->describe().nulls}, {field, {}, {}, {}}).ok());
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(own.x[i])) continue;
    own.ux[i] = field[i];
    own.uy[i] = field[n + i];
  }
  return own;
}

TEST(FullField, DerivativesAreThoseOfDifferences) {
  Measured measured = measure({0.5, 1}, bulging, {-3, 1}, {7, 7}, 9);
  measured.channels = {"ux", "uy", "force_left", "force_right"};
  struct Case {
    std::unique_ptr<Model> model;
    std::vector<double> p;
    std::string state;
    double angle;
  };
  std::vector<Case> cases;
  cases.push_back({make_model("gho"), wall, "plane_stress", 0});
  cases.push_back({make_model("gho"), wall, "plane_stress", 20});
  cases.push_back({hyperfoam(), foam, "plane_stress", 0});
  cases.push_back({hyperfoam(), foam, "plane_strain", 0});
  for (const Case& one : cases) {
    Plate setup;
    setup.state = one.state;
    setup.angle = one.angle;
    setup.boundary = R"({"left": "measured", "right": "measured"})";
    const std::size_t channels = measured.channels.size(), size = channels * measured.step.size();
    // The edges follow the parameters, up to terms of the size of what is left. So the field is that of the parameters.
    const auto test = make(setup, simulated(setup, measured, *one.model, one.p));
    std::vector<double> jacobian((one.p.size() + test->describe().nulls.size()) * size), values(size);
    ASSERT_TRUE(test->predict({*one.model, one.p, test->describe().nulls}, {values, jacobian, {}, {}}).ok());
    for (std::size_t j = 0; j < one.p.size(); ++j) {
      std::vector<double> ahead(size), behind(size), p = one.p;
      const double h = 1e-5 * (0.1 + std::abs(one.p[j]));
      p[j] = one.p[j] + h;
      ASSERT_TRUE(test->predict({*one.model, p, test->describe().nulls}, {ahead, {}, {}, {}}).ok());
      p[j] = one.p[j] - h;
      ASSERT_TRUE(test->predict({*one.model, p, test->describe().nulls}, {behind, {}, {}, {}}).ok());
      for (std::size_t k = 0; k < channels; ++k) {
        double scale = 1e-7, worst = 0;
        for (std::size_t i = k * size / channels; i < (k + 1) * size / channels; ++i)
          scale = std::max(scale, std::abs(jacobian[j * size + i]));
        for (std::size_t i = k * size / channels; i < (k + 1) * size / channels; ++i)
          worst = std::max(worst, std::abs((ahead[i] - behind[i]) / (2 * h) - jacobian[j * size + i]));
        EXPECT_LT(worst / scale, 1e-4) << one.state << one.angle << " channel " << k << " parameter " << j;
      }
    }
  }
}

double largest_of(const std::vector<double>& of, std::size_t first, std::size_t last) {
  double most = 0;
  for (std::size_t i = first; i < last; ++i) most = std::max(most, std::abs(of[i]));
  return most;
}

// Where searches begin. Undamped steps of the edges ask for what no material bears, and the stiffness jumps where
// fibres are switched on.
TEST(FullField, FarFromTheMaterialTheFieldHasAnAnswer) {
  const auto pulled = [](const Point& at, double load) -> Point { return {0.3 * load * at[0], -0.1 * load * at[1]}; };
  Measured measured = measure({0.4, 1}, pulled, {-11, -9.5}, {11, 9.5}, 14);
  for (std::size_t i = measured.step.size(); i-- > 0;)
    if (std::hypot(measured.x[i], measured.y[i]) < 4.2)
      for (auto* column : {&measured.step, &measured.x, &measured.y, &measured.ux, &measured.uy})
        column->erase(column->begin() + static_cast<std::ptrdiff_t>(i));
  measured.channels = {"ux", "uy", "force_right"};
  Plate setup;
  setup.shape = R"({"rectangle": [24, 20], "corner": [-12, -10], "holes": [{"centre": [0, 0], "radius": 4}]})";
  setup.mesh = R"({"size": 2.5})";
  setup.boundary = R"({"left": "measured", "right": "measured"})";
  setup.angle = 90;
  setup.smoothing = 6;
  const auto gho = make_model("gho");
  const auto test = make(setup, simulated(setup, measured, *gho, wall));
  const std::size_t size = measured.channels.size() * measured.step.size();
  for (const std::vector<double>& p : {std::vector<double>{10, 0.1, 10, 1, 45},
                                       {7.528, 0.1697, 0.4415, 1.282, 11.52},
                                       {0.2431, 0.2908, 451.8, 0.01028, 57.71},
                                       {0.3717, 0.1285, 12.54, 19.69, 58.42}}) {
    std::vector<double> values(size);
    const Status status = test->predict({*gho, p, test->describe().nulls}, {values, {}, {}, {}});
    EXPECT_TRUE(status.ok()) << p[0] << ": " << status.reason();
  }
}

// Around a hole, where the points of the camera are too few for the strain, and with a material ten per cent away too.
TEST(FullField, AFewStepsComeCloseToTheEquilibrium) {
  const auto pulled = [](const Point& at, double load) -> Point { return {0.2 * load * at[0], -0.05 * load * at[1]}; };
  Measured measured = measure({0.5, 1}, pulled, {1.2, 1.2}, {5, 5});
  measured.channels = {"ux", "uy", "force_left", "force_right"};
  Plate setup;
  setup.shape = R"({"rectangle": [5, 5], "holes": [{"centre": [0, 0], "radius": 1}]})";
  setup.mesh = R"({"size": 0.5})";
  setup.unseen = "accept";
  setup.boundary = R"({"left": {"x": "fixed"}, "right": {"x": "uniform"}, "bottom": {"y": "fixed"}})";
  const auto gho = make_model("gho");
  const Measured own = simulated(setup, measured, *gho, wall);
  const auto exact = make(setup, own);
  setup.method = "modified_newton";
  const auto quick = make(setup, own);
  EXPECT_TRUE(exact->describe().costly);
  EXPECT_FALSE(quick->describe().costly);
  const std::size_t n = own.step.size(), size = own.channels.size() * n;
  for (const auto& [factor, near, near_slope] : {std::tuple(1.0, 1e-4, 0.02), std::tuple(1.1, 1e-4, 0.02)}) {
    const std::size_t slopes = (wall.size() + exact->describe().nulls.size()) * size;
    std::vector<double> p = wall, a(size), b(size), slope_a(slopes), slope_b(slopes);
    p[2] *= factor;
    ASSERT_TRUE(exact->predict({*gho, p, exact->describe().nulls}, {a, slope_a, {}, {}}).ok());
    ASSERT_TRUE(quick->predict({*gho, p, exact->describe().nulls}, {b, slope_b, {}, {}}).ok());
    for (std::size_t k = 0; k < own.channels.size(); ++k) {
      std::vector<double> gap(size);
      for (std::size_t i = 0; i < size; ++i) gap[i] = a[i] - b[i];
      EXPECT_LT(largest_of(gap, k * n, (k + 1) * n), near * largest_of(a, k * n, (k + 1) * n)) << k << " at " << factor;
      for (std::size_t j = 0; j < p.size(); ++j) {
        std::vector<double> apart(size);
        for (std::size_t i = 0; i < size; ++i) apart[i] = slope_a[j * size + i] - slope_b[j * size + i];
        EXPECT_LT(largest_of(apart, k * n, (k + 1) * n),
                  near_slope * largest_of(slope_a, j * size + k * n, j * size + (k + 1) * n) + 1e-9)
            << k << " by " << j << " at " << factor;
      }
    }
  }
}

// A quarter of a plate with a hole, whose curved edge is smooth: the force loses at least a factor of four where
// triangles are halved, as it does with the square of their size or faster.
TEST(FullField, ConvergesWithTheMesh) {
  const auto pulled = [](const Point& at, double) -> Point { return {0.2 * at[0], 0.05 * at[1]}; };
  const Measured measured = measure({1}, pulled, {1.2, 1.2}, {3, 3});
  const auto model = make_model("neo_hooke");
  std::vector<double> force;
  for (const char* size : {"0.28", "0.14", "0.05"}) {
    Plate setup;
    setup.mesh = std::string(R"({"size": )") + size + "}";
    setup.unseen = "accept";
    setup.shape = R"({"rectangle": [3, 3], "holes": [{"centre": [0, 0], "radius": 1.5}]})";
    setup.boundary = R"({"left": {"x": "fixed"}, "right": {"x": "uniform"}, "bottom": {"y": "fixed"},
                         "top": {"y": "uniform"}})";
    const auto test = make(setup, measured);
    const std::size_t n = measured.step.size();
    std::vector<double> values(6 * n);
    const std::vector<double> p{100};
    ASSERT_TRUE(test->predict({*model, p, test->describe().nulls}, {values, {}, {}, {}}).ok());
    force.push_back(values[4 * n - 1]);
  }
  EXPECT_GT(std::abs(force[0] - force[2]), 4 * std::abs(force[1] - force[2]));
  EXPECT_NEAR(force[1] / force[2], 1, 1e-4);
}

std::string refusal(const Plate& setup, const Measured& measured) {
  try {
    make(setup, measured);
  } catch (const InputError& problem) {
    return problem.what();
  }
  return "none";
}

TEST(FullField, RefusesWhatItCannotSimulate) {
  Measured measured = measure({1}, affine, {-3, 1}, {7, 7});
  measured.channels = {"ux", "uy"};
  const auto with = [&](auto change) {
    Plate setup;
    change(setup);
    return refusal(setup, measured);
  };
  EXPECT_EQ(with([](Plate&) {}), "none");
  EXPECT_THAT(with([](Plate& s) { s.mesh = R"({"file": "none.msh"})"; }), HasSubstr("\"shape\""));
  EXPECT_THAT(with([](Plate& s) {
                s.mesh = R"({"file": "none.msh"})";
                s.shape = "null";
              }),
              HasSubstr("none.msh does not exist"));
  EXPECT_THAT(with([](Plate& s) { s.mesh = R"({"size": "2 kPa"})"; }), HasSubstr("kPa"));
  EXPECT_THAT(with([](Plate& s) { s.mesh = R"({"size": 0.001})"; }), HasSubstr("triangles"));
  EXPECT_THAT(with([](Plate& s) { s.boundary = R"({"left": "fixed"})"; }), HasSubstr("nothing would move"));
  EXPECT_THAT(with([](Plate& s) { s.boundary = R"({"left": {"x": "measured"}})"; }),
              HasSubstr("holds the specimen in y"));
  EXPECT_THAT(with([](Plate& s) { s.boundary = R"({"left": "glued"})"; }), HasSubstr("glued"));
  EXPECT_THAT(with([](Plate& s) { s.shape = R"({"rectangle": [5, 5]})"; }), HasSubstr("outside of the specimen"));
  EXPECT_THAT(with([](Plate& s) { s.shape = R"({"rectangle": [30, 6], "corner": [-3, 1]})"; }),
              HasSubstr("ends where points"));
  const auto forces = [&](const char* boundary) {
    Plate setup;
    setup.boundary = boundary;
    Measured loaded = measured;
    loaded.channels.push_back("force_right");
    return refusal(setup, loaded);
  };
  EXPECT_THAT(forces(R"({"right": "measured", "top": {"x": "measured"}})"), HasSubstr("'force_right'"));
  EXPECT_THAT(forces(R"({"left": "measured", "top": {"y": "measured"}})"), HasSubstr("bears none"));
  EXPECT_EQ(forces(R"({"right": {"x": "measured"}, "top": {"y": "measured"}})"), "none");
  Measured gap = measured;
  for (std::size_t i = 0; i < gap.x.size(); ++i)
    if (gap.x[i] < 0 && gap.y[i] > 4) gap.ux[i] = nan;
  EXPECT_THAT(refusal({}, gap), HasSubstr("no point lies near it"));
  const auto taller = [](Plate& s) {
    s.shape = R"({"rectangle": [10, 8], "corner": [-3, 1]})";
    s.boundary = R"({"left": {"x": "uniform", "y": "fixed"}, "right": {"x": "uniform"}})";
  };
  EXPECT_THAT(with(taller), HasSubstr("beyond the points on the top side"));
  EXPECT_EQ(with([&](Plate& s) {
              taller(s);
              s.unseen = "accept";
            }),
            "none");
  EXPECT_THAT(with([](Plate& s) { s.mesh = R"({"file": 3})"; }), HasSubstr("is no text"));
  Measured alone = measured;
  alone.channels = {"uy"};
  EXPECT_THAT(refusal({}, alone), HasSubstr("no column is mapped to 'ux'"));
  const auto test = make({.state = "plane_strain"}, measured);
  EXPECT_EQ(test->describe().volume, TestDescription::Volume::free);
}

}  // namespace
}  // namespace tunica::testing::full_field
