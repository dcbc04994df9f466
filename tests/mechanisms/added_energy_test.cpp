// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deformations.hpp"
#include "shelf.hpp"

namespace tunica::added_energy_test {
namespace {

using testing::evaluate;
using testing::model;
using testing::random_deformations;
using testing::relative_difference;
using testing::wrapped;

void expect_same(const testing::Response& a, const testing::Response& b) {
  EXPECT_LE(relative_difference(a.energy, b.energy), 1e-14);
  EXPECT_LE(relative_difference(a.stress, b.stress), 1e-14);
  EXPECT_LE(relative_difference(a.tangent, b.tangent), 1e-14);
  EXPECT_LE(relative_difference(a.stress_dp, b.stress_dp), 1e-14);
}

TEST(AddedEnergy, FamiliesAlongBothAxesMakeTheFourFibreModelOfHgo) {
  const auto made = wrapped("circumferential_fibres", wrapped("axial_fibres", model("hgo")));
  const auto known = model("four_fibre");
  const std::vector<double> parameters{12, 20, 0.6, 38, 7, 0.9, 11, 1.3};
  const std::vector<double> C = random_deformations(100, 4);
  expect_same(evaluate(*made, C, parameters, {.stress_dp = true}),
              evaluate(*known, C, parameters, {.stress_dp = true}));
}

TEST(AddedEnergy, ASecondInvariantMakesMooneyRivlinOfNeoHooke) {
  const auto made = wrapped("second_invariant", model("neo_hooke"));
  const auto known = model("mooney_rivlin");
  const std::vector<double> C = random_deformations(100, 5);
  const auto a = evaluate(*made, C, {50, 15}), b = evaluate(*known, C, {25, 15});  // μ/2 = c10
  EXPECT_LE(relative_difference(a.energy, b.energy), 1e-14);
  EXPECT_LE(relative_difference(a.stress, b.stress), 1e-14);
  EXPECT_LE(relative_difference(a.tangent, b.tangent), 1e-14);
}

/// W = T ln λt: S_tt = T/C_tt, so that σ_tt = F S Fᵀ = T; nothing else changes.
TEST(AddedEnergy, ToneAddsItsStressAroundTheCircumference) {
  constexpr double tone = 35;
  const std::vector<double> bare{18.668, 24.905, 0.2912, 46.44};
  std::vector<double> parameters = bare;
  parameters.push_back(tone);
  const std::size_t n = 50;
  const std::vector<double> C = random_deformations(n, 6);
  const auto with = evaluate(*wrapped("active_tone", model("hgo")), C, parameters);
  const auto without = evaluate(*model("hgo"), C, bare);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(with.energy[i] - without.energy[i], tone * 0.5 * std::log(C[i]), 1e-12 * tone);
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(with.stress[k * n + i] - without.stress[k * n + i], k == 0 ? tone / C[i] : 0,
                  1e-11 * std::abs(with.stress[k * n + i]) + 1e-10);
  }
}

/// What is added does not depend on what it is added to: an energy that is a sum of parts, or one that exposes none.
TEST(AddedEnergy, AddsTheSameToAModelThatExposesNoParts) {
  constexpr std::size_t n = 20;
  const std::vector<double> C = random_deformations(n, 11);
  const std::vector<double> of_ogden{630, 1.3, 1.2, 5, -10, -2}, of_hgo{18.668, 24.905, 0.2912, 46.44};
  for (const char* mechanism : {"second_invariant", "active_tone", "axial_fibres"}) {
    const auto added = [&](const std::string& type, std::vector<double> parameters) {
      const auto bare = model(type), with = wrapped(mechanism, model(type));
      EXPECT_EQ(with->describe().principal_axes, bare->describe().principal_axes);
      const testing::Response without = evaluate(*bare, C, parameters, {.stress_dp = true});
      parameters.push_back(7);
      if (with->describe().parameters.size() > parameters.size()) parameters.push_back(0.7);
      testing::Response sum = evaluate(*with, C, parameters, {.stress_dp = true});
      for (std::size_t k = 0; k < without.stress_dp.size(); ++k) EXPECT_EQ(sum.stress_dp[k], without.stress_dp[k]);
      sum.stress_dp.erase(sum.stress_dp.begin(),
                          sum.stress_dp.begin() + static_cast<std::ptrdiff_t>(without.stress_dp.size()));
      for (std::size_t k = 0; k < sum.energy.size(); ++k) sum.energy[k] -= without.energy[k];
      for (std::size_t k = 0; k < sum.stress.size(); ++k) sum.stress[k] -= without.stress[k];
      for (std::size_t k = 0; k < sum.tangent.size(); ++k) sum.tangent[k] -= without.tangent[k];
      return sum;
    };
    const testing::Response a = added("ogden", of_ogden), b = added("hgo", of_hgo);
    const auto close = [&](const std::vector<double>& x, const std::vector<double>& y) {
      ASSERT_EQ(x.size(), y.size());
      for (std::size_t k = 0; k < x.size(); ++k) EXPECT_NEAR(x[k], y[k], 1e-9 * (1 + std::abs(y[k]))) << mechanism;
    };
    close(a.energy, b.energy);
    close(a.stress, b.stress);
    close(a.tangent, b.tangent);
    close(a.stress_dp, b.stress_dp);
  }
}

TEST(AddedEnergy, LeavesAModelThatExposesNoPartsAsItIsAtTheNullBitForBit) {
  const std::vector<double> C = random_deformations(40, 12);
  std::vector<double> parameters{630, 1.3, 1.2, 5, -10, -2};
  const testing::Response bare = evaluate(*model("ogden"), C, parameters);
  parameters.push_back(0);
  const testing::Response with = evaluate(*wrapped("second_invariant", model("ogden")), C, parameters);
  EXPECT_EQ(with.energy, bare.energy);
  EXPECT_EQ(with.stress, bare.stress);
  EXPECT_EQ(with.tangent, bare.tangent);
}

class EveryAddition : public ::testing::TestWithParam<const char*> {
 protected:
  std::unique_ptr<Model> extended = wrapped(GetParam(), model("hgo", "none"));
  std::vector<double> bare{18.668, 24.905, 0.2912, 46.44};
  std::size_t own = extended->describe().parameters.size() - bare.size();

  [[nodiscard]] std::vector<double> at(double amplitude) const {
    std::vector<double> parameters = bare;
    parameters.push_back(amplitude);
    if (own == 2) parameters.push_back(0.7);
    return parameters;
  }
};

TEST_P(EveryAddition, IsTheBareModelAtTheNullBitForBit) {
  const auto base = model("hgo", "none");
  const std::vector<double> C = random_deformations(70, 7);
  const auto a = evaluate(*extended, C, at(0)), b = evaluate(*base, C, bare);
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.stress, b.stress);
  EXPECT_EQ(a.tangent, b.tangent);
}

/// The stress is linear in the amplitude, so that any difference is exact but for rounding.
TEST_P(EveryAddition, DerivativeAtTheNullIsThatOfTheFormula) {
  const std::size_t n = 20, row = 6 * n;
  const std::vector<double> C = random_deformations(n, 8);
  const auto null = evaluate(*extended, C, at(0), {.stress_dp = true});
  const auto away = evaluate(*extended, C, at(8));
  std::vector<double> difference(row);
  for (std::size_t i = 0; i < row; ++i) difference[i] = (away.stress[i] - null.stress[i]) / 8;
  const auto by_amplitude = null.stress_dp.begin() + static_cast<std::ptrdiff_t>(bare.size() * row);
  EXPECT_LE(relative_difference({by_amplitude, by_amplitude + static_cast<std::ptrdiff_t>(row)}, difference), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(AddedEnergy, EveryAddition,
                         ::testing::Values("axial_fibres", "circumferential_fibres", "second_invariant", "active_tone"),
                         [](const auto& at) { return std::string(at.param); });

}  // namespace
}  // namespace tunica::added_energy_test
