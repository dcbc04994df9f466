// SPDX-License-Identifier: Apache-2.0
// `tunica diagnose` from outside, as a user has it.
#include <sstream>

#include <gmock/gmock.h>

#include "cli/process.hpp"
#include "diagnosis/measured.hpp"
#include "diagnosis/output/outputs.hpp"

namespace tunica::trial {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

Ended tunica(const Measured& measured, const std::vector<std::string>& arguments) {
  measured.save();
  return trial::tunica(arguments, measured.folder.path());
}

json result(const Measured& measured, const std::string& directory) {
  return json::parse(text_of(measured.folder.path() / directory / "result.json"));
}

/// Exit code 2, no results, and the message.
std::string refused(const Measured& measured, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"diagnose", "experiment.json", "-o", "out", "--quick", "--quiet"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Ended ended = tunica(measured, arguments);
  EXPECT_EQ(ended.code, 2) << ended.out;
  EXPECT_EQ(ended.out, "");
  EXPECT_FALSE(std::filesystem::exists(measured.folder.path() / "out" / "result.json"));
  return ended.err;
}

/// Two strips of a wall with axial fibres, which gho does not have.
struct WithAxialFibres : Measured {
  WithAxialFibres() : Measured({{.sd = 0.6}, {.name = "axial", .sd = 0.6}}) {
    measure(21, [](json& truth) { truth["models"]["gho"]["mechanisms"] = {mechanism("axial_fibres", "k", 1.5)}; });
  }
};

/// Whether the schema of results takes the document, and knows every key of its diagnosis.
Ended validated(const std::filesystem::path& document) {
  const std::string program = R"(
import json, sys, jsonschema
schema, document = (json.load(open(path)) for path in sys.argv[1:3])
jsonschema.Draft7Validator(schema).validate(document)
def close(part):
    if isinstance(part, dict):
        if "properties" in part and part.get("type") != "string":
            part.setdefault("additionalProperties", False)
        for inner in part.values():
            close(inner)
    elif isinstance(part, list):
        for inner in part:
            close(inner)
close(schema["definitions"])
jsonschema.Draft7Validator({"definitions": schema["definitions"], "$ref": "#/definitions/diagnosis"}).validate(document["diagnosis"])
)";
  return Process(
             {TUNICA_PYTHON, "-c", program, TUNICA_SOURCE_DIR "/schemas/tunica-result.schema.json", document.string()},
             document.parent_path())
      .wait();
}

#define SKIP_WITHOUT_VALIDATOR(ended)                                        \
  if ((ended).err.find("No module named 'jsonschema'") != std::string::npos) \
  GTEST_SKIP() << "the independent validator is not installed (python3-jsonschema)"

TEST(Diagnose, WritesTheSameWithOneThreadAsWithTwo) {
  const WithAxialFibres measured;
  for (const char* threads : {"1", "2"}) {
    const Ended ended = tunica(measured, {"diagnose", "experiment.json", "-o", threads, "-j", threads});
    ASSERT_EQ(ended.code, 0) << ended.err;
  }
  json one = result(measured, "1"), two = result(measured, "2");
  one["provenance"].erase("date");
  two["provenance"].erase("date");
  EXPECT_EQ(one.dump(1), two.dump(1));
  for (const char* file : {"extended.json", "residuals.csv", "confusability.csv", "input.json"}) {
    EXPECT_EQ(text_of(measured.folder.path() / "1" / file), text_of(measured.folder.path() / "2" / file)) << file;
    EXPECT_FALSE(text_of(measured.folder.path() / "1" / file).empty()) << file;
  }
}

TEST(Diagnose, WritesAnExtensionWhoseRunHasThePromisedMisfit) {
  const WithAxialFibres measured;
  ASSERT_EQ(tunica(measured, {"diagnose", "experiment.json", "-o", "out", "--quiet"}).code, 0);
  const json found = result(measured, "out")["diagnosis"];
  ASSERT_EQ(found["extension"]["mechanisms"][0]["type"], "axial_fibres");
  const Ended ran = tunica(measured, {"run", "out/extended.json", "-o", "extended", "--quiet"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const double after = found["gain"]["after"];
  EXPECT_LT(after, found["gain"]["before"]);
  EXPECT_NEAR(result(measured, "extended")["runs"][0]["best"]["objective"].get<double>(), after, 1e-4 * after);
}

TEST(Diagnose, RunsAnExtensionWithLevenbergMarquardtWhateverElseIsCalledThat) {
  Measured measured;
  measured.measure(21,
                   [](json& truth) { truth["models"]["gho"]["mechanisms"] = {mechanism("axial_fibres", "k", 1.5)}; });
  measured.experiment["optimizers"] = {{"lm", {{"type", "es"}}}, {"lm_extended", {{"type", "es"}}}};
  const json extended = json::parse(diagnosis::extended_experiment(measured.diagnose(), testing::catalogue()));
  const std::string name = extended["runs"][0]["optimizer"];
  EXPECT_EQ(name, "lm_extended_extended");
  EXPECT_EQ(extended["optimizers"][name]["type"], "ceres_lm");
}

TEST(Diagnose, WritesResultsThatTheSchemaKnows) {
  const WithAxialFibres hidden;
  const Measured bare;
  bare.measure(22);
  Measured wrong_row;
  wrong_row.measure(23, {}, [](const Strip& strip, double stretch) {
    return strip.name == "axial" && std::abs(stretch - 1.3) < 0.01 ? 6.0 : 0;
  });
  Measured unknown;
  unknown.measure(24, {}, [](const Strip&, double stretch) { return 2 * std::sin(60 * stretch) * stretch; });
  for (const Measured* measured : std::initializer_list<const Measured*>{&hidden, &bare, &wrong_row, &unknown}) {
    ASSERT_EQ(tunica(*measured, {"diagnose", "experiment.json", "-o", "out", "--quick", "--quiet"}).code, 0);
    const Ended ended = validated(measured->folder.path() / "out" / "result.json");
    SKIP_WITHOUT_VALIDATOR(ended);
    EXPECT_EQ(ended.code, 0) << result(*measured, "out")["diagnosis"]["verdict"] << '\n' << ended.err;
  }
}

TEST(Diagnose, TakesAlphaAndSeedFromTheCommandLineFirst) {
  Measured measured;
  measured.measure(25);
  measured.experiment["diagnosis"] = {{"alpha", 0.01}};
  ASSERT_EQ(tunica(measured, {"diagnose", "experiment.json", "-o", "file", "--quick", "--quiet"}).code, 0);
  EXPECT_EQ(result(measured, "file")["diagnosis"]["alpha"], 0.01);
  ASSERT_EQ(tunica(measured,
                   {"diagnose", "experiment.json", "-o", "said", "--quick", "--quiet", "--alpha", "0.2", "--seed", "5"})
                .code,
            0);
  const json said = result(measured, "said")["diagnosis"];
  EXPECT_EQ(said["alpha"], 0.2);
  // Other draws: the p-value is another, but not much.
  EXPECT_NE(said["p_smooth"], result(measured, "file")["diagnosis"]["p_smooth"]);
}

TEST(Diagnose, WritesTheNoiseOfAMeanWhereThereAreReplicates) {
  Measured measured;
  measured.measure(28,
                   [](json& truth) { truth["models"]["gho"]["mechanisms"] = {mechanism("axial_fibres", "k", 1.5)}; });
  json& data = measured.experiment["tests"]["axial"]["data"];
  data.erase("file");
  data["files"] = {"axial.csv", "2.csv", "3.csv", "4.csv"};
  for (const char* copy : {"2.csv", "3.csv", "4.csv"})
    std::filesystem::copy_file(measured.folder.path() / "axial.csv", measured.folder.path() / copy);
  ASSERT_EQ(tunica(measured,
                   {"diagnose", "experiment.json", "-o", "out", "--quick", "--quiet", "--mechanisms", "axial_fibres"})
                .code,
            0);
  std::istringstream table(text_of(measured.folder.path() / "out" / "residuals.csv"));
  std::string line;
  std::getline(table, line);
  ASSERT_THAT(line, HasSubstr("measured,predicted,extended,sigma,residual,residual_extended,signature_"));
  int rows = 0;
  while (std::getline(table, line)) {
    std::vector<std::string> cells;
    std::istringstream one(line);
    for (std::string cell; std::getline(one, cell, ',');) cells.push_back(cell);
    const auto number = [&cells](std::size_t k) { return std::stod(cells.at(k)); };
    EXPECT_NEAR(number(11), cells[0] == "axial" ? 0.15 : 0.3, 1e-9) << line;
    EXPECT_NEAR((number(8) - number(9)) / number(11), number(12), 1e-4 + 1e-5 * std::abs(number(12))) << line;
    // What the cause changes is what it takes from the residuals.
    EXPECT_NEAR(number(12) - number(13), number(14), 1e-4 + 1e-5 * std::abs(number(12))) << line;  // six digits
    ++rows;
  }
  EXPECT_EQ(rows, 60);
}

TEST(Diagnose, ConsidersOnlyTheMechanismsAskedFor) {
  const WithAxialFibres measured;
  ASSERT_EQ(tunica(measured, {"diagnose", "experiment.json", "-o", "out", "--quick", "--quiet", "--mechanisms",
                              "force_offset,axial_fibres"})
                .code,
            0);
  const json found = result(measured, "out")["diagnosis"];
  EXPECT_EQ(found["detectable"].size(), 2u);
  EXPECT_EQ(found["causes"][0]["id"], "axial_fibres");
}

TEST(Diagnose, RefusesUnknownMechanisms) {
  Measured measured;
  EXPECT_THAT(refused(measured, {"--mechanisms", "force_ofset"}),
              AllOf(HasSubstr("--mechanisms: no loaded plugin provides the mechanism 'force_ofset'"),
                    HasSubstr("Did you mean 'force_offset'?")));
  measured.experiment["diagnosis"]["mechanisms"] = {"force_ofset"};
  EXPECT_THAT(refused(measured), AllOf(HasSubstr("unknown mechanism 'force_ofset' (/diagnosis/mechanisms/0, line "),
                                       HasSubstr("Did you mean 'force_offset'?")));
  measured.experiment["diagnosis"]["mechanisms"] = json::array();
  EXPECT_THAT(refused(measured), HasSubstr("the list is empty"));
  measured.experiment["diagnosis"]["mechanisms"] = "force_offset";
  EXPECT_THAT(refused(measured), HasSubstr("for example [\"force_offset\"]"));
}

TEST(Diagnose, RefusesWhatLeavesNothingToJudgeBy) {
  Measured held_out;
  for (const Strip& strip : held_out.strips) held_out.experiment["tests"][strip.name]["hold_out"] = true;
  EXPECT_THAT(refused(held_out), HasSubstr("held out"));
  const Measured short_one({{.stretch = {1.1, 1.2, 1.3}}});
  EXPECT_THAT(
      refused(short_one),
      HasSubstr("diagnosis: 3 parameters are fitted to 3 rows, which leaves nothing to test the model with. Fix "
                "parameters or give more rows"));
}

TEST(Diagnose, WarnsOfNoiseThatItHadToEstimate) {
  Measured measured;
  measured.measure(26);
  measured.experiment["tests"]["axial"]["data"].erase("noise");
  const Ended ended = tunica(measured, {"diagnose", "experiment.json", "-o", "out", "--quick", "--quiet"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("no noise is stated"));
  const json found = result(measured, "out");
  EXPECT_THAT(found["warnings"].dump(), HasSubstr("that neither a mechanism nor a smooth shape can explain: axial"));
  for (const json& noise : found["diagnosis"]["noise"]) {
    const bool open = noise["test"] == "axial";
    EXPECT_EQ(noise["source"], open ? "encompassing" : "stated");
    EXPECT_EQ(noise["freedom"].is_number() && noise["neighbours"].is_number(), open);
  }
}

TEST(DiagnoseBatch, GoesThroughFoldersAndSkipsWhatIsDone) {
  const Measured measured;
  measured.measure(27);
  measured.save();
  const auto root = measured.folder.path() / "cases";
  for (const char* name : {"a", "b", "empty"}) std::filesystem::create_directories(root / name);
  for (const char* name : {"a", "b"})
    for (const char* file : {"experiment.json", "circumferential.csv", "axial.csv"})
      std::filesystem::copy_file(measured.folder.path() / file, root / name / file);
  Ended ended = trial::tunica({"diagnose", "--batch", "--quick", "cases", "-o", "found"}, measured.folder.path());
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("2 diagnoses made, 0 failed"));
  EXPECT_EQ(result(measured, "found/a")["diagnosis"], result(measured, "found/b")["diagnosis"]);
  std::filesystem::remove(measured.folder.path() / "found/b/result.json");
  std::filesystem::remove(root / "b" / "axial.csv");
  ended = trial::tunica({"diagnose", "--batch", "--quick", "cases", "-o", "found"}, measured.folder.path());
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.out, HasSubstr("0 diagnoses made, 1 failed"));
  EXPECT_THAT(ended.err, AllOf(HasSubstr("cases/b"), HasSubstr("axial.csv")));
}

TEST(DiagnoseBatch, RefusesAFolderThatIsNotThere) {
  const Measured measured;
  const Ended ended = tunica(measured, {"diagnose", "--batch", "nowhere"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("--batch nowhere: no such folder. Name one that holds folders with an "
                                   "experiment.json each"));
}

}  // namespace
}  // namespace tunica::trial
