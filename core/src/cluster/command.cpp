// SPDX-License-Identifier: Apache-2.0
#include "cluster/command.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tunica::cluster {

namespace {

/// Two pipes, emptied in parallel: a program that fills an unread pipe would wait for ever.
struct Pipes {
  std::array<int, 2> read{-1, -1}, write{-1, -1};

  bool open() {
    for (std::size_t k = 0; k < 2; ++k) {
      int ends[2];
      if (::pipe2(ends, O_CLOEXEC) != 0) return false;
      read[k] = ends[0];
      write[k] = ends[1];
    }
    return true;
  }
  ~Pipes() {
    close(read);
    close(write);
  }
  static void close(std::array<int, 2>& ends) {
    for (int& end : ends) {
      if (end >= 0) ::close(end);
      end = -1;
    }
  }
  void drain(std::string& out, std::string& err) {
    std::array<std::string*, 2> texts{&out, &err};
    std::array<char, 4096> buffer;
    while (read[0] >= 0 || read[1] >= 0) {
      std::array<pollfd, 2> wanted{{{read[0], POLLIN, 0}, {read[1], POLLIN, 0}}};
      if (::poll(wanted.data(), wanted.size(), -1) < 0 && errno != EINTR) return;
      for (std::size_t k = 0; k < 2; ++k) {
        if (wanted[k].revents == 0) continue;
        const ssize_t count = ::read(read[k], buffer.data(), buffer.size());
        if (count > 0) texts[k]->append(buffer.data(), static_cast<std::size_t>(count));
        if (count == 0 || (count < 0 && errno != EINTR)) ::close(std::exchange(read[k], -1));
      }
    }
  }
};

Ended not_started(const std::string& program, int error) {
  Ended ended;
  ended.code = 127;
  ended.err = fmt::format("{} could not be started: {}", program, std::strerror(error));
  return ended;
}

}  // namespace

Ended run_command(const std::vector<std::string>& words) {
  const auto begin = std::chrono::steady_clock::now();
  auto copies = words;
  std::vector<char*> argv;
  for (auto& word : copies) argv.push_back(word.data());
  argv.push_back(nullptr);
  Pipes pipes;
  if (!pipes.open()) return not_started(words.front(), errno);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&actions, pipes.write[0], STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, pipes.write[1], STDERR_FILENO);
  pid_t child = -1;
  const int error = ::posix_spawnp(&child, argv.front(), &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return not_started(words.front(), error);
  Pipes::close(pipes.write);
  Ended ended;
  pipes.drain(ended.out, ended.err);
  int status = 0;
  rusage used{};
  while (::wait4(child, &status, 0, &used) < 0 && errno == EINTR) {
  }
  ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  ended.peak_bytes = static_cast<std::size_t>(used.ru_maxrss) * 1024;  // Linux counts KiB
  ended.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return ended;
}

std::string last_line(const std::string& text) {
  const auto end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) return {};
  const auto before = text.find_last_of('\n', end);
  const auto begin = before == std::string::npos ? 0 : before + 1;
  return text.substr(begin, end + 1 - begin);
}

}  // namespace tunica::cluster
