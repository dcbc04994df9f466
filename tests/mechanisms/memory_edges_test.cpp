// SPDX-License-Identifier: Apache-2.0
// Memory where paths begin, end and turn: prestressed bodies, amplitudes at their bounds, the moment before the largest
// energy, and bases that take their interface by the word.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "deformations.hpp"
#include "exact_model.hpp"
#include "shelf.hpp"

namespace tunica::testing::memory_edges_test {
namespace {

using Values = std::vector<double>;

constexpr double mu = 20, tau = 5;
const Values rest{1, 1, 1, 0, 0, 0};

std::unique_ptr<Model> exact(const std::string& type) { return std::make_unique<ExactModel>(model(type)); }

/// Muscle pulls at rest too, S = T e_t ⊗ e_t there. A branch that begins at rest has nothing to relax from.
TEST(MemoryEdges, APrestressThatWasAlwaysThereDoesNotRelax) {
  const auto viscous = wrapped("viscoelasticity", wrapped("active_tone", model("neo_hooke")));
  for (const double g : {1.0, 0.6}) {
    const Values parameters{mu, 8, g, tau};
    const auto first = evaluate(*viscous, rest, parameters, {.state = true}, {1});
    for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(first.stress[c], c > 2 ? 0 : c == 0 ? mu + 8 : mu, 1e-12) << c;
    // Stretched, the change of S' alone is held: S_tt = μ + T/C_tt, S' = S − ⅓ (S : C) C⁻¹.
    const Values C = uniaxial_deformation(1.3);
    const auto stretched = evaluate(*viscous, C, parameters, {}, {0}, first.state);
    const double S[] = {mu + 8 / C[0], mu, mu}, work = S[0] * C[0] + S[1] * C[1] + S[2] * C[2];
    for (std::size_t c = 0; c < 3; ++c) {
      const double now = S[c] - work / 3 / C[c], at_rest = (c == 0 ? mu + 8 : mu) - (3 * mu + 8) / 3;
      EXPECT_NEAR(stretched.stress[c], S[c] + g * (now - at_rest), 1e-12 * mu) << c;
    }
  }
}

/// A branch as stiff as what it stands beside doubles a jump of S', trial or not, alone or beside another one.
TEST(MemoryEdges, ABranchOfShareOneDoublesAJump) {
  const auto one = wrapped("viscoelasticity", model("mooney_rivlin"));
  const auto two = wrapped("viscoelasticity", wrapped("viscoelasticity", model("mooney_rivlin")));
  const Values C = random_deformations(4, 41), elastic{6, 3}, now(4, 0.0);
  const auto bare = evaluate(*model("mooney_rivlin"), C, elastic);
  const auto single = evaluate(*one, C, {6, 3, 1, tau}, {}, now);
  const auto with_null = evaluate(*two, C, {6, 3, 0, tau, 1, 2 * tau}, {}, now);
  const auto with_one = evaluate(*two, C, {6, 3, 1, tau, 1, 2 * tau}, {}, now);
  for (std::size_t i = 0; i < 4; ++i) {
    double work = 0;
    for (std::size_t c = 0; c < 6; ++c) work += (c < 3 ? 1 : 2) * bare.stress[4 * c + i] * C[4 * c + i];
    const double minor = C[4 + i] * C[8 + i] - C[16 + i] * C[16 + i];
    const double determinant = C[i] * minor - C[12 + i] * (C[12 + i] * C[8 + i] - C[16 + i] * C[20 + i]) +
                               C[20 + i] * (C[12 + i] * C[16 + i] - C[4 + i] * C[20 + i]);
    const double jump = bare.stress[i] - work / 3 * minor / determinant;
    EXPECT_NEAR(single.stress[i], bare.stress[i] + jump, 1e-11 * std::abs(bare.stress[i])) << i;
    EXPECT_NEAR(with_one.stress[i], bare.stress[i] + 2 * jump, 1e-11 * std::abs(bare.stress[i])) << i;
  }
  EXPECT_EQ(with_null.stress, single.stress);
  EXPECT_EQ(with_null.tangent, single.tangent);
}

/// dS = ½ A : dC, with a base whose tangent has all components, shear along the normal among them.
TEST(MemoryEdges, TheTangentOfABranchIsThatOfItsStressInEveryComponent) {
  const auto viscous = wrapped("viscoelasticity", model("mooney_rivlin"));
  constexpr std::size_t n = 3;
  const Values parameters{6, 3, 0.8, tau}, step(n, 0.7), C = random_deformations(n, 42);
  const auto start = evaluate(*viscous, random_deformations(n, 43), parameters, {.state = true}, step);
  const auto at = evaluate(*viscous, C, parameters, {}, step, start.state);
  constexpr double h = 1e-5;
  for (std::size_t b = 0; b < 6; ++b) {
    Values up = C, down = C;
    for (std::size_t i = 0; i < n; ++i) {
      up[b * n + i] += h;
      down[b * n + i] -= h;
    }
    const auto above = evaluate(*viscous, up, parameters, {}, step, start.state);
    const auto below = evaluate(*viscous, down, parameters, {}, step, start.state);
    for (std::size_t a = 0; a < 6; ++a)
      for (std::size_t i = 0; i < n; ++i)
        EXPECT_NEAR(at.tangent[(6 * a + b) * n + i],
                    2 * (above.stress[a * n + i] - below.stress[a * n + i]) / (2 * h * (b < 3 ? 1 : 2)), 1e-6)
            << a << ' ' << b << " of point " << i;
  }
}

/// Bases get their own parameters and state, and outputs of the length that they write, whatever is wanted.
TEST(MemoryEdges, ABaseIsAskedInItsOwnTerms) {
  constexpr std::size_t n = 3;
  const Values first = random_deformations(n, 44), second = random_deformations(n, 45), step(n, 0.5);
  const Values soft{0.5, 0.4}, branch{0.7, tau};
  const auto expect_answers = [&](const Model& made, const Values& own) {
    Values parameters{18.7, 24.9, 0.9, 46};
    parameters.insert(parameters.end(), own.begin(), own.end());
    const std::size_t history = made.describe().history_size;
    const auto start = evaluate(made, first, parameters, {.state = true}, step);
    const auto all = evaluate(made, second, parameters, {.state = true}, step, start.state);
    Values energy(n), stress(6 * n), tangent(36 * n), state(history * n);
    const MaterialPoints points{n, second, parameters, step, start.state};
    EXPECT_EQ(made.evaluate(points, {energy, {}, {}, {}, {}}).reason(), "");
    EXPECT_EQ(made.evaluate(points, {{}, stress, {}, {}, {}}).reason(), "");
    EXPECT_EQ(made.evaluate(points, {{}, {}, tangent, {}, {}}).reason(), "");
    EXPECT_EQ(made.evaluate(points, {{}, {}, {}, {}, state}).reason(), "");
    EXPECT_EQ(energy, all.energy);
    EXPECT_EQ(stress, all.stress);
    EXPECT_EQ(tangent, all.tangent);
    EXPECT_EQ(state, all.state);
    EXPECT_EQ(Values(state.begin(), state.begin() + n), Values(n, 2)) << "steps of the base";
  };
  expect_answers(*wrapped("viscoelasticity", exact("hgo")), branch);
  expect_answers(*wrapped("stress_softening", exact("hgo")), soft);
  expect_answers(*wrapped("viscoelasticity", wrapped("viscoelasticity", exact("hgo"))), {0.7, tau, 0.3, 60});
  expect_answers(*wrapped("stress_softening", wrapped("viscoelasticity", exact("hgo"))), {0.7, tau, 0.5, 0.4});
}

/// How often the base is evaluated in one call; a state stands for steps before.
std::size_t calls_of(const std::vector<std::string>& mechanisms, const Values& own, bool memory, bool stress,
                     bool tangent, bool before, bool commit) {
  std::size_t calls = 0;
  std::unique_ptr<Model> made = std::make_unique<ExactModel>(model("neo_hooke"), &calls, memory);
  for (const std::string& mechanism : mechanisms) made = wrapped(mechanism, std::move(made));
  Values parameters{mu}, energy(1), s(stress ? 6 : 0), t(tangent ? 36 : 0);
  parameters.insert(parameters.end(), own.begin(), own.end());
  const std::size_t history = made->describe().history_size;
  const Values C = uniaxial_deformation(1.2), step{1}, old(before ? history : 0, 0.1);
  Values state(commit ? history : 0);
  const Status status = made->evaluate({1, C, parameters, step, old}, {energy, s, t, {}, state});
  EXPECT_TRUE(status.ok()) << status.reason();
  return calls;
}

/// At the null the base answers alone, and where nothing can be soft yet. Softening asks for the energy at rest too,
/// and for the stress without memory where a tangent needs it: every evaluation costs as much as the material does.
TEST(MemoryEdges, SofteningAsksItsBaseAsOftenAsItNeeds) {
  const auto calls = [](double s, bool memory, bool stress, bool tangent, bool before, bool commit) {
    return calls_of({"stress_softening"}, {s, 0.5}, memory, stress, tangent, before, commit);
  };
  EXPECT_EQ(calls(0, false, true, true, true, false), 1u) << "at the null";
  EXPECT_EQ(calls(0.4, false, true, true, false, false), 1u) << "at the first step";
  EXPECT_EQ(calls(0.4, false, false, false, true, false), 1u) << "of the energy alone";
  EXPECT_EQ(calls(0.4, false, true, true, true, false), 2u) << "and the energy at rest";
  EXPECT_EQ(calls(0.4, true, true, false, true, false), 2u) << "a stress needs no other";
  EXPECT_EQ(calls(0, true, true, true, true, true), 2u) << "Wmax alone";
  EXPECT_EQ(calls(0.4, true, true, true, true, false), 3u) << "and the stress without memory";
}

/// A branch asks for the stress at rest where a path begins, and beside another one for the elastic response.
TEST(MemoryEdges, ABranchAsksItsBaseAsOftenAsItNeeds) {
  const std::vector<std::string> one{"viscoelasticity"}, two{"viscoelasticity", "viscoelasticity"};
  EXPECT_EQ(calls_of(one, {0.5, tau}, true, true, true, true, true), 1u);
  EXPECT_EQ(calls_of(one, {0.5, tau}, true, true, true, false, true), 2u) << "and at rest";
  EXPECT_EQ(calls_of(one, {0.5, tau}, true, false, false, false, false), 1u) << "of the energy alone";
  EXPECT_EQ(calls_of(one, {0, tau}, true, true, true, false, true), 1u) << "at the null";
  EXPECT_EQ(calls_of(two, {0, tau, 0, tau}, true, true, true, true, false), 1u) << "both at the null";
  EXPECT_EQ(calls_of(two, {0.5, tau, 0, tau}, true, true, true, true, false), 1u) << "the second at the null";
  EXPECT_EQ(calls_of(two, {0.5, tau, 0.3, tau}, true, true, true, true, false), 2u) << "and the elastic response";
}

/// W of a neo-Hookean material in a strip.
double energy_of(double stretch) { return mu / 2 * (stretch * stretch + 2 / stretch - 3); }

/// Numbers of the base beyond the largest energy so far: nothing is soft, not even the slope.
TEST(MemoryEdges, BeyondTheLargestEnergyNothingIsSoft) {
  const auto soft = wrapped("stress_softening", model("neo_hooke"));
  const Values C = uniaxial_deformation(1.5);
  const auto bare = evaluate(*model("neo_hooke"), C, {mu});
  for (const double s : {1.0, 0.4}) {
    const auto found = evaluate(*soft, C, {mu, s, 0.3}, {.state = true}, {}, {energy_of(1.3)});
    EXPECT_EQ(found.stress, bare.stress);
    EXPECT_EQ(found.tangent, bare.tangent);
    EXPECT_NEAR(found.state[0], energy_of(1.5), 1e-12 * mu);
  }
}

/// s = 1 is a bound, not a null: far below the largest energy all is lost; with s = 0.4 a share of 0.4, and the stress
/// does not depend on the energy there.
TEST(MemoryEdges, FarBelowTheLargestEnergyTheWholeShareIsLost) {
  const auto soft = wrapped("stress_softening", model("neo_hooke"));
  const Values C = uniaxial_deformation(1.1);
  for (const double s : {1.0, 0.4}) {
    const auto found = evaluate(*soft, C, {mu, s, 0.01}, {}, {}, {energy_of(1.5)});
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found.stress[c], (1 - s) * mu, 1e-13 * mu);
    for (const double entry : found.tangent) EXPECT_EQ(entry, 0);  // η is constant, and S = η μ 1
  }
}

/// Unloading has begun one rounding below the largest energy: the tangent is that of the lower curve,
/// 2 ∂η/∂C ⊗ S with ∂η/∂W = 2 s / (√π m Wmax), while the stress still is the base's.
TEST(MemoryEdges, TheTangentTurnsWhereUnloadingBegins) {
  const auto soft = wrapped("stress_softening", model("neo_hooke"));
  const Values C = uniaxial_deformation(1.5);
  constexpr double s = 0.2, m = 10;
  const double W = evaluate(*model("neo_hooke"), C, {mu}).energy[0];
  const double largest = std::nextafter(W, std::numeric_limits<double>::infinity());
  const auto found = evaluate(*soft, C, {mu, s, m}, {}, {}, {largest});
  const double slope = 2 * s / (std::sqrt(M_PI) * m * W);
  for (std::size_t a = 0; a < 6; ++a) {
    EXPECT_EQ(found.stress[a], a < 3 ? mu : 0);
    for (std::size_t b = 0; b < 6; ++b)
      EXPECT_NEAR(found.tangent[6 * a + b], a < 3 && b < 3 ? slope * mu * mu : 0, 1e-12 * slope * mu * mu);
  }
}

/// A material at rest under stress of its own, with the energy that it is told.
class Pulled final : public Model {
 public:
  explicit Pulled(Values stress, double energy) : stress_(std::move(stress)), energy_(energy) {
    description_.type = "pulled";
    description_.parameters = {{"a", "1", 1, 0, 2, Scale::linear, "", ""}};
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    const std::size_t n = points.count;
    for (std::size_t i = 0; i < n; ++i) {
      const bool at_rest = points.C[i] == 1;
      if (!response.energy.empty()) response.energy[i] = at_rest ? 0 : energy_;
      for (std::size_t c = 0; c < 6 && !response.stress.empty(); ++c)
        response.stress[c * n + i] = c < 3 ? stress_[c] * (i == 1 ? 1 : 0.01) : 0;
    }
    for (double& entry : response.tangent) entry = 0;
    return {};
  }

 private:
  ModelDescription description_;
  Values stress_;
  double energy_;
};

/// What is below 1e-12 of the stress, on whichever axis that is the largest, is rounding and no memory.
TEST(MemoryEdges, AnEnergyBelowRoundingIsNoMemory) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      Values stress{3, 3, 3};
      stress[axis] = sign * 100;
      const auto soft = wrapped("stress_softening", std::make_unique<Pulled>(stress, 0.1e-12 * 100));
      constexpr std::size_t n = 3;
      Values C(6 * n, 0.0);
      for (std::size_t k = 0; k < 3 * n; ++k) C[k] = 1.1;
      const auto stress_of = [&](double largest) {
        const Values state(n, largest);
        return evaluate(*soft, C, {1, 0.5, 0.1}, {}, {}, state).stress[axis * n + 1];
      };
      EXPECT_EQ(stress_of(0.8e-12 * 100), sign * 100) << axis;
      EXPECT_NEAR(stress_of(1.25e-12 * 100), sign * 50, 1e-6) << axis;
    }
}

/// An energy that is not a number leaves a memory that is none; one below that of rest leaves none.
TEST(MemoryEdges, AnUndefinedEnergyIsNotForgotten) {
  const double undefined = std::numeric_limits<double>::quiet_NaN();
  const Values C = uniaxial_deformation(1.2), parameters{1, 0.5, 0.1};
  const auto lost = wrapped("stress_softening", std::make_unique<Pulled>(Values{1, 1, 1}, undefined));
  EXPECT_TRUE(std::isnan(evaluate(*lost, C, parameters, {.state = true}, {}, {3}).state[0]));
  const auto below = wrapped("stress_softening", std::make_unique<Pulled>(Values{1, 1, 1}, -2));
  EXPECT_EQ(evaluate(*below, C, parameters, {.state = true}).state[0], 0);
}

}  // namespace
}  // namespace tunica::testing::memory_edges_test
