// SPDX-License-Identifier: Apache-2.0
// The isotropic models in the three tests of rubber, against stresses written out by hand: nominal stress is
// P = 2 (λ − 1/λ²)(W1 + W2/λ) in uniaxial tension, 2 (λ − 1/λ⁵)(W1 + λ² W2) in equibiaxial tension (each direction) and
// 2 (λ − 1/λ³)(W1 + W2) in pure shear (Treloar 1975, The Physics of Rubber Elasticity, ch. 5); for Ogden's energy
// Σ μ (λ^(α−1) − λ^(β α − 1)) with β = −½, −2, −1 (Ogden 1972).
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "support/sheet.hpp"
#include "support/strip.hpp"
#include "tunica/models/arterial_fibres.hpp"
#include "tunica/models/rubber_laws.hpp"

namespace tunica::testing {
namespace {

enum class Kind { uniaxial, equibiaxial, pure_shear };
constexpr Kind kinds[] = {Kind::uniaxial, Kind::equibiaxial, Kind::pure_shear};

/// Thirty rows from 0.6 to 3, nominal stress.
const std::vector<double>& stretches() {
  static const std::vector<double> values = evenly(0.6, 3, 30);
  return values;
}
std::unique_ptr<Test> make(Kind kind) {
  const std::string measure = "first_piola_kirchhoff";
  if (kind == Kind::uniaxial) return make_strip(stretches(), {.measure = measure});
  return make_sheet(kind == Kind::equibiaxial ? "equibiaxial" : "pure_shear", {{"stretch", stretches()}},
                    {.channels = {"stress"}, .measure = measure});
}

/// W1 and W2 as functions of I1 and I2.
using Slopes = std::function<std::pair<double, double>(double, double)>;

double nominal(Kind kind, double l, const Slopes& slopes) {
  switch (kind) {
    case Kind::uniaxial: {
      const auto [w1, w2] = slopes(l * l + 2 / l, 2 * l + 1 / (l * l));
      return 2 * (l - 1 / (l * l)) * (w1 + w2 / l);
    }
    case Kind::equibiaxial: {
      const auto [w1, w2] = slopes(2 * l * l + std::pow(l, -4), std::pow(l, 4) + 2 / (l * l));
      return 2 * (l - std::pow(l, -5)) * (w1 + l * l * w2);
    }
    case Kind::pure_shear:
      break;
  }
  const double both = l * l + 1 + 1 / (l * l);
  const auto [w1, w2] = slopes(both, both);
  return 2 * (l - std::pow(l, -3)) * (w1 + w2);
}

void expect_closed_form(const char* type, const std::vector<double>& p, const Slopes& slopes,
                        const Options& options = {}, double tolerance = 1e-9) {
  const auto model = make_model(type, options);
  for (const Kind kind : kinds) {
    const std::vector<double> values = stresses(*make(kind), *model, p);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double expected = nominal(kind, stretches()[i], slopes);
      EXPECT_NEAR(values[i], expected, tolerance * (p[0] + std::abs(expected))) << type << " " << stretches()[i];
    }
  }
}

TEST(Rubber, InvariantModelsHaveTheirClosedForms) {
  expect_closed_form("neo_hooke", {390}, [](double, double) { return std::pair(195., 0.); });
  expect_closed_form("mooney_rivlin", {160, 25}, [](double, double) { return std::pair(160., 25.); });
  expect_closed_form("yeoh", {170, -1.5, 0.03}, [](double i1, double) {
    const double x = i1 - 3;
    return std::pair(170 - 3 * x + 0.09 * x * x, 0.);
  });
  expect_closed_form("gent", {270, 80}, [](double i1, double) { return std::pair(135 * 80 / (83 - i1), 0.); });
}

// W = Σ c_mn x^m y^n with x = I1 − 3, y = I2 − 3: W1 = Σ m c_mn x^(m−1) y^n, W2 = Σ n c_mn x^m y^(n−1).
TEST(Rubber, MooneyRivlinOfMoreConstantsHasItsClosedForms) {
  struct Weight {
    int m, n;
    double c;
  };
  const std::vector<Weight> three{{1, 0, 160}, {0, 1, 25}, {1, 1, -1.5}};
  const std::vector<Weight> nine{{1, 0, 160},  {0, 1, 25},     {2, 0, -1.2},  {1, 1, 0.8},   {0, 2, -0.05},
                                 {3, 0, 0.06}, {2, 1, -0.004}, {1, 2, 0.002}, {0, 3, 0.0004}};
  const std::vector<Weight> five(nine.begin(), nine.begin() + 5);
  for (const std::vector<Weight>& weights : {three, five, nine}) {
    std::vector<double> p;
    for (const Weight& weight : weights) p.push_back(weight.c);
    const auto slopes = [&weights](double i1, double i2) {
      std::pair<double, double> both{0, 0};
      for (const auto& [m, n, c] : weights) {
        if (m > 0) both.first += c * m * std::pow(i1 - 3, m - 1) * std::pow(i2 - 3, n);
        if (n > 0) both.second += c * n * std::pow(i1 - 3, m) * std::pow(i2 - 3, n - 1);
      }
      return both;
    };
    Options options;
    options.set("terms", static_cast<std::int64_t>(weights.size()));
    expect_closed_form("mooney_rivlin", p, slopes, options, 1e-10);
  }
}

TEST(Rubber, OgdenHasItsClosedForms) {
  const auto model = make_model("ogden");
  const std::vector<double> p{630, 1.3, 1.2, 5, -10, -2};
  for (const Kind kind : kinds) {
    const double beta = kind == Kind::uniaxial ? -0.5 : kind == Kind::equibiaxial ? -2 : -1;
    const std::vector<double> values = stresses(*make(kind), *model, p);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double l = stretches()[i];
      double expected = 0;
      for (const std::size_t k : {0u, 2u, 4u})
        expected += p[k] * (std::pow(l, p[k + 1] - 1) - std::pow(l, beta * p[k + 1] - 1));
      EXPECT_NEAR(values[i], expected, 1e-9 * (630 + std::abs(expected))) << l;
    }
  }
}

TEST(Rubber, WorkOfAnEquibiaxialTestIsTheDifferenceOfTheEnergy) {
  // ∫ (P_t + P_z) dλ from 1 to 1.8 by Gauss's rule, 40 panels of three points (error far below rounding).
  constexpr double from = 1, to = 1.8;
  constexpr std::size_t panels = 40;
  const double node = std::sqrt(0.6), half = (to - from) / panels / 2;
  std::vector<double> l, weight;
  for (std::size_t k = 0; k < panels; ++k)
    for (const double at : {-node, 0., node}) {
      l.push_back(from + (2 * static_cast<double>(k) + 1 + at) * half);
      weight.push_back(at == 0 ? half * 8 / 9 : half * 5 / 9);
    }
  const auto sheet = make_sheet("equibiaxial", {{"stretch", l}}, {.measure = "first_piola_kirchhoff"});
  const std::vector<std::pair<const char*, std::vector<double>>> all{{"neo_hooke", {390}},
                                                                     {"mooney_rivlin", {160, 25}},
                                                                     {"yeoh", {170, -1.5, 0.03}},
                                                                     {"gent", {270, 80}},
                                                                     {"ogden", {630, 1.3, 1.2, 5, -10, -2}},
                                                                     {"gho", {18.668, 0.1367, 24.905, 0.2912, 46.44}},
                                                                     {"four_fibre", {10, 20, 0.5, 40, 5, 0.3, 8, 0.7}}};
  for (const auto& [type, p] : all) {
    const auto model = make_model(type);
    const std::vector<double> values = stresses(*sheet, *model, p);
    double work = 0;
    for (std::size_t i = 0; i < l.size(); ++i) work += weight[i] * (values[i] + values[l.size() + i]);
    const std::vector<double> c{from * from, to * to, from * from, to * to, 1, std::pow(to, -4)};
    std::vector<double> energy(2);
    ASSERT_TRUE(model->evaluate_axes({2, c, p}, {energy, {}, {}, {}}).ok());
    EXPECT_NEAR(work, energy[1] - energy[0], 1e-8 * (energy[1] - energy[0])) << type;
  }
}

struct LimitedFibres {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    InvariantOf<T> e;
    e.fibre = T(1);
    e.offset = T(-1);
    e.angle = p[4] * degree;
    return e;
  }
};

/// Gent's matrix with two fibre families: lateral equilibrium is no longer at λ2 = 1/√λ1, and Newton's steps towards it
/// can leave the domain where the energy is defined.
std::unique_ptr<Model> limited_wall() {
  ModelDescription description;
  description.type = "limited_wall";
  for (const char* name : {"mu", "Jm", "k1", "k2", "theta"})
    description.parameters.push_back({name, "1", 1, 0, 90, Scale::linear, "", ""});
  Options options;
  options.set("fibre_switch", std::string("strain"));
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(isotropic::part<laws::Gent, isotropic::FirstInvariant, 5>("matrix", {0, 1}));
  parts.push_back(arterial::fibres<LimitedFibres, 5>({4}, {2, 3}, options));
  return std::make_unique<Hyperelastic>(std::move(description), std::move(parts));
}

struct Equilibrium {
  double stress, excess;  ///< Cauchy stress; I1 − 3
};
/// The strip by bisection in extended precision; beyond the limit the residual's sign is that of the side.
Equilibrium bisect(const std::vector<double>& p, double stretch) {
  const long double c1 = static_cast<long double>(stretch) * stretch, s2 = std::pow(std::sin(p[4] * degree), 2.0L);
  long double low = -std::log(c1) / 2 - 3, high = -std::log(c1) / 2 + 3, stress = 0, excess = 0;
  const auto residual = [&](long double y) -> long double {
    const long double u = std::exp(y), c3 = 1 / (c1 * u);
    excess = c1 + u + c3 - 3;
    if (excess >= p[1]) return u > c3 ? 1 : -1;
    const long double w1 = 0.5L * p[0] * p[1] / (p[1] - excess), e = s2 * c1 + (1 - s2) * u - 1;
    const long double f = e > 0 ? 2 * p[2] * e * std::exp(p[3] * e * e) : 0;
    stress = 2 * (c1 * (w1 + f * s2) - c3 * w1);
    return u * (w1 + f * (1 - s2)) - c3 * w1;
  };
  for (int i = 0; i < 120; ++i) {
    const long double middle = (low + high) / 2;
    (residual(middle) > 0 ? high : low) = middle;
  }
  residual((low + high) / 2);
  return {static_cast<double>(stress), static_cast<double>(excess)};
}

TEST(Gent, TrialsBeyondTheLimitDoNotBreakAStripThatCanBeSolved) {
  // 200 sets (seed 12, deterministic). Up to the stretch where I1 − 3 reaches 99.9 % of Jm on the free path every row
  // must be solved, on both paths; one step beyond the limit it must be a status.
  const auto model = limited_wall();
  std::mt19937_64 engine(12);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int draw = 0; draw < 200; ++draw) {
    const std::vector<double> p{1 + 50 * unit(engine), 0.2 + 3 * unit(engine), 100 * unit(engine), 0.1 + unit(engine),
                                90 * unit(engine)};
    double low = 1, high = 4;  // stretch at which the limit is reached
    for (int i = 0; i < 60; ++i)
      (bisect(p, 0.5 * (low + high)).excess < 0.999 * p[1] ? low : high) = 0.5 * (low + high);
    const std::vector<double> stretch = evenly(1, low, draw % 2 == 0 ? 6 : 40);
    for (const double misalignment : {0., 1e-9}) {
      const Prediction out = predict(*make_strip(stretch), *model, p, misalignment);
      ASSERT_TRUE(out.status.ok()) << out.status.reason() << " draw " << draw << ", misalignment " << misalignment;
      for (std::size_t i = 0; i < stretch.size(); ++i) {
        const double expected = bisect(p, stretch[i]).stress;
        ASSERT_NEAR(out.values[i], expected, 1e-7 * (p[0] + std::abs(expected))) << "draw " << draw << " row " << i;
      }
    }
    const Prediction beyond = predict(*make_strip({1.0, 1 + 3 * (low - 1)}), *model, p);
    if (bisect(p, 1 + 3 * (low - 1)).excess >= p[1]) {
      EXPECT_EQ(beyond.status.kind(), Status::Kind::failed);
    }
  }
}

TEST(Gent, ARowBeyondTheLimitIsAStatusThatNamesIt) {
  const auto model = make_model("gent");
  const Prediction out = predict(*make_strip({1, 2, 3, 4}), *model, {300, 8});  // I1 − 3 = 8 is reached at 3.2
  EXPECT_EQ(out.status.kind(), Status::Kind::failed);
  EXPECT_NE(out.status.reason().find("row 4 (stretch 4"), std::string::npos) << out.status.reason();
  EXPECT_TRUE(predict(*make_strip({1, 2, 3, 3.2}), *model, {300, 8}).status.ok());
}

}  // namespace
}  // namespace tunica::testing
