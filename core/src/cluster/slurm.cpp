// SPDX-License-Identifier: Apache-2.0
#include "cluster/slurm.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

#include <fmt/format.h>

#include "cluster/command.hpp"
#include "tunica/error.hpp"

namespace tunica::cluster::slurm {

namespace {

/// Every state that is not final, from `man squeue`, "JOB STATE CODES".
constexpr text::Codes<Phase, 16> living_states{{{Phase::waiting, "PENDING"},
                                                {Phase::waiting, "CONFIGURING"},
                                                {Phase::waiting, "REQUEUED"},
                                                {Phase::waiting, "REQUEUE_FED"},
                                                {Phase::waiting, "REQUEUE_HOLD"},
                                                {Phase::waiting, "RESV_DEL_HOLD"},
                                                {Phase::waiting, "SPECIAL_EXIT"},
                                                {Phase::running, "RUNNING"},
                                                {Phase::running, "COMPLETING"},
                                                {Phase::running, "RESIZING"},
                                                {Phase::running, "SIGNALING"},
                                                {Phase::running, "STAGE_OUT"},
                                                {Phase::running, "STOPPED"},
                                                {Phase::running, "SUSPENDED"},
                                                {Phase::ended, "COMPLETED"},
                                                {Phase::failed, "FAILED"}}};

std::optional<std::size_t> number_in(const std::string& text) {
  std::size_t number = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && stopped == end ? std::optional(number) : std::nullopt;
}

std::vector<std::string> cut(const std::string& line, char separator) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, separator);) cells.push_back(cell);
  return cells;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ",") + word;
  return text;
}

/// "ended with code 1: Unable to contact slurm controller"
std::string end_words(const Ended& ended) {
  const std::string said = last_line(ended.err.empty() ? ended.out : ended.err);
  return fmt::format("ended with code {}: {}", ended.code, said.empty() ? "it said nothing" : said);
}

}  // namespace

bool Task::held() const {
  // "JobHeldUser", "JobHeldAdmin", "launch failed requeued held"
  return phase == Phase::waiting && (reason.find("Held") != std::string::npos || reason.ends_with("held"));
}

Phase phase_of(const std::string& state) {
  const auto known = text::value_of(living_states, state.substr(0, state.find(' ')));
  return known.value_or(Phase::failed);  // TIMEOUT, NODE_FAIL, OUT_OF_MEMORY, CANCELLED, DEADLINE, …
}

std::vector<Task> tasks_of(const std::string& squeue) {
  std::vector<Task> tasks;
  std::istringstream lines(squeue);
  for (std::string line; std::getline(lines, line);) {
    auto cells = cut(line, '|');
    cells.resize(std::max<std::size_t>(cells.size(), 6));
    if (!number_in(cells[0])) continue;
    Task task{cells[0], number_in(cells[1]), cells[2], cells[3], cells[4], cells[5], phase_of(cells[3])};
    if (task.reason == "None") task.reason.clear();
    tasks.push_back(std::move(task));
  }
  return tasks;
}

std::vector<Task> queue(const std::vector<std::string>& names) {
  // --array: a line for each task, also of those that wait; --all: partitions that are hidden, too.
  const Ended ended = run_command({"squeue", "--noheader", "--array", "--all", "--states=all",
                                   "--name=" + joined(names), "--format=%F|%K|%j|%T|%r|%N"});
  if (!ended.well())
    throw InputError(
        fmt::format("squeue {}, so nobody knows which jobs are alive. Look with `scontrol ping` whether Slurm answers, "
                    "and try again",
                    end_words(ended)));
  return tasks_of(ended.out);
}

std::vector<Task> accounts(const std::vector<std::string>& jobs) {
  if (jobs.empty()) return {};
  const Ended ended = run_command({"sacct", "--noheader", "--parsable2", "--allocations", "--jobs=" + joined(jobs),
                                   "--format=JobID,JobName,State,NodeList"});
  std::vector<Task> tasks;
  if (!ended.well()) return tasks;  // most clusters keep accounts, but not all
  std::istringstream lines(ended.out);
  for (std::string line; std::getline(lines, line);) {
    auto cells = cut(line, '|');
    cells.resize(std::max<std::size_t>(cells.size(), 4));
    const auto bar = cells[0].find('_');
    if (!number_in(cells[0].substr(0, bar))) continue;
    tasks.push_back({cells[0].substr(0, bar),
                     bar == std::string::npos ? std::nullopt : number_in(cells[0].substr(bar + 1)), cells[1], cells[2],
                     "", cells[3], phase_of(cells[2])});
  }
  return tasks;
}

std::optional<std::size_t> largest_index() {
  const Ended ended = run_command({"scontrol", "show", "config"});
  std::istringstream lines(ended.out);
  for (std::string line; ended.well() && std::getline(lines, line);) {
    std::istringstream words(line);
    std::string key, equals, value;
    words >> key >> equals >> value;
    if (const auto number = number_in(value); key == "MaxArraySize" && number && *number > 1) return *number - 1;
  }
  return {};
}

namespace {

/// sbatch takes % in the name of an output file, and in the folder before it, for a pattern, and %% for itself.
std::string no_pattern(const std::string& path) {
  std::string text;
  for (const char letter : path) text += letter == '%' ? "%%" : std::string(1, letter);
  return text;
}

}  // namespace

std::vector<std::string> words_of(const Order& order) {
  std::vector<std::string> words{"sbatch",
                                 "--parsable",
                                 "--job-name=" + order.name,
                                 "--requeue",
                                 "--open-mode=append",
                                 "--nodes=1",
                                 "--ntasks=1",
                                 fmt::format("--cpus-per-task={}", order.threads),
                                 "--time=" + order.time,
                                 "--mem=" + order.memory,
                                 "--chdir=" + order.folder.string(),
                                 "--output=" + no_pattern(order.folder.string()) + "/" + order.log};
  if (!order.partition.empty()) words.push_back("--partition=" + order.partition);
  if (!order.array.empty()) words.push_back("--array=" + order.array);
  // afterok would never start after a failed task. The merge itself reports missing specimens.
  if (!order.after.empty()) words.push_back("--dependency=afterany:" + order.after);
  words.push_back(order.script.string());
  return words;
}

std::string submit(const Order& order) {
  if (order.folder.string().find('\\') != std::string::npos)
    throw InputError(
        fmt::format("{}: has a backslash, which sbatch reads as a sign of its own; name a folder without one "
                    "with -o",
                    order.folder.string()));
  const Ended ended = run_command(words_of(order));
  // "4711", or "4711;cluster"
  const std::string line = last_line(ended.out);
  std::string job = line.substr(0, line.find(';'));
  if (!ended.well() || !number_in(job))
    throw InputError(
        fmt::format("sbatch {}. Give it another --partition, --time or --memory where it names them; it also "
                    "reads SBATCH_ACCOUNT, SBATCH_QOS and its other variables",
                    end_words(ended)));
  return job;
}

void cancel(const std::string& job) { run_command({"scancel", job}); }

}  // namespace tunica::cluster::slurm
