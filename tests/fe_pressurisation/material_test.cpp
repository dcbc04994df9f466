// SPDX-License-Identifier: Apache-2.0
#include "material.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "support/tensors_only.hpp"
#include "support/tube.hpp"

namespace tunica::testing::material_test {
namespace {

constexpr std::size_t n = 20;

/// Seeded states (t, z, r, zr) with shear between z and r.
std::vector<double> states(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<double> C(4 * n);
  for (std::size_t i = 0; i < n; ++i) {
    C[i] = 1.5 + 0.4 * unit(engine);
    C[n + i] = 1.5 + 0.4 * unit(engine);
    C[2 * n + i] = 0.8 + 0.3 * unit(engine);
    C[3 * n + i] = 0.3 * unit(engine);
  }
  return C;
}

void expect_consistent(const fe::Material& material) {
  const std::vector<double> C = states(1);
  std::vector<double> first(4 * n), second(10 * n);
  ASSERT_TRUE(material.evaluate(n, C, first, second, {}).ok());
  constexpr std::size_t index[4][4] = {{0, 3, 5, 7}, {3, 1, 4, 8}, {5, 4, 2, 9}, {7, 8, 9, 6}};
  constexpr double h = 1e-5;
  for (std::size_t a = 0; a < (material.sees_shear() ? 4 : 3); ++a) {
    std::vector<double> up = C, down = C, above(n), below(n), first_above(4 * n), first_below(4 * n);
    for (std::size_t i = 0; i < n; ++i) {
      up[a * n + i] += h;
      down[a * n + i] -= h;
    }
    ASSERT_TRUE(material.energy(n, up, above).ok() && material.energy(n, down, below).ok());
    ASSERT_TRUE(material.evaluate(n, up, first_above, {}, {}).ok());
    ASSERT_TRUE(material.evaluate(n, down, first_below, {}, {}).ok());
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(first[a * n + i], (above[i] - below[i]) / (2 * h), 1e-6 * (1 + std::abs(first[a * n + i])));
      for (std::size_t b = 0; b < (material.sees_shear() ? 4 : 3); ++b) {
        const double given = second[index[a][b] * n + i];
        EXPECT_NEAR(given, (first_above[b * n + i] - first_below[b * n + i]) / (2 * h), 1e-6 * (1 + std::abs(given)))
            << a << b;
      }
    }
  }
}

TEST(FiniteElementMaterial, GivesDerivativesOfTheEnergy) {
  const auto gho = make_model("gho"), rubber = make_model("mooney_rivlin");
  const std::vector<double> rubber_parameters{20, 15};
  const fe::Material by_axes(*gho, set_s), by_tensors(*rubber, rubber_parameters);
  EXPECT_FALSE(by_axes.sees_shear());
  EXPECT_TRUE(by_tensors.sees_shear());
  expect_consistent(by_axes);
  expect_consistent(by_tensors);
}

TEST(FiniteElementMaterial, TensorsGiveWhatTheAxesGive) {
  const auto model = make_model("gho");
  const TensorsOnly slow(make_model("gho"));
  const fe::Material by_axes(*model, set_s), by_tensors(slow, set_s);
  EXPECT_TRUE(by_tensors.sees_shear());
  const std::vector<double> C = states(2);
  std::vector<double> first[2], second[2], by[2];
  for (const std::size_t k : {0u, 1u}) {
    first[k].resize(4 * n);
    second[k].resize(10 * n);
    by[k].resize(5 * 4 * n);
    ASSERT_TRUE((k == 0 ? by_axes : by_tensors).evaluate(n, C, first[k], second[k], by[k]).ok());
  }
  for (std::size_t i = 0; i < 3 * n; ++i) EXPECT_NEAR(first[0][i], first[1][i], 1e-11 * (1 + std::abs(first[0][i])));
  for (std::size_t i = 0; i < 6 * n; ++i) EXPECT_NEAR(second[0][i], second[1][i], 1e-10 * (1 + std::abs(second[0][i])));
  for (std::size_t i = 0; i < by[0].size(); ++i) EXPECT_NEAR(by[0][i], by[1][i], 1e-10 * (1 + std::abs(by[0][i])));
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(first[1][3 * n + i], 0, 1e-12);
  for (std::size_t i = 6 * n; i < 10 * n; ++i) EXPECT_NEAR(second[1][i], 0, 1e-11);
}

}  // namespace
}  // namespace tunica::testing::material_test
