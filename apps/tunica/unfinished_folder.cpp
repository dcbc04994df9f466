// SPDX-License-Identifier: Apache-2.0
#include "unfinished_folder.hpp"

#include <csignal>

#include <unistd.h>

#include "exit_codes.hpp"

namespace tunica::app {

namespace {

// A signal handler may call rmdir, write and _exit, but nothing that allocates: what it needs is laid out before.
std::vector<std::string> to_remove;
std::string last_words;

void remove_empty() {
  for (const auto& folder : to_remove) ::rmdir(folder.c_str());  // fails, as it should, where something is inside
}

void on_signal(int) {
  remove_empty();
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, last_words.data(), last_words.size());
  ::_exit(interrupted);
}

}  // namespace

UnfinishedFolder::UnfinishedFolder(const std::vector<std::filesystem::path>& folders, const std::string& message) {
  to_remove.clear();
  // Absolute: something may change the working directory on the way.
  for (const auto& folder : folders) to_remove.push_back(std::filesystem::absolute(folder).string());
  last_words = message;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

UnfinishedFolder::~UnfinishedFolder() {
  remove_empty();
  keep();
}

void UnfinishedFolder::keep() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  to_remove.clear();
}

}  // namespace tunica::app
