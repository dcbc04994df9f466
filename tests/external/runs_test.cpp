// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include <gmock/gmock.h>

#include "external/gone.hpp"
#include "external/solver.hpp"

using namespace tunica;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(External, ParametersAreFoundThroughAProgramOfFiles) {
  trial::SolverBench bench;
  const auto ended = bench.run();
  ASSERT_EQ(ended.code, 0) << ended.err << ended.out;
  EXPECT_NEAR(bench.parameter("mu"), 310, 310 * 1e-3);
  EXPECT_NEAR(bench.parameter("Jm"), 12, 12 * 1e-3);
  EXPECT_GT(bench.solver_runs(), 0U);
  EXPECT_THAT(ended.out, HasSubstr("solver runs"));
  EXPECT_TRUE(std::filesystem::is_empty(bench.folder.path() / "scratch"));
}

// mu = 100 kPa and a compliance of 0.004/kPa, K = 250 kPa: C10 = 0.05 MPa, D1 = 2/K = 8/MPa on the card that the solver
// reads. With full invariants no card has the material.
TEST(External, TheCardHasTheFittedCompressibility) {
  const trial::Folder seen;
  const std::string copy = (seen.path() / "card.inp").string();
  trial::SolverBench bench(310, 12, "cp card.inp " + copy);
  bench.folder.write("card.in", "{{card}}");
  bench.test["templates"]["card.inp"] = "card.in";
  bench.folder.write("input.in", "mu_MPa=0.3\nJm=12\n");
  bench.test["card"] = {{"program", "abaqus"}, {"units", "mm-N-MPa"}, {"material", "PAD"}};
  bench.experiment["models"]["gent"] = {{"type", "neo_hooke"}, {"parameters", {{"mu", {{"initial", 100}}}}}};
  bench.experiment["models"]["gent"]["mechanisms"] = {{{"type", "compressibility"},
                                                       {"invariants", "isochoric"},
                                                       {"law", "quadratic"},
                                                       {"parameters", {{"compliance", {{"initial", 0.004}}}}}}};
  const auto ended = bench.tunica({"simulate", "experiment.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err << ended.out;
  const std::string card = trial::text_of(copy);
  EXPECT_THAT(card, AllOf(HasSubstr("*MATERIAL, NAME=PAD"), HasSubstr("*HYPERELASTIC, NEO HOOKE\n0.05, 8\n")));
  bench.experiment["models"]["gent"]["mechanisms"][0]["invariants"] = "full";
  const auto refused = bench.tunica({"simulate", "experiment.json", "-o", "other"});
  EXPECT_NE(refused.code, 0);
  EXPECT_THAT(refused.err + refused.out, HasSubstr("the mechanism 'compressibility' has full invariants"));
}

TEST(External, UpdatesSaveRunsAndDifferencesAgree) {
  trial::SolverBench bench;
  ASSERT_EQ(bench.run("broyden").code, 0);
  bench.test["derivatives"] = "forward";
  ASSERT_EQ(bench.run("forward").code, 0);
  bench.test["derivatives"] = "central";
  ASSERT_EQ(bench.run("central").code, 0);
  EXPECT_LE(static_cast<double>(bench.solver_runs("broyden")), 0.6 * static_cast<double>(bench.solver_runs("forward")));
  EXPECT_GT(bench.solver_runs("central"), bench.solver_runs("forward"));
  for (const char* run : {"forward", "central"})
    EXPECT_NEAR(bench.parameter("mu", run), bench.parameter("mu", "broyden"), 310 * 1e-3) << run;
}

// Starts run side by side, and each has a memory of its own.
TEST(External, ResultsDoNotDependOnTheNumberOfThreads) {
  trial::SolverBench bench;
  bench.experiment["optimizers"]["lm"]["starts"] = 3;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "--threads", "1", "-o", "one"}).code, 0);
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "--threads", "3", "-o", "three"}).code, 0);
  EXPECT_EQ(bench.result("one")["best"]["parameters"], bench.result("three")["best"]["parameters"]);
  EXPECT_EQ(bench.result("one")["best"]["objective"], bench.result("three")["best"]["objective"]);
}

TEST(External, AKilledRunCostsOneEvaluation) {
  // The seventh run is killed, as the system does where memory is short.
  const trial::Folder counted;
  trial::SolverBench bench(310, 12,
                           "echo >> " + (counted.path() / "runs").string() + "\n[ $(wc -l < " +
                               (counted.path() / "runs").string() + ") = 7 ] && kill -9 $$");
  const auto ended = bench.run();
  ASSERT_EQ(ended.code, 0) << ended.err << ended.out;
  EXPECT_NEAR(bench.parameter("mu"), 310, 310 * 1e-3);
  EXPECT_LE(bench.result()["failures"], 1);
  EXPECT_EQ(bench.result()["efforts"]["strip"]["failed_runs"], 1);
}

TEST(External, AProgramThatHangsIsEndedAtItsLimit) {
  trial::SolverBench bench(310, 12, "echo begun; sleep 60");
  bench.test["time_limit"] = "0.5 s";
  bench.experiment["stop"]["max_evaluations"] = 1;
  const auto begun = std::chrono::steady_clock::now();
  const auto ended = bench.run();
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(30));
  EXPECT_NE(ended.code, 0);
  EXPECT_THAT(bench.result()["first_failure"].get<std::string>(),
              AllOf(HasSubstr("was ended at its time limit of 0.5 s"), HasSubstr("begun")));
}

TEST(External, AFailureShowsTheLastLinesAndKeepsTheFolder) {
  trial::SolverBench bench(310, 12, "echo matrix is singular; exit 3");
  bench.experiment["stop"]["max_evaluations"] = 1;
  EXPECT_NE(bench.run().code, 0);
  const std::string reason = bench.result()["first_failure"];
  EXPECT_THAT(reason, AllOf(HasSubstr("exit code 3"), HasSubstr("matrix is singular"), HasSubstr("tunica-failed-*")));
  EXPECT_FALSE(std::filesystem::is_empty(bench.folder.path() / "scratch"));
}

TEST(External, MissingResultsAreAFailedEvaluation) {
  trial::SolverBench bench(310, 12, "echo nothing to do; exit 0");
  bench.experiment["stop"]["max_evaluations"] = 1;
  EXPECT_NE(bench.run().code, 0);
  EXPECT_THAT(
      bench.result()["first_failure"].get<std::string>(),
      AllOf(HasSubstr("ended well, but 'curve.csv'"), HasSubstr("was not written"), HasSubstr("nothing to do")));
}

TEST(External, ResultsAreKeptByContent) {
  trial::SolverBench bench;
  bench.test["cache"] = "cache";
  ASSERT_EQ(bench.run("first").code, 0);
  ASSERT_EQ(bench.run("second").code, 0);
  EXPECT_EQ(bench.solver_runs("second"), 0U);
  EXPECT_EQ(bench.parameter("mu", "first"), bench.parameter("mu", "second"));
  bench.folder.write("input.in", "mu_MPa={{mu MPa}}\nJm={{Jm}}\n\n");  // other content
  ASSERT_EQ(bench.run("third").code, 0);
  EXPECT_GT(bench.solver_runs("third"), 0U);
}

TEST(External, AnotherProgramIsAnotherResult) {
  trial::SolverBench bench;
  bench.test["cache"] = "cache";
  ASSERT_EQ(bench.run("first").code, 0);
  std::string program = trial::text_of(bench.folder.path() / "gent.sh");
  bench.folder.write("solve.sh", program + "# another\n");
  bench.test["command"] = {"sh", (bench.folder.path() / "solve.sh").string()};
  ASSERT_EQ(bench.run("second").code, 0);
  EXPECT_GT(bench.solver_runs("second"), 0U);
  ASSERT_EQ(bench.run("third").code, 0);
  EXPECT_EQ(bench.solver_runs("third"), 0U);
  bench.folder.write("solve.sh", program + "# a third\n");
  ASSERT_EQ(bench.run("fourth").code, 0);
  EXPECT_GT(bench.solver_runs("fourth"), 0U);
}

// Two tests read different columns of one program's results.
TEST(External, TestsThatShareACacheReadTheirOwnColumns) {
  trial::SolverBench bench;
  bench.test["cache"] = "cache";
  bench.test["results"]["diameter"] = {{"file", "curve.csv"}, {"column", "u [mm]"}, {"start", 0}};
  bench.test["data"]["columns"] = {{"displacement", "u"}};
  nlohmann::json forces = bench.test;
  bench.test["data"]["columns"]["diameter"] = "d";
  forces["data"]["columns"]["force"] = "d";
  bench.folder.write("data.csv", "u [mm],d\n8,1\n16,1\n40,1\n");
  bench.experiment["tests"]["forces"] = forces;
  bench.folder.write("values.json", R"({"mu": 310, "Jm": 12})");
  const auto ended =
      bench.tunica({"simulate", "experiment.json", "--model", "gent", "--parameters", "values.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err << ended.out;
  const std::string diameters = trial::text_of(bench.folder.path() / "out/strip.csv");
  EXPECT_THAT(diameters, AllOf(HasSubstr("8,8"), HasSubstr("16,16"), HasSubstr("40,40"))) << diameters;
  EXPECT_THAT(trial::text_of(bench.folder.path() / "out/forces.csv"), ::testing::Not(HasSubstr("40,40")));
}

TEST(External, TwoFilesOfOneNameAreRefused) {
  trial::SolverBench bench;
  bench.test["files"] = {"gent.sh", "other/gent.sh"};
  std::filesystem::create_directories(bench.folder.path() / "other");
  bench.folder.write("other/gent.sh", "");
  auto ended = bench.run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("'gent.sh'"), HasSubstr("give each its own")));
  bench.test["files"] = {"gent.sh"};
  bench.test["templates"] = {{"output.txt", "input.in"}};
  ended = bench.run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("takes what the program prints"));
}

// At its fifth run the solver sends Ctrl-C to tunica (its keeper's parent), starts a program of its own and waits.
TEST(External, CtrlCEndsTheSolverAndTheRunGoesOnLater) {
  trial::SolverBench whole;
  ASSERT_EQ(whole.run().code, 0);
  const trial::Folder counted;
  const std::string runs = (counted.path() / "runs").string(), child = (counted.path() / "child").string();
  trial::SolverBench bench(310, 12,
                           "echo >> " + runs + "\nif [ $(wc -l < " + runs +
                               ") = 5 ]; then kill -INT $(cut -d' ' -f4 /proc/$PPID/stat); sleep 300 & echo $! > " +
                               child + "; wait; fi");
  const auto ended = bench.run();
  EXPECT_EQ(ended.code, 130) << ended.err << ended.out;
  EXPECT_TRUE(std::filesystem::is_empty(bench.folder.path() / "scratch"));
  EXPECT_TRUE(trial::is_gone(std::stoi(trial::text_of(child))));
  const auto resumed = bench.tunica({"run", "experiment.json", "-o", "out", "--resume"});
  EXPECT_EQ(resumed.code, 0) << resumed.err << resumed.out;
  EXPECT_EQ(bench.result()["best"]["parameters"], whole.result()["best"]["parameters"]);
  EXPECT_EQ(bench.result()["evaluations"], whole.result()["evaluations"]);
  EXPECT_EQ(bench.result()["failures"], 0);
}

TEST(External, ATemplateWithoutAParameterOfTheSearchIsRefused) {
  trial::SolverBench bench;
  bench.folder.write("input.in", "mu_MPa={{mu MPa}}\nJm=12\n");
  auto ended = bench.run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("test 'strip'"), HasSubstr("searches for 'Jm'"), HasSubstr("fixed")));
  bench.experiment["models"]["gent"]["parameters"]["Jm"] = {{"fixed", 12}};
  ended = bench.run();
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NEAR(bench.parameter("mu"), 310, 310 * 1e-3);
}

TEST(External, AMisspeltParameterIsRefusedWithTheNearestName) {
  trial::SolverBench bench;
  bench.folder.write("input.in", "mu_MPa={{my MPa}}\nJm={{Jm}}\n");
  const auto ended = bench.run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("'my'"), HasSubstr("Did you mean 'mu'")));
}

TEST(External, AProgramThatIsNotThereIsRefused) {
  trial::SolverBench bench;
  bench.test["command"] = {"no_such_solver", "input"};
  auto ended = bench.run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("'no_such_solver'"), HasSubstr("PATH")));
  bench.test["command"] = {"./solver"};
  ended = bench.run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("does not exist"));
}

TEST(External, ResultsThatDoNotSayWhereAreRefused) {
  trial::SolverBench bench;
  bench.test["results"].erase("force");
  auto ended = bench.run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("'force'"), HasSubstr("\"results\"")));
  bench.test["results"]["force"] = {{"file", "curve.csv"}, {"pattern", "no group"}};
  ended = bench.run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("no group"));
  bench.test["results"]["force"] = {{"file", "../curve.csv"}, {"column", 2}};
  ended = bench.run();
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("without '..'"));
}

TEST(External, AnEffectOnTheDataCostsNoRuns) {
  trial::SolverBench bench;
  bench.test["mechanisms"] = {{{"type", "signal_drift"}}};
  const auto ended = bench.run();
  ASSERT_EQ(ended.code, 0) << ended.err << ended.out;
  EXPECT_NEAR(bench.parameter("mu"), 310, 310 * 1e-2);
  EXPECT_GT(bench.result()["efforts"]["strip"]["cached_results"], 0);
}

TEST(External, ACurveThatEndsTooEarlyNamesTheRow) {
  trial::SolverBench bench;
  std::string text = trial::text_of(bench.folder.path() / "data.csv");
  bench.folder.write("data.csv", text + "84,3000\n");
  bench.experiment["stop"]["max_evaluations"] = 1;
  EXPECT_NE(bench.run().code, 0);
  EXPECT_THAT(bench.result()["first_failure"].get<std::string>(),
              AllOf(HasSubstr("row 20"), HasSubstr("from 0 to 80")));
}

// A file of somebody else may name any command.
TEST(External, CheckShowsTheCommandAndStartsItOnDemand) {
  const trial::Folder counted;
  const auto mark = counted.path() / "was_here";
  trial::SolverBench bench(310, 12, "touch " + mark.string());
  const auto shown = bench.tunica({"check", "experiment.json"});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_THAT(shown.out, AllOf(HasSubstr("test 'strip' runs: sh gent.sh"), HasSubstr("--run-external")));
  EXPECT_FALSE(std::filesystem::exists(mark));
  const auto json = bench.tunica({"check", "experiment.json", "--json"});
  EXPECT_THAT(json.out, HasSubstr("\"not_run\""));
  EXPECT_FALSE(std::filesystem::exists(mark));
  const auto started = bench.tunica({"check", "experiment.json", "--run-external"});
  EXPECT_EQ(started.code, 0) << started.err;
  EXPECT_THAT(started.out, HasSubstr("at the initial point: objective"));
  EXPECT_TRUE(std::filesystem::exists(mark));
}

// It writes all the while, to its output and to its results: what counts is the whole time.
constexpr const char* drips = "while :; do echo .; echo . >> curve.csv; sleep 0.05; done";

TEST(External, MaxTimeEndsAProgramThatHangsOrDrips) {
  for (const char* how : {"sleep 60", drips}) {
    trial::SolverBench bench(310, 12, how);
    bench.experiment["stop"]["max_time"] = "1 s";
    const auto begun = std::chrono::steady_clock::now();
    const auto ended = bench.run();
    EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(40));
    EXPECT_EQ(ended.code, 1) << ended.err;
    EXPECT_THAT(bench.result()["first_failure"].get<std::string>(), HasSubstr("its max_time was over")) << how;
    EXPECT_THAT(ended.out, HasSubstr("tunica check experiment.json --run-external")) << "what to do next";
  }
}

TEST(External, AProgramThatDripsIsEndedAtItsLimit) {
  trial::SolverBench bench(310, 12, drips);
  bench.test["time_limit"] = "0.5 s";
  bench.experiment["stop"]["max_evaluations"] = 1;
  EXPECT_NE(bench.run().code, 0);
  EXPECT_THAT(bench.result()["first_failure"].get<std::string>(), HasSubstr("was ended at its time limit of 0.5 s"));
}

TEST(External, AFileWithoutEndIsEndedAtItsLimit) {
  trial::SolverBench bench(310, 12, "exec yes > large");
  bench.test["output_limit"] = 1;
  bench.experiment["stop"]["max_evaluations"] = 1;
  EXPECT_NE(bench.run().code, 0);
  EXPECT_THAT(bench.result()["first_failure"].get<std::string>(), HasSubstr("output_limit"));
}

TEST(External, FoldersOfAnEndedProcessAreSwept) {
  trial::SolverBench bench;
  bench.experiment["stop"]["max_evaluations"] = 2;
  std::filesystem::create_directories(bench.folder.path() / "scratch/tunica-running-abcdef/below");
  std::filesystem::create_directories(bench.folder.path() / "scratch/tunica-failed-abcdef");
  static_cast<void>(bench.run());
  EXPECT_FALSE(std::filesystem::exists(bench.folder.path() / "scratch/tunica-running-abcdef"));
  EXPECT_TRUE(std::filesystem::exists(bench.folder.path() / "scratch/tunica-failed-abcdef"));
}
