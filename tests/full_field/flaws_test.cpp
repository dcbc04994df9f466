// SPDX-License-Identifier: Apache-2.0
// Flaws of a sheet and of how it is held: where they are parameters, their derivatives, and a state that they leave.
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "sheet.hpp"

namespace tunica::testing::flawed_sheet {
namespace {

using full_field::make, full_field::Measured, full_field::measure, full_field::Plate, full_field::Point;

Point drawn(const Point& at, double load) { return {0.2 * load * (at[0] + 3), -0.08 * load * at[1]}; }

constexpr const char* clamped = R"({"left": "fixed", "right": {"x": "uniform", "y": "fixed"}})";

std::vector<std::string> names_of(const Test& test) {
  std::vector<std::string> names;
  for (const Parameter& parameter : test.describe().parameters) names.push_back(parameter.name);
  return names;
}

// A flaw of an edge is a parameter where the edge could show it: not where it is fitted freely, nor in half a specimen.
TEST(FlawedSheet, HasTheFlawsThatItsEdgesCanShow) {
  Measured measured = measure({1}, drawn, {-3, 1}, {7, 7});
  measured.channels = {"ux", "uy"};
  const auto with = [&](const char* boundary) {
    Plate setup;
    setup.boundary = boundary;
    return names_of(*make(setup, measured));
  };
  const std::vector<std::string> uneven{"thickness_gradient", "thickness_gradient_direction", "stiffer_half",
                                        "stiffer_half_direction"};
  const auto and_uneven = [&](std::vector<std::string> names) {
    names.insert(names.end(), uneven.begin(), uneven.end());
    return names;
  };
  EXPECT_EQ(with(R"({"left": "measured", "right": "measured"})"), uneven);
  EXPECT_EQ(with(clamped), and_uneven({"clamp_slip", "grip_tilt", "oblique_pull"}));
  EXPECT_EQ(with(R"({"left": "fixed", "right": "measured"})"), and_uneven({"clamp_slip"}));
  EXPECT_EQ(with(R"({"left": {"x": "uniform", "y": "fixed"}, "right": {"x": "uniform", "y": "measured"}})"),
            and_uneven({"grip_tilt", "oblique_pull"}));
  EXPECT_EQ(with(R"({"left": {"x": "fixed"}, "right": {"x": "uniform"}, "bottom": {"y": "fixed"}})"),
            and_uneven({"grip_tilt"}));
  EXPECT_EQ(with(R"({"right": {"x": "uniform", "y": "fixed"}})"), uneven) << "nothing holds the left side";
  EXPECT_EQ(with(R"({"left": "fixed", "right": {"x": "uniform", "y": "fixed"}, "top": {"y": "fixed"}})"),
            and_uneven({"clamp_slip", "grip_tilt"}))
      << "the upper side guides y";
}

/// A sheet drawn out between clamps, as a material has it that has these flaws.
struct Flawed {
  Measured measured;
  std::unique_ptr<Model> model = make_model("neo_hooke");
  std::vector<double> p{100};
  std::unique_ptr<Test> test;
  explicit Flawed(const std::vector<double>& flaws) {
    const auto pulled = [](const Point& at, double load) -> Point { return {0.2 * load * (at[0] + 3), 0}; };
    measured = measure({0.5, 1}, pulled, {-3, 1}, {7, 7}, 9);
    measured.channels = {"ux", "uy", "force_left", "force_right"};
    Plate setup;
    setup.boundary = clamped;
    test = make(setup, measured);
    const std::vector<double> field = values(flaws);
    for (std::size_t i = 0; i < measured.step.size(); ++i) {
      if (!std::isfinite(measured.x[i])) continue;
      measured.ux[i] = field[i];
      measured.uy[i] = field[measured.step.size() + i];
    }
    test = make(setup, measured);
  }
  [[nodiscard]] std::vector<double> values(const std::vector<double>& flaws, std::span<double> jacobian = {}) const {
    std::vector<double> found(4 * measured.step.size());
    const Status status = test->predict({*model, p, flaws}, {found, jacobian, {}, {}});
    EXPECT_TRUE(status.ok()) << status.reason();
    return found;
  }
};

// At rest, and with all flaws at once.
TEST(FlawedSheet, DerivativesByFlawsAreThoseOfDifferences) {
  const std::vector<double> somewhere{0.03, -0.05, 4, 0.2, 30, -0.15, 70};
  const std::size_t count = somewhere.size();
  for (const std::vector<double>& flaws : {std::vector<double>(count, 0.0), somewhere}) {
    const Flawed sheet(flaws);
    const std::size_t n = sheet.measured.step.size(), size = 4 * n;
    std::vector<double> jacobian((1 + count) * size);
    EXPECT_EQ(sheet.values(flaws, jacobian).size(), size);
    for (std::size_t q = 0; q < count; ++q) {
      std::vector<double> ahead = flaws, behind = flaws;
      const double h = std::abs(somewhere[q]) * 1e-3;
      ahead[q] += h;
      behind[q] -= h;
      const std::vector<double> above = sheet.values(ahead), below = sheet.values(behind);
      for (std::size_t k = 0; k < 4; ++k) {
        double scale = 0, worst = 0;
        for (std::size_t i = k * n; i < (k + 1) * n; ++i) {
          const double difference = (above[i] - below[i]) / (2 * h);
          scale = std::max(scale, std::abs(difference));
          worst = std::max(worst, std::abs(difference - jacobian[(1 + q) * size + i]));
        }
        EXPECT_LE(worst, 2e-4 * scale + 1e-7) << names_of(*sheet.test)[q] << " channel " << k << " of " << flaws[q];
        // A direction has no effect at rest.
        if (k < 2) {
          EXPECT_EQ(scale > 1e-6, flaws[q] != 0 || (q != 4 && q != 6)) << names_of(*sheet.test)[q] << scale;
        }
      }
    }
  }
}

// Of the last step: the right side moves by L in its middle.
TEST(FlawedSheet, EdgesMoveAsTheAmplitudesSay) {
  constexpr std::size_t last = 81, low = last + 72, middle = last + 76, high = last + 80;  // of the right side
  const auto uy = [](std::size_t at) { return at + 2 * 81 + 2; };
  for (const double size : {-0.04, 0.0, 0.07}) {
    const double slip = std::abs(size), tilt = 2 * size, degrees = 100 * size;
    const Flawed sheet({slip, tilt, degrees, 0, 0, 0, 0});
    ASSERT_EQ(sheet.measured.x[high], 7);
    ASSERT_EQ(sheet.measured.y[high], 7);
    ASSERT_EQ(sheet.measured.y[middle], 4);
    const std::vector<double> u = sheet.values({slip, tilt, degrees, 0, 0, 0, 0});
    const double L = u[middle];
    EXPECT_GT(L, 1);
    EXPECT_NEAR(u[high], L * (1 + tilt), 1e-9);
    EXPECT_NEAR(u[low], L * (1 - tilt), 1e-9);
    for (const std::size_t at : {low, middle, high})
      EXPECT_NEAR(u[uy(at)], L * std::tan(degrees * std::numbers::pi / 180), 1e-9);
    for (const std::size_t at : {last, last + 4, last + 8}) {  // of the left side
      EXPECT_NEAR(u[at], slip * L, 1e-9);
      EXPECT_NEAR(u[uy(at)], 0, 1e-9);
    }
  }
}

// Whatever side it is, an oblique pull has the same sign in x and y, and the upper or right end of a tilted side goes
// farther.
TEST(FlawedSheet, EverySideMovesAsTheAmplitudesSay) {
  constexpr std::array<const char*, 4> boundaries{R"({"right": "fixed", "left": {"x": "uniform", "y": "fixed"}})",
                                                  clamped,
                                                  R"({"top": "fixed", "bottom": {"x": "fixed", "y": "uniform"}})",
                                                  R"({"bottom": "fixed", "top": {"x": "fixed", "y": "uniform"}})"};
  constexpr double tilt = 0.1, degrees = 5;
  for (std::size_t side = 0; side < 4; ++side) {
    const std::size_t c = side / 2;
    const double still = c == 0 ? (side == 0 ? 7 : -3) : (side == 2 ? 7 : 1);
    const auto pulled = [&](const Point& at, double load) {
      Point u{0, 0};
      u[c] = 0.1 * load * (at[c] - still);
      return u;
    };
    Measured measured = measure({1}, pulled, {-3, 1}, {7, 7}, 9);
    measured.channels = {"ux", "uy"};
    Plate setup;
    setup.boundary = boundaries[side];
    const auto test = make(setup, measured);
    ASSERT_EQ(names_of(*test)[1], "grip_tilt");
    const std::size_t n = measured.step.size();
    std::vector<double> u(2 * n);
    const auto model = make_model("neo_hooke");
    const std::vector<double> p{100}, flaws{0, tilt, degrees, 0, 0, 0, 0};
    ASSERT_TRUE(test->predict({*model, p, flaws}, {u, {}, {}, {}}).ok());
    const std::size_t end = side % 2 == 0 ? 0 : 8, step = c == 0 ? 1 : 9, first = c == 0 ? 9 * end : end;
    const double L = u[c * n + first + 4 * step];
    EXPECT_EQ(L > 0, side % 2 == 1);
    EXPECT_NEAR(u[c * n + first + 8 * step], L * (1 + tilt), 1e-9) << side;
    EXPECT_NEAR(u[(1 - c) * n + first + 4 * step], L * std::tan(degrees * std::numbers::pi / 180), 1e-9) << side;
  }
}

/// Nominal stress of a sheet of neo-Hookean rubber, mu = 100 kPa, whose width is held.
double held_stress(double stretch) { return 100 * (stretch - std::pow(stretch, -3)); }

// Pulled along an axis with the width held, a sheet that is uneven along that axis bears h P(λ) = N everywhere: what is
// thicker is stretched less.
TEST(FlawedSheet, WhatIsThickerStretchesLess) {
  for (const std::size_t c : {0, 1})
    for (const double turn : {0.0, 180.0})
      for (const bool step : {false, true}) {
        const double direction = turn - (c == 1 ? 90 : 0), sign = (turn == 0) == (c == 0) ? 1 : -1;
        const Point from{-3, 1}, to{7, 7};
        const double length = to[c] - from[c], width = to[1 - c] - from[1 - c];
        const auto pulled = [&](const Point& at, double load) {
          Point u{0, 0};
          u[c] = 0.3 * load * (at[c] - from[c]);
          return u;
        };
        Measured measured = measure({0.5, 1}, pulled, from, to);
        measured.channels = {"ux", "uy", c == 0 ? "force_right" : "force_top"};
        Plate setup;
        setup.mesh = R"({"size": 1})";
        setup.boundary = c == 0 ? R"({"left": {"x": "fixed"}, "right": {"x": "uniform"}, "bottom": {"y": "fixed"},
                                      "top": {"y": "fixed"}})"
                                : R"({"bottom": {"y": "fixed"}, "top": {"y": "uniform"}, "left": {"x": "fixed"},
                                      "right": {"x": "fixed"}})";
        const auto test = make(setup, measured);
        ASSERT_EQ(names_of(*test).size(), 5u);
        const std::size_t n = measured.step.size();
        std::vector<double> u(3 * n);
        const auto model = make_model("neo_hooke");
        const std::vector<double> p{100},
            flaws = step ? std::vector<double>{0, 0, 0, 0.3, direction} : std::vector<double>{0, 0.4, direction, 0, 0};
        ASSERT_TRUE(test->predict({*model, p, flaws}, {u, {}, {}, {}}).ok());
        const double N = u[3 * n - 1] / (2 * width);
        ASSERT_GT(N, 20);
        for (std::size_t k = 0; k < 12; ++k) {
          const double xi = sign * ((static_cast<double>(k) + 0.5) / 12 - 0.5);
          if (step && std::abs(xi) < 0.2) continue;  // elements across the border
          const std::size_t at = 169 + (c == 0 ? 13 * k + 6 : 13 * 6 + k), next = at + (c == 0 ? 13 : 1);
          const double stretch = 1 + (u[c * n + next] - u[c * n + at]) / (length / 12);
          const double h = !step ? 1 + 0.4 * xi : xi > 0 ? 1.3 : 0.7;
          EXPECT_NEAR(h * held_stress(stretch) / N, 1, 0.01) << c << ' ' << direction << ' ' << xi;
        }
      }
}

// The state of a sheet between sliding edges is homogeneous, however its thickness 1 + g ξ changes across the pull, and
// ∫ h P dy = P. So it is where halves differ, but for the integral over elements that the border crosses.
TEST(FlawedSheet, AnUnevenSheetBetweenSlidingEdgesKeepsItsStateAndLoad) {
  const auto stretched = [](const Point& at, double load) -> Point { return {0.2 * load * (at[0] + 3), 0}; };
  Measured measured = measure({0.5, 1}, stretched, {-3, 1}, {7, 7});
  measured.channels = {"ux", "uy", "force_right"};
  Plate setup;
  setup.boundary = R"({"left": {"x": "fixed"}, "right": {"x": "uniform"}, "bottom": {"y": "fixed"}})";
  const auto test = make(setup, measured);
  ASSERT_EQ(names_of(*test).front(), "grip_tilt");
  const auto model = make_model("neo_hooke");
  const std::vector<double> p{100};
  const std::size_t n = measured.step.size();
  const auto values = [&](const std::vector<double>& flaws) {
    std::vector<double> found(3 * n);
    const Status status = test->predict({*model, p, flaws}, {found, {}, {}, {}});
    EXPECT_TRUE(status.ok()) << status.reason();
    return found;
  };
  const std::vector<double> even = values(test->describe().nulls);
  for (const auto& [flaws, exactly] : {std::pair(std::vector<double>{0, 0.3, 90, 0, 0}, 1e-8),
                                       std::pair(std::vector<double>{0, 0, 0, 0.4, -90}, 2e-3)}) {
    const std::vector<double> uneven = values(flaws);
    for (std::size_t i = 0; i < 2 * n; ++i) EXPECT_NEAR(uneven[i], even[i], exactly);
    EXPECT_NEAR(uneven[3 * n - 1] / even[3 * n - 1], 1, exactly);
  }
}

}  // namespace
}  // namespace tunica::testing::flawed_sheet
