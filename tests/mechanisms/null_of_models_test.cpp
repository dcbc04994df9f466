// SPDX-License-Identifier: Apache-2.0
// The promises of every mechanism that acts on a model: at its null it is the bare model, and its predictions are
// smooth there on its admissible side. One seed each, so the outcome is deterministic, and was a pass when this was
// committed.
#include <cmath>

#include <gtest/gtest.h>

#include "conformance/mechanism_properties.hpp"
#include "deformations.hpp"
#include "shelf.hpp"

namespace tunica::testing::null_of_models_test {
using namespace conformance;
namespace {

const std::vector<double> hgo{18.7, 24.9, 0.9, 46};
constexpr std::size_t n = 40;

class OnAModel : public ::testing::TestWithParam<std::string> {
 protected:
  /// The last stress of a path from rest to one state, half way back, and on to another; 1 s a step.
  [[nodiscard]] static std::vector<double> path(const Model& of, const std::vector<double>& parameters) {
    const std::vector<double> there = random_deformations(n, 21), second(n, 1.0);
    std::vector<double> back = there;
    for (std::size_t k = 0; k < back.size(); ++k) back[k] = 0.5 * (there[k] + (k < 3 * n ? 1 : 0));
    const auto first = testing::evaluate(of, there, parameters, {.state = true}, second);
    return testing::evaluate(of, back, parameters, {.state = true}, second, first.state).stress;
  }

  const WrappedModel on{catalogue().mechanisms().at(GetParam()).factory, model("hgo", "strain"),
                        wrapped(GetParam(), model("hgo", "strain")), hgo};
};

TEST_P(OnAModel, TheNullIsTheBareModelBitForBit) {
  EXPECT_EQ(null_is_the_bare_model(on, 20).counter_example, "");
  EXPECT_EQ(limit_is_the_bare_model(on, 20).counter_example, "");
}

TEST_P(OnAModel, ItsParametersStandBehindThoseOfTheBase) {
  EXPECT_EQ(parameters_stand_behind_those_of_the_base(on).counter_example, "");
  EXPECT_EQ(amplitude_has_an_effect(on).counter_example, "");
}

TEST_P(OnAModel, DerivativesByTheBasesParametersAtTheNullAreTheBases) {
  const Verdict verdict = base_derivatives_at_the_null_are_those_of_the_base(on, 20);
  EXPECT_EQ(verdict.counter_example, "");
  EXPECT_EQ(verdict.worst, 0);
  if (!verdict.skipped.empty()) {
    EXPECT_TRUE(on.with->describe().history_size > 0 || on.with->describe().compressible);
  }
}

TEST_P(OnAModel, ItsDerivativeAtTheNullIsThatOfTheStress) {
  if (on.with->describe().parameter_derivatives) {
    EXPECT_EQ(derivative_at_the_null_matches_differences(on, 22).counter_example, "");
    return;
  }
  // Models with memory are linear in the amplitude at a given path, and the host differences it: so any step gives the
  // derivative.
  const std::vector<double> f0 = path(*on.with, on.at(0)), near = path(*on.with, on.at(1e-3)),
                            far = path(*on.with, on.at(1));
  double largest = 0;
  for (std::size_t i = 0; i < f0.size(); ++i) largest = std::max(largest, std::abs(far[i] - f0[i]));
  EXPECT_GT(largest, 0.1);
  for (std::size_t i = 0; i < f0.size(); ++i) EXPECT_NEAR(1e3 * (near[i] - f0[i]), far[i] - f0[i], 1e-8 * largest);
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, OnAModel, ::testing::ValuesIn([] {
                           std::vector<std::string> ids;
                           for (const auto& [id, entry] : catalogue().mechanisms())
                             if (entry.factory.stage < Stage::test) ids.push_back(id);
                           return ids;
                         }()),
                         [](const auto& at) { return at.param; });

}  // namespace
}  // namespace tunica::testing::null_of_models_test
