// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/file/changes.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "data/quantities.hpp"

namespace tunica::diagnosis {
namespace {

/// The last constant of a table of "numbered_files" is the number in its name.
bool may_be_numbered(const data::DataRequest& table) {
  if (table.constants.empty()) return false;
  const std::string name = table.files.front().filename().string();
  const char* const end = name.data() + name.size();
  for (const char* from = name.data(); from != end; ++from)
    for (const char* to = from + 1; to <= end; ++to) {
      double number = 0;
      const auto [last, problem] = std::from_chars(from, to, number);
      if (problem == std::errc() && last == to && number == table.constants.back().second) return true;
    }
  return false;
}

bool has_stress(const data::DataRequest& table, const std::vector<Observable>& observables) {
  return std::ranges::any_of(table.columns, [&](const auto& column) {
    const auto quantity = data::quantity_named(column.first, observables);
    return quantity && quantity->observable->kind == Observable::Kind::stress;
  });
}

}  // namespace

std::string pointer(std::initializer_list<std::string_view> parts) {
  nlohmann::json::json_pointer way;
  for (const std::string_view part : parts) way.push_back(std::string(part));
  return way.to_string();
}

std::string json_text(std::string_view words) { return nlohmann::json(words).dump(); }

bool change_stress_measure(const experiment::TestEntry& test, const std::vector<Observable>& observables,
                           std::string_view measure, std::vector<Change>& changes) {
  const std::vector<data::DataRequest>& tables = test.data.tables;
  if (std::ranges::any_of(tables, may_be_numbered)) return false;
  if (tables.empty()) changes.push_back({pointer({"tests", test.name, "data", "stress_measure"}), json_text(measure)});
  for (std::size_t k = 0; k < tables.size(); ++k)
    if (has_stress(tables[k], observables))
      changes.push_back(
          {pointer({"tests", test.name, "data", std::to_string(k), "stress_measure"}), json_text(measure)});
  return true;
}

bool change_units(const experiment::TestEntry& test, const std::vector<std::string>& columns, const std::string& unit,
                  std::vector<Change>& changes) {
  if (!test.data.tables.empty()) return false;
  nlohmann::ordered_json units = nlohmann::ordered_json::object();
  for (const auto& [column, own] : test.data.layout.units) units[column] = own;
  for (const std::string& column : columns) units[column] = unit;
  changes.push_back({pointer({"tests", test.name, "data", "units"}), units.dump()});
  return true;
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
