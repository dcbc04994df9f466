// SPDX-License-Identifier: Apache-2.0
#include "fresh_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "execution/interrupt.hpp"

namespace tunica::app {

namespace {

/// A pipe that a child writes into.
class Pipe {
 public:
  Pipe() { static_cast<void>(::pipe2(ends_.data(), O_CLOEXEC)); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close(0);
    close(1);
  }
  /// Negative where there was no pipe, and after its end.
  [[nodiscard]] int reading() const { return ends_[0]; }
  [[nodiscard]] int writing() const { return ends_[1]; }
  void close_writing() { close(1); }
  /// Appends what is there; closes at its end.
  void read(std::string& text) {
    std::array<char, 4096> buffer;
    const ssize_t count = ::read(reading(), buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    if (count == 0 || (count < 0 && errno != EINTR)) close(0);
  }

 private:
  void close(std::size_t end) {
    if (ends_[end] >= 0) ::close(ends_[end]);
    ends_[end] = -1;
  }
  std::array<int, 2> ends_{-1, -1};
};

std::string last_line(std::string_view text) {
  const auto end = text.find_last_not_of("\r\n \t");
  if (end == std::string_view::npos) return {};
  text = text.substr(0, end + 1);
  return std::string(text.substr(text.rfind('\n') + 1));
}

/// Starts a program under a name and waits for it. One with a limit gets a process group of its own, and its standard
/// error is read; that of another one is ours.
Answer ask(const std::string& executable, const std::string& name, const std::vector<std::string>& arguments,
           std::optional<std::chrono::seconds> limit) {
  std::vector<std::string> words{name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  Pipe out, err;
  if (out.reading() < 0 || err.reading() < 0) return {{}, fmt::format("no pipe: {}", std::strerror(errno)), {}};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, out.writing(), STDOUT_FILENO);
  if (limit) ::posix_spawn_file_actions_adddup2(&actions, err.writing(), STDERR_FILENO);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  if (limit) ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t child = -1;
  const int error = ::posix_spawnp(&child, executable.c_str(), &actions, &attributes, argv.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&actions);
  out.close_writing();
  err.close_writing();
  Answer answer;
  if (error != 0) {
    answer.problem = fmt::format("it could not be started: {}", std::strerror(error));
    return answer;
  }
  // Until the end of the process: another one that a plugin has begun may hold a pipe for ever.
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  int status = 0;
  bool ended = false;
  std::string errors;
  for (;;) {
    const bool open = out.reading() >= 0 || err.reading() >= 0;
    std::array<pollfd, 2> wanted{{{out.reading(), POLLIN, 0}, {err.reading(), POLLIN, 0}}};  // negative: passed over
    const bool came = ::poll(wanted.data(), wanted.size(), ended ? 0 : open ? 100 : 10) > 0;
    if (ended && !came) break;
    if (came && wanted[0].revents != 0) out.read(answer.out);
    if (came && wanted[1].revents != 0) err.read(errors);
    if (!ended) ended = ::waitpid(child, &status, WNOHANG) == child;
    if (ended || !limit) continue;
    const bool late = Clock::now() - begun > *limit;
    if (!late && !execution::InterruptWatch::interrupted()) continue;
    ::kill(-child, SIGKILL);
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    answer.problem = late ? fmt::format("it was ended after {} s", limit->count()) : "it was interrupted";
    break;
  }
  answer.said = last_line(errors);
  if (!answer.problem.empty()) return answer;
  if (WIFSIGNALED(status)) answer.problem = fmt::format("it was ended by signal {}", WTERMSIG(status));
  if (WIFEXITED(status) && WEXITSTATUS(status) > 1)  // 1: it answered, with bad news
    answer.problem = fmt::format("it ended with code {}", WEXITSTATUS(status));
  return answer;
}

}  // namespace

Answer ask_fresh_process(const std::vector<std::string>& arguments) {
  // The kernel's link to our own image: right even when the file was moved or replaced meanwhile.
  return ask("/proc/self/exe", "tunica", arguments, std::nullopt);
}

Answer ask_program(const std::string& program, const std::vector<std::string>& arguments, std::chrono::seconds limit) {
  return ask(program, program, arguments, limit);
}

}  // namespace tunica::app
