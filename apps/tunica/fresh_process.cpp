// SPDX-License-Identifier: Apache-2.0
#include "fresh_process.hpp"

#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tunica::app {

namespace {

/// Starts a program under a name, whose standard error is ours or nowhere, and waits for it.
Answer ask(const std::string& executable, const std::string& name, const std::vector<std::string>& arguments,
           bool quiet) {
  std::vector<std::string> words{name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC) != 0) return {{}, fmt::format("no pipe: {}", std::strerror(errno))};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  if (quiet) ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = -1;
  const int error = ::posix_spawnp(&child, executable.c_str(), &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  Answer answer;
  if (error != 0) {
    ::close(pipe[0]);
    answer.problem = fmt::format("it could not be started: {}", std::strerror(error));
    return answer;
  }
  // Until the end of the pipe, or of the process: another one that a plugin has begun may hold the pipe for ever.
  int status = 0;
  bool ended = false;
  for (std::array<char, 4096> buffer;;) {
    pollfd wanted{pipe[0], POLLIN, 0};
    if (::poll(&wanted, 1, ended ? 0 : 100) > 0) {
      const ssize_t count = ::read(pipe[0], buffer.data(), buffer.size());
      if (count > 0) answer.out.append(buffer.data(), static_cast<std::size_t>(count));
      if (count == 0 || (count < 0 && errno != EINTR)) break;
    } else if (ended) {
      break;
    } else {
      ended = ::waitpid(child, &status, WNOHANG) == child;
    }
  }
  ::close(pipe[0]);
  while (!ended && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) answer.problem = fmt::format("it was ended by signal {}", WTERMSIG(status));
  if (WIFEXITED(status) && WEXITSTATUS(status) > 1)  // 1: it answered, with bad news
    answer.problem = fmt::format("it ended with code {}", WEXITSTATUS(status));
  return answer;
}

}  // namespace

Answer ask_fresh_process(const std::vector<std::string>& arguments) {
  // The kernel's link to our own image: right even when the file was moved or replaced meanwhile.
  return ask("/proc/self/exe", "tunica", arguments, false);
}

Answer ask_program(const std::string& program, const std::vector<std::string>& arguments) {
  return ask(program, program, arguments, true);
}

}  // namespace tunica::app
