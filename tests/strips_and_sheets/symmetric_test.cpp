// SPDX-License-Identifier: Apache-2.0
// Strips of isotropic materials: λ2 = λ3 = λ1^(−½), and the Cauchy stress 2 (λ² − 1/λ)(W1 + W2/λ), whatever the
// parameters, whether or not the state is stable.
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "support/strip.hpp"
#include "tunica/detail/solve_strip.hpp"
#include "tunica/models/model_sum.hpp"

namespace tunica::testing {
namespace {

const std::vector<double>& far_stretches() {
  static const std::vector<double> values = evenly(0.5, 18, 60);
  return values;
}

/// Three terms of size a·10^(−k), of any sign: most sets are unstable somewhere below a stretch of 18.
std::vector<double> any_sign(std::mt19937_64& engine, std::size_t count) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<double> p(count);
  for (std::size_t k = 0; k < count; ++k) p[k] = 100 * unit(engine) * std::pow(0.03, static_cast<double>(k));
  return p;
}

/// `slopes` are W1 and W2; misaligned by nothing or by an angle that an isotropic material does not feel.
void expect_everywhere(const Model& model, const std::vector<double>& p,
                       const std::function<std::pair<double, double>(double)>& slopes) {
  const auto strip = make_strip(far_stretches(), {.channels = {"stress", "transverse_stretch"}});
  for (const double misalignment : {0., 7.}) {
    const Prediction out = predict(*strip, model, p, misalignment, false);
    ASSERT_TRUE(out.status.ok()) << out.status.reason() << " at misalignment " << misalignment;
    for (std::size_t i = 0; i < far_stretches().size(); ++i) {
      const double l = far_stretches()[i];
      const auto [w1, w2] = slopes(l * l + 2 / l);
      const double scale = 2 * (l * l + 1 / l) * (std::abs(w1) + std::abs(w2) / l);
      // In the turned frame the components of C are rounded.
      ASSERT_NEAR(out.values[i], 2 * (l * l - 1 / l) * (w1 + w2 / l), (misalignment == 0 ? 1e-12 : 1e-10) * scale) << l;
      ASSERT_NEAR(out.values[far_stretches().size() + i], 1 / std::sqrt(l), 1e-14 / std::sqrt(l));
    }
  }
}

TEST(SymmetricStrip, NoSetOfYeohFailsOnStretchesTo18) {
  const auto model = make_model("yeoh");
  std::mt19937_64 engine(44);  // 200 sets, deterministic
  for (int draw = 0; draw < 200; ++draw) {
    const std::vector<double> p = any_sign(engine, 3);
    expect_everywhere(*model, p, [&p](double i1) {
      const double x = i1 - 3;
      return std::pair(p[0] + 2 * p[1] * x + 3 * p[2] * x * x, 0.);
    });
  }
}

TEST(SymmetricStrip, NoSetOfMooneyRivlinFailsOnStretchesTo18) {
  const auto model = make_model("mooney_rivlin");
  std::mt19937_64 engine(45);
  for (int draw = 0; draw < 200; ++draw) {
    const std::vector<double> p = any_sign(engine, 2);
    expect_everywhere(*model, p, [&p](double) { return std::pair(p[0], p[1]); });
  }
}

// The limit Jm lies beyond I1 − 3 = 321.1, which is that at the stretch 18.
TEST(SymmetricStrip, NoSetOfGentFailsInsideItsLimit) {
  const auto model = make_model("gent");
  std::mt19937_64 engine(49);
  std::uniform_real_distribution<double> modulus(1, 500), limit(322, 2000);
  for (int draw = 0; draw < 200; ++draw) {
    const std::vector<double> p{modulus(engine), limit(engine)};
    expect_everywhere(*model, p, [&p](double i1) { return std::pair(0.5 * p[0] * p[1] / (p[1] - (i1 - 3)), 0.); });
  }
}

TEST(SymmetricStrip, NoSetOfOgdenFailsOnStretchesTo18) {
  const auto model = make_model("ogden");
  std::mt19937_64 engine(46);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto strip = make_strip(far_stretches());
  for (int draw = 0; draw < 200; ++draw) {
    std::vector<double> p;
    for (int k = 0; k < 3; ++k) {
      p.push_back(500 * unit(engine));
      p.push_back(8 * unit(engine));
    }
    const Prediction out = predict(*strip, *model, p);
    ASSERT_TRUE(out.status.ok()) << out.status.reason();
    for (std::size_t i = 0; i < far_stretches().size(); ++i) {
      const double l = far_stretches()[i];
      double expected = 0, scale = 0;
      for (const std::size_t k : {0u, 2u, 4u}) {
        expected += p[k] * (std::pow(l, p[k + 1]) - std::pow(l, -p[k + 1] / 2));
        scale += std::abs(p[k]) * (std::pow(l, p[k + 1]) + std::pow(l, -p[k + 1] / 2));
      }
      ASSERT_NEAR(out.values[i], expected, 1e-12 * scale) << l;
    }
  }
}

TEST(SymmetricStrip, DerivativesAreThoseOfTheClosedForm) {
  // A linear model: the columns do not depend on the parameters, and these are unstable.
  const auto model = make_model("yeoh");
  const std::vector<double> p{106, -4.65, 0.0332};
  const std::size_t n = far_stretches().size();
  const Prediction out = predict(*make_strip(far_stretches()), *model, p, 0, true);
  ASSERT_TRUE(out.status.ok()) << out.status.reason();
  for (std::size_t i = 0; i < n; ++i) {
    const double l = far_stretches()[i], x = l * l + 2 / l - 3, factor = 2 * (l * l - 1 / l);
    const double slopes[] = {1, 2 * x, 3 * x * x};
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_NEAR(out.jacobian[j * n + i], factor * slopes[j], 1e-11 * (1 + std::abs(factor * slopes[j])));
    const double w1 = p[0] + 2 * p[1] * x + 3 * p[2] * x * x, by_x = 2 * p[1] + 6 * p[2] * x;
    const double factor_l = 2 * (2 * l + 1 / (l * l)), x_l = 2 * l - 2 / (l * l);
    EXPECT_NEAR(out.abscissa_derivative[i], factor_l * w1 + factor * by_x * x_l,
                1e-11 * (std::abs(factor_l * w1) + std::abs(factor * by_x * x_l)));
  }
}

// A sum has no parts. Its base, at the null of what is added, is unstable here, and Newton's method fails on it.
TEST(SymmetricStrip, IsThatOfTheBaseWhereNothingIsAdded) {
  const std::shared_ptr<const Model> base = make_model("yeoh");
  auto added = make_model("neo_hooke");
  const std::vector<Parameter> own = added->describe().parameters;
  const ModelSum sum(base, own, 0, std::move(added));
  const auto strip = make_strip(far_stretches());
  const Prediction bare = predict(*strip, *base, {106, -4.65, 0.0332});
  ASSERT_TRUE(bare.status.ok()) << bare.status.reason();
  for (const bool jacobian : {false, true}) {
    const Prediction with = predict(*strip, sum, {106, -4.65, 0.0332, 0}, 0, jacobian);
    ASSERT_TRUE(with.status.ok()) << with.status.reason();
    for (std::size_t i = 0; i < bare.values.size(); ++i)
      EXPECT_NEAR(with.values[i], bare.values[i], 1e-12 * std::abs(bare.values[i])) << jacobian;
  }
}

TEST(SymmetricStrip, AgreesWithIterationWhereThatSucceeds) {
  std::mt19937_64 engine(47);
  std::uniform_real_distribution<double> unit(0.1, 1);
  const std::vector<double> stretch = evenly(0.7, 2.5, 40);
  int compared = 0;
  for (int draw = 0; draw < 60; ++draw) {
    const std::vector<std::pair<const char*, std::vector<double>>> all{
        {"neo_hooke", {100 * unit(engine)}},
        {"mooney_rivlin", {100 * unit(engine), 30 * unit(engine)}},
        {"yeoh", {100 * unit(engine), 2 * unit(engine), 0.1 * unit(engine)}},
        {"gent", {100 * unit(engine), 30 + 50 * unit(engine)}},
        {"ogden", {100 * unit(engine), 1 + unit(engine), 10 * unit(engine), 4 * unit(engine), -10 * unit(engine), -2}}};
    for (const auto& [type, p] : all) {
      const auto model = make_model(type);
      const std::size_t n = stretch.size();
      std::vector<double> stress(n), by_l(n), y(n), y_l(n), by_p(n * p.size()), y_p(n * p.size());
      std::vector<double> stress2(n), by_l2(n), y2(n), y_l2(n), by_p2(n * p.size()), y_p2(n * p.size());
      free_strip::Scratch scratch;
      const StripPath iterated{.parameters = p,
                               .stretch = stretch,
                               .stress = stress,
                               .lateral = y,
                               .stress_dp = by_p,
                               .lateral_dp = y_p,
                               .stress_by_l = by_l,
                               .lateral_by_l = y_l};
      const StripPath answered{.parameters = p,
                               .stretch = stretch,
                               .stress = stress2,
                               .lateral = y2,
                               .stress_dp = by_p2,
                               .lateral_dp = y_p2,
                               .stress_by_l = by_l2,
                               .lateral_by_l = y_l2};
      Status old;
      if (!model->solve_strip(iterated, old)) old = free_strip::solve_by_batches(*model, iterated, scratch);
      if (!old.ok()) continue;
      ++compared;
      Status status;
      ASSERT_TRUE(free_strip::solve_symmetric({*model, p, 0}, answered, scratch, status)) << type;
      ASSERT_TRUE(status.ok()) << status.reason();
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_NEAR(stress2[i], stress[i], 1e-12 * (p[0] + std::abs(stress[i]))) << type;
        EXPECT_NEAR(y2[i], y[i], 1e-12) << type;
        EXPECT_NEAR(by_l2[i], by_l[i], 1e-11 * (p[0] + std::abs(by_l[i]))) << type;
        EXPECT_NEAR(y_l2[i], y_l[i], 1e-11) << type;
      }
      for (std::size_t k = 0; k < by_p.size(); ++k)
        EXPECT_NEAR(by_p2[k], by_p[k], 1e-11 * (1 + std::abs(by_p[k]))) << type << " " << k;
    }
  }
  EXPECT_EQ(compared, 300);
}

TEST(SymmetricStrip, AMaterialWithFibresIsNotTakenForSymmetric) {
  const std::vector<double> stretch = evenly(0.8, 1.6, 9);
  const std::vector<std::pair<const char*, std::vector<double>>> all{
      {"gho", {18.668, 0.1367, 24.905, 0.2912, 46.44}}, {"hgo", {10, 20, 0.5, 40}}, {"fung", {}}};
  for (const auto& [type, given] : all) {
    const auto model = make_model(type);
    std::vector<double> p = given;
    for (std::size_t k = p.size(); k < model->describe().parameters.size(); ++k)
      p.push_back(model->describe().parameters[k].initial);
    for (const std::size_t axis : {0u, 1u}) EXPECT_FALSE(free_strip::is_symmetric({*model, p, axis}, stretch)) << type;
  }
}

TEST(SymmetricStrip, AMaterialWithMemoryStaysSymmetricOnItsPath) {
  const auto model = plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), make_model("yeoh"), {});
  const std::vector<double> stretch = evenly(1.2, 12, 20);
  StripSetup setup;
  setup.channels = {"stress", "transverse_stretch"};
  setup.time = evenly(1, 20, 20);
  const auto strip = make_strip(stretch, setup);
  // Unstable from a stretch of 5 on.
  const Prediction out = predict(*strip, *model, {106, -4.65, 0.0332, 0.3, 5});
  ASSERT_TRUE(out.status.ok()) << out.status.reason();
  for (std::size_t i = 0; i < stretch.size(); ++i)
    EXPECT_NEAR(out.values[20 + i], 1 / std::sqrt(stretch[i]), 1e-10) << stretch[i];
}

TEST(SymmetricStrip, OnlyAStressBeyondTheLargestNumberFails) {
  const auto model = make_model("yeoh");
  const Prediction out = predict(*make_strip({1, 2, 18}), *model, {1, 1, 1e305});
  EXPECT_FALSE(out.status.ok());
  EXPECT_NE(out.status.reason().find("row 3 (stretch 18"), std::string::npos) << out.status.reason();
}

}  // namespace
}  // namespace tunica::testing
