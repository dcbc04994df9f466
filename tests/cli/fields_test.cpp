// SPDX-License-Identifier: Apache-2.0
// tunica simulate --fields: what a reader of VTK files that is not ours finds in them.
#include <gmock/gmock.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::HasSubstr;

namespace {

/// Set S in a clamped tube of 4 × 6 elements, at three pressures.
class Fields : public ::testing::Test {
 protected:
  Fields() {
    bench.folder.write("tube.csv", "pressure [mmHg],outer [1]\n0,0.9\n80,1.1\n160,1.3\n");
    bench.experiment["models"] = {{"gho",
                                   {{"type", "gho"},
                                    {"parameters",
                                     {{"mu", {{"fixed", 18.668}}},
                                      {"kappa", {{"fixed", 0.1367}}},
                                      {"k1", {{"fixed", 24.905}}},
                                      {"k2", {{"fixed", 0.2912}}},
                                      {"theta", {{"fixed", 46.44}}}}}}}};
    bench.experiment["tests"]["tube"] = {
        {"type", "fe_pressurisation"},
        {"inner_radius", "3.71 mm"},
        {"thickness", "2.06 mm"},
        {"length", "14 mm"},
        {"axial_stretch", 1.2},
        {"element", element},
        {"elements", {radial, 6}},
        {"data", {{"file", "tube.csv"}, {"columns", {{"pressure", "pressure"}, {"outer_diameter_stretch", "outer"}}}}}};
    bench.experiment["runs"] = {{{"model", "gho"}, {"optimizer", "lm"}}};
  }
  [[nodiscard]] std::string refused(const std::string& fields) const {
    const auto ended =
        bench.tunica({"simulate", "experiment.json", "--model", "gho", "--fields", fields, "-o", "refused"});
    EXPECT_EQ(ended.code, 2) << ended.out;
    return ended.err;
  }

  static constexpr std::size_t radial = 4;
  std::string element = "quadrilateral_9";
  trial::Bench bench;
};

TEST_F(Fields, AreReadByAnother) {
  const auto ended =
      bench.tunica({"simulate", "experiment.json", "--model", "gho", "--fields", "tube:3,1,3", "-o", "out"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  trial::Process reader({"/usr/bin/python3", TUNICA_VTK_READER, "out/tube.pvd"}, bench.folder.path());
  const auto read = reader.wait();
  if (read.code == 77) GTEST_SKIP() << "/usr/bin/python3 has no meshio; ./bootstrap test installs it";
  ASSERT_EQ(read.code, 0) << read.err;
  const auto grids = nlohmann::json::parse(read.out);
  ASSERT_EQ(grids.size(), 2u);
  // The third row of the table is what the last grid shows at mid-length.
  std::istringstream table(bench.text("out/tube.csv"));
  std::string line, last;
  while (std::getline(table, line))
    if (!line.empty()) last = line;
  const double stretch = std::stod(last.substr(last.find(',') + 1));
  EXPECT_EQ(grids[1]["time"], 3);
  EXPECT_NEAR(grids[1]["outer"].get<double>() / 5.77, stretch, 1e-6);
  EXPECT_EQ(grids[1]["points"], (2 * radial + 1) * 13u);
  EXPECT_EQ(grids[1]["cells"], 2 * radial * 12u);
  EXPECT_EQ(grids[1]["of_points"], nlohmann::json({"displacement [mm]"}));
  const auto& cells = grids[1]["of_cells"];
  for (const char* name : {"circumferential_stress [kPa]", "axial_stress [kPa]", "radial_stress [kPa]", "fibre_stretch",
                           "pressure [kPa]", "volume_ratio", "least_wave_stiffness [kPa]"})
    EXPECT_TRUE(cells.contains(name)) << name;
  // Incompressible in the mean of each element, stable (set S has dispersed fibres), stretched most from inside.
  EXPECT_NEAR(cells["volume_ratio"][0].get<double>(), 1, 0.02);
  EXPECT_NEAR(cells["volume_ratio"][1].get<double>(), 1, 0.02);
  EXPECT_GT(cells["least_wave_stiffness [kPa]"][0].get<double>(), 0);
  EXPECT_GT(cells["circumferential_stretch"][1].get<double>(), stretch);
  EXPECT_THAT(bench.text("out/tube_3_section.csv"), HasSubstr("least_wave_stiffness [kPa]"));
}

/// What `check` says of the same tube: it agrees with the long one where its mesh allows, and says so where not.
TEST_F(Fields, OfWhichCheckComparesTheSimulationWithOthers) {
  bench.experiment["models"]["gho"]["parameters"]["mu"] = {{"initial", 18.668}};
  bench.experiment["runs"] = {{{"model", "gho"}, {"optimizer", "lm"}, {"tests", {"tube"}}}};
  bench.experiment["tests"]["tube"]["data"]["noise"] = {{"absolute", 0.001}};
  const auto good = bench.tunica({"check", "experiment.json"});
  ASSERT_EQ(good.code, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("tube against the semi-analytic long tube, ends sliding: outer diameter"));
  EXPECT_THAT(good.out, HasSubstr("tube against an axial strip, one element far from the axis"));
  EXPECT_THAT(good.out, ::testing::Not(HasSubstr("expected")));
}

TEST_F(Fields, OfTheBestPointComeWithEveryRun) {
  bench.experiment["models"]["gho"]["parameters"]["mu"] = {{"initial", 18.668}};
  bench.experiment["runs"] = {{{"model", "gho"}, {"optimizer", "lm"}, {"tests", {"tube"}}}};
  bench.experiment["tests"]["tube"]["data"]["noise"] = {{"absolute", 0.001}};
  bench.experiment["stop"] = {{"max_evaluations", 3}};
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  ASSERT_LE(ended.code, 1) << ended.err;
  const auto table = bench.text("out/wall_tube.csv");
  EXPECT_THAT(table, ::testing::StartsWith("run,row,unloaded_radius [mm],radius [mm],"));
  EXPECT_THAT(table.substr(0, table.find('\n')), ::testing::EndsWith(",prescribed_pressure [kPa]"));
  for (const char* row : {"\ngho/lm,1,", "\ngho/lm,2,", "\ngho/lm,3,"}) EXPECT_THAT(table, HasSubstr(row));
  EXPECT_THAT(bench.text("out/wall_tube_3.vtu"), HasSubstr("circumferential_stress [kPa]"));
  EXPECT_THAT(bench.text("out/report.html"), HasSubstr("Wall of the tube"));
}

TEST_F(Fields, SayWhatCannotBeShown) {
  EXPECT_THAT(refused("tub:1"), HasSubstr("--fields tub: the experiment has no test of that name"));
  EXPECT_THAT(refused("tube:4"), HasSubstr("--fields tube: there is no row 4; the test has 3"));
  EXPECT_THAT(refused("tube:first"), HasSubstr("--fields tube:first: 'first' is not a row; rows are counted from 1"));
  const std::string strip = bench.experiment["tests"].begin().key();
  ASSERT_NE(strip, "tube");
  EXPECT_THAT(refused(strip), HasSubstr("this test has no fields to show"));
}

}  // namespace
