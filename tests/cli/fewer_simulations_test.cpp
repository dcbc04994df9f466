// SPDX-License-Identifier: Apache-2.0
// A clamped tube on a coarse mesh beside two strips: the same answer from fewer simulations.
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::HasSubstr;

namespace {

class FewerSimulations : public ::testing::Test {
 protected:
  FewerSimulations() {
    bench.folder.write("tube.csv",
                       "pressure [mmHg],outer [1]\n0,0.93\n40,1.03\n80,1.12\n110,1.2\n140,1.26\n170,1.33\n");
    bench.experiment["models"] = {{"gho",
                                   {{"type", "gho"},
                                    {"parameters",
                                     {{"mu", {{"min", 1}, {"max", 100}}},
                                      {"k1", {{"min", 1}, {"max", 200}}},
                                      {"k2", {{"min", 0.01}, {"max", 10}}},
                                      {"kappa", {{"fixed", 0.13}}},
                                      {"theta", {{"fixed", 46}}}}}}}};
    bench.experiment["tests"]["tube"] = {
        {"type", "fe_pressurisation"},
        {"inner_radius", "3.71 mm"},
        {"thickness", "2.06 mm"},
        {"length", "14 mm"},
        {"axial_stretch", 1.2},
        {"element", "quadrilateral_9"},
        {"elements", {2, 4}},
        {"data", {{"file", "tube.csv"}, {"columns", {{"pressure", "pressure"}, {"outer_diameter_stretch", "outer"}}}}}};
    bench.experiment["optimizers"] = {{"es", {{"type", "es"}, {"restarts", 0}}},
                                      {"lm", {{"type", "ceres_lm"}, {"starts", 3}}}};
    bench.experiment["stop"] = {{"max_evaluations", 800}};
  }
  nlohmann::json run(const std::string& optimizer, const nlohmann::json& fewer, const std::string& folder,
                     const std::string& threads = "1") {
    bench.experiment["runs"] = {{{"model", "gho"}, {"optimizer", optimizer}, {"fewer_simulations", fewer}}};
    const auto ended = bench.tunica({"run", "experiment.json", "-o", folder, "-j", threads});
    EXPECT_EQ(ended.code, 0) << ended.err;
    said = ended.out;
    return bench.result(folder)["runs"][0];
  }
  trial::Bench bench;
  std::string said;
};

TEST_F(FewerSimulations, AnEarlyEndChangesNothingButTheirNumber) {
  auto all = run("es", {{"early_end", false}}, "all"), early = run("es", {{"early_end", true}}, "early");
  EXPECT_EQ(all["full_simulations"], (nlohmann::json{{"count", 800}, {"ended_early", 0}, {"guide_evaluations", 0}}));
  const int simulated = early["full_simulations"]["count"], ended = early["full_simulations"]["ended_early"];
  EXPECT_EQ(simulated + ended, 800);
  EXPECT_LT(simulated, 640);
  EXPECT_THAT(said, HasSubstr(std::to_string(simulated) + " full simulations"));
  EXPECT_EQ(early["best"]["parameters"], all["best"]["parameters"]);
  EXPECT_EQ(early["best"]["objective"], all["best"]["objective"]);
  EXPECT_EQ(early["best"]["per_test"], all["best"]["per_test"]);
  EXPECT_EQ(early["evaluations"], all["evaluations"]);
  EXPECT_EQ(early["ended_by"], all["ended_by"]);
  // The rows of both journals agree where the point was simulated.
  std::istringstream first(trial::without_times(bench.text("all/evaluations.csv"))),
      second(trial::without_times(bench.text("early/evaluations.csv")));
  int marked = 0;
  for (std::string a, b; std::getline(first, a) && std::getline(second, b);) {
    if (b.find(",ended_early,") == std::string::npos)
      EXPECT_EQ(a, b);
    else
      ++marked;
  }
  EXPECT_EQ(marked, ended);
}

TEST_F(FewerSimulations, ThreadsDoNotChangeWhichEndEarly) {
  run("es", {{"early_end", true}}, "one", "1");
  run("es", {{"early_end", true}}, "three", "3");
  EXPECT_EQ(trial::without_times(bench.text("one/evaluations.csv")),
            trial::without_times(bench.text("three/evaluations.csv")));
}

TEST_F(FewerSimulations, AGuideLeadsAnyOptimiserToTheSameOptimum) {
  const auto plain = run("lm", {{"guide", false}}, "plain");
  for (const std::string optimizer : {"lm", "es"}) {
    const auto guided = run(optimizer, {{"guide", true}}, "guided_" + optimizer);
    const double objective = guided["best"]["objective"], reference = plain["best"]["objective"];
    EXPECT_NEAR(objective / reference, 1, 1e-5) << optimizer;
    EXPECT_LE(guided["full_simulations"]["count"].get<int>(), 20) << optimizer;
    EXPECT_GT(guided["full_simulations"]["guide_evaluations"].get<int>(), 20) << optimizer;
    EXPECT_THAT(said, HasSubstr("the cheaper tests that guided the"));
    EXPECT_TRUE(guided["converged"].get<bool>()) << guided["ended_by"];
    // The correction's steps end where full simulations promise no more than rounding, so a neighbour may be a little
    // better; a second evaluation has to agree.
    EXPECT_THAT(guided["best"]["certificate"]["verdict_code"].get<std::string>(),
                ::testing::AnyOf("confirmed", "better_neighbour"))
        << guided["best"]["certificate"];
  }
  const auto again = run("es", {{"guide", true}}, "threads", "3");
  EXPECT_EQ(trial::without_times(bench.text("threads/evaluations.csv")),
            trial::without_times(bench.text("guided_es/evaluations.csv")));
}

TEST_F(FewerSimulations, EvaluationsAreThinnedOnDemand) {
  run("lm", {{"guide", false}}, "all");
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "thin", "--keep-evaluations", "improvements"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::string all = bench.text("all/evaluations.csv"), thin = bench.text("thin/evaluations.csv");
  EXPECT_LT(std::count(thin.begin(), thin.end(), '\n'), std::count(all.begin(), all.end(), '\n'));
  auto first = trial::without_times(bench.result("all")), second = trial::without_times(bench.result("thin"));
  EXPECT_EQ(first["runs"], second["runs"]);
  const auto resumed =
      bench.tunica({"run", "experiment.json", "-o", "thin", "--resume", "--keep-evaluations", "improvements"});
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(trial::without_times(bench.result("thin"))["runs"], first["runs"]);
  EXPECT_EQ(bench.text("thin/evaluations.csv"), thin);
  const auto refused = bench.tunica({"run", "experiment.json", "-o", "none", "--keep-evaluations", "few"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--keep-evaluations: found 'few'; expected all or improvements"));
}

}  // namespace
