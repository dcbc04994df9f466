// SPDX-License-Identifier: Apache-2.0
// POSIX calls: Boost.Process 1.74 waits for a child with a time limit by blocking SIGCHLD of the calling thread, which
// several waiting threads cannot share. A descriptor of the process (pidfd) belongs to one run alone.
#include "process.hpp"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tunica/error.hpp"

namespace tunica::external {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> found;
  for (std::string& word : words) found.push_back(word.data());
  found.push_back(nullptr);
  return found;
}

std::vector<std::string> environment_of(const Command& command) {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text(*variable);
    bool replaced = false;
    for (const auto& [name, value] : command.environment)
      replaced = replaced || (text.substr(0, name.size()) == name && text.substr(name.size(), 1) == "=");
    if (!replaced) variables.emplace_back(text);
  }
  for (const auto& [name, value] : command.environment) variables.push_back(name + "=" + value);
  return variables;
}

/// In the child, between fork and exec: calls that are safe there, and nothing that allocates.
[[noreturn]] void become(const Command& command, const char* folder, const char* output, char* const* words,
                         char* const* variables, pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (command.mebibytes > 0) {
    const rlim_t bytes = static_cast<rlim_t>(command.mebibytes) << 20U;
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_AS, &limit);
  }
  const int nothing = open("/dev/null", O_RDONLY);
  const int printed = open(output, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (nothing < 0 || printed < 0 || chdir(folder) != 0) _exit(126);
  dup2(nothing, STDIN_FILENO);
  dup2(printed, STDOUT_FILENO);
  dup2(printed, STDERR_FILENO);
  execve(words[0], words, variables);
  _exit(126);
}

/// Waits until the process has ended, at most so long; false at the limit.
bool wait_for_end(int descriptor, Clock::time_point limit) {
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(limit - Clock::now()).count();
    pollfd watched{descriptor, POLLIN, 0};
    const int found = poll(&watched, 1, static_cast<int>(std::clamp<long long>(left, 0, 60000)));
    if (found > 0) return true;
    if (found < 0 && errno != EINTR) return false;
    if (left <= 0) return false;
  }
}

}  // namespace

Ending run(const Command& command) {
  Ending ending;
  std::vector<std::string> words = command.words, variables = environment_of(command);
  const std::vector<char*> word_pointers = pointers(words), variable_pointers = pointers(variables);
  const std::string folder = command.folder.string(), output = command.output.string();
  const Clock::time_point begun = Clock::now();
  const pid_t parent = getpid(), child = fork();
  if (child < 0) {
    ending.words = fmt::format("could not be started: {}", std::strerror(errno));
    return ending;
  }
  if (child == 0)
    become(command, folder.c_str(), output.c_str(), word_pointers.data(), variable_pointers.data(), parent);
  setpgid(child, child);  // both sides do it: whoever comes first
  ending.started = true;
  // By its number: the header of glibc 2.36 declares pidfd_open without extern "C".
  const int descriptor = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
  const auto limit =
      begun + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(command.seconds));
  ending.timed_out = descriptor < 0 || !wait_for_end(descriptor, limit);
  kill(-child, SIGKILL);  // before it is waited for: until then its number is nobody else's
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (descriptor >= 0) close(descriptor);
  ending.seconds = std::chrono::duration<double>(Clock::now() - begun).count();
  if (WIFEXITED(status)) ending.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) ending.signal = WTERMSIG(status);
  if (ending.timed_out)
    ending.words = fmt::format("was ended at its time limit of {:g} s", command.seconds);
  else if (ending.signal != 0)
    ending.words = fmt::format("was ended by signal {} ({}) after {:.1f} s", ending.signal, sigabbrev_np(ending.signal),
                               ending.seconds);
  else
    ending.words = fmt::format("ended with exit code {} after {:.1f} s", ending.code, ending.seconds);
  return ending;
}

fs::path program_file(const std::string& name, const fs::path& folder) {
  const auto runs = [](const fs::path& file) { return fs::is_regular_file(file) && access(file.c_str(), X_OK) == 0; };
  if (name.find('/') != name.npos) {
    const fs::path file = (folder / name).lexically_normal();
    if (runs(file)) return file;
    throw InputError(
        fmt::format("the program '{}' of \"command\" {}; correct its path, which begins at the folder of "
                    "the experiment file",
                    file.string(), fs::exists(file) ? "may not be executed (chmod +x)" : "does not exist"));
  }
  const char* const path = std::getenv("PATH");
  std::string_view left = path != nullptr ? path : "/usr/bin:/bin";
  while (!left.empty()) {
    const std::size_t colon = left.find(':');
    const fs::path file = fs::path(left.substr(0, colon)) / name;
    if (file.is_absolute() && runs(file)) return file;
    left = colon == left.npos ? std::string_view() : left.substr(colon + 1);
  }
  throw InputError(
      fmt::format("the program '{}' of \"command\" is in no folder of PATH; install it, or give its path", name));
}

std::string last_lines(const fs::path& file, std::size_t count) {
  std::ifstream stream(file);
  std::deque<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t end = line.find_last_not_of(" \t\r");
    if (end == line.npos) continue;
    lines.push_back(line.substr(line.find_first_not_of(" \t"), std::size_t{200}));
    lines.back().resize(std::min(lines.back().size(), lines.back().find_last_not_of(" \t\r") + 1));
    if (lines.size() > count) lines.pop_front();
  }
  return lines.empty() ? "nothing" : fmt::format("{}", fmt::join(lines, " | "));
}

}  // namespace tunica::external
