// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>

#include <gmock/gmock.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::HasSubstr;

TEST(Run, WritesEverythingItPromises) {
  const trial::Bench bench;
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  for (const char* file :
       {"result.json", "evaluations.csv", "fit_circ.csv", "fit_axial.csv", "input.json", "run.log", "checkpoint.json"})
    EXPECT_TRUE(std::filesystem::exists(bench.path("out") / file)) << file;
  EXPECT_FALSE(std::filesystem::exists(bench.path("out/parts")));
  const auto result = bench.result("out");
  ASSERT_EQ(result["runs"].size(), 2u);
  const auto& neo = result["runs"][0];
  EXPECT_EQ(neo["model"], "neo");
  EXPECT_EQ(neo["best"]["parameters"].size(), 1u);
  EXPECT_EQ(neo["best"]["status"], "ok");
  EXPECT_EQ(result["runs"][1]["realisations"], 3);
  EXPECT_EQ(result["runs"][1]["evaluations"], 1800);
  EXPECT_EQ(result["ranking"].size(), 2u);
  EXPECT_EQ(result["provenance"]["seed"], 7);
  EXPECT_TRUE(neo["best"]["parameters"]["mu"]["ci95"].is_array());
  EXPECT_GT(neo["best"]["per_test"]["circ"]["channels"][0]["r2"], 0.9);
  // One row an evaluation, and the best of them is the one that is reported.
  const auto rows = bench.text("out/evaluations.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + neo["evaluations"].get<long>() + 1800);
  const auto fit = bench.text("out/fit_circ.csv");
  EXPECT_EQ(fit.substr(0, fit.find('\n')),
            "run,stretch [1],stress [kPa],stress.predicted [kPa],held_out,transverse_stretch,normal_stretch,"
            "stress.ci95 [kPa],stress.lowest [kPa],stress.highest [kPa]");
  EXPECT_EQ(std::count(fit.begin(), fit.end(), '\n'), 1 + 2 * 20);
}

TEST(Run, WritesBothStretchesOfABiaxialFit) {
  trial::Bench bench;
  bench.folder.write("sheet.csv", "lt [1],lz [1],st [kPa],sz [kPa]\n1.05,1.1,2,3\n1.1,1.15,4,5\n1.2,1.2,9,9\n");
  bench.experiment["tests"] = {{"sheet",
                                {{"type", "biaxial"},
                                 {"data",
                                  {{"file", "sheet.csv"},
                                   {"columns",
                                    {{"stretch_circumferential", "lt"},
                                     {"stretch_axial", "lz"},
                                     {"stress_circumferential", "st"},
                                     {"stress_axial", "sz"}}}}}}}};
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto fit = bench.text("out/fit_sheet.csv");
  const auto header = fit.substr(0, fit.find('\n'));
  for (const char* column : {"stretch_circumferential [1],", "stretch_axial [1],", "stress_axial.predicted [kPa],"})
    EXPECT_THAT(header, ::testing::HasSubstr(column));
  EXPECT_THAT(fit, ::testing::AnyOf(::testing::HasSubstr(",1.05,1.1,"), ::testing::HasSubstr(",1.1,1.05,")));
}

TEST(Run, WritesTheComparisonAsTables) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  const auto lines = [&](const char* file) {
    const auto text = bench.text(std::string("out/") + file);
    return std::count(text.begin(), text.end(), '\n');
  };
  EXPECT_EQ(lines("ranking.csv"), 1 + 2);
  EXPECT_EQ(lines("realisations.csv"), 1 + 4);
  EXPECT_GE(lines("statistics.csv"), 2 + 2 * 4);
  EXPECT_THAT(bench.text("out/statistics.csv"), HasSubstr("\ngho/es,mu,kPa,3,"));
  EXPECT_THAT(bench.text("out/ranking.csv"), HasSubstr(",evaluations_total,jacobians_total,failures,"));
  EXPECT_GT(lines("convergence.csv"), 3 + 4 * 3);
  EXPECT_GE(lines("performance_profile.csv"), 3 + 2);
  EXPECT_GE(lines("data_profile.csv"), 3 + 2);
  const auto statistics = bench.result("out")["runs"][1]["statistics"];
  EXPECT_EQ(statistics["count"], 3);
  EXPECT_LE(statistics["q1"], statistics["median"]);
  EXPECT_GE(statistics["successes"], 1);
  EXPECT_GE(statistics["expected_running_time"], statistics["evaluations_to_target"]["min"]);
}

TEST(Run, CertifiesItsOptimaInAFreshProcess) {
  const trial::Bench bench;
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto result = bench.result("out");
  EXPECT_EQ(result["runs"].size(), 2u);
  for (const auto& run : result["runs"]) {
    const auto& certificate = run["best"]["certificate"];
    ASSERT_TRUE(certificate["fresh_process"].is_object()) << certificate.dump();
    EXPECT_LT(std::abs(certificate["fresh_process"]["difference"].get<double>()), 1e-9);
    EXPECT_EQ(certificate["neighbours"]["failed"], 0);
  }
  EXPECT_THAT(ended.out, HasSubstr("optimum: evaluated "));
  // The verb by itself says the same.
  const auto again = bench.tunica({"certify", "out"});
  ASSERT_EQ(again.code, 0) << again.err;
  const auto certified = nlohmann::json::parse(again.out);
  EXPECT_EQ(certified["runs"].size(), 2u);
  EXPECT_EQ(certified["runs"][0]["recorded"], bench.result("out")["runs"][0]["best"]["objective"]);
}

TEST(Run, IsContradictedByCertifyWhereAnObjectiveWasChanged) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out", "--no-certificate"}).code, 0);
  auto result = bench.result("out");
  result["runs"][0]["best"]["objective"] = 0.5 * result["runs"][0]["best"]["objective"].get<double>();
  bench.folder.write("out/result.json", result.dump());
  const auto ended = bench.tunica({"certify", "out"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.err, HasSubstr("error: neo/lm: not confirmed: result.json records the objective "));
  EXPECT_EQ(nlohmann::json::parse(ended.out)["runs"].size(), 2u);
}

TEST(Run, SaysThatNoFeasiblePointWasFoundBeforeAnythingElse) {
  trial::Bench bench;
  auto& parameters = bench.experiment["models"]["gho"]["parameters"];
  parameters = {{"mu", {{"max", 2}}},
                {"k1", {{"min", 20}}},
                {"k2", {{"min", 0.5}, {"max", 1}}},
                {"theta", {{"min", 40}, {"max", 50}}},
                {"kappa", {{"min", 0}, {"max", 0.01}}}};
  bench.experiment["runs"] = {
      {{"model", "gho"}, {"optimizer", "lm"}},
      {{"model", "gho"}, {"optimizer", "lm"}, {"constraints", {{{"type", "transverse_stability"}, {"h", 0.7}}}}}};
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.out.find("Warnings\n  ! gho/lm#2: no feasible point was found in "), std::string::npos) << ended.out;
  EXPECT_EQ(ended.out.find("gho/lm#2: unstable"), std::string::npos) << "of a point that is no fit";
  const auto best = bench.result("out")["runs"][1]["best"];
  EXPECT_EQ(best["status"], "infeasible");
  EXPECT_EQ(best["stability"]["ratio_to_free"], nullptr);
  EXPECT_EQ(best["parameters"]["k1"]["ci95"], nullptr);
}

TEST(Run, LeavesTheCertificateOutOnDemand) {
  const trial::Bench bench;
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out", "--no-certificate"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto result = bench.result("out");
  EXPECT_TRUE(result["runs"][0]["best"]["certificate"]["fresh_process"].is_null());
  const std::string verdict = result["runs"][0]["best"]["certificate"]["verdict"];
  EXPECT_THAT(verdict, HasSubstr("not evaluated again in a fresh process (--no-certificate was given)"));
}

TEST(Run, MakesProfilesAndBootstrapOnDemandAlsoOfAFinishedRun) {
  trial::Bench bench;
  bench.experiment["runs"][1] = {{"model", "gho"}, {"optimizer", "lm"}};  // 600 evaluations of es are no optimum
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  EXPECT_FALSE(std::filesystem::exists(bench.path("out/bootstrap.csv")));
  const auto before = bench.text("out/evaluations.csv");
  const auto ended =
      bench.tunica({"run", "experiment.json", "-o", "out", "--resume", "--profiles", "mu,k1", "--bootstrap", "40"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(bench.text("out/evaluations.csv"), before);
  EXPECT_EQ(nlohmann::json::parse(bench.text("out/input.json"))["analysis"]["profiles"].size(), 2u);
  const auto best = bench.result("out")["runs"][0]["best"];
  const auto& mu = best["parameters"]["mu"];
  EXPECT_LT(mu["profile_ci95"][0], mu["value"]);
  EXPECT_GT(mu["profile_ci95"][1], mu["value"]);
  EXPECT_LT(mu["bootstrap_ci95"][0], mu["bootstrap_ci95"][1]);
  EXPECT_EQ(best["bootstrap"]["draws"], 40);
  EXPECT_EQ(best["bootstrap"]["failed"], 0);
  EXPECT_THAT(ended.out, HasSubstr("profile ("));
  const auto rows = bench.text("out/bootstrap.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + 2 * 40);
  EXPECT_THAT(bench.text("out/profile_mu.csv"), HasSubstr("\nneo/lm,"));
  EXPECT_THAT(bench.text("out/profile_k1.csv"), ::testing::Not(HasSubstr("\nneo/lm,")));
  // The same for another number of threads.
  ASSERT_EQ(
      bench.tunica({"run", "experiment.json", "-o", "one", "-j", "1", "--profiles", "mu,k1", "--bootstrap", "40"}).code,
      0);
  EXPECT_EQ(bench.text("one/bootstrap.csv"), rows);
  EXPECT_EQ(bench.text("one/profile_mu.csv"), bench.text("out/profile_mu.csv"));
}

TEST(Run, RefusesNamesOfProfilesThatAreNone) {
  trial::Bench bench;
  const auto refused = bench.tunica({"run", "experiment.json", "-o", "never", "--profiles", ",", "--quiet"});
  EXPECT_EQ(refused.code, 2) << refused.out;
  EXPECT_THAT(refused.err, HasSubstr("is not the name of a parameter; expected names separated by commas"));
}

TEST(Run, LeavesTheThresholdOfSuccessEmptyWhereNothingIsFeasible) {
  trial::Bench bench;
  bench.experiment["constraints"] = {{{"type", "transverse_stability"}, {"h", 0}}};
  // Oblique fibres without dispersion always thicken the strip at the end: Ψ ≡ 1 is out of reach.
  auto& parameters = bench.experiment["models"]["gho"]["parameters"];
  parameters["kappa"] = {{"fixed", 0}}, parameters["theta"] = {{"fixed", 45}}, parameters["k1"] = {{"fixed", 20}};
  bench.experiment["runs"] = {{{"model", "gho"}, {"optimizer", "es"}, {"stop", {{"max_evaluations", 200}}}}};
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_EQ(bench.result("out")["runs"][0]["best"]["status"], "infeasible") << ended.err;
  EXPECT_THAT(bench.text("out/ranking.csv"), ::testing::Not(HasSubstr("inf,")));
}

TEST(Run, WritesAResultThatItsSchemaAccepts) {
  trial::Bench bench;
  bench.experiment["tests"]["axial"]["hold_out"] = true;
  bench.experiment["models"]["gho"]["parameters"]["kappa"] = {{"fixed", 0.1}};
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out", "--profiles", "all", "--bootstrap", "40"}).code, 0);
  const std::string program =
      "import json, sys, jsonschema; "
      "jsonschema.Draft7Validator(json.load(open(sys.argv[1]))).validate(json.load(open(sys.argv[2])))";
  const auto ended =
      trial::Process({TUNICA_PYTHON, "-c", program, TUNICA_SOURCE_DIR "/schemas/tunica-result.schema.json",
                      bench.path("out/result.json").string()},
                     bench.folder.path())
          .wait();
  if (ended.err.find("No module named 'jsonschema'") != std::string::npos)
    GTEST_SKIP() << "the independent validator is not installed (python3-jsonschema)";
  EXPECT_EQ(ended.code, 0) << ended.err;
  const auto result = bench.result("out");
  EXPECT_EQ(result["runs"][1]["fixed"]["kappa"]["value"], 0.1);
  EXPECT_EQ(result["runs"][0]["best"]["per_test"]["axial"]["channels"][0]["held_out"], true);
  EXPECT_THAT(result["warnings"].dump(), HasSubstr("test axial: all rows are held out"));
  EXPECT_THAT(bench.text("out/fit_axial.csv"), HasSubstr(",1,"));
}

TEST(Run, EndsWithTheTableThePathAndTheNextStep) {
  const trial::Bench bench;
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  for (const char* text : {"objective", "success", "neo/lm", "gho/es", "best of 3 realisations", "RMSE ", "R² ",
                           "Results: out/result.json", "Next:    tunica simulate experiment.json --model"})
    EXPECT_THAT(ended.out, HasSubstr(text));
  std::istringstream stream(ended.out);
  for (std::string line; std::getline(stream, line);) {
    const auto width = std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xC0) != 0x80; });
    EXPECT_LE(width, 80) << line;
  }
}

// What is poor depends on the tolerance.
TEST(Run, SendsAPoorFitToTheDiagnosis) {
  trial::Bench bench;
  bench.experiment["runs"] = {{{"model", "neo"}, {"optimizer", "lm"}}};
  const auto next = [&bench](const char* tolerance, const char* folder) {
    bench.experiment["diagnosis"]["tolerance"] = tolerance;
    return bench.tunica({"run", "experiment.json", "-o", folder}).out;
  };
  EXPECT_THAT(next("0.001 %", "strict"), HasSubstr("Next:    tunica diagnose experiment.json"));
  EXPECT_THAT(next("50 %", "loose"), HasSubstr("Next:    tunica simulate experiment.json --model neo"));
}

TEST(Run, WritesNoControlCharactersToPipes) {
  const trial::Bench bench;
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  for (const std::string& text : {ended.out, ended.err})
    EXPECT_TRUE(std::none_of(text.begin(), text.end(),
                             [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) && c != '\n'; }));
}

TEST(Run, DrawsABarOnATerminalAndObeysNoColor) {
  if (!std::filesystem::exists("/usr/bin/script")) GTEST_SKIP() << "there is no script(1) to make a terminal with";
  trial::Bench bench;
  bench.experiment["stop"]["max_evaluations"] = 60000;
  bench.save();
  const auto on_terminal = [&](const std::string& folder, const std::string& environment) {
    std::string line = "TERM=xterm " + environment;
    for (const auto& word : trial::tunica_command({"run", "experiment.json", "-o", folder})) line += " '" + word + "'";
    const auto ended = trial::Process({"/usr/bin/script", "-qec", line, "/dev/null"}, bench.folder.path()).wait();
    EXPECT_EQ(ended.code, 0);
    return ended.out;
  };
  const auto plain = on_terminal("plain", "NO_COLOR=1"), coloured = on_terminal("coloured", "NO_COLOR=");
  EXPECT_THAT(plain, HasSubstr("\r["));
  EXPECT_THAT(plain, HasSubstr("/s  gho/es: best "));
  EXPECT_THAT(plain, HasSubstr("\r\033[K"));
  EXPECT_THAT(plain, ::testing::Not(HasSubstr("\033[36m")));
  EXPECT_THAT(coloured, HasSubstr("\033[36m"));
}

TEST(Run, IsSilentOnStderrWhenAsked) {
  const trial::Bench bench;
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out", "--quiet"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err, "");
}

TEST(Run, GivesTheSameResultForAnyNumberOfThreads) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "one", "-j", "1"}).code, 0);
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "two", "-j", "2"}).code, 0);
  EXPECT_EQ(trial::without_times(bench.result("one")), trial::without_times(bench.result("two")));
  EXPECT_EQ(trial::without_times(bench.text("one/evaluations.csv")),
            trial::without_times(bench.text("two/evaluations.csv")));
  EXPECT_EQ(bench.text("one/fit_circ.csv"), bench.text("two/fit_circ.csv"));
}

TEST(Run, TakesTheSeedOfTheCommandLine) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "seven"}).code, 0);
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "eight", "--seed", "8"}).code, 0);
  EXPECT_EQ(nlohmann::json::parse(bench.text("eight/input.json"))["seed"], 8);
  EXPECT_EQ(bench.result("eight")["provenance"]["seed"], 8);
  EXPECT_NE(bench.result("seven")["runs"][1]["best"]["parameters"],
            bench.result("eight")["runs"][1]["best"]["parameters"]);
}

TEST(Run, CanBeRepeatedFromItsInput) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "first"}).code, 0);
  std::filesystem::copy_file(bench.path("first/input.json"), bench.path("again.json"));
  ASSERT_EQ(bench.tunica({"run", "again.json", "-o", "second"}).code, 0);
  auto first = trial::without_times(bench.result("first")), second = trial::without_times(bench.result("second"));
  EXPECT_EQ(first["runs"], second["runs"]);
}

TEST(Run, ShoutsAboutParametersAtTheirBounds) {
  trial::Bench bench;
  bench.experiment["models"]["neo"]["parameters"]["mu"] = {{"min", 1}, {"max", 5}, {"initial", 2}};
  bench.experiment["runs"].erase(1);
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_EQ(ended.code, 1) << "its mean is nearer to the data than the model";
  EXPECT_THAT(ended.out, HasSubstr("mu = 5 kPa lies at its upper bound"));
  EXPECT_THAT(ended.out, HasSubstr("<- at its upper bound"));
  const auto result = bench.result("out");
  EXPECT_EQ(result["runs"][0]["best"]["parameters"]["mu"]["at_bound"], "upper");
  ASSERT_EQ(result["warnings"].size(), result["warning_details"].size());
  EXPECT_EQ(result["warning_details"][0]["kind"], "misfit_out_of_scale") << "the bound keeps the model off the data";
  const auto& warning = result["warning_details"][1];
  EXPECT_EQ(warning["kind"], "at_bound");
  EXPECT_EQ(warning["run"], "neo/lm");
  EXPECT_EQ(warning["subjects"][0], "mu");
  EXPECT_EQ(result["warnings"][1], "neo/lm: " + warning["sentence"].get<std::string>());
}

TEST(Run, ReturnsOneAndNamesTheLimitWhereItsOptimiserHadNotConverged) {
  trial::Bench bench;
  bench.experiment["models"]["neo"]["parameters"]["mu"] = {{"min", 1}, {"max", 500}, {"initial", 2}};
  bench.experiment["optimizers"]["lm"]["max_iterations"] = 1;
  bench.experiment["optimizers"]["lm"]["starts"] = 1;
  bench.experiment["runs"].erase(1);
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_EQ(ended.code, 1) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("max_iterations"));
  const auto run = bench.result("out")["runs"][0];
  EXPECT_FALSE(run["converged"].get<bool>());
  EXPECT_EQ(run["limit"]["key"], "optimizers.lm.max_iterations");
  EXPECT_EQ(run["limit"]["value"], "1");
}

TEST(Run, SaysWhyWhenEveryEvaluationFails) {
  trial::Bench bench;
  // exp(k2 E²) overflows for every k2 in these bounds.
  bench.experiment["models"]["gho"]["parameters"]["k2"] = {{"min", 1e6}, {"max", 1e7}, {"initial", 2e6}};
  bench.experiment["runs"].erase(0);
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(ended.err, HasSubstr("error: no evaluation succeeded; the first reason: "));
  EXPECT_THAT(ended.out, HasSubstr("no result: "));
  const auto result = bench.result("out");
  EXPECT_TRUE(result["runs"][0]["best"].is_null());
  EXPECT_TRUE(result["ranking"][0]["rank"].is_null());
  EXPECT_EQ(result["runs"][0]["failures"], result["runs"][0]["evaluations"]);
}

TEST(Check, ShowsTheSetUpAndWritesNothing) {
  const trial::Bench bench;
  const auto ended = bench.tunica({"check", "experiment.json"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* text :
       {"gho/es: 3 realisations of at most 600 evaluations", "circ, stress: 20 rows", "mu ", "kPa", "log",
        "at the initial point: objective", "one evaluation takes", "In order. Next: tunica run experiment.json"})
    EXPECT_THAT(ended.out, HasSubstr(text));
  EXPECT_FALSE(std::filesystem::exists(bench.path("results")));
}

TEST(Run, TheAnalysisEndsAtMaxTimeAndSaysWhatItLeftOut) {
  trial::Bench bench;
  bench.experiment["runs"] = {{{"model", "neo"}, {"optimizer", "lm"}}};
  bench.experiment["stop"]["max_time"] = "1 s";
  bench.experiment["analysis"]["bootstrap"]["draws"] = 1000000;
  const auto begun = std::chrono::steady_clock::now();
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::minutes(2));  // minutes without the limit
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(bench.text("out/result.json"), HasSubstr("of 1000000 draws of the bootstrap: max_time of 1 s was over"));
  EXPECT_LT(bench.result("out")["runs"][0]["bootstrap"]["draws"], 1000000);
}
