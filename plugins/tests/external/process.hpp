// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
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
};

/// How a run ended.
struct Ending {
  bool started = false;    ///< false: the system could not start it, see `words`
  bool timed_out = false;  ///< it was ended at its limit
  int code = -1;           ///< exit code; −1 where a signal ended it
  int signal = 0;
  double seconds = 0;
  std::string words;  ///< "ended with exit code 3 after 1.2 s"

  [[nodiscard]] bool good() const { return started && !timed_out && code == 0; }
};

/// Runs a program in a process group of its own, and waits for it. At the limit, and when the program has ended, every
/// process that is left in its group is killed. It is killed as well where this process dies. Thread-safe.
Ending run(const Command& command);

/// The program's file: found in PATH, or below `folder` where the name has a slash. Throws InputError.
std::filesystem::path program_file(const std::string& name, const std::filesystem::path& folder);

/// The last lines of a text file, joined by " | "; blank ones left out.
std::string last_lines(const std::filesystem::path& file, std::size_t count);

}  // namespace tunica::external
