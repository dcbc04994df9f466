// SPDX-License-Identifier: Apache-2.0
// What the report draws of a folder's tables.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "report/grid.hpp"
#include "report/report.hpp"
#include "scratch.hpp"

using namespace tunica;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

/// The charts of the page, by their id.
nlohmann::json charts(const trial::Scratch& scratch) {
  const std::string page = report::report({scratch.path()}, scratch.path());
  const std::string open = "id=\"charts\">";
  const auto begin = page.find(open) + open.size();
  nlohmann::json found;
  for (auto& chart : nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin)))
    found[chart["id"].get<std::string>()] = chart;
  return found;
}

const char* const one_run =
    R"({"format": 1, "runs": [{"run": "m/o", "model": "m", "optimizer": "o", "best": {"objective": 1}}],
                                "ranking": [{"run": "m/o", "rank": 1, "group": "g"}]})";

const char* const grid = R"(<?xml version="1.0"?>
<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="4" NumberOfCells="1">
<Points><DataArray Name="points [mm]" NumberOfComponents="3">1 0 0 3 0 0 3 2 0 1 2 0</DataArray></Points>
<Cells><DataArray Name="connectivity">0 1 2 3</DataArray><DataArray Name="offsets">4</DataArray></Cells>
<PointData><DataArray Name="displacement [mm]" NumberOfComponents="3">0 0 0 1 0 0 1 0 0 0 0 0</DataArray></PointData>
<CellData><DataArray Name="circumferential_stress [kPa]" NumberOfComponents="1">7.5</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>)";

}  // namespace

TEST(FitChart, ShadesTheIntervalAndDrawsTheRangeOfTheRealisations) {
  const trial::Scratch scratch;
  scratch.write("result.json", one_run);
  scratch.write("fit_t.csv",
                "run,stretch [1],stress [kPa],stress.predicted [kPa],held_out,stress.ci95 [kPa],stress.lowest "
                "[kPa],stress.highest [kPa]\nm/o,1,0,0,0,0.5,-1,0\nm/o,2,4,5,0,1,4,7\n");
  const auto chart = charts(scratch)["fit_t_stress"];
  const auto& range = chart["series"][1];
  const auto& curve = chart["series"][2];
  EXPECT_EQ(range["mark"], "range");
  EXPECT_EQ(range["low"], nlohmann::json({-1, 4}));
  EXPECT_EQ(range["high"], nlohmann::json({0, 7}));
  EXPECT_EQ(curve["low"], nlohmann::json({-0.5, 4}));
  EXPECT_EQ(curve["high"], nlohmann::json({0.5, 6}));
  const std::string page = report::report({scratch.path()}, scratch.path());
  EXPECT_THAT(page, HasSubstr("Shaded: where the noise of the data leaves the fitted curve, 95 %."));
  EXPECT_THAT(page, HasSubstr("Thin lines: lowest and highest over the realisations."));
}

TEST(FitChart, OfAnOlderTableHasNeither) {
  const trial::Scratch scratch;
  scratch.write("result.json", one_run);
  scratch.write("fit_t.csv",
                "run,stretch [1],stress [kPa],stress.predicted [kPa],held_out\nm/o,1,0,0,0\nm/o,2,4,5,0\n");
  EXPECT_FALSE(charts(scratch)["fit_t_stress"]["series"][1].contains("low"));
  EXPECT_THAT(report::report({scratch.path()}, scratch.path()), Not(HasSubstr("Shaded: where the noise")));
}

TEST(FitChart, LiesOverWhatTheTestSweepsAndNotOverWhatItHolds) {
  const trial::Scratch scratch;
  scratch.write("result.json", one_run);
  scratch.write("fit_t.csv",
                "run,pressure [kPa],axial_stretch [1],time [s],force [mN],force.predicted [mN],held_out\n"
                "m/o,3.31,1.0,0,0,0,0\nm/o,3.29,1.1,1,1,1,0\nm/o,3.32,1.2,2,2,2,0\nm/o,3.30,1.3,3,3,3,0\n");
  EXPECT_EQ(charts(scratch)["fit_t_force"]["x"]["title"], "axial_stretch");
}

TEST(FitChart, DrawsTheCurvesOfAFamilyApart) {
  const trial::Scratch scratch;
  scratch.write("result.json", one_run);
  std::string table =
      "run,stretch_circumferential [1],stretch_axial [1],stress [kPa],stress.predicted [kPa],held_out\n";
  for (const char* held : {"1.3", "1.5"})
    for (const char* x : {"1", "1.1", "1.2", "1.3"}) table += std::string("m/o,") + x + ',' + held + ",2,1,0\n";
  scratch.write("fit_t.csv", table);
  const auto found = charts(scratch);
  const auto& fit = found.at("fit_t_stress");
  ASSERT_EQ(fit["series"].size(), 4u) << "measured and predicted, twice";
  EXPECT_EQ(fit["series"][0]["label"], "stretch_axial = 1.3");
  EXPECT_EQ(fit["series"][0]["tag"], "1.3");
  EXPECT_EQ(fit["series"][3]["label"], "stretch_axial = 1.5");
  EXPECT_EQ(fit["series"][3]["x"], nlohmann::json({1, 1.1, 1.2, 1.3}));
  EXPECT_EQ(fit["x"]["title"], "stretch_circumferential");
  EXPECT_EQ(found.at("fit_t_stress_residuals")["series"].size(), 2u);
}

TEST(FitChart, LaysAChannelOverWhatTheResultSays) {
  const trial::Scratch scratch;
  scratch.write(
      "result.json",
      R"({"format": 1, "runs": [{"run": "m/o", "model": "m", "optimizer": "o", "best": {"objective": 1, "per_test": {"t":
                    {"channels": [{"channel": "force", "over": "b"}]}}}}]})");
  scratch.write("fit_t.csv",
                "run,a [1],b [1],force [mN],force.predicted [mN],held_out\n"
                "m/o,1,2,0,0,0\nm/o,1.1,2.1,1,1,0\nm/o,1.2,2.4,2,2,0\nm/o,1.3,2.5,3,3,0\n");
  EXPECT_EQ(charts(scratch)["fit_t_force"]["x"]["title"], "b");
}

TEST(ParameterChart, SaysWhereADotIsNotFixed) {
  const trial::Scratch scratch;
  const std::string loose = R"({"objective": 1, "covariance": {}, "parameters": {
      "mu": {"value": 1, "unit": "kPa", "ci95": [0.9, 1.1], "at_bound": null, "min": 0, "max": 9},
      "k2": {"value": 3, "unit": "1", "ci95": null, "at_bound": null, "min": 0, "max": 9},
      "k3": {"value": 9, "unit": "1", "ci95": null, "at_bound": "upper", "min": 0, "max": 9}}})";
  const std::string unknown =
      R"({"objective": 2, "parameters": {"mu": {"value": 1}, "k2": {"value": 3}, "k3": {"value": 9}}})";
  scratch.write("result.json", R"({"format": 1, "runs": [{"run": "m/o", "model": "m", "optimizer": "o", "best": )" +
                                   loose + R"(}, {"run": "m/p", "model": "m", "optimizer": "p", "best": )" + unknown +
                                   "}]}");
  const auto found = charts(scratch);
  EXPECT_EQ(found.at("parameter_mu_m")["labels"], nlohmann::json({"m/o", "m/p"}));
  EXPECT_EQ(found.at("parameter_k2_m")["labels"], nlohmann::json({"m/o, not fixed", "m/p"}));
  EXPECT_EQ(found.at("parameter_k3_m")["labels"], nlohmann::json({"m/o", "m/p"})) << "the table says: at its bound";
}

TEST(SimulationChart, DrawsEveryCurveOfAFamilyOverItsOwnAbscissa) {
  const trial::Scratch scratch;
  scratch.write("t.csv", "l1 [1],l2 [1],p [kPa]\n1,1.3,1\n1.1,1.3,2\n1.2,1.3,3\n1,1.5,2\n1.1,1.5,3\n1.2,1.5,4\n");
  scratch.write("simulation.json", R"({"format": 1, "name": "n", "model": "m", "tests": ["t"],
      "curves": [{"test": "t", "column": "p", "over": "l1", "prescribed": ["l1", "l2"]}]})");
  const auto found = charts(scratch);
  EXPECT_FALSE(found.contains("t_l2")) << "what is prescribed is no prediction";
  const auto& series = found.at("t_p")["series"];
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(series[1]["name"], "l2 = 1.5");
  EXPECT_EQ(series[1]["y"], nlohmann::json({2, 3, 4}));
}

TEST(ResidualChart, EndsALittleBeyondTheResidualsAndSaysHowFarASignatureGoes) {
  const trial::Scratch scratch;
  scratch.write("result.json", R"({"format": 1, "diagnosis": {"verdict": "named"}})");
  scratch.write("residuals.csv",
                "test,channel,row,abscissa,abscissa_unit,abscissa_name,curve,unit,measured,predicted,extended,sigma,"
                "residual,residual_extended,signature_drift,signature_other\n"
                "t,s,0,1,1,stretch,,kPa,1,1,1,1,-11,1,-3630,1\nt,s,1,2,1,stretch,,kPa,2,2,2,1,11,1,2,-1\n");
  const auto chart = charts(scratch)["residuals_t_s"];
  EXPECT_GT(chart["y"]["domain"][0], -20);
  EXPECT_LT(chart["y"]["domain"][0], -11);
  EXPECT_GT(chart["y"]["domain"][1], 11);
  const std::string page = report::report({scratch.path()}, scratch.path());
  EXPECT_THAT(page, HasSubstr("Cut off: what drift runs from -3630 to 2 σ."));
}

TEST(ResidualChart, IsNotCutWhereTheSignaturesKeepToTheResiduals) {
  const trial::Scratch scratch;
  scratch.write("result.json", R"({"format": 1, "diagnosis": {"verdict": "named"}})");
  scratch.write("residuals.csv",
                "test,channel,row,abscissa,abscissa_unit,abscissa_name,unit,measured,predicted,extended,sigma,residual,"
                "residual_extended,signature_drift\nt,s,0,1,1,stretch,kPa,1,1,1,1,-1,1,-2\n");
  EXPECT_FALSE(charts(scratch)["residuals_t_s"]["y"].contains("domain"));
  EXPECT_THAT(report::report({scratch.path()}, scratch.path()), Not(HasSubstr("Cut off")));
}

TEST(ScoreCharts, OfTheMaterialAndOfTheRigHaveTheSameAxis) {
  const trial::Scratch scratch;
  scratch.write("result.json", R"({"format": 1, "diagnosis": {"verdict": "unknown", "scores": [
      {"id": "crimp", "group": "material", "score": 5, "p_value": 0.1},
      {"id": "drift", "group": "rig", "score": 70, "p_value": 0.01}],
      "ranking": [{"id": "drift", "group": "rig", "probability": 0.9, "score": 70, "gain": 71},
                  {"id": "crimp", "group": "material", "probability": 0.1, "score": 5, "gain": null}]}})");
  const auto found = charts(scratch);
  EXPECT_EQ(found.at("scores_material")["labels"], nlohmann::json({"crimp"}));
  EXPECT_EQ(found.at("scores_rig")["labels"], nlohmann::json({"drift"}));
  EXPECT_EQ(found.at("scores_material")["x"]["include"], found.at("scores_rig")["x"]["include"]);
  const std::string page = report::report({scratch.path()}, scratch.path());
  EXPECT_LT(page.find(">In the material<"), page.find(">In the rig<"));
}

TEST(Confusability, ShowsOnlyWhatLeavesATrace) {
  const trial::Scratch scratch;
  scratch.write("result.json", R"({"format": 1, "diagnosis": {"verdict": "unknown", "detectable": [
      {"id": "tethering", "absent": "no test that it applies to"}, {"id": "drift", "absent": ""}]}})");
  scratch.write("confusability.csv",
                "mechanism,crimp,tethering,drift\ncrimp,1,0,0.4\ntethering,0,1,0\ndrift,0.4,0,1\n");
  const auto chart = charts(scratch)["confusability"];
  EXPECT_EQ(chart["columns"], nlohmann::json({"crimp", "drift"}));
  EXPECT_EQ(chart["labels"], nlohmann::json({"crimp", "drift"}));
  EXPECT_EQ(chart["values"], nlohmann::json({{1, 0.4}, {0.4, 1}}));
}

TEST(WallCharts, DrawTheDeformedWallAndTheStressThroughIt) {
  const trial::Scratch scratch;
  scratch.write("result.json", one_run);
  std::string table =
      "run,row,unloaded_radius [mm],radius [mm],circumferential_stretch [1],axial_stretch [1],radial_stretch "
      "[1],circumferential_stress [kPa],axial_stress [kPa],radial_stress [kPa],prescribed_pressure [kPa]\n";
  for (const char* row :
       {"1,1,1,1,1,1,0,0,0,0", "1,2,2,1,1,1,0,0,0,0", "9,1,1.5,1.5,1,0.7,90,40,-12,12", "9,2,2.4,1.2,1,0.8,50,30,0,12"})
    table += std::string("m/o,") + row + "\n";
  scratch.write("wall_tube.csv", table);
  scratch.write("wall_tube_9.vtu", grid);
  const auto found = charts(scratch);
  EXPECT_EQ(found["deformed_wall_tube"]["kind"], "mesh");
  EXPECT_EQ(found["deformed_wall_tube"]["title"], "Deformed wall at pressure = 12 kPa");
  EXPECT_EQ(found["deformed_wall_tube"]["mesh"]["values"][0], 70);
  const auto& hoop = found["wall_tube_circumferential_stress"]["series"];
  ASSERT_EQ(hoop.size(), 2u);
  EXPECT_EQ(hoop[1]["name"], "pressure = 12 kPa");
  EXPECT_EQ(hoop[1]["y"], nlohmann::json({90, 50}));
  const auto& field = found["field_tube_9_circumferential_stress"];
  EXPECT_EQ(field["mesh"]["values"], nlohmann::json({7.5}));
  EXPECT_EQ(field["series"][0]["x"], nlohmann::json({1, 2, 2, 1, 1})) << "the outline is that of the unloaded wall";
  EXPECT_FALSE(found.contains("field_tube_1_circumferential_stress"));
}

TEST(WallCharts, ComeWithASimulationTooAndItsSectionsAreNoCurves) {
  const trial::Scratch scratch;
  scratch.write("tube.csv", "pressure [kPa],diameter [1]\n0,1\n12,1.4\n");
  scratch.write("tube_2_section.csv",
                "unloaded_radius [mm],radius [mm],circumferential_stress [kPa],prescribed_pressure "
                "[kPa]\n1,1.5,90,12\n2,2.4,50,12\n");
  const auto found = charts(scratch);
  EXPECT_TRUE(found.contains("deformed_wall_tube"));
  EXPECT_TRUE(found.contains("tube_diameter"));
  EXPECT_FALSE(found.contains("tube_2_section_radius"));
}

TEST(Grid, ThatCannotBeReadIsToldOf) {
  const trial::Scratch scratch;
  std::string problem;
  EXPECT_FALSE(report::Grid::read(scratch.path() / "none.vtu", problem));
  EXPECT_EQ(problem, "");
  const auto refused = [&](std::string text, const std::string& from, const std::string& to) {
    if (const auto at = text.find(from); at != text.npos) text.replace(at, from.size(), to);
    scratch.write("a.vtu", text);
    problem.clear();
    EXPECT_FALSE(report::Grid::read(scratch.path() / "a.vtu", problem));
    return problem;
  };
  EXPECT_THAT(refused(grid, "<Cells>", "<Celld>"), HasSubstr("a.vtu: cannot be read as a VTK grid"));
  EXPECT_EQ(refused(grid, "0 1 2 3<", "0 1 2<"), "a.vtu: has cells that are no quadrilaterals");
  EXPECT_EQ(refused(grid, "0 1 2 3<", "0 1 2 4<"), "a.vtu: has cells of points that it does not have");
  EXPECT_EQ(refused(grid, "0 1 2 3<", "<"), "a.vtu: has no cells");
  EXPECT_EQ(refused(grid, "7.5", "7.5 8"), "a.vtu: has another number of 'circumferential_stress [kPa]' than of cells");
  EXPECT_EQ(refused(grid, "0 0 0 1 0 0 1 0 0", "0 0"),
            "a.vtu: has another number of 'displacement [mm]' than of points");
}

TEST(SpectrumChart, HasASymbolForEachBranchAndBarsAlongBothAxes) {
  const trial::Scratch scratch;
  scratch.write("result.json", R"({"format": 1, "runs": [{"run": "m/o", "model": "m", "optimizer": "o", "best":
    {"objective": 1, "parameters": {
      "mu": {"value": 20, "unit": "kPa", "ci95": [19, 21]},
      "fast.g": {"value": 0.8, "unit": "1", "ci95": [0.7, 0.9]},
      "fast.tau": {"value": 2, "unit": "s", "ci95": [1, 4], "posterior_ci95": [1.5, 3]},
      "viscoelasticity.g": {"value": 0.3, "unit": "1", "ci95": null}}},
    "fixed": {"viscoelasticity.tau": {"value": 100, "unit": "s"}}}],
    "ranking": [{"run": "m/o", "rank": 1, "group": "g"}]})");
  scratch.write("input.json", R"({"models": {"m": {"type": "yeoh", "mechanisms": [
    {"type": "viscoelasticity", "as": "fast"}, {"type": "viscoelasticity"}, {"type": "damage"}]}}})");
  const auto chart = charts(scratch)["spectrum_m"];
  ASSERT_EQ(chart["series"].size(), 3u);
  const auto &bars = chart["series"][0], &across = chart["series"][1], &points = chart["series"][2];
  EXPECT_EQ(points["x"], nlohmann::json({2, 100}));
  EXPECT_EQ(points["y"], nlohmann::json({0.8, 0.3}));
  EXPECT_EQ(bars["x"], nlohmann::json({2})) << "no interval where the data fix none";
  EXPECT_EQ(bars["low"], nlohmann::json({0.7}));
  EXPECT_EQ(bars["high"], nlohmann::json({0.9}));
  EXPECT_EQ(across["x"][0], 1.5) << "the posterior before the linearised interval";
  EXPECT_EQ(across["x"][1], 3);
  EXPECT_EQ(across["y"][2], nullptr) << "a gap before the next branch";
  EXPECT_EQ(chart["x"]["log"], true);
}

TEST(SpectrumChart, IsLeftOutWithoutBranches) {
  const trial::Scratch scratch;
  scratch.write("result.json", one_run);
  scratch.write("input.json", R"({"models": {"m": {"type": "yeoh", "mechanisms": [{"type": "damage"}]}}})");
  EXPECT_FALSE(charts(scratch).contains("spectrum_m"));
}
