// SPDX-License-Identifier: Apache-2.0
// What each model says of its parameters: names and units of experiment files, starts that are published values or the
// order of magnitude of the material, bounds that no fit of such a material should meet.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/loaded.hpp"

namespace tunica::testing::declared_parameters_test {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> declared(const std::string& type, const std::string& option = "",
                                  const std::string& value = "") {
  Options options;
  if (!option.empty()) options.set(option, value);
  const auto model = make_model(type, options);
  EXPECT_EQ(model->describe().type, type);
  std::vector<std::string> all;
  for (const Parameter& one : model->describe().parameters)
    all.push_back(fmt::format("{} = {} {} in [{:.6g}, {:.6g}]{}", one.name, one.initial, one.unit, one.min, one.max,
                              one.scale == Scale::log ? ", log" : ""));
  return all;
}

const std::string mu = "mu = 10 kPa in [0.1, 200], log", k1 = "k1 = 10 kPa in [0.01, 1000], log",
                  k2 = "k2 = 1 1 in [0.001, 100], log", theta = "theta = 45 deg in [0, 90]";

TEST(DeclaredParameters, OfArteries) {
  EXPECT_THAT(declared("hgo"), ElementsAre(mu, k1, k2, theta));
  EXPECT_THAT(declared("gho"), ElementsAre(mu, "kappa = 0.1 1 in [0, 0.333333]", k1, k2, theta));
  EXPECT_THAT(declared("holzapfel_2015"),
              ElementsAre(mu, "A = 0.2 1 in [0, 0.333333]", "B = 0.4 1 in [0, 1]", k1, k2, theta));
  EXPECT_THAT(
      declared("four_fibre"),
      ElementsAre(mu, k1, k2, theta, "k1_axial = 10 kPa in [0.01, 1000], log", "k2_axial = 1 1 in [0.001, 100], log",
                  "k1_circumferential = 10 kPa in [0.01, 1000], log", "k2_circumferential = 1 1 in [0.001, 100], log"));
}

/// A family along an axis is not of the paper that the diagonal pair is of.
TEST(DeclaredParameters, OfFourFibresSayWhereEachFamilyIsFrom) {
  const auto model = make_model("four_fibre");
  const auto& all = model->describe().parameters;
  ASSERT_EQ(all.size(), 8u);
  for (std::size_t j = 4; j < 8; ++j) EXPECT_THAT(all[j].reference, ::testing::HasSubstr("Baek")) << all[j].name;
  EXPECT_THAT(all[1].reference, ::testing::Not(::testing::HasSubstr("Baek")));
}

TEST(DeclaredParameters, OfFungInEveryForm) {
  const auto square = [](const char* name, const char* start) {
    return fmt::format("{} = {} 1 in [0.001, 100], log", name, start);
  };
  const auto product = [](const char* name) { return fmt::format("{} = 0.1 1 in [-10, 100]", name); };
  const std::string c = "c = 20 kPa in [0.01, 10000], log", a1 = square("a1", "1"), a2 = square("a2", "0.5"),
                    a3 = square("a3", "0.1");
  EXPECT_THAT(declared("fung"), ElementsAre(c, a1, a2, product("a4")));
  EXPECT_THAT(declared("fung", "form", "wall"),
              ElementsAre(c, a1, a2, a3, product("a4"), product("a5"), product("a6")));
  EXPECT_THAT(declared("fung", "form", "wall_with_shear"),
              ElementsAre(c, a1, a2, a3, product("a4"), product("a5"), product("a6"), square("a7", "1"),
                          square("a8", "1"), square("a9", "1")));
}

/// Holzapfel, Ogden 2009, table 1: simple shear of myocardium.
TEST(DeclaredParameters, OfMyocardiumBeginWithThePublishedOnes) {
  const auto stiffness = [](const char* name, const char* start) {
    return fmt::format("{} = {} kPa in [0.001, 1000], log", name, start);
  };
  const auto rate = [](const char* name, const char* start) {
    return fmt::format("{} = {} 1 in [0.001, 100], log", name, start);
  };
  EXPECT_THAT(declared("holzapfel_ogden"),
              ElementsAre(stiffness("a", "0.059"), rate("b", "8.023"), stiffness("a_f", "18.472"),
                          rate("b_f", "16.026"), stiffness("a_s", "2.481"), rate("b_s", "11.12"),
                          stiffness("a_fs", "0.216"), rate("b_fs", "11.436"), "theta = 90 deg in [0, 180]"));
}

/// Treloar's rubber: 390 kPa, of Ogden 1972 with his own three terms.
TEST(DeclaredParameters, OfRubber) {
  EXPECT_THAT(declared("neo_hooke"), ElementsAre("mu = 100 kPa in [0.1, 100000], log"));
  EXPECT_THAT(declared("mooney_rivlin"), ElementsAre("c10 = 150 kPa in [0, 10000]", "c01 = 15 kPa in [0, 10000]"));
  EXPECT_THAT(declared("yeoh"), ElementsAre("c10 = 150 kPa in [0.05, 100000], log", "c20 = 0 kPa in [-1000, 1000]",
                                            "c30 = 0.1 kPa in [-100, 100]"));
  EXPECT_THAT(declared("gent"), ElementsAre("mu = 300 kPa in [0.1, 100000], log", "Jm = 100 1 in [0.1, 10000], log"));
  EXPECT_THAT(declared("arruda_boyce"),
              ElementsAre("mu = 270 kPa in [0.1, 100000], log", "N = 26.5 1 in [1.05, 10000], log"));
  EXPECT_THAT(declared("ogden"), ElementsAre("mu_1 = 630 kPa in [-5000, 5000]", "alpha_1 = 1.3 1 in [-30, 30]",
                                             "mu_2 = 1.2 kPa in [-5000, 5000]", "alpha_2 = 5 1 in [-30, 30]",
                                             "mu_3 = -10 kPa in [-5000, 5000]", "alpha_3 = -2 1 in [-30, 30]"));
}

}  // namespace
}  // namespace tunica::testing::declared_parameters_test
