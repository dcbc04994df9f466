// SPDX-License-Identifier: Apache-2.0
// Mechanisms that change parts of an energy around one another, around parts of every kind, and at their null.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deformations.hpp"
#include "made_up_parts.hpp"
#include "shelf.hpp"

namespace tunica::testing::parts_of_parts_test {
namespace {

using Values = std::vector<double>;
using ::testing::Each;
using ::testing::HasSubstr;

/// ∂S/∂p by central differences, all parameters.
void expect_derivatives(const Model& made, const Values& C, const Values& at) {
  const Values found = evaluate(made, C, at, {.stress_dp = true}).stress_dp;
  for (std::size_t j = 0; j < at.size(); ++j) {
    const double h = 1e-6 * at[j];
    Values up = at, down = at;
    up[j] += h;
    down[j] -= h;
    const Values above = evaluate(made, C, up).stress, below = evaluate(made, C, down).stress;
    double largest = 1;
    for (std::size_t i = 0; i < C.size(); ++i) largest = std::max(largest, std::abs(above[i] - below[i]) / (2 * h));
    for (std::size_t i = 0; i < C.size(); ++i)
      EXPECT_NEAR(found[j * C.size() + i], (above[i] - below[i]) / (2 * h), 1e-6 * largest) << j << ' ' << i;
  }
}

constexpr double mu = 20, k1 = 30, k2 = 0.7, kappa = 0.1, taken_up = 1.08;

/// Axial fibres; x = κ I1 + (1 − 3κ) C_zz with one of the two weights over λs², or with both.
void expect_energy(const Model& made, const Values& own, double of_i1, double of_fibre) {
  constexpr std::size_t n = 40;
  const Values C = random_deformations(n, 51);
  Values parameters{mu, k1, k2, 0};
  parameters.insert(parameters.end(), own.begin(), own.end());
  const auto found = evaluate(made, C, parameters);
  std::size_t carrying = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double I1 = C[i] + C[n + i] + C[2 * n + i], E = std::max(0., of_i1 * I1 + of_fibre * C[n + i] - 1);
    carrying += E > 0;
    EXPECT_NEAR(found.energy[i], mu / 2 * (I1 - 3) + k1 / k2 * std::expm1(k2 * E * E), 1e-10 * mu) << i;
  }
  EXPECT_GT(carrying, 10u);
  parameters[3] = 40;
  expect_derivatives(made, C, parameters);
}

/// The outer one changes what the inner one has made of M·CM.
TEST(PartsOfParts, FibresAreTakenUpLateAndDispersedInEitherOrder) {
  const double late = 1 / (taken_up * taken_up);
  expect_energy(*wrapped("fibre_recruitment", wrapped("fibre_dispersion", model("hgo", "strain"))), {kappa, taken_up},
                kappa, (1 - 3 * kappa) * late);
  expect_energy(*wrapped("fibre_dispersion", wrapped("fibre_recruitment", model("hgo", "strain"))), {taken_up, kappa},
                kappa * late, (1 - 3 * kappa) * late);
}

std::unique_ptr<MadeUpPart> part() { return std::make_unique<MadeUpPart>(); }
std::unique_ptr<Model> with(std::unique_ptr<MadeUpPart> made) { return std::make_unique<MadeUpModel>(std::move(made)); }

/// A matrix stiffens once: what has stiffened is neo-Hookean no more.
TEST(PartsOfParts, AMatrixIsNotStiffenedTwice) {
  for (const char* inner : {"matrix_stiffening", "chain_extensibility"})
    EXPECT_THAT(refusal("matrix_stiffening", wrapped(inner, model("neo_hooke"))), HasSubstr("no part that it could"));
}

TEST(PartsOfParts, OnlyALinearFunctionOfTheFirstInvariantIsNeoHookean) {
  EXPECT_EQ(refusal("matrix_stiffening", with(part())), "accepted");
  Invariant twice{.i1 = 2, .offset = -3}, unshifted{.i1 = 1}, areas{.i1 = 1, .i2 = 1, .offset = -3},
      fibres{.i1 = 1, .fibre = 1, .offset = -3}, normal{.i1 = 1, .normal = 1, .offset = -3},
      across{.i1 = 1, .across = 1, .offset = -3};
  for (const Invariant& other : {twice, unshifted, areas, fibres, normal, across}) {
    auto made = part();
    made->x = other;
    EXPECT_THAT(refusal("matrix_stiffening", with(std::move(made))), HasSubstr("no part that it could change"));
  }
  auto curved = part(), moved = part();
  curved->description.linear = false;
  moved->description.invariant_parameters = {0};
  EXPECT_THAT(refusal("matrix_stiffening", with(std::move(curved))), HasSubstr("no part that it could change"));
  EXPECT_THAT(refusal("matrix_stiffening", with(std::move(moved))), HasSubstr("no part that it could change"));
}

/// ψ = (a/2 + b) x: a modulus of two parameters stiffens as one does, W = (a/2 + b) (e^{cx} − 1)/c.
TEST(PartsOfParts, AModulusOfTwoParametersStiffens) {
  const auto made = wrapped("matrix_stiffening", with(part()));
  constexpr std::size_t n = 3;
  const Values C = random_deformations(n, 52), at{6, 4, 0.5};
  const auto found = evaluate(*made, C, at);
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_NEAR(found.energy[i], 7 * std::expm1(0.5 * (C[i] + C[n + i] + C[2 * n + i] - 3)) / 0.5, 1e-11);
  expect_derivatives(*made, C, at);
  const Values c{1.3, 1.1, 1.2, 0.9, 0.95, 1.4, 0.8, 1, 0.7};
  Values W(n), g(3 * n), h(6 * n), g_dp(9 * n), W_dp(3 * n);
  ASSERT_TRUE(made->evaluate_axes({n, c, at}, {W, g, h, g_dp, W_dp}).ok());
  for (std::size_t i = 0; i < n; ++i) {
    const double x = c[i] + c[n + i] + c[2 * n + i] - 3, grown = std::expm1(0.5 * x) / 0.5;
    EXPECT_NEAR(W_dp[i], grown / 2, 1e-12);
    EXPECT_NEAR(W_dp[n + i], grown, 1e-12);
    EXPECT_NEAR(W_dp[2 * n + i], 7 * (x * std::exp(0.5 * x) - grown) / 0.5, 1e-11);
    EXPECT_NEAR(g_dp[i], std::exp(0.5 * x) / 2, 1e-12);
    EXPECT_NEAR(g_dp[3 * n + i], std::exp(0.5 * x), 1e-12);
  }
}

/// Fibres that only the wall's normal scatters are dispersed too, whether a parameter says so or not.
TEST(PartsOfParts, FibresScatteredByAnythingAreDispersedAlready) {
  const auto fibres = [](const Invariant& x) {
    auto made = part();
    made->description.role = EnergyPart::Role::fibre;
    made->x = x;
    return with(std::move(made));
  };
  EXPECT_EQ(refusal("fibre_dispersion", fibres({.fibre = 1, .offset = -1})), "accepted");
  EXPECT_THAT(refusal("fibre_dispersion", fibres({.fibre = 1, .normal = 0.1, .offset = -1})), HasSubstr("already"));
  EXPECT_THAT(refusal("fibre_dispersion", fibres({.i1 = 0.1, .fibre = 0.7, .offset = -1})), HasSubstr("already"));
}

/// Who answers at the null is the base itself, and beside it, also at an amplitude of 1, the changed energy.
TEST(PartsOfParts, TheBaseAnswersAtTheNullAndOnlyThere) {
  const Values C = random_deformations(2, 53);
  const auto energy = [&](const char* mechanism, std::unique_ptr<Model> base, double amplitude) {
    const auto made = wrapped(mechanism, std::move(base));
    Values parameters{3, 5, amplitude};
    if (made->describe().parameters.size() > 3) parameters.push_back(0.7);
    return evaluate(*made, C, parameters).energy;
  };
  for (const char* mechanism : {"matrix_stiffening", "chain_extensibility", "axial_fibres", "circumferential_fibres",
                                "second_invariant", "active_tone"}) {
    EXPECT_THAT(energy(mechanism, with(part()), 0), Each(42)) << mechanism;
    EXPECT_THAT(energy(mechanism, with(part()), 1), Each(::testing::Ne(42))) << mechanism;
  }
  const auto fibres = [] {
    auto made = part();
    made->description.role = EnergyPart::Role::fibre;
    made->description.active = EnergyPart::Active::argument_positive;
    made->x = {.fibre = 1, .offset = -1};
    return with(std::move(made));
  };
  EXPECT_THAT(energy("fibre_dispersion", fibres(), 0), Each(42));
  EXPECT_THAT(energy("fibre_recruitment", fibres(), 1), Each(42));
  // A base without parts answers always, and at the null alone.
  for (const char* mechanism : {"second_invariant", "active_tone"}) {
    EXPECT_THAT(energy(mechanism, std::make_unique<MadeUpModel>(nullptr), 0), Each(42)) << mechanism;
    EXPECT_THAT(energy(mechanism, std::make_unique<MadeUpModel>(nullptr), 1), Each(::testing::Ne(42))) << mechanism;
  }
}

}  // namespace
}  // namespace tunica::testing::parts_of_parts_test
