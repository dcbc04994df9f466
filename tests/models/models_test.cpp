// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"
#include "support/loaded.hpp"
#include "tunica/models/autodiff.hpp"
#include "tunica/models/hyperelastic.hpp"
#include "tunica/models/laws.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

/// Largest relative difference between the hand-written response of a law and the one differentiated from its formula.
template <class Law>
double worst_against_autodiff(const std::vector<double>& p, const std::vector<double>& x) {
  const std::size_t n = x.size(), np = p.size();
  std::array<std::vector<double>, 5> hand, automatic;
  for (auto* rows : {&hand, &automatic}) {
    for (std::size_t k = 0; k < 3; ++k) (*rows)[k].resize(n);
    for (std::size_t k = 3; k < 5; ++k) (*rows)[k].resize(np * n);
  }
  Law::respond(p, {x, hand[0], hand[1], hand[2], hand[3], hand[4]});
  respond_by_autodiff<Law>(p, {x, automatic[0], automatic[1], automatic[2], automatic[3], automatic[4]});
  double worst = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    for (std::size_t row = 0; row < hand[k].size() / n; ++row) {
      double scale = 0, difference = 0;
      for (std::size_t i = 0; i < n; ++i) {
        scale = std::max(scale, std::abs(automatic[k][row * n + i]));
        difference = std::max(difference, std::abs(hand[k][row * n + i] - automatic[k][row * n + i]));
      }
      if (scale > 0) worst = std::max(worst, difference / scale);
    }
  }
  return worst;
}

TEST(Laws, HandWrittenDerivativesAgreeWithAutodiff) {
  std::mt19937_64 engine(1);  // deterministic: seed fixed
  std::uniform_real_distribution<double> strain(-0.5, 2), exponent(0.05, 5), stiffness(0.1, 100);
  for (int draw = 0; draw < 50; ++draw) {
    std::vector<double> x(17);
    for (double& value : x) value = strain(engine);
    EXPECT_LT(worst_against_autodiff<laws::Exponential>({stiffness(engine), exponent(engine)}, x), 1e-12);
    EXPECT_LT(worst_against_autodiff<laws::Linear>({stiffness(engine)}, x), 1e-12);
  }
}

TEST(Laws, ExponentialHasItsLimitAtSmallExponent) {
  const std::vector<double> p{3, 1e-9}, x{0.7};
  double value, first, second;
  std::array<double, 2> value_dp, first_dp;
  laws::Exponential::respond(p, {x, {&value, 1}, {&first, 1}, {&second, 1}, value_dp, first_dp});
  EXPECT_NEAR(value, 0.5 * 3 * 0.49, 1e-8);
  EXPECT_NEAR(first, 3 * 0.7, 1e-8);
  EXPECT_NEAR(value_dp[1], 3. / 4 * std::pow(0.7, 4), 1e-8);  // ∂ψ/∂k2 → k1 x⁴/4
}

TEST(Laws, SeriesOfTheExponentialJoinsTheClosedForm) {
  for (const double y : {0.99e-2, 1.01e-2, -0.99e-2, -1.01e-2}) {
    const long double e = std::exp(static_cast<long double>(y)), l = y;
    EXPECT_NEAR(laws::Exponential::phi_prime(y), static_cast<double>((e * (l - 1) + 1) / (l * l)), 1e-11);
  }
}

/// W of the `gho` written out once more, by hand and on the full tensor (physics, section 2).
double gho_energy(const Tensor& C, const std::vector<double>& p) {
  const double theta = p[4] * std::acos(-1.0) / 180, i1 = C[0] + C[1] + C[2];
  double w = p[0] / 2 * (i1 - 3);
  for (const double sign : {1., -1.}) {
    const double t = std::sin(sign * theta), z = std::cos(theta);
    const double e = p[1] * i1 + (1 - 3 * p[1]) * (t * t * C[0] + z * z * C[1] + 2 * t * z * C[3]) - 1;
    if (e > 0) w += p[2] / (2 * p[3]) * (std::exp(p[3] * e * e) - 1);
  }
  return w;
}

TEST(Gho, EnergyIsTheFormulaOfThePaper) {
  const auto model = make_model("gho");
  Sampler sampler(3);
  for (int draw = 0; draw < 50; ++draw) {
    const std::vector<double> p = sampler.parameters(model->describe());
    const Tensor C = sampler.right_cauchy_green();
    const double expected = gho_energy(C, p);
    EXPECT_NEAR(evaluate(*model, C, p).energy, expected, 1e-12 * std::max(1.0, std::abs(expected)));
  }
}

TEST(Gho, IsHgoWithoutDispersion) {
  const auto gho = make_model("gho"), hgo = make_model("hgo");
  Sampler sampler(4);
  for (int draw = 0; draw < 50; ++draw) {
    const std::vector<double> p = sampler.parameters(hgo->describe());
    const Tensor C = sampler.right_cauchy_green();
    const Evaluated one = evaluate(*gho, C, std::vector<double>{p[0], 0, p[1], p[2], p[3]}),
                    other = evaluate(*hgo, C, p);
    for (std::size_t c = 0; c < 6; ++c)
      EXPECT_NEAR(one.stress[c], other.stress[c], 1e-13 * (1 + std::abs(other.stress[c])));
  }
}

TEST(Holzapfel2015, IsGhoOnTheLineOfSymmetricDispersion) {
  const auto gho = make_model("gho"), general = make_model("holzapfel_2015");
  Sampler sampler(5);
  for (int draw = 0; draw < 50; ++draw) {
    const std::vector<double> p = sampler.parameters(gho->describe());
    const Tensor C = sampler.right_cauchy_green();
    const std::vector<double> q{p[0], p[1], 1 - 3 * p[1], p[2], p[3], p[4]};
    const Evaluated one = evaluate(*gho, C, p), other = evaluate(*general, C, q);
    for (std::size_t c = 0; c < 6; ++c)
      EXPECT_NEAR(one.stress[c], other.stress[c], 1e-11 * (1 + std::abs(one.stress[c])));
  }
}

TEST(Holzapfel2015, DeclaresWhatAlignedTestsSee) {
  const auto model = make_model("holzapfel_2015");
  ASSERT_EQ(model->describe().combinations.size(), 2u);
  const std::vector<double> p{20, 0.2, 0.4, 15, 0.04, 60};
  EXPECT_DOUBLE_EQ(model->describe().combinations[0].value(p), 0.8);
  EXPECT_NEAR(model->describe().combinations[1].value(p), -0.2, 1e-15);
}

TEST(Holzapfel2015, DeclaresCombinationsAsTheyArePrinted) {
  const auto model = make_model("holzapfel_2015");
  const ModelDescription& declared = model->describe();
  std::vector<double> p;
  for (const Parameter& parameter : declared.parameters)
    p.push_back(parameter.name == "A" ? 0.15 : parameter.name == "B" ? 0.3 : parameter.name == "theta" ? 25 : 7);
  const std::map<std::string, double> expected{{"2A + B", 0.6},
                                               {"B cos 2theta", 0.3 * std::cos(50 * std::acos(-1) / 180)},
                                               {"A + B", 0.45},
                                               {"1 - 2A - B", 0.4}};
  std::size_t seen = 0;
  for (const auto* list : {&declared.combinations, &declared.admissible})
    for (const Combination& combination : *list) {
      EXPECT_NEAR(combination.value(p), expected.at(combination.name), 1e-15) << combination.name;
      ++seen;
    }
  EXPECT_EQ(seen, expected.size());
}

TEST(FibreSwitch, CountsTheRightLimitAtRest) {
  // At rest E = 0 up to rounding; the tangent must hold the fibres' stiffness there (right limit).
  for (const double theta : {0., 17.3, 45., 61.3, 90.}) {
    const auto model = make_model("gho");
    const Evaluated at = evaluate(*model, {1, 1, 1, 0, 0, 0}, std::vector<double>{10, 0.1, 30, 1, theta});
    double trace = 0;
    for (std::size_t c = 0; c < 3; ++c) trace += at.tangent[7 * c];
    EXPECT_GT(trace, 4 * 2 * 30 * 0.3) << theta;
  }
}

TEST(FibreSwitch, SilencesCompressedFibres) {
  const std::vector<double> p{10, 30, 1, 0};  // hgo, fibres axial
  Options always;
  always.set("fibre_switch", std::string("none"));
  const Tensor shortened{1.2, 0.7, 1 / (1.2 * 0.7), 0, 0, 0};
  EXPECT_NEAR(evaluate(*make_model("hgo"), shortened, p).stress[1], 10, 1e-12);
  EXPECT_LT(evaluate(*make_model("hgo", always), shortened, p).stress[1], 10);
}

TEST(Models, OverflowIsANonFiniteNumberAtThatPointOnly) {
  const auto model = make_model("gho");
  const std::vector<double> p{10, 0.1, 30, 50, 45};
  const std::vector<double> c{1.1, 25, 1.0, 25, 0.9, 1. / 625};  // two points
  std::vector<double> gradient(6);
  ASSERT_TRUE(model->evaluate_axes({2, c, p}, {{}, gradient, {}, {}}).ok());
  EXPECT_TRUE(std::isfinite(gradient[0]) && std::isfinite(gradient[2]) && std::isfinite(gradient[4]));
  EXPECT_FALSE(std::isfinite(gradient[1]));
}

/// A part with an I2 term, which no built-in model of this round has: the kernels carry it for those that will.
class SecondInvariantPart final : public EnergyPart {
 public:
  [[nodiscard]] const Description& describe() const override { return description_; }
  void invariant(std::span<const double> p, Invariant& value, std::span<Invariant> derivatives) const override {
    value = {.i1 = 0.3, .i2 = p[0], .fibre = 0.2, .normal = 0.1, .offset = -1, .angle = 0.6};
    if (!derivatives.empty()) derivatives[0] = {.i2 = 1};
  }
  void respond(std::span<const double> p, const ResponseBatch& batch) const override {
    const std::array<double, 2> law{p[1], p[2]};
    laws::Exponential::respond(law, batch);
  }

 private:
  Description description_{"general", Role::matrix, Active::always, true, {0}, {1, 2}};
};

TEST(Hyperelastic, CarriesTheSecondInvariantThroughBothPaths) {
  ModelDescription description;
  description.type = "general";
  description.parameters = {{"a", "1", 0.2, 0.1, 0.4, Scale::linear, "", ""},
                            {"k1", "kPa", 1, 0.5, 2, Scale::linear, "", ""},
                            {"k2", "1", 0.1, 0.05, 0.2, Scale::linear, "", ""}};
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(std::make_unique<SecondInvariantPart>());
  const Hyperelastic model(description, std::move(parts));
  for (const ModelProperty& property : model_properties())
    if (property.function != deviatoric_stress_vanishes_at_rest) {
      EXPECT_EQ(property.check(model, 11).counter_example, "") << property.name;
    }
}

TEST(Conformance, CatchesAStressThatIsNotTheGradient) {
  class Wrong final : public Model {
   public:
    explicit Wrong(std::unique_ptr<Model> right) : right_(std::move(right)) {}
    [[nodiscard]] const ModelDescription& describe() const override { return right_->describe(); }
    Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
      Status status = right_->evaluate(points, response);
      if (!response.stress.empty()) response.stress[0] *= 1 + 1e-5;
      return status;
    }

   private:
    std::unique_ptr<Model> right_;
  };
  EXPECT_NE(stress_is_the_gradient_of_the_energy(Wrong(make_model("gho")), 1).counter_example, "");
}

}  // namespace
}  // namespace tunica::testing
