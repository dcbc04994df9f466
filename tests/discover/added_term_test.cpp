// SPDX-License-Identifier: Apache-2.0
// One term beside a model is the same energy as a model of both.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/loaded.hpp"

namespace tunica::testing {
namespace {

struct Added {
  std::string invariant, law, family;
};

std::vector<Added> all() {
  std::vector<Added> terms;
  for (const char* law :
       {"linear", "quadratic", "cubic", "power", "exponential", "gent", "inverse_langevin", "logarithm"})
    for (const char* invariant : {"I1", "I2"}) terms.push_back({invariant, law, ""});
  for (const char* law : {"quadratic", "cubic", "power", "exponential_square"})
    for (const char* family : {"axial", "circumferential", "diagonal", "single"})
      terms.push_back({"fibre", law, family});
  terms.push_back({"stretches", "power", ""});
  terms.push_back({"coupling", "quadratic", ""});
  return terms;
}

std::string words(const ::testing::TestParamInfo<Added>& info) {
  return info.param.invariant + "_" + info.param.law + (info.param.family.empty() ? "" : "_" + info.param.family);
}

/// Energy, gradient and all derivatives at three states, one row after the other.
std::vector<double> answers(const Model& model, const std::vector<double>& parameters) {
  const std::vector<double> c{1.2, 1.5, 0.9, 1.1, 0.8, 1.4, 0.8, 0.85, 0.9};  // squared stretches, component-major
  const std::size_t n = 3, m = parameters.size();
  std::vector<double> energy(n), gradient(3 * n), hessian(6 * n), gradient_dp(3 * n * m), energy_dp(n * m);
  EXPECT_TRUE(model.evaluate_axes({n, c, parameters}, {energy, gradient, hessian, gradient_dp, energy_dp}).ok());
  std::vector<double> C(6 * n, 0.0), W(n), S(6 * n), tangent(36 * n), S_dp(6 * n * m);
  std::copy(c.begin(), c.end(), C.begin());
  for (std::size_t i = 0; i < n; ++i) C[3 * n + i] = 0.1;
  EXPECT_TRUE(model.evaluate({n, C, parameters, {}, {}}, {W, S, tangent, S_dp, {}}).ok());
  std::vector<double> whole;
  for (const auto* rows : {&energy, &gradient, &hessian, &gradient_dp, &energy_dp, &W, &S, &tangent, &S_dp})
    whole.insert(whole.end(), rows->begin(), rows->end());
  return whole;
}

class AddedTerm : public ::testing::TestWithParam<Added> {};

TEST_P(AddedTerm, IsTheSumWithTheBase) {
  const Added& added = GetParam();
  const auto& mechanism = catalogue().mechanisms().at("added_term");
  Options options = defaults(mechanism.factory.options);
  options.set("invariant", added.invariant);
  options.set("law", added.law);
  if (!added.family.empty()) options.set("family", added.family);
  const auto with_term = plugins::wrap(mechanism, make_model("neo_hooke"), options);

  std::string term = fmt::format(R"({{"name": "t", "invariant": "{}")", added.invariant);
  if (added.invariant != "stretches") term += fmt::format(R"(, "law": "{}")", added.law);
  if (!added.family.empty()) term += fmt::format(R"(, "family": "{}")", added.family);
  Options both;
  both.set("terms", R"([{"name": "m", "invariant": "I1", "law": "linear"}, )" + term + "}]");
  const auto composed = make_model("composed", both);

  std::vector<double> parameters{30};
  const auto& declared = with_term->describe().parameters;
  ASSERT_EQ(declared.size(), composed->describe().parameters.size());
  for (std::size_t j = 1; j < declared.size(); ++j) {
    EXPECT_EQ("t_" + declared[j].name, composed->describe().parameters[j].name);
    parameters.push_back(j == 1 ? 12 : composed->describe().parameters[j].initial);
  }
  const std::vector<double> sum = answers(*with_term, parameters), whole = answers(*composed, parameters);
  for (std::size_t k = 0; k < sum.size(); ++k) EXPECT_NEAR(sum[k], whole[k], 1e-11 * (1 + std::abs(whole[k]))) << k;
  // At the null the base answers alone.
  parameters[1] = 0;
  const auto base = make_model("neo_hooke");
  std::vector<double> c{1.2, 1.5, 0.7}, gradient(3), bare(3);
  ASSERT_TRUE(with_term->evaluate_axes({1, c, parameters}, {{}, gradient, {}, {}, {}}).ok());
  ASSERT_TRUE(base->evaluate_axes({1, c, std::vector<double>{30}}, {{}, bare, {}, {}, {}}).ok());
  EXPECT_EQ(gradient, bare);
}

// A search that may leave a term out has to reach 0, which the logarithm of a stiffness does not.
TEST(AddedTermDescription, HasAnAmplitudeThatMayBeNothing) {
  const auto& mechanism = catalogue().mechanisms().at("added_term").factory;
  ASSERT_EQ(mechanism.parameters.size(), 1u);  // by default I2, linear
  EXPECT_EQ(mechanism.parameters[0].name, "mu");
  Options options = defaults(mechanism.options);
  const auto amplitude = [&](const std::string& invariant, const std::string& law, const std::string& knots = "[]") {
    options.set("invariant", invariant);
    options.set("law", law);
    options.set("knots", knots);
    return mechanism.parameters_of(options).front();
  };
  for (const Parameter& one : {mechanism.parameters[0], amplitude("I1", "gent"), amplitude("fibre", "power"),
                               amplitude("radial", "spline", "[0, 1]")}) {
    EXPECT_EQ(one.min, 0) << one.name;
    EXPECT_EQ(one.scale, Scale::linear) << one.name;
    EXPECT_EQ(one.max, 1e5) << one.name;
  }
  // Ogden's coefficients have either sign.
  EXPECT_EQ(amplitude("stretches", "power").min, -5000);
}

INSTANTIATE_TEST_SUITE_P(AllTerms, AddedTerm, ::testing::ValuesIn(all()), words);

}  // namespace
}  // namespace tunica::testing
