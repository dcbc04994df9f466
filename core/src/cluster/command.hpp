// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

/// A queue of a computing centre that runs shards of a cohort: Slurm. docs/cohort_cluster.md.
namespace tunica::cluster {

/// How a program ended, and its output.
struct Ended {
  int code = -1;  ///< its exit code, 128 + signal, or 127 where it could not be started
  std::string out, err;
  std::size_t peak_bytes = 0;  ///< the most memory that it held at once
  double seconds = 0;

  [[nodiscard]] bool well() const { return code == 0; }
};

/// Starts a program, found on PATH, with exactly these words, and waits for it. No shell reads them. Its standard input
/// is empty.
Ended run_command(const std::vector<std::string>& words);

/// The last line that is not empty; "" where there is none.
std::string last_line(const std::string& text);

}  // namespace tunica::cluster
