// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

/// Writing that notices when the disk is full, and files that are either old or new but never half.
namespace tunica::execution {

/// The operating system did not take what was to be written: the message says which file, why, and what to do.
class WriteFailure : public std::runtime_error {
 public:
  WriteFailure(const std::filesystem::path& file, int error);
  WriteFailure(const std::filesystem::path& file, const std::string& words);
};

/// A file that grows at its end. Every call either writes everything or throws WriteFailure: also where a plugin has
/// closed its descriptor, or made it that of another file, whose rows would be lost without a word. Not thread-safe. A
/// symbolic link under its name is refused: it could lead the rows into any file of the user.
class AppendFile {
 public:
  AppendFile() = default;
  /// Opens, and creates where there is none.
  explicit AppendFile(std::filesystem::path file);
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;
  ~AppendFile();

  void append(std::string_view text);
  /// Returns once the data, and the name of a new file, are on the disk, so that they survive a loss of power.
  void sync();
  /// Leaves the first `size` bytes.
  void cut(std::uintmax_t size);
  void close();
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  void check_descriptor() const;

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t device_ = 0, inode_ = 0;  ///< of what was opened
  bool listed_ = false;                   ///< its folder has the name for good
};

/// Replaces a file in one step: temporary file in the same folder, fsync, rename, fsync of the folder. Whoever reads
/// it, now or after a crash, sees the old text or the new one. Any number of processes may write the same file at once;
/// the last rename stays. A link under the name is replaced, not followed. A writer that is killed may leave a file
/// <name>.new-<16 digits>, which nobody reads.
void write_atomically(const std::filesystem::path& file, std::string_view text);

/// Makes a folder and those above it that are missing, so that they survive a loss of power. One that is there is no
/// error.
std::error_code make_folders(const std::filesystem::path& folder);

/// Returns once the names in a folder are on the disk; "" is the working folder. Throws WriteFailure.
void sync_folder(const std::filesystem::path& folder);
/// A folder that may be there already; throws WriteFailure.
void make_folder(const std::filesystem::path& folder);

/// A folder of the program's own within one of results, which may be missing. Throws InputError where a symbolic link
/// stands in its place: what is written, mended or removed below it would be somewhere else.
std::filesystem::path own_folder(const std::filesystem::path& folder);

/// The whole text of a file; throws InputError.
std::string read_text(const std::filesystem::path& file);

}  // namespace tunica::execution
