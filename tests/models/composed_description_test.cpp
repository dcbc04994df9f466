// SPDX-License-Identifier: Apache-2.0
// What a model that is put together in the file says of itself: its parameters with their bounds, its formula, its
// limits.
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/composed.hpp"

namespace tunica::testing::composed_description_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string one_term(const std::string& more) { return R"([{"name": "t", )" + more + "}]"; }
ModelDescription described(const std::string& more) { return composed(one_term(more))->describe(); }

std::vector<std::string> parameters_of(const std::string& more) {
  std::vector<std::string> all;
  for (const Parameter& one : described(more).parameters)
    all.push_back(fmt::format("{} = {} {} in [{}, {}]{}", one.name, one.initial, one.unit, one.min, one.max,
                              one.scale == Scale::log ? ", log" : ""));
  return all;
}

// From docs/composed.md, and bounds that no fit should meet: 0.1 Pa to 100 MPa.
TEST(ComposedDescription, HasTheParametersOfEachLaw) {
  const auto of_law = [](const std::string& law) {
    return parameters_of(R"("invariant": "I1", "law": ")" + law + "\"");
  };
  const auto stiffness = [](const char* name) { return fmt::format("t_{} = 10 kPa in [0.0001, 100000], log", name); };
  const auto rate = [](const char* name) { return fmt::format("t_{} = 1 1 in [0.001, 100], log", name); };
  EXPECT_THAT(of_law("linear"), ElementsAre(stiffness("mu")));
  EXPECT_THAT(of_law("quadratic"), ElementsAre(stiffness("k")));
  EXPECT_THAT(of_law("cubic"), ElementsAre(stiffness("k")));
  EXPECT_THAT(of_law("power"), ElementsAre(stiffness("k"), "t_m = 3 1 in [2, 20]"));
  EXPECT_THAT(of_law("exponential"), ElementsAre(stiffness("mu"), rate("b")));
  EXPECT_THAT(of_law("exponential_square"), ElementsAre(stiffness("k1"), rate("k2")));
  EXPECT_THAT(of_law("gent"), ElementsAre(stiffness("mu"), "t_Jm = 50 1 in [0.01, 10000], log"));
  EXPECT_THAT(of_law("inverse_langevin"), ElementsAre(stiffness("mu"), "t_N = 20 1 in [1.05, 10000], log"));
  EXPECT_THAT(of_law("logarithm"), ElementsAre(stiffness("mu")));
}

TEST(ComposedDescription, GivesASplineAHeightAtEveryKnotAndASlopeWhereItMayPullAtRest) {
  const std::string curve = R"("law": "spline", "knots": [0, 0.5, 1], "invariant": )";
  const std::string first = "t_c_1 = 10 kPa in [0, 100000]", second = "t_c_2 = 10 kPa in [0, 100000]",
                    third = "t_c_3 = 10 kPa in [0, 100000]";
  EXPECT_THAT(parameters_of(curve + R"("I1")"), ElementsAre("t_slope = 0 kPa in [0, 100000]", first, second, third));
  EXPECT_THAT(parameters_of(curve + R"("radial")"), ElementsAre(first, second, third));
  const ModelDescription model = described(curve + R"("radial")");
  EXPECT_EQ(model.parameters[1].doc, "Second derivative of the curve at knot 2.");
}

TEST(ComposedDescription, GivesFibresAnAngleAndTheirDispersion) {
  const auto fibres = [](const std::string& family, const std::string& more) {
    return parameters_of(R"("invariant": "fibre", "law": "quadratic", "family": ")" + family + "\"" + more);
  };
  const std::string k = "t_k = 10 kPa in [0.0001, 100000], log", third = fmt::format("{}", 1. / 3);
  EXPECT_THAT(fibres("axial", ""), ElementsAre(k));
  EXPECT_THAT(fibres("axial", R"(, "dispersion": "rotational")"),
              ElementsAre(k, "t_kappa = 0.1 1 in [0, " + third + "]"));
  EXPECT_THAT(fibres("axial", R"(, "dispersion": "two_planes")"),
              ElementsAre(k, "t_A = 0.2 1 in [0, " + third + "]", "t_B = 0.4 1 in [0, 1]"));
  ASSERT_EQ(fibres("diagonal", "").size(), 2u);
  EXPECT_THAT(fibres("diagonal", "").back(), HasSubstr("t_theta"));
}

TEST(ComposedDescription, GivesPowersOfTheStretchesACoefficientAndAnExponent) {
  EXPECT_THAT(parameters_of(R"("invariant": "stretches")"),
              ElementsAre("t_mu = 100 kPa in [-5000, 5000]", "t_alpha = 2 1 in [-30, 30]"));
}

// The structure tensor A 1 + B M + (1 − 3A − B) N has the weights A + B, 1 − 2A − B and A along the three axes of the
// fibre (Holzapfel et al. 2015).
TEST(ComposedDescription, AsksForAStructureTensorWithoutNegativeWeight) {
  const ModelDescription model =
      described(R"("invariant": "fibre", "law": "quadratic", "family": "diagonal", "dispersion": "two_planes")");
  ASSERT_EQ(model.admissible.size(), 2u);
  std::vector<double> p(model.parameters.size(), std::nan(""));
  for (std::size_t j = 0; j < p.size(); ++j) {
    if (model.parameters[j].name == "t_A") p[j] = 0.3;
    if (model.parameters[j].name == "t_B") p[j] = 0.25;
  }
  EXPECT_EQ(model.admissible[0].name, "t_A + t_B");
  EXPECT_NEAR(model.admissible[0].value(p), 0.55, 1e-15);
  EXPECT_EQ(model.admissible[1].name, "1 - 2 t_A - t_B");
  EXPECT_NEAR(model.admissible[1].value(p), 0.15, 1e-15);
  EXPECT_TRUE(described(R"("invariant": "fibre", "law": "quadratic", "family": "axial", "dispersion": "rotational")")
                  .admissible.empty());
}

TEST(ComposedDescription, WritesEveryLawAsAFormula) {
  const std::map<std::string, std::string> formulas{
      {R"("invariant": "I1", "law": "linear")", "t_mu/2 (I1 - 3)"},
      {R"("invariant": "I2", "law": "quadratic")", "t_k/2 (I2 - 3)^2"},
      {R"("invariant": "radial", "law": "cubic")", "t_k/3 (C_rr - 1)^3"},
      {R"("invariant": "I1", "law": "power")", "t_k/t_m (I1 - 3)^t_m"},
      {R"("invariant": "I1", "law": "exponential")", "t_mu/(2 t_b) (exp(t_b (I1 - 3)) - 1)"},
      {R"("invariant": "I1", "law": "gent")", "-t_mu t_Jm/2 ln(1 - (I1 - 3)/t_Jm)"},
      {R"("invariant": "I2", "law": "logarithm")", "3 t_mu/2 ln(1 + (I2 - 3)/3)"},
      {R"("invariant": "I1", "law": "inverse_langevin")", "[eight chains of t_N links, n k T = t_mu, x = (I1 - 3)]"},
      {R"("invariant": "I1", "law": "spline", "knots": [0, 1])", "[a curve over (I1 - 3)]"},
      {R"("invariant": "across", "family": "circumferential", "law": "quadratic")", "t_k/2 C_tr^2"},
      {R"("invariant": "stretches")", "t_mu/t_alpha (l1^t_alpha + l2^t_alpha + l3^t_alpha - 3)"}};
  for (const auto& [term, formula] : formulas) EXPECT_EQ(described(term).formula, "W = " + formula) << term;
  const std::string shared = composed(R"([{"name": "f", "invariant": "fibre", "family": "single", "law": "quadratic"},
    {"name": "g", "invariant": "fibre", "family": "diagonal", "angle_of": "f", "law": "quadratic"}])")
                                 ->describe()
                                 .formula;
  EXPECT_THAT(shared, HasSubstr("sum over +-f_theta of g_k/2"));
  const std::string coupled = composed(R"([{"name": "f", "invariant": "fibre", "family": "single", "law": "quadratic"},
    {"name": "c", "invariant": "coupling", "angle_of": "f", "law": "quadratic"}])")
                                  ->describe()
                                  .formula;
  EXPECT_THAT(coupled, HasSubstr("cos 2 f_theta"));
}

std::string many(std::size_t count, const std::string& more) {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < count; ++k) all.push_back(fmt::format(R"({{"name": "t{}", {}}})", k, more));
  return fmt::format("[{}]", fmt::join(all, ", "));
}

TEST(ComposedDescription, HasSixPowersOfTheStretchesAtMostAnd64Parameters) {
  const std::string power = R"("invariant": "stretches")", line = R"("invariant": "I1", "law": "linear")";
  EXPECT_EQ(refusal(many(6, power)), "");
  EXPECT_THAT(refusal(many(7, power)), HasSubstr("have 7 terms of the principal stretches, and a model may have 6"));
  EXPECT_EQ(refusal(many(64, line)), "");
  EXPECT_THAT(refusal(many(65, line)), HasSubstr("have 65 parameters together, and a model may have 64"));
}

// Beyond what a part holds, terms of I1 stand beside each other: n lines of the same modulus are one of n times it.
TEST(ComposedDescription, AddsUpMoreTermsThanOnePartHolds) {
  const std::string line = R"("invariant": "I1", "law": "linear")";
  for (const std::size_t count : {2u, 15u, 16u, 17u, 18u, 40u}) {
    const auto model = composed(many(count, line));
    const std::vector<double> C{1.44, 1 / 1.44, 1, 0, 0, 0}, p(count, 3);
    double energy = 0;
    ASSERT_TRUE(model->evaluate({1, C, p, {}, {}}, {{&energy, 1}, {}, {}, {}, {}}).ok());
    EXPECT_NEAR(energy, 1.5 * static_cast<double>(count) * (1.44 + 1 / 1.44 + 1 - 3), 1e-12) << count;
  }
}

}  // namespace
}  // namespace tunica::testing::composed_description_test
