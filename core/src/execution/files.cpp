// SPDX-License-Identifier: Apache-2.0
#include "execution/files.hpp"

#include <cerrno>
#include <cstring>
#include <random>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "data/read_bytes.hpp"

namespace tunica::execution {

namespace {

constexpr std::size_t largest_text = std::size_t{4} << 30;  // checkpoints of long runs are large

std::string describe_failure(const std::filesystem::path& file, int error) {
  const bool space = error == ENOSPC || error == EDQUOT || error == EFBIG;
  return fmt::format(
      "{}: cannot write: {}. {}", file.string(), std::strerror(error),
      space ? "Free some space, or raise the limit" : "Check that the folder exists and can be written to");
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

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);  // some file systems cannot; the rename itself is atomic all the same
  ::close(descriptor);
}

/// A new file beside `file`. Its name is drawn, so that writers of the same file on several machines, whose process
/// numbers may be equal, never share it.
std::pair<std::filesystem::path, int> open_temporary(const std::filesystem::path& file) {
  std::random_device device;
  for (;;) {
    std::filesystem::path temporary = file;
    temporary += fmt::format(".new-{:08x}{:08x}", device(), device());
    const int descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return {temporary, descriptor};
    if (errno != EEXIST) throw WriteFailure(file, errno);
  }
}

}  // namespace

WriteFailure::WriteFailure(const std::filesystem::path& file, int error)
    : std::runtime_error(describe_failure(file, error)) {}

AppendFile::AppendFile(std::filesystem::path file) : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw WriteFailure(file_, errno);
}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

AppendFile& AppendFile::operator=(AppendFile&& other) noexcept {
  if (this != &other) {
    close();
    file_ = std::move(other.file_);
    descriptor_ = std::exchange(other.descriptor_, -1);
  }
  return *this;
}

AppendFile::~AppendFile() { close(); }

void AppendFile::append(std::string_view text) { write_all(descriptor_, text, file_); }

void AppendFile::sync() {
  if (is_open() && ::fdatasync(descriptor_) != 0 && errno != EINVAL) throw WriteFailure(file_, errno);
}

void AppendFile::close() {
  if (is_open()) ::close(std::exchange(descriptor_, -1));
}

void write_atomically(const std::filesystem::path& file, std::string_view text) {
  const auto [temporary, descriptor] = open_temporary(file);
  try {
    write_all(descriptor, text, file);
    if (::fsync(descriptor) != 0 && errno != EINVAL) throw WriteFailure(file, errno);
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
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw WriteFailure(folder, error.value());
}

std::string read_text(const std::filesystem::path& file) { return data::read_bytes(file, largest_text); }

}  // namespace tunica::execution
