// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "data/cycles.hpp"
#include "data/local_regression.hpp"
#include "data/strip.hpp"
#include "data/table_place.hpp"

/// Data as testing machines write them: tables below other lines, units in a row of their own, force and displacement,
/// cycles.
namespace tunica::data {
namespace {

using testing::by_force;
using testing::Mapping;
using testing::read_strip;
using testing::strip_of;
using testing::strip_refusal;

/// 0 → 5 → 0 mm, `cycles` times in steps of 0.5 mm, then 0 → 5 mm; the force of cycle k is (10 + k)·way.
std::string preconditioned(int cycles) {
  std::string text = "Way [mm],Force [mN]\n";
  for (int cycle = 1; cycle <= cycles + 1; ++cycle) {
    const int rows = cycle > cycles ? 10 : 19;
    for (int row = 0; row <= rows; ++row) {
      const double way = 0.5 * (row <= 10 ? row : 20 - row);
      text += fmt::format("{},{}\n", way, (10 + cycle) * way);
    }
  }
  return text;
}

TEST(TablePlace, IsTheFirstLineOfAPlainTable) {
  const auto place = find_table("# c\nstretch,stress\n1,2\n1.1,3\n1.2,4\n", {});
  ASSERT_TRUE(place);
  EXPECT_EQ(place->header, 2u);
  EXPECT_EQ(place->first_row, 3u);
  EXPECT_EQ(place->delimiter, ',');
}

TEST(TablePlace, LiesBelowLinesThatAreTablesTooButShorter) {
  const auto place = find_table(
      "Specimen;A\nWidth;26,9\nThickness;1,4\nLength;12,5\n\nTime;Way;Force\ns;mm;N\n0,0;0,0;0,1\n0,1;0,2;0,3\n0,2;0,4;"
      "0,"
      "5\n0,3;0,6;0,7\n",
      {});
  ASSERT_TRUE(place);
  EXPECT_EQ(place->header, 6u);
  EXPECT_EQ(place->first_row, 8u);
  EXPECT_EQ(place->delimiter, ';');
}

TEST(TablePlace, ToleratesTextEmptyCellsAndLostRows) {
  const auto place = find_table("operator,x\nset,way,force\na,0,\na,1,n/a\nb,2,3\nb,,4\nb,3,5\nb,4,6\n", {});
  ASSERT_TRUE(place);
  EXPECT_EQ(place->header, 2u);
}

TEST(TablePlace, OfRowsWithoutNamesHasNoHeader) {
  const auto place = find_table("0 0.5\n1 0.6\n2 0.8\n", {});
  ASSERT_TRUE(place);
  EXPECT_FALSE(place->header);
  EXPECT_EQ(place->delimiter, ' ');
  EXPECT_FALSE(find_table("a,b\n1,2\n", {})) << "two lines say nothing";
}

TEST(Cycles, EndAtTurningPoints) {
  const std::vector<double> path = {0, 1, 2, 1, 0, 0, 1, 2, 2, 1, 0, 1, 2};
  const auto branches = branches_of(path, 0);
  ASSERT_EQ(branches.size(), 5u);
  const std::size_t first[] = {0, 3, 5, 8, 10}, last[] = {3, 5, 8, 10, 13}, cycle[] = {1, 1, 2, 2, 3};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(branches[k].first, first[k]) << k;
    EXPECT_EQ(branches[k].last, last[k]) << k;
    EXPECT_EQ(branches[k].cycle, cycle[k]) << k;
    EXPECT_EQ(branches[k].loading, k % 2 == 0) << k;
  }
  EXPECT_EQ(returns_in(path, branches), 2u);
}

TEST(Cycles, OfCompressionLoadDownwards) {
  const std::vector<double> path = {1, 0.9, 0.8, 0.9, 1, 0.9, 0.8};
  const auto branches = branches_of(path, 1);
  ASSERT_EQ(branches.size(), 3u);
  EXPECT_TRUE(branches[0].loading);
  EXPECT_EQ(branches[0].last, 3u);
  EXPECT_EQ(cycles_in(branches), 2u);
}

TEST(Cycles, AreNotMadeByNoise) {
  std::vector<double> path;
  for (int row = 0; row < 200; ++row) path.push_back(row + (row % 2 == 0 ? 3.0 : -3.0));  // 3 % of the range to and fro
  EXPECT_EQ(branches_of(path, 0).size(), 1u);
}

TEST(RigData, GivesStretchAndNominalStressFromForceAndDisplacement) {
  const Dataset strip = read_strip("Way [mm],Force [N]\n0,0\n0.5,1\n1,3\n", by_force, strip_of(4, 0.5, 10));
  EXPECT_EQ(strip.abscissae[0].first, "stretch");
  EXPECT_EQ(strip.channels[0].observable, "stress");
  const double stretch[] = {1, 1.05, 1.1}, stress[] = {0, 500, 1500};  // 1 N / 2 mm² = 500 kPa
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_NEAR(strip.abscissae[0].second[row], stretch[row], 1e-15);
    EXPECT_NEAR(strip.channels[0].values[row], stress[row], 1e-12);
  }
  EXPECT_TRUE(strip.rows().abscissae[0].from_elongation);
  EXPECT_EQ(strip.source_columns[1].second, (std::pair<std::string, std::string>{"stress", ""}));
}

TEST(RigData, GivesTheStressMeasureOfTheTest) {
  DataRequest request = strip_of(4, 0.5, 10);
  const auto last_stress = [&](const char* measure) {
    request.stress_measure = measure;
    return read_strip("Way [mm],Force [N]\n0,0\n0.5,1\n2,3\n", by_force, request).channels[0].values[2];
  };
  EXPECT_NEAR(last_stress("cauchy"), 1500 * 1.2, 1e-10);
  EXPECT_NEAR(last_stress("second_piola_kirchhoff"), 1500 / 1.2, 1e-10);
}

TEST(RigData, KnowsLengthStrainAreaAndGramsOfABalance) {
  DataRequest request;
  request.specimen.area = 2;
  request.specimen.all.gauge_length = 20;
  request.stress_measure = "first_piola_kirchhoff";
  const Dataset length =
      read_strip("Size [mm],Balance [g]\n20,0\n24,100\n", {{"length", "Size"}, {"force", "Balance"}}, request);
  EXPECT_DOUBLE_EQ(length.abscissae[0].second[1], 1.2);
  EXPECT_NEAR(length.channels[0].values[1], 980.665 / 2, 1e-10);
  const Dataset strain =
      read_strip("Strain [%],Force [mN]\n0,0\n20,100\n", {{"strain", "Strain"}, {"force", "Force"}}, request);
  EXPECT_DOUBLE_EQ(strain.abscissae[0].second[1], 1.2);
  EXPECT_TRUE(strain.rows().abscissae[0].from_elongation);
  EXPECT_FALSE(length.rows().abscissae[0].from_elongation);
  EXPECT_FALSE(read_strip("stretch,stress [kPa]\n1,0\n1.2,3\n").rows().abscissae[0].from_elongation);
}

TEST(RigData, ReadsARowOfUnitsHeaderLinesAndDecimalCommas) {
  const Dataset strip = read_strip(
      "Machine;7\nOperator;M\nWidth;4,0\nThickness;0,5\n\nLength;10,0\nWay;Force;Remark\n(mm);(N);\n0,0;0,0;\n0,5;1,0;"
      "x\n1,"
      "0;3,0;\n",
      by_force, strip_of(4, 0.5, 10));
  EXPECT_EQ(strip.lines, (std::vector<std::size_t>{9, 10, 11}));
  EXPECT_NEAR(strip.channels[0].values[2], 1500, 1e-10);
  EXPECT_TRUE(strip.warnings.empty());
}

TEST(RigData, ObeysALayoutThatIsStated) {
  DataRequest request = strip_of(4, 0.5, 10);
  request.layout.skip_lines = 2;
  request.layout.delimiter = ';';
  request.layout.decimal = ',';
  request.layout.units = {{"Way", "um"}, {"Force", "N"}};
  const Dataset strip = read_strip("x;y\n1;2\nWay;Force\n0;0\n500;1,5\n", by_force, request);
  EXPECT_NEAR(strip.abscissae[0].second[1], 1.05, 1e-15);
  EXPECT_NEAR(strip.channels[0].values[1], 750, 1e-10);
  request.layout.skip_lines = 50;
  EXPECT_EQ(strip_refusal("x;y\n1;2\nWay;Force\n0;0\n", by_force, request),
            "strip.csv: \"skip_lines\" is 50, and no table follows. The file has 4 lines; correct it.");
}

TEST(RigData, TakesColumnsByTheirNumber) {
  DataRequest request;
  request.layout.by_position = true;
  const Mapping columns = {{"stretch", "#1"}, {"stress", "#3"}};
  EXPECT_EQ(read_strip("1 7 0\n1.1 8 2.5\n1.2 9 5\n", columns, request).channels[0].values,
            (std::vector<double>{0, 2.5, 5}));
  EXPECT_EQ(read_strip("a,b,c\n1,7,0\n1.1,8,2.5\n", columns).channels[0].values, (std::vector<double>{0, 2.5}));
  EXPECT_EQ(strip_refusal("a,b\n1,7\n1.1,8\n", columns),
            "strip.csv, line 1: there is no column 3, the table has 2. Give a number that is there.");
}

TEST(RigData, MatchesAnyOfSeveralValues) {
  DataRequest request;
  request.where = {{"set", "a"}, {"set", "c"}, {"side", "left"}};
  EXPECT_EQ(
      read_strip("set,side,stretch,stress [kPa]\na,left,1,0\nb,left,1.1,1\nc,left,1.2,2\nc,right,1.3,3\n", {}, request)
          .channels[0]
          .values,
      (std::vector<double>{0, 2}));
  request.where.emplace_back("set", "d");
  EXPECT_NE(strip_refusal("set,side,stretch,stress [kPa]\na,left,1,0\nc,left,1.2,2\n", {}, request)
                .find("no row left has the value 'd'"),
            std::string::npos);
}

TEST(RigData, CountsRowsFromTheEnd) {
  DataRequest request;
  request.rows = {-2, {}, 1};
  const char* const text = "stretch,stress [kPa]\n1,0\n1.1,1\n1.2,2\n1.3,3\n";
  EXPECT_EQ(read_strip(text, {}, request).channels[0].values, (std::vector<double>{2, 3}));
  request.rows = {-50, -3, 1};
  EXPECT_EQ(read_strip(text, {}, request).channels[0].values, (std::vector<double>{0}));
}

TEST(RigData, WarnsFirstOfCyclesReadAsOneCurve) {
  const Dataset strip = read_strip(preconditioned(5), by_force, strip_of(1, 1, 10));
  ASSERT_FALSE(strip.warnings.empty());
  EXPECT_EQ(
      strip.warnings.front(),
      "strip.csv, line 1, column 1 ('Way'): the rows go through 6 cycles of 'stretch' and are read as one curve. "
      "Choose some with \"cycle\" (\"last\", a number or a list), or say with \"cycle\": \"all\" that they are the "
      "history of loading.");
  DataRequest request = strip_of(1, 1, 10);
  request.cycle = CycleChoice{};
  const Dataset all = read_strip(preconditioned(5), by_force, request);
  EXPECT_TRUE(all.warnings.empty());
  EXPECT_TRUE(all.ordered);
  EXPECT_EQ(all.count, strip.count);
}

TEST(RigData, TakesTheLastCycleAListOfThemAndBranches) {
  DataRequest request = strip_of(1, 1, 10);
  request.cycle = CycleChoice{true, {}};
  const Dataset last = read_strip(preconditioned(5), by_force, request);
  ASSERT_EQ(last.count, 11u);
  EXPECT_EQ(last.channels[0].values.front(), 0);
  EXPECT_DOUBLE_EQ(last.channels[0].values.back(), 16 * 5);
  request.cycle = CycleChoice{false, {2, 3}};
  request.branch = BranchChoice::unloading;
  const Dataset back = read_strip(preconditioned(5), by_force, request);
  ASSERT_EQ(back.count, 18u);  // from below the peak to above the valley
  EXPECT_DOUBLE_EQ(back.channels[0].values.front(), 12 * 4.5);
  request.cycle = CycleChoice{true, {}};
  EXPECT_DOUBLE_EQ(read_strip(preconditioned(5), by_force, request).channels[0].values.front(), 15 * 4.5)
      << "the last unloading is that of cycle 5";
  request.cycle = CycleChoice{false, {7}};
  EXPECT_EQ(
      strip_refusal(preconditioned(5), by_force, request),
      "strip.csv, line 1, column 1 ('Way'): there is no cycle 7. Cycles found from the turning points: 1, 2, 3, 4, "
      "5, 6.");
}

TEST(RigData, TakesCyclesFromAColumn) {
  DataRequest request = strip_of(1, 1, 10);
  request.cycle = CycleChoice{true, {}};
  request.cycles_from = "Cycle";
  request.branch = BranchChoice::loading;
  const Dataset strip = read_strip(
      "Cycle,Way [mm],Force "
      "[mN]\n1-Stretch,0,0\n1-Stretch,5,50\n1-Recover,0,1\n2-Stretch,0,2\n2-Stretch,5,40\n2-Recover,0,"
      "1\n",
      by_force, request);
  EXPECT_EQ(strip.channels[0].values, (std::vector<double>{2, 40}));
  EXPECT_NE(strip_refusal("Cycle,Way [mm],Force [mN]\n1,0,0\nend,5,50\n", by_force, request)
                .find("line 3, column 1 ('Cycle'): found 'end' where the number of a cycle is expected"),
            std::string::npos);
}

TEST(RigData, BeginsATimeWithThePartThatIsUsed) {
  DataRequest request = strip_of(1, 1, 10);
  request.cycle = CycleChoice{true, {}};
  Mapping columns = by_force;
  columns.emplace_back("time", "t");
  const Dataset strip = read_strip("t [s],Way [mm],Force [mN]\n0,0,0\n1,5,50\n2,0,0\n3,5,40\n", columns, request);
  EXPECT_EQ(strip.time, (std::vector<double>{0, 1}));
}

TEST(RigData, LeavesCellsOutOfChannelsThatHaveOthers) {
  const Mapping both = {{"stretch", "stretch"}, {"stress", "stress"}, {"transverse_stretch", "across"}};
  const Dataset strip = read_strip("stretch,stress [kPa],across\n1,0,1\n1.1,,0.95\n1.2,5,NaN\n", both);
  EXPECT_TRUE(std::isnan(strip.channels[0].values[1]));
  EXPECT_EQ(strip.channels[0].values[2], 5);
  EXPECT_TRUE(std::isnan(strip.channels[1].values[2]));
  EXPECT_EQ(strip.channels[1].values[1], 0.95);
  EXPECT_NE(strip_refusal("stretch,stress [kPa],across\n1,0,1\n1.1,,\n", both)
                .find("line 3, column 2 ('stress'): found an empty cell"),
            std::string::npos)
      << "nothing was measured in that row";
}

TEST(LocalRegression, ReproducesALineAndStatesItsError) {
  std::vector<double> x, y;
  std::mt19937 generator(11);
  std::normal_distribution<double> normal(0, 0.5);
  for (int row = 0; row < 4000; ++row) {
    x.push_back(row / 4000.0);
    y.push_back(2 + 3 * x.back() + normal(generator));
  }
  std::vector<double> line;
  for (const double at : x) line.push_back(2 + 3 * at);
  std::vector<double> at;
  for (int point = 0; point < 21; ++point) at.push_back(point / 20.0 * x.back());
  const Smoothed exact = local_regression(x, line, at, 0.05);
  for (std::size_t point = 0; point < at.size(); ++point) EXPECT_NEAR(exact.values[point], 2 + 3 * at[point], 1e-10);
  const Smoothed noisy = local_regression(x, y, at, 0.05);
  EXPECT_NEAR(noisy.scatter, 0.5, 0.5 * 0.06);  // sd of an estimate from 4000 values is 1.1 %: six of them
  double squares = 0;
  for (std::size_t point = 0; point < at.size(); ++point)
    squares += std::pow((noisy.values[point] - 2 - 3 * at[point]) / noisy.error, 2);
  // χ² with 21 degrees of freedom, but for the correlation: outside of 5 to 50 with a chance below 0.001.
  EXPECT_GT(squares, 5);
  EXPECT_LT(squares, 50);
  EXPECT_GT(noisy.correlation, 0);
  EXPECT_LT(noisy.correlation, 0.5);
}

TEST(RigData, ResamplesBranchesAndKeepsTheScatterAsNoise) {
  std::string text = "stretch [-],stress [kPa]\n";
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0, 2);
  for (int row = 0; row <= 800; ++row) {
    const double x = 1 + 0.4 * (row <= 400 ? row : 800 - row) / 400.0;
    text += fmt::format("{},{}\n", x, 100 * (x - 1) + (row > 400 ? 30 : 0) + normal(generator));
  }
  DataRequest request;
  request.resample = 11;
  const Dataset strip = read_strip(text, {}, request);
  ASSERT_EQ(strip.count, 22u);
  EXPECT_NEAR(strip.abscissae[0].second[5], 1.2, 1e-12);
  ASSERT_TRUE(strip.channels[0].noise);
  const double error = strip.channels[0].noise->absolute;
  EXPECT_LT(error, 2.0 / std::sqrt(10)) << "many rows stand behind each point";
  EXPECT_GT(error, 2.0 / std::sqrt(80));
  for (std::size_t row = 1; row < 10; ++row)
    EXPECT_NEAR(strip.channels[0].values[row], 100 * (strip.abscissae[0].second[row] - 1), 5 * error) << row;
  request.resample = 500;
  EXPECT_NE(strip_refusal(text, {}, request).find("\"resample\" is 500, and a branch has only 401 rows"),
            std::string::npos);
}

TEST(RigData, NamesWhatIsMissing) {
  DataRequest request = strip_of(1, 1, 10);
  request.specimen.thickness.reset();
  EXPECT_EQ(strip_refusal("Way [mm],Force [N]\n0,0\n1,1\n", by_force, request),
            "strip.csv, line 1, column 2 ('Force'): 'force' needs the size \"thickness\" of the specimen. Add it to "
            "\"specimen\".");
  EXPECT_NE(strip_refusal("Way [mm],Force [mm]\n0,0\n1,1\n", by_force, strip_of(1, 1, 10))
                .find("The quantity 'force' is in mN: correct the unit in the header."),
            std::string::npos);
  request = strip_of(1, 1, 10);
  request.preload = Preload{1, false};
  EXPECT_NE(strip_refusal("Way [mm],Force [N]\n0,0\n1,1\n", by_force, request).find("the preload is a stress"),
            std::string::npos);
}

TEST(TablePlace, TakesNumbersForNamesAboveARowOfUnits) {
  const auto place = find_table(
      "MTS793|MPT|DEU|1|2|,|.|:|A\nDatum\t30.6.2023\nTag\tLaufzeit\tKraft\tWeg\t1470533\nd\ts\tkN\tmm\tmm\n"
      "45107\t22,89\t-1,27\t38,0\t-0,5\n45107\t23,89\t-1,85\t38,1\t-0,6\n45107\t24,89\t-3,01\t38,2\t-0,7\n",
      {});
  ASSERT_TRUE(place);
  EXPECT_EQ(place->header, 3u);
  EXPECT_EQ(place->delimiter, '\t');
}

TEST(RigData, StrainsAreWhatTheyAreDeclaredAs) {
  const double e = std::log(1.2), green = 0.5 * (1.2 * 1.2 - 1);
  const std::string text = fmt::format("log,green,stress [kPa]\n0,0,0\n{},{},1\n{},{},2\n", e / 2, green / 2, e, green);
  const Dataset of_log = read_strip(text, {{"true_strain", "log"}, {"stress", "stress"}});
  const Dataset of_green = read_strip(text, {{"green_strain", "green"}, {"stress", "stress"}});
  EXPECT_NEAR(of_log.abscissae[0].second[2], 1.2, 1e-14);
  EXPECT_NEAR(of_green.abscissae[0].second[2], 1.2, 1e-14);
  EXPECT_NE(strip_refusal("green,stress [kPa]\n0,0\n-0.5,1\n", {{"green_strain", "green"}, {"stress", "stress"}})
                .find("line 3, column 1 ('green'): found the Green strain -0.5"),
            std::string::npos);
}

TEST(RigData, CompressionMayBePositive) {
  const std::string text = "strain,stress [kPa]\n0,0\n0.1,1\n0.2,3\n";
  DataRequest request;
  request.compression.all = true;
  const Dataset all = read_strip(text, {{"strain", "strain"}, {"stress", "stress"}}, request);
  EXPECT_NEAR(all.abscissae[0].second[2], 0.8, 1e-15);
  EXPECT_EQ(all.channels[0].values[2], -3);
  request.compression = {false, {"stress"}};
  const Dataset one = read_strip(text, {{"strain", "strain"}, {"stress", "stress"}}, request);
  EXPECT_NEAR(one.abscissae[0].second[2], 1.2, 1e-15);
  EXPECT_EQ(one.channels[0].values[2], -3);
  request.compression = {false, {"stretch"}};
  EXPECT_NE(strip_refusal("stretch,stress [kPa]\n1,0\n1.1,1\n", {}, request)
                .find("\"compression\" names this column, and it is not read as"),
            std::string::npos);
}

TEST(RigData, RowsOfEmptyCellsAreBlankLines) {
  const Dataset dataset = read_strip("stretch,stress [kPa],\n1,0,\n1.1,2,\n,,\n, , \n1.2,3,\n,,\n");
  EXPECT_EQ(dataset.count, 3u);
}

TEST(RigData, TextOfOtherEncodingsIsReadAndWorkbooksAreNot) {
  std::string wide = "\xFF\xFE";
  for (const char letter : std::string("stretch,stress [kPa]\n1,0\n1.1,2\n")) {
    wide += letter;
    wide += '\0';
  }
  EXPECT_EQ(read_strip(wide).channels[0].values[1], 2);
  EXPECT_NE(strip_refusal(std::string("PK\x03\x04\x14\0", 6)).find("this is a workbook"), std::string::npos);
  EXPECT_NE(strip_refusal("\xD0\xCF\x11\xE0\xA1").find("this is a workbook"), std::string::npos);
}

}  // namespace
}  // namespace tunica::data
