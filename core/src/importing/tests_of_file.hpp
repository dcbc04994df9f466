// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "importing/proposal.hpp"

namespace tunica::importing {

/// What one file is proposed to be.
struct TestsOfFile {
  Specimen specimen;                                ///< of all its tests
  std::vector<std::pair<std::string, Json>> tests;  ///< name and entry of each
};

/// Reads a file, guesses its columns, and proposes a test for each part of it. What was understood is added to `notes`.
/// Relative names in the entries begin at `folder`. Throws InputError on a file that is no table, and on columns that
/// make no test.
TestsOfFile tests_of_file(const std::filesystem::path& file, const Answers& answers,
                          const std::filesystem::path& folder, const plugins::Catalogue& catalogue, const Ask& ask,
                          std::vector<std::string>& notes);

}  // namespace tunica::importing
