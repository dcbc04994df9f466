// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::app {

/// Folders that were made for results which do not exist yet. Unless keep() is called they are taken away again while
/// they are empty: by the destructor, so that an error leaves nothing behind, and on Ctrl-C (SIGINT) or SIGTERM, which
/// ends the process with `message` on stderr and exit code 130. One object at a time.
class UnfinishedFolder {
 public:
  /// The innermost folder first.
  UnfinishedFolder(const std::vector<std::filesystem::path>& folders, const std::string& message);
  ~UnfinishedFolder();
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;
  /// The results are there: the folders stay, and signals do what they did before.
  void keep();
};

}  // namespace tunica::app
