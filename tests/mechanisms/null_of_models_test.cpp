// SPDX-License-Identifier: Apache-2.0
// What every mechanism that acts on a model promises: at its null it is the bare model, and what it predicts is smooth
// there on its admissible side.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "deformations.hpp"
#include "shelf.hpp"

namespace tunica::testing {
namespace {

const std::vector<double> hgo{18.7, 24.9, 0.9, 46};
constexpr std::size_t n = 40;

class OnAModel : public ::testing::TestWithParam<std::string> {
 protected:
  /// Parameters of the base, this amplitude, and nuisances at their initial values.
  [[nodiscard]] std::vector<double> at(double amplitude) const {
    std::vector<double> all = hgo;
    all.push_back(amplitude);
    for (std::size_t k = 1; k < mechanism.parameters.size(); ++k) all.push_back(mechanism.parameters[k].initial);
    return all;
  }
  /// The last stress of a path from rest to one state, half way back, and on to another; 1 s a step.
  [[nodiscard]] static std::vector<double> path(const Model& of, const std::vector<double>& parameters) {
    const std::vector<double> there = random_deformations(n, 21), second(n, 1.0);
    std::vector<double> back = there;
    for (std::size_t k = 0; k < back.size(); ++k) back[k] = 0.5 * (there[k] + (k < 3 * n ? 1 : 0));
    const auto first = evaluate(of, there, parameters, {.state = true}, second);
    return evaluate(of, back, parameters, {.state = true}, second, first.state).stress;
  }

  const MechanismFactory& mechanism = catalogue().mechanisms().at(GetParam()).factory;
  const std::unique_ptr<Model> bare = model("hgo", "strain"), with = wrapped(GetParam(), model("hgo", "strain"));
};

void expect_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_GE(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), sizeof(double) * b.size()), 0);
}

TEST_P(OnAModel, TheNullIsTheBareModelBitForBit) {
  const std::vector<double> C = random_deformations(n, 20), null = at(mechanism.null);
  const auto a = evaluate(*with, C, null), b = evaluate(*bare, C, hgo);
  expect_same_bits(a.energy, b.energy);
  expect_same_bits(a.stress, b.stress);
  expect_same_bits(a.tangent, b.tangent);
  expect_same_bits(path(*with, null), path(*bare, hgo));
}

TEST_P(OnAModel, DerivativesByTheBasesParametersAtTheNullAreTheBases) {
  const std::vector<double> C = random_deformations(n, 20);
  if (!with->describe().parameter_derivatives) {
    EXPECT_GT(with->describe().history_size, 0u);
    return;
  }
  const auto a = evaluate(*with, C, at(mechanism.null), {.stress_dp = true});
  expect_same_bits(a.stress_dp, evaluate(*bare, C, hgo, {.stress_dp = true}).stress_dp);
}

/// One-sided differences of fourth order. Models with memory are linear in the amplitude at a given path, and the host
/// differences it: so any step gives the derivative.
TEST_P(OnAModel, ItsDerivativeAtTheNullIsThatOfTheStress) {
  const std::vector<double> C = random_deformations(n, 22);
  if (!with->describe().parameter_derivatives) {
    const std::vector<double> f0 = path(*with, at(0)), near = path(*with, at(1e-3)), far = path(*with, at(1));
    double largest = 0;
    for (std::size_t i = 0; i < f0.size(); ++i) largest = std::max(largest, std::abs(far[i] - f0[i]));
    EXPECT_GT(largest, 0.1);
    for (std::size_t i = 0; i < f0.size(); ++i) EXPECT_NEAR(1e3 * (near[i] - f0[i]), far[i] - f0[i], 1e-8 * largest);
    return;
  }
  const double h = 2e-4 * (mechanism.plausible_max - mechanism.null);
  const auto stress = [&](double steps) { return evaluate(*with, C, at(mechanism.null + steps * h)).stress; };
  const auto exact = evaluate(*with, C, at(mechanism.null), {.stress_dp = true}).stress_dp;
  const std::vector<double> f0 = stress(0), f1 = stress(1), f2 = stress(2), f3 = stress(3), f4 = stress(4);
  for (std::size_t c = 0; c < 6; ++c) {
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t k = c * n + i;
      const double difference = (-25 * f0[k] + 48 * f1[k] - 36 * f2[k] + 16 * f3[k] - 3 * f4[k]) / (12 * h);
      double scale = 1e-6;
      for (std::size_t e = 0; e < 6; ++e) scale = std::max(scale, std::abs(exact[hgo.size() * 6 * n + e * n + i]));
      EXPECT_NEAR(exact[hgo.size() * 6 * n + k], difference, 1e-6 * scale + 1e-13 * std::abs(f0[k]) / h)
          << "component " << c << " of state " << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, OnAModel, ::testing::ValuesIn([] {
                           std::vector<std::string> ids;
                           for (const auto& [id, entry] : catalogue().mechanisms())
                             if (entry.factory.stage < Stage::test) ids.push_back(id);
                           return ids;
                         }()),
                         [](const auto& at) { return at.param; });

}  // namespace
}  // namespace tunica::testing
