// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "conformance/test_properties.hpp"
#include "support/sheet.hpp"
#include "support/strip.hpp"
#include "support/tensors_only.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

/// Set S of Canales et al. 2023: mu, kappa, k1, k2, theta.
const std::vector<double> set_s{18.668, 0.1367, 24.905, 0.2912, 46.44};
const std::vector<double> four_fibres{10, 20, 0.5, 40, 5, 0.3, 8, 0.7};
const std::vector<double> ogden{630, 1.3, 1.2, 5, -10, -2};

Columns both(const std::vector<double>& circumferential, const std::vector<double>& axial) {
  return {{"stretch_circumferential", circumferential}, {"stretch_axial", axial}};
}
Columns one(const std::vector<double>& stretch) { return {{"stretch", stretch}}; }

TEST(Biaxial, ReproducesAPointOfTheGhoComputedByHand) {
  // λt = 1.3, λz = 1.15: E = κ I1 + (1 − 3κ)(sin²θ λt² + cos²θ λz²) − 1 = 0.366954440721572 in both families, and
  // σ_a = 2 λ_a² [μ/2 + f (κ + (1 − 3κ) m_a)] − 2 λr² [μ/2 + f κ], f = 2 k1 E exp(k2 E²), m = (sin²θ, cos²θ); worked
  // out with 30 digits.
  const double circumferential = 49.5569466307162729, axial = 34.9683566853901807;
  const auto model = make_model("gho");
  const auto sheet = make_sheet("general", both({1.3}, {1.15}));
  const std::vector<double> values = stresses(*sheet, *model, set_s);
  EXPECT_NEAR(values[0] / circumferential, 1, 1e-9);
  EXPECT_NEAR(values[1] / axial, 1, 1e-9);
  // The same columns mapped in the other order, and the other measures.
  const Columns swapped{{"stretch_axial", {1.15}}, {"stretch_circumferential", {1.3}}};
  EXPECT_EQ(stresses(*make_sheet("general", swapped), *model, set_s), values);
  const auto nominal = stresses(*make_sheet("general", swapped, {.measure = "first_piola_kirchhoff"}), *model, set_s);
  EXPECT_NEAR(nominal[0] * 1.3 / circumferential, 1, 1e-9);
  EXPECT_NEAR(nominal[1] * 1.15 / axial, 1, 1e-9);
  const auto second = stresses(*make_sheet("general", swapped, {.measure = "second_piola_kirchhoff"}), *model, set_s);
  EXPECT_NEAR(second[0] * 1.3 * 1.3 / circumferential, 1, 1e-9);
  EXPECT_NEAR(second[1] * 1.15 * 1.15 / axial, 1, 1e-9);
}

TEST(Biaxial, ProtocolsAreSpecialCasesOfTheGeneralOne) {
  const auto model = make_model("four_fibre");
  const std::vector<double> stretch = evenly(0.9, 1.5, 9), rest(9, 1.0);
  const auto general = [&](const std::vector<double>& t, const std::vector<double>& z) {
    return stresses(*make_sheet("general", both(t, z)), *model, four_fibres);
  };
  const SheetSetup all{.channels = {"stress_circumferential", "stress_axial", "stress"}};
  const auto protocol = [&](const char* name, const char* direction) {
    SheetSetup setup = all;
    setup.direction = direction;
    return stresses(*make_sheet(name, one(stretch), setup), *model, four_fibres);
  };
  const auto equal = general(stretch, stretch), pulled_t = general(stretch, rest), pulled_z = general(rest, stretch);
  const auto equibiaxial = protocol("equibiaxial", "circumferential"),
             shear_t = protocol("pure_shear", "circumferential"), shear_z = protocol("pure_shear", "axial");
  for (std::size_t i = 0; i < 9; ++i) {
    for (const std::size_t k : {i, 9 + i}) {
      EXPECT_DOUBLE_EQ(equibiaxial[k], equal[k]);
      EXPECT_DOUBLE_EQ(shear_t[k], pulled_t[k]);
      EXPECT_DOUBLE_EQ(shear_z[k], pulled_z[k]);
    }
    EXPECT_DOUBLE_EQ(equibiaxial[18 + i], 0.5 * (equal[i] + equal[9 + i]));
    EXPECT_DOUBLE_EQ(shear_t[18 + i], pulled_t[i]);
    EXPECT_DOUBLE_EQ(shear_z[18 + i], pulled_z[9 + i]);
  }
}

TEST(Biaxial, DiagnosesTheNormalStretch) {
  const auto sheet = make_sheet("general", both({1.2, 1.5}, {1.1, 0.8}));
  std::vector<double> diagnostics(2);
  ASSERT_TRUE(sheet->predict({*make_model("gho"), set_s, {}}, {{}, {}, {}, diagnostics}).ok());
  EXPECT_EQ(sheet->describe().diagnostics, std::vector<std::string>{"normal_stretch"});
  EXPECT_NEAR(diagnostics[0], 1 / (1.2 * 1.1), 1e-15);
  EXPECT_NEAR(diagnostics[1], 1 / (1.5 * 0.8), 1e-15);
}

class BiaxialConformance : public ::testing::TestWithParam<std::tuple<const char*, const char*, TestProperty>> {};

TEST_P(BiaxialConformance, Holds) {
  const auto [protocol, measure, property] = GetParam();
  const bool general = std::string(protocol) == "general";
  const std::vector<double> stretch = evenly(1.05, 1.6, 25), other = evenly(1.3, 1.02, 25);
  SheetSetup setup{.channels = {"stress_axial", "stress_circumferential"}, .measure = measure};
  if (!general) setup.channels.push_back("stress");
  const auto sheet = make_sheet(protocol, general ? both(stretch, other) : one(stretch), setup);
  EXPECT_EQ(property.check({*sheet, *make_model("gho"), set_s, {}}).counter_example, "");
  EXPECT_EQ(property.check({*sheet, *make_model("four_fibre"), four_fibres, {}}).counter_example, "");
  EXPECT_EQ(property.check({*sheet, *make_model("ogden"), ogden, {}}).counter_example, "");
}

INSTANTIATE_TEST_SUITE_P(All, BiaxialConformance,
                         ::testing::Combine(::testing::Values("general", "equibiaxial", "pure_shear"),
                                            ::testing::Values("cauchy", "first_piola_kirchhoff",
                                                              "second_piola_kirchhoff"),
                                            ::testing::ValuesIn(test_properties())),
                         [](const auto& at) {
                           return fmt::format("{}_{}_{}", std::get<0>(at.param), std::get<1>(at.param),
                                              std::get<2>(at.param).name);
                         });

TEST(Biaxial, TensorsGiveWhatTheAxesGive) {
  const auto model = make_model("gho");
  const TensorsOnly tensors(make_model("gho"));
  const auto sheet =
      make_sheet("general", both(evenly(1, 1.6, 12), evenly(0.9, 1.2, 12)), {.measure = "first_piola_kirchhoff"});
  std::vector<double> values[2], jacobian[2], derivative[2];
  for (const std::size_t k : {0u, 1u}) {
    values[k].resize(24);
    jacobian[k].resize(5 * 24);
    derivative[k].resize(2 * 24);
    const Model& either = k == 0 ? *model : static_cast<const Model&>(tensors);
    ASSERT_TRUE(sheet->predict({either, set_s, {}}, {values[k], jacobian[k], derivative[k], {}}).ok());
  }
  for (std::size_t i = 0; i < 24; ++i) EXPECT_NEAR(values[0][i], values[1][i], 1e-11);
  for (std::size_t i = 0; i < 5 * 24; ++i) EXPECT_NEAR(jacobian[0][i], jacobian[1][i], 1e-10);
  for (std::size_t i = 0; i < 2 * 24; ++i) EXPECT_NEAR(derivative[0][i], derivative[1][i], 1e-10);
}

TEST(Biaxial, RelaxesAtConstantStretchAsTheClosedFormDoes) {
  // Held at once from rest, an isotropic sheet: σ(t) = (1 + g e^{−t/τ}) μ (λ² − 1/λ⁴).
  constexpr double mu = 12, g = 0.8, tau = 5, stretch = 1.4;
  const std::vector<double> time{0, 0.5, 2, 10, 200};
  const auto& viscoelasticity = catalogue().mechanisms().at("viscoelasticity");
  const auto viscous = plugins::wrap(viscoelasticity, make_model("neo_hooke"), {});
  const Columns held = one(std::vector<double>(5, stretch));
  const auto values = stresses(*make_sheet("equibiaxial", held, {.time = time}), *viscous, {mu, g, tau});
  const double equilibrium = mu * (std::pow(stretch, 2) - std::pow(stretch, -4));
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_NEAR(values[k], (1 + g * std::exp(-time[k % 5] / tau)) * equilibrium, 1e-9 * equilibrium) << k;
  for (const double stress : stresses(*make_sheet("equibiaxial", held), *viscous, {mu, g, tau}))
    EXPECT_NEAR(stress, equilibrium, 1e-10 * equilibrium);  // without a clock: at equilibrium
}

TEST(Biaxial, SaysThatPathsWithHistoryOnTensorsHaveNoJacobian) {
  const TensorsOnly viscous(plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), make_model("neo_hooke"), {}));
  std::vector<double> values(2), jacobian(6);
  const Status status =
      make_sheet("equibiaxial", one({1.1}))->predict({viscous, {{12, 0.8, 5}}, {}}, {values, jacobian, {}, {}});
  EXPECT_EQ(status.kind(), Status::Kind::failed);
  EXPECT_NE(status.reason().find("no exact Jacobian along the path"), std::string::npos);
}

TEST(Biaxial, OverflowAndUndefinedEnergiesAreAStatusThatNamesTheRow) {
  const auto sheet = make_sheet("equibiaxial", one({1.1, 2, 30}));
  EXPECT_EQ(overflow_is_a_status({*sheet, *make_model("gho"), {10, 0.1, 500, 100, 90}, {}}).counter_example, "");
  EXPECT_EQ(overflow_is_a_status({*sheet, *make_model("gent"), {300, 80}, {}}).counter_example, "");
  std::vector<double> values(6);
  const Status status = sheet->predict({*make_model("gent"), {{300, 80}}, {}}, {values, {}, {}, {}});
  EXPECT_NE(status.reason().find("row 3 (stretch 30"), std::string::npos) << status.reason();
}

std::string refusal(const char* protocol, const Columns& columns, const SheetSetup& setup = {}) {
  try {
    make_sheet(protocol, columns, setup);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}
#define EXPECT_SAYS(text, part) EXPECT_NE(std::string(text).find(part), std::string::npos) << (text)

TEST(Biaxial, RefusesColumnsThatDoNotFitTheProtocol) {
  const std::vector<double> v{1, 1.1};
  EXPECT_SAYS(refusal("general", {{"stretch_axial", v}}),
              "no column is mapped to 'stretch_circumferential', and the protocol 'general' needs both");
  EXPECT_SAYS(refusal("general", one(v)), "\"equibiaxial\" or \"pure_shear\", which need the one column 'stretch'");
  EXPECT_SAYS(refusal("general", {{"stretch_axial", v}, {"stretch_circumferential", v}, {"stretch", v}}),
              "'stretch', which the protocol 'general' has no use for");
  EXPECT_SAYS(refusal("equibiaxial", both(v, v)), "no column is mapped to 'stretch', which the protocol 'equibiaxial'");
  EXPECT_SAYS(refusal("pure_shear", {{"stretch", v}, {"stretch_axial", v}}),
              "mapped to 'stretch_axial', but the protocol 'pure_shear' has both stretches from 'stretch'");
  EXPECT_SAYS(refusal("general", both(v, v), {.channels = {"stress"}}),
              "map it to 'stress_circumferential' or 'stress_axial'");
}

TEST(Biaxial, RefusesRowsItCannotSimulate) {
  EXPECT_SAYS(refusal("general", both({1, 1.1}, {1, -0.2})), "row 2 has 'stretch_axial' -0.2");
  EXPECT_SAYS(refusal("equibiaxial", one({1, 1.1, 1.2}), {.time = {0, 2, 1}}),
              "time runs backwards at row 3; give the rows in the order in which they were measured");
  EXPECT_SAYS(refusal("equibiaxial", one({})), "there are no rows");
}

}  // namespace
}  // namespace tunica::testing
