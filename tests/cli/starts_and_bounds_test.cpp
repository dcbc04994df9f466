// SPDX-License-Identifier: Apache-2.0
// The starting points of searches, and bounds that are only defaults.
#include <algorithm>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

/// The parameters of every evaluation of a run, as evaluations.csv has them.
std::set<std::string> points_of(const std::string& table, const std::string& run) {
  std::set<std::string> points;
  std::istringstream stream(table);
  std::string line;
  std::getline(stream, line);
  for (; std::getline(stream, line);) {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    if (cells[1] != run) continue;
    points.insert(fmt::format("{} {} {} {} {}", cells[3], cells[4], cells[5], cells[6], cells[7]));
  }
  return points;
}

std::size_t in_common(const std::set<std::string>& a, const std::set<std::string>& b) {
  return static_cast<std::size_t>(
      std::count_if(a.begin(), a.end(), [&](const auto& point) { return b.contains(point); }));
}

/// Two strips of a tissue whose fibres are stiff: hgo with k1 = 3000 kPa, where the default ends at 1000 kPa.
struct StiffTissue : trial::Bench {
  StiffTissue() {
    experiment["models"] = {{"wall", {{"type", "hgo"}}}};
    experiment["runs"] = {{{"model", "wall"}, {"optimizer", "lm"}}};
    for (const char* name : {"circ", "axial"}) {
      std::string rows = "stretch [1],stress [kPa]\n";
      for (int k = 1; k <= 15; ++k) rows += fmt::format("{},1\n", 1 + 0.01 * k);
      folder.write(fmt::format("{}.csv", name), rows);
    }
    folder.write("truth.json", R"({"mu": 30, "k1": 3000, "k2": 2, "theta": 40})");
    const auto made =
        tunica({"simulate", "experiment.json", "--model", "wall", "--parameters", "truth.json", "-o", "made"});
    EXPECT_EQ(made.code, 0) << made.err;
    for (const char* name : {"circ", "axial"})
      experiment["tests"][name]["data"]["file"] = fmt::format("made/{}.csv", name);
  }
};

}  // namespace

TEST(PairedStarts, OptimisersBeginAtTheSamePoints) {
  trial::Bench bench;
  bench.experiment["optimizers"] = {{"lm", {{"type", "ceres_lm"}, {"starts", 6}}},
                                    {"slsqp", {{"type", "nlopt"}, {"algorithm", "slsqp"}, {"starts", 6}}}};
  bench.experiment["runs"] = {{{"model", "gho"}, {"optimizer", "lm"}}, {{"model", "gho"}, {"optimizer", "slsqp"}}};
  const auto run = [&](std::vector<std::string> words, const std::string& folder) {
    words.insert(words.begin(), {"run", "experiment.json", "-o", folder, "--no-certificate"});
    const auto ended = bench.tunica(words);
    EXPECT_NE(ended.code, 2) << ended.err;
    const std::string table = bench.text(folder + "/evaluations.csv");
    return in_common(points_of(table, "gho/lm"), points_of(table, "gho/slsqp"));
  };
  EXPECT_EQ(run({}, "apart"), 1u) << "the initial values";
  EXPECT_GE(run({"--paired-starts"}, "paired"), 6u);
  const auto result = bench.result("paired");
  EXPECT_EQ(result["runs"][0]["paired_with"], nlohmann::json({"gho/slsqp"}));
  EXPECT_EQ(result["runs"][1]["paired_with"], nlohmann::json({"gho/lm"}));
  EXPECT_TRUE(bench.result("apart")["runs"][0]["paired_with"].is_null());
  EXPECT_TRUE(nlohmann::json::parse(bench.text("paired/input.json"))["paired_starts"].get<bool>());

  bench.experiment["paired_starts"] = true;
  EXPECT_GE(run({}, "by_file"), 6u);
  EXPECT_EQ(bench.text("by_file/realisations.csv").substr(0, 200),
            bench.text("paired/realisations.csv").substr(0, 200));

  // Random starts of single searches too, realisation by realisation.
  bench.experiment["optimizers"]["lm"]["starts"] = bench.experiment["optimizers"]["slsqp"]["starts"] = 1;
  for (auto& entry : bench.experiment["runs"]) entry.update({{"realisations", 3}, {"initial", "random"}});
  EXPECT_GE(run({}, "random"), 3u);
  bench.experiment["paired_starts"] = false;
  EXPECT_EQ(run({}, "random_apart"), 0u);
}

TEST(PairedStarts, AreTrueOrFalse) {
  trial::Bench bench;
  bench.experiment["paired_starts"] = "yes";
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("/paired_starts"));
}

TEST(DefaultBounds, AreToldWhereAStiffTissueLiesBeyondThem) {
  StiffTissue bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  const auto result = bench.result("out");
  // What k1 must not be, k2 makes up for as far as its own default goes.
  EXPECT_EQ(result["runs"][0]["best"]["parameters"]["k2"]["bound_kind"], "default");
  EXPECT_THAT(
      result["warnings"].get<std::vector<std::string>>(),
      Contains(HasSubstr("k2 = 100 lies at its upper bound (100). The bound is the default, nobody chose it. The "
                         "best value may lie beyond it: widen it with \"max\" of 'k2'")));

  bench.experiment["models"]["wall"]["parameters"]["k1"] = {{"max", "10 MPa"}};
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "wide"}).code, 0);
  const auto wide = bench.result("wide");
  EXPECT_NEAR(wide["runs"][0]["best"]["parameters"]["k1"]["value"], 3000, 30);
  EXPECT_THAT(wide["warnings"].get<std::vector<std::string>>(), Not(Contains(HasSubstr("bound is the default"))));
}

TEST(DefaultBounds, AreToldWhereARubberIsStifferThanTheyAllow) {
  trial::Bench bench;
  bench.experiment["models"] = {{"rubber", {{"type", "mooney_rivlin"}}}};
  bench.experiment["runs"] = {{{"model", "rubber"}, {"optimizer", "lm"}}};
  std::string rows = "stretch [1],stress [MPa]\n";
  for (int k = 1; k <= 15; ++k) {
    const double l = 1 + 0.02 * k;
    rows += fmt::format("{},{}\n", l, 40 * (l * l - 1 / l));  // neo-Hookean, 2 c10 = 40 MPa; the default is 10 MPa
  }
  bench.folder.write("circ.csv", rows);
  bench.experiment["tests"].erase("axial");
  bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_THAT(bench.result("out")["warnings"].get<std::vector<std::string>>(),
              Contains(HasSubstr("c10 = 10000 kPa lies at its upper bound (10000 kPa). The bound is the default")));
}
