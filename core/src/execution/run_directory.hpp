// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tunica::execution {

/// The output folder of one run, locked against other processes while this object lives.
class RunDirectory {
 public:
  /// A new folder: `requested`, which must be missing or empty, else results/<name>-<n> with the first free n. Throws
  /// InputError otherwise: existing files are never overwritten.
  static RunDirectory create(const std::optional<std::filesystem::path>& requested, const std::string& name);
  /// The folder of an interrupted run: `requested`, else the newest results/<name>-<n>.
  static RunDirectory reopen(const std::optional<std::filesystem::path>& requested, const std::string& name);

  RunDirectory(RunDirectory&& other) noexcept;
  RunDirectory& operator=(RunDirectory&&) = delete;
  ~RunDirectory();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Whether this object made the folder.
  [[nodiscard]] bool is_new() const { return is_new_; }

 private:
  explicit RunDirectory(std::filesystem::path path);
  std::filesystem::path path_;
  int lock_ = -1;
  bool is_new_ = false;
};

/// Results that are written into a new folder in one go and never resumed. If they do not become complete, for lack of
/// space or because of an error, nothing of them is left. An incomplete folder would block the same command.
class NewResults {
 public:
  explicit NewResults(const RunDirectory& directory) : directory_(directory) {}
  ~NewResults();
  NewResults(const NewResults&) = delete;
  NewResults& operator=(const NewResults&) = delete;
  void complete() { complete_ = true; }

 private:
  const RunDirectory& directory_;
  bool complete_ = false;
};

}  // namespace tunica::execution
