// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/file/changes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace tunica::diagnosis {

std::string pointer(std::initializer_list<std::string_view> parts) {
  nlohmann::json::json_pointer way;
  for (const std::string_view part : parts) way.push_back(std::string(part));
  return way.to_string();
}

std::string json_text(std::string_view words) { return nlohmann::json(words).dump(); }

void change_data(const experiment::TestEntry& test, std::string_view key, const std::string& value,
                 std::vector<Change>& changes) {
  if (test.data.tables.empty()) changes.push_back({pointer({"tests", test.name, "data", key}), value});
  for (std::size_t k = 0; k < test.data.tables.size(); ++k)
    changes.push_back({pointer({"tests", test.name, "data", std::to_string(k), key}), value});
}

void change_units(const experiment::TestEntry& test, const std::vector<std::string>& columns, const std::string& unit,
                  std::vector<Change>& changes) {
  if (!test.data.tables.empty()) return;
  nlohmann::ordered_json units = nlohmann::ordered_json::object();
  for (const auto& [column, own] : test.data.layout.units) units[column] = own;
  for (const std::string& column : columns) units[column] = unit;
  changes.push_back({pointer({"tests", test.name, "data", "units"}), units.dump()});
}

void add_mechanisms(const experiment::TestEntry& test, const std::vector<std::string>& mechanisms,
                    std::vector<Change>& changes) {
  if (test.mechanisms.empty()) {
    changes.push_back({pointer({"tests", test.name, "mechanisms"}), fmt::format("[{}]", fmt::join(mechanisms, ", "))});
    return;
  }
  for (const std::string& one : mechanisms) changes.push_back({pointer({"tests", test.name, "mechanisms", "-"}), one});
}

}  // namespace tunica::diagnosis
