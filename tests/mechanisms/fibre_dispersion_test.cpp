// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deformations.hpp"
#include "shelf.hpp"

namespace tunica::fibre_dispersion_test {
namespace {

using testing::evaluate;
using testing::model;
using testing::random_deformations;
using testing::relative_difference;
using testing::wrapped;

// hgo: mu, k1, k2, theta, kappa behind; gho: mu, kappa, k1, k2, theta.
const std::vector<double> on_hgo{18.668, 24.905, 0.2912, 46.44, 0.1367};
const std::vector<double> on_gho{18.668, 0.1367, 24.905, 0.2912, 46.44};
constexpr std::size_t gho_position[] = {0, 2, 3, 4, 1};

class OnFibreSwitch : public ::testing::TestWithParam<const char*> {};

TEST_P(OnFibreSwitch, DispersionOfHgoIsGho) {
  const auto dispersed = wrapped("fibre_dispersion", model("hgo", GetParam()));
  const auto gho = model("gho", GetParam());
  const std::vector<double> C = random_deformations(100, 1);
  const auto a = evaluate(*dispersed, C, on_hgo, {.stress_dp = true});
  const auto b = evaluate(*gho, C, on_gho, {.stress_dp = true});
  EXPECT_LE(relative_difference(a.energy, b.energy), 1e-14);
  EXPECT_LE(relative_difference(a.stress, b.stress), 1e-14);
  EXPECT_LE(relative_difference(a.tangent, b.tangent), 1e-14);
  const std::size_t row = 6 * 100;
  for (std::size_t j = 0; j < 5; ++j) {
    const auto mine = a.stress_dp.begin() + static_cast<std::ptrdiff_t>(j * row);
    const auto theirs = b.stress_dp.begin() + static_cast<std::ptrdiff_t>(gho_position[j] * row);
    EXPECT_LE(relative_difference({mine, mine + row}, {theirs, theirs + row}), 1e-14) << "parameter " << j;
  }
}

INSTANTIATE_TEST_SUITE_P(FibreDispersion, OnFibreSwitch, ::testing::Values("strain", "stretch", "none"));

struct Axes {
  std::vector<double> energy, gradient, hessian, gradient_dp;
};

Axes evaluate_axes(const Model& model, const std::vector<double>& c, const std::vector<double>& parameters,
                   bool derivatives) {
  const std::size_t n = c.size() / 3;
  Axes r{std::vector<double>(n), std::vector<double>(3 * n), std::vector<double>(6 * n), {}};
  if (derivatives) r.gradient_dp.resize(3 * n * parameters.size());
  const Status status = model.evaluate_axes({n, c, parameters}, {r.energy, r.gradient, r.hessian, r.gradient_dp});
  EXPECT_TRUE(status.ok()) << status.reason();
  return r;
}

const std::vector<double> squared_stretches{1.44, 1, 2.25, 0.81, 1, 0.7, 0.86, 1, 0.64};

TEST(FibreDispersion, EqualsGhoOnThePrincipalAxesPathToo) {
  const auto dispersed = wrapped("fibre_dispersion", model("hgo"));
  const auto gho = model("gho");
  ASSERT_TRUE(dispersed->describe().principal_axes);
  const Axes a = evaluate_axes(*dispersed, squared_stretches, on_hgo, true);
  const Axes b = evaluate_axes(*gho, squared_stretches, on_gho, true);
  EXPECT_LE(relative_difference(a.energy, b.energy), 1e-14);
  EXPECT_LE(relative_difference(a.gradient, b.gradient), 1e-14);
  EXPECT_LE(relative_difference(a.hessian, b.hessian), 1e-14);
  const std::vector<double> by_kappa(a.gradient_dp.begin() + 4 * 9, a.gradient_dp.end());
  const std::vector<double> gho_by_kappa(b.gradient_dp.begin() + 9, b.gradient_dp.begin() + 18);
  EXPECT_LE(relative_difference(by_kappa, gho_by_kappa), 1e-14);
}

TEST(FibreDispersion, IsTheBareModelAtTheNullBitForBit) {
  const auto bare = model("hgo");
  const auto dispersed = wrapped("fibre_dispersion", model("hgo"));
  const std::vector<double> bare_parameters(on_hgo.begin(), on_hgo.end() - 1);
  std::vector<double> at_null = on_hgo;
  at_null.back() = 0;
  const std::vector<double> C = random_deformations(70, 2);
  for (const bool derivatives : {false, true}) {
    const auto a = evaluate(*dispersed, C, at_null, {.stress_dp = derivatives});
    const auto b = evaluate(*bare, C, bare_parameters, {.stress_dp = derivatives});
    EXPECT_EQ(a.energy, b.energy);
    EXPECT_EQ(a.stress, b.stress);
    EXPECT_EQ(a.tangent, b.tangent);
    EXPECT_EQ(
        std::vector<double>(a.stress_dp.begin(), a.stress_dp.begin() + static_cast<std::ptrdiff_t>(b.stress_dp.size())),
        b.stress_dp);
    EXPECT_EQ(evaluate_axes(*dispersed, squared_stretches, at_null, derivatives).hessian,
              evaluate_axes(*bare, squared_stretches, bare_parameters, derivatives).hessian);
  }
}

TEST(FibreDispersion, DerivativeAtTheNullIsThatOfTheFormula) {
  const auto dispersed = wrapped("fibre_dispersion", model("hgo", "none"));
  std::vector<double> parameters = on_hgo;
  parameters.back() = 0;
  const std::vector<double> C = random_deformations(20, 3);
  const auto at_null = evaluate(*dispersed, C, parameters, {.stress_dp = true});
  // Second-order one-sided difference: (4 S(h) − S(2h) − 3 S(0)) / 2h.
  constexpr double h = 1e-5;
  parameters.back() = h;
  const auto near = evaluate(*dispersed, C, parameters);
  parameters.back() = 2 * h;
  const auto far = evaluate(*dispersed, C, parameters);
  std::vector<double> difference(120);
  for (std::size_t i = 0; i < 120; ++i)
    difference[i] = (4 * near.stress[i] - far.stress[i] - 3 * at_null.stress[i]) / (2 * h);
  EXPECT_LE(relative_difference({at_null.stress_dp.end() - 120, at_null.stress_dp.end()}, difference), 1e-7);
}

TEST(FibreDispersion, PutsItsParameterBehindThoseOfTheModel) {
  const auto dispersed = wrapped("fibre_dispersion", model("hgo"));
  const auto& parameters = dispersed->describe().parameters;
  ASSERT_EQ(parameters.size(), 5u);
  EXPECT_EQ(parameters.back().name, "kappa");
  EXPECT_EQ(parameters.back().min, 0);
  EXPECT_DOUBLE_EQ(parameters.back().max, 1. / 3);
  ASSERT_EQ(dispersed->parts().size(), 2u);
  EXPECT_EQ(dispersed->parts()[1]->describe().name, "fibres");
}

std::string refusal(const std::string& type) {
  try {
    wrapped("fibre_dispersion", model(type));
  } catch (const InputError& problem) {
    return problem.what();
  }
  return "accepted";
}

TEST(FibreDispersion, RefusesModelsThatAreDispersedAlready) {
  using ::testing::EndsWith;
  using ::testing::StartsWith;
  for (const char* type : {"gho", "holzapfel_2015"}) {
    EXPECT_THAT(refusal(type), StartsWith("plugin 'fibre_dispersion "));
    EXPECT_THAT(refusal(type),
                EndsWith(std::string("fibre_dispersion: the fibres of model '") + type +
                         "' (part 'fibres') are dispersed already; expected a model with aligned fibres, for example "
                         "hgo; use the model's own dispersion parameters, or take the mechanism out"));
  }
  EXPECT_EQ(refusal("hgo"), "accepted");
}

TEST(FibreDispersion, RefusesModelsWithoutFibres) {
  EXPECT_THAT(refusal("neo_hooke"),
              ::testing::EndsWith("model 'neo_hooke' has no fibre parts to disperse; expected a model with fibres, for "
                                  "example hgo; take the mechanism out or choose another model"));
}

}  // namespace
}  // namespace tunica::fibre_dispersion_test
