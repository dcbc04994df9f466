// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace tunica::app::studio {

/// What .tunica-studio/jobs/<id>.json says. The words of the process are beside it, in <id>.out and <id>.err.
struct JobRecord {
  std::string id = {}, verb = {};
  std::vector<std::string> words = {};       ///< of the command line, behind "tunica"
  std::string folder = {}, experiment = {};  ///< of the results; empty where the verb has none
  double started = 0;                        ///< s since 1970
  std::optional<double> ended = {};          ///< none: it runs, or the server was ended
  std::optional<int> code = {};              ///< of its end
  bool asked_to_stop = false;
  std::string output = {};  ///< the one file that the verb writes; empty where it writes a folder, or in its place

  /// "run" saves continuously, and resumes from the saved state.
  [[nodiscard]] bool is_resumable() const;
  [[nodiscard]] std::filesystem::path file(const char* ending) const;
};

/// The number of the next one, six digits.
std::string next_job_id();
/// Newest first; invalid records are left out.
std::vector<JobRecord> job_records();
void write_record(const JobRecord& job);

}  // namespace tunica::app::studio
