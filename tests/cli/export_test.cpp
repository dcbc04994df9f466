// SPDX-License-Identifier: Apache-2.0
// From a result folder to a material card, with all refusals.
#include <filesystem>

#include <gmock/gmock.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {
/// The comments without their line breaks.
std::string unwrapped(std::string card) {
  for (std::size_t at; (at = card.find("\n**   ")) != std::string::npos;) card.replace(at, 6, " ");
  return card;
}
}  // namespace

/// Two strips fitted with one model, which the folder "out" then holds.
class Export : public ::testing::Test {
 protected:
  void fit(const nlohmann::json& model) {
    bench.experiment["models"] = {{"wall", model}};
    bench.experiment["runs"] = {{{"model", "wall"}, {"optimizer", "lm"}}};
    const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
    ASSERT_EQ(ended.code, 0) << ended.err;
  }
  [[nodiscard]] trial::Ended exported(std::vector<std::string> words) const {
    words.insert(words.begin(), "export");
    return bench.tunica(std::move(words));
  }
  [[nodiscard]] std::string refused(std::vector<std::string> words) const {
    const auto ended = exported(std::move(words));
    EXPECT_EQ(ended.code, 2) << ended.out;
    EXPECT_EQ(ended.out, "");
    return ended.err;
  }
  trial::Bench bench;
};

TEST_F(Export, WritesACardWithProvenanceRangeStabilityAndUncertaintyButNoDate) {
  fit({{"type", "neo_hooke"}});
  const auto ended = exported({"out", "--to", "calculix"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  const double mu = bench.result("out")["runs"][0]["best"]["parameters"]["mu"]["value"];
  EXPECT_THAT(unwrapped(ended.out),
              AllOf(HasSubstr("run 'wall/lm'"), HasSubstr("type neo_hooke"), HasSubstr("sha256:"),
                    HasSubstr("% interval"), HasSubstr("Fitted range of test 'circ': stretch 1.02 to 1.4"),
                    HasSubstr("Stability: "), HasSubstr("Units: mm, N, MPa, s.")));
  EXPECT_THAT(unwrapped(ended.out), HasSubstr("Misfit: the model misses by 8.2 % of the range beyond noise; the "
                                              "intervals hold only if the model is right."))
      << "one law for two strips of different stiffness";
  const std::string date = bench.result("out")["provenance"]["date"];
  EXPECT_THAT(ended.out, Not(HasSubstr(date.substr(0, 10))));
  const auto at = ended.out.find("*HYPERELASTIC, NEO HOOKE\n");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NEAR(std::stod(ended.out.substr(at + 25)), 0.5e-3 * mu, 1e-11 * mu);
  EXPECT_EQ(exported({"out/result.json", "--to", "calculix", "-o", "card.inp"}).out, "card.inp\n");
  EXPECT_EQ(bench.text("card.inp"), ended.out) << "the same every time, by folder or by file";
  EXPECT_THAT(refused({"out", "--to", "calculix", "-o", "card.inp"}), HasSubstr("is there already; name a new file"));
}

TEST_F(Export, IsSilentOfAMisfitThatNoiseExplains) {
  bench.experiment["tests"].erase("axial");
  bench.experiment["tests"]["circ"]["data"]["noise"] = {{"stress", {{"absolute", 0.2}}}};
  fit({{"type", "neo_hooke"}});
  const auto ended = exported({"out", "--to", "calculix"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, Not(HasSubstr("Misfit:")));
}

TEST_F(Export, SaysWhatItCannotUse) {
  fit({{"type", "gho"}, {"parameters", {{"kappa", {{"fixed", 0.1}}}}}});
  EXPECT_THAT(refused({"out", "--to", "calculix"}), HasSubstr("CalculiX cannot express the model 'gho'"));
  EXPECT_THAT(refused({"out", "--to", "nastran"}), HasSubstr("there are no cards for 'nastran'"));
  EXPECT_THAT(refused({"out", "--to", "abaqus", "--units", "mm-N-kPa"}), HasSubstr("they are not consistent"));
  EXPECT_THAT(refused({"out", "--to", "abaqus", "--run", "wall/ml"}), HasSubstr("Did you mean 'wall/lm'?"));
  EXPECT_THAT(refused({"out", "--to", "abaqus", "--model", "wal"}), HasSubstr("Did you mean 'wall'?"));
  EXPECT_THAT(refused({"nowhere", "--to", "abaqus"}), HasSubstr("nowhere: no such folder"));
  std::filesystem::create_directory(bench.path("empty"));
  EXPECT_THAT(refused({"empty", "--to", "abaqus"}), HasSubstr("there is no result.json"));
}

TEST_F(Export, WritesTheSubroutineBesideItsCard) {
  fit({{"type", "holzapfel_2015"}, {"parameters", {{"A", {{"fixed", 0.2}}}, {"B", {{"fixed", 0.3}}}}}});
  EXPECT_THAT(refused({"out", "--to", "abaqus"}), HasSubstr("--subroutine FILE.f"));
  const auto ended = exported({"out", "--to", "abaqus", "--subroutine", "wall.f", "-o", "wall.inp"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, "wall.inp\nwall.f\n");
  EXPECT_THAT(bench.text("wall.inp"), HasSubstr("LOCAL DIRECTIONS=3, PROPERTIES=11"));
  EXPECT_THAT(bench.text("wall.f"), HasSubstr("subroutine uanisohyper_inv("));
  EXPECT_THAT(refused({"out", "--to", "abaqus", "--subroutine", "wall.f"}),
              HasSubstr("--subroutine wall.f: is there already"));
}

TEST_F(Export, TakesADensityWithItsUnit) {
  fit({{"type", "neo_hooke"}});
  EXPECT_THAT(refused({"out", "--to", "lsdyna"}), HasSubstr("give it, for example --density"));
  EXPECT_THAT(refused({"out", "--to", "lsdyna", "--density", "1 kPa"}), HasSubstr("density '1 kPa'"));
  EXPECT_THAT(refused({"out", "--to", "febio", "--density", "1.1e-9"}),
              HasSubstr("found a number without a unit; give for example \"1000 kg/m3\", or \"1.1e-9 tonne/mm3\""));
  const auto ended = exported({"out", "--to", "febio", "--density", "1.1 g/cm3", "--units", "m-N-Pa"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("<density>1100</density>"));
}

TEST_F(Export, RefusesAModelThatAMechanismChanges) {
  fit({{"type", "neo_hooke"}, {"mechanisms", {{{"type", "chain_extensibility"}}}}});
  EXPECT_THAT(refused({"out", "--to", "abaqus"}),
              AllOf(HasSubstr("the mechanism 'chain_extensibility' changes the model 'neo_hooke', and no card has it"),
                    HasSubstr("result.json has all parameters"), HasSubstr("docs/export.md")));
}

// Runs of different tests have objectives that cannot be compared, so that none of them is the best.
TEST_F(Export, TakesNoRunOfSeveralThatCannotBeCompared) {
  const std::string test = bench.experiment["tests"].begin().key();
  bench.experiment["models"] = {{"wall", {{"type", "neo_hooke"}}}};
  bench.experiment["runs"] = {{{"model", "wall"}, {"optimizer", "lm"}},
                              {{"model", "wall"}, {"optimizer", "lm"}, {"tests", {test}}}};
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  EXPECT_THAT(refused({"out", "--to", "calculix"}),
              AllOf(HasSubstr("none is the best of all"), HasSubstr("choose with --run")));
  EXPECT_EQ(exported({"out", "--to", "calculix", "--run", "wall/lm"}).code, 0);
}
