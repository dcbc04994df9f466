// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::HasSubstr;

namespace {
const trial::Folder folder;
const std::vector<std::string> verbs = {"run", "diagnose", "report", "check", "simulate", "list", "describe", "schema"};
}  // namespace

TEST(Help, OfEveryVerbHasAnExample) {
  for (const auto& verb : verbs) {
    const auto ended = trial::tunica({verb, "--help"}, folder.path());
    EXPECT_EQ(ended.code, 0);
    EXPECT_THAT(ended.out, HasSubstr("Examples:\n  tunica " + verb));
    EXPECT_EQ(ended.err, "");
  }
}

TEST(Help, NamesTheVerbsThatExistAndTheExitCodes) {
  const auto ended = trial::tunica({"--help"}, folder.path());
  EXPECT_EQ(ended.code, 0);
  for (const auto& verb : verbs) EXPECT_THAT(ended.out, HasSubstr("\n  " + verb + " "));
  EXPECT_THAT(ended.out, HasSubstr("130 interrupted"));
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

TEST(Help, RefusesUnknownAndMissingArguments) {
  EXPECT_EQ(trial::tunica({"run"}, folder.path()).code, 2);
  const auto ended = trial::tunica({"run", "x.json", "--threds", "2"}, folder.path());
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("--threds"));
  const auto threads = trial::tunica({"run", "x.json", "-j", "0"}, folder.path());
  EXPECT_EQ(threads.code, 2);
  EXPECT_THAT(threads.err, HasSubstr("--threads: Value 0 not in range 1 to 1024"));
  EXPECT_EQ(trial::tunica({}, folder.path()).code, 2);
}
