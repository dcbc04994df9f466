// SPDX-License-Identifier: Apache-2.0
#include "cli/process.hpp"

#include <atomic>
#include <stdexcept>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "execution/folder.hpp"

namespace tunica::trial {

Process::Process(std::vector<std::string> arguments, std::filesystem::path folder) {
  static std::atomic<int> number = 0;
  const auto name = "tunica-" + std::to_string(getpid()) + "-" + std::to_string(number++);
  out_ = std::filesystem::temp_directory_path() / (name + ".out");
  err_ = std::filesystem::temp_directory_path() / (name + ".err");
  std::vector<char*> argv;
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  id_ = fork();
  if (id_ < 0) throw std::runtime_error("cannot fork");
  if (id_ > 0) return;
  const int out = ::open(out_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int err = ::open(err_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (out < 0 || err < 0 || dup2(out, STDOUT_FILENO) < 0 || dup2(err, STDERR_FILENO) < 0) _exit(126);
  if (chdir(folder.c_str()) != 0) _exit(126);
  execv(argv.front(), argv.data());
  _exit(127);
}

Process::~Process() {
  if (id_ > 0) {
    ::kill(id_, SIGKILL);
    wait();
  }
  std::error_code ignored;
  std::filesystem::remove(out_, ignored);
  std::filesystem::remove(err_, ignored);
}

void Process::signal(int number) const {
  if (id_ > 0) ::kill(id_, number);
}

Ended Process::wait() {
  int status = 0;
  ::waitpid(id_, &status, 0);
  id_ = -1;
  Ended ended;
  ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  ended.out = text_of(out_);
  ended.err = text_of(err_);
  return ended;
}

std::vector<std::string> tunica_command(std::vector<std::string> arguments) {
  // The test tree may be world-writable (containers); the rule itself is tested with the loader.
  arguments.insert(arguments.begin(), {TUNICA_EXECUTABLE, "--allow-world-writable-plugins"});
  return arguments;
}

Ended tunica(std::vector<std::string> arguments, const std::filesystem::path& folder) {
  return Process(tunica_command(std::move(arguments)), folder).wait();
}

}  // namespace tunica::trial
