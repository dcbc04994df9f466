// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::app {

/// Files and folders that were made for results which are not whole yet. Unless keep() is called they are taken away
/// again, folders while they are empty: by the destructor, so that an error leaves nothing behind, and on Ctrl-C
/// (SIGINT) or SIGTERM, which ends the process with `message` on stderr and exit code 130. One object at a time.
class UnfinishedResults {
 public:
  /// The innermost folder first. A missing entry is not an error.
  UnfinishedResults(const std::vector<std::filesystem::path>& made, const std::string& message);
  ~UnfinishedResults();
  UnfinishedResults(const UnfinishedResults&) = delete;
  UnfinishedResults& operator=(const UnfinishedResults&) = delete;
  /// The results are there: they stay, and signals do what they did before.
  void keep();
};

}  // namespace tunica::app
