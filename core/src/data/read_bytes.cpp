// SPDX-License-Identifier: Apache-2.0
#include "data/read_bytes.hpp"

#include <algorithm>
#include <cerrno>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include "tunica/error.hpp"

namespace tunica::data {

namespace {

/// Open for reading; nothing that is opened makes the opener wait.
class Opened {
 public:
  explicit Opened(const std::filesystem::path& file)
      : descriptor_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) {}
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;
  ~Opened() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// Files that the kernel makes up while they are read: their size says nothing, and some never end.
bool made_up(int descriptor) {
  struct statfs system {};
  if (::fstatfs(descriptor, &system) != 0) return false;
  const auto type = static_cast<unsigned long>(system.f_type);
  return type == PROC_SUPER_MAGIC || type == SYSFS_MAGIC || type == DEBUGFS_MAGIC || type == TRACEFS_MAGIC;
}

}  // namespace

std::string read_bytes(const std::filesystem::path& file, std::size_t most) {
  const auto refuse = [&](std::string_view what) { throw InputError(fmt::format("{}: {}", file.string(), what)); };
  if (file.native().find('\0') != std::string::npos)
    throw InputError(fmt::format("{}: a NUL character stands in the name of the file. Take it out.",
                                 file.string().substr(0, file.native().find('\0'))));
  // Asked before it is opened: to open a device may already do something.
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0 && (errno == ENOENT || errno == ENOTDIR))
    refuse("there is no such file. Check its name; paths in an experiment file are relative to it.");
  if (S_ISDIR(status.st_mode)) refuse("this is a folder. Name a file in it.");
  constexpr const char* special = "this is not a regular file. Name a text file.";
  if (status.st_mode != 0 && !S_ISREG(status.st_mode)) refuse(special);
  const Opened opened(file);
  constexpr const char* unreadable = "the file cannot be read. Check its permissions.";
  if (opened.descriptor() < 0 || ::fstat(opened.descriptor(), &status) != 0) refuse(unreadable);
  if (!S_ISREG(status.st_mode) || made_up(opened.descriptor())) refuse(special);
  const auto size = static_cast<std::size_t>(std::max<off_t>(status.st_size, 0));
  const auto check_size = [&](std::size_t bytes) {
    if (bytes > most)
      refuse(fmt::format("the file has {} MiB; expected at most {}. Take out what is not needed, or split it.",
                         (bytes >> 20) + 1, most >> 20));
  };
  check_size(size);
  std::string bytes;
  for (std::size_t have = 0;;) {
    bytes.resize(std::max(have + 65536, std::min(size + 1, most + 1)));
    const ssize_t count = ::read(opened.descriptor(), bytes.data() + have, bytes.size() - have);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse(unreadable);
    have += static_cast<std::size_t>(count);
    check_size(have);  // it may grow while it is read
    if (count > 0) continue;
    bytes.resize(have);
    return bytes;
  }
}

}  // namespace tunica::data
