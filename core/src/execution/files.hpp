// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

/// Writing that detects a full disk, and replacement of files that never leaves a partial one.
namespace tunica::execution {

/// The operating system refused a write. The message says which file, why, and what to do.
class WriteFailure : public std::runtime_error {
 public:
  WriteFailure(const std::filesystem::path& file, int error);
  WriteFailure(const std::filesystem::path& file, const std::string& words);
  /// With the whole sentence, for one who adds to that of another failure.
  explicit WriteFailure(const std::string& sentence) : std::runtime_error(sentence) {}
};

/// A file that only grows at its end. Every call either writes everything or throws WriteFailure. It also throws if a
/// plugin has closed the descriptor or redirected it to another file; rows would otherwise be lost silently. Not
/// thread-safe. A symbolic link under its name is refused, because it could direct the rows into any file of the user.
class AppendFile {
 public:
  AppendFile() = default;
  /// Opens the file, and creates it if it is missing.
  explicit AppendFile(std::filesystem::path file);
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;
  ~AppendFile();

  void append(std::string_view text);
  /// Returns after the data, and the name of a new file, are on the disk and survive a loss of power.
  void sync();
  /// Truncates the file to its first `size` bytes.
  void cut(std::uintmax_t size);
  void close();
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  void check_descriptor() const;

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::uint64_t device_ = 0, inode_ = 0;  ///< of the opened file
  bool listed_ = false;                   ///< its folder entry is on the disk
};

/// Replaces a file in one step: temporary file in the same folder, fsync, rename, fsync of the folder. A reader sees
/// either the old text or the new one, even after a crash. Any number of processes may write the same file at once; the
/// last rename wins. A link under the name is replaced, not followed. A killed writer may leave a file <name>.new-<16
/// digits>, which is never read.
void write_atomically(const std::filesystem::path& file, std::string_view text);

/// Makes a folder and its missing parents, which then survive a loss of power. An existing folder is not an error.
std::error_code make_folders(const std::filesystem::path& folder);

/// Returns after the entries of a folder are on the disk; "" is the working folder. Throws WriteFailure.
void sync_folder(const std::filesystem::path& folder);
/// Makes a folder unless it exists; throws WriteFailure.
void make_folder(const std::filesystem::path& folder);

/// The program's own folder within a result folder; it may be missing. Throws InputError if it is a symbolic link,
/// because the program would then write, repair or remove files elsewhere.
std::filesystem::path own_folder(const std::filesystem::path& folder);

/// The whole text of a file; throws InputError.
std::string read_text(const std::filesystem::path& file);

}  // namespace tunica::execution
