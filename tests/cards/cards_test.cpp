// SPDX-License-Identifier: Apache-2.0
#include <functional>

#include <gmock/gmock.h>

#include "cards/card.hpp"
#include "cards/comment.hpp"
#include "cards/given.hpp"
#include "plugins/guarded.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using cards::Target;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using tunica::testing::Given;
using tunica::testing::material;
using tunica::testing::option;

namespace {

/// A pair at ±30 degrees.
FibreEnergy fibres(double A, double B, EnergyPart::Active active = EnergyPart::Active::argument_positive) {
  return {12, {{30, 20, 0.8, A, B}, {-30, 20, 0.8, A, B}}, active};
}

const cards::Material neo{.type = "neo_hooke", .energy = PolynomialEnergy{{{1, 0, 200}}}};
const cards::Material yeoh{.type = "yeoh", .energy = PolynomialEnergy{{{1, 0, 180}, {2, 0, -1.5}, {3, 0, 0.05}}}};
const cards::Material gent{.type = "gent", .energy = LimitedChainEnergy{300, 80}};
const cards::Material ogden{.type = "ogden", .energy = StretchEnergy{{{600, 1.5}, {-10, -2}}}};
const cards::Material hgo{.type = "hgo", .energy = fibres(0, 1)};
const cards::Material gho{.type = "gho", .energy = fibres(0.1, 0.7)};
const cards::Material dispersed{.type = "holzapfel_2015", .energy = fibres(0.2, 0.5)};

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
  std::get<FibreEnergy>(material.energy).active =
      fibre_switch == "none" ? EnergyPart::Active::always : EnergyPart::Active::fibre_stretched;
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
  FibreEnergy with_axial = fibres(0, 1);
  with_axial.families.push_back({0, 5, 1});
  const cards::Material four{.type = "four_fibre", .energy = with_axial};
  EXPECT_THAT(refused(Target::abaqus, four), HasSubstr("one k1 and one k2 for all families"));
  const cards::Material many{.type = "ogden", .energy = StretchEnergy{{{1, 2}, {1, 2}, {1, 2}, {1, 2}}}};
  EXPECT_THAT(refused(Target::calculix, many), HasSubstr("3 terms at most, and these are 4"));
  EXPECT_EQ(refused(Target::abaqus, many), "accepted");
  EXPECT_THAT(refused(Target::ansys, hgo), AllOf(HasSubstr("Ansys cannot express"), HasSubstr("no documented switch")));
  EXPECT_THAT(refused(Target::lsdyna, gho, {.density = 1000}), HasSubstr("*MAT_295"));
  EXPECT_THAT(refused(Target::lsdyna, gent, {.density = 1000}), HasSubstr("limit of extension"));
  EXPECT_THAT(refused(Target::febio, dispersed), HasSubstr("normal of the wall"));
  EXPECT_THAT(refused(Target::febio, switched(hgo, "none")), HasSubstr("fibre_switch is 'none'"));
  EXPECT_THAT(refused(Target::febio, switched(gho, "stretch")), HasSubstr("fibre_switch is 'stretch'"));
  EXPECT_THAT(refusal([] {
                (void)cards::material_of(tunica::testing::catalogue(), {"fung", {}}, {}, {});
              }),
              AllOf(HasSubstr("no card is known for the model 'fung'"), HasSubstr("Known: blatz_ko")));
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
  const Given aligned{"gho", {{"mu", 12}, {"kappa", 0}, {"k1", 20}, {"k2", 0.8}, {"theta", 30}}};
  EXPECT_EQ(cards::write_card(Target::calculix, material(aligned)), cards::write_card(Target::calculix, hgo));
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
  EXPECT_THAT(refused(Target::calculix, material({"neo_hooke", {{"mu", -1}}})),
              HasSubstr("found a shear modulus of -1 kPa at rest"));
  EXPECT_THAT(refused(Target::calculix, {.type = "ogden", .energy = StretchEnergy{{{1, 0}}}}),
              HasSubstr("the exponent alpha_1 is 0"));
  EXPECT_THAT(refusal([] { (void)cards::target_of("calculx"); }), HasSubstr("Did you mean 'calculix'?"));
}

TEST(Cards, AreThoseOfTheFormOfAnEnergyWhateverItsModelIsCalled) {
  const auto own = [](PolynomialEnergy energy) {
    return cards::Material{.type = "my_own", .energy = std::move(energy)};
  };
  const cards::CardSettings settings{.name = "R", .units = kilopascal};
  EXPECT_EQ(cards::write_card(Target::abaqus, own({{{2, 0, -1.5}, {1, 0, 180}, {3, 0, 0.05}}}), settings),
            cards::write_card(Target::abaqus, yeoh, settings));
  // 4 (I1 − 3)² beside 200 (I1 − 3) and 20 (I2 − 3): no program has this form by name.
  const cards::Material mixed = own({{{1, 0, 200}, {0, 1, 20}, {2, 0, 4}}});
  EXPECT_THAT(cards::write_card(Target::abaqus, mixed, settings),
              EndsWith("*HYPERELASTIC, POLYNOMIAL, N=2\n200, 20, 4, 0, 0, 0, 0\n"));
  EXPECT_THAT(refused(Target::febio, mixed), HasSubstr("two constants"));
  const cards::Material fourth = own({{{1, 0, 200}, {4, 0, 1}}});
  EXPECT_THAT(refused(Target::ansys, fourth), HasSubstr("end with the third degree"));
  EXPECT_THAT(refused(Target::lsdyna, fourth, {.density = 1000}), HasSubstr("ends with c30"));
  EXPECT_THAT(refused(Target::calculix, fourth), HasSubstr("end with degree 3, and this one has 4"));
  EXPECT_EQ(refused(Target::abaqus, fourth), "accepted");
  EXPECT_THAT(refused(Target::abaqus, own({})), HasSubstr("its card has no term"));
  EXPECT_THAT(refused(Target::abaqus, own({{{1, 0, NAN}}})), HasSubstr("found nan in the energy of its card"));
}

TEST(Cards, TakeTheVolumeOfAMechanismAndRefuseOthers) {
  const auto by = [](const std::string& mechanism, Options options, std::vector<double> values) {
    Options all = tunica::testing::defaults(tunica::testing::catalogue().mechanisms().at(mechanism).factory.options);
    for (const auto& [name, value] : options.values()) all.set(name, value);
    const std::vector<cards::Ingredient> mechanisms{{mechanism, all}};
    return cards::material_of(tunica::testing::catalogue(), {"neo_hooke", {}}, mechanisms, values);
  };
  EXPECT_DOUBLE_EQ(by("compressibility", option("invariants", "isochoric"), {400, 1e-5}).volume.bulk_modulus, 1e5);
  EXPECT_THAT(refusal([&] { (void)by("compressibility", {}, {400, 1e-5}); }), HasSubstr("full invariants"));
  EXPECT_THAT(refusal([&] {
                (void)by("second_invariant", {}, {400, 1});
              }),
              HasSubstr("the mechanism 'second_invariant' changes the model 'neo_hooke', and no card has it"));
}

// Both programs define η = 1 − 1/r erf((Wmax − W)/(m + β Wmax)): Abaqus, "Mullins effect"; Ansys, "TB,CDM", PSE2.
TEST(Cards, TakeTheSofteningOfAMechanism) {
  const std::vector<cards::Ingredient> softening{{"stress_softening", {}}};
  const auto softened = [&](const char* model, std::vector<double> values) {
    const auto& known = tunica::testing::catalogue().models().at(model).factory;
    return cards::material_of(tunica::testing::catalogue(), {model, tunica::testing::defaults(known.options)},
                              softening, values);
  };
  const cards::Material yeoh = softened("yeoh", {418, -33.6, 5.74, 0.5, 0.394});
  cards::CardSettings settings;
  settings.name = "rubber";
  EXPECT_THAT(cards::write_card(Target::abaqus, yeoh, settings), EndsWith("*MULLINS EFFECT\n2, 0, 0.394\n"));
  EXPECT_THAT(cards::write_card(Target::ansys, yeoh, settings), EndsWith("TB,CDM,1,1,3,PSE2\nTBDATA,1, 2, 0, 0.394\n"));
  EXPECT_THAT(refusal([&] { (void)cards::write_card(Target::calculix, yeoh, settings); }),
              AllOf(HasSubstr("no softening of Ogden and Roxburgh"), HasSubstr("export for Abaqus or Ansys")));
  EXPECT_THAT(refusal([&] {
                (void)softened("yeoh", {418, -33.6, 5.74, 1, 0.394});
              }),
              HasSubstr("at s = 1 all is lost"));
  const cards::Material fibres = softened("hgo", {10, 5, 1, 40, 0.5, 0.394});
  EXPECT_THAT(refusal([&] { (void)cards::write_card(Target::abaqus, fibres, settings); }),
              HasSubstr("for isotropic energies only"));
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

TEST(Cards, NameThePluginWhoseEnergyThrows) {
  ModelFactory factory;
  factory.type = "broken";
  factory.create = [](const Options&) { return std::unique_ptr<Model>(); };
  factory.card = [](const Options&, std::span<const double>) -> CardEnergy { throw std::runtime_error("no energy"); };
  plugins::Catalogue::Registration registration;
  registration.add(std::move(factory));
  plugins::Catalogue catalogue;
  catalogue.commit(std::move(registration), "broken 1.0");
  try {
    (void)cards::material_of(catalogue, {"broken", {}}, {}, {});
    FAIL() << "it throws";
  } catch (const plugins::PluginFailure& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("plugin 'broken 1.0' failed: no energy"));
  }
}
