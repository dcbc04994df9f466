// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tunica::execution {

/// The folder that one run writes to, held against a second process until this object dies.
class RunDirectory {
 public:
  /// A new folder: `requested`, which must not exist or be empty, else results/<name>-<n> with the first free n.
  /// Throws InputError: nothing that is there is ever overwritten.
  static RunDirectory create(const std::optional<std::filesystem::path>& requested, const std::string& name);
  /// The folder of an interrupted run: `requested`, else the newest results/<name>-<n>.
  static RunDirectory reopen(const std::optional<std::filesystem::path>& requested, const std::string& name);

  RunDirectory(RunDirectory&& other) noexcept;
  RunDirectory& operator=(RunDirectory&&) = delete;
  ~RunDirectory();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  explicit RunDirectory(std::filesystem::path path);
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace tunica::execution
