// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "cli/bench.hpp"

using namespace tunica;
using ::testing::HasSubstr;

namespace {
const trial::Folder lookup_folder;
}

TEST(List, ShowsWhatThePluginsProvide) {
  const auto ended = trial::tunica({"list"}, lookup_folder.path());
  EXPECT_EQ(ended.code, 0);
  for (const char* name : {"models (", "  gho ", "tests (", "  uniaxial ", "optimizers (", "  es ", "  ceres_lm ",
                           "mechanisms (", "  fibre_dispersion ", "[gho "})
    EXPECT_THAT(ended.out, HasSubstr(name));
  EXPECT_THAT(trial::tunica({"list", "models"}, lookup_folder.path()).out, ::testing::Not(HasSubstr("uniaxial")));
  EXPECT_EQ(trial::tunica({"list", "modles"}, lookup_folder.path()).code, 2);
}

TEST(Describe, ShowsEveryObjectThatListNames) {
  const auto list = trial::tunica({"list"}, lookup_folder.path());
  std::istringstream stream(list.out);
  int described = 0;
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("  ", 0) != 0 || line[2] == ' ') continue;
    const std::string name = line.substr(2, line.find(' ', 2) - 2);
    const auto ended = trial::tunica({"describe", name}, lookup_folder.path());
    EXPECT_EQ(ended.code, 0) << name << ": " << ended.err;
    EXPECT_THAT(ended.out, HasSubstr(name + " ("));
    ++described;
  }
  EXPECT_GT(described, 8);
}

TEST(Describe, ShowsParametersUnitsBoundsAndOptions) {
  const auto gho = trial::tunica({"describe", "gho"}, lookup_folder.path());
  for (const char* text : {"mu ", "kPa", "kappa", "initial", "min", "max", "Reference: "})
    EXPECT_THAT(gho.out, HasSubstr(text));
  const auto strip = trial::tunica({"describe", "uniaxial"}, lookup_folder.path());
  for (const char* text : {"stretch ", "prescribed, required", "direction"}) EXPECT_THAT(strip.out, HasSubstr(text));
  EXPECT_THAT(trial::tunica({"describe", "ceres_lm"}, lookup_folder.path()).out, HasSubstr("sees residuals"));
  EXPECT_THAT(trial::tunica({"describe", "force_offset"}, lookup_folder.path()).out, HasSubstr("looks like"));
}

TEST(Describe, SuggestsTheNameThatWasMeant) {
  const auto ended = trial::tunica({"describe", "unaxial"}, lookup_folder.path());
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("nothing is called 'unaxial'. Did you mean 'uniaxial'?"));
}

TEST(Schema, IsPrintedOrWritten) {
  const auto printed = trial::tunica({"schema"}, lookup_folder.path());
  EXPECT_EQ(printed.code, 0);
  const auto schema = nlohmann::json::parse(printed.out);
  EXPECT_TRUE(schema.contains("$schema"));
  EXPECT_THAT(printed.out, HasSubstr("\"gho\""));
  EXPECT_EQ(trial::tunica({"schema", "-o", "schema.json"}, lookup_folder.path()).out, "");
  EXPECT_EQ(trial::text_of(lookup_folder.path() / "schema.json"), printed.out);
}
