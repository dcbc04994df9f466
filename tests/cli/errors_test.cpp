// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::AllOf;
using ::testing::HasSubstr;

namespace {

/// Exit code 2, nothing on stdout, no results folder, and a message on stderr.
std::string refused(const trial::Bench& bench, int code = 2) {
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_EQ(ended.code, code) << ended.err;
  EXPECT_EQ(ended.out, "");
  EXPECT_FALSE(std::filesystem::exists(bench.path("out")));
  return ended.err;
}

}  // namespace

TEST(InvalidInput, MistypedParameter) {
  trial::Bench bench;
  bench.experiment["models"]["gho"]["parameters"]["kapa"] = {{"min", 0}};
  EXPECT_THAT(refused(bench),
              AllOf(HasSubstr("'kapa'"), HasSubstr("kappa"), HasSubstr("experiment.json"), HasSubstr("/models/gho")));
}

TEST(InvalidInput, ControlCharactersOfAFileDoNotReachTheTerminal) {
  trial::Bench bench;
  bench.experiment["models"]["g\033[31m"] = {{"type", "gho"}};
  EXPECT_THAT(refused(bench), AllOf(HasSubstr("the model name 'g\\x1b[31m'"), HasSubstr("/models/g\\x1b[31m, line"),
                                    ::testing::Not(HasSubstr("\033"))));
  bench.experiment["models"].erase("g\033[31m");
  bench.experiment["name"] = "a\033[31mb\a";
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.out, AllOf(HasSubstr("a\\x1b[31mb\\x07, seed 7"), ::testing::Not(HasSubstr("\033"))));
  EXPECT_THAT(ended.err, ::testing::Not(HasSubstr("\033")));
}

TEST(InvalidInput, ReversedBounds) {
  trial::Bench bench;
  bench.experiment["models"]["gho"]["parameters"]["mu"] = {{"min", "20 kPa"}, {"max", "10 kPa"}};
  EXPECT_THAT(refused(bench), AllOf(HasSubstr("/models/gho/parameters/mu"), HasSubstr("20"), HasSubstr("10")));
}

TEST(InvalidInput, UnknownUnit) {
  trial::Bench bench;
  bench.experiment["models"]["gho"]["parameters"]["mu"] = {{"min", "1 kPaa"}};
  EXPECT_THAT(refused(bench), AllOf(HasSubstr("kPaa"), HasSubstr("kPa"), HasSubstr("/models/gho/parameters/mu/min")));
}

TEST(InvalidInput, TextInANumberColumn) {
  trial::Bench bench;
  bench.folder.write("circ.csv", "stretch [1],stress [kPa]\n1.1,10\n1.2,broken\n1.3,30\n");
  EXPECT_THAT(refused(bench),
              AllOf(HasSubstr("circ.csv, line 3, column 2"), HasSubstr("'broken'"), HasSubstr("stress")));
}

TEST(InvalidInput, MissingColumn) {
  trial::Bench bench;
  bench.experiment["tests"]["circ"]["data"]["columns"]["stress"] = "stres";
  EXPECT_THAT(refused(bench), AllOf(HasSubstr("'stres'"), HasSubstr("circ.csv"), HasSubstr("stress")));
}

TEST(InvalidInput, ColumnThatTheProtocolOfATestNeeds) {
  trial::Bench bench;
  bench.experiment["tests"]["circ"]["type"] = "biaxial";
  bench.experiment["tests"]["circ"]["protocol"] = "general";
  EXPECT_THAT(refused(bench),
              AllOf(HasSubstr("test 'circ'"), HasSubstr("no column is mapped to 'stretch_circumferential'"),
                    HasSubstr("the protocol 'general' needs both in-plane stretches")));
}

TEST(InvalidInput, InitialValueOutsideItsBounds) {
  trial::Bench bench;
  bench.experiment["models"]["gho"]["parameters"]["mu"] = {{"min", 1}, {"max", 10}, {"initial", 11}};
  EXPECT_THAT(refused(bench), AllOf(HasSubstr("/models/gho/parameters/mu"), HasSubstr("11")));
}

TEST(InvalidInput, LogScaleWithAZeroBound) {
  trial::Bench bench;
  bench.experiment["models"]["gho"]["parameters"]["mu"] = {{"min", 0}, {"max", 10}, {"scale", "log"}};
  EXPECT_THAT(refused(bench), AllOf(HasSubstr("/models/gho/parameters/mu"), HasSubstr("log"), HasSubstr("0")));
}

TEST(InvalidInput, MissingFile) {
  const trial::Folder folder;
  const auto ended = trial::tunica({"run", "nowhere.json"}, folder.path());
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("nowhere.json"));
}

TEST(InvalidInput, FolderWithResults) {
  trial::Bench bench;
  bench.folder.write("note.txt", "mine");
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "."});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("is not empty, and results are never overwritten"));
}

TEST(InvalidInput, FolderThatCannotBeWritten) {
  trial::Bench bench;
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "/proc/tunica"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("/proc/tunica: cannot be created: "));
}

TEST(PluginRefused, NamedFile) {
  trial::Bench bench;
  const auto ended = bench.tunica({"--plugin-path", TUNICA_BAD_PLUGIN_DIR "/wrong_api.so", "check", "experiment.json"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("error: --plugin-path "), HasSubstr("wrong_api.so"), HasSubstr("API")));
}

TEST(PluginRefused, InAFolderIsOnlyAWarning) {
  trial::Bench bench;
  const auto ended = bench.tunica({"--plugin-path", TUNICA_BAD_PLUGIN_DIR, "list", "models"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.err, HasSubstr("warning: plugin "));
  EXPECT_THAT(ended.out, HasSubstr("gho"));
}

TEST(PluginRefused, InAFolderIsTheErrorWhenItIsNeeded) {
  trial::Bench bench;
  bench.experiment["models"]["gho"] = {{"type", "wrong_api"}};
  bench.save();
  const auto ended = bench.tunica({"--plugin-path", TUNICA_BAD_PLUGIN_DIR, "check", "experiment.json"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err,
              AllOf(HasSubstr("The type 'wrong_api' is missing because its plugin"), HasSubstr("was refused")));
}

TEST(PluginRefused, MissingPathIsInvalidInput) {
  trial::Bench bench;
  const auto ended = bench.tunica({"--plugin-path", "nowhere", "list"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("--plugin-path nowhere: no such file or folder"));
}

TEST(InvalidInput, ProfileOfAParameterThatNoRunHas) {
  const trial::Bench bench;
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out", "--profiles", "kapa"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("no run searches for the parameter 'kapa' that a profile is asked of"),
                               HasSubstr("Did you mean 'kappa'?")));
  EXPECT_FALSE(std::filesystem::exists(bench.path("out")));
}

TEST(InvalidInput, TooFewDrawsOnTheCommandLine) {
  const trial::Bench bench;
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out", "--bootstrap", "5"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("--bootstrap"));
}

TEST(InvalidInput, TooFewDrawsFromThePosterior) {
  const trial::Bench bench;
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out", "--posterior=5"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("5 draws are asked of the posterior; expected a number from 400 to 1000000"));
  EXPECT_FALSE(std::filesystem::exists(bench.path("out")));
}

TEST(InvalidInput, CertificateOfWhatIsNoFinishedRun) {
  const trial::Bench bench;
  const auto ended = bench.tunica({"certify", "."});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("there is no input.json; name the folder of a finished run"));
}
