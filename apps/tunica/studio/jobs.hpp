// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <nlohmann/json_fwd.hpp>
#include <sys/types.h>

#include "session.hpp"
#include "studio/job_record.hpp"

namespace tunica::app::studio {

/// One process of `tunica` a job, in the project. Jobs end with the server: they are asked to save, and ended where
/// they do not. What is known of them stands in .tunica-studio/jobs, so that the next server offers to resume them.
class Jobs {
 public:
  /// `plugins`: options that every command needs to find the plugins of this process.
  Jobs(const Session& session, std::vector<std::string> plugins);
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// What the page asks for: {"verb": run|diagnose|discover, "experiment", "quick", "readings": only what the file may
  /// say and is not so}, {"verb": "run", "resume": id},
  /// {"verb": "report", "folders"} or {"verb": "export", "folder", "to", "units", "run"}. Returns as all() does. Throws
  /// InputError.
  nlohmann::ordered_json start(const nlohmann::json& request);
  /// As Ctrl-C does: results so far are saved.
  void stop(const std::string& id);
  /// The newest first, with "state": running, done, not_converged, failed, stopped or interrupted.
  [[nodiscard]] nlohmann::ordered_json all();
  /// Words of a stream of server-sent events: "progress", and at last "end". Throws InputError.
  [[nodiscard]] std::function<std::optional<std::string>()> events(const std::string& id);

 private:
  nlohmann::ordered_json entry(const JobRecord& job) const;
  void launch(JobRecord& job, std::unique_lock<std::mutex>& lock);
  void watch();
  void finish(const std::string& id, int status);
  [[nodiscard]] JobRecord find(const std::string& id);

  const Session& session_;
  const std::vector<std::string> plugins_;
  std::mutex starting_, mutex_;  ///< one start at a time; what is below
  std::map<std::string, pid_t> running_;
  /// A process ends with the thread that has begun it (PR_SET_PDEATHSIG), and threads of the server end before the jobs
  /// are asked to save: the watch begins them.
  std::function<void()> beginning_;
  std::condition_variable changed_;
  bool over_ = false;
  std::thread watch_;
};

}  // namespace tunica::app::studio
