// SPDX-License-Identifier: Apache-2.0
#include "execution/evaluation_table.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>

#include "execution/damage.hpp"
#include "execution/folder.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using execution::EvaluationTable;
using ::testing::HasSubstr;

namespace {

EvaluationTable two_runs() {
  return EvaluationTable({{"gho/es", {{"mu", "kPa"}, {"kappa", "1"}}, {"circ", "axial"}},
                          {"neo/lm", {{"mu", "kPa"}, {"c, \"odd\"", "1"}}, {"axial"}}});
}

std::string row(const EvaluationTable& table, std::size_t run, const std::vector<double>& parameters, double objective,
                const std::vector<double>& per_test, const Status& status, std::uint64_t index = 0,
                double seconds = 0.25) {
  fmt::memory_buffer buffer;
  table.append_row(buffer, run, 3, {index, parameters, objective, per_test, status, seconds});
  return fmt::to_string(buffer);
}

search::JournalEntry read(const EvaluationTable& table, std::string line, EvaluationTable::Row& parsed) {
  line.pop_back();
  search::JournalEntry entry;
  table.parse(line, parsed);
  table.values(parsed, entry);
  return entry;
}

}  // namespace

TEST(EvaluationTable, UnitesTheColumnsOfAllRuns) {
  EXPECT_EQ(two_runs().header(),
            "id,run,realisation,mu [kPa],kappa [1],\"c, \"\"odd\"\" "
            "[1]\",cost.circ,cost.axial,objective,status,violation,reason,time [s],checksum\n");
}

TEST(EvaluationTable, LeavesCellsEmptyThatARunDoesNotHave) {
  EXPECT_EQ(row(two_runs(), 1, {10.5, 2}, 7, {7}, Status()), trial::checked("1,neo/lm,3,10.5,,2,,7,7,ok,,,0.250000"));
}

TEST(EvaluationTable, WritesNoObjectiveForAFailedEvaluation) {
  EXPECT_EQ(
      row(two_runs(), 0, {1, 0.1}, std::nan(""), {1, 2}, Status::failed("row 3, stretch 1.2: no, \"root\"\nfound"), 8),
      trial::checked("9,gho/es,3,1,0.1,,,,,failed,,\"row 3, stretch 1.2: no, \"\"root\"\"\\nfound\",0.250000"));
}

// 2000 random bit patterns of finite doubles, seed 1; any loss of a bit fails, so there is no false alarm.
TEST(EvaluationTable, ReadsBackEveryBit) {
  const auto table = two_runs();
  std::mt19937_64 generator(1);
  const auto finite = [&] {
    for (;;) {
      const double value = std::bit_cast<double>(generator());
      if (std::isfinite(value)) return value;
    }
  };
  EvaluationTable::Row parsed;
  for (std::uint64_t index = 0; index < 2000; ++index) {
    const std::vector<double> parameters{finite(), finite()}, per_test{finite(), finite()};
    const double objective = finite();
    const auto entry = read(table, row(table, 0, parameters, objective, per_test, Status(), index), parsed);
    ASSERT_EQ(entry.parameters, parameters);
    ASSERT_EQ(entry.per_test, per_test);
    ASSERT_EQ(entry.objective, objective);
    ASSERT_EQ(parsed.index, index);
    ASSERT_EQ(parsed.realisation, 3u);
    ASSERT_EQ(parsed.run, 0u);
  }
}

TEST(EvaluationTable, ReadsBackStatusAndReason) {
  const auto table = two_runs();
  EvaluationTable::Row parsed;
  auto entry = read(table, row(table, 1, {1, 2}, 0, {0}, Status::failed("no \"root\", sorry")), parsed);
  EXPECT_EQ(entry.status.kind(), Status::Kind::failed);
  EXPECT_EQ(entry.status.reason(), "no \"root\", sorry");
  EXPECT_EQ(parsed.run, 1u);
  entry = read(table, row(table, 1, {1, 2}, 4, {4}, Status::infeasible("unstable", 0.1)), parsed);
  EXPECT_EQ(entry.status.kind(), Status::Kind::infeasible);
  EXPECT_EQ(entry.objective, 4);
  EXPECT_EQ(entry.status.violation(), 0.1);
}

TEST(EvaluationTable, RefusesLinesItCannotHaveWritten) {
  const auto table = two_runs();
  EvaluationTable::Row parsed;
  const auto message = [&](const std::string& line) {
    return trial::message_of<InputError>([&] { table.parse(line, parsed); });
  };
  EXPECT_THAT(message("1,gho/es"), HasSubstr("2 cells where the header has 14"));
  EXPECT_THAT(message("1,other,1,1,,,,,1,ok,,,0,"), HasSubstr("'other' is not a run"));
  EXPECT_THAT(message("x,gho/es,1,1,,,,,1,ok,,,0,"), HasSubstr("'x' is not a number"));
  table.parse("1,gho/es,1,1,,,,,1,fine,,,0,", parsed);
  search::JournalEntry entry;
  EXPECT_THAT(trial::message_of<InputError>([&] { table.values(parsed, entry); }), HasSubstr("'fine' is not a status"));
}
