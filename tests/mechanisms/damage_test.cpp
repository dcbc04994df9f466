// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "deformations.hpp"
#include "shelf.hpp"
#include "support/strip.hpp"

namespace tunica::damage_test {
namespace {

using testing::make_strip;
using testing::model;

/// Loaded, unloaded, loaded again and beyond, unloaded to rest.
const std::vector<double> stretches{1, 1.2, 1.4, 1.3, 1.1, 1, 1.15, 1.35, 1.4, 1.45, 1.6, 1.5, 1.2, 1};

std::unique_ptr<Model> damaged(const std::string& base, const std::string& law) {
  const auto& entry = testing::catalogue().mechanisms().at("damage");
  Options options;
  options.set("law", law);
  return plugins::wrap(entry, model(base), options);
}

std::vector<double> values_of(const Test& test, const Model& model, const std::vector<double>& parameters) {
  const testing::Prediction predicted = testing::predict(test, model, parameters);
  EXPECT_TRUE(predicted.status.ok()) << predicted.status.reason();
  return predicted.values;
}

/// Along the whole path, from the closed form of a neo-Hookean strip (Treloar 1943).
TEST(Damage, LoadsUnloadsAndReloadsAStripAsTheClosedFormsDo) {
  constexpr double mu = 25, d = 0.6, w = 4, m = 3;
  for (const std::string law : {"discontinuous", "failure"}) {
    std::vector<double> p{mu, d, w};
    if (law == "failure") p.push_back(m);
    const std::vector<double> values = values_of(*make_strip(stretches), *damaged("neo_hooke", law), p);
    double largest = 0;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const double l = stretches[i];
      largest = std::max(largest, mu / 2 * (l * l + 2 / l - 3));
      const double eta = 1 - d * (1 - std::exp(-std::pow(largest / w, law == "failure" ? m : 1)));
      EXPECT_NEAR(values[i], eta * mu * (l * l - 1 / l), 1e-9 * mu) << law << ", row " << i;
    }
    EXPECT_NEAR(values[4] / values[1], (1.21 - 1 / 1.1) / (1.44 - 1 / 1.2), law == "failure" ? 0.5 : 0.3);
    EXPECT_LT(values[3], values[2]);
    EXPECT_NEAR(values[2], values[8], 1e-9 * mu) << "nothing tears where it has been";
  }
}

/// Where the energy of a neo-Hookean strip, μ/2 (λ² + 2/λ − 3), is W.
double stretch_of(double W, double mu) {
  double low = 1, high = 10;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (mu / 2 * (middle * middle + 2 / middle - 3) < W ? low : high) = middle;
  }
  return low;
}

TEST(Damage, SoftensToFailure) {
  // Whatever m, 1/e of the stress is left at W = w. The larger m, the more is left before, and the less beyond.
  constexpr double mu = 25, w = 8;
  std::vector<double> path{1};
  for (const double part : {0.5, 1., 2.}) path.push_back(stretch_of(part * w, mu));
  std::vector<double> before{0}, beyond{1};
  for (const double m : {1., 2., 4., 20.}) {
    const auto values = values_of(*make_strip(path), *damaged("neo_hooke", "failure"), {mu, 1, w, m});
    const auto left = [&](std::size_t i) { return values[i] / (mu * (path[i] * path[i] - 1 / path[i])); };
    EXPECT_NEAR(left(2), std::exp(-1), 1e-9) << m;
    EXPECT_GT(left(1), before.back()) << m;
    EXPECT_LT(left(3), beyond.back()) << m;
    before.push_back(left(1));
    beyond.push_back(left(3));
  }
  EXPECT_GT(before.back(), 0.999);
  EXPECT_LT(beyond[3], 1e-3);
}

TEST(Damage, BearsMostBeforeItFails) {
  std::vector<double> rising;
  for (int k = 0; k <= 60; ++k) rising.push_back(1 + 0.02 * k);
  const auto values = values_of(*make_strip(rising), *damaged("neo_hooke", "failure"), {25, 1, 8, 4});
  const auto peak = std::max_element(values.begin(), values.end());
  EXPECT_GT(peak - values.begin(), 10);
  EXPECT_LT(peak - values.begin(), 50);
  EXPECT_LT(values.back(), 1e-3 * *peak);
}

TEST(Damage, CarriesDerivativesByAllParametersAsDifferencesFindThem) {
  const auto torn = damaged("gho", "failure");
  const std::vector<double> at{18.668, 0.1367, 24.905, 0.2912, 46.44, 0.7, 6, 2.5};
  const auto test = make_strip(stretches, {.channels = {"stress", "transverse_stretch"}});
  std::vector<double> values(2 * stretches.size()), jacobian(9 * values.size());
  const std::vector<double> own{0};
  ASSERT_TRUE(test->predict({*torn, at, own}, {values, jacobian, {}, {}}).ok());
  for (std::size_t j = 0; j < at.size(); ++j) {
    std::vector<double> p = at;
    const double h = 1e-4 * at[j];
    const auto moved = [&](double by) {
      p[j] = at[j] + by;
      return values_of(*test, *torn, p);
    };
    const auto a = moved(h), b = moved(-h), c = moved(2 * h), d = moved(-2 * h);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double difference = (8 * (a[i] - b[i]) - (c[i] - d[i])) / (12 * h);
      EXPECT_NEAR(jacobian[j * values.size() + i], difference, 1e-7 / at[j] + 1e-7 * std::abs(difference))
          << "parameter " << j << ", value " << i;
    }
  }
}

TEST(Damage, HasATangentConsistentWithItsStress) {
  const auto torn = damaged("gho", "failure");
  const std::vector<double> p{18.668, 0.1367, 24.905, 0.2912, 46.44, 0.7, 1, 2.5}, old{0.2};
  for (const double scale : {1.0, 0.05}) {  // beyond what was borne, and below
    std::vector<double> C{1 + 0.4 * scale, 1 - 0.2 * scale, 1 - 0.1 * scale, 0.1 * scale, 0.05 * scale, -0.02 * scale};
    const auto at = testing::evaluate(*torn, C, p, {}, {}, old);
    for (std::size_t b = 0; b < 6; ++b) {
      constexpr double h = 1e-5;
      std::vector<double> up = C, down = C;
      up[b] += h;
      down[b] -= h;
      const auto ahead = testing::evaluate(*torn, up, p, {}, {}, old).stress,
                 behind = testing::evaluate(*torn, down, p, {}, {}, old).stress;
      for (std::size_t a = 0; a < 6; ++a)
        EXPECT_NEAR(at.tangent[6 * a + b], (b < 3 ? 2 : 1) * (ahead[a] - behind[a]) / (2 * h), 1e-5)
            << scale << ", " << a << b;
    }
  }
}

}  // namespace
}  // namespace tunica::damage_test
