// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "controlled.hpp"
#include "support/strip.hpp"
#include "support/tensors_only.hpp"

// Strips under a prescribed stress: against strips under a prescribed stretch, closed forms and differences.
namespace tunica::testing::creep_test {
namespace {

using ::testing::HasSubstr;

struct Material {
  std::string name;
  std::unique_ptr<Model> model;
  std::vector<double> parameters;
};
std::vector<Material> materials() {
  std::vector<Material> all;
  all.push_back({"gho", make_model("gho"), {18.668, 0.1367, 24.905, 0.2912, 46.44}});
  all.push_back({"neo_hooke", make_model("neo_hooke"), {12}});
  all.push_back({"viscous gho", viscous("gho", 2), {18.668, 0.1367, 24.905, 0.2912, 46.44, 0.8, 5, 0.3, 60}});
  all.push_back({"viscous neo_hooke", viscous("neo_hooke", 1), {12, 0.8, 5}});
  all.push_back({"soft viscous yeoh", wrapped("stress_softening", viscous("yeoh", 1)), {30, 4, 0.5, 0.8, 5, 0.3, 0.6}});
  return all;
}

/// A ramp, a hold, an unloading below the first stretch and a recovery.
const std::vector<double> stretches{1.05, 1.15, 1.3, 1.3, 1.3, 1.2, 1.1, 1.12, 1.12, 1.25, 1.4};
const std::vector<double> clock{0.5, 1, 2, 3, 10, 11, 12, 20, 50, 51, 52};

TEST(Creep, InvertsAStripWhoseStretchIsPrescribed) {
  for (const Material& one : materials())
    for (const std::string measure : {"cauchy", "first_piola_kirchhoff", "second_piola_kirchhoff"})
      for (const bool timed : {true, false}) {
        StripSetup setup{.channels = {"stress", "transverse_stretch"}, .measure = measure};
        if (timed) setup.time = clock;
        const auto strip = make_strip(stretches, setup);
        const Prediction relaxed = predict(*strip, *one.model, one.parameters);
        ASSERT_TRUE(relaxed.status.ok()) << relaxed.status.reason();
        const std::size_t n = stretches.size();
        const std::vector<double> stress(relaxed.values.begin(), relaxed.values.begin() + std::ptrdiff_t(n));
        const auto creep = make_creep(stress, timed ? clock : std::vector<double>{},
                                      {.channels = {"stretch", "transverse_stretch"}, .measure = measure});
        const Predicted found = predicted(*creep, *one.model, one.parameters);
        ASSERT_TRUE(found.status.ok()) << one.name << ": " << found.status.reason();
        for (std::size_t i = 0; i < n; ++i) {
          EXPECT_NEAR(found.values[i], stretches[i], 1e-9) << one.name << ", " << measure << ", row " << i;
          EXPECT_NEAR(found.values[n + i], relaxed.values[n + i], 1e-9) << one.name << ", row " << i;
        }
      }
}

/// λ with μ (λ − λ⁻²) = P, by bisection in extended precision.
double neo_hookean_stretch(double mu, double nominal) {
  long double low = 0.01L, high = 1000;
  for (int k = 0; k < 200; ++k) {
    const long double middle = (low + high) / 2;
    (mu * (middle - 1 / (middle * middle)) > nominal ? high : low) = middle;
  }
  return static_cast<double>(low);
}

TEST(Creep, FindsTheStretchOfARubberBand) {
  const std::vector<double> stress{-30, 1e-3, 5, 50, 5000};
  const auto test = make_creep(stress, {}, {.measure = "first_piola_kirchhoff"});
  const Predicted found = predicted(*test, *make_model("neo_hooke"), {12});
  ASSERT_TRUE(found.status.ok()) << found.status.reason();
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const double expected = neo_hookean_stretch(12, stress[i]);
    EXPECT_NEAR(found.values[i] / expected, 1, 1e-12) << stress[i];
  }
}

TEST(Creep, HoldsTheStretchUnderTheStressThatRelaxesThere) {
  // P(t) = μ (λ − λ⁻²) (1 + Σ g_i e^{−t/τ_i}) is the closed form of a hold at λ after a jump.
  constexpr double mu = 12, stretch = 1.7;
  const std::vector<double> time{0, 0.01, 0.5, 2, 10, 11, 200, 5000};
  std::vector<double> stress;
  for (const double t : time)
    stress.push_back(mu * (stretch - 1 / (stretch * stretch)) *
                     (1 + 0.8 * std::exp(-t / 5) + 0.3 * std::exp(-t / 60) + 1.4 * std::exp(-t / 0.1)));
  const auto test = make_creep(stress, time, {.measure = "first_piola_kirchhoff"});
  const Predicted found = predicted(*test, *viscous("neo_hooke", 3), {mu, 0.8, 5, 0.3, 60, 1.4, 0.1});
  ASSERT_TRUE(found.status.ok()) << found.status.reason();
  for (std::size_t i = 0; i < time.size(); ++i) EXPECT_NEAR(found.values[i], stretch, 1e-12) << time[i] << " s";
}

TEST(Creep, OfASmallStressIsTheClosedFormOfTheStandardLinearSolid) {
  // E(t) = 3μ (1 + g e^{−t/τ}); held at σ: ε = σ/(3μ) (1 − g/(1 + g) e^{−t/((1 + g) τ)}), and, unloaded at t1, what is
  // left of it. Strains of 1e-7 are linear to 1e-7 of themselves; steps of 1/2000 τ leave their square.
  constexpr double mu = 12, g = 0.8, tau = 5, held = 3.6e-6, t1 = 10;
  std::vector<double> stress, time;
  const auto add = [&](double t, double value) {
    time.push_back(t);
    stress.push_back(value);
  };
  for (int k = 0; k <= 4000; ++k) add(t1 * k / 4000, held);
  for (int k = 0; k <= 4000; ++k) add(t1 + t1 * k / 4000, 0);
  const Predicted found = predicted(*make_creep(stress, time), *viscous("neo_hooke", 1), {mu, g, tau});
  ASSERT_TRUE(found.status.ok()) << found.status.reason();
  const auto compliance = [&](double t) { return (1 - g / (1 + g) * std::exp(-t / ((1 + g) * tau))) / (3 * mu); };
  for (const std::size_t i : {0u, 1u, 100u, 2000u, 4000u, 4001u, 4002u, 6000u, 8001u}) {
    const double expected = held * (compliance(time[i]) - (i > 4000 ? compliance(time[i] - t1) : 0));
    EXPECT_NEAR(found.values[i] - 1, expected, 3e-7 * held / (3 * mu)) << "row " << i;
  }
}

TEST(Creep, CarriesDerivativesByAllParametersAsDifferencesFindThem) {
  const std::vector<double> stress{2, 6, 14, 14, 14, 9, 3, 0, 0, 11, 21};
  for (const Material& one : materials())
    for (const bool timed : {true, false}) {
      const auto test = make_creep(stress, timed ? clock : std::vector<double>{},
                                   {.channels = {"stretch", "transverse_stretch", "normal_stretch"},
                                    .measure = "first_piola_kirchhoff",
                                    .steps = 3});
      const Predicted exact = predicted(*test, *one.model, one.parameters, true);
      ASSERT_TRUE(exact.status.ok()) << one.name << ": " << exact.status.reason();
      const Predicted alone = predicted(*test, *one.model, one.parameters);
      for (std::size_t i = 0; i < alone.values.size(); ++i) EXPECT_NEAR(exact.values[i], alone.values[i], 1e-14);
      const std::size_t size = exact.values.size();
      for (std::size_t j = 0; j < one.parameters.size(); ++j) {
        std::vector<double> p = one.parameters;
        const double h = 1e-4 * p[j];
        const auto moved = [&](double by) {
          p[j] = one.parameters[j] + by;
          return predicted(*test, *one.model, p).values;
        };
        const auto a = moved(h), b = moved(-h), c = moved(2 * h), d = moved(-2 * h);
        for (std::size_t i = 0; i < size; ++i) {
          const double difference = (8 * (a[i] - b[i]) - (c[i] - d[i])) / (12 * h);
          EXPECT_NEAR(exact.jacobian[j * size + i], difference, 1e-8 / p[j] + 1e-7 * std::abs(difference))
              << one.name << ", parameter " << j << ", value " << i;
        }
      }
    }
}

TEST(Creep, FollowsAModelOnTensorsWhereItHasNoAxes) {
  const std::vector<double> stress{2, 6, 14, 14, 14, 9, 3, 0, 0, 11, 21};
  const std::vector<double> p{18.668, 0.1367, 24.905, 0.2912, 46.44, 0.8, 5};
  const auto test = make_creep(stress, clock, {.channels = {"stretch", "transverse_stretch"}, .direction = "axial"});
  const TensorsOnly slow(viscous("gho", 1));
  const Predicted on_axes = predicted(*test, *viscous("gho", 1), p), on_tensors = predicted(*test, slow, p);
  ASSERT_TRUE(on_tensors.status.ok()) << on_tensors.status.reason();
  for (std::size_t i = 0; i < on_axes.values.size(); ++i) EXPECT_NEAR(on_tensors.values[i], on_axes.values[i], 1e-9);
  EXPECT_THAT(predicted(*test, slow, p, true).status.reason(), HasSubstr("no exact Jacobian"));
}

TEST(Creep, SaysWhichRowAMaterialDoesNotBear) {
  // The nominal stress of a softening energy has a largest value: c10 < 0 behind the start.
  const auto test = make_creep({1, 1e6}, {}, {.measure = "first_piola_kirchhoff"});
  const Predicted found = predicted(*test, *make_model("yeoh"), {30, -4, 0});
  EXPECT_FALSE(found.status.ok());
  EXPECT_THAT(found.status.reason(), HasSubstr("row 2 (stress 1000000.000000 kPa)"));
}

TEST(Creep, AtATemperatureIsThatOfOtherTimes) {
  const std::vector<double> stress{2, 6, 14, 14, 14, 9, 3, 0, 0, 11, 21};
  const std::vector<double> p{18.668, 0.1367, 24.905, 0.2912, 46.44, 0.8, 5};
  const auto model = viscous("gho", 1);
  for (const std::string shift : {"wlf", "arrhenius"}) {
    const std::vector<double> own =
        shift == "wlf" ? std::vector<double>{0.2, 8.86, 101.6} : std::vector<double>{0.2, 60};
    CreepSetup setup{.channels = {"stretch", "transverse_stretch"}, .permanent_set = true};
    const double a = shift == "wlf" ? std::pow(10, -8.86 * 12 / (101.6 + 12))
                                    : std::exp(60 / 8.31446261815324e-3 * (1 / 312.0 - 1 / 300.0));
    std::vector<double> times = clock;
    for (double& t : times) t /= a;
    const auto expected = predicted(*make_creep(stress, times, setup), *model, p, false, {0.2}).values;
    setup.shift = shift;
    setup.temperature = 312;
    setup.reference = 300;
    const auto test = make_creep(stress, clock, setup);
    const Predicted exact = predicted(*test, *model, p, true, own);
    ASSERT_TRUE(exact.status.ok()) << exact.status.reason();
    const std::size_t size = exact.values.size();
    for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(exact.values[i], expected[i], 1e-9) << shift;
    for (std::size_t j = 0; j < own.size(); ++j) {
      const double h = 1e-5 * own[j];
      std::vector<double> up = own, down = own;
      up[j] += h;
      down[j] -= h;
      const auto ahead = predicted(*test, *model, p, false, up).values,
                 behind = predicted(*test, *model, p, false, down).values;
      for (std::size_t i = 0; i < size; ++i) {
        const double difference = (ahead[i] - behind[i]) / (2 * h);
        EXPECT_NEAR(exact.jacobian[(p.size() + j) * size + i], difference, 1e-8 / own[j] + 1e-6 * std::abs(difference))
            << shift << ", parameter " << j << ", value " << i;
      }
    }
  }
}

TEST(Creep, SaysWhatAShiftNeeds) {
  const auto refusal = [](const CreepSetup& setup, const std::vector<double>& time) -> std::string {
    try {
      make_creep({1, 2}, time, setup);
    } catch (const InputError& problem) {
      return problem.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal({.temperature = 300}, {0, 1}), HasSubstr("changes nothing without \"shift\""));
  EXPECT_THAT(refusal({.shift = "wlf", .temperature = 300}, {0, 1}), HasSubstr("give both"));
  EXPECT_THAT(refusal({.shift = "wlf", .temperature = 300, .reference = 290}, {}), HasSubstr("without a time"));
}

TEST(Creep, RefusesRowsThatAreNone) {
  EXPECT_THROW(make_creep({}, {}), InputError);
  EXPECT_THROW(make_creep({1, NAN}, {}), InputError);
  EXPECT_THROW(make_creep({1, 2}, {1, 0}), InputError);
}

}  // namespace
}  // namespace tunica::testing::creep_test
