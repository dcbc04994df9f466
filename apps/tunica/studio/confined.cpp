// SPDX-License-Identifier: Apache-2.0
#include "studio/confined.hpp"

#include <nlohmann/json.hpp>

#include "studio/project_folder.hpp"
#include "tunica/detail/bounded_json.hpp"

namespace tunica::app::studio {

namespace fs = std::filesystem;

namespace {

/// Every text within a value of JSON.
void collect_texts(const nlohmann::json& value, std::vector<std::string>& found) {
  if (value.is_string()) found.push_back(value);
  if (value.is_structured())
    for (const auto& child : value) collect_texts(child, found);
}

std::vector<std::string> texts_of(const std::string& option) {
  std::vector<std::string> found{option};
  if (option.starts_with('{') || option.starts_with('[') || option.starts_with('"')) {
    const auto value = detail::parse_json(option, false);
    if (!value.is_discarded()) collect_texts(value, found);
  }
  return found;
}

}  // namespace

std::vector<fs::path> files_of(const experiment::TestEntry& test) {
  std::vector<fs::path> files = test.data.files;
  for (const auto& [name, value] : test.options.values()) {
    const auto* const option = std::get_if<std::string>(&value);
    if (option == nullptr || name == "command") continue;
    for (const std::string& text : texts_of(*option)) {
      std::error_code none;  // also of a text that is longer than a name
      if (!text.empty() && fs::exists(test.folder / text, none)) files.push_back(test.folder / text);
    }
  }
  return files;
}

experiment::Experiment read_confined(const Session& session, const fs::path& file) {
  auto experiment = session.read(file, experiment::Purpose::prediction);
  for (const auto& test : experiment.tests)
    for (const fs::path& named : files_of(test)) require_inside(named, file.string());
  return experiment;
}

}  // namespace tunica::app::studio
