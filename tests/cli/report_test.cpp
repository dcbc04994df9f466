// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::HasSubstr;

TEST(ReportVerb, RunWritesAReportAndTheVerbMakesItAgain) {
  const trial::Bench bench;
  const auto ran = bench.tunica({"run", "experiment.json", "-o", "out"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("Report:  out/report.html"));
  const std::string first = bench.text("out/report.html");
  EXPECT_THAT(first, HasSubstr("How well"));
  std::filesystem::remove(bench.path("out/report.html"));
  const auto made = bench.tunica({"report", "out"});
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.out, "out/report.html\n");
  EXPECT_EQ(bench.text("out/report.html"), first);
}

TEST(ReportVerb, PutsFoldersSideBySide) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "a"}).code, 0);
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "b", "--seed", "9"}).code, 0);
  const auto unnamed = bench.tunica({"report", "a", "b"});
  EXPECT_EQ(unnamed.code, 2);
  EXPECT_THAT(unnamed.err, HasSubstr("say with -o where it goes"));
  EXPECT_EQ(bench.tunica({"report", "a", "b", "-o", "both.html"}).out, "both.html\n");
  EXPECT_THAT(bench.text("both.html"), HasSubstr("Side by side"));
  EXPECT_THAT(bench.text("both.html"), HasSubstr("href=\"a/fit_circ.csv\""));
}

TEST(ReportVerb, SaysWhatIsWrongWithItsArguments) {
  const trial::Bench bench;
  const auto absent = bench.tunica({"report", "nowhere"});
  EXPECT_EQ(absent.code, 2);
  EXPECT_THAT(absent.err, HasSubstr("nowhere: no such folder"));
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  EXPECT_THAT(bench.tunica({"report", "out", "-o", "out"}).err, HasSubstr("is a folder; name a file"));
  EXPECT_THAT(bench.tunica({"report", "out", "-o", "no/where.html"}).err, HasSubstr("make it first"));
}
