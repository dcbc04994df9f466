// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

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

namespace {

/// A script that stands for a browser.
std::string script_in(const trial::Bench& bench, const std::string& name, const std::string& text) {
  bench.folder.write(name, "#!/bin/sh\n" + text);
  std::filesystem::permissions(bench.path(name), std::filesystem::perms::owner_all);
  return bench.path(name).string();
}

/// Prints the report of out; temporary files go into a folder whose name is no address as it stands.
std::vector<std::string> printing(const trial::Bench& bench, const std::string& browser, const std::string& path) {
  const auto scratch = bench.path("50% of #1");
  std::filesystem::create_directory(scratch);
  std::vector<std::string> words = trial::tunica_command({"report", "out", "--pdf", "out.pdf"});
  words.insert(words.begin(),
               {"/usr/bin/env", "PATH=" + path, "TUNICA_BROWSER=" + browser, "TMPDIR=" + scratch.string()});
  return words;
}

}  // namespace

// The programs that print are looked for on PATH: here a script that says what it was asked for.
TEST(ReportVerb, PrintsThePageByABrowser) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  const auto with = [&bench](const std::string& browser, const std::string& path) {
    return trial::Process(printing(bench, browser, path), bench.folder.path()).wait();
  };
  const auto script = [&bench](const std::string& name, const std::string& text) {
    return script_in(bench, name, text);
  };
  std::filesystem::create_directory(bench.path("bin"));
  const std::string bin = bench.path("bin").string();
  const auto none = with("", bin);
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("install one (Debian: chromium)"));
  const std::string prints =
      "for word; do case $word in --print-to-pdf=*) to=${word#*=};; file://*) page=${word#file://};; esac; done\n"
      "page=$(echo \"$page\" | sed 's/%20/ /g; s/%23/#/g; s/%25/%/g')\n"
      "echo '%PDF-1.4' > \"$to\"; cat \"$page\" >> \"$to\"; echo noise >&2\n";
  script("bin/chromium", prints);
  const auto found = with("", bin + ":/usr/bin:/bin");
  EXPECT_EQ(found.code, 0) << found.err;
  EXPECT_EQ(found.out, "out.pdf\n");
  EXPECT_EQ(found.err, "");
  EXPECT_EQ(bench.text("out.pdf").substr(0, 9), "%PDF-1.4\n");
  EXPECT_NE(bench.text("out.pdf").find("How well"), std::string::npos);
  const auto fails = with(script("fails", "echo first >&2; echo no display >&2; echo >&2; exit 3\n"), bin);
  EXPECT_EQ(fails.code, 2);
  EXPECT_THAT(fails.err, HasSubstr("has printed no PDF: it ended with code 3 ('no display'); name another"));
  const auto lies = with(script("lies", "exit 0\n"), bin);
  EXPECT_THAT(lies.err, HasSubstr("has printed no PDF; name another browser"));
  EXPECT_THAT(lies.err, HasSubstr("make the page with `tunica report DIR`"));
  EXPECT_THAT(bench.tunica({"report", "out", "--pdf", "no/where.pdf"}).err, HasSubstr("make it first"));
  EXPECT_THAT(bench.tunica({"report", "out", "--pdf", ""}).err, HasSubstr("--pdf: found an empty value"));
  EXPECT_TRUE(std::filesystem::is_empty(bench.path("50% of #1")));
}

// Everything that may be refused is refused before the browser begins.
TEST(ReportVerb, LooksAtBothFilesBeforeItPrints) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  auto words = printing(bench, script_in(bench, "browser", "touch begun; exit 3\n"), "/usr/bin:/bin");
  words.insert(words.end(), {"-o", "no/where.html"});
  const auto refused = trial::Process(words, bench.folder.path()).wait();
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("make it first"));
  EXPECT_FALSE(std::filesystem::exists(bench.path("begun")));
}

TEST(ReportVerb, CtrlCEndsTheBrowserAndLeavesNothing) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  const std::string browser =
      script_in(bench, "browser", "sleep 600 & echo $! > sleeper.part; mv sleeper.part sleeper; wait\n");
  trial::Process printer(printing(bench, browser, "/usr/bin:/bin"), bench.folder.path());
  for (int k = 0; k < 600 && !std::filesystem::exists(bench.path("sleeper")); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const int sleeper = std::stoi(bench.text("sleeper"));
  EXPECT_EQ(::kill(sleeper, 0), 0);
  printer.signal(SIGINT);
  const auto ended = printer.wait();
  EXPECT_EQ(ended.code, 130) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("interrupted; nothing is printed"));
  EXPECT_TRUE(std::filesystem::is_empty(bench.path("50% of #1")));
  EXPECT_FALSE(std::filesystem::exists(bench.path("out.pdf")));
  // Its end takes a moment; then its new parent may not have collected it yet.
  const auto state = [sleeper] {
    std::ifstream file("/proc/" + std::to_string(sleeper) + "/stat");
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const auto is_over = [&] { return state().empty() || state().find(") Z ") != std::string::npos; };
  for (int k = 0; k < 100 && !is_over(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_TRUE(is_over()) << state();
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
