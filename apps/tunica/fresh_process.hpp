// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace tunica::app {

/// What another process of this program said.
struct Answer {
  std::string out;
  std::string problem;  ///< how it ended, unless well; then `out` does not count
  std::string said;     ///< the last line of its standard error, of another program
};

/// Starts this very executable with these arguments and waits for it. Its standard output is the answer, its standard
/// error ours.
Answer ask_fresh_process(const std::vector<std::string>& arguments);

/// The same with another program, found on PATH. It is ended, with all that it has started, at the time limit and where
/// an execution::InterruptWatch has seen Ctrl-C.
Answer ask_program(const std::string& program, const std::vector<std::string>& arguments, std::chrono::seconds limit);

}  // namespace tunica::app
