// SPDX-License-Identifier: Apache-2.0
// Materials that change their volume: strips, sheets, sheared blocks, confined and volumetric compression.
#include <cmath>

#include <gtest/gtest.h>

#include "conformance/test_properties.hpp"
#include "plugins/guarded.hpp"
#include "support/sheet.hpp"
#include "support/strip.hpp"

namespace tunica::testing::compressible_test {
namespace {

// One term of hyperfoam: μ, α, ν, with β = ν/(1 − 2ν).
const double mu = 25, alpha = 6, nu = 0.18, beta = nu / (1 - 2 * nu);
const std::vector<double> foam{mu, alpha, nu};
const std::vector<double> pressed = evenly(0.3, 1.6, 14);

std::unique_ptr<Model> hyperfoam(int terms, const std::string& poisson = "shared") {
  Options options;
  options.set("terms", std::int64_t{terms});
  options.set("poisson", poisson);
  return make_model("hyperfoam", options);
}

std::unique_ptr<Model> compressible(std::unique_ptr<Model> base, const std::string& invariants = "isochoric",
                                    const std::string& law = "quadratic") {
  Options options;
  options.set("invariants", invariants);
  options.set("law", law);
  return plugins::wrap(catalogue().mechanisms().at("compressibility"), std::move(base), options);
}

std::unique_ptr<Test> make_test(const std::string& type, const std::string& abscissa, const std::vector<double>& rows,
                                const std::vector<std::string>& channels, const std::string& measure = "cauchy") {
  TestSetup setup;
  if (type == "confined_compression") setup.options.set("direction", std::string("radial"));
  if (type == "simple_shear") {
    setup.options.set("direction", std::string("circumferential"));
    setup.options.set("normal", std::string("axial"));
    setup.options.set("angle", 0.0);
  }
  setup.rows.count = rows.size();
  setup.rows.abscissae = {{abscissa, rows}};
  setup.rows.channels = channels;
  setup.stress_measure = measure;
  return plugins::create(catalogue().tests().at(type), setup);
}

// S22 = 0: λ2^α = J^(−αβ), J = λ1 λ2², so that λ2 = λ1^(−ν), and P = 2μ/(α λ1) (λ1^α − J^(−αβ)).
TEST(Compressible, StripOfHyperfoamHasItsClosedForm) {
  for (const char* direction : {"circumferential", "axial", "radial"}) {
    const auto strip = make_strip(
        pressed,
        {direction, {"stress", "transverse_stretch", "normal_stretch", "volume_ratio"}, "first_piola_kirchhoff"});
    const Prediction found = predict(*strip, *hyperfoam(1), foam);
    ASSERT_TRUE(found.status.ok()) << found.status.reason();
    const std::size_t n = pressed.size();
    for (std::size_t i = 0; i < n; ++i) {
      const double l = pressed[i], lateral = std::pow(l, -nu), J = l * lateral * lateral;
      EXPECT_NEAR(found.values[i], 2 * mu / (alpha * l) * (std::pow(l, alpha) - std::pow(J, -alpha * beta)), 1e-10);
      EXPECT_NEAR(found.values[n + i], lateral, 1e-10);
      EXPECT_NEAR(found.values[2 * n + i], lateral, 1e-10);
      EXPECT_NEAR(found.values[3 * n + i], J, 1e-10);
      EXPECT_NEAR(found.diagnostics[i], lateral, 1e-10);
    }
  }
}

// S33 = 0: λ3 = (λ1 λ2)^(−ν/(1−ν)), and σ_a = 2μ/(α J) (λ_a^α − J^(−αβ)).
TEST(Compressible, SheetOfHyperfoamHasItsClosedForm) {
  const std::vector<double> t = evenly(0.8, 1.5, 8), z = evenly(1.4, 0.9, 8);
  const auto values =
      stresses(*make_sheet("general", {{"stretch_circumferential", t}, {"stretch_axial", z}}, {.angle = 20}),
               *hyperfoam(1), foam);
  for (std::size_t i = 0; i < 8; ++i) {
    const double normal = std::pow(t[i] * z[i], -nu / (1 - nu)), J = t[i] * z[i] * normal;
    EXPECT_NEAR(values[i], 2 * mu / (alpha * J) * (std::pow(t[i], alpha) - std::pow(J, -alpha * beta)), 1e-10);
    EXPECT_NEAR(values[8 + i], 2 * mu / (alpha * J) * (std::pow(z[i], alpha) - std::pow(J, -alpha * beta)), 1e-10);
  }
}

// Hyperfoam keeps its volume in simple shear. With λ − 1/λ = γ: τ = dW/dγ = 2μ/α (λ^α − λ^−α)/(λ + 1/λ).
TEST(Compressible, ShearedHyperfoamHasItsClosedForm) {
  const std::vector<double> gammas{-0.8, -0.2, 0.1, 0.6, 1.5};
  const auto values = stresses(*make_test("simple_shear", "shear", gammas, {"shear_stress"}), *hyperfoam(1), foam);
  for (std::size_t i = 0; i < gammas.size(); ++i) {
    const double l = gammas[i] / 2 + std::sqrt(1 + gammas[i] * gammas[i] / 4);
    EXPECT_NEAR(values[i], 2 * mu / alpha * (std::pow(l, alpha) - std::pow(l, -alpha)) / (l + 1 / l), 1e-10);
  }
}

TEST(Compressible, ConfinedAndVolumetricCompressionHaveTheirClosedForms) {
  const std::vector<double> l = evenly(0.4, 1.3, 10);
  const auto confined =
      stresses(*make_test("confined_compression", "stretch", l, {"stress", "lateral_stress"}), *hyperfoam(1), foam);
  const auto pressure = stresses(*make_test("volumetric", "volume_ratio", l, {"pressure"}), *hyperfoam(1), foam);
  // Neo-Hooke with K/2 (J − 1)²: p = −K (J − 1), whatever μ.
  const double K = 40;
  const auto of_bulk = stresses(*make_test("volumetric", "volume_ratio", l, {"pressure"}),
                                *compressible(make_model("neo_hooke")), {7, 1 / K});
  for (std::size_t i = 0; i < l.size(); ++i) {
    const double back = std::pow(l[i], -alpha * beta);
    EXPECT_NEAR(confined[i], 2 * mu / (alpha * l[i]) * (std::pow(l[i], alpha) - back), 1e-10);
    EXPECT_NEAR(confined[l.size() + i], 2 * mu / (alpha * l[i]) * (1 - back), 1e-10);
    EXPECT_NEAR(pressure[i], -2 * mu / (alpha * l[i]) * (std::pow(l[i], alpha / 3) - back), 1e-10);
    EXPECT_NEAR(of_bulk[i], -K * (l[i] - 1), 1e-10);
  }
}

// Blatz and Ko's foam, W = μ/2 (I2/I3 + 2 √I3 − 5) with ν = 1/4: P = μ (λ2² − λ1^−3) with λ2 = λ1^(−1/4) … of W by
// differences, J = λ1^(1/2).
TEST(Compressible, BlatzKoFoamDoesTheWorkOfItsEnergy) {
  const auto energy = [](double l) {
    const double c = std::pow(l, -0.5), J = l * c;
    return 11.0 / 2 * (1 / (l * l) + 2 / c + 2 * J - 5);
  };
  const auto strip = make_strip(pressed, {"axial", {"stress"}, "first_piola_kirchhoff"});
  const Prediction found = predict(*strip, *make_model("blatz_ko"), {11, 0, 0.25});
  ASSERT_TRUE(found.status.ok()) << found.status.reason();
  for (std::size_t i = 0; i < pressed.size(); ++i) {
    const double h = 1e-4 * pressed[i];
    EXPECT_NEAR(found.values[i], (energy(pressed[i] + h) - energy(pressed[i] - h)) / (2 * h),
                2e-6 * (1 + std::abs(found.values[i])));
  }
}

struct Case {
  std::string name;
  std::unique_ptr<Model> model;
  std::vector<double> p;
};
std::vector<Case> cases() {
  std::vector<Case> all;
  const std::vector<double> wall{20, 0.1, 30, 1.2, 40};
  all.push_back({"foam", hyperfoam(2, "each"), {25, 6, 0.18, 8, -2, 0.3}});
  all.push_back({"blatz_ko", make_model("blatz_ko"), {11, 0.3, 0.25}});
  for (const char* law : {"quadratic", "logarithmic", "simo", "ogden"}) {
    for (const char* invariants : {"isochoric", "full"}) {
      std::vector<double> p = wall;
      p.push_back(0.02);
      all.push_back(
          {std::string("gho ") + invariants + " " + law, compressible(make_model("gho"), invariants, law), p});
    }
  }
  Options terms;
  terms.set("terms", std::string(R"([{"name": "m", "invariant": "I1", "law": "exponential"},
                                     {"name": "n", "invariant": "I2bar", "law": "linear"},
                                     {"name": "p", "invariant": "I1bar*I2bar", "law": "linear"},
                                     {"name": "f", "invariant": "fibrebar", "family": "diagonal", "law": "quadratic"},
                                     {"name": "v", "invariant": "J", "law": "ogden"},
                                     {"name": "w", "invariant": "J", "law": "power"}])"));
  all.push_back({"composed", make_model("composed", terms), {20, 1.5, 6, -2, 9, 35, 50, -2, 300, 4}});
  return all;
}

/// Every derivative of a test with central differences of fourth order.
void expect_derivatives(const Test& test, const Model& model, const std::vector<double>& p, double own,
                        const std::string& name) {
  const std::size_t rows = test.rows().count * test.rows().channels.size(), parameters = p.size();
  const bool has_own = !test.describe().parameters.empty();
  std::vector<double> values(rows), jacobian((parameters + has_own) * rows), along(rows * test.rows().abscissae.size());
  const auto at = [&](const std::vector<double>& q, double angle) {
    std::vector<double> found(rows);
    const Status status = test.predict({model, q, {&angle, has_own ? 1u : 0u}}, {found, {}, {}, {}});
    EXPECT_TRUE(status.ok()) << name << ": " << status.reason();
    return found;
  };
  const Status status = test.predict({model, p, {&own, has_own ? 1u : 0u}}, {values, jacobian, along, {}});
  ASSERT_TRUE(status.ok()) << name << ": " << status.reason();
  for (std::size_t j = 0; j < parameters + has_own; ++j) {
    const double h = 1e-4 * (j < parameters ? std::abs(p[j]) : 1);
    const auto shifted = [&](double steps) {
      std::vector<double> q = p;
      if (j < parameters) q[j] += steps * h;
      return at(q, own + (j < parameters ? 0 : steps * h));
    };
    const auto a = shifted(-2), b = shifted(-1), c = shifted(1), d = shifted(2);
    double scale = 1e-3;  // above the rounding of the differences
    for (std::size_t i = 0; i < rows; ++i) scale = std::max(scale, std::abs(jacobian[j * rows + i]));
    for (std::size_t i = 0; i < rows; ++i)
      EXPECT_NEAR(jacobian[j * rows + i], (a[i] - 8 * b[i] + 8 * c[i] - d[i]) / (12 * h), 2e-7 * scale)
          << name << ", parameter " << j << ", row " << i;
  }
  for (std::size_t k = 0; k < test.rows().abscissae.size(); ++k) {
    const auto shifted = [&](double step) {
      std::vector<std::vector<double>> columns;
      std::vector<std::span<const double>> spans;
      for (const auto& column : test.rows().abscissae) columns.emplace_back(column.values.begin(), column.values.end());
      for (double& x : columns[k]) x += step;
      for (const auto& column : columns) spans.emplace_back(column);
      std::vector<double> found(rows);
      EXPECT_TRUE(test.predict({model, p, {&own, has_own ? 1u : 0u}, spans}, {found, {}, {}, {}}).ok());
      return found;
    };
    const double h = 1e-4;
    const auto a = shifted(-2 * h), b = shifted(-h), c = shifted(h), d = shifted(2 * h);
    double scale = 1e-3;  // above the rounding of the differences
    for (std::size_t i = 0; i < rows; ++i) scale = std::max(scale, std::abs(along[k * rows + i]));
    for (std::size_t i = 0; i < rows; ++i)
      EXPECT_NEAR(along[k * rows + i], (a[i] - 8 * b[i] + 8 * c[i] - d[i]) / (12 * h), 2e-7 * scale)
          << name << ", abscissa " << k << ", row " << i;
  }
}

TEST(Compressible, DerivativesAreThoseOfDifferences) {
  const std::vector<double> t{0.93, 1.06, 1.17}, z{1.08, 0.96, 1.12};
  for (const Case& one : cases()) {
    for (const char* measure : {"cauchy", "first_piola_kirchhoff", "second_piola_kirchhoff"})
      expect_derivatives(*make_strip(t, {"circumferential", {"stress", "transverse_stretch", "volume_ratio"}, measure}),
                         *one.model, one.p, 7, one.name + ", strip");
    expect_derivatives(*make_strip(t, {"radial", {"stress", "normal_stretch"}}), *one.model, one.p, 0,
                       one.name + ", radial strip");
    expect_derivatives(*make_sheet("general", {{"stretch_circumferential", t}, {"stretch_axial", z}}, {.angle = 15}),
                       *one.model, one.p, 0, one.name + ", sheet");
    expect_derivatives(*make_test("simple_shear", "shear", {-0.3, 0.2, 0.5}, {"shear_stress", "normal_stress"}),
                       *one.model, one.p, 0, one.name + ", shear");
    expect_derivatives(*make_test("confined_compression", "stretch", {0.8, 0.95, 1.1}, {"stress", "lateral_stress"}),
                       *one.model, one.p, 0, one.name + ", confined");
  }
}

// J → 1: a bulk modulus of 10⁸ times the shear modulus leaves the incompressible strip and sheet to 1e-6.
TEST(Compressible, ALargeBulkModulusLeavesTheIncompressibleMaterial) {
  const std::vector<double> stretch = evenly(0.8, 1.25, 7), z = evenly(1.2, 0.9, 7), wall{20, 0.1, 30, 1.2, 40};
  std::vector<double> stiff = wall;
  stiff.push_back(1 / (1e8 * 20));
  const auto strip = make_strip(stretch, {"circumferential", {"stress", "transverse_stretch"}});
  const auto sheet = make_sheet("general", {{"stretch_circumferential", stretch}, {"stretch_axial", z}});
  for (const char* invariants : {"isochoric", "full"}) {
    const auto model = compressible(make_model("gho"), invariants);
    const auto near = predict(*strip, *model, stiff), exact = predict(*strip, *make_model("gho"), wall);
    ASSERT_TRUE(near.status.ok()) << near.status.reason();
    for (std::size_t i = 0; i < exact.values.size(); ++i)
      EXPECT_NEAR(near.values[i], exact.values[i], 1e-6 * (1 + std::abs(exact.values[i])));
    const auto loaded = stresses(*sheet, *model, stiff), bare = stresses(*sheet, *make_model("gho"), wall);
    for (std::size_t i = 0; i < bare.size(); ++i) EXPECT_NEAR(loaded[i], bare[i], 1e-6 * (1 + std::abs(bare[i])));
  }
}

// At compressibility 0 the base answers, bit for bit; the derivative there is that of a small compressibility.
TEST(Compressible, WithoutCompressibilityTheBaseAnswers) {
  const std::vector<double> stretch = evenly(0.85, 1.3, 9), wall{20, 0.1, 30, 1.2, 40};
  std::vector<double> null = wall, small = wall;
  null.push_back(0);
  small.push_back(1e-6);
  const auto model = compressible(make_model("gho"));
  const auto strip = make_strip(stretch, {"axial", {"stress", "transverse_stretch"}});
  const Prediction with = predict(*strip, *model, null), bare = predict(*strip, *make_model("gho"), wall);
  ASSERT_TRUE(with.status.ok() && bare.status.ok());
  EXPECT_EQ(with.values, bare.values);
  const Prediction exact = predict(*strip, *model, null, 0, true), near = predict(*strip, *model, small),
                   base = predict(*strip, *make_model("gho"), wall, 0, true);
  ASSERT_TRUE(exact.status.ok() && near.status.ok() && base.status.ok());
  const std::size_t rows = with.values.size();
  for (std::size_t i = 0; i < rows; ++i) {
    const double slope = (near.values[i] - bare.values[i]) / 1e-6;
    EXPECT_NEAR(exact.jacobian[5 * rows + i], slope, 1e-3 * (1e-3 + std::abs(slope)));
    for (std::size_t j = 0; j < 5; ++j)
      EXPECT_NEAR(exact.jacobian[j * rows + i], base.jacobian[j * rows + i],
                  1e-5 * (1e-2 + std::abs(base.jacobian[j * rows + i])));
  }
}

// Energies beside a compressible model leave it without stress at rest, but for a tone.
TEST(Compressible, AddedEnergiesLeaveNoStressAtRest) {
  const auto at_rest = [](const std::string& mechanism, double amplitude) {
    const auto& on_shelf = catalogue().mechanisms().at(mechanism);
    const auto model = plugins::wrap(on_shelf, hyperfoam(1), {});
    std::vector<double> p = foam, S(6);
    p.push_back(amplitude);
    for (std::size_t j = 1; j < on_shelf.factory.parameters.size(); ++j)
      p.push_back(on_shelf.factory.parameters[j].initial);
    const std::vector<double> rest{1, 1, 1, 0, 0, 0};
    EXPECT_TRUE(model->evaluate({1, rest, p, {}, {}}, {{}, S, {}, {}, {}}).ok());
    return S;
  };
  for (const double s : at_rest("second_invariant", 5)) EXPECT_NEAR(s, 0, 1e-12);
  for (const double s : at_rest("axial_fibres", 5)) EXPECT_NEAR(s, 0, 1e-12);
  const auto tone = at_rest("active_tone", 10);
  EXPECT_NEAR(tone[0], 10, 1e-12);
  for (std::size_t c = 1; c < 6; ++c) EXPECT_NEAR(tone[c], 0, 1e-12);
}

// A volume that nothing changes is the same after a permanent set.
TEST(Compressible, APermanentSetLeavesTheVolume) {
  const auto& on_shelf = catalogue().mechanisms().at("permanent_set");
  const auto strip = plugins::wrap(on_shelf, make_strip({1.1, 1.4, 1.2}, {"axial", {"stress", "volume_ratio"}}), {});
  std::vector<double> values(6);
  const std::vector<double> own{0, 0.3}, p{30};
  ASSERT_TRUE(strip->predict({*make_model("neo_hooke"), p, own}, {values, {}, {}, {}}).ok());
  for (std::size_t i = 3; i < 6; ++i) EXPECT_EQ(values[i], 1);
}

}  // namespace
}  // namespace tunica::testing::compressible_test
