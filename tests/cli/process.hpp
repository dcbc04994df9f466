// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace tunica::trial {

/// How a process ended, and its output.
struct Ended {
  int code = -1;  ///< exit code, or 128 + signal
  std::string out, err;
};

/// A process that was started, its output going to files beside `folder`.
class Process {
 public:
  Process(std::vector<std::string> arguments, std::filesystem::path folder);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();
  void signal(int number) const;
  Ended wait();

 private:
  std::filesystem::path out_, err_;
  pid_t id_ = -1;
};

/// The built executable with these arguments; stands in `folder`, output is piped (to files), no terminal.
Ended tunica(std::vector<std::string> arguments, const std::filesystem::path& folder);
/// The arguments with the executable and the folder of the built plugins in front.
std::vector<std::string> tunica_command(std::vector<std::string> arguments);

}  // namespace tunica::trial
