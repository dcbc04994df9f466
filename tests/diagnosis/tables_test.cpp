// SPDX-License-Identifier: Apache-2.0
// residuals.csv and confusability.csv, cell by cell.
#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"
#include "diagnosis/naming/claims.hpp"
#include "diagnosis/output/outputs.hpp"
#include "diagnosis/search_bed.hpp"
#include "execution/folder.hpp"

namespace tunica::diagnosis::tables_test {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;
using Cells = std::vector<std::string>;

std::vector<Cells> cells_of(const std::string& text) {
  std::vector<Cells> all;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    all.emplace_back();
    std::istringstream cells(line + ",");
    for (std::string cell; std::getline(cells, cell, ',');) all.back().push_back(cell);
  }
  return all;
}

/// The cells of a column.
Cells column(const std::vector<Cells>& table, const std::string& name) {
  const auto at = static_cast<std::size_t>(std::find(table[0].begin(), table[0].end(), name) - table[0].begin());
  EXPECT_LT(at, table[0].size()) << name;
  Cells found;
  for (std::size_t k = 1; k < table.size(); ++k) found.push_back(at < table[k].size() ? table[k][at] : "missing");
  return found;
}

/// Two tests; the base shows 1 + x/10 and so do the data. Row 1 of "a" is held out, row 2 of it gross.
struct Bed : SearchBed {
  Bed() {
    auto& first = add("a", {1, 2, 3, 4});
    first.hold_out.rows = data::RowRange{1, 2, 1};
    first.data.noise.front().second.gross = {2};
    add("b", {5, 6}, true);
    close();
    evidence.fit.residuals = Eigen::VectorXd::LinSpaced(7, 1, 7);
  }
};

TEST(ResidualTable, HasALineForEveryFittedRow) {
  const Bed bed;
  const auto table = cells_of(residual_table(bed.evidence, nullptr, nullptr, {}));
  ASSERT_THAT(table, SizeIs(8));
  EXPECT_THAT(column(table, "test"), ElementsAre("a", "a", "a", "b", "b", "b", "b"));
  EXPECT_THAT(column(table, "channel"), ElementsAre("y", "y", "y", "y", "y", "z", "z"));
  EXPECT_THAT(column(table, "row"), ElementsAre("0", "2", "3", "0", "1", "0", "1"));
  EXPECT_THAT(column(table, "abscissa"), ElementsAre("1", "3", "4", "5", "6", "5", "6"));
  EXPECT_THAT(column(table, "abscissa_name"), ::testing::Each("x"));
  EXPECT_THAT(column(table, "unit"), ::testing::Each("kPa"));
  EXPECT_THAT(column(table, "measured"), ElementsAre("1.1", "1.3", "1.4", "1.5", "1.6", "15", "16"));
  EXPECT_THAT(column(table, "predicted"), ElementsAre("1.1", "1.3", "1.4", "1.5", "1.6", "15", "16"));
  EXPECT_THAT(column(table, "sigma"), ElementsAre("0.5", "0.5", "0.5", "0.5", "0.5", "5", "5"));
  EXPECT_THAT(column(table, "extended"), ::testing::Each(""));
  EXPECT_THAT(column(table, "residual_extended"), ::testing::Each(""));
  const Cells residual = column(table, "residual");
  EXPECT_EQ(residual[0], "-1") << "measured less predicted";
  EXPECT_LT(std::abs(std::stod(residual[1])), 1e-9) << "a gross row is as far off as it is, whatever the fit counts";
  EXPECT_THAT(Cells(residual.begin() + 2, residual.end()), ElementsAre("-3", "-4", "-5", "-6", "-7"));
}

TEST(ResidualTable, HasTheExtensionAndSignaturesBeside) {
  const Bed bed;
  const Extension extended(bed.experiment, bed.run, {{"offset", {{"a"}}, {}}}, bed.shelf);
  Fit fit;
  fit.free = {0.3};
  fit.residuals = Eigen::VectorXd::LinSpaced(7, 0.5, 3.5);
  const auto table = cells_of(
      residual_table(bed.evidence, &extended.assembly(), &fit, {{"first", Eigen::VectorXd::LinSpaced(7, 10, 16)}}));
  EXPECT_THAT(column(table, "extended"), ElementsAre("1.4", "1.6", "1.7", "1.5", "1.6", "15", "16"));
  EXPECT_THAT(column(table, "residual_extended"), ElementsAre("-0.5", "-0.6", "-1.5", "-2", "-2.5", "-3", "-3.5"))
      << "of the gross row (1.3 - 1.6)/0.5";
  EXPECT_EQ(column(table, "residual")[0], "-1");
  EXPECT_THAT(column(table, "signature_first"), ElementsAre("10", "11", "12", "13", "14", "15", "16"));
}

TEST(ResidualTable, LeavesOutCurvesThatAreNotOfTheDiagnosis) {
  Bed bed;
  bed.evidence.curves.erase(bed.evidence.curves.begin());
  EXPECT_THAT(column(cells_of(residual_table(bed.evidence, nullptr, nullptr, {})), "test"),
              ElementsAre("b", "b", "b", "b"));
  bed.evidence.curves.erase(bed.evidence.curves.begin());
  EXPECT_THAT(column(cells_of(residual_table(bed.evidence, nullptr, nullptr, {})), "channel"), ElementsAre("z", "z"));
}

TEST(ResidualTable, SaysWhereNothingCanBePredicted) {
  Bed bed;
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("no"); });
  const auto table = cells_of(residual_table(bed.evidence, nullptr, nullptr, {}));
  EXPECT_THAT(column(table, "predicted"), ::testing::Each("nan"));
  EXPECT_EQ(column(table, "measured")[0], "1.1");
}

/// The tables of causes that explain a row each, of 25, 16 and 9.
struct Written {
  explicit Written(std::size_t named) : causes({25, 16, 9}) {
    causes.add_each(3);
    causes.close();
    found.analysis = causes.analysis;
    found.explanation.best_direction = {0, std::nullopt, 2};
    Claim& claim = found.explanation.claim;
    claim.named = named;
    claim.causes.resize(3);
    claim.causes[2].id = "m2";  // that no refit has
    claim.causes[0].id = "m0";
    claim.causes[1].id = named == 1 ? "m1" : "m0";
    claim.best = named == 1 ? causes.single("m0").best : causes.group_of({0, 1}).refit;
    claim.rivals = {*claim.best};
    if (named == 1) claim.rivals.push_back(*causes.single("m1").best);
  }
  std::vector<Cells> table(const std::string& name) {
    write_tables(folder.path(), found);
    return cells_of(trial::text_of(folder.path() / name));
  }
  OneRowEach causes;
  Diagnosis found;
  trial::Folder folder;
};

std::vector<double> numbers(const Cells& cells) {
  std::vector<double> all;
  for (const std::string& one : cells) all.push_back(std::stod(one));
  return all;
}

using ::testing::DoubleNear;
auto near(double value) { return DoubleNear(value, 1e-3); }

TEST(WrittenTables, SayOfOneExplanationHowItsRefitDiffersFromTheBase) {
  Written written(1);
  const auto table = written.table("residuals.csv");
  EXPECT_THAT(numbers(column(table, "signature_m0")), ElementsAre(near(5), near(0), near(0)));
  EXPECT_THAT(numbers(column(table, "signature_m1")), ElementsAre(near(0), near(4), near(0)));
  EXPECT_THAT(numbers(column(table, "signature_m2")), ElementsAre(0, 0, 0));
  EXPECT_THAT(numbers(column(table, "residual_extended")), ElementsAre(near(0), near(4), near(3)));
}

TEST(WrittenTables, SayOfAMemberWhatItsAmplitudeDoes) {
  Written written(2);
  const auto table = written.table("residuals.csv");
  EXPECT_THAT(numbers(column(table, "signature_m0")), ElementsAre(near(5), near(0), near(0)));
  EXPECT_THAT(numbers(column(table, "signature_m0_2")), ElementsAre(near(0), near(4), near(0))) << "of the same name";
  EXPECT_THAT(numbers(column(table, "signature_m2")), ElementsAre(0, 0, 0));
  written.found.analysis.hypotheses.projection = Projection(Eigen::MatrixXd(Eigen::Vector3d(1, 0, 1)));
  EXPECT_THAT(numbers(column(written.table("residuals.csv"), "signature_m0")),
              ElementsAre(near(2.5), near(0), near(-2.5)))
      << "as far as the parameters could not do it";
  written.found.explanation.claim.best.reset();
  const auto without = written.table("residuals.csv");
  EXPECT_THAT(numbers(column(without, "signature_m0")), ElementsAre(0, 0, 0));
  EXPECT_THAT(column(without, "extended"), ::testing::Each(""));
}

TEST(WrittenTables, SayHowMuchMechanismsLookAlike) {
  Written written(1);
  written.found.analysis.hypotheses.directions[2].unit = Eigen::Vector3d(0.6, 0, 0.8);
  const auto table = written.table("confusability.csv");
  EXPECT_THAT(table, ElementsAre(Cells({"mechanism", "m0", "m2"}), Cells({"m0", "1.0000", "0.6000"}),
                                 Cells({"m2", "0.6000", "1.0000"})))
      << "m1 leaves no trace";
}

}  // namespace
}  // namespace tunica::diagnosis::tables_test
