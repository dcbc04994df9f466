// SPDX-License-Identifier: Apache-2.0
// Fung's exponential: the formula by tensors, published coefficients, and closed forms of strips, sheets and shear.
#include <cmath>

#include <gtest/gtest.h>

#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"
#include "support/sheet.hpp"
#include "support/strip.hpp"

namespace tunica::testing::fung_test {
using namespace conformance;
namespace {

std::unique_ptr<Model> fung(const std::string& form) {
  Options options;
  options.set("form", form);
  return make_model("fung", options);
}

/// Chuong & Fung 1983, carotid artery of a rabbit: c in kPa, a1 to a6.
const std::vector<double> carotid{22.4, 1.0672, 0.4775, 0.0499, 0.0903, 0.0585, 0.0042};

/// a1 to a9 of any form from its parameters, behind c.
std::vector<double> coefficients(const std::string& form, const std::vector<double>& p) {
  std::vector<double> a = form == "plane" ? std::vector{p[0], p[1], p[2], 0.0, p[3], 0.0, 0.0} : p;
  if (form != "wall_with_shear")
    a.insert(a.end(), {(a[1] + a[2]) / 2 - a[4], (a[2] + a[3]) / 2 - a[5], (a[3] + a[1]) / 2 - a[6]});
  return a;
}

TEST(Fung, EnergyIsTheFormulaInEveryForm) {
  for (const std::string form : {"plane", "wall", "wall_with_shear"}) {
    const auto model = fung(form);
    Sampler sampler(23);
    for (int draw = 0; draw < 40; ++draw) {
      const auto [C, p] = sampler.point(*model);
      const std::vector<double> a = coefficients(form, p);
      const Matrix E = (to_matrix(C) - Matrix::Identity()) / 2;  // axes t, z, r
      const double Q = a[1] * E(0, 0) * E(0, 0) + a[2] * E(1, 1) * E(1, 1) + a[3] * E(2, 2) * E(2, 2) +
                       2 * (a[4] * E(0, 0) * E(1, 1) + a[5] * E(1, 1) * E(2, 2) + a[6] * E(2, 2) * E(0, 0)) +
                       2 * (a[7] * E(0, 1) * E(0, 1) + a[8] * E(1, 2) * E(1, 2) + a[9] * E(2, 0) * E(2, 0));
      const double expected = a[0] / 2 * std::expm1(Q);
      EXPECT_NEAR(evaluate(*model, C, p).energy, expected, 1e-11 * std::max(1.0, std::abs(expected))) << form;
    }
  }
}

// Seed 20230211, the same on every run: the outcome is deterministic.
TEST(Fung, KeepsEveryPropertyOfAModelInEveryForm) {
  for (const std::string form : {"plane", "wall", "wall_with_shear"})
    for (const ModelProperty& property : model_properties())
      EXPECT_EQ(property.check(*fung(form), 20230211).counter_example, "") << form << ", " << property.name;
}

// σ_t = c e^Q [λt² (a1 E_t + a4 E_z + a6 E_r) − λr² (a3 E_r + a5 E_z + a6 E_t)], and so on with t and z exchanged.
TEST(Fung, StretchesASheetAsChuongAndFungWrite) {
  const double lt = 1.4, lz = 1.2, lr = 1 / (lt * lz);
  const auto E = [](double l) { return (l * l - 1) / 2; };
  const auto& a = carotid;
  const double Et = E(lt), Ez = E(lz), Er = E(lr),
               Q = a[1] * Et * Et + a[2] * Ez * Ez + a[3] * Er * Er +
                   2 * (a[4] * Et * Ez + a[5] * Ez * Er + a[6] * Er * Et),
               scale = a[0] * std::exp(Q), r = lr * lr * (a[3] * Er + a[5] * Ez + a[6] * Et);
  const auto sheet = make_sheet("general", {{"stretch_circumferential", {lt}}, {"stretch_axial", {lz}}});
  const std::vector<double> found = stresses(*sheet, *fung("wall"), carotid);
  EXPECT_NEAR(found[0], scale * (lt * lt * (a[1] * Et + a[4] * Ez + a[6] * Er) - r), 1e-11);
  EXPECT_NEAR(found[1], scale * (lz * lz * (a[2] * Ez + a[4] * Et + a[5] * Er) - r), 1e-11);
}

// Without radial strain the lateral face is free where a2 E_z + a4 E_t = 0, whatever the exponential.
TEST(Fung, NarrowsAStripByItsProductTerm) {
  const std::vector<double> p{15, 1.1, 0.6, 0.2}, stretch{1.05, 1.2, 1.5};
  const auto strip = make_strip(stretch, {.channels = {"transverse_stretch", "stress"}});
  const Prediction found = predict(*strip, *fung("plane"), p);
  ASSERT_TRUE(found.status.ok()) << found.status.reason();
  for (std::size_t i = 0; i < stretch.size(); ++i) {
    const double Et = (stretch[i] * stretch[i] - 1) / 2, Ez = -p[3] / p[2] * Et,
                 Q = p[1] * Et * Et + p[2] * Ez * Ez + 2 * p[3] * Et * Ez;
    EXPECT_NEAR(found.values[i], std::sqrt(1 + 2 * Ez), 1e-9);
    EXPECT_NEAR(found.values[3 + i], stretch[i] * stretch[i] * p[0] * std::exp(Q) * (p[1] * Et + p[3] * Ez), 1e-8);
  }
}

// Small shear γ: W = c/2 · 2 a7 (γ/2)², so that the modulus is c a7/2 in the plane t, z, and so on.
TEST(Fung, ResistsShearInEveryPlane) {
  const double gamma = 1e-4;
  for (const std::string form : {"plane", "wall", "wall_with_shear"}) {
    std::vector<double> p{20, 1, 0.6, 0.3, 0.1, 0.05, 0.02, 0.7, 0.9, 1.3};
    if (form == "plane") p = {20, 1, 0.6, 0.1};
    if (form == "wall") p.resize(7);
    const std::vector<double> a = coefficients(form, p);
    for (std::size_t k = 0; k < 3; ++k) {
      Tensor C{1, 1, 1, 0, 0, 0};
      C[3 + k] = gamma;
      EXPECT_NEAR(evaluate(*fung(form), C, p).stress[3 + k], a[0] * a[7 + k] / 2 * gamma, 1e-10) << form << k;
    }
  }
  // The published coefficients are those of a material that resists.
  for (std::size_t k = 7; k < 10; ++k) EXPECT_GT(coefficients("wall", carotid)[k], 0.2);
}

// a1 = a2 = 2 a4: one shear modulus G in all planes, and Young's modulus 3 G in both directions.
TEST(Fung, IsIsotropicForSmallStrainsWhereItsCoefficientsAreEven) {
  const double modulus = 10, strain = 1e-5;
  const std::vector<double> p{modulus, 2, 2, 1};
  for (std::size_t k = 3; k < 6; ++k) {
    Tensor C{1, 1, 1, 0, 0, 0};
    C[k] = strain;
    EXPECT_NEAR(evaluate(*fung("plane"), C, p).stress[k] / strain, modulus / 2, 1e-6);
  }
  for (const char* direction : {"circumferential", "axial"}) {
    const Prediction found = predict(*make_strip({1 + strain}, {.direction = direction}), *fung("plane"), p);
    EXPECT_NEAR(found.values[0] / strain, 3 * modulus / 2, 1e-3);
  }
}

TEST(Fung, SaysWhatIsAdmissible) {
  const auto values = [](const std::string& form, const std::vector<double>& p) {
    std::vector<double> all;
    const auto model = fung(form);
    for (const Combination& one : model->describe().admissible) all.push_back(one.value(p));
    return all;
  };
  EXPECT_NEAR(values("plane", {20, 1, 0.6, 0.1}).at(0), 0.59, 1e-14);
  EXPECT_LT(values("plane", {20, 1, 0.6, 0.8}).at(0), 0);
  Matrix A;  // the determinant by Eigen
  A << carotid[1], carotid[4], carotid[6], carotid[4], carotid[2], carotid[5], carotid[6], carotid[5], carotid[3];
  EXPECT_NEAR(values("wall", carotid).at(1), A.determinant(), 1e-15);
  EXPECT_GT(values("wall", carotid).at(1), 0);
}

TEST(Fung, SaysWhichParametersAnAdmissibleCombinationIsOf) {
  for (const std::string form : {"plane", "wall", "wall_with_shear"}) {
    const auto model = fung(form);
    const ModelDescription& description = model->describe();
    const auto names_of = [&](const Combination& combination) {
      std::vector<std::string> names;
      for (const std::size_t index : combination.arguments) names.push_back(description.parameters.at(index).name);
      return names;
    };
    ASSERT_EQ(description.admissible.size(), form == "plane" ? 1u : 2u);
    EXPECT_EQ(names_of(description.admissible[0]), (std::vector<std::string>{"a1", "a2", "a4"})) << form;
    if (form == "plane") continue;
    EXPECT_EQ(names_of(description.admissible[1]), (std::vector<std::string>{"a1", "a2", "a3", "a4", "a5", "a6"}));
  }
}

}  // namespace
}  // namespace tunica::testing::fung_test
