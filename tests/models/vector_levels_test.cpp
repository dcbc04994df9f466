// SPDX-License-Identifier: Apache-2.0
// Every vector level against the baseline: laws, sums of parts, free strips. The plugins themselves run on every level
// in the tests Levels.*, since a library chooses its level once.
#include <cmath>
#include <thread>

#include "on_levels.hpp"
#include "tunica/detail/free_strip.hpp"
#include "tunica/models/convex_laws.hpp"
#include "tunica/models/rubber_laws.hpp"

namespace tunica::testing {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// exp of a polynomial and a power, with automatic derivatives only.
struct Formula {
  static constexpr std::size_t parameter_count = 3;
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    using namespace tunica::functions;
    return p[0] * (exp(p[1] * x * x + 0.1 * x) - 1.0) + pow(1.0 + x * x, p[2]) + log(2.0 + x * x);
  }
};

template <class Law>
Rows answer(const std::vector<double>& p, const std::vector<double>& x) {
  const std::size_t n = x.size();
  Rows rows(3, std::vector<double>(n));
  rows.resize(5, std::vector<double>(p.size() * n));
  respond<Law>(p, {x, rows[0], rows[1], rows[2], rows[3], rows[4]});
  return rows;
}

template <class Law>
void expect_levels_agree(const std::vector<double>& p, double first, double step) {
  for (const std::size_t n : {0, 1, 3, 7, 64, 65}) {
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = first + step * static_cast<double>(i);
    const OnLevel baseline(VectorLevel::baseline);
    const Rows reference = answer<Law>(p, x);
    for (const auto level : levels()) {
      const OnLevel here(level);
      const Rows rows = answer<Law>(p, x), again = answer<Law>(p, x);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        EXPECT_LT(difference(rows[k], reference[k]), 1e-13) << name(level) << ", n = " << n << ", row " << k;
        EXPECT_TRUE(same_bits(rows[k], again[k])) << name(level);
      }
      // A value does not depend on its place.
      for (std::size_t i = 0; i < n; ++i) {
        const Rows alone = answer<Law>(p, {x[i]});
        for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(alone[k][0], rows[k][i]) << name(level) << ", point " << i;
      }
    }
  }
}

TEST(VectorLevels, LawsAgreeOnAllLevelsAndPlaces) {
  expect_levels_agree<laws::Linear>({20}, -0.5, 0.04);
  expect_levels_agree<laws::Exponential>({20, 0.7}, -0.5, 0.04);
  expect_levels_agree<laws::Cubic>({20, -1, 0.3}, -0.5, 0.1);
  expect_levels_agree<laws::Gent>({20, 50}, 0.1, 0.4);
  expect_levels_agree<laws::EightChain>({20, 9}, 0, 0.3);  // to the full length of the chains, and nearly beyond
  expect_levels_agree<laws::Ogden<2>>({20, 1.5, -3, -2}, 0.4, 0.05);
  expect_levels_agree<Formula>({3, 0.4, 1.7}, -0.5, 0.04);
}

TEST(VectorLevels, OverflowIsInfiniteAndNaNStays) {
  for (const auto level : levels()) {
    const OnLevel here(level);
    const Rows rows = answer<laws::Exponential>({20, 1}, {0.0, 100.0, nan, 0.5, -100.0});
    EXPECT_EQ(rows[1][0], 0);
    EXPECT_EQ(rows[1][1], infinity) << name(level);
    EXPECT_TRUE(std::isnan(rows[1][2])) << name(level);
    EXPECT_NEAR(rows[1][3], 20 * 0.5 * std::exp(0.25), 1e-12);
    EXPECT_EQ(rows[1][4], -infinity) << name(level);
  }
}

template <class Answer>
void expect_models_agree(const Answer& answers, double tolerance) {
  for (const auto& model : models()) {
    for (const std::size_t n : {1, 3, 7, 64, 65}) {
      const OnLevel baseline(VectorLevel::baseline);
      const Rows reference = answers(*model, n);
      for (const auto level : levels()) {
        const OnLevel here(level);
        const Rows rows = answers(*model, n);
        Rows beside;
        std::thread([&] { beside = answers(*model, n); }).join();
        ASSERT_EQ(rows.size(), reference.size());
        ASSERT_EQ(rows.size(), beside.size());
        for (std::size_t k = 0; k < rows.size(); ++k) {
          EXPECT_LT(difference(rows[k], reference[k]), tolerance) << name(level) << ", n = " << n << ", row " << k;
          EXPECT_TRUE(same_bits(rows[k], beside[k])) << name(level);
        }
      }
    }
  }
}

TEST(VectorLevels, SumsOfPartsAgreeInPrincipalAxes) { expect_models_agree(along_axes, 1e-13); }
TEST(VectorLevels, SumsOfPartsAgreeOnTensors) { expect_models_agree(on_tensors, 1e-13); }

// The last step of Newton's method is applied to first order, which leaves its square, 1e-12.
TEST(VectorLevels, FreeStripsAgree) {
  for (const std::size_t loaded : {0, 1})
    expect_models_agree([loaded](const Model& model, std::size_t n) { return along_strip(model, n, loaded); }, 2e-12);
}

TEST(VectorLevels, ModelsWithoutPointsWriteNothing) {
  for (const auto level : levels()) {
    const OnLevel here(level);
    EXPECT_TRUE(models()[0]->evaluate_axes({0, {}, parameters}, {}).ok());
    EXPECT_TRUE(models()[0]->evaluate({0, {}, parameters, {}, {}}, {}).ok());
  }
}

/// The free strip as tests solve it with evaluate_axes(), row by row from rest.
TEST(FreeStrips, ModelsFindWhatTestsFind) {
  for (const auto& model : models()) {
    if (jumps(*model)) continue;
    for (const std::size_t loaded : {0, 1}) {
      const std::size_t n = 40;
      const Rows rows = along_strip(*model, n, loaded);
      free_strip::Scratch scratch;
      const free_strip::Pull pull{*model, parameters, loaded};
      std::vector<double> stress(n), lateral(n), stress_by_l(n), lateral_by_l(n), stress_dp(count * n), y_dp(count * n);
      for (std::size_t i = 0; i < n; ++i) {
        const double stretch = 0.9 + 0.6 * static_cast<double>(i) / n;
        double u = 1;
        ASSERT_TRUE(free_strip::solve_from_rest(pull, stretch, scratch, u));
        free_strip::Batch batch(pull, {&stretch, 1}, scratch);
        ASSERT_TRUE(batch.evaluate(&u, true).ok());
        stress[i] = scratch.stress[0];
        lateral[i] = std::log(u);
        batch.by_stretch(0, stress_by_l[i], lateral_by_l[i]);
        for (std::size_t j = 0; j < count; ++j) batch.by_parameter(0, j, stress_dp[j * n + i], y_dp[j * n + i]);
      }
      EXPECT_LT(difference(rows[0], stress), 1e-11);
      EXPECT_LT(difference(rows[1], lateral), 1e-11);
      EXPECT_LT(difference(rows[2], stress_dp), 1e-11);
      EXPECT_LT(difference(rows[3], y_dp), 1e-11);
      EXPECT_LT(difference(rows[4], stress_by_l), 1e-11);
      EXPECT_LT(difference(rows[5], lateral_by_l), 1e-11);
      EXPECT_LT(difference(rows[6], stress_dp), 1e-11);
    }
  }
}

TEST(FreeStrips, ALostRowIsNamed) {
  const auto all = models();
  const auto& model = all.front();
  const std::vector<double> stretch{1.1, 40, 1.2};
  std::vector<double> stress(3), wild = parameters;
  wild[k2] = 100;
  std::size_t lost = StripPath::none;
  StripPath path{.loaded = 0, .parameters = wild, .stretch = stretch, .stress = stress};
  path.lost = &lost;
  Status status;
  ASSERT_TRUE(model->solve_strip(path, status));
  EXPECT_FALSE(status.ok());
  EXPECT_EQ(lost, 1u);
}

TEST(VectorLevels, AreCalledByTheirNames) {
  for (const auto level : {VectorLevel::baseline, VectorLevel::avx2, VectorLevel::avx512})
    EXPECT_EQ(detail::vector_level_called(name(level)), level);
  EXPECT_FALSE(detail::vector_level_called("AVX2"));
}

}  // namespace
}  // namespace tunica::testing
