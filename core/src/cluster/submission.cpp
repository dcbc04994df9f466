// SPDX-License-Identifier: Apache-2.0
#include "cluster/submission.hpp"

#include <cctype>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include "cluster/command.hpp"
#include "data/sha256.hpp"
#include "execution/files.hpp"
#include "text/shell.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::cluster {

namespace {

std::filesystem::path jobs_file(const std::filesystem::path& results) { return queue_folder(results) / "jobs.json"; }

std::string script_of(const Invocation& call, const char* what, const std::vector<std::string>& verb,
                      const std::string& after) {
  std::vector<std::string> words{call.program.string()};
  words.insert(words.end(), call.options.begin(), call.options.end());
  words.insert(words.end(), verb.begin(), verb.end());
  words.insert(words.end(), {call.cohort.string(), "-o", call.results.string()});
  std::string text = fmt::format("#!/bin/sh\n# {}\n", what);
  if (!call.plugin_path.empty()) text += "export TUNICA_PLUGIN_PATH=" + text::quoted(call.plugin_path) + "\n";
  return text + "exec " + text::quoted(words) + after + "\n";
}

}  // namespace

std::filesystem::path queue_folder(const std::filesystem::path& results) { return results / "slurm"; }

std::filesystem::path shard_log(const std::filesystem::path& results, std::size_t part) {
  return queue_folder(results) / fmt::format("shard_{}.txt", part);
}

std::string job_name(const std::string& cohort, const std::filesystem::path& results) {
  std::string name = "tunica-";
  for (const char letter : cohort.substr(0, 40))
    name += std::isalnum(static_cast<unsigned char>(letter)) ? letter : '-';
  return name + "-" + data::sha256(results.string()).substr(0, 8);
}

std::optional<Submission> stored_submission(const std::filesystem::path& results) {
  const auto file = jobs_file(results);
  if (!std::filesystem::exists(file)) return {};
  try {
    const auto json = detail::parse_json(execution::read_text(file));
    Submission submission;
    submission.name = json.at("name");
    Wishes& wishes = submission.wishes;
    wishes.shards = json.at("shards");
    wishes.threads = json.at("threads");
    wishes.time = json.at("time");
    wishes.memory = json.at("memory");
    wishes.merge_time = json.at("merge_time");
    wishes.merge_memory = json.at("merge_memory");
    wishes.partition = json.at("partition");
    for (const auto& job : json.at("jobs")) submission.jobs.push_back({job.at("id"), job.at("array")});
    return submission;
  } catch (const nlohmann::json::exception&) {
    throw InputError(
        fmt::format("{}: is not what `tunica cohort submit` writes. Look with squeue whether jobs are "
                    "alive, then remove the file and submit again",
                    file.string()));
  }
}

void store(const Submission& submission, const std::filesystem::path& results) {
  auto jobs = nlohmann::ordered_json::array();
  for (const Job& job : submission.jobs) jobs.push_back({{"id", job.id}, {"array", job.array}});
  const Wishes& wishes = submission.wishes;
  const nlohmann::ordered_json json = {{"format", 1},
                                       {"queue", "slurm"},
                                       {"name", submission.name},
                                       {"shards", wishes.shards},
                                       {"threads", wishes.threads},
                                       {"time", wishes.time},
                                       {"memory", wishes.memory},
                                       {"merge_time", wishes.merge_time},
                                       {"merge_memory", wishes.merge_memory},
                                       {"partition", wishes.partition},
                                       {"jobs", jobs}};
  execution::write_atomically(jobs_file(results),
                              json.dump(1, ' ', false, decltype(json)::error_handler_t::replace) + "\n");
}

SubmissionLock::SubmissionLock(const std::filesystem::path& results) {
  const auto folder = queue_folder(results);
  execution::make_folder(folder);
  const auto file = folder / "lock";
  file_ = execution::AppendFile(file);
  if (::flock(file_.descriptor(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw InputError(
        fmt::format("{}: another tunica is submitting this cohort; wait for it, then look with `tunica "
                    "cohort status`",
                    file.string()));
}

std::string shard_script(const Invocation& call, const Wishes& wishes) {
  std::string options = fmt::format(" --shard \"$SLURM_ARRAY_TASK_ID/{}\" --threads {}", wishes.shards, wishes.threads);
  for (const auto& option : call.shard_options) options += " " + text::quoted(option);
  return script_of(call, "Fits one shard: a task of a job array. Written by tunica cohort submit.", {"cohort"},
                   options);
}

std::string merge_script(const Invocation& call, const Wishes& wishes) {
  return script_of(call, "Makes the results from what the shards have left. Written by tunica cohort submit.",
                   {"cohort", "merge"}, fmt::format(" --threads {}", wishes.threads));
}

slurm::Order shards_order(const Submission& submission, const std::filesystem::path& results,
                          const std::string& array) {
  const Wishes& wishes = submission.wishes;
  return {submission.name,  array,          "",      wishes.time,          wishes.memory,
          wishes.partition, wishes.threads, results, "slurm/shard_%a.txt", queue_folder(results) / "shard.sh"};
}

slurm::Order merge_order(const Submission& submission, const std::filesystem::path& results, const std::string& after) {
  slurm::Order order = shards_order(submission, results, "");
  order.name = submission.merge_name();
  order.after = after;
  order.time = submission.wishes.merge_time;
  order.memory = submission.wishes.merge_memory;
  order.log = "slurm/merge.txt";
  order.script = queue_folder(results) / "merge.sh";
  return order;
}

}  // namespace tunica::cluster
