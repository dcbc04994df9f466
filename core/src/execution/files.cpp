// SPDX-License-Identifier: Apache-2.0
#include "execution/files.hpp"

#include <cerrno>
#include <cstring>
#include <random>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "data/read_bytes.hpp"
#include "tunica/error.hpp"

namespace tunica::execution {

namespace {

constexpr std::size_t largest_text = std::size_t{4} << 30;  // checkpoints of long runs are large

std::string describe_failure(const std::filesystem::path& file, int error) {
  const bool space = error == ENOSPC || error == EDQUOT || error == EFBIG;
  const char* advice = space            ? "Free some space, or raise the limit"
                       : error == ELOOP ? "It is a symbolic link, which is never followed here; remove it"
                       : error == EIO   ? "Check the disk"
                                        : "Check that the folder exists and can be written to";
  return fmt::format("{}: cannot write: {}. {}", file.string(), std::strerror(error), advice);
}

/// Opens every file that the program makes. A symbolic link under its name is not followed.
int open_to_write(const std::filesystem::path& file, int how) {
  return ::open(file.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC | how, 0666);
}

void write_all(int descriptor, std::string_view text, const std::filesystem::path& file) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      throw WriteFailure(file, errno);
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// Some file systems cannot do this; a rename is atomic even so.
bool cannot_sync(int error) { return error == EINVAL || error == ENOTSUP || error == EROFS; }

/// A new file beside `file`. Its name is random: writers of the same file on several machines may have equal process
/// numbers, and must not share a temporary file.
std::pair<std::filesystem::path, int> open_temporary(const std::filesystem::path& file) {
  std::random_device device;
  for (;;) {
    std::filesystem::path temporary = file;
    temporary += fmt::format(".new-{:08x}{:08x}", device(), device());
    const int descriptor = open_to_write(temporary, O_EXCL);
    if (descriptor >= 0) return {temporary, descriptor};
    if (errno != EEXIST) throw WriteFailure(file, errno);
  }
}

}  // namespace

WriteFailure::WriteFailure(const std::filesystem::path& file, int error)
    : std::runtime_error(describe_failure(file, error)) {}

WriteFailure::WriteFailure(const std::filesystem::path& file, const std::string& words)
    : std::runtime_error(fmt::format("{}: cannot write: {}", file.string(), words)) {}

AppendFile::AppendFile(std::filesystem::path file) : file_(std::move(file)) {
  std::error_code unknown;
  listed_ = std::filesystem::exists(file_, unknown);
  descriptor_ = open_to_write(file_, O_APPEND);
  struct stat status {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) throw WriteFailure(file_, errno);
  device_ = status.st_dev;
  inode_ = status.st_ino;
}

void AppendFile::check_descriptor() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0 && status.st_dev == device_ && status.st_ino == inode_) return;
  throw WriteFailure(file_,
                     std::string("something in the process, which a plugin can only be, has closed the file or put "
                                 "another one in its place. Take that plugin out, or report this to its author"));
}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      device_(other.device_),
      inode_(other.inode_),
      listed_(other.listed_) {}

AppendFile& AppendFile::operator=(AppendFile&& other) noexcept {
  if (this != &other) {
    close();
    file_ = std::move(other.file_);
    descriptor_ = std::exchange(other.descriptor_, -1);
    device_ = other.device_;
    inode_ = other.inode_;
    listed_ = other.listed_;
  }
  return *this;
}

AppendFile::~AppendFile() { close(); }

void AppendFile::append(std::string_view text) {
  check_descriptor();
  write_all(descriptor_, text, file_);
}

void AppendFile::sync() {
  if (!is_open()) return;
  check_descriptor();
  if (::fdatasync(descriptor_) != 0 && !cannot_sync(errno)) throw WriteFailure(file_, errno);
  if (!std::exchange(listed_, true)) sync_folder(file_.parent_path());
}

void AppendFile::cut(std::uintmax_t size) {
  check_descriptor();
  int done = 0;
  do done = ::ftruncate(descriptor_, static_cast<off_t>(size));
  while (done != 0 && errno == EINTR);
  if (done != 0) throw WriteFailure(file_, errno);
}

void AppendFile::close() {
  struct stat status {};
  // After a plugin has closed the descriptor, its number may belong to another file.
  const bool own =
      is_open() && ::fstat(descriptor_, &status) == 0 && status.st_dev == device_ && status.st_ino == inode_;
  if (own) ::close(descriptor_);
  descriptor_ = -1;
}

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;  // one that may be written to but not read
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  if (error != 0 && !cannot_sync(error)) throw WriteFailure(folder, error);
}

std::error_code make_folders(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::is_directory(folder, error)) return {};
  if (const auto parent = folder.parent_path(); !parent.empty() && parent != folder)
    if (const auto problem = make_folders(parent)) return problem;
  error.clear();
  std::filesystem::create_directory(folder, error);
  if (error == std::errc::file_exists) return std::make_error_code(std::errc::not_a_directory);
  if (!error) sync_folder(folder.parent_path());
  return error;
}

void write_atomically(const std::filesystem::path& file, std::string_view text) {
  const auto [temporary, descriptor] = open_temporary(file);
  try {
    write_all(descriptor, text, file);
    if (::fsync(descriptor) != 0 && !cannot_sync(errno)) throw WriteFailure(file, errno);
  } catch (...) {
    ::close(descriptor);
    ::unlink(temporary.c_str());
    throw;
  }
  ::close(descriptor);
  if (::rename(temporary.c_str(), file.c_str()) != 0) {
    const int error = errno;
    ::unlink(temporary.c_str());
    throw WriteFailure(file, error);
  }
  sync_folder(file.parent_path());
}

void make_folder(const std::filesystem::path& folder) {
  if (const auto error = make_folders(folder)) throw WriteFailure(folder, error.value());
}

std::filesystem::path own_folder(const std::filesystem::path& folder) {
  std::error_code unknown;
  if (std::filesystem::is_symlink(folder, unknown))
    throw InputError(
        fmt::format("{}: is a symbolic link where a folder of the run is expected, and links are never followed there; "
                    "put the folder that it leads to in its place, or start anew with another -o",
                    folder.string()));
  return folder;
}

std::string read_text(const std::filesystem::path& file) { return data::read_bytes(file, largest_text); }

}  // namespace tunica::execution
