// SPDX-License-Identifier: Apache-2.0
#include "execution/run_directory.hpp"

#include <array>
#include <atomic>
#include <cctype>
#include <charconv>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/file.h>
#include <unistd.h>

#include "execution/files.hpp"
#include "tunica/error.hpp"

namespace tunica::execution {

namespace {

const std::filesystem::path results = "results";

/// Descriptors that hold a lock, stored plus one; 0 = free. fork() copies descriptors, and a lock lasts as long as one
/// copy is open. A forked process therefore closes its copies, without allocating or waiting.
std::array<std::atomic<int>, 64> held_locks = {};

void replace_held(int from, int to) {
  for (auto& place : held_locks)
    if (int expected = from + 1; place.compare_exchange_strong(expected, to + 1)) return;
}

void close_copies() {
  for (auto& place : held_locks)
    if (const int descriptor = place.exchange(0) - 1; descriptor >= 0) ::close(descriptor);
}

void keep_from_forks(int lock) {
  [[maybe_unused]] static const int registered = ::pthread_atfork(nullptr, nullptr, close_copies);
  replace_held(-1, lock);
}

/// A name as a folder name: characters that are special in a shell become '-', and a long name is cut.
std::string folder_name(const std::string& name) {
  constexpr std::size_t longest = 100;
  std::string folder;
  for (const char character : std::string_view(name).substr(0, longest))
    folder +=
        std::isalnum(static_cast<unsigned char>(character)) || character == '-' || character == '_' ? character : '-';
  return folder.empty() ? "experiment" : folder;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::error_code& error) {
  throw InputError(fmt::format("{}: cannot be created: {}; name a folder that you may write to with -o", path.string(),
                               error.message()));
}

/// The system would end the name there.
void refuse_zero_byte(const std::filesystem::path& path) {
  if (const auto end = path.native().find('\0'); end != std::string::npos)
    throw InputError(
        fmt::format("{}: a NUL character stands in the name of the folder; take it out", path.string().substr(0, end)));
}

/// The numbers n for which results/<folder>-<n> exists; the largest, or 0.
int newest(const std::string& folder) {
  int largest = 0;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(results, error)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(folder + '-', 0) != 0) continue;
    int number = 0;
    const char* end = name.data() + name.size();
    const auto [stop, problem] = std::from_chars(name.data() + folder.size() + 1, end, number);
    if (problem == std::errc{} && stop == end && number > largest) largest = number;
  }
  return largest;
}

}  // namespace

RunDirectory RunDirectory::create(const std::optional<std::filesystem::path>& requested, const std::string& name) {
  if (requested) refuse_zero_byte(*requested);
  std::error_code error;
  if (requested) {
    if (std::filesystem::exists(*requested, error) && !std::filesystem::is_directory(*requested, error))
      throw InputError(fmt::format("{}: is a file; name a folder with -o", requested->string()));
    if (std::filesystem::is_directory(*requested, error) && !std::filesystem::is_empty(*requested, error))
      throw InputError(fmt::format(
          "{}: is not empty, and results are never overwritten; name another folder with -o{}", requested->string(),
          std::filesystem::exists(*requested / "checkpoint.json", error) ? ", or go on with the run in it with --resume"
                                                                         : ""));
    const bool was_there = std::filesystem::exists(*requested, error);
    if (const auto problem = make_folders(*requested)) refuse(*requested, problem);
    RunDirectory directory(*requested);
    directory.is_new_ = !was_there;
    return directory;
  }
  if (const auto problem = make_folders(results)) refuse(results, problem);
  const std::string folder = folder_name(name);
  for (int number = newest(folder) + 1;; ++number) {
    const auto path = results / fmt::format("{}-{}", folder, number);
    const bool made = std::filesystem::create_directory(path, error);
    if (error) refuse(path, error);
    if (!made) continue;
    sync_folder(results);
    RunDirectory directory(path);
    directory.is_new_ = true;
    return directory;
  }
}

RunDirectory RunDirectory::reopen(const std::optional<std::filesystem::path>& requested, const std::string& name) {
  if (requested) refuse_zero_byte(*requested);
  if (requested && !std::filesystem::is_directory(*requested))
    throw InputError(fmt::format("{}: no such folder; --resume goes on with the run in it", requested->string()));
  if (requested) return RunDirectory(*requested);
  const std::string folder = folder_name(name);
  const int number = newest(folder);
  if (number == 0)
    throw InputError(
        fmt::format("{}/{}-<n>: there is no run to resume here; name its folder with -o", results.string(), folder));
  return RunDirectory(results / fmt::format("{}-{}", folder, number));
}

RunDirectory::RunDirectory(std::filesystem::path path) : path_(std::move(path)) {
  if (::access(path_.c_str(), W_OK | X_OK) != 0)
    throw InputError(
        fmt::format("{}: cannot be written to: {}; name another folder with -o", path_.string(), std::strerror(errno)));
  lock_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0)
    throw InputError(fmt::format("{}: cannot be opened: {}; check its permissions, or name another folder with -o",
                                 path_.string(), std::strerror(errno)));
  // The lock ends with the process, so a killed run leaves none behind. A process forked by a plugin does not hold it.
  keep_from_forks(lock_);
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    replace_held(lock_, -1);
    ::close(std::exchange(lock_, -1));
    throw InputError(fmt::format("{}: another tunica is running in it; wait for it, or name another folder with -o",
                                 path_.string()));
  }
}

RunDirectory::RunDirectory(RunDirectory&& other) noexcept
    : path_(std::move(other.path_)), lock_(std::exchange(other.lock_, -1)), is_new_(other.is_new_) {}

RunDirectory::~RunDirectory() {
  if (lock_ < 0) return;
  replace_held(lock_, -1);
  ::close(lock_);
}

NewResults::~NewResults() {
  if (complete_) return;
  std::error_code left;
  for (const auto& entry : std::filesystem::directory_iterator(directory_.path(), left))
    std::filesystem::remove_all(entry.path(), left);
  if (directory_.is_new()) std::filesystem::remove(directory_.path(), left);
}

}  // namespace tunica::execution
