// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <complex>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "controlled.hpp"
#include "support/strip.hpp"

// Storage and loss modulus: closed forms of a Prony series, slopes of static curves, and a strip that oscillates in
// time.
namespace tunica::testing::dynamic_mechanical_test {
namespace {

using ::testing::HasSubstr;
using Complex = std::complex<double>;
using Column = std::pair<std::string, std::vector<double>>;

struct Dma {
  std::string mode = "tension", direction = "circumferential", normal = "axial", shift = "none";
  double static_stretch = 1, reference = 0, amplitude = 0;
  std::vector<std::string> channels = {"storage_modulus", "loss_modulus"};
};
std::unique_ptr<Test> make_dma(const std::vector<Column>& columns, const Dma& dma = {}) {
  TestSetup setup;
  setup.options.set("mode", dma.mode);
  setup.options.set("direction", dma.direction);
  setup.options.set("normal", dma.normal);
  setup.options.set("shift", dma.shift);
  setup.options.set("static_stretch", dma.static_stretch);
  setup.options.set("strain_amplitude", dma.amplitude);
  setup.options.set("reference_temperature", dma.reference);
  setup.rows.count = columns.front().second.size();
  for (const auto& [name, values] : columns) setup.rows.abscissae.push_back({name, values});
  setup.rows.channels = dma.channels;
  setup.stress_measure = "cauchy";
  return plugins::create(catalogue().tests().at("dynamic_mechanical"), setup);
}
std::vector<double> values_of(const Test& test, const Model& model, const std::vector<double>& p,
                              const std::vector<double>& own = {}) {
  std::vector<double> values(test.rows().count * test.rows().channels.size());
  const Status status = test.predict({model, p, own}, {values, {}, {}, {}});
  EXPECT_TRUE(status.ok()) << status.reason();
  return values;
}

const std::vector<double> frequencies{1e-5, 1e-3, 0.01, 0.1, 1, 10, 1e3, 1e6};

/// 1 + Σ g iωτ/(1 + iωτ) of branches (g, τ).
Complex series(double frequency, const std::vector<double>& branches) {
  const Complex i(0, 1);
  Complex sum = 1;
  for (std::size_t k = 0; k < branches.size(); k += 2) {
    const Complex x = i * (2 * std::numbers::pi * frequency * branches[k + 1]);
    sum += branches[k] * x / (1.0 + x);
  }
  return sum;
}

TEST(DynamicMechanical, IsTheClosedFormOfAPronySeriesAtRest) {
  // E* = 3μ (1 + Σ …), G* = μ (1 + Σ …), with four branches over five decades.
  const std::vector<double> branches{0.8, 5, 0.3, 60, 0.5, 0.02, 1.2, 0.5};
  std::vector<double> p{12};
  p.insert(p.end(), branches.begin(), branches.end());
  const auto model = viscous("neo_hooke", 4);
  for (const std::string mode : {"tension", "shear"}) {
    const double modulus = mode == "tension" ? 36 : 12;
    const auto values = values_of(*make_dma({{"frequency", frequencies}}, {.mode = mode}), *model, p);
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      const Complex expected = modulus * series(frequencies[i], branches);
      EXPECT_NEAR(values[i], expected.real(), 1e-8 * std::abs(expected)) << mode << ", " << frequencies[i] << " Hz";
      EXPECT_NEAR(values[8 + i], expected.imag(), 1e-8 * std::abs(expected)) << mode << ", " << frequencies[i] << " Hz";
    }
  }
}

TEST(DynamicMechanical, IsTheClosedFormAboutAStaticStretch) {
  // A neo-Hookean strip at λ: S'_a = μ (1 − I1/(3 c_a)). With λ2 = λ3, σ_v = λ² S'_1 − S'_2/λ changes by
  // μ (λ² + 2/λ)' in l at fixed rest: from the definition dσ_v = c1 dS'_1 − c3 dS'_3 with c = (λ², 1/λ, 1/λ) this is
  // (c1 d(−I1/(3 c1)) + c3 d(I1/(3 c3))) μ = μ I1, as dI1 cancels. The elastic part is dσ/dl = μ (2λ² + 1/λ).
  constexpr double mu = 12, g = 0.8, tau = 5;
  for (const double stretch : {0.7, 1.3, 2.0}) {
    const double first = stretch * stretch + 2 / stretch;
    const double stress = mu * (stretch * stretch - 1 / stretch);
    const auto values = values_of(*make_dma({{"frequency", frequencies}}, {.static_stretch = stretch}),
                                  *viscous("neo_hooke", 1), {mu, g, tau});
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      const Complex viscous_part = series(frequencies[i], {g, tau}) - 1.0;
      const Complex expected =
          (mu * (2 * stretch * stretch + 1 / stretch) - stress + viscous_part * mu * first) / (stretch * stretch);
      EXPECT_NEAR(values[i], expected.real(), 1e-8 * std::abs(expected)) << stretch << ", " << frequencies[i] << " Hz";
      EXPECT_NEAR(values[8 + i], expected.imag(), 1e-8 * std::abs(expected)) << stretch << ", " << frequencies[i];
    }
  }
}

TEST(DynamicMechanical, IsTheSlopeOfTheStaticCurveWithoutMemory) {
  const std::vector<double> gho{18.668, 0.1367, 24.905, 0.2912, 46.44}, stretches{0.95, 1.1, 1.3, 1.6};
  for (const std::string direction : {"circumferential", "axial"}) {
    const auto test = make_dma({{"frequency", {1, 1, 1, 1}}, {"static_stretch", stretches}}, {.direction = direction});
    const auto values = values_of(*test, *make_model("gho"), gho);
    const auto strip = make_strip(stretches, {.direction = direction, .measure = "first_piola_kirchhoff"});
    const auto slope = predict(*strip, *make_model("gho"), gho, 0, true).abscissa_derivative;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(values[i] / slope[i], 1, 1e-9) << direction << ", " << stretches[i];
      EXPECT_EQ(values[4 + i], 0);
    }
  }
}

/// What a strip of gho with two branches shows that oscillates in time from a settled state, in the last of its
/// periods: the first harmonic of the nominal stress over the amplitude.
struct Oscillated {
  static constexpr double stretch = 1.3, frequency = 0.1;
  std::vector<double> p{18.668, 0.1367, 24.905, 0.2912, 46.44, 0.8, 2, 0.3, 0.5};
  std::unique_ptr<Model> model = viscous("gho", 2);

  [[nodiscard]] Complex modulus(double amplitude, std::size_t per_period, std::size_t periods) const {
    const auto phase_at = [&](std::size_t k) {
      return 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(per_period);
    };
    std::vector<double> lambda{stretch}, time{1e6};  // settled before
    for (std::size_t k = 1; k <= per_period * periods; ++k) {
      time.push_back(1e6 + static_cast<double>(k) / (static_cast<double>(per_period) * frequency));
      lambda.push_back(stretch + amplitude * std::sin(phase_at(k)));
    }
    const auto strip = make_strip(lambda, {.measure = "first_piola_kirchhoff", .time = time});
    const auto stress = predict(*strip, *model, p).values;
    Complex sum;
    for (std::size_t k = per_period * (periods - 1) + 1; k <= per_period * periods; ++k)
      sum += Complex(std::sin(phase_at(k)), std::cos(phase_at(k))) * stress[k];
    return sum * (2 / (static_cast<double>(per_period) * amplitude));
  }
};

TEST(DynamicMechanical, IsWhatAStripShowsThatOscillatesInTime) {
  const Oscillated strip;
  const Complex shown = strip.modulus(1e-5, 2000, 8);
  const auto values = values_of(*make_dma({{"frequency", {strip.frequency}}}, {.static_stretch = strip.stretch}),
                                *strip.model, strip.p);
  EXPECT_NEAR(shown.real(), values[0], 1e-5 * values[0]);
  EXPECT_NEAR(shown.imag(), values[1], 1e-5 * values[0]);
}

// σ1 = μγ + h_ab + γ h_bb, where S'_ab = μ (γ + γ³/3) and S'_bb = −μγ²/3. With γ = A sin ωt the first harmonic of the
// one is μA (1 + A²/4), the second one of the other μA²/6, and H_n = Σ g inωτ/(1 + inωτ) makes h of the n-th:
//
//   G*(A) = μ (1 + (1 + A²/4) H_1 − (A²/12) H_2)
TEST(LargeOscillation, InShearIsTheClosedFormOfAPronySeries) {
  const std::vector<double> branches{0.8, 5, 0.3, 60, 0.5, 0.02, 0.6, 1e5};
  std::vector<double> p{12};
  p.insert(p.end(), branches.begin(), branches.end());
  const auto model = viscous("neo_hooke", 4);
  const std::vector<double> at{1e-5, 1e-3, 0.01, 0.1, 1, 10, 1e3};
  for (const double amplitude : {0.05, 0.5, 1.5}) {
    const auto values = values_of(*make_dma({{"frequency", at}}, {.mode = "shear", .amplitude = amplitude}), *model, p);
    const double square = amplitude * amplitude;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const Complex first = series(at[i], branches) - 1.0, second = series(2 * at[i], branches) - 1.0;
      const Complex expected = 12.0 * (1.0 + (1 + square / 4) * first - square / 12 * second);
      EXPECT_NEAR(values[i], expected.real(), 3e-5 * std::abs(expected)) << amplitude << ", " << at[i] << " Hz";
      EXPECT_NEAR(values[at.size() + i], expected.imag(), 3e-5 * std::abs(expected)) << amplitude << ", " << at[i];
    }
  }
}

// P = μ (λ − λ⁻²) without memory; its first harmonic by a finer sum.
TEST(LargeOscillation, WithoutMemoryIsTheFirstHarmonicOfTheStaticCurve) {
  constexpr double mu = 12, stretch = 1.4, amplitude = 0.3;
  double expected = 0;
  constexpr int parts = 1000;
  for (int k = 0; k < parts; ++k) {
    const double sine = std::sin(2 * std::numbers::pi * k / parts), at = stretch + amplitude * sine;
    expected += mu * (at - 1 / (at * at)) * sine * 2 / (parts * amplitude);
  }
  const auto values = values_of(*make_dma({{"frequency", {1}}}, {.static_stretch = stretch, .amplitude = amplitude}),
                                *make_model("neo_hooke"), {mu});
  EXPECT_NEAR(values[0], expected, 1e-9 * expected);
  EXPECT_NEAR(values[1], 0, 1e-9 * expected);
}

// Moduli are even in the amplitude: half of it leaves a quarter of the difference.
TEST(LargeOscillation, ConvergesToTheSmallOneWithTheSquareOfTheAmplitude) {
  const std::vector<double> gho{18.668, 0.1367, 24.905, 0.2912, 46.44, 0.8, 2, 0.3, 0.5};
  const std::vector<double> neo_hooke{12, 0.8, 2, 0.3, 0.5}, amplitudes{0.08, 0.04, 0.02, 0};
  for (const auto& [type, p, mode, stretch] :
       {std::tuple("gho", gho, "tension", 1.3), std::tuple("neo_hooke", neo_hooke, "tension", 1.3),
        std::tuple("neo_hooke", neo_hooke, "shear", 1.0)}) {
    const auto test = make_dma({{"frequency", {0.1, 0.1, 0.1, 0.1}}, {"strain_amplitude", amplitudes}},
                               {.mode = mode, .static_stretch = stretch});
    const auto values = values_of(*test, *viscous(type, 2), p);
    const auto off = [&](std::size_t i) { return Complex(values[i] - values[3], values[4 + i] - values[7]); };
    const double size = std::hypot(values[3], values[7]);
    EXPECT_GT(std::abs(off(0)), 1e-4 * size) << type << " " << mode << " tells amplitudes apart";
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(std::abs(off(i)) / std::abs(off(i + 1)), 4, 0.3) << type << " " << mode << ", " << amplitudes[i];
  }
}

TEST(LargeOscillation, IsWhatAStripShowsThatOscillatesInTime) {
  constexpr double amplitude = 0.2;
  const Oscillated strip;
  const Complex shown = strip.modulus(amplitude, 1000, 12);  // in finer steps than those of the test
  const auto values = values_of(
      *make_dma({{"frequency", {strip.frequency}}}, {.static_stretch = strip.stretch, .amplitude = amplitude}),
      *strip.model, strip.p);
  EXPECT_NEAR(values[0], shown.real(), 2e-5 * std::abs(shown));
  EXPECT_NEAR(values[1], shown.imag(), 2e-5 * std::abs(shown));
}

TEST(LargeOscillation, HasAModulusWhereTheMaterialSoftens) {
  // Behind the first cycle all is elastic. Softening spares the largest load and lowers the smaller ones, so that the
  // curve between them is steeper.
  const auto& mechanism = catalogue().mechanisms().at("stress_softening");
  const auto model = plugins::wrap(mechanism, make_model("neo_hooke"), defaults(mechanism.factory.options));
  const auto test = make_dma({{"frequency", {1}}}, {.static_stretch = 1.3, .amplitude = 0.2});
  const auto soft = values_of(*test, *model, {20, 0.3, 0.5}), bare = values_of(*test, *make_model("neo_hooke"), {20});
  EXPECT_GT(soft[0], 1.01 * bare[0]);
  EXPECT_NEAR(soft[1], 0, 1e-9 * soft[0]);
}

TEST(DynamicMechanical, ShiftsFrequenciesWithTheTemperature) {
  const std::vector<double> at{0.5, 0.5, 0.5}, T{280, 300, 330}, p{12, 0.8, 0.3};
  const auto model = viscous("neo_hooke", 1);
  const auto wlf = make_dma({{"frequency", at}, {"temperature", T}}, {.shift = "wlf", .reference = 300});
  const auto arrhenius = make_dma({{"frequency", at}, {"temperature", T}}, {.shift = "arrhenius", .reference = 300});
  const auto by_wlf = values_of(*wlf, *model, p, {8.86, 101.6}), by_arrhenius = values_of(*arrhenius, *model, p, {60});
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = std::pow(10, -8.86 * (T[i] - 300) / (101.6 + T[i] - 300));
    const double b = std::exp(60e3 / 8.31446261815324 * (1 / T[i] - 1.0 / 300));
    EXPECT_NEAR(by_wlf[i], 36 * series(0.5 * a, {0.8, 0.3}).real(), 1e-7);
    EXPECT_NEAR(by_arrhenius[3 + i], 36 * series(0.5 * b, {0.8, 0.3}).imag(), 1e-7);
  }
  std::vector<double> values(6);
  const std::vector<double> too_cold{8.86, 15};
  const Status status = wlf->predict({*model, p, too_cold}, {values, {}, {}, {}});
  EXPECT_THAT(status.reason(), HasSubstr("row 1 (0.500000 Hz, stretch 1.000000): the temperature lies where"));
}

TEST(DynamicMechanical, GivesLossTangentAndAmplitudeToo) {
  const auto test = make_dma({{"frequency", {0.1}}},
                             {.channels = {"storage_modulus", "loss_modulus", "loss_tangent", "dynamic_modulus"}});
  const auto values = values_of(*test, *viscous("neo_hooke", 1), {12, 0.8, 5});
  EXPECT_DOUBLE_EQ(values[2], values[1] / values[0]);
  EXPECT_DOUBLE_EQ(values[3], std::hypot(values[0], values[1]));
}

std::string refusal(const std::vector<Column>& columns, const Dma& dma = {}) {
  try {
    make_dma(columns, dma);
  } catch (const InputError& problem) {
    return problem.what();
  }
  return "accepted";
}

TEST(DynamicMechanical, HasNoModulusWhereTheMaterialSoftensAsTheLoadRises) {
  // About the largest stretch so far, softening has one slope upwards and another downwards.
  for (const auto& [id, amplitude, other] :
       {std::tuple("stress_softening", 0.3, 0.5), std::tuple("damage", 0.5, 6.0)}) {
    const auto& mechanism = catalogue().mechanisms().at(id);
    const auto model = plugins::wrap(mechanism, make_model("neo_hooke"), defaults(mechanism.factory.options));
    for (const double stretch : {0.8, 1.01, 1.5}) {
      const auto test = make_dma({{"frequency", {0.1, 1}}}, {.static_stretch = stretch});
      std::vector<double> values(4);
      const std::vector<double> p{20, amplitude, other}, own;
      EXPECT_THAT(test->predict({*model, p, own}, {values, {}, {}, {}}).reason(),
                  HasSubstr("one modulus where it is stretched more and another"))
          << id << ", " << stretch;
      // Without amplitude, and before it begins, it is the base.
      const auto bare = values_of(*test, *make_model("neo_hooke"), {20});
      const auto null = values_of(*test, *model, {20, 0, other});
      for (std::size_t i = 0; i < bare.size(); ++i) EXPECT_NEAR(null[i], bare[i], 1e-8 * bare[0]) << id;
    }
    EXPECT_NEAR(values_of(*make_dma({{"frequency", {1}}}), *model, {20, amplitude, other})[0], 60, 1e-3) << id;
    EXPECT_NEAR(values_of(*make_dma({{"frequency", {1}}}, {.mode = "shear"}), *model, {20, amplitude, other})[0], 20,
                1e-3)
        << id;
  }
}

TEST(DynamicMechanical, TakesFibresThatBeginToPull) {
  // At rest the elastic curve bends, which is no matter of memory.
  EXPECT_GT(values_of(*make_dma({{"frequency", {1}}}), *viscous("gho", 1), {20, 0.1, 30, 1, 40, 0.5, 1})[0], 60);
}

TEST(DynamicMechanical, SaysWhatIsWrongWithAProtocol) {
  EXPECT_THAT(refusal({{"frequency", {1, 0}}}), HasSubstr("row 2 has the frequency 0.000000 Hz; expected one above 0"));
  EXPECT_THAT(refusal({{"frequency", {1}}, {"static_stretch", {-1}}}), HasSubstr("the static stretch -1.000000"));
  EXPECT_THAT(refusal({{"temperature", {300}}}), HasSubstr("no column mapped to 'frequency'"));
  EXPECT_THAT(refusal({{"frequency", {1}}, {"temperature", {300}}}), HasSubstr("changes nothing without \"shift\""));
  EXPECT_THAT(refusal({{"frequency", {1}}}, {.shift = "wlf"}), HasSubstr("needs the temperature of each row"));
  EXPECT_THAT(refusal({{"frequency", {1}}, {"temperature", {300}}}, {.shift = "wlf"}),
              HasSubstr("needs \"reference_temperature\""));
  EXPECT_THAT(refusal({{"frequency", {1}}}, {.mode = "shear", .static_stretch = 1.2}), HasSubstr("is not stretched"));
  EXPECT_THAT(refusal({{"frequency", {1}}}, {.mode = "shear", .normal = "circumferential"}), HasSubstr("are the same"));
  EXPECT_THAT(refusal({{"frequency", {1}}, {"static_stretch", {1.2}}}, {.static_stretch = 1.2}),
              HasSubstr("is an option and a column"));
  EXPECT_THAT(refusal({{"frequency", {1}}, {"strain_amplitude", {0.1}}}, {.amplitude = 0.1}),
              HasSubstr("\"strain_amplitude\" is an option and a column"));
  EXPECT_THAT(refusal({{"frequency", {1, 1}}, {"strain_amplitude", {0, -0.1}}}),
              HasSubstr("row 2 has the strain amplitude -0.100000; expected 0"));
  EXPECT_THAT(
      refusal({{"frequency", {1}}, {"strain_amplitude", {5}}}),
      HasSubstr("row 1 has the strain amplitude 5.000000 about the stretch 1.000000; expected an amplitude below"));
}

}  // namespace
}  // namespace tunica::testing::dynamic_mechanical_test
