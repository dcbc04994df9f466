// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace tunica::external {

/// A program to run: its arguments, where, and how long.
struct Command {
  std::vector<std::string> words;                                ///< the program, with its path, and its arguments
  std::filesystem::path folder;                                  ///< in which it runs
  std::filesystem::path output;                                  ///< file that takes what it prints, errors too
  std::vector<std::pair<std::string, std::string>> environment;  ///< set for it besides what this process has
  double seconds = 0;                                            ///< time limit by the clock
  std::size_t mebibytes = 0;                                     ///< limit of its address space; 0 = none
  std::size_t file_mebibytes = 0;                                ///< limit of each file that it writes; 0 = none
  std::filesystem::path discarded = {};                          ///< removed where this process dies; empty = nothing
  std::function<bool()> interrupted = {};                        ///< asked ten times a second: whether to end it
};

/// How a run ended.
struct Ending {
  bool started = false;      ///< false: the system could not start it, see `words`
  bool timed_out = false;    ///< it was ended at its limit
  bool interrupted = false;  ///< it was ended because a person ended the work
  int code = -1;             ///< exit code; −1 where a signal ended it
  int signal = 0;
  std::string words;  ///< "ended with exit code 3"

  [[nodiscard]] bool good() const { return started && !timed_out && !interrupted && code == 0; }
};

/// Runs a program in a process group of its own, and waits for it. At the limit, when it is interrupted, and when the
/// program has ended, every process that is left in its group is killed. So they are where this process dies, whatever
/// it dies of. Thread-safe.
Ending run(const Command& command);

}  // namespace tunica::external
