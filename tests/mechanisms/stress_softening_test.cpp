// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "deformations.hpp"
#include "shelf.hpp"
#include "support/strip.hpp"

namespace tunica::stress_softening_test {
namespace {

using testing::evaluate;
using testing::make_strip;
using testing::model;
using testing::random_deformations;
using testing::wrapped;

/// Loaded, unloaded, loaded again and beyond, unloaded to rest.
const std::vector<double> stretches{1, 1.2, 1.4, 1.3, 1.1, 1, 1.15, 1.35, 1.4, 1.45, 1.6, 1.5, 1.2, 1};

std::vector<double> values_of(const Test& test, const Model& model, const std::vector<double>& parameters) {
  const testing::Prediction predicted = testing::predict(test, model, parameters);
  EXPECT_TRUE(predicted.status.ok()) << predicted.status.reason();
  return predicted.values;
}

/// By Ogden's and Roxburgh's formula along the whole path, from the closed form of a neo-Hookean strip (Treloar 1943).
TEST(StressSoftening, LoadsUnloadsAndReloadsAStripAsTheClosedFormDoes) {
  constexpr double mu = 25, s = 0.45, m = 0.3;
  const auto soft = wrapped("stress_softening", model("neo_hooke"));
  const std::vector<double> values = values_of(*make_strip(stretches), *soft, {mu, s, m});
  double largest = 0;
  std::size_t softened = 0;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const double l = stretches[i], W = mu / 2 * (l * l + 2 / l - 3);
    largest = std::max(largest, W);
    const double eta = largest > 0 ? 1 - s * std::erf((largest - W) / (m * largest)) : 1;
    softened += eta < 0.99;
    EXPECT_NEAR(values[i], eta * mu * (l * l - 1 / l), 1e-9 * mu) << "row " << i;
  }
  EXPECT_EQ(softened, 8u) << "at rows 3 to 7 and from 11 on; at row 8 it is back where it had been";
}

/// hgo along t with families at ±θ from z, all stretches those of the bare strip: the factor leaves λ2 alone.
TEST(StressSoftening, WeighsTheEnergyOfTheFibresToo) {
  constexpr double mu = 18.7, k1 = 24.9, k2 = 0.9, theta = 46, s = 0.6, m = 0.5;
  const auto test = make_strip(stretches, {.channels = {"stress", "transverse_stretch"}});
  const auto soft = wrapped("stress_softening", model("hgo"));
  const std::vector<double> bare = values_of(*test, *model("hgo"), {mu, k1, k2, theta});
  const std::vector<double> values = values_of(*test, *soft, {mu, k1, k2, theta, s, m});
  const std::size_t n = stretches.size();
  const double sine = std::pow(std::sin(theta * M_PI / 180), 2);
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = stretches[i] * stretches[i], z = bare[n + i] * bare[n + i];
    const double strain = std::max(0., t * sine + z * (1 - sine) - 1);
    const double W = mu / 2 * (t + z + 1 / (t * z) - 3) + k1 / k2 * std::expm1(k2 * strain * strain);
    largest = std::max(largest, W);
    const double eta = largest > 0 ? 1 - s * std::erf((largest - W) / (m * largest)) : 1;
    EXPECT_NEAR(values[i], eta * bare[i], 1e-8 * std::abs(bare[i]) + 1e-9) << "row " << i;
    EXPECT_NEAR(values[n + i], bare[n + i], 1e-9);
  }
}

/// Stress and energy of a neo-Hookean material are proportional to μ, so that nothing is large or small by itself.
TEST(StressSoftening, HasNoScaleOfStressOfItsOwn) {
  const auto soft = wrapped("stress_softening", model("neo_hooke"));
  const std::vector<double> values = values_of(*make_strip(stretches), *soft, {25, 0.45, 0.3});
  for (const double scale : {1e-10, 1e10}) {
    const std::vector<double> scaled = values_of(*make_strip(stretches), *soft, {25 * scale, 0.45, 0.3});
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(scaled[i], scale * values[i], 1e-9 * scale * 25) << "row " << i;
    std::vector<double> state, scaled_state;
    for (const double stretch : {1.3, 1.5, 1.2}) {
      const std::vector<double> C = testing::uniaxial_deformation(stretch);
      const auto one = evaluate(*soft, C, {25, 0.45, 0.3}, {.state = true}, {}, state);
      const auto other = evaluate(*soft, C, {25 * scale, 0.45, 0.3}, {.state = true}, {}, scaled_state);
      for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(other.stress[c], scale * one.stress[c], 1e-9 * scale * 25);
      state = one.state;
      scaled_state = other.state;
    }
  }
}

TEST(StressSoftening, IsNotSeenOnAPathThatOnlyLoads) {
  const auto test = make_strip({1, 1.1, 1.2, 1.3, 1.5});
  const auto soft = wrapped("stress_softening", model("hgo"));
  const std::vector<double> hgo{18.7, 24.9, 0.9, 46};
  EXPECT_LE(testing::relative_difference(values_of(*test, *soft, {18.7, 24.9, 0.9, 46, 0.7, 0.2}),
                                         values_of(*test, *model("hgo"), hgo)),
            1e-10);
}

/// Rest is computed to rounding only, and none of it is a memory.
TEST(StressSoftening, HasNothingToRememberAtRest) {
  const auto soft = wrapped("stress_softening", model("hgo"));
  const std::vector<double> idle{1, 1 + 1e-9, 1, 1 - 1e-9, 1, 1, 1.2, 1.4};
  const std::vector<double> hgo{18.7, 24.9, 0.9, 46};
  const auto test = make_strip(idle, {.channels = {"stress", "transverse_stretch"}});
  const std::vector<double> bare = values_of(*test, *model("hgo"), hgo);
  const std::vector<double> values = values_of(*test, *soft, {18.7, 24.9, 0.9, 46, 0.9, 0.05});
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], bare[i], 1e-9 + 1e-9 * std::abs(bare[i]));
}

TEST(StressSoftening, GoesByTheOrderOfRowsAndNotByTime) {
  const auto soft = wrapped("stress_softening", model("hgo"));
  std::vector<double> time;
  for (std::size_t i = 0; i < stretches.size(); ++i) time.push_back(static_cast<double>(i * i));
  const std::vector<double> parameters{18.7, 24.9, 0.9, 46, 0.5, 0.4};
  EXPECT_EQ(values_of(*make_strip(stretches, {.time = time}), *soft, parameters),
            values_of(*make_strip(stretches), *soft, parameters));
}

/// One around the other, around hgo.
std::unique_ptr<Model> with_memory(const std::string& inner, const std::string& outer) {
  return wrapped(outer, inner.empty() ? model("hgo") : wrapped(inner, model("hgo")));
}
std::vector<double> parameters_of(const Model& model) {
  std::vector<double> values;
  for (const Parameter& parameter : model.describe().parameters)
    values.push_back(parameter.name == "g"     ? 0.7
                     : parameter.name == "s"   ? 0.5
                     : parameter.name == "m"   ? 0.4
                     : parameter.name == "tau" ? 3
                     : parameter.name == "mu"  ? 18.7
                     : parameter.name == "k1"  ? 24.9
                     : parameter.name == "k2"  ? 0.9
                                               : 46);
  return values;
}

class SofteningBesideOthers : public ::testing::TestWithParam<std::pair<const char*, const char*>> {
 protected:
  const std::unique_ptr<Model> made = with_memory(GetParam().first, GetParam().second);
  const std::vector<double> parameters = parameters_of(*made);
  static constexpr std::size_t n = 30;
  const std::vector<double> second = std::vector<double>(n, 1.0);
};

/// dS = ½ A : dC along a random direction, from a state that has been further: half of the way back from there.
TEST_P(SofteningBesideOthers, TheTangentIsThatOfTheStressAtAGivenState) {
  const std::vector<double> there = random_deformations(n, 31), aim = random_deformations(n, 32);
  const auto first = evaluate(*made, there, parameters, {.state = true}, second);
  std::vector<double> C(6 * n), direction(6 * n), up, down;
  for (std::size_t k = 0; k < 6 * n; ++k) {
    const double rest = k < 3 * n ? 1 : 0;
    C[k] = rest + 0.5 * (there[k] - rest);
    direction[k] = aim[k] - rest;
  }
  constexpr double h = 1e-6;
  up = C;
  down = C;
  for (std::size_t k = 0; k < 6 * n; ++k) {
    up[k] += h * direction[k];
    down[k] -= h * direction[k];
  }
  const auto at = evaluate(*made, C, parameters, {}, second, first.state);
  const auto above = evaluate(*made, up, parameters, {}, second, first.state);
  const auto below = evaluate(*made, down, parameters, {}, second, first.state);
  for (std::size_t i = 0; i < n; ++i) {
    double size = 1;
    for (std::size_t a = 0; a < 6; ++a) size = std::max(size, std::abs(at.stress[a * n + i]));
    for (std::size_t a = 0; a < 6; ++a) {
      double change = 0;
      for (std::size_t b = 0; b < 6; ++b)
        change += 0.5 * at.tangent[(6 * a + b) * n + i] * direction[b * n + i] * (b < 3 ? 1 : 2);
      EXPECT_NEAR(change, (above.stress[a * n + i] - below.stress[a * n + i]) / (2 * h), 1e-6 * size) << i;
    }
  }
}

TEST_P(SofteningBesideOthers, ABatchIsItsPointsAndATrialCommitsNothing) {
  const std::vector<double> first = random_deformations(n, 33), then = random_deformations(n, 34);
  const auto start = evaluate(*made, first, parameters, {.state = true}, second);
  const auto batch = evaluate(*made, then, parameters, {.state = true}, second, start.state);
  EXPECT_EQ(evaluate(*made, then, parameters, {}, second, start.state).stress, batch.stress) << "state not wanted";
  const std::size_t history = made->describe().history_size;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> C, state, stress, after;
    for (std::size_t c = 0; c < 6; ++c) {
      C.push_back(then[c * n + i]);
      stress.push_back(batch.stress[c * n + i]);
    }
    for (std::size_t k = 0; k < history; ++k) {
      state.push_back(start.state[k * n + i]);
      after.push_back(batch.state[k * n + i]);
    }
    const auto one = evaluate(*made, C, parameters, {.state = true}, {1}, state);
    EXPECT_EQ(one.stress, stress) << i;
    EXPECT_EQ(one.state, after) << i;
  }
}

/// Where the stress alone, or the tangent alone is asked for, it is the same.
TEST_P(SofteningBesideOthers, AnswersDoNotDependOnWhatElseIsWanted) {
  const std::vector<double> first = random_deformations(n, 35), then = random_deformations(n, 36);
  const auto start = evaluate(*made, first, parameters, {.state = true}, second);
  const auto all = evaluate(*made, then, parameters, {.state = true}, second, start.state);
  std::vector<double> stress(6 * n), tangent(36 * n), state(all.state.size());
  ASSERT_TRUE(made->evaluate({n, then, parameters, second, start.state}, {{}, stress, {}, {}, {}}).ok());
  ASSERT_TRUE(made->evaluate({n, then, parameters, second, start.state}, {{}, {}, tangent, {}, {}}).ok());
  ASSERT_TRUE(made->evaluate({n, then, parameters, second, start.state}, {{}, {}, {}, {}, state}).ok());
  EXPECT_EQ(stress, all.stress);
  EXPECT_EQ(tangent, all.tangent);
  EXPECT_EQ(state, all.state);
}

INSTANTIATE_TEST_SUITE_P(StressSoftening, SofteningBesideOthers,
                         ::testing::Values(std::pair{"", "stress_softening"},
                                           std::pair{"stress_softening", "stress_softening"},
                                           std::pair{"viscoelasticity", "stress_softening"},
                                           std::pair{"stress_softening", "viscoelasticity"}),
                         [](const auto& at) {
                           const std::string inner = at.param.first;
                           return (inner.empty() ? "hgo" : inner) + "_in_" + at.param.second;
                         });

TEST(StressSoftening, OfAViscousBaseIsTheViscousStressTimesTheFactor) {
  const auto viscous = wrapped("viscoelasticity", model("hgo"));
  const auto both = wrapped("stress_softening", wrapped("viscoelasticity", model("hgo")));
  const std::vector<double> of_viscous{18.7, 24.9, 0.9, 46, 0.7, 3}, of_both{18.7, 24.9, 0.9, 46, 0.7, 3, 0.5, 0.4};
  const std::vector<double> out = testing::uniaxial_deformation(1.4), back = testing::uniaxial_deformation(1.2);
  const auto a = evaluate(*viscous, out, of_viscous, {.state = true}, {1});
  const auto b = evaluate(*both, out, of_both, {.state = true}, {1});
  const auto a2 = evaluate(*viscous, back, of_viscous, {}, {1}, a.state);
  const auto b2 = evaluate(*both, back, of_both, {}, {1}, b.state);
  EXPECT_EQ(b.stress, a.stress);
  const double eta = 1 - 0.5 * std::erf((a.energy[0] - a2.energy[0]) / (0.4 * a.energy[0]));
  EXPECT_LT(eta, 0.7);
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(b2.stress[c], eta * a2.stress[c], 1e-12 * std::abs(a2.stress[c]));
}

TEST(StressSoftening, DeclaresItsStateAndHasNoParameterDerivativesOfAStep) {
  const auto soft = wrapped("stress_softening", model("hgo"));
  EXPECT_EQ(soft->describe().history_size, 1u);
  EXPECT_FALSE(soft->describe().parameter_derivatives);
  EXPECT_FALSE(soft->describe().principal_axes);
  EXPECT_EQ(soft->parts().size(), 2u);
  std::vector<double> C = testing::uniaxial_deformation(1.1), stress_dp(36);
  const std::vector<double> parameters{18.7, 24.9, 0.9, 46, 0.5, 0.4};
  const Status status = soft->evaluate({1, C, parameters, {}, {}}, {{}, {}, {}, stress_dp, {}});
  EXPECT_EQ(status.reason(), "stress_softening: no parameter derivatives at a single step; difference the whole path");
}

}  // namespace
}  // namespace tunica::stress_softening_test
