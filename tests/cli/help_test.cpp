// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::HasSubstr;

namespace {
const trial::Folder folder;

/// Read from the help itself, so new verbs are tested too.
std::vector<std::string> verbs() {
  const auto help = trial::tunica({"--help"}, folder.path()).out;
  std::vector<std::string> found;
  std::istringstream stream(help.substr(help.find("Subcommands:")));
  for (std::string line; std::getline(stream, line) && !line.empty();)
    if (line.starts_with("  ") && line[2] != ' ') found.push_back(line.substr(2, line.find(' ', 2) - 2));
  return found;
}
/// Characters, not bytes.
std::ptrdiff_t columns(const std::string& line) {
  return std::count_if(line.begin(), line.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; });
}

}  // namespace

TEST(Help, OfEveryVerbHasAnExample) {
  for (const auto& verb : verbs()) {
    const auto ended = trial::tunica({verb, "--help"}, folder.path());
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.out, HasSubstr("Examples:\n  tunica " + verb));
    EXPECT_EQ(ended.err, "");
  }
}

TEST(Help, FitsInto80Columns) {
  auto calls = verbs();
  calls.emplace_back("");
  for (const auto& verb : calls) {
    std::istringstream stream(trial::tunica({verb.empty() ? "--help" : verb, "--help"}, folder.path()).out);
    for (std::string line; std::getline(stream, line);) EXPECT_LE(columns(line), 80) << verb << ": " << line;
  }
}

TEST(Help, KnowsTheVerbsOfTheContract) {
  EXPECT_THAT(verbs(),
              ::testing::IsSupersetOf({"run", "diagnose", "report", "certify", "check", "simulate", "stability", "data",
                                       "list", "describe", "schema", "completion", "man"}));
}

TEST(Help, NamesTheVerbsThatExistAndTheExitCodes) {
  const auto ended = trial::tunica({"--help"}, folder.path());
  EXPECT_EQ(ended.code, 0);
  for (const auto& verb : verbs()) EXPECT_THAT(ended.out, HasSubstr("\n  " + verb + " "));
  EXPECT_THAT(ended.out, HasSubstr("interrupted and resumable"));
  EXPECT_THAT(ended.out, HasSubstr("--plugin-path"));
}

TEST(Help, SaysTheVersion) {
  const auto ended = trial::tunica({"--version"}, folder.path());
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.out, ::testing::MatchesRegex("tunica [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Help, SuggestsTheVerbThatWasMeant) {
  const auto ended = trial::tunica({"simulat", "x.json"}, folder.path());
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.out, "");
  EXPECT_THAT(ended.err, HasSubstr("there is no verb 'simulat'. Did you mean 'simulate'?"));
}

TEST(Help, RefusesUnknownAndMissingArgumentsAndSaysWhereToReadOn) {
  const auto refusal = [](const std::vector<std::string>& arguments) {
    const auto ended = trial::tunica(arguments, folder.path());
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.out, "");
    return ended.err;
  };
  EXPECT_EQ(refusal({"run"}),
            "error: experiment is required. `tunica run --help` shows what it takes, with\n       examples.\n");
  EXPECT_EQ(refusal({"run", "x.json", "--threds", "2"}),
            "error: --threds: there is no such option. Did you mean '--threads'? `tunica run\n"
            "       --help` shows what it takes, with examples.\n");
  EXPECT_THAT(refusal({"check", "x.json", "--plugn-path=a"}), HasSubstr("Did you mean '--plugin-path'?"));
  EXPECT_THAT(refusal({"check", "x.json", "y.json"}), HasSubstr("error: 'y.json' is one argument too many."));
  EXPECT_THAT(refusal({"run", "x.json", "-j", "0"}), HasSubstr("--threads: Value 0 not in range 1 to 1024."));
  for (const std::string seed : {"-1", "18446744073709551616", "1.5", "7a"})
    EXPECT_THAT(refusal({"run", "x.json", "--seed", seed}),
                AllOf(HasSubstr("a seed is a whole number from 0 to"), HasSubstr("'" + seed + "'. ")));
  EXPECT_THAT(refusal({}), HasSubstr("error: a verb is missing: run, "));
  EXPECT_THAT(refusal({"completion", "fish"}), HasSubstr("there is no completion for 'fish'. "));
}
