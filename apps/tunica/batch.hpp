// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace tunica::app {

/// The option --batch: a folder of folders with an experiment.json each.
struct Batch {
  std::filesystem::path root;
  std::string into;   ///< folder for the results; empty = beside the experiments
  std::string share;  ///< "2/7": only part of the folders; empty = all
  std::string many;   ///< what is made, "diagnoses"
  bool quiet = false;
};

/// Calls `make(case, results)` for every folder that has no result.json yet, several at a time; `results` may not be
/// there yet. One that fails is reported and leaves the others alone. The exit code; throws InputError where there is
/// no such folder.
int run_batch(
    const Batch& batch,
    const std::function<void(const std::filesystem::path& of_case, const std::filesystem::path& results)>& make);

}  // namespace tunica::app
