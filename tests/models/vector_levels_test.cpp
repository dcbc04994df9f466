// SPDX-License-Identifier: Apache-2.0
// Every vector level against the baseline: laws, sums of parts, free strips. The plugins themselves run on every level
// in the tests Levels.*, since a library chooses its level once.
#include <bit>
#include <cmath>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "tunica/detail/free_strip.hpp"
#include "tunica/models/arterial_fibres.hpp"
#include "tunica/models/rubber_laws.hpp"

namespace tunica::testing {
namespace {

using detail::VectorLevel;
constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/// The levels that this machine offers.
std::vector<VectorLevel> levels() {
  std::vector<VectorLevel> all;
  for (const auto level : {VectorLevel::baseline, VectorLevel::avx2, VectorLevel::avx512})
    if (level <= detail::best_vector_level()) all.push_back(level);
  return all;
}

/// Chooses a level, and the one before again at the end.
class OnLevel {
 public:
  explicit OnLevel(VectorLevel level) : before_(detail::vector_level()) { detail::use_vector_level(level); }
  ~OnLevel() { detail::use_vector_level(before_); }

 private:
  VectorLevel before_;
};

/// The largest difference relative to the largest number of the row, of at least 1e-3; infinite where
/// one is finite and the other not.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double scale = 1e-3, worst = 0;
  for (const double value : b)
    if (std::isfinite(value)) scale = std::max(scale, std::abs(value));
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isfinite(a[i]) && std::isfinite(b[i]))
      worst = std::max(worst, std::abs(a[i] - b[i]));
    else if (std::isnan(a[i]) != std::isnan(b[i]) || (!std::isnan(a[i]) && a[i] != b[i]))
      return infinity;
  }
  return worst / scale;
}
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) {
           return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
         });
}

/// exp of a polynomial and a power, with automatic derivatives only.
struct Formula {
  static constexpr std::size_t parameter_count = 3;
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    using namespace tunica::functions;
    return p[0] * (exp(p[1] * x * x + 0.1 * x) - 1.0) + pow(1.0 + x * x, p[2]) + log(2.0 + x * x);
  }
};

using Rows = std::vector<std::vector<double>>;

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

enum { mu, k1, k2, theta, kappa, count };
struct Dispersed {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    return {.i1 = p[kappa], .fibre = 1.0 - 3.0 * p[kappa], .offset = T(-1), .angle = p[theta] * degree};
  }
};
const std::vector<double> parameters{22, 15, 0.4, 57, 0.2};

ModelDescription five_parameters() {
  ModelDescription description;
  description.type = "levels";
  description.parameters = {arterial::mu(),
                            arterial::k1(),
                            arterial::k2(),
                            arterial::theta(),
                            {"kappa", "1", 0.1, 0, 1. / 3, Scale::linear, "", ""}};
  return description;
}
std::unique_ptr<EnergyPart> fibres(EnergyPart::Active active) {
  return std::make_unique<LawPart<laws::Exponential, Dispersed, count>>(
      EnergyPart::Description{"fibres", EnergyPart::Role::fibre, active, true, {kappa, theta}, {k1, k2}, false});
}

/// A matrix and fibres; the same with a part of I2 and a second family; a matrix alone.
std::vector<std::unique_ptr<Hyperelastic>> models() {
  using Active = EnergyPart::Active;
  std::vector<std::unique_ptr<Hyperelastic>> all;
  for (const auto active : {Active::argument_positive, Active::fibre_stretched, Active::always})
    all.push_back(std::make_unique<Hyperelastic>(five_parameters(),
                                                 energy_parts(isotropic::neo_hookean<count>(mu), fibres(active))));
  all.push_back(std::make_unique<Hyperelastic>(
      five_parameters(),
      energy_parts(isotropic::neo_hookean<count>(mu), fibres(Active::argument_positive),
                   isotropic::part<laws::Exponential, isotropic::SecondInvariant, count>("second", {k1, k2}))));
  all.push_back(std::make_unique<Hyperelastic>(five_parameters(), energy_parts(isotropic::neo_hookean<count>(mu))));
  return all;
}

Rows along_axes(const Model& model, std::size_t n) {
  std::vector<double> c(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    c[i] = 1 + 0.02 * static_cast<double>(i);
    c[n + i] = 1.1 - 0.003 * static_cast<double>(i);
    c[2 * n + i] = 1 / (c[i] * c[n + i]);
  }
  Rows rows{std::vector<double>(n), std::vector<double>(3 * n), std::vector<double>(6 * n),
            std::vector<double>(3 * count * n), std::vector<double>(count * n)};
  EXPECT_TRUE(model.evaluate_axes({n, c, parameters}, {rows[0], rows[1], rows[2], rows[3], rows[4]}).ok());
  return rows;
}
Rows on_tensors(const Model& model, std::size_t n) {
  std::vector<double> C(6 * n);
  for (std::size_t k = 0; k < 6; ++k)
    for (std::size_t i = 0; i < n; ++i)
      C[k * n + i] = k < 3 ? 1 + 0.01 * static_cast<double>((k + 1) * i % 17) : 0.02 * static_cast<double>(i % 5);
  Rows rows{std::vector<double>(n), std::vector<double>(6 * n), std::vector<double>(36 * n),
            std::vector<double>(6 * count * n)};
  EXPECT_TRUE(model.evaluate({n, C, parameters, {}, {}}, {rows[0], rows[1], rows[2], rows[3], {}}).ok());
  return rows;
}

/// σ, y, their derivatives by parameters and along the path.
Rows along_strip(const Model& model, std::size_t n, std::size_t loaded, double reach = 0.6) {
  std::vector<double> stretch(n);
  for (std::size_t i = 0; i < n; ++i) stretch[i] = 0.9 + reach * static_cast<double>(i) / static_cast<double>(n);
  Rows rows(6, std::vector<double>(n));
  rows[2].resize(count * n);
  rows[3].resize(count * n);
  StripPath path{.loaded = loaded, .parameters = parameters, .stretch = stretch, .stress = rows[0]};
  path.lateral = rows[1];
  path.stress_dp = rows[2];
  path.lateral_dp = rows[3];
  path.stress_by_l = rows[4];
  path.lateral_by_l = rows[5];
  const free_strip::Start start(stretch);
  start.set(path);
  Status status;
  EXPECT_TRUE(model.solve_strip(path, status));
  EXPECT_TRUE(status.ok()) << status.reason();
  return rows;
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
    // With dispersion, a switch by the fibres' own stretch makes W discontinuous: a row may have two equilibria.
    if (model->parts().back()->describe().active == EnergyPart::Active::fibre_stretched) continue;
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
