// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deformations.hpp"
#include "shelf.hpp"

namespace tunica::changed_parts_test {
namespace {

using testing::evaluate;
using testing::model;
using testing::random_deformations;
using testing::refusal;
using testing::relative_difference;
using testing::wrapped;

TEST(ChangedParts, ChainsWithAnEndMakeGentOfNeoHooke) {
  const auto made = wrapped("chain_extensibility", model("neo_hooke"));
  const auto known = model("gent");
  ASSERT_EQ(known->describe().parameters.size(), 2u);
  const std::vector<double> C = random_deformations(100, 9);
  for (const double limit : {4.0, 30.0, 1e4}) {
    const auto a = evaluate(*made, C, {50, 1 / limit}), b = evaluate(*known, C, {50, limit});
    EXPECT_LE(relative_difference(a.energy, b.energy), 1e-11);
    EXPECT_LE(relative_difference(a.stress, b.stress), 1e-13);
    EXPECT_LE(relative_difference(a.tangent, b.tangent), 1e-12);
  }
}

/// Beyond the last of the chains there is no energy: a failure or infinity, never a number.
TEST(ChangedParts, NothingComesAfterTheEndOfTheChains) {
  const auto made = wrapped("chain_extensibility", model("neo_hooke"));
  const std::vector<double> C{9, 1. / 3, 1. / 3, 0, 0, 0}, parameters{50, 0.25};  // I1 − 3 = 6.7, Jm = 4
  std::vector<double> energy(1), stress(6);
  const Status status = made->evaluate({1, C, parameters, {}, {}}, {energy, stress, {}, {}, {}});
  EXPECT_TRUE(!status.ok() || !std::isfinite(energy[0]));
}

/// W = μ/(2b) [exp(b (I1 − 3)) − 1], S = 2 ∂W/∂C = μ exp(b (I1 − 3)) 1.
TEST(ChangedParts, AMatrixThatStiffensIsDemiray) {
  constexpr double mu = 40, b = 0.8;
  const std::size_t n = 60;
  const std::vector<double> C = random_deformations(n, 10);
  const auto made = evaluate(*wrapped("matrix_stiffening", model("neo_hooke")), C, {mu, b});
  for (std::size_t i = 0; i < n; ++i) {
    const double x = C[i] + C[n + i] + C[2 * n + i] - 3;
    EXPECT_NEAR(made.energy[i], mu / (2 * b) * std::expm1(b * x), 1e-12 * mu * std::exp(b * std::abs(x)));
    for (std::size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(made.stress[k * n + i], k < 3 ? mu * std::exp(b * x) : 0, 1e-12 * mu * std::exp(b * std::abs(x)));
  }
}

/// Axial fibres (both families at 0°) that are taken up at λs: E = C_zz/λs² − 1 while positive.
TEST(ChangedParts, FibresTakenUpLateSeeTheirOwnStretch) {
  constexpr double mu = 20, k1 = 30, k2 = 0.7, taken_up = 1.1;
  const std::size_t n = 60;
  const std::vector<double> C = random_deformations(n, 11);
  const auto made = evaluate(*wrapped("fibre_recruitment", model("hgo", "strain")), C, {mu, k1, k2, 0, taken_up});
  std::size_t carrying = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double E = std::max(0., C[n + i] / (taken_up * taken_up) - 1);
    carrying += E > 0;
    const double matrix = mu / 2 * (C[i] + C[n + i] + C[2 * n + i] - 3);
    EXPECT_NEAR(made.energy[i], matrix + k1 / k2 * std::expm1(k2 * E * E), 1e-11 * mu);
    EXPECT_NEAR(made.stress[n + i], mu + 4 * k1 * E * std::exp(k2 * E * E) / (taken_up * taken_up), 1e-10 * mu);
  }
  EXPECT_GT(carrying, 10u);
  EXPECT_LT(carrying, n - 10);
}

/// The stress of fibres that are taken up late by the parameters of the base, the angle among them, against
/// differences.
TEST(ChangedParts, FibresTakenUpLateHaveTheDerivativesOfTheirStress) {
  const auto made = wrapped("fibre_recruitment", model("hgo", "strain"));
  const std::vector<double> C = random_deformations(40, 13), at{18.668, 24.905, 0.2912, 46.44, 1.15};
  const auto found = evaluate(*made, C, at, {.stress_dp = true});
  const std::size_t size = C.size();
  for (std::size_t j = 0; j < at.size(); ++j) {
    const double h = 1e-6 * at[j];
    std::vector<double> up = at, down = at;
    up[j] += h;
    down[j] -= h;
    const auto above = evaluate(*made, C, up), below = evaluate(*made, C, down);
    for (std::size_t i = 0; i < size; ++i) {
      const double difference = (above.stress[i] - below.stress[i]) / (2 * h);
      EXPECT_NEAR(found.stress_dp[j * size + i], difference, 1e-5 * (1 + std::abs(difference))) << j << ' ' << i;
    }
  }
}

struct Case {
  const char* mechanism;
  double null;
};

class EveryChange : public ::testing::TestWithParam<Case> {
 protected:
  std::unique_ptr<Model> changed = wrapped(GetParam().mechanism, model("hgo", "strain"));
  const std::vector<double> bare{18.668, 24.905, 0.2912, 46.44};

  [[nodiscard]] std::vector<double> at(double beyond) const {
    std::vector<double> parameters = bare;
    parameters.push_back(GetParam().null + beyond);
    return parameters;
  }
};

TEST_P(EveryChange, IsTheBareModelAtTheNullBitForBit) {
  const std::vector<double> C = random_deformations(70, 12);
  const auto a = evaluate(*changed, C, at(0)), b = evaluate(*model("hgo", "strain"), C, bare);
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.stress, b.stress);
  EXPECT_EQ(a.tangent, b.tangent);
}

TEST_P(EveryChange, DerivativeAtTheNullIsThatOfTheFormula) {
  const std::size_t row = 120;
  const std::vector<double> C = random_deformations(20, 13);
  const auto null = evaluate(*changed, C, at(0), {.stress_dp = true});
  // Second-order one-sided difference: (4 S(h) − S(2h) − 3 S(0)) / 2h.
  constexpr double h = 1e-5;
  const auto near = evaluate(*changed, C, at(h)), far = evaluate(*changed, C, at(2 * h));
  std::vector<double> difference(row);
  for (std::size_t i = 0; i < row; ++i)
    difference[i] = (4 * near.stress[i] - far.stress[i] - 3 * null.stress[i]) / (2 * h);
  EXPECT_LE(
      relative_difference({null.stress_dp.end() - static_cast<std::ptrdiff_t>(row), null.stress_dp.end()}, difference),
      1e-6);
}

INSTANTIATE_TEST_SUITE_P(ChangedParts, EveryChange,
                         ::testing::Values(Case{"matrix_stiffening", 0}, Case{"chain_extensibility", 0},
                                           Case{"fibre_recruitment", 1}),
                         [](const auto& at) { return std::string(at.param.mechanism); });

TEST(ChangedParts, RefuseModelsWithoutSuchParts) {
  EXPECT_THAT(refusal("matrix_stiffening", model("ogden")),
              ::testing::EndsWith("matrix_stiffening: model 'ogden' has no part that it could change; expected a "
                                  "neo-Hookean matrix, for example in hgo, gho or neo_hooke; take the mechanism out or "
                                  "choose another model"));
  EXPECT_THAT(refusal("fibre_recruitment", model("neo_hooke")),
              ::testing::HasSubstr("model 'neo_hooke' has no part that it could change; expected fibres"));
  for (const char* fibre_switch : {"stretch", "none"})
    EXPECT_THAT(refusal("fibre_recruitment", model("hgo", fibre_switch)),
                ::testing::HasSubstr("the fibres of model 'hgo' are not slack until they are taken up; expected "
                                     "\"fibre_switch\": \"strain\""));
}

}  // namespace
}  // namespace tunica::changed_parts_test
