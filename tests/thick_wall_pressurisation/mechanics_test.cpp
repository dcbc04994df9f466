// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/strip.hpp"
#include "support/tube.hpp"

namespace tunica::testing::mechanics_test {
namespace {

constexpr double inner = 3.71, outer = 5.77;

/// The gho tube once more, written down for itself: Simpson's rule in R² and bisection, nothing shared with the plugin.
class IndependentTube {
 public:
  IndependentTube(const std::vector<double>& p, double axial_stretch) : p_(p), lz_(axial_stretch) {}

  struct Forces {
    double pressure, axial_force;
  };
  [[nodiscard]] Forces at(double ro) const {
    constexpr int intervals = 4000;
    const double low = inner * inner, high = outer * outer, h = (high - low) / intervals;
    Forces sum{0, 0};
    for (int k = 0; k <= intervals; ++k) {
      const double R2 = low + k * h, r2 = ro * ro - (high - R2) / lz_, c = r2 / R2, cz = lz_ * lz_, cr = 1 / (c * cz);
      const double sine = std::sin(p_[4] * std::numbers::pi / 180), st = sine * sine;
      const double kappa = p_[1], e = kappa * (c + cz + cr) + (1 - 3 * kappa) * (st * c + (1 - st) * cz) - 1;
      const double fibre = e > 0 ? 2 * p_[2] * e * std::exp(p_[3] * e * e) : 0;  // both families
      const double wt = p_[0] / 2 + fibre * (kappa + (1 - 3 * kappa) * st), wr = p_[0] / 2 + fibre * kappa;
      const double wz = p_[0] / 2 + fibre * (kappa + (1 - 3 * kappa) * (1 - st));
      const double hoop = 2 * (c * wt - cr * wr), axial = 2 * (cz * wz - cr * wr);
      const double weight = (k == 0 || k == intervals ? 1 : k % 2 == 1 ? 4 : 2) * h / 3;
      sum.pressure += weight * hoop / (2 * lz_ * r2);  // R dR = d(R²)/2
      sum.axial_force += weight * std::numbers::pi * (2 * axial - hoop) / (2 * lz_);
    }
    return sum;
  }
  [[nodiscard]] double outer_radius(double pressure) const {
    double low = std::sqrt((outer * outer - inner * inner) / lz_ + 0.1), high = 4 * outer;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (at(middle).pressure > pressure ? high : low) = middle;
    }
    return (low + high) / 2;
  }

 private:
  std::vector<double> p_;
  double lz_;
};

TEST(Tube, AgreesWithAnIndependentBisection) {
  for (const double stretch : {1.05, 1.35}) {
    const std::vector<double> pressure{0, 3, 9, 18};
    const Inflation out = inflate(*make_tube(pressure, {.axial_stretch = stretch}), *make_model("gho"), set_s);
    ASSERT_TRUE(out.status.ok()) << out.status.reason();
    const IndependentTube independent(set_s, stretch);
    for (std::size_t i = 0; i < 4; ++i) {
      const double ro = independent.outer_radius(pressure[i]);
      EXPECT_NEAR(out.values[i], ro / outer, 1e-9) << i;
      const double force = independent.at(ro).axial_force;
      EXPECT_NEAR(out.values[4 + i], force, 1e-8 * std::max(100., std::abs(force))) << i;
    }
  }
}

/// Energy of the wall per unit of unloaded length, from the outer diameter stretch: π ∫ W d(R²), Simpson's rule.
double energy(const Model& model, const std::vector<double>& p, double outer_stretch, double axial_stretch) {
  constexpr std::size_t n = 2001;
  std::vector<double> c(3 * n), W(n);
  const double low = inner * inner, high = outer * outer, h = (high - low) / (n - 1), ro = outer_stretch * outer;
  for (std::size_t k = 0; k < n; ++k) {
    const double R2 = low + static_cast<double>(k) * h;
    c[k] = (ro * ro - (high - R2) / axial_stretch) / R2;
    c[n + k] = axial_stretch * axial_stretch;
    c[2 * n + k] = 1 / (c[k] * c[n + k]);
  }
  EXPECT_TRUE(model.evaluate_axes({n, c, p}, {W, {}, {}, {}}).ok());
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) sum += (k == 0 || k == n - 1 ? 1 : k % 2 == 1 ? 4 : 2) * h / 3 * W[k];
  return std::numbers::pi * sum;
}

/// Nodes and weights of the five-point rule on [0, 1].
constexpr double gauss_node[] = {0.0469100770306680, 0.2307653449471585, 0.5, 0.7692346550528415, 0.9530899229693320};
constexpr double gauss_weight[] = {0.1184634425280945, 0.2393143352496832, 0.2844444444444444, 0.2393143352496832,
                                   0.1184634425280945};

TEST(Tube, PressureDoesTheWorkThatTheWallStores) {
  // ∫ p dV from 0 to 20 kPa at λz = 1.2, integrated by parts to ∫ V dp, V = π ri² λz per unloaded length: p_1 V_1 − ∫ V
  // dp.
  const auto model = make_model("gho");
  std::vector<double> pressure, weight;
  constexpr int parts = 20;
  for (int k = 0; k < parts; ++k)
    for (int m = 0; m < 5; ++m) {
      pressure.push_back(20. / parts * (k + gauss_node[m]));
      weight.push_back(20. / parts * gauss_weight[m]);
    }
  pressure.insert(pressure.end(), {0, 20});
  const Inflation out =
      inflate(*make_tube(pressure, {.channels = {"inner_diameter", "outer_diameter_stretch"}}), *model, set_s);
  ASSERT_TRUE(out.status.ok()) << out.status.reason();
  const std::size_t n = pressure.size();
  const auto volume = [&](std::size_t i) { return std::numbers::pi / 4 * out.values[i] * out.values[i] * 1.2; };
  double work = 20 * volume(n - 1);
  for (std::size_t i = 0; i + 2 < n; ++i) work -= weight[i] * volume(i);
  const double stored =
      energy(*model, set_s, out.values[2 * n - 1], 1.2) - energy(*model, set_s, out.values[2 * n - 2], 1.2);
  EXPECT_NEAR(work, stored, 1e-8 * stored);
}

TEST(Tube, PressureAndAxialForceTogetherDoTheWorkThatTheWallStores) {
  // At 10 kPa held from λz = 1.05 to 1.3: the pressure does p ΔV, the rig ∫ F dλz, F the reduced force.
  const auto model = make_model("gho");
  std::vector<double> stretch, weight;
  for (int k = 0; k < 10; ++k)
    for (int m = 0; m < 5; ++m) {
      stretch.push_back(1.05 + 0.025 * (k + gauss_node[m]));
      weight.push_back(0.025 * gauss_weight[m]);
    }
  stretch.insert(stretch.end(), {1.05, 1.3});
  const std::size_t n = stretch.size();
  const Inflation out = inflate(
      *make_tube(std::vector<double>(n, 10.),
                 {.channels = {"inner_diameter", "outer_diameter_stretch", "axial_force"}, .axial_stretches = stretch}),
      *model, set_s);
  ASSERT_TRUE(out.status.ok()) << out.status.reason();
  const auto volume = [&](std::size_t i) { return std::numbers::pi / 4 * out.values[i] * out.values[i] * stretch[i]; };
  double work = 10 * (volume(n - 1) - volume(n - 2));
  for (std::size_t i = 0; i + 2 < n; ++i) work += weight[i] * out.values[2 * n + i];
  const double stored =
      energy(*model, set_s, out.values[2 * n - 1], 1.3) - energy(*model, set_s, out.values[2 * n - 2], 1.05);
  EXPECT_NEAR(work, stored, 1e-8 * std::abs(stored));
}

TEST(Tube, AThinWallObeysLaplace) {
  // p = σt t/r and F = 2π r t (σz − σt/2) at the mid-surface: the error is of the order of (t/R)².
  const auto model = make_model("gho");
  const auto sheet_stress = [&](double lt, double lz) {
    const std::vector<double> c{lt * lt, lz * lz, 1 / (lt * lt * lz * lz)};
    std::vector<double> g(3);
    EXPECT_TRUE(model->evaluate_axes({1, c, set_s}, {{}, g, {}, {}}).ok());
    return std::pair{2 * (c[0] * g[0] - c[2] * g[2]), 2 * (c[1] * g[1] - c[2] * g[2])};
  };
  double error[2];
  for (const int k : {0, 1}) {
    const double thickness = k == 0 ? 0.02 : 0.01, Ri = 4 - thickness / 2, Ro = 4 + thickness / 2;
    const auto [hoop, axial] = sheet_stress(1.3, 1.2);
    const double t = thickness / (1.3 * 1.2), r = 1.3 * 4, pressure = hoop * t / r;
    const Inflation out =
        inflate(*make_tube({pressure}, {.channels = {"outer_diameter", "inner_diameter", "axial_force"},
                                        .inner_radius = Ri,
                                        .thickness = thickness}),
                *model, set_s);
    ASSERT_TRUE(out.status.ok()) << out.status.reason();
    // The radius that halves the volume of the wall is the mid-surface's.
    const double mid = std::sqrt((out.values[0] * out.values[0] + out.values[1] * out.values[1]) / 8);
    const double unloaded = std::sqrt((Ri * Ri + Ro * Ro) / 2);
    error[k] = std::abs(mid / unloaded / 1.3 - 1);
    EXPECT_NEAR(out.values[2] / (2 * std::numbers::pi * r * t * (axial - hoop / 2)), 1, 3 * thickness / 4);
  }
  EXPECT_LT(error[0], 1e-4);
  EXPECT_GT(error[0] / error[1], 1.8);  // and it falls with the thickness
}

TEST(Tube, MeanStressesAreTheIntegralsOverTheWall) {
  const auto model = make_model("gho");
  const Inflation out = inflate(*make_tube({12}), *model, set_s);
  ASSERT_TRUE(out.status.ok());
  const double ro = out.values[0] * outer, lz = 1.2, Ri2 = inner * inner;
  const double ri = std::sqrt(ro * ro - (outer * outer - Ri2) / lz);
  EXPECT_NEAR(out.diagnostics[0], ri / inner, 1e-12);
  // σr from the inner face outwards, dσr/dr = (σt − σr)/r; midpoint rule.
  constexpr int steps = 20000;
  double radial = -12, hoop_sum = 0, axial_sum = 0;
  const double dr = (ro - ri) / steps;
  for (int k = 0; k < steps; ++k) {
    const double r = ri + (k + 0.5) * dr, R2 = Ri2 + (r * r - ri * ri) * lz;
    const std::vector<double> c{r * r / R2, lz * lz, R2 / (r * r * lz * lz)};
    std::vector<double> g(3);
    ASSERT_TRUE(model->evaluate_axes({1, c, set_s}, {{}, g, {}, {}}).ok());
    const double hoop = 2 * (c[0] * g[0] - c[2] * g[2]), axial = 2 * (c[1] * g[1] - c[2] * g[2]);
    const double middle = radial + 0.5 * hoop / r * dr;
    hoop_sum += (hoop + middle) * dr;
    axial_sum += (axial + middle) * 2 * r * dr;
    radial += hoop / r * dr;
  }
  EXPECT_NEAR(out.diagnostics[1], hoop_sum / (ro - ri), 1e-6 * hoop_sum);
  EXPECT_NEAR(out.diagnostics[2], axial_sum / (ro * ro - ri * ri), 1e-6 * axial_sum);
}

TEST(Tube, RelaxesUnderPressureTowardsTheEquilibriumDiameter) {
  const auto viscous = plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), make_model("neo_hooke"), {});
  const std::vector<double> p{60, 0.8, 5}, held(7, 8.);
  const Inflation creep = inflate(*make_tube(held, {.time = {0, 0.5, 2, 10, 40, 400, 800}}), *viscous, p);
  const Inflation elastic = inflate(*make_tube({8}), *make_model("neo_hooke"), {60});
  const Inflation stiff = inflate(*make_tube({8}), *make_model("neo_hooke"), {60 * 1.8});
  ASSERT_TRUE(creep.status.ok() && elastic.status.ok() && stiff.status.ok()) << creep.status.reason();
  for (std::size_t i = 1; i < 7; ++i) EXPECT_GT(creep.values[i], creep.values[i - 1]);
  EXPECT_NEAR(creep.values[0], stiff.values[0], 1e-9);  // at once: the branch is a second, parallel spring
  EXPECT_NEAR(creep.values[6], elastic.values[0], 1e-6);
  const Inflation clockless = inflate(*make_tube(held), *viscous, p);
  ASSERT_TRUE(clockless.status.ok());
  EXPECT_NEAR(clockless.values[3], elastic.values[0], 1e-10);
}

/// The integral of a column over the radius, by the trapezoidal rule, carried on to both faces.
double across(const Snapshot& snapshot, std::size_t column, double ri, double ro, bool over_area) {
  const auto& r = snapshot.section[1].values;
  const auto& v = snapshot.section[column].values;
  const auto weighted = [&](std::size_t k) { return v[k] * (over_area ? 2 * std::numbers::pi * r[k] : 1); };
  double sum = weighted(0) * (r.front() - ri) + weighted(r.size() - 1) * (ro - r.back());
  for (std::size_t k = 1; k < r.size(); ++k) sum += 0.5 * (weighted(k) + weighted(k - 1)) * (r[k] - r[k - 1]);
  return sum;
}

TEST(Tube, ShowsTheStressThroughItsWall) {
  const auto tube = make_tube({0, 12}, {.channels = {"outer_diameter", "inner_diameter", "axial_force"}});
  const auto model = make_model("gho");
  for (const std::vector<double>& own : {bare_tube, std::vector<double>{70, 0, 0, 0, 1.4}}) {
    std::vector<Snapshot> found;
    const std::vector<std::size_t> rows{1};
    const Status status = tube->snapshots({*model, set_s, own}, rows, found);
    ASSERT_TRUE(status.ok()) << status.reason();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].row, 1u);
    EXPECT_TRUE(found[0].cells.empty());
    ASSERT_EQ(found[0].section[5].name, "circumferential_stress");
    const Inflation out = inflate(*tube, *model, set_s, own);
    const double ro = out.values[1] / 2, ri = out.values[3] / 2;
    const auto& radial = found[0].section[7].values;
    EXPECT_NEAR(radial.front(), -12, 0.1);
    EXPECT_NEAR(radial.back(), 0, 0.1);
    // Equilibrium of half a ring, and of a closed end less the force that the pressure takes.
    EXPECT_NEAR(across(found[0], 5, ri, ro, false), 12 * ri, 0.01 * 12 * ri);
    const double force = across(found[0], 6, ri, ro, true) - 12 * std::numbers::pi * ri * ri;
    EXPECT_NEAR(force, out.values[5], 0.01 * std::abs(out.values[5]) + 1);
    EXPECT_NEAR(found[0].section[0].values.front(), inner, 0.01);
    EXPECT_NEAR(found[0].section[1].values.back(), ro, 0.01);
  }
}

TEST(Tube, ShowsNoWallThatRemembers) {
  const auto viscous = plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), make_model("neo_hooke"), {});
  std::vector<Snapshot> found;
  const std::vector<double> p{60, 0.8, 5};
  const std::vector<std::size_t> rows{0};
  const Status status = make_tube({8})->snapshots({*viscous, p, bare_tube}, rows, found);
  EXPECT_FALSE(status.ok());
  EXPECT_NE(status.reason().find("shows the wall of a material without history only"), std::string::npos);
}

}  // namespace
}  // namespace tunica::testing::mechanics_test
