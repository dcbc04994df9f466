// SPDX-License-Identifier: Apache-2.0
#include "cohort/extended_files.hpp"

#include <filesystem>

#include "data/csv.hpp"
#include "experiment/json_document.hpp"

namespace tunica::cohort {

namespace {

using Json = nlohmann::ordered_json;

/// A file name of the experiment, as written from another folder.
std::string moved(const std::string& name, const std::filesystem::path& from) {
  const std::filesystem::path path(name);
  return path.is_absolute() ? name
                            : (std::filesystem::absolute(from.empty() ? "." : from) / path).lexically_normal().string();
}

/// Measured data stay where they are: every "file", "files" and "numbered_files" of a table.
void move_table(Json& data, const std::filesystem::path& from) {
  if (!data.is_object()) return;
  for (const char* key : {"file", "numbered_files"})
    if (data.contains(key) && data[key].is_string()) data[key] = moved(data[key], from);
  if (data.contains("files") && data["files"].is_array())
    for (Json& file : data["files"])
      if (file.is_string()) file = moved(file, from);
}

void move_data(Json& experiment, const std::filesystem::path& from) {
  for (auto& [name, test] : experiment["tests"].items()) {
    if (!test.contains("data")) continue;
    Json& data = test["data"];
    if (data.is_array())
      for (Json& table : data) move_table(table, from);
    else
      move_table(data, from);
  }
}

bool names_a_file(const std::string& pointer) {
  return pointer.ends_with("/data/file") || pointer.find("/data/files/") != std::string::npos;
}

}  // namespace

Json template_json(const Specification& cohort) {
  const std::string text = experiment::JsonDocument(cohort.experiment, data::read_bytes(cohort.experiment)).text();
  return Json::parse(text, nullptr, true, true);
}

std::string experiment_text(const Specification& cohort, Json experiment) {
  move_data(experiment, cohort.experiment.parent_path());
  experiment.erase("$schema");
  return experiment.dump(2, ' ', false, decltype(experiment)::error_handler_t::replace) + "\n";
}

std::string cohort_text(const Specification& cohort) {
  Json json = Json::parse(cohort.text, nullptr, true, true);
  const auto folder = cohort.experiment.parent_path();
  json["name"] = cohort.name + "_extended";
  json["experiment"] = "extended.json";
  const std::string table = std::filesystem::absolute(cohort.table).lexically_normal().string();
  if (json["specimens"].is_object())
    json["specimens"]["file"] = table;
  else
    json["specimens"] = table;
  for (auto& [pointer, pattern] : json["bind"].items())
    if (names_a_file(pointer)) pattern = moved(pattern, folder);
  json.erase("diagnosis");
  json.erase("$schema");
  return json.dump(2, ' ', false, decltype(json)::error_handler_t::replace) + "\n";
}

}  // namespace tunica::cohort
