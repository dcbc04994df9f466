// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "conformance/test_properties.hpp"
#include "support/fe_tube.hpp"
#include "support/strip.hpp"

namespace tunica::testing::sensitivity_test {
namespace {

const std::vector<std::string> all_channels{"axial_force", "outer_diameter_stretch", "inner_diameter", "outer_diameter",
                                            "inner_diameter_stretch"};

struct Case {
  const char *name, *element, *elements, *ends;
};
struct Wall {
  const char *name, *model, *fibre_switch;
  std::vector<double> parameters;
};

class FiniteElementSensitivity : public ::testing::TestWithParam<std::tuple<Case, Wall>> {
 protected:
  Case mesh = std::get<0>(GetParam());
  Wall wall = std::get<1>(GetParam());
  std::unique_ptr<Model> model = make_model(wall.model, switched());
  FeSetup setup{.element = mesh.element, .elements = mesh.elements, .ends = mesh.ends, .channels = all_channels};

  Options switched() const {
    Options options;
    if (wall.fibre_switch != nullptr) options.set("fibre_switch", std::string(wall.fibre_switch));
    return options;
  }
  /// The largest deviation of a column from differences of fourth order, over its channel's largest entry.
  double worst_column(const tunica::Test& tube, const std::vector<double>& own) {
    const std::size_t n = tube.rows().count, rows = n * all_channels.size(), models = wall.parameters.size();
    std::vector<double> jacobian((models + own.size()) * rows);
    const Status status = tube.predict({*model, wall.parameters, own}, {{}, jacobian, {}, {}});
    EXPECT_TRUE(status.ok()) << status.reason();
    double worst = 0;
    for (std::size_t j = 0; j < models + own.size(); ++j) {
      const double h = j < models                    ? 1e-3 * std::abs(wall.parameters[j])
                       : j == models + opening_angle ? 0.1
                       : j == models + tethering     ? 0.01
                                                     : 2e-4;
      const auto at = [&](double steps) {
        std::vector<double> p = wall.parameters, q = own;
        (j < models ? p[j] : q[j - models]) += steps * h;
        const Inflation out = inflate(tube, *model, p, q);
        EXPECT_TRUE(out.status.ok()) << out.status.reason();
        return out.values;
      };
      const auto up = at(1), down = at(-1), up2 = at(2), down2 = at(-2);
      for (std::size_t c = 0; c < all_channels.size(); ++c) {
        double scale = 0, off = 0;
        for (std::size_t i = c * n; i < (c + 1) * n; ++i) {
          const double expected = (8 * (up[i] - down[i]) - (up2[i] - down2[i])) / (12 * h);
          scale = std::max(scale, std::abs(jacobian[j * rows + i]));
          off = std::max(off, std::abs(jacobian[j * rows + i] - expected));
        }
        EXPECT_GT(scale, 0) << j;
        EXPECT_LE(off, 1e-7 * scale) << "parameter " << j << ", " << all_channels[c];
        worst = std::max(worst, off / scale);
      }
    }
    return worst;
  }
};

TEST_P(FiniteElementSensitivity, MatchesDifferencesForEveryParameter) {
  const double held = worst_column(*make_fe_tube({1, 8, 19}, setup), {20, 0.01, 2, 0.03, 1});
  setup.axial_stretches = {1.1, 1.25, 1.25, 1.1, 1.3};
  const double varied = worst_column(*make_fe_tube({2, 2, 14, 14, 6}, setup), {15, 0, 0, 0, 1});
  std::printf("  %s: %.1e, force–length %.1e\n", wall.name, held, varied);
}

/// Each row's derivative by its own pressure and axial stretch.
TEST_P(FiniteElementSensitivity, MatchesDifferencesByPressureAndAxialStretch) {
  setup.axial_stretches = {1.1, 1.25, 1.25, 1.1, 1.3};
  const std::vector<double> pressure{2, 2, 14, 14, 6};
  const auto tube = make_fe_tube(pressure, setup);
  const std::size_t n = pressure.size(), rows = n * all_channels.size();
  std::vector<double> derivative(2 * rows);
  ASSERT_TRUE(tube->predict({*model, wall.parameters, bare_fe}, {{}, {}, derivative, {}}).ok());
  for (std::size_t a = 0; a < 2; ++a) {
    const double h = a == 0 ? 5e-3 : 2e-4;
    const auto at = [&](double steps) {
      std::vector<double> columns[2] = {pressure, setup.axial_stretches};
      for (double& value : columns[a]) value += steps * h;
      const std::vector<std::span<const double>> abscissae{columns[0], columns[1]};
      std::vector<double> values(rows);
      EXPECT_TRUE(tube->predict({*model, wall.parameters, bare_fe, abscissae}, {values, {}, {}, {}}).ok());
      return values;
    };
    const auto up = at(1), down = at(-1), up2 = at(2), down2 = at(-2);
    for (std::size_t i = 0; i < rows; ++i) {
      double scale = 0;
      for (std::size_t k = i / n * n; k < i / n * n + n; ++k)
        scale = std::max(scale, std::abs(derivative[a * rows + k]));
      const double expected = (8 * (up[i] - down[i]) - (up2[i] - down2[i])) / (12 * h);
      EXPECT_NEAR(derivative[a * rows + i], expected, 1e-7 * scale) << a << ", " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, FiniteElementSensitivity,
    ::testing::Combine(
        ::testing::Values(Case{"FourNodesClamped", "quadrilateral_4", "[4, 7]", "clamped"},
                          Case{"FourNodesClampedLater", "quadrilateral_4", "[4, 7]", "clamped_after_stretch"},
                          Case{"FourNodesSliding", "quadrilateral_4", "[4, 3]", "sliding"},
                          Case{"NineNodesClamped", "quadrilateral_9", "[2, 4]", "clamped"},
                          Case{"NineNodesClampedLater", "quadrilateral_9", "[2, 4]", "clamped_after_stretch"},
                          Case{"NineNodesSliding", "quadrilateral_9", "[3, 2]", "sliding"}),
        ::testing::Values(Wall{"Gho", "gho", "none", set_s}, Wall{"GhoThatSwitches", "gho", "strain", set_s},
                          Wall{"HgoThatSwitches", "hgo", "strain", {30, 20, 0.6, 40}},
                          Wall{"MooneyRivlin", "mooney_rivlin", nullptr, {25, 15}})),
    [](const auto& at) { return std::string(std::get<0>(at.param).name) + std::get<1>(at.param).name; });

/// Derivatives of an interpolated curve are the interpolated derivatives.
TEST(FiniteElementCurve, IsAndDifferentiatesAsEveryRowAlone) {
  const auto model = make_model("gho");
  const std::vector<double> pressure = evenly(-1, 22.66474, 40);
  for (const auto& [element, elements] : {std::pair{"quadrilateral_4", "[6, 12]"}, {"quadrilateral_9", "[3, 6]"}}) {
    const FeSetup setup{.element = element, .elements = elements};
    const std::size_t n = pressure.size(), all = 10;
    std::vector<double> values(2 * n), jacobian(all * 2 * n), one(2), one_jacobian(all * 2);
    ASSERT_TRUE(make_fe_tube(pressure, setup)->predict({*model, set_s, bare_fe}, {values, jacobian, {}, {}}).ok());
    double worst[2] = {0, 0}, scale[2] = {1, 0};
    std::vector<double> column_scale(2 * all), column_worst(2 * all);
    for (std::size_t i = 0; i < n; ++i) {
      const auto alone = make_fe_tube({pressure[i]}, setup);
      ASSERT_TRUE(alone->predict({*model, set_s, bare_fe}, {one, one_jacobian, {}, {}}).ok());
      scale[1] = std::max(scale[1], std::abs(one[1]));
      for (std::size_t c = 0; c < 2; ++c) {
        worst[c] = std::max(worst[c], std::abs(one[c] - values[c * n + i]));
        for (std::size_t j = 0; j < all; ++j) {
          const double exact = one_jacobian[j * 2 + c];
          column_scale[2 * j + c] = std::max(column_scale[2 * j + c], std::abs(exact));
          column_worst[2 * j + c] = std::max(column_worst[2 * j + c], std::abs(exact - jacobian[(2 * j + c) * n + i]));
        }
      }
    }
    EXPECT_LE(worst[0], 1e-6);
    EXPECT_LE(worst[1], 1e-5 * scale[1]);
    double columns = 0, by_angle = 0;
    for (std::size_t k = 0; k < 2 * all; ++k) {
      if (column_scale[k] == 0) continue;
      double& worst_of = k / 2 == 5 + opening_angle ? by_angle : columns;
      worst_of = std::max(worst_of, column_worst[k] / column_scale[k]);
    }
    std::printf("  %s interpolated: %.1e in D/D0, %.1e in force, %.1e of a derivative\n", element, worst[0],
                worst[1] / scale[1], columns);
    EXPECT_LE(columns, 1e-3);
    EXPECT_LE(by_angle, 1e-2);  // it has the modulus of fibres in it, which jumps where they switch
    // It is that of the curve as it is interpolated all the same.
    const auto tube = make_fe_tube(pressure, setup);
    const auto at = [&](double angle) {
      std::vector<double> own = bare_fe;
      own[opening_angle] += angle;
      const Inflation out = inflate(*tube, *model, set_s, own);
      EXPECT_TRUE(out.status.ok()) << out.status.reason();
      return out.values;
    };
    constexpr double h = 1e-3;
    const std::vector<double> up = at(h), down = at(-h);
    double off = 0;
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t i = c * n; i < (c + 1) * n; ++i)
        off = std::max(off, std::abs((up[i] - down[i]) / (2 * h) - jacobian[(5 + opening_angle) * 2 * n + i]) /
                                column_scale[2 * (5 + opening_angle) + c]);
    std::printf("  by the opening angle %.1e from every row alone, %.1e from differences\n", by_angle, off);
    EXPECT_LE(off, 1e-5);
  }
}

}  // namespace
}  // namespace tunica::testing::sensitivity_test
