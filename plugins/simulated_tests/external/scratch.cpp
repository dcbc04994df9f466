// SPDX-License-Identifier: Apache-2.0
#include "scratch.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tunica::external {

namespace {

constexpr const char* in_use = "tunica-running-";  ///< what every name begins with that is removed at the end

int open_folder(const std::filesystem::path& folder) {
  return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

}  // namespace

void Scratch::sweep(const std::filesystem::path& parent) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(parent, error)) {
    if (entry.path().filename().string().rfind(in_use, 0) != 0) continue;
    const int folder = open_folder(entry.path());
    if (folder < 0) continue;
    struct stat found = {};
    const bool left =
        ::fstat(folder, &found) == 0 && found.st_uid == ::geteuid() && ::flock(folder, LOCK_EX | LOCK_NB) == 0;
    if (left) std::filesystem::remove_all(entry.path(), error);
    ::close(folder);
  }
}

Scratch::Scratch(const std::filesystem::path& parent, bool stays) : kept_(stays) {
  std::error_code error;
  std::filesystem::create_directories(parent, error);
  std::string name = (parent / "tunica-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw std::runtime_error(fmt::format("no scratch folder can be made in {}: {}; name another one in \"scratch\"",
                                         parent.string(), std::strerror(errno)));
  folder_ = name;
  if (stays) return;
  // Under a name that is swept only when it is locked: no other process takes it away in between.
  lock_ = open_folder(folder_);
  if (lock_ < 0 || ::flock(lock_, LOCK_EX | LOCK_NB) != 0) return;
  const auto running = parent / (in_use + name.substr(name.size() - 6));
  std::filesystem::rename(folder_, running, error);
  if (!error) folder_ = running;
}

Scratch::~Scratch() {
  std::error_code error;
  if (!kept_) std::filesystem::remove_all(folder_, error);
  if (lock_ >= 0) ::close(lock_);
}

void Scratch::keep_as_failed() {
  const std::string name = folder_.filename().string();
  const auto failed = folder_.parent_path() / ("tunica-failed" + name.substr(name.rfind('-')));
  std::error_code error;
  std::filesystem::rename(folder_, failed, error);
  if (!error) folder_ = failed;
  keep();
}

void Scratch::write(const std::string& name, const std::string& text) const {
  const std::filesystem::path file = folder_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error(fmt::format("{} cannot be written", file.string()));
}

}  // namespace tunica::external
