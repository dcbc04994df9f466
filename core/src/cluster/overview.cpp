// SPDX-License-Identifier: Apache-2.0
#include "cluster/overview.hpp"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cluster/command.hpp"
#include "results/keys.hpp"

namespace tunica::cluster {

namespace key = results::key;

namespace {

/// The end of a log, which may be long.
std::string end_of(const std::filesystem::path& file) {
  constexpr std::streamoff most = 4096;
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) return {};
  const std::streamoff length = stream.tellg();
  stream.seekg(std::max<std::streamoff>(0, length - most));
  return last_line({std::istreambuf_iterator<char>(stream), {}});
}

/// Of two tasks the one that tells more: the living one, else the younger.
bool tells_more(const slurm::Task& one, const slurm::Task& other) {
  if (one.alive() != other.alive()) return one.alive();
  return std::pair(one.job.size(), one.job) > std::pair(other.job.size(), other.job);  // numbers as text
}

const slurm::Task* best_of(const std::vector<slurm::Task>& tasks, const std::string& name,
                           std::optional<std::size_t> part) {
  const slurm::Task* best = nullptr;
  for (const slurm::Task& task : tasks)
    if (task.name == name && task.part == part && (!best || tells_more(task, *best))) best = &task;
  return best;
}

Standing standing_of(const cohort::ShareProgress& progress, const slurm::Task* task) {
  if (progress.missing == 0) return Standing::done;
  if (!task || !task->alive()) return Standing::stopped;
  return task->phase == slurm::Phase::running ? Standing::running : Standing::waiting;
}

/// "TIMEOUT", or "PENDING (Resources)", or nothing.
std::string state_words(const std::string& state, const std::string& reason) {
  return reason.empty() ? state : fmt::format("{} ({})", state, reason);
}

/// As scontrol takes it: "12", or "12_3" in an array.
std::string id_of(const slurm::Task& task) { return task.part ? fmt::format("{}_{}", task.job, *task.part) : task.job; }

std::string line_of(const ShardView& shard) {
  const auto& progress = shard.progress;
  std::string line = fmt::format(
      "  {:>6}  {:<8} {:>6} of {:<6}", fmt::format("{}/{}", progress.share.part, progress.share.of),
      text::code_of(standing_codes, shard.standing), progress.specimens - progress.missing, progress.specimens);
  if (!shard.job.empty()) line += fmt::format("  job {}", shard.job);
  if (!shard.state.empty()) line += "  " + state_words(shard.state, shard.reason);
  if (!shard.nodes.empty()) line += " on " + shard.nodes;
  line += '\n';
  if (!shard.last_words.empty()) line += fmt::format("{:18}its log ends with: {}\n", "", shard.last_words);
  return line;
}

}  // namespace

std::size_t Overview::count(Standing standing) const {
  return static_cast<std::size_t>(std::count_if(shards.begin(), shards.end(),
                                                [standing](const ShardView& one) { return one.standing == standing; }));
}

bool Overview::stuck() const {
  return count(Standing::stopped) > 0 || (missing == 0 && merge && merge->phase == slurm::Phase::failed);
}

std::vector<slurm::Task> known_tasks(const Submission& submission) {
  auto tasks = slurm::queue({submission.name, submission.merge_name()});
  std::vector<std::string> forgotten;
  for (const Job& job : submission.jobs)
    if (std::none_of(tasks.begin(), tasks.end(), [&job](const auto& task) { return task.job == job.id; }))
      forgotten.push_back(job.id);
  for (auto& task : slurm::accounts(forgotten)) {
    if (task.alive()) task.phase = slurm::Phase::failed;  // accounts of a job that the queue has lost
    tasks.push_back(std::move(task));
  }
  return tasks;
}

Overview overview(const Submission& submission, const std::vector<cohort::ShareProgress>& progress,
                  const std::vector<slurm::Task>& tasks, const std::filesystem::path& results) {
  Overview view;
  for (const cohort::ShareProgress& one : progress) {
    ShardView shard;
    shard.progress = one;
    const slurm::Task* task = best_of(tasks, submission.name, one.share.part);
    shard.standing = standing_of(one, task);
    if (task) {
      shard.job = task->job;
      shard.state = task->state;
      shard.reason = task->reason;
      shard.nodes = task->nodes;
    }
    if (shard.standing == Standing::stopped) shard.last_words = end_of(shard_log(results, one.share.part));
    view.specimens += one.specimens;
    view.missing += one.missing;
    view.shards.push_back(std::move(shard));
  }
  for (const slurm::Task& task : tasks)
    if (task.held()) view.held.push_back(task);
  if (const slurm::Task* merge = best_of(tasks, submission.merge_name(), std::nullopt)) view.merge = *merge;
  if (view.merge && view.merge->phase == slurm::Phase::failed)
    view.merge_last_words = end_of(queue_folder(results) / "merge.txt");
  return view;
}

std::string in_words(const Overview& view, const Submission& submission) {
  constexpr std::size_t most_lines = 30;
  const std::size_t there = view.specimens - view.missing;
  std::string text =
      fmt::format("{} of {} specimens have a result ({:.0f} %)\n", there, view.specimens,
                  view.specimens ? 100.0 * static_cast<double>(there) / static_cast<double>(view.specimens) : 100);
  text += fmt::format("{} shards: {} done, {} running, {} waiting, {} stopped\n", view.shards.size(),
                      view.count(Standing::done), view.count(Standing::running), view.count(Standing::waiting),
                      view.count(Standing::stopped));
  std::size_t lines = 0;
  for (const Standing standing : {Standing::stopped, Standing::running, Standing::waiting})
    for (const ShardView& shard : view.shards)
      if (shard.standing == standing && lines++ < most_lines) text += line_of(shard);
  if (lines > most_lines) text += fmt::format("  and {} more; --json lists all\n", lines - most_lines);
  if (view.merge)
    text += fmt::format("   merge  {:<8} job {}  {}\n", text::code_of(slurm::phase_codes, view.merge->phase),
                        view.merge->job, state_words(view.merge->state, view.merge->reason));
  if (!view.merge_last_words.empty()) text += fmt::format("{:18}its log ends with: {}\n", "", view.merge_last_words);
  for (const slurm::Task& task : view.held)
    text += fmt::format("Slurm holds job {} ({}). When its nodes are well, let it go: scontrol release {}\n",
                        id_of(task), task.reason, id_of(task));
  if (!view.queue_problem.empty())
    text += fmt::format("The queue was not asked, so a shard may be alive that is called stopped here: {}\n",
                        view.queue_problem);
  if (submission.jobs.empty() && view.queue_problem.empty()) text += "No job of this cohort was recorded.\n";
  return text;
}

std::string in_json(const Overview& view, const Submission& submission) {
  using Json = nlohmann::ordered_json;
  const auto or_null = [](const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); };
  Json shards = Json::array();
  for (const ShardView& shard : view.shards)
    shards.push_back({{key::shard, shard.progress.share.part},
                      {key::standing, std::string(text::code_of(standing_codes, shard.standing))},
                      {key::specimens, shard.progress.specimens},
                      {key::missing, shard.progress.missing},
                      {key::job, or_null(shard.job)},
                      {key::state, or_null(shard.state)},
                      {key::reason, or_null(shard.reason)},
                      {key::nodes, or_null(shard.nodes)},
                      {key::last_words, or_null(shard.last_words)}});
  Json merge = nullptr;
  if (view.merge)
    merge = {{key::job, view.merge->job},
             {key::standing, std::string(text::code_of(slurm::phase_codes, view.merge->phase))},
             {key::state, view.merge->state},
             {key::reason, or_null(view.merge->reason)},
             {key::last_words, or_null(view.merge_last_words)}};
  Json held = Json::array();
  for (const slurm::Task& task : view.held) held.push_back({{key::job, id_of(task)}, {key::reason, task.reason}});
  const Json json = {{key::name, submission.name},
                     {key::specimens, view.specimens},
                     {key::missing, view.missing},
                     {key::queue_problem, or_null(view.queue_problem)},
                     {key::shards, shards},
                     {key::merge, merge},
                     {key::held, held}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tunica::cluster
