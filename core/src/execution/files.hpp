// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

/// Writing that notices when the disk is full, and files that are either old or new but never half.
namespace tunica::execution {

/// The operating system did not take what was to be written: the message says which file, why, and what to do.
class WriteFailure : public std::runtime_error {
 public:
  WriteFailure(const std::filesystem::path& file, int error);
};

/// A file that grows at its end. Every call either writes everything or throws WriteFailure. Not thread-safe.
class AppendFile {
 public:
  AppendFile() = default;
  /// Opens, and creates where there is none.
  explicit AppendFile(std::filesystem::path file);
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;
  ~AppendFile();

  void append(std::string_view text);
  /// Returns once the data are on the disk, so that they survive a loss of power.
  void sync();
  void close();
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

/// Replaces a file in one step: temporary file in the same folder, fsync, rename, fsync of the folder. Whoever reads
/// it, now or after a crash, sees the old text or the new one. Any number of processes may write the same file at once;
/// the last rename stays. One that is killed may leave a file <name>.new-<16 digits>, which nobody reads.
void write_atomically(const std::filesystem::path& file, std::string_view text);

/// A folder that may be there already; throws WriteFailure.
void make_folder(const std::filesystem::path& folder);

/// The whole text of a file; throws InputError.
std::string read_text(const std::filesystem::path& file);

}  // namespace tunica::execution
