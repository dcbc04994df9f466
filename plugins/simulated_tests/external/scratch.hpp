// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace tunica::external {

/// A new folder for one run of the solver, removed at the end unless it is kept.
class Scratch {
 public:
  /// Below `parent`, which is made where it does not exist. Throws std::runtime_error where that fails.
  /// One that is to stay has another name from the beginning.
  explicit Scratch(const std::filesystem::path& parent, bool stays = false);
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  void keep() { kept_ = true; }
  /// Keeps it, under a name that begins with "tunica-failed-".
  void keep_as_failed();
  /// Writes a file below the folder. Throws std::runtime_error where that fails.
  void write(const std::string& name, const std::string& text) const;

  /// Removes the files below `parent` of processes that were killed, for example at their memory limit.
  static void sweep(const std::filesystem::path& parent);

 private:
  std::filesystem::path folder_;
  int lock_ = -1;  ///< goes with the process, and tells that the folder is in use
  bool kept_ = false;
};

}  // namespace tunica::external
