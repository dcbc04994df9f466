// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tunica::app {

/// What another process of this program said.
struct Answer {
  std::string out;
  std::string problem;  ///< how it ended, unless well; then `out` does not count
};

/// Starts this very executable with these arguments and waits for it. Its standard output is the answer, its standard
/// error ours.
Answer ask_fresh_process(const std::vector<std::string>& arguments);

/// The same with another program, found on PATH. Its standard error goes nowhere.
Answer ask_program(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace tunica::app
