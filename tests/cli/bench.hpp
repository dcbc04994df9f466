// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "execution/folder.hpp"

namespace tunica::trial {

/// A folder with a small experiment on two made-up strips (stretch 1.02 … 1.4) and the built plugins.
class Bench {
 public:
  Bench();
  /// The experiment, to be changed before save().
  nlohmann::json experiment;
  void save() const { folder.write("experiment.json", experiment.dump(2)); }
  /// Saves, and runs tunica in the folder.
  Ended tunica(std::vector<std::string> arguments) const {
    save();
    return trial::tunica(std::move(arguments), folder.path());
  }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder.path() / name; }
  [[nodiscard]] std::string text(const std::string& name) const { return text_of(path(name)); }
  [[nodiscard]] nlohmann::json result(const std::string& run) const {
    return nlohmann::json::parse(text(run + "/result.json"));
  }

  Folder folder;
};

/// result.json without what may differ between two equal runs: seconds, date, threads.
nlohmann::json without_times(nlohmann::json result);
/// evaluations.csv without its last columns, the time and the checksum.
std::string without_times(const std::string& evaluations);

}  // namespace tunica::trial
