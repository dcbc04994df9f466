// SPDX-License-Identifier: Apache-2.0
// Terms of J and of the strain at constant volume: closed forms, other models, derivatives, and what is refused.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"
#include "models/composed.hpp"
#include "plugins/guarded.hpp"

namespace tunica::testing::composed_volume_test {
using namespace conformance;
namespace {

std::string term(const std::string& name, const std::string& invariant, const std::string& law,
                 const std::string& more = "") {
  return R"({"name": ")" + name + R"(", "invariant": ")" + invariant + "\"" +
         (law.empty() ? "" : R"(, "law": ")" + law + "\"") + more + "}";
}

double determinant(const Tensor& C) {
  return C[0] * (C[1] * C[2] - C[4] * C[4]) - C[3] * (C[3] * C[2] - C[4] * C[5]) + C[5] * (C[3] * C[4] - C[1] * C[5]);
}

/// Invariants of C̄ = J^(−2/3) C, and along (sin a, cos a, 0).
struct Strain {
  double J, first, second;
  Tensor bar;
  explicit Strain(const Tensor& C) : J(std::sqrt(determinant(C))) {
    for (std::size_t c = 0; c < 6; ++c) bar[c] = std::pow(J, -2. / 3) * C[c];
    first = bar[0] + bar[1] + bar[2];
    second = bar[0] * bar[1] + bar[1] * bar[2] + bar[2] * bar[0] - bar[3] * bar[3] - bar[4] * bar[4] - bar[5] * bar[5];
  }
  [[nodiscard]] double along(double angle) const {
    const double s = std::sin(angle), c = std::cos(angle);
    return s * s * bar[0] + c * c * bar[1] + 2 * s * c * bar[3];
  }
};

// Energies of Thakolkaran et al., J. Mech. Phys. Solids 169:105076 (2022), at 20 states of seed 7, against their
// formulas. A term of x is twice its coefficient, mu/2 x; one of x² k/2 x².
TEST(ComposedVolume, PublishedPlatesHaveTheirFormulas) {
  const std::string matrix = term("m", "I1bar", "linear"), volume = term("v", "J", "quadratic");
  const auto neo_hooke = composed("[" + matrix + ", " + volume + "]");
  const auto isihara = composed("[" + matrix + ", " + term("n", "I2bar", "linear") + ", " +
                                term("q", "I1bar", "quadratic") + ", " + volume + "]");
  const auto holzapfel =
      composed("[" + matrix + ", " + volume + ", " +
               term("f", "fibrebar", "exponential_square", R"(, "family": "diagonal", "fibre_switch": "none")") + "]");
  Sampler sampler(7);
  for (int draw = 0; draw < 20; ++draw) {
    const Tensor C = sampler.right_cauchy_green();
    const Strain at(C);
    const double x = at.first - 3, volume_change = at.J - 1;
    EXPECT_NEAR(evaluate(*neo_hooke, C, std::vector{1., 3.}).energy, 0.5 * x + 1.5 * volume_change * volume_change,
                1e-12);
    EXPECT_NEAR(evaluate(*isihara, C, std::vector{1., 2., 2., 3.}).energy,
                0.5 * x + (at.second - 3) + x * x + 1.5 * volume_change * volume_change, 1e-12);
    double fibres = 0;
    for (const double angle : {60., -60.}) {
      const double E = at.along(angle * std::numbers::pi / 180) - 1;
      fibres += 0.9 / (2 * 0.8) * (std::exp(0.8 * E * E) - 1);
    }
    EXPECT_NEAR(evaluate(*holzapfel, C, std::vector{1., 2., 0.9, 0.8, 60.}).energy,
                0.5 * x + volume_change * volume_change + fibres, 1e-12);
  }
}

/// Another model at parameters `p`, and the same energy as `q` of a list of terms.
struct Twin {
  std::string name, terms;
  std::unique_ptr<Model> model;
  std::vector<double> p, q;
};

std::unique_ptr<Model> compressible(std::unique_ptr<Model> base, const std::string& invariants,
                                    const std::string& law) {
  Options options;
  options.set("invariants", invariants);
  options.set("law", law);
  return plugins::wrap(catalogue().mechanisms().at("compressibility"), std::move(base), options);
}

std::vector<Twin> twins() {
  std::vector<Twin> all;
  // 2μ/α² [Σ λ^α − 3 + (J^(−αβ) − 1)/β]: Ogden's term of 2μ/α, and K = (2μ/α) αβ with the exponent αβ.
  const double mu = 25, alpha = 6, nu = 0.18, beta = nu / (1 - 2 * nu);
  Options one;
  one.set("terms", std::int64_t{1});
  one.set("poisson", std::string("shared"));
  all.push_back({"hyperfoam",
                 "[" + term("s", "stretches", "") + ", " + term("v", "J", "ogden") + "]",
                 make_model("hyperfoam", one),
                 {mu, alpha, nu},
                 {2 * mu / alpha, alpha, 2 * mu * beta, alpha * beta}});
  // f = 1: μ/2 [I1 − 3 + (J^(−2β) − 1)/β]
  all.push_back({"blatz_ko",
                 "[" + term("m", "I1", "linear") + ", " + term("v", "J", "ogden") + "]",
                 make_model("blatz_ko"),
                 {mu, 1, nu},
                 {mu, 2 * mu * beta, 2 * beta}});
  const double K = 40;
  for (const std::string law : {"quadratic", "logarithmic", "simo", "ogden"})
    for (const bool isochoric : {false, true}) {
      const std::string bar = isochoric ? "bar" : "", J = term("v", "J", law);
      std::vector<double> tail{K};
      if (law == "ogden") tail.push_back(9);
      const auto with = [&](std::vector<double> first) {
        first.insert(first.end(), tail.begin(), tail.end());
        return first;
      };
      const std::string how = isochoric ? "isochoric" : "full";
      all.push_back(
          {"gho " + how + " " + law,
           "[" + term("m", "I1" + bar, "linear") + ", " +
               term("f", "fibre" + bar, "exponential_square", R"(, "family": "diagonal", "dispersion": "rotational")") +
               ", " + J + "]",
           compressible(make_model("gho"), how, law),
           {20, 0.1, 30, 1.2, 40, 1 / K},
           with({20, 30, 1.2, 40, 0.1})});
      Options nine;
      nine.set("terms", std::int64_t{9});
      all.push_back({"mooney_rivlin " + how + " " + law,
                     "[" + term("a", "I1" + bar, "linear") + ", " + term("b", "I2" + bar, "linear") + ", " +
                         term("c", "I1" + bar, "quadratic") + ", " + term("d", "I1" + bar + "*I2" + bar, "linear") +
                         ", " + term("e", "I2" + bar, "quadratic") + ", " + term("f", "I1" + bar, "cubic") + ", " +
                         term("g", "I1" + bar + "^2*I2" + bar, "linear") + ", " +
                         term("h", "I1" + bar + "*I2" + bar + "^2", "linear") + ", " + term("i", "I2" + bar, "cubic") +
                         ", " + J + "]",
                     compressible(make_model("mooney_rivlin", nine), how, law),
                     {30, 5, 2, -3, 4, 1, -2, 3, 0.5, 1 / K},
                     with({60, 10, 4, -6, 8, 3, -4, 6, 1.5})});
      Options two;
      two.set("terms", std::int64_t{2});
      all.push_back({"ogden " + how + " " + law,
                     "[" + term("a", "stretches" + bar, "") + ", " + term("b", "stretches" + bar, "") + ", " + J + "]",
                     compressible(make_model("ogden", two), how, law),
                     {20, 3, -4, -2, 1 / K},
                     with({20, 3, -4, -2})});
    }
  return all;
}

// Seed 11. Energy, stress and tangent to 1e-11 of the largest entry.
TEST(ComposedVolume, IsTheModelThatHasTheSameEnergy) {
  for (const Twin& twin : twins()) {
    const auto own = composed(twin.terms);
    ASSERT_TRUE(own->describe().compressible) << twin.name;
    Sampler sampler(11);
    for (int draw = 0; draw < 10; ++draw) {
      const Tensor C = sampler.right_cauchy_green();
      const Evaluated a = evaluate(*twin.model, C, twin.p), b = evaluate(*own, C, twin.q);
      double largest = 1;
      for (const double entry : a.tangent) largest = std::max(largest, std::abs(entry));
      EXPECT_NEAR(a.energy, b.energy, 1e-11 * largest) << twin.name;
      for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(a.stress[k], b.stress[k], 1e-11 * largest) << twin.name;
      for (std::size_t k = 0; k < 36; ++k) EXPECT_NEAR(a.tangent[k], b.tangent[k], 1e-11 * largest) << twin.name;
    }
    const Evaluated rest = evaluate(*own, {1, 1, 1, 0, 0, 0}, twin.q);
    for (const double s : rest.stress) EXPECT_NEAR(s, 0, 1e-12 * 100) << twin.name;
  }
}

// Seed 20230211. Gradients, tangents and derivatives by parameters against differences, and all else a model promises.
TEST(ComposedVolume, KeepsEveryPropertyOfAModelWhateverTheTerm) {
  std::vector<std::string> all;
  for (const char* law : {"quadratic", "power", "exponential_square", "logarithmic", "simo", "ogden"})
    all.push_back(term("m", "I1", "linear") + ", " + term("v", "J", law));
  const std::string J = term("v", "J", "quadratic");
  for (const char* invariant : {"I1bar", "I2bar"})
    for (const char* law : {"linear", "exponential", "gent"})
      all.push_back(term("m", "I1", "linear") + ", " + J + ", " + term("t", invariant, law));
  for (const char* invariant : {"I1bar*I2bar", "I1bar^2*I2bar", "I1bar*I2bar^2", "I1*I2"})
    all.push_back(term("m", "I1bar", "linear") + ", " + J + ", " + term("t", invariant, "linear"));
  all.push_back(term("s", "stretches", "") + ", " + term("t", "stretchesbar", "") + ", " + J);
  all.push_back(J + ", " +
                term("t", "fibrebar", "exponential_square",
                     R"(, "family": "diagonal", "fibre_switch": "none", "dispersion": "two_planes")"));
  for (const std::string& terms : all) {
    const auto model = composed("[" + terms + "]");
    for (const ModelProperty& property : model_properties())
      if (std::string(property.name) != "concurrent_calls_agree") {
        EXPECT_EQ(property.check(*model, 20230211).counter_example, "") << terms << ", " << property.name;
      }
  }
}

// Near β = 0 the formula changes to a series: K θ² h(βθ) is continuous, and so are its derivatives. By differences over
// β and J, whose error is that of a fourth-order formula.
TEST(ComposedVolume, OgdensLawIsSmoothWhereItsExponentVanishes) {
  const auto model = composed("[" + term("m", "I1bar", "linear") + ", " + term("v", "J", "ogden") + "]");
  const auto at = [&](double J, double beta) {
    const double c = std::pow(J, 2. / 3);
    return evaluate(*model, {c, c, c, 0, 0, 0}, std::vector{10., 50., beta});
  };
  for (const double J : {0.5, 0.9, 1.001, 1.7}) {
    EXPECT_NEAR(at(J, 0).energy, 25 * std::log(J) * std::log(J), 1e-12);
    for (const double beta : {-2.0, -0.3, -1e-3, 0.0, 1e-6, 5e-3, 0.02, 0.2, 9.0}) {
      const double h = 1e-3;
      const double by_beta = (at(J, beta - 2 * h).stress[0] - 8 * at(J, beta - h).stress[0] +
                              8 * at(J, beta + h).stress[0] - at(J, beta + 2 * h).stress[0]) /
                             (12 * h);
      EXPECT_NEAR(at(J, beta).stress_dp[6 * 2], by_beta, 1e-8 * (1 + std::abs(by_beta))) << J << ", " << beta;
      const double c = std::pow(J, 2. / 3), k = 1e-4 * c;
      const auto energy = [&](double x) { return at(std::pow(x, 1.5), beta).energy; };
      // W(c 1): dW/dc = ½ S : 1
      const double slope = (energy(c - 2 * k) - 8 * energy(c - k) + 8 * energy(c + k) - energy(c + 2 * k)) / (12 * k);
      EXPECT_NEAR(1.5 * at(J, beta).stress[0], slope, 1e-9 * (1 + std::abs(slope))) << J << ", " << beta;
    }
  }
}

TEST(ComposedVolume, MessagesSayWhatATermMayBe) {
  using ::testing::HasSubstr;
  EXPECT_THAT(refusal("[" + term("m", "I1bar", "linear") + "]"),
              HasSubstr("\"terms\", 'm': the invariant is of the strain at constant volume, and no term has the "
                        "invariant J, so that nothing resists a change of volume. Add one"));
  EXPECT_THAT(refusal("[" + term("v", "J", "linear") + "]"),
              HasSubstr("the law 'linear' is not one of the invariant 'J'. Take one of quadratic, power"));
  EXPECT_THAT(refusal("[" + term("m", "I1", "simo") + "]"),
              HasSubstr("the law 'simo' is not one of the invariant 'I1'. Take one of linear"));
  Options options;
  options.set("invariant", std::string("J"));
  options.set("law", std::string("quadratic"));
  EXPECT_THAT(message_of<InputError>(
                  [&] { (void)plugins::wrap(catalogue().mechanisms().at("added_term"), make_model("yeoh"), options); }),
              HasSubstr("added_term: the invariant 'J' is of materials that change their volume, and the model 'yeoh' "
                        "keeps it. Take another invariant"));
}

TEST(ComposedVolume, TheFormulaNamesTheVolume) {
  EXPECT_EQ(composed("[" + term("m", "I1", "linear") + ", " + term("v", "J", "logarithmic") + "]")->describe().formula,
            "W = m_mu/2 (I1 - 3) + v_K/2 (ln J)^2 - a ln J, a so that S = 0 at rest");
  EXPECT_EQ(
      composed("[" + term("m", "I1bar^2*I2bar", "linear") + ", " + term("v", "J", "power") + "]")->describe().formula,
      "W = m_mu/2 (I1bar - 3)^2 (I2bar - 3) + v_K/v_m |(J - 1)|^v_m");
}

// A term beside a model that changes its volume is the same term in a list, but for the stress that it relieves.
TEST(ComposedVolume, AddedTermsStandBesideACompressibleModel) {
  const std::string base = term("m", "I1bar", "linear") + ", " + term("v", "J", "quadratic");
  Sampler sampler(3);
  for (const auto& [invariant, law] : std::vector<std::pair<std::string, std::string>>{
           {"J", "exponential_square"}, {"I2bar", "exponential"}, {"I1", "exponential"}, {"I1bar*I2bar", "linear"}}) {
    Options options;
    options.set("invariant", invariant);
    options.set("law", law);
    const auto added = plugins::wrap(catalogue().mechanisms().at("added_term"), composed("[" + base + "]"), options);
    const auto whole = composed("[" + base + ", " + term("t", invariant, law) + "]");
    ASSERT_EQ(added->describe().parameters.size(), whole->describe().parameters.size());
    std::vector<double> p{20, 50, 7, 1.3};
    p.resize(whole->describe().parameters.size());
    for (int draw = 0; draw < 5; ++draw) {
      const Tensor C = sampler.right_cauchy_green();
      const Evaluated a = evaluate(*added, C, p), b = evaluate(*whole, C, p);
      for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(a.stress[k], b.stress[k], 1e-10) << invariant;
      for (std::size_t k = 0; k < 36; ++k) EXPECT_NEAR(a.tangent[k], b.tangent[k], 1e-9) << invariant;
      for (std::size_t k = 0; k < a.stress_dp.size(); ++k)
        EXPECT_NEAR(a.stress_dp[k], b.stress_dp[k], 1e-10) << invariant;
    }
  }
}

}  // namespace
}  // namespace tunica::testing::composed_volume_test
