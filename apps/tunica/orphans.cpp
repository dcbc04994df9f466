// SPDX-License-Identifier: Apache-2.0
#include "orphans.hpp"

#include <csignal>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tunica::app {

namespace {

std::string command_of(const std::string& process) {
  std::ifstream line("/proc/" + process + "/cmdline", std::ios::binary);
  return {std::istreambuf_iterator<char>(line), {}};
}

/// Children of this process, which has one thread, that are copies of it: forked, and no program of their own since. A
/// program that was started on purpose, by a queue for instance, is left alone.
std::vector<pid_t> copies() {
  std::ifstream list(fmt::format("/proc/self/task/{}/children", ::getpid()));
  const std::string own = command_of("self");
  std::vector<pid_t> found;
  for (pid_t child = 0; list >> child;)
    if (command_of(fmt::format("{}", child)) == own) found.push_back(child);
  return found;
}

}  // namespace

void end_orphans() {
  constexpr int moments = 100;
  constexpr timespec moment{0, 10'000'000};
  for (int k = 0;; ++k) {
    while (::waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    const auto left = copies();
    if (left.empty() || k > moments + 20) return;  // beyond: one that cannot be ended, for it waits for a device
    if (k >= moments)
      for (const pid_t copy : left) ::kill(copy, SIGKILL);
    ::nanosleep(&moment, nullptr);
  }
}

}  // namespace tunica::app
