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

// The programs that print are looked for on PATH: here a script that says what it was asked for.
TEST(ReportVerb, PrintsThePageByABrowser) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  const auto with = [&bench](const std::string& browser, const std::string& path) {
    std::vector<std::string> words = trial::tunica_command({"report", "out", "--pdf", "out.pdf"});
    words.insert(words.begin(), {"/usr/bin/env", "PATH=" + path, "TUNICA_BROWSER=" + browser});
    return trial::Process(words, bench.folder.path()).wait();
  };
  const auto script = [&bench](const std::string& name, const std::string& text) {
    bench.folder.write(name, "#!/bin/sh\n" + text);
    std::filesystem::permissions(bench.path(name), std::filesystem::perms::owner_all);
    return bench.path(name).string();
  };
  std::filesystem::create_directory(bench.path("bin"));
  const std::string bin = bench.path("bin").string();
  const auto none = with("", bin);
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("install one (Debian: chromium)"));
  const std::string prints =
      "for word; do case $word in --print-to-pdf=*) to=${word#*=};; file://*) page=${word#file://};; esac; done\n"
      "echo '%PDF-1.4' > $to; cat $page >> $to; echo noise >&2\n";
  script("bin/chromium", prints);
  const auto found = with("", bin + ":/usr/bin:/bin");
  EXPECT_EQ(found.code, 0) << found.err;
  EXPECT_EQ(found.out, "out.pdf\n");
  EXPECT_EQ(found.err, "");
  EXPECT_EQ(bench.text("out.pdf").substr(0, 9), "%PDF-1.4\n");
  EXPECT_NE(bench.text("out.pdf").find("How well"), std::string::npos);
  const auto fails = with(script("fails", "exit 3\n"), bin);
  EXPECT_EQ(fails.code, 2);
  EXPECT_THAT(fails.err, HasSubstr("has printed no PDF: it ended with code 3"));
  const auto lies = with(script("lies", "exit 0\n"), bin);
  EXPECT_THAT(lies.err, HasSubstr("has printed no PDF; name another browser"));
  EXPECT_THAT(bench.tunica({"report", "out", "--pdf", "no/where.pdf"}).err, HasSubstr("make it first"));
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
