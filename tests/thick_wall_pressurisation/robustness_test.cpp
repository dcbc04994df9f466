// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <random>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include "support/strip.hpp"
#include "support/tube.hpp"

namespace tunica::testing {
namespace {

TEST(TubeRobustness, TheLimitPressureOfANeoHookeanTubeIsNoticed) {
  // p → (μ/λz) ln(Ro/Ri) as the tube widens, from below.
  constexpr double mu = 60, lz = 1.2;
  const double limit = mu / lz * std::log(5.77 / 3.71);
  const auto model = make_model("neo_hooke");
  EXPECT_TRUE(inflate(*make_tube({0.5 * limit, 0.98 * limit}), *model, {mu}).status.ok());
  const Inflation out = inflate(*make_tube({0.5 * limit, 1.01 * limit}), *model, {mu});
  EXPECT_EQ(out.status.kind(), Status::Kind::failed);
  const std::string& reason = out.status.reason();
  EXPECT_NE(reason.find("no equilibrium at row 2 (pressure 22.3"), std::string::npos) << reason;
  const auto at = reason.find("(limit pressure): ");
  ASSERT_NE(at, std::string::npos) << reason;
  EXPECT_NEAR(std::stod(reason.substr(at + 18)), limit, 1e-3 * limit) << reason;
}

TEST(TubeRobustness, ATubeThatSnapsToAWiderStateFailsAtTheLimitPressure) {
  // Ogden's soft term makes p fall after a maximum and the stiff one lets it rise again: the wider states exist, but
  // loading does not lead there. The maximum comes from the test itself, along prescribed diameters.
  Options two;
  two.set("terms", std::int64_t{2});
  const auto model = make_model("ogden", two);
  const std::vector<double> p{120, 1.2, 1e-3, 9};
  double maximum = 0;
  double fell = 0;
  const auto pressure_at = [&](double ri) {
    constexpr int n = 2001;
    const double lz = 1.1, a = ri * ri - 9 / lz;
    std::vector<double> c(3 * n), g(3 * n);
    for (int k = 0; k < n; ++k) {
      c[k] = 1 / lz + a * std::exp(-2 * (std::log(3.) + std::log(4. / 3) * k / (n - 1)));
      c[n + k] = lz * lz;
      c[2 * n + k] = 1 / (c[k] * c[n + k]);
    }
    EXPECT_TRUE(model->evaluate_axes({n, c, p}, {{}, g, {}, {}}).ok());
    double sum = 0;
    for (int k = 0; k < n; ++k)
      sum += (k == 0 || k == n - 1 ? 1 : k % 2 == 1 ? 4 : 2) * 2 * (g[k] - c[2 * n + k] * g[2 * n + k] / c[k]);
    return sum * std::log(4. / 3) / (n - 1) / 3 / lz;
  };
  for (double ri = 2.9; ri < 30; ri *= 1.01) {
    const double pressure = pressure_at(ri);
    maximum = fell == 0 ? std::max(maximum, pressure) : maximum;
    if (pressure < 0.9 * maximum) fell = ri;
  }
  ASSERT_GT(fell, 0) << "the curve has no maximum";
  ASSERT_GT(pressure_at(60), 1.5 * maximum);
  const TubeSetup setup{.axial_stretch = 1.1, .inner_radius = 3, .thickness = 1};
  EXPECT_TRUE(inflate(*make_tube({0.99 * maximum}, setup), *model, p).status.ok());
  for (const double beyond : {1.01, 1.2}) {
    const Inflation out = inflate(*make_tube({0.5 * maximum, beyond * maximum}, setup), *model, p);
    EXPECT_EQ(out.status.kind(), Status::Kind::failed) << beyond;
    const auto at = out.status.reason().find("(limit pressure): ");
    ASSERT_NE(at, std::string::npos) << out.status.reason();
    EXPECT_NEAR(std::stod(out.status.reason().substr(at + 18)), maximum, 2e-3 * maximum);
  }
}

struct Carried {
  double pressure, magnitude;  ///< magnitude: ∫ |σt − σr|, what the pressure is a difference of
  double slope;                ///< ∂p/∂(D/D0)
};
/// Pressure that a bare tube carries at a given diameter, by adaptive quadrature that knows nothing of the material.
Carried carried_pressure(const Model& model, const std::vector<double>& p, double Ri, double Ro, double outer_stretch,
                         double lz) {
  const auto integrand = [&](double x, double stretch) {
    const double R2 = std::exp(2 * x), c = (std::pow(stretch * Ro, 2) - (Ro * Ro - R2) / lz) / R2;
    const std::vector<double> at{c, lz * lz, 1 / (c * lz * lz)};
    std::vector<double> g(3);
    EXPECT_TRUE(model.evaluate_axes({1, at, p}, {{}, g, {}, {}}).ok());
    return 2 * (g[0] - at[2] * g[2] / c) / lz;
  };
  using boost::math::quadrature::gauss_kronrod;
  const auto pressure = [&](double stretch) {
    return gauss_kronrod<double, 31>::integrate([&](double x) { return integrand(x, stretch); }, std::log(Ri),
                                                std::log(Ro), 12, 1e-12);
  };
  const double magnitude = gauss_kronrod<double, 31>::integrate(
      [&](double x) { return std::abs(integrand(x, outer_stretch)); }, std::log(Ri), std::log(Ro), 4, 1e-3);
  constexpr double h = 1e-6;
  return {pressure(outer_stretch), magnitude, (pressure(outer_stretch + h) - pressure(outer_stretch - h)) / (2 * h)};
}

/// A thousand tubes over the whole box of the gho (seed 11, deterministic: no false alarm).
TEST(TubeRobustness, AnyTubeOfDispersedFibresConverges) {
  const auto model = make_model("gho");
  std::mt19937_64 engine(11);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * unit(engine); };
  std::size_t sharp = 0;
  double worst = 0;
  for (int draw = 0; draw < 1000; ++draw) {
    std::vector<double> p;
    for (const Parameter& parameter : model->describe().parameters)
      p.push_back(parameter.scale == Scale::log ? parameter.min * std::pow(parameter.max / parameter.min, unit(engine))
                                                : between(parameter.min, parameter.max));
    const double Ri = between(0.2, 6), thickness = between(0.05, 1.5) * Ri, lz = between(0.8, 1.8),
                 top = between(1, 40);
    std::vector<double> own = bare_tube;
    if (draw % 2 == 1)
      own = {between(-60, 200), between(-0.05, 0.05), between(0, 20), between(-0.2, 0.2), between(0.3, 3)};
    if (draw % 4 < 2) own[tethering] = 0;
    const auto tube = make_tube(evenly(0, top, draw % 3 == 0 ? 4 : 30),
                                {.axial_stretch = lz, .inner_radius = Ri, .thickness = thickness});
    const Inflation out = inflate(*tube, *model, p, own);
    ASSERT_TRUE(out.status.ok()) << draw << ": " << out.status.reason();
    for (const double value : out.values) ASSERT_TRUE(std::isfinite(value)) << draw;
    if (own != bare_tube) continue;
    const std::size_t n = tube->rows().count;
    const double pressure = tube->rows().abscissae[0].values[n - 1];
    const Carried carried = carried_pressure(*model, p, Ri, Ri + thickness, out.values[n - 1], lz);
    // No double for the diameter does better than its own rounding, nor a difference of stresses better than theirs.
    const double rounding = 4e-16 * out.values[n - 1] * carried.slope + 1e-13 * carried.magnitude;
    const double residual = std::abs(carried.pressure - pressure);
    const double stretch_error = residual / carried.slope;
    if (rounding < 1e-11 * pressure) {
      worst = std::max(worst, stretch_error);
      ++sharp;
    }
    EXPECT_LT(stretch_error, 1e-9 + rounding / carried.slope) << "draw " << draw;
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(sharp, 400u);  // so many of the 500 bare tubes were held to the full 1e-9
  std::printf("sharp %zu, worst error of the stretch %.2e\n", sharp, worst);
}

/// Many rows are found on a curve through samples, few one by one; the number of points through the wall is chosen, or
/// fixed at one that is fine enough for these walls (seed 23, deterministic: no false alarm).
TEST(TubeRobustness, ManyRowsAreWhereFewOnAFineRuleAre) {
  const auto model = make_model("gho");
  std::mt19937_64 engine(23);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr std::size_t n = 30, few = 6;
  for (int draw = 0; draw < 40; ++draw) {
    const auto between = [&](double low, double high) { return low + (high - low) * unit(engine); };
    const std::vector<double> p{between(5, 40), between(0.02, 0.3), between(5, 60), between(0.1, 5), between(20, 70)};
    std::vector<double> own = bare_tube;
    if (draw % 2 == 1) own = {between(-60, 160), between(-0.05, 0.05), 0, between(-0.2, 0.2), between(0.4, 2.5)};
    TubeSetup setup{.channels = {"outer_diameter_stretch", "inner_diameter", "axial_force"},
                    .axial_stretch = between(1, 1.5)};
    const std::vector<double> pressure = evenly(0, between(10, 25), n);
    const std::size_t columns = 3 * (p.size() + own.size());
    std::vector<double> values(3 * n), jacobian(columns * n), without_jacobian(3 * n);
    const auto whole = make_tube(pressure, setup);
    ASSERT_TRUE(whole->predict({*model, p, own}, {values, jacobian, {}, {}}).ok()) << draw;
    ASSERT_TRUE(whole->predict({*model, p, own}, {without_jacobian, {}, {}, {}}).ok()) << draw;
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_NEAR(values[i], without_jacobian[i], 1e-13 * std::abs(values[i])) << "draw " << draw << ", value " << i;
    setup.options.set("gauss_points", std::int64_t{60});
    for (std::size_t first = 0; first < n; first += few) {
      const auto part = make_tube({pressure.begin() + first, pressure.begin() + first + few}, setup);
      std::vector<double> alone(3 * few), by(columns * few);
      ASSERT_TRUE(part->predict({*model, p, own}, {alone, by, {}, {}}).ok()) << draw;
      const auto compare = [&](const std::vector<double>& many, const std::vector<double>& one, double tolerance) {
        for (std::size_t column = 0; column < one.size() / few; ++column) {
          double scale = 1e-12;  // a column of zeros
          for (std::size_t i = 0; i < n; ++i) scale = std::max(scale, std::abs(many[column * n + i]));
          for (std::size_t i = 0; i < few; ++i)
            ASSERT_NEAR(many[column * n + first + i], one[column * few + i], tolerance * scale)
                << "draw " << draw << ", column " << column << ", row " << first + i;
        }
      };
      compare(values, alone, 1e-11);
      compare(without_jacobian, alone, 1e-11);
      compare(jacobian, by, 1e-9);
    }
  }
}

/// Tubes of steep fibres in a soft matrix, whose stiffness changes a hundredfold where they are left or taken up (seed
/// 5, deterministic: no false alarm). Measured files often begin at the highest pressure.
TEST(TubeRobustness, RowsOfFallingPressureFindTheStatesOfRisingOnes) {
  const auto model = make_model("gho");
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * unit(engine); };
  for (int draw = 0; draw < 200; ++draw) {
    const std::vector<double> p{between(2, 30), draw % 2 == 0 ? 0 : between(0, 0.1), between(50, 1000),
                                between(10, 100), between(60, 90)};
    std::vector<double> own = bare_tube;
    own[opening_angle] = between(0, 150);
    const TubeSetup setup{.axial_stretch = between(1.02, 1.3), .inner_radius = 1.531, .thickness = 0.77};
    std::vector<double> pressure = evenly(0, between(1, 3.3), draw % 3 == 0 ? 2 : 12);
    const Inflation up = inflate(*make_tube(pressure, setup), *model, p, own);
    std::reverse(pressure.begin(), pressure.end());
    const Inflation down = inflate(*make_tube(pressure, setup), *model, p, own);
    ASSERT_TRUE(up.status.ok()) << draw << ": " << up.status.reason();
    ASSERT_TRUE(down.status.ok()) << draw << ": " << down.status.reason();
    for (std::size_t i = 0, n = pressure.size(); i < n; ++i)
      EXPECT_NEAR(up.values[i], down.values[n - 1 - i], 1e-9) << draw;
  }
}

}  // namespace
}  // namespace tunica::testing
