// SPDX-License-Identifier: Apache-2.0
#include "cohort/results_folder.hpp"

#include <optional>
#include <string_view>

#include "execution/files.hpp"
#include "execution/run_directory.hpp"

namespace tunica::cohort {

namespace {

constexpr std::string_view mark = "cohort.json";  ///< the first file of every start

/// Nothing is in it but the first file of a start that runs at this moment, perhaps under its temporary name.
bool nothing_else_in(const std::filesystem::path& folder) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().filename().string().rfind(mark, 0) != 0) return false;
  return !error;
}

}  // namespace

std::filesystem::path results_folder(const std::filesystem::path& requested, const std::string& name) {
  if (requested.empty()) return execution::RunDirectory::create(std::nullopt, name).path();
  const std::error_code error = execution::make_folders(requested);
  // The mark is asked for last: a neighbour writes it before anything else.
  if (!error && (nothing_else_in(requested) || std::filesystem::exists(requested / mark))) return requested;
  return execution::RunDirectory::create(requested, name).path();  // says what is wrong
}

}  // namespace tunica::cohort
