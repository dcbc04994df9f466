// SPDX-License-Identifier: Apache-2.0
// Plugins that break one promise each, through the command line: the right property is named.
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "execution/folder.hpp"

namespace tunica::wrong_plugins_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Names = std::set<std::string>;

const trial::Folder folder;

std::string wrong(const std::string& plugin) { return std::string(TUNICA_WRONG_PLUGIN_DIR) + "/" + plugin + ".so"; }

trial::Ended check(const std::string& file, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"plugin", "check", file};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return trial::tunica(arguments, folder.path());
}

/// The properties that failed, of the thing that is called `name`; of all without.
Names failed(const std::string& plugin, const std::string& name = "", std::vector<std::string> more = {}) {
  more.push_back("--json");
  const trial::Ended ended = check(wrong(plugin), more);
  EXPECT_EQ(ended.code, 1) << ended.err << ended.out;
  Names names;
  const auto all = nlohmann::json::parse(ended.out);
  EXPECT_FALSE(all["passed"]);
  for (const auto& one : all["findings"])
    if (one["outcome"] == "FAILED" && (name.empty() || one["name"] == name)) {
      EXPECT_NE(one["counter_example"], "") << one;
      names.insert(one["property"]);
    }
  return names;
}

/// The result of the check for one property of an object.
std::string words(const std::string& plugin, const std::string& name, const std::string& property) {
  const auto all = nlohmann::json::parse(check(wrong(plugin), {"--only", name, "--json"}).out);
  for (const auto& one : all["findings"])
    if (one["name"] == name && one["property"] == property && one["outcome"] == "FAILED") return one["counter_example"];
  return "it did not fail";
}

}  // namespace

TEST(WrongModel, OfWhichTheStressIsNotTheGradientOfTheEnergyIsNamed) {
  EXPECT_EQ(failed("wrong_energy"), Names{"stress_is_the_gradient_of_the_energy"});
}

TEST(WrongModel, OfWhichTheCardHasAnotherEnergyIsNamed) {
  EXPECT_EQ(failed("wrong_card"), Names{"card_has_the_energy_of_the_model"});
}

TEST(WrongModel, ThatDependsOnTheAxesOfAnIsotropicMaterialIsNamed) {
  EXPECT_EQ(failed("not_objective"), Names{"response_is_objective"});
}

TEST(WrongModel, ThatRemembersTheCallBeforeIsNamed) {
  // The size of the batch before is part of what it remembers.
  EXPECT_THAT(failed("leaking_state"), Contains("calls_leave_nothing_behind"));
}

TEST(WrongModel, WithAWrongSignOfAParameterDerivativeIsNamed) {
  EXPECT_EQ(failed("wrong_parameter_derivative"), Names{"parameter_derivatives_match_differences"});
}

TEST(WrongModel, WithDeviatoricStressAtRestIsNamed) {
  EXPECT_EQ(failed("stress_at_rest"), Names{"deviatoric_stress_vanishes_at_rest"});
}

TEST(WrongModel, ThatIsCompressibleAndSwellsAtRestIsNamed) {
  EXPECT_EQ(failed("wrong_volume", "swelling"), Names{"deviatoric_stress_vanishes_at_rest"});
  EXPECT_THAT(words("wrong_volume", "swelling", "deviatoric_stress_vanishes_at_rest"),
              ::testing::StartsWith("S_tt = "));
}

TEST(WrongTest, ThatSaysItCarriesEveryVolumeAndDoesNotIsNamed) {
  EXPECT_EQ(words("wrong_volume", "half_strip", "carries_compressible_materials"),
            "the test says that it carries materials of any volume, and of this one: half_strip: its volume changes");
}

/// None of 468 checks of a second missed it, on one processor or two, idle or not; see docs/plugin-check.md.
TEST(WrongModel, ThatIsNotThreadSafeIsNamed) { EXPECT_EQ(failed("unsafe_scratch"), Names{"concurrent_calls_agree"}); }

TEST(WrongModel, ThatCrashesIsAFindingAndTheOtherPropertiesAreChecked) {
  const auto ended = check(wrong("crashing"));
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.out, HasSubstr("FAILED      batch_equals_single_points"));
  EXPECT_THAT(ended.out, HasSubstr("ended by signal 11"));
  EXPECT_THAT(ended.out, HasSubstr("ok          stress_is_the_gradient_of_the_energy"));
}

TEST(WrongModel, ThatThrowsIsNamedWithWhatItThrows) {
  const auto ended = check(wrong("throwing"), {"--only", "unwanted_outputs_change_nothing"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.out, HasSubstr("seven points are too many"));
}

TEST(WrongModel, ThatWritesOneNumberPastTheEndIsToldWhereAndHowMany) {
  EXPECT_EQ(words("wrong_memory", "past_the_end", "writes_its_outputs_and_nothing_else"),
            "the model writes 1 number past the end of the output 'stress', which has 6: keep to the size of the span");
}

TEST(WrongModel, ThatAddsALittleBeforeTheBeginningIsToldWhereAndHowMany) {
  EXPECT_EQ(words("wrong_memory", "before_the_beginning", "writes_its_outputs_and_nothing_else"),
            "the model writes 2 numbers before the beginning of the output 'stress_dp', which has 1152: keep to the "
            "size of the span");
}

TEST(WrongModel, ThatWritesNothingAndReturnsOkFails) {
  EXPECT_EQ(words("wrong_memory", "silent", "writes_its_outputs_and_nothing_else"),
            "the model never writes its output 'energy', and returns ok: 1 of 1 numbers are as they were before the "
            "call");
}

TEST(WrongModel, ThatLeavesOneNumberUnwrittenIsToldWhich) {
  EXPECT_EQ(words("wrong_memory", "short_of_one", "writes_its_outputs_and_nothing_else"),
            "the model leaves 1 of 7 numbers of its output 'energy' unwritten, and returns ok; the first is number 7");
}

TEST(WrongModel, ThatAddsToItsOutputIsTold) {
  EXPECT_EQ(words("wrong_memory", "adding", "writes_its_outputs_and_nothing_else"),
            "the model computes 1 of 1 numbers of its output 'energy' from what was there before the call; outputs are "
            "to be assigned, not added to");
}

TEST(WrongModel, ThatChangesItsInputIsToldWhich) {
  EXPECT_EQ(words("wrong_memory", "tidying", "writes_its_outputs_and_nothing_else"),
            "the model writes to its input 'C': 1 of 786 numbers changed");
}

TEST(WrongModel, ThatNeverWritesItsStateIsToldSo) {
  EXPECT_EQ(words("wrong_state", "state_unwritten", "writes_its_outputs_and_nothing_else"),
            "the model never writes its output 'state', and returns ok: 2 of 2 numbers are as they were before the "
            "call");
}

TEST(WrongModel, ThatWritesHalfItsStateIsToldHowMuch) {
  EXPECT_EQ(words("wrong_state", "state_half", "writes_its_outputs_and_nothing_else"),
            "the model leaves 1 of 2 numbers of its output 'state' unwritten, and returns ok; the first is number 2");
}

TEST(WrongModel, WhoseStateIsNoNumberAfterALongStepIsNamed) {
  EXPECT_THAT(words("wrong_state", "state_no_number", "history_stands_still_without_time"),
              HasSubstr("number 2 of 2 of the state is nan after a step of 1 s"));
}

TEST(WrongModel, WhoseTangentForgetsTheOldStateIsNamed) {
  EXPECT_EQ(failed("wrong_state", "history_tangent"), Names{"history_tangent_is_the_derivative_of_the_step"});
}

TEST(WrongModel, ThatIsInOrderButForItsNeighboursIsNotNamed) {
  EXPECT_THAT(failed("wrong_state", "state_right"), IsEmpty());
}

TEST(WrongModel, ThatIsRightWithTheDefaultAloneIsNamedWithTheChoice) {
  const auto all = nlohmann::json::parse(check(wrong("wrong_choices"), {"--only", "wrong_choice", "--json"}).out);
  for (const auto& one : all["findings"])
    EXPECT_EQ(one["outcome"] == "FAILED",
              one["property"] == "stress_is_the_gradient_of_the_energy" && one["with"] == "with energy = half")
        << one;
}

TEST(WrongOptimizer, ThatIsRightWithTheDefaultAloneIsNamedWithTheChoice) {
  const auto all = nlohmann::json::parse(
      check(wrong("wrong_choices"), {"--only", "repeats_itself_with_the_same_seed", "--json"}).out);
  Names refused;
  for (const auto& one : all["findings"])
    if (one["outcome"] == "FAILED") refused.insert(one["with"]);
  EXPECT_EQ(refused, Names{"with seed = own"});
}

TEST(WrongTest, ThatWritesNothingAndReturnsOkFails) {
  EXPECT_THAT(words("wrong_answers", "shear_silent", "writes_its_outputs_and_nothing_else"),
              HasSubstr("the test never writes its output 'values', and returns ok: 6 of 6 numbers"));
}

TEST(WrongTest, ThatWritesOneNumberPastTheEndIsToldWhereAndHowMany) {
  EXPECT_THAT(words("wrong_answers", "shear_past_the_end", "writes_its_outputs_and_nothing_else"),
              HasSubstr("the test writes 1 number past the end of the output 'jacobian', which has 30"));
}

TEST(WrongTest, ThatPredictsNoNumbersFailsThoughNoRowsSuitIt) {
  EXPECT_THAT(words("wrong_answers", "shear_no_number", "predictions_are_numbers"),
              HasSubstr("channel shear_stress is nan under the status ok"));
}

TEST(WrongTest, ThatThrowsWhileRowsAreLookedForFails) {
  EXPECT_EQ(words("wrong_answers", "shear_throwing", "predictions_are_numbers"), "nobody catches this");
}

TEST(WrongTest, WhoseJacobianRemembersTheCallBeforeIsNamed) {
  EXPECT_THAT(failed("wrong_answers", "shear_leaking_jacobian"), Contains("predictions_repeat_themselves"));
}

TEST(WrongTest, ThatIsInOrderButForItsNeighboursIsNotNamed) {
  EXPECT_THAT(failed("wrong_answers", "shear_right"), IsEmpty());
}

TEST(WrongOptimizer, ThatLeavesTheBoxIsNamed) {
  EXPECT_THAT(failed("wrong_optimizers", "boundless"), Contains("keeps_the_bounds"));
}

TEST(WrongOptimizer, ThatNobodyCanRepeatIsNamed) {
  const Names names = failed("wrong_optimizers", "irreproducible");
  EXPECT_THAT(names, Contains("repeats_itself_with_the_same_seed"));
  EXPECT_THAT(names, Not(Contains("keeps_the_bounds")));
}

TEST(WrongOptimizer, ThatIsInOrderButForItsNeighboursIsNotNamed) {
  EXPECT_THAT(failed("wrong_optimizers", "orderly"), IsEmpty());
}

TEST(WrongTest, WithAJacobianThatForgetsATermIsNamed) {
  EXPECT_EQ(failed("wrong_jacobian"), Names{"jacobian_matches_differences"});
}

TEST(WrongTest, WhoseDerivativeIsRightWithTheDefaultAloneIsNamedWithTheChoice) {
  EXPECT_EQ(failed("wrong_plane"), Names{"abscissa_derivative_matches_differences"});
  const auto shown = nlohmann::json::parse(
      check(wrong("wrong_plane"), {"--only", "abscissa_derivative_matches_differences", "--json"}).out);
  Names refused;
  for (const auto& one : shown["findings"])
    if (one["outcome"] == "FAILED") refused.insert(one["with"]);
  EXPECT_THAT(refused, ::testing::UnorderedElementsAre(HasSubstr("plane = axial_radial"),
                                                       HasSubstr("plane = circumferential_radial")));
}

TEST(WrongMechanism, ThatIsNotTheBareTestAtItsNullIsNamed) {
  EXPECT_THAT(failed("wrong_null"), Contains("null_is_the_bare_test"));
}

TEST(PluginCheck, ShowsTheWorstErrorBesideItsToleranceAndACounterExample) {
  const auto ended = check(wrong("wrong_parameter_derivative"));
  EXPECT_THAT(ended.out, HasSubstr("model wrong_parameter_derivative"));
  EXPECT_THAT(ended.out,
              ::testing::ContainsRegex("FAILED +parameter_derivatives_match_differences +[0-9.e+-]+ of 1e-06"));
  EXPECT_THAT(ended.out, HasSubstr("/dc20 = "));
  EXPECT_THAT(ended.out, HasSubstr("not checked history_begins_at_rest"));
  EXPECT_THAT(ended.out, HasSubstr("NOT in order: 1 property failed"));
}

TEST(PluginCheck, ChecksOnlyWhatIsAskedFor) {
  const auto ended = check(wrong("wrong_energy"), {"--only", "tangent_has_its_symmetries"});
  EXPECT_EQ(ended.code, 0) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("In order: 1 of 1 held"));
  EXPECT_THAT(ended.out, Not(HasSubstr("stress_is_the_gradient")));
}

TEST(PluginCheck, RefusesANameThatNothingAnswersTo) {
  const auto ended = check(wrong("wrong_energy"), {"--only", "tangent_has_its_symmetry"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("--only tangent_has_its_symmetry"));
  EXPECT_THAT(ended.err, HasSubstr("tangent_has_its_symmetries"));
}

TEST(PluginCheck, StopsWhatTakesLongerThanTheTimeLimit) {
  const auto ended = check(wrong("wrong_energy"), {"--only", "tangent_has_its_symmetries", "--time-limit", "1e-6"});
  EXPECT_EQ(ended.code, 1) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("no end after 1e-06 s"));
  EXPECT_EQ(check(wrong("wrong_energy"), {"--time-limit", "0"}).code, 2);
}

TEST(PluginCheck, AnswersTheSameForTheSameSeed) {
  const auto one = check(wrong("wrong_energy"), {"--seed", "7", "--only", "stress_is_the_gradient_of_the_energy"}),
             two = check(wrong("wrong_energy"), {"--seed", "7", "--only", "stress_is_the_gradient_of_the_energy"});
  EXPECT_EQ(one.out, two.out);
  EXPECT_NE(one.out,
            check(wrong("wrong_energy"), {"--seed", "8", "--only", "stress_is_the_gradient_of_the_energy"}).out);
}

TEST(PluginCheck, ReturnsTwoWhereThereIsNoSuchFileAndThreeForAPluginThatIsRefused) {
  const auto absent = check("nowhere.so");
  EXPECT_EQ(absent.code, 2);
  EXPECT_THAT(absent.err, HasSubstr("nowhere.so: no such file"));
  const auto refused = check(std::string(TUNICA_BAD_PLUGIN_DIR) + "/wrong_api.so");
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, HasSubstr("API"));
}

}  // namespace tunica::wrong_plugins_test
