// SPDX-License-Identifier: Apache-2.0
// The codes of result.json are those that its schema lists.
#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "assembly/channel_noise.hpp"
#include "comparison/certificate.hpp"
#include "comparison/hold_out.hpp"
#include "execution/warning.hpp"
#include "search/stop_reason.hpp"

using namespace tunica;
using ::testing::ElementsAreArray;

namespace {

std::vector<std::string> listed(const char* definition) {
  std::ifstream file(TUNICA_SOURCE_DIR "/schemas/tunica-result.schema.json");
  const nlohmann::json schema = nlohmann::json::parse(file);
  std::vector<std::string> codes;
  for (const auto& one : schema.at("definitions").at(definition).at("oneOf"))
    if (one.at("const").is_string()) codes.push_back(one.at("const"));
  return codes;
}

template <class Table>
std::vector<std::string> codes_of(const Table& table) {
  std::vector<std::string> codes;
  for (const auto& entry : table) codes.emplace_back(entry.code);
  return codes;
}

}  // namespace

TEST(Codes, AreThoseOfTheSchema) {
  EXPECT_THAT(codes_of(execution::warning_codes), ElementsAreArray(listed("warning_kind")));
  EXPECT_THAT(codes_of(comparison::certificate_codes), ElementsAreArray(listed("certificate_verdict")));
  EXPECT_THAT(codes_of(comparison::hold_out_codes), ElementsAreArray(listed("hold_out_verdict")));
  EXPECT_THAT(codes_of(assembly::noise_origin_codes), ElementsAreArray(listed("noise_origin")));
  std::vector<std::string> reasons;
  for (const auto& [reason, code] : search::stop_reason_codes)
    if (reason != search::StopReason::none) reasons.emplace_back(code);
  EXPECT_THAT(reasons, ElementsAreArray(listed("stop_reason")));
}

TEST(Codes, ReadBackAsTheValueThatWroteThem) {
  for (const auto& entry : execution::warning_codes) {
    EXPECT_EQ(execution::code(entry.value), entry.code);
    EXPECT_EQ(text::value_of(execution::warning_codes, entry.code), entry.value);
  }
  EXPECT_FALSE(text::value_of(execution::warning_codes, "of a newer version"));
}
