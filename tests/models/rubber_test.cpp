// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"
#include "support/loaded.hpp"
#include "tunica/models/autodiff.hpp"
#include "tunica/models/rubber_laws.hpp"

namespace tunica::testing::rubber_test {
using namespace conformance;
namespace {

struct Invariants {
  double i1, i2;
  explicit Invariants(const Tensor& C)
      : i1(C[0] + C[1] + C[2]), i2(C[0] * C[1] + C[1] * C[2] + C[2] * C[0] - C[3] * C[3] - C[4] * C[4] - C[5] * C[5]) {}
};

/// The energy against its formula at 50 seeded states.
template <class Formula>
void expect_energy(const char* type, const Formula& formula, double tolerance = 1e-12) {
  const auto model = make_model(type);
  Sampler sampler(7);
  for (int draw = 0; draw < 50; ++draw) {
    const auto [C, p] = sampler.point(*model);
    const double expected = formula(Invariants(C), p);
    EXPECT_NEAR(evaluate(*model, C, p).energy, expected, tolerance * std::max(1.0, std::abs(expected)));
  }
}

using Parameters = std::vector<double>;

TEST(MooneyRivlin, EnergyIsTheFormula) {
  expect_energy("mooney_rivlin",
                [](const Invariants& at, const Parameters& p) { return p[0] * (at.i1 - 3) + p[1] * (at.i2 - 3); });
}
/// Σ c_mn x^m y^n with the powers in the order of the parameters.
void expect_polynomial(std::int64_t terms, const std::vector<std::pair<int, int>>& powers) {
  Options options;
  options.set("terms", terms);
  const auto model = make_model("mooney_rivlin", options);
  ASSERT_EQ(model->describe().parameters.size(), powers.size());
  for (std::size_t k = 0; k < powers.size(); ++k)
    EXPECT_EQ(model->describe().parameters[k].name,
              "c" + std::to_string(powers[k].first) + std::to_string(powers[k].second));
  Sampler sampler(11);
  for (int draw = 0; draw < 50; ++draw) {
    const auto [C, p] = sampler.point(*model);
    const Invariants at(C);
    double expected = 0, size = 1;
    for (std::size_t k = 0; k < powers.size(); ++k) {
      const double term = p[k] * std::pow(at.i1 - 3, powers[k].first) * std::pow(at.i2 - 3, powers[k].second);
      expected += term;
      size += std::abs(term);
    }
    EXPECT_NEAR(evaluate(*model, C, p).energy, expected, 1e-12 * size);
  }
}
TEST(MooneyRivlin, WithMoreConstantsIsThePolynomialOfTheInvariants) {
  expect_polynomial(3, {{1, 0}, {0, 1}, {1, 1}});
  expect_polynomial(5, {{1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}});
  expect_polynomial(9, {{1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}});
}
TEST(MooneyRivlin, HasTwoThreeFiveOrNineConstants) {
  for (const std::int64_t terms : {4, 6, 7, 8}) {
    Options options;
    options.set("terms", terms);
    EXPECT_THROW(make_model("mooney_rivlin", options), InputError);
  }
}
TEST(Yeoh, EnergyIsTheFormula) {
  expect_energy("yeoh", [](const Invariants& at, const Parameters& p) {
    const double x = at.i1 - 3;
    return p[0] * x + p[1] * x * x + p[2] * x * x * x;
  });
}
TEST(Gent, EnergyIsTheFormula) {
  expect_energy("gent", [](const Invariants& at, const Parameters& p) {
    return -p[0] * p[1] / 2 * static_cast<double>(std::log(1 - (at.i1 - 3.0L) / p[1]));
  });
}

// The inverse by bisection, in long double: W = μ N [y β + ln(β/sinh β)] less that at rest, L(β) = y = √(I1/(3N)). The
// energy is a difference of numbers that are up to 1e4 times as large.
TEST(ArrudaBoyce, EnergyIsTheFormula) {
  const auto formula = [](const Invariants& at, const Parameters& p) {
    const long double links = p[1];
    const auto of = [links](long double i1) {
      const long double y = std::sqrt(i1 / (3 * links));
      long double low = 0, high = 2 / (1 - y);
      for (int step = 0; step < 120; ++step) {
        const long double middle = (low + high) / 2, b2 = middle * middle;
        // L(β), as a series where its difference would lose digits
        const long double langevin = middle < 0.05L
                                         ? middle * (1 / 3.0L - b2 * (1 / 45.0L - b2 * (2 / 945.0L - b2 / 4725.0L)))
                                         : 1 / std::tanh(middle) - 1 / middle;
        (langevin < y ? low : high) = middle;
      }
      return y * low - std::log(std::sinh(low) / low);
    };
    return static_cast<double>(p[0] * links * (of(at.i1) - of(3)));
  };
  expect_energy("arruda_boyce", formula, 1e-10);
}

// Five terms of the series that Arruda and Boyce give, eq. (15), for long chains.
TEST(ArrudaBoyce, TendsToItsSeries) {
  const Tensor C{1.6, 1.3, 0.9, 0.2, -0.1, 0.1};
  const double mu = 270, N = 60, i1 = C[0] + C[1] + C[2];
  double expected = 0;
  const double coefficient[] = {1. / 2, 1. / 20, 11. / 1050, 19. / 7000, 519. / 673750};
  for (int k = 1; k <= 5; ++k)
    expected += mu * coefficient[k - 1] * (std::pow(i1, k) - std::pow(3, k)) / std::pow(N, k - 1);
  const double found = evaluate(*make_model("arruda_boyce"), C, Parameters{mu, N}).energy;
  EXPECT_NEAR(found, expected, 1e-6 * expected);
  EXPECT_GT(std::abs(found - mu / 2 * (i1 - 3)), 1e-3 * expected);  // more than its first term
}

TEST(Rubber, ShearModulusIsThatOfTheFormulas) {
  // Simple shear, C = 1 + γ (e_t⊗e_z + e_z⊗e_t) + γ² e_z⊗e_z: W = ½ G γ² + O(γ⁴).
  const auto modulus = [](const char* type, const Parameters& p, Options options = {}) {
    constexpr double gamma = 1e-4;
    return 2 * evaluate(*make_model(type, std::move(options)), {1, 1 + gamma * gamma, 1, gamma, 0, 0}, p).energy /
           (gamma * gamma);
  };
  EXPECT_NEAR(modulus("mooney_rivlin", {150, 20}), 2 * 170, 1e-3);
  EXPECT_NEAR(modulus("yeoh", {150, -2, 0.1}), 2 * 150, 1e-3);
  EXPECT_NEAR(modulus("gent", {270, 80}), 270, 1e-3);
  EXPECT_NEAR(modulus("ogden", {630, 1.3, 1.2, 5, -10, -2}), 0.5 * (630 * 1.3 + 1.2 * 5 + 10 * 2), 1e-2);
}

TEST(Rubber, PartsAreMatrix) {
  for (const char* type : {"mooney_rivlin", "yeoh", "gent", "arruda_boyce"}) {
    const auto model = make_model(type);
    ASSERT_FALSE(model->parts().empty()) << type;
    for (const auto& part : model->parts()) EXPECT_EQ(part->describe().role, EnergyPart::Role::matrix) << type;
  }
}

TEST(Gent, TendsToNeoHookeAsTheLimitMovesAway) {
  const Tensor C{1.4, 0.9, 1.1, 0.1, -0.2, 0.05};
  const Tensor limited = evaluate(*make_model("gent"), C, Parameters{30, 1e12}).stress,
               free = evaluate(*make_model("neo_hooke"), C, Parameters{30}).stress;
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(limited[c], free[c], 1e-9);
}

TEST(Gent, IsNotFiniteFromItsLimitOnAndFiniteBeforeIt) {
  const auto model = make_model("gent");
  const Parameters p{30, 2};
  // I1 − 3 = 1.99, 2, 2.01, 20, through both paths.
  const std::vector<double> excess{1.99, 2, 2.01, 20};
  std::vector<double> c(12), C(24), energy(4), gradient(12), hessian(24), gradient_dp(24), stress(24);
  for (std::size_t i = 0; i < 4; ++i) {
    c[i] = C[i] = 1 + excess[i];
    for (const std::size_t a : {1u, 2u}) c[a * 4 + i] = C[a * 4 + i] = 1;
  }
  ASSERT_TRUE(model->evaluate_axes({4, c, p}, {energy, gradient, hessian, gradient_dp}).ok());
  ASSERT_TRUE(model->evaluate({4, C, p, {}, {}}, {{}, stress, {}, {}, {}}).ok());
  for (std::size_t i = 0; i < 4; ++i) {
    const bool inside = excess[i] < 2;
    EXPECT_EQ(std::isfinite(energy[i]), inside) << i;
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_EQ(std::isfinite(gradient[a * 4 + i]), inside) << i;
      EXPECT_EQ(std::isfinite(hessian[a * 4 + i]), inside) << i;
      EXPECT_EQ(std::isfinite(stress[a * 4 + i]), inside) << i;
      for (std::size_t j = 0; j < 2; ++j) EXPECT_EQ(std::isfinite(gradient_dp[(3 * j + a) * 4 + i]), inside) << i;
    }
  }
}

/// Largest difference between a law by hand and by automatic differentiation, relative to each row's largest entry.
template <class Law>
double worst_against_autodiff(const Parameters& p, const std::vector<double>& x) {
  const std::size_t n = x.size();
  std::array<std::vector<double>, 5> hand, automatic;
  for (auto* rows : {&hand, &automatic})
    for (std::size_t k = 0; k < 5; ++k) (*rows)[k].resize(k < 3 ? n : p.size() * n);
  Law::respond(p, {x, hand[0], hand[1], hand[2], hand[3], hand[4]});
  respond_by_autodiff<Law>(p, {x, automatic[0], automatic[1], automatic[2], automatic[3], automatic[4]});
  double worst = 0;
  for (std::size_t k = 0; k < 5; ++k)
    for (std::size_t row = 0; row < hand[k].size(); row += n) {
      double scale = 0, difference = 0;
      for (std::size_t i = row; i < row + n; ++i) {
        scale = std::max(scale, std::abs(automatic[k][i]));
        difference = std::max(difference, std::abs(hand[k][i] - automatic[k][i]));
      }
      worst = std::max(worst, difference / scale);
    }
  return worst;
}

TEST(RubberLaws, HandWrittenDerivativesAgreeWithAutodiff) {
  std::mt19937_64 engine(8);  // deterministic: seed fixed
  std::uniform_real_distribution<double> strain(-0.5, 2), limit(2.2, 50), modulus(-100, 100), power(0.5, 12),
      stretch(0.3, 4);
  for (int draw = 0; draw < 50; ++draw) {
    std::vector<double> x(83), lambda(83);  // more than one chunk
    for (double& value : x) value = strain(engine);
    for (double& value : lambda) value = stretch(engine);
    EXPECT_LT(worst_against_autodiff<laws::Gent>({30, limit(engine)}, x), 1e-12);
    EXPECT_LT(worst_against_autodiff<laws::Ogden<2>>({modulus(engine), power(engine), modulus(engine), -power(engine)},
                                                     lambda),
              1e-11);
  }
}

}  // namespace
}  // namespace tunica::testing::rubber_test
