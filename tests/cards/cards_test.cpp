// SPDX-License-Identifier: Apache-2.0
#include <functional>

#include <gmock/gmock.h>

#include "cards/card.hpp"
#include "cards/comment.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using cards::Target;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

namespace {

const cards::Material neo{.type = "neo_hooke", .values = {{"mu", 400}}};
const cards::Material yeoh{.type = "yeoh", .values = {{"c10", 180}, {"c20", -1.5}, {"c30", 0.05}}};
const cards::Material gent{.type = "gent", .values = {{"mu", 300}, {"Jm", 80}}};
const cards::Material ogden{.type = "ogden",
                            .values = {{"mu_1", 600}, {"alpha_1", 1.5}, {"mu_2", -10}, {"alpha_2", -2}}};
const cards::Material hgo{.type = "hgo", .values = {{"mu", 12}, {"k1", 20}, {"k2", 0.8}, {"theta", 30}}};
const cards::Material gho{.type = "gho",
                          .values = {{"mu", 12}, {"kappa", 0.1}, {"k1", 20}, {"k2", 0.8}, {"theta", 30}}};
const cards::Material dispersed{.type = "holzapfel_2015",
                                .values = {{"mu", 12}, {"A", 0.2}, {"B", 0.5}, {"k1", 20}, {"k2", 0.8}, {"theta", 30}}};

const cards::UnitSystem kilopascal = cards::unit_system("mm-mN-kPa");

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& problem) {
    return problem.what();
  }
  return "accepted";
}

std::string refused(Target target, const cards::Material& material, cards::CardSettings settings = {}) {
  return refusal([&] { (void)cards::write_card(target, material, settings); });
}

cards::Material switched(cards::Material material, const std::string& fibre_switch) {
  material.fibre_switch = fibre_switch;
  return material;
}

}  // namespace

TEST(Cards, ConvertParametersAsTheirPageSays) {
  // C10 = μ/2; K = 100 × 400 kPa, D1 = 2/K.
  EXPECT_THAT(cards::write_card(Target::calculix, neo, {.name = "R", .units = kilopascal, .bulk_ratio = 100}),
              EndsWith("*MATERIAL, NAME=R\n*HYPERELASTIC, NEO HOOKE\n200, 5e-05\n"));
  // Abaqus is incompressible by itself. 1 kPa = 0.001 MPa.
  EXPECT_THAT(cards::write_card(Target::abaqus, yeoh, {.name = "R"}),
              EndsWith("*HYPERELASTIC, YEOH\n0.18, -0.0015, 5e-05, 0, 0, 0\n"));
  // Theirs are ½ μ α: 450 and 10.
  EXPECT_THAT(cards::write_card(Target::abaqus, ogden, {.name = "R", .units = kilopascal}),
              EndsWith("*HYPERELASTIC, OGDEN, N=2\n450, 1.5, 10, -2, 0, 0\n"));
  EXPECT_THAT(cards::write_card(Target::abaqus, gho, {.name = "W", .units = kilopascal}),
              AllOf(HasSubstr("** 0.5, 0.866025403784439, 0\n** -0.5, 0.866025403784439, 0\n"),
                    EndsWith("*ANISOTROPIC HYPERELASTIC, HOLZAPFEL, LOCAL DIRECTIONS=2\n6, 0, 20, 0.8, 0.1\n")));
}

TEST(Cards, AreTheSameEveryTimeAndPlainAscii) {
  const cards::CardSettings settings{.remarks = {"Stability: λ3 falls, χ² = 3 – a remark that is longer than one line "
                                                 "and has a \n line break in it"}};
  const auto card = cards::write_card(Target::calculix, yeoh, settings);
  EXPECT_EQ(card, cards::write_card(Target::calculix, yeoh, settings));
  EXPECT_THAT(card, HasSubstr("** Stability: lambda3 falls, chi^2 = 3 - a remark"));
  for (const char c : card) EXPECT_LT(static_cast<unsigned char>(c), 0x80);
  std::istringstream lines(card);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 132U) << "what CalculiX reads of a line";
    EXPECT_TRUE(line.starts_with("**") || line.find("remark") == std::string::npos) << line;
  }
}

TEST(Cards, HoldTheirNumbersIn20Columns) {
  for (const double value : {-1.0 / 3 * 1e-9, -123456.789012345678, 2.0 / 3 * 1e12})
    EXPECT_LE(cards::number(value).size(), 20U) << value;
}

TEST(Cards, RefuseWhatAProgramCannotExpressWithTheReason) {
  EXPECT_THAT(refused(Target::calculix, gent),
              AllOf(HasSubstr("CalculiX cannot express the model 'gent'"), HasSubstr("limit of extension")));
  EXPECT_THAT(refused(Target::abaqus, gent), HasSubstr("Abaqus cannot express the model 'gent'"));
  EXPECT_THAT(refused(Target::calculix, gho), HasSubstr("no dispersion"));
  EXPECT_THAT(refused(Target::calculix, dispersed), HasSubstr("no dispersion"));
  EXPECT_THAT(refused(Target::abaqus, dispersed), AllOf(HasSubstr("normal of the wall"), HasSubstr("--subroutine")));
  EXPECT_THAT(refused(Target::calculix, switched(hgo, "none")), HasSubstr("fibre_switch is 'none'"));
  EXPECT_THAT(refused(Target::abaqus, switched(gho, "stretch")), HasSubstr("fibre_switch is 'stretch'"));
  EXPECT_EQ(refused(Target::abaqus, switched(hgo, "stretch")), "accepted") << "the same without dispersion";
  const cards::Material four{.type = "four_fibre",
                             .values = {{"mu", 12},
                                        {"k1", 20},
                                        {"k2", 0.8},
                                        {"theta", 30},
                                        {"k1_axial", 5},
                                        {"k2_axial", 1},
                                        {"k1_circumferential", 6},
                                        {"k2_circumferential", 1}}};
  EXPECT_THAT(refused(Target::abaqus, four), HasSubstr("one k1 and one k2 for all families"));
  cards::Material many{.type = "ogden"};
  for (const char k : {'1', '2', '3', '4'}) {
    many.values[std::string("mu_") + k] = 1;
    many.values[std::string("alpha_") + k] = 2;
  }
  EXPECT_THAT(refused(Target::calculix, many), HasSubstr("3 terms at most, and these are 4"));
  EXPECT_EQ(refused(Target::abaqus, many), "accepted");
  EXPECT_THAT(refused(Target::ansys, hgo), AllOf(HasSubstr("Ansys cannot express"), HasSubstr("no documented switch")));
  EXPECT_THAT(refused(Target::lsdyna, gho, {.density = 1000}), HasSubstr("*MAT_295"));
  EXPECT_THAT(refused(Target::lsdyna, gent, {.density = 1000}), HasSubstr("limit of extension"));
  EXPECT_THAT(refused(Target::febio, dispersed), HasSubstr("normal of the wall"));
  EXPECT_THAT(refused(Target::febio, switched(hgo, "none")), HasSubstr("fibre_switch is 'none'"));
  EXPECT_THAT(refused(Target::febio, switched(gho, "stretch")), HasSubstr("fibre_switch is 'stretch'"));
  EXPECT_THAT(refused(Target::calculix, {.type = "demiray"}), HasSubstr("no card is known for the model 'demiray'"));
}

TEST(Cards, ARefusalNamesOnlyProgramsThatTakeThisModel) {
  const std::vector<std::pair<std::string, Target>> programs = {
      {"FEBio", Target::febio}, {"Ansys", Target::ansys}, {"CalculiX", Target::calculix}, {"LS-DYNA", Target::lsdyna}};
  std::size_t refusals = 0;
  for (const auto& material : {gent, gho, hgo, dispersed, switched(hgo, "none"), switched(gho, "stretch"),
                               switched(dispersed, "none"), switched(gho, "none")})
    for (const auto& entry : cards::target_codes) {
      const std::string said = refused(entry.value, material, {.density = 1000});
      if (said == "accepted") continue;
      ++refusals;
      const std::string advice = said.substr(said.find("; ") + 2);
      EXPECT_THAT(advice, Not(IsEmpty())) << said;
      for (const auto& [name, target] : programs)
        EXPECT_EQ(advice.find(name) != std::string::npos,
                  target != entry.value && refused(target, material, {.density = 1000}) == "accepted")
            << said << " and " << name;
    }
  EXPECT_GT(refusals, 15U);
  EXPECT_THAT(refused(Target::ansys, gho), HasSubstr("export for FEBio or Abaqus"));
  EXPECT_THAT(refused(Target::ansys, dispersed), HasSubstr("; export for Abaqus with --subroutine"));
}

TEST(Cards, OfDispersionZeroAreThoseOfAlignedFibres) {
  cards::Material aligned = gho;
  aligned.values["kappa"] = 0;
  EXPECT_EQ(cards::write_card(Target::calculix, aligned), cards::write_card(Target::calculix, hgo));
}

TEST(Cards, RefuseSettingsAndParametersThatAreNotUsable) {
  EXPECT_THAT(refused(Target::calculix, neo, {.name = "1\n*STEP"}),
              HasSubstr("name of the material: found '1\\n*STEP'"));
  EXPECT_THAT(refused(Target::calculix, neo, {.bulk_ratio = 0}), HasSubstr("CalculiX needs a bulk modulus"));
  EXPECT_THAT(refused(Target::febio, neo, {.bulk_ratio = 0}), HasSubstr("FEBio needs a bulk modulus"));
  EXPECT_THAT(refused(Target::lsdyna, neo), HasSubstr("a card of LS-DYNA has a density"));
  EXPECT_THAT(refused(Target::lsdyna, neo, {.bulk_ratio = 1e9, .density = 1000}), HasSubstr("ten columns"));
  EXPECT_THAT(refused(Target::febio, neo, {.density = -1}), HasSubstr("density: found -1 kg/m3"));
  EXPECT_THAT(refused(Target::febio, gho, {.subroutine = true}), HasSubstr("for fibre models in Abaqus"));
  EXPECT_THAT(refused(Target::abaqus, neo, {.subroutine = true}), HasSubstr("this is 'neo_hooke' for Abaqus"));
  EXPECT_THAT(refused(Target::abaqus, neo, {.bulk_ratio = -1}), HasSubstr("bulk ratio: found -1"));
  // CalculiX takes D1 < 1e-10 for zero.
  EXPECT_THAT(refused(Target::calculix, neo, {.units = cards::unit_system("m-N-Pa"), .bulk_ratio = 1e6}),
              HasSubstr("CalculiX takes what is below 1e-10 for 0"));
  EXPECT_THAT(refused(Target::calculix, {.type = "yeoh", .values = {{"c10", 1}}}),
              HasSubstr("the parameter 'c20' has no value, only c10"));
  EXPECT_THAT(refused(Target::calculix, {.type = "neo_hooke", .values = {{"mu", -1}}}),
              HasSubstr("found a shear modulus of -1 kPa at rest"));
  EXPECT_THAT(refused(Target::calculix, {.type = "neo_hooke", .values = {{"mu", NAN}}}), HasSubstr("finite number"));
  EXPECT_THAT(refused(Target::calculix, {.type = "ogden", .values = {{"mu_1", 1}, {"alpha_1", 0}}}),
              HasSubstr("the exponent alpha_1 is 0"));
  EXPECT_THAT(refusal([] { (void)cards::target_of("calculx"); }), HasSubstr("Did you mean 'calculix'?"));
}

TEST(Units, OfCardsAreConsistent) {
  EXPECT_DOUBLE_EQ(cards::unit_system("mm-N-MPa").stress_per_kPa, 1e-3);
  EXPECT_DOUBLE_EQ(cards::unit_system("m-N-Pa").stress_per_kPa, 1e3);
  EXPECT_DOUBLE_EQ(cards::unit_system("um-nN-kPa").stress_per_kPa, 1);
  EXPECT_NEAR(cards::unit_system("in-lbf-psi").stress_per_kPa, 0.1450377377, 1e-9);
  EXPECT_THAT(refusal([] { (void)cards::unit_system("mm-N-kPa"); }),
              AllOf(HasSubstr("N over the square of mm is 1000 kPa"), HasSubstr("mm-N-MPa")));
  EXPECT_THAT(refusal([] { (void)cards::unit_system("SI"); }), HasSubstr("expected length-force-stress"));
  EXPECT_THAT(refusal([] { (void)cards::unit_system("mm-parsnip-MPa"); }), HasSubstr("parsnip"));
}
