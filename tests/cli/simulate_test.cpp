// SPDX-License-Identifier: Apache-2.0
#include <sstream>

#include <gmock/gmock.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::AllOf;
using ::testing::HasSubstr;

namespace {

std::vector<double> last_column(const std::string& text) {
  std::vector<double> values;
  std::istringstream stream(text);
  std::string line;
  for (std::getline(stream, line); std::getline(stream, line);)
    values.push_back(std::stod(line.substr(line.rfind(',') + 1)));
  return values;
}

}  // namespace

TEST(Simulate, WritesWhatTheDataLookLike) {
  trial::Bench bench;
  bench.folder.write("axial.csv", "lambda [percent];sigma [Pa]\n110;5000\n120;9000\n130;14000\n");
  bench.experiment["tests"]["axial"]["data"]["columns"] = {{"stretch", "lambda"}, {"stress", "sigma"}};
  bench.folder.write("mu.json", "{\"mu\": \"30 kPa\"}");
  const auto ended =
      bench.tunica({"simulate", "experiment.json", "--model", "neo", "--parameters", "mu.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, "out/axial.csv\nout/circ.csv\nout/simulation.json\nout/report.html\n");
  const auto record = nlohmann::json::parse(bench.text("out/simulation.json"));
  EXPECT_EQ(record["model"], "neo");
  EXPECT_EQ(record["parameters"]["mu"], nlohmann::json({{"value", 30.0}, {"unit", "kPa"}}));
  EXPECT_EQ(record["tests"], nlohmann::json({"axial", "circ"}));
  const auto text = bench.text("out/axial.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')), "lambda [percent],sigma [Pa]");
  // Neo-Hooke: sigma = mu (l^2 - 1/l), here in Pa.
  EXPECT_NEAR(last_column(text)[1], 30e3 * (1.44 - 1 / 1.2), 1e-3);
}

TEST(Simulate, ReadsBackTheResultOfARun) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "run"}).code, 0);
  const auto ended =
      bench.tunica({"simulate", "experiment.json", "--model", "neo", "--parameters", "run/result.json", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const double mu = bench.result("run")["runs"][0]["best"]["parameters"]["mu"]["value"];
  EXPECT_NEAR(last_column(bench.text("out/circ.csv")).back(), mu * (1.96 - 1 / 1.4), 1e-8 * mu);
}

// Noise of 2 % on 20 rows, seed 3: the root mean square of 20 standard normals lies in 0.5 … 1.6 with probability
// > 0.9999 (chi-square), and the seed is fixed.
TEST(Simulate, AddsSeededRelativeNoise) {
  const trial::Bench bench;
  const std::vector<std::string> command{"simulate", "experiment.json", "--model", "neo", "--noise",
                                         "0.02",     "--seed",          "3",       "-o"};
  const auto with = [&](const std::string& folder) {
    auto all = command;
    all.push_back(folder);
    EXPECT_EQ(bench.tunica(all).code, 0);
    return last_column(bench.text(folder + "/circ.csv"));
  };
  const auto noisy = with("a"), again = with("b");
  ASSERT_EQ(bench.tunica({"simulate", "experiment.json", "--model", "neo", "-o", "c"}).code, 0);
  const auto clean = last_column(bench.text("c/circ.csv"));
  EXPECT_EQ(noisy, again);
  double squares = 0;
  for (std::size_t i = 0; i < clean.size(); ++i) squares += std::pow((noisy[i] / clean[i] - 1) / 0.02, 2);
  const double rms = std::sqrt(squares / static_cast<double>(clean.size()));
  EXPECT_GT(rms, 0.5);
  EXPECT_LT(rms, 1.6);
}

TEST(Simulate, RefusesWhatItCannotUse) {
  trial::Bench bench;
  bench.experiment["models"]["gho"]["parameters"]["kappa"] = {{"fixed", 0.1}};
  bench.folder.write("wrong.json", "{\"muu\": 3}");
  bench.folder.write("fixed.json", "{\"kappa\": 0.2}");
  bench.folder.write("list.json", "[1]");
  const auto message = [&](const std::string& model, const std::string& file) {
    const auto ended =
        bench.tunica({"simulate", "experiment.json", "--model", model, "--parameters", file, "-o", "out"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_FALSE(std::filesystem::exists(bench.path("out")));
    return ended.err;
  };
  EXPECT_THAT(message("ghho", "wrong.json"), AllOf(HasSubstr("--model ghho"), HasSubstr("gho")));
  EXPECT_THAT(message("gho", "wrong.json"), AllOf(HasSubstr("wrong.json: muu"), HasSubstr("Did you mean 'mu'?")));
  EXPECT_THAT(message("gho", "fixed.json"), HasSubstr("holds it fixed at 0.1"));
  EXPECT_THAT(message("gho", "list.json"), HasSubstr("expected an object {name: value}"));
  EXPECT_THAT(message("gho", "nowhere.json"), HasSubstr("nowhere.json: there is no such file"));
}
