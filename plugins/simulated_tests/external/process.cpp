// SPDX-License-Identifier: Apache-2.0
#include "process.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "keeper.hpp"

namespace tunica::external {
namespace {

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
  for (const auto& [name, value] : command.environment) variables.push_back(fmt::format("{}={}", name, value));
  return variables;
}

/// Waits for the next message until then; none: the time is up. A keeper that dies silently counts as ended.
std::optional<Message> next(int pipe, Clock::time_point limit) {
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(limit - Clock::now()).count();
    pollfd watched{pipe, POLLIN, 0};
    const int found = poll(&watched, 1, static_cast<int>(std::clamp<long long>(left, 0, 60000)));
    if (found > 0) {
      Message message;
      const auto bytes = read(pipe, &message, sizeof message);
      if (bytes == sizeof message) return message;
      if (bytes < 0 && errno == EINTR) continue;
      return Message{Message::Kind::ended, SIGKILL};
    }
    if (found == 0 && left <= 0) return std::nullopt;
  }
}

/// Reads messages until the program has ended, and ends it when time is up or a person wants it.
Ending follow(const Command& command, int pipe, Clock::time_point limit) {
  constexpr std::chrono::milliseconds heartbeat{100};
  Ending ending;
  ending.started = true;
  pid_t group = 0;
  const auto not_started = [&](const char* what, int problem) {
    ending.started = false;
    ending.words = fmt::format("{}: {}", what, std::strerror(problem));
  };
  for (;;) {
    const auto message = next(pipe, std::min(limit, Clock::now() + heartbeat));
    if (!message) {
      const bool first = !ending.timed_out && !ending.interrupted;
      if (first && command.interrupted && command.interrupted()) ending.interrupted = true;
      if (first && !ending.interrupted && Clock::now() >= limit) ending.timed_out = true;
      if ((ending.timed_out || ending.interrupted) && group > 0) {
        kill(-group, SIGKILL);
        limit = Clock::now() + heartbeat;  // until its end is told
      }
      continue;
    }
    const int value = message->value;
    switch (message->kind) {
      case Message::Kind::group:
        group = value;
        break;
      case Message::Kind::not_ready:
        not_started("could not be started in its scratch folder", value);
        break;
      case Message::Kind::not_run:
        not_started("could not be started", value);
        break;
      case Message::Kind::not_made:
        not_started("could not be started", value);
        return ending;
      case Message::Kind::not_watched:
        not_started("could not be watched (pidfd_open)", value);
        return ending;
      case Message::Kind::ended:
        if (WIFEXITED(value)) ending.code = WEXITSTATUS(value);
        if (WIFSIGNALED(value)) ending.signal = WTERMSIG(value);
        return ending;
    }
  }
}

}  // namespace

Ending run(const Command& command) {
  std::vector<std::string> words = command.words, variables = environment_of(command);
  std::vector<std::string> tidying = {"/bin/rm", "-rf", "--", command.discarded.string()};
  const std::vector<char*> word_pointers = pointers(words), variable_pointers = pointers(variables),
                           tidying_pointers = pointers(tidying);
  const std::string folder = command.folder.string(), output = command.output.string();
  int ends[2];
  const auto impossible = [] {
    Ending ending;
    ending.words = fmt::format("could not be started: {}", std::strerror(errno));
    return ending;
  };
  if (pipe2(ends, O_CLOEXEC) != 0) return impossible();
  const Kept kept{folder.c_str(),
                  output.c_str(),
                  word_pointers.data(),
                  variable_pointers.data(),
                  command.discarded.empty() ? nullptr : tidying_pointers.data(),
                  command.mebibytes << 20U,
                  command.file_mebibytes << 20U,
                  getpid(),
                  ends[1]};
  const auto limit =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(command.seconds));
  const pid_t keeper = fork();
  if (keeper == 0) keep(kept);
  Ending ending = keeper < 0 ? impossible() : Ending{};
  close(ends[1]);
  if (keeper > 0) {
    ending = follow(command, ends[0], limit);
    while (waitpid(keeper, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  close(ends[0]);
  if (!ending.words.empty()) return ending;
  if (ending.interrupted)
    ending.words = "was ended because the work was interrupted, or its max_time was over";
  else if (ending.timed_out)
    ending.words = fmt::format("was ended at its time limit of {:g} s", command.seconds);
  else if (ending.signal == SIGXFSZ)
    ending.words = fmt::format("was ended at a file of {} MiB; let it write less, or raise \"output_limit\"",
                               command.file_mebibytes);
  else if (ending.signal != 0)
    ending.words = fmt::format("was ended by signal {} ({})", ending.signal, sigabbrev_np(ending.signal));
  else
    ending.words = fmt::format("ended with exit code {}", ending.code);
  return ending;
}

}  // namespace tunica::external
