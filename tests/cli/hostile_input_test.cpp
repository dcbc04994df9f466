// SPDX-License-Identifier: Apache-2.0
// Malicious or unforeseen input: it gives one message and exit code 2, in time.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

/// Exit code 2, nothing on stdout, no folder, and a message of a size that a person reads.
std::string refusal_of(const trial::Bench& bench) {
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_EQ(ended.code, 2) << ended.err.substr(0, 1000);
  EXPECT_EQ(ended.out, "");
  EXPECT_LT(ended.err.size(), 1000u);
  EXPECT_FALSE(std::filesystem::exists(bench.path("out")));
  return ended.err;
}

/// Neither ESC, nor C1, nor a mark of direction, nor a byte that is not UTF-8 (JSON has none of these either).
void expect_harmless(const std::string& text) {
  for (const char* harm : {"\033", "\u009b", "\u202e", "\xFF"})
    EXPECT_THAT(text, Not(HasSubstr(harm))) << text.substr(0, 2000);
}

}  // namespace

TEST(HostileInput, CountsThatNoMachineHolds) {
  trial::Bench bench;
  bench.experiment["runs"][0]["realisations"] = 1000000000;
  EXPECT_THAT(refusal_of(bench), HasSubstr("a whole number of realisations from 1 to 100000 is expected"));
  bench.experiment["runs"][0].erase("realisations");
  bench.experiment["constraints"] = {{{"type", "transverse_stability"}, {"points", 1000000000000}}};
  EXPECT_THAT(refusal_of(bench), HasSubstr("a whole number of stretches from 2 to 10000 is expected"));
  bench.experiment.erase("constraints");
  bench.experiment["analysis"]["bootstrap"]["draws"] = 1000000000;
  EXPECT_THAT(refusal_of(bench), HasSubstr("a whole number of draws from 40 to 1000000 is expected"));
}

TEST(HostileInput, CountsOnTheCommandLine) {
  const trial::Bench bench;
  for (const auto& [option, value] :
       {std::pair{"--bootstrap", "1000000000"}, std::pair{"-j", "1000000000"}, std::pair{"--shard", "1/1000000000"}}) {
    const auto ended = bench.tunica({"run", "experiment.json", "-o", "out", option, value});
    EXPECT_EQ(ended.code, 2) << option;
    EXPECT_FALSE(std::filesystem::exists(bench.path("out")));
  }
}

TEST(HostileInput, EmptyValuesOfOptions) {
  const trial::Bench bench;
  for (const char* option : {"--shard", "-o", "--plugin-path"}) {
    const auto ended = bench.tunica({"run", "experiment.json", option, ""});
    EXPECT_EQ(ended.code, 2) << option;
    EXPECT_THAT(ended.err, HasSubstr("empty")) << option;
    EXPECT_FALSE(std::filesystem::exists(bench.path("results")));
  }
}

TEST(HostileInput, BatchOfAFolderWithoutCases) {
  const trial::Bench bench;
  std::filesystem::create_directory(bench.path("cases"));
  const auto ended = bench.tunica({"diagnose", "--batch", "cases"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("holds no folder with an experiment.json"));
}

TEST(HostileInput, NulInTheNameOfAFile) {
  trial::Bench bench;
  for (auto& [name, test] : bench.experiment["tests"].items()) {
    auto& file = test["data"]["file"];
    if (file.is_string()) file = file.get<std::string>() + std::string("\0.csv", 5);
  }
  EXPECT_THAT(refusal_of(bench), HasSubstr("NUL character"));
}

// Sanitizers reserve more memory than any limit leaves them.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
// Realisations that the schema allows, where a process may have 600 MB.
TEST(HostileInput, WhatDoesNotFitIntoTheMemoryIsRefusedBeforeItIsTried) {
  trial::Bench bench;
  bench.experiment["runs"][0]["realisations"] = 100000;
  bench.save();
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", "experiment.json", "-o", "out"}, {"check", "experiment.json"}}) {
    std::vector<std::string> command{"/bin/sh", "-c", "ulimit -d 600000; exec \"$@\"", "sh"};
    for (std::string& word : trial::tunica_command(arguments)) command.push_back(std::move(word));
    const auto ended = trial::Process(command, bench.folder.path()).wait();
    EXPECT_EQ(ended.code, 2) << ended.err.substr(0, 1000);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("the experiment needs about"), HasSubstr("lower \"realisations\"")));
    EXPECT_FALSE(std::filesystem::exists(bench.path("out")));
  }
}
#endif

TEST(HostileInput, AHugeKeyAndAHugeValueAreQuotedInShort) {
  trial::Bench bench;
  bench.experiment[std::string(10'000'000, 'k')] = 1;
  EXPECT_THAT(refusal_of(bench), HasSubstr("has 10000000 bytes, and at most 1000 are allowed"));
  bench.experiment.erase(std::string(10'000'000, 'k'));
  bench.experiment["objective"]["type"] = std::string(10'000'000, 'v');
  EXPECT_THAT(refusal_of(bench), HasSubstr("unknown objective 'vvvv"));
}

TEST(HostileInput, TextOfFilesActsOnNoTerminal) {
  trial::Bench bench;
  bench.experiment["models"]["neo\u202e"] = {{"type", "neo_hooke"}};
  const std::string error = refusal_of(bench);
  EXPECT_THAT(error, HasSubstr("'neo\\u202e'"));
  expect_harmless(error);
  bench.experiment["models"].erase("neo\u202e");
  bench.folder.write("circ.csv", "stretch [1],str\xFF\033[2J\u009b\u202e\n1.1,1\n");
  const std::string columns = refusal_of(bench);
  EXPECT_THAT(columns, HasSubstr("str\\xff\\x1b[2J\\u009b\\u202e"));
  expect_harmless(columns);
}

TEST(HostileInput, JsonIsValidAndHarmlessWhateverTheNames) {
  trial::Bench bench;
  bench.experiment["name"] = "a\u202eb\u009b\033c";
  bench.folder.write("axial.csv", "\xFF\033\u202e,stretch [1],stress [kPa]\nx,1.1,10\nx,1.2,21\nx,1.3,33\n");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"check", "experiment.json", "--json"}, {"run", "experiment.json", "-o", "out"}}) {
    const auto ended = bench.tunica(words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    expect_harmless(ended.out);
    expect_harmless(ended.err);
    if (words.front() == "check") {
      EXPECT_FALSE(nlohmann::json::parse(ended.out, nullptr, false).is_discarded());
    }
  }
  EXPECT_EQ(bench.result("out")["name"], "a\u202eb\u009b\033c") << "files hold the name as it is";
}

TEST(HostileInput, TheLogAndTheReportActOnNobody) {
  trial::Bench bench;
  bench.experiment["name"] = "a\u202eb\u009b\033c\n2026-01-01 00:00:00.000 info: forged";
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "o\033[31mut"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  expect_harmless(ended.err);
  for (const char* file : {"run.log", "report.html"}) expect_harmless(bench.text(std::string("o\033[31mut/") + file));
  EXPECT_THAT(bench.text("o\033[31mut/run.log"), Not(HasSubstr("\n2026-01-01")));
}

TEST(HostileInput, SpecialFilesNeverMakeItWait) {
  trial::Bench bench;
  ASSERT_EQ(::mkfifo(bench.path("pipe").c_str(), 0600), 0);
  for (const char* file : {"pipe", "/dev/zero"}) {
    bench.experiment["tests"]["circ"]["data"]["file"] = file;
    EXPECT_THAT(refusal_of(bench), HasSubstr("is no regular file"));
  }
  bench.experiment["tests"]["circ"]["data"]["file"] = "/proc/kmsg";
  EXPECT_THAT(refusal_of(bench), AnyOf(HasSubstr("/proc/kmsg: this is not a regular file"),
                                       HasSubstr("/proc/kmsg: the file cannot be read")));  // where only root may
  for (const char* verb : {"run", "check", "discover"}) {
    const auto ended = trial::tunica({verb, "pipe"}, bench.folder.path());
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, HasSubstr("pipe: this is not a regular file"));
  }
  bench.experiment["tests"]["circ"]["data"]["file"] = "circ.csv";
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out"}).code, 0);
  std::filesystem::remove(bench.path("out/evaluations.csv"));
  ASSERT_EQ(::mkfifo(bench.path("out/evaluations.csv").c_str(), 0600), 0);
  const auto resumed = bench.tunica({"run", "experiment.json", "-o", "out", "--resume"});
  EXPECT_EQ(resumed.code, 2);
  EXPECT_THAT(resumed.err, HasSubstr("evaluations.csv: this is not a regular file"));
}

TEST(HostileInput, AFolderWhoseNameIsNotUtf8) {
  const trial::Bench bench;
  const auto folder = bench.path("d\xFF");
  std::filesystem::create_directory(folder);
  bench.save();
  for (const char* file : {"experiment.json", "circ.csv", "axial.csv"})
    std::filesystem::copy(bench.path(file), folder / file);
  for (const char* verb : {"run", "check"}) {
    const auto ended = trial::tunica({verb, "experiment.json"}, folder);
    EXPECT_EQ(ended.code, 2);
    EXPECT_THAT(ended.err, AllOf(HasSubstr("the name of the file, or of a folder above it, is not UTF-8"),
                                 Not(HasSubstr("fault of tunica"))));
    expect_harmless(ended.err);
  }
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "d\xFF/out"});
  EXPECT_EQ(ended.code, 0) << "results go anywhere";
  expect_harmless(ended.out);
}

TEST(HostileInput, DataThatFixNothing) {
  trial::Bench bench;
  bench.experiment["tests"]["circ"]["weight"] = bench.experiment["tests"]["axial"]["weight"] = 0;
  EXPECT_THAT(refusal_of(bench), HasSubstr("every row that could be fitted has the weight 0"));
  bench.experiment["tests"]["circ"].erase("weight");
  bench.experiment["tests"]["circ"]["data"]["noise"] = {{"relative", 1e308}};
  EXPECT_THAT(refusal_of(bench), HasSubstr("the stated noise gives σ = ∞"));
  bench.experiment["tests"]["circ"]["data"]["noise"] = {{"absolute", 1e-14}};
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_LT(ended.out.find("NOT A FIT: 'stress' of test"), 200u) << "before everything else";
}

TEST(HostileInput, ExactlyLinearDataAreToldAndTheCertificateIsHonest) {
  trial::Bench bench;
  double product = 0, square = 0;
  for (const auto& [name, slope] : {std::pair{"circ", 60.0}, std::pair{"axial", 44.0}}) {
    std::string text = "stretch [1],stress [kPa]\n";
    for (int i = 1; i <= 20; ++i) {
      const double stretch = 1 + 0.02 * i, stress = slope * 0.02 * i, shape = stretch * stretch - 1 / stretch;
      text += fmt::format("{},{}\n", stretch, stress);
      product += shape * stress;
      square += shape * shape;
    }
    bench.folder.write(fmt::format("{}.csv", name), text);
    bench.experiment["tests"][name]["data"]["noise"] = {{"absolute", 1e-14}};
  }
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_LT(ended.out.find("NOT A FIT: 'stress' of test 'circ'"), 200u) << "before everything else";
  EXPECT_THAT(ended.out, HasSubstr("rows lie on a"));
  const auto result = bench.result("out");
  int told = 0;
  for (const auto& warning : result["warning_details"]) told += warning["kind"] == "misfit_out_of_scale";
  EXPECT_EQ(told, 2) << "each run";
  for (const auto& run : result["runs"]) {
    const auto& best = run["best"];
    const auto& certificate = best["certificate"];
    const double objective = best["objective"], lowest = certificate["neighbours"]["lowest"]["objective"];
    EXPECT_GT(objective, 1e27) << "residuals of a kPa, in units of 1e-14 kPa";
    EXPECT_EQ(certificate["verdict_code"] == "confirmed", !certificate["neighbours"]["better"]);
    EXPECT_EQ(certificate["neighbours"]["better"].get<bool>(), lowest < objective);
  }
  // The objective of neo-Hooke is a parabola in mu: its least squares are known.
  const auto& neo = result["runs"][0]["best"];
  EXPECT_NEAR(neo["parameters"]["mu"]["value"], product / square, 1e-7 * product / square);
  EXPECT_EQ(neo["certificate"]["verdict_code"], "confirmed");
  // 600 evaluations of an evolution strategy do not end at an optimum of five parameters.
  EXPECT_EQ(result["runs"][1]["best"]["certificate"]["verdict_code"], "not_an_optimum");
}

TEST(HostileInput, ExactlyLinearDataWithoutANoiseAreFittedToOnePercent) {
  trial::Bench bench;
  std::string text = "stretch [1],stress [kPa]\n";
  for (int i = 1; i <= 20; ++i) text += fmt::format("{},{}\n", 1 + 0.02 * i, 1.2 * i);
  bench.folder.write("circ.csv", text);
  bench.folder.write("axial.csv", text);
  const auto ended = bench.tunica({"run", "experiment.json", "-o", "out", "--no-certificate"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("rows lie on a"));
  EXPECT_THAT(ended.out, HasSubstr("0.24 kPa assumed, 1 % of the largest value"));
  const auto result = bench.result("out");
  for (const auto& run : result["runs"]) EXPECT_LT(run["best"]["objective"], 1e6);
}

TEST(HostileInput, ATruncatedPluginInAFolderIsOneWarning) {
  const trial::Bench bench;
  const auto folder = bench.path("plugins");
  std::filesystem::create_directory(folder);
  std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
  const auto plugin = folder / "good.so";
  std::filesystem::copy(TUNICA_BAD_PLUGIN_DIR "/good.so", plugin);
  std::filesystem::permissions(plugin, std::filesystem::perms::owner_all);
  std::filesystem::resize_file(plugin, std::filesystem::file_size(plugin) / 2);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"list", "models"}, {"check", "experiment.json"}}) {
    auto all = words;
    all.insert(all.begin(), {"--plugin-path", "plugins"});
    const auto ended = bench.tunica(all);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("good.so was refused: the file is cut short"));
  }
}

TEST(HostileInput, NumbersOfTheCommandLineAreFinite) {
  const trial::Bench bench;
  const std::vector<std::vector<std::string>> commands = {
      {"diagnose", "experiment.json", "-o", "out", "--alpha"},
      {"discover", "experiment.json", "-o", "out", "--alpha"},
      {"simulate", "experiment.json", "--model", "neo", "-o", "out", "--noise"},
      {"export", "out", "--to", "febio", "--bulk-ratio"},
      {"stability", "experiment.json", "--model", "neo", "--to"},
      {"check", "experiment.json", "--call-limit"},
      {"check", "experiment.json", "--memory-limit"}};
  for (const auto& words : commands)
    for (const char* value : {"nan", "-nan", "inf", "-inf", "1e308", "1e999"}) {
      auto with = words;
      with.back() += std::string("=") + value;
      const auto ended = bench.tunica(with);
      EXPECT_EQ(ended.code, 2) << with.front() << " " << with.back();
      EXPECT_THAT(ended.err, ContainsRegex("not\\s+in\\s+range")) << with.front() << " " << with.back();
      EXPECT_FALSE(std::filesystem::exists(bench.path("out")));
    }
}

TEST(HostileInput, SavedJsonNestedWithoutEndIsRefused) {
  const trial::Bench bench;
  ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out", "--quiet"}).code, 0);
  const std::string deep = std::string(80'000, '[') + std::string(80'000, ']');
  for (const char* name : {"result.json", "checkpoint.json", "input.json"})
    bench.folder.write(std::string("out/") + name, R"({"format": 1, "a": )" + deep + "}");
  const std::vector<std::vector<std::string>> commands = {
      {"report", "out"},
      {"export", "out", "--to", "febio"},
      {"certify", "out"},
      {"run", "experiment.json", "-o", "out", "--resume"},
      {"simulate", "experiment.json", "--model", "neo", "--parameters", "out/result.json", "-o", "other"}};
  for (const auto& words : commands) {
    const auto ended = bench.tunica(words);
    EXPECT_EQ(ended.code, 2) << words.front() << ended.err;
  }
}

TEST(HostileInput, AFolderOfTheRunThatIsALinkIsNotFollowed) {
  const trial::Bench bench;
  for (const char* own : {"parts", "shards"}) {
    std::filesystem::remove_all(bench.path("out"));
    ASSERT_EQ(bench.tunica({"run", "experiment.json", "-o", "out", "--quiet"}).code, 0);
    std::filesystem::create_directory(bench.path(std::string("other_") + own));
    const std::string kept = std::string("other_") + own + "/2.csv";
    bench.folder.write(kept, "kept");
    std::filesystem::create_directory_symlink(bench.path(std::string("other_") + own), bench.path("out") / own);
    const auto ended = bench.tunica({"run", "experiment.json", "-o", "out", "--resume"});
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("is a symbolic link"));
    EXPECT_EQ(bench.text(kept), "kept");
  }
}
