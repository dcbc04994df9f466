// SPDX-License-Identifier: Apache-2.0
#include "unfinished_results.hpp"

#include <csignal>

#include <unistd.h>

#include "exit_codes.hpp"

namespace tunica::app {

namespace {

// A signal handler may call unlink, rmdir, write and _exit, but nothing that allocates: what it needs is laid out
// before.
std::vector<std::string> to_remove;
std::string last_words;

void remove_made() {
  for (const auto& one : to_remove)
    if (::unlink(one.c_str()) != 0) ::rmdir(one.c_str());  // fails, as it should, where something is inside
}

void on_signal(int) {
  remove_made();
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, last_words.data(), last_words.size());
  ::_exit(interrupted);
}

}  // namespace

UnfinishedResults::UnfinishedResults(const std::vector<std::filesystem::path>& made, const std::string& message) {
  to_remove.clear();
  // Absolute: something may change the working directory on the way.
  for (const auto& one : made)
    if (!one.empty()) to_remove.push_back(std::filesystem::absolute(one).string());
  last_words = message;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

UnfinishedResults::~UnfinishedResults() {
  remove_made();
  keep();
}

void UnfinishedResults::keep() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  to_remove.clear();
}

}  // namespace tunica::app
