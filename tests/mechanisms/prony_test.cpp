// SPDX-License-Identifier: Apache-2.0
// Parallel branches (a Prony series): their single contributions to the elastic stress add up.
#include <cmath>

#include <gtest/gtest.h>

#include "shelf.hpp"

namespace tunica::testing::prony_test {
namespace {

using Values = std::vector<double>;

constexpr double g1 = 0.7, tau1 = 2, g2 = 0.4, tau2 = 30;
const Values rubber{150, -1, 0.1};
/// A path that is not proportional, three points at a time; components tt, zz, rr, tz, zr, tr.
Values deformation(double t) {
  const double a = 1 + 0.3 * t, b = 1 - 0.1 * t, shear = 0.1 * t * t;
  return {a, a * a, 1, b, b * b, 1 + 0.05 * t, 1 / (a * b), 1, 1 - 0.05 * t, shear, 0, -shear,
          0, shear, 0, 0, 0,     shear};
}

Values with(const Values& first, const Values& rest) {
  Values all = first;
  all.insert(all.end(), rest.begin(), rest.end());
  return all;
}

/// Stress and tangent after four steps.
Response along_the_path(const Model& model, const Values& parameters) {
  Values state;
  Response last;
  for (const double t : {0.2, 0.5, 0.9, 0.7}) {
    last = evaluate(model, deformation(t), parameters, {.state = true}, Values(3, 4 * t), state);
    state = last.state;
  }
  return last;
}

TEST(PronySeries, AddsWhatItsBranchesAddAlone) {
  const auto one = wrapped("viscoelasticity", model("yeoh"));
  const auto two = wrapped("viscoelasticity", wrapped("viscoelasticity", model("yeoh")));
  const Response elastic = along_the_path(*one, with(rubber, {0, tau1})),
                 first = along_the_path(*one, with(rubber, {g1, tau1})),
                 second = along_the_path(*one, with(rubber, {g2, tau2})),
                 both = along_the_path(*two, with(rubber, {g1, tau1, g2, tau2})),
                 turned = along_the_path(*two, with(rubber, {g2, tau2, g1, tau1}));
  double largest = 0;
  for (std::size_t i = 0; i < both.stress.size(); ++i) {
    const double sum = first.stress[i] + second.stress[i] - elastic.stress[i];
    EXPECT_NEAR(both.stress[i], sum, 1e-11 * (1 + std::abs(sum))) << i;
    EXPECT_NEAR(turned.stress[i], sum, 1e-11 * (1 + std::abs(sum))) << i;
    largest = std::max(largest, std::abs(second.stress[i] - elastic.stress[i]));
  }
  EXPECT_GT(largest, 1);
  for (std::size_t i = 0; i < both.tangent.size(); ++i) {
    const double sum = first.tangent[i] + second.tangent[i] - elastic.tangent[i];
    EXPECT_NEAR(both.tangent[i], sum, 1e-10 * (1 + std::abs(sum))) << i;
  }
}

TEST(PronySeries, WithASecondBranchAtItsNullIsTheFirstBitForBit) {
  const auto one = wrapped("viscoelasticity", model("yeoh"));
  const auto two = wrapped("viscoelasticity", wrapped("viscoelasticity", model("yeoh")));
  const Response first = along_the_path(*one, with(rubber, {g1, tau1})),
                 both = along_the_path(*two, with(rubber, {g1, tau1, 0, tau2}));
  EXPECT_EQ(both.stress, first.stress);
  EXPECT_EQ(both.tangent, first.tangent);
}

/// Softening between the elastic model and the branches: they relax from what is softened.
TEST(PronySeries, StandsBesideAModelThatHasAMemoryOfItsOwn) {
  const auto soft = [] { return wrapped("stress_softening", model("yeoh")); };
  const auto one = wrapped("viscoelasticity", soft());
  const auto two = wrapped("viscoelasticity", wrapped("viscoelasticity", soft()));
  const Values softened = with(rubber, {0.5, 0.4});
  const Response elastic = along_the_path(*one, with(softened, {0, tau1})),
                 first = along_the_path(*one, with(softened, {g1, tau1})),
                 second = along_the_path(*one, with(softened, {g2, tau2})),
                 both = along_the_path(*two, with(softened, {g1, tau1, g2, tau2}));
  for (std::size_t i = 0; i < both.stress.size(); ++i) {
    const double sum = first.stress[i] + second.stress[i] - elastic.stress[i];
    EXPECT_NEAR(both.stress[i], sum, 1e-11 * (1 + std::abs(sum))) << i;
  }
}

}  // namespace
}  // namespace tunica::testing::prony_test
