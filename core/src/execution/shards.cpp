// SPDX-License-Identifier: Apache-2.0
#include "execution/shards.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "execution/checkpoint.hpp"
#include "execution/files.hpp"
#include "execution/recovery.hpp"
#include "execution/run_directory.hpp"
#include "tunica/error.hpp"

namespace tunica::execution {

namespace {

/// Folders of parts, in the order of their names.
std::vector<std::filesystem::path> parts_of(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> parts;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(own_folder(directory / "shards"), error))
    if (std::filesystem::exists(own_folder(entry.path()) / "checkpoint.json")) parts.push_back(entry.path());
  std::sort(parts.begin(), parts.end());
  return parts;
}

/// The rows of each task of a part that is not running.
std::map<std::size_t, std::string> rows_of(const std::filesystem::path& part, const EvaluationTable& table,
                                           const std::vector<Task>& tasks, std::vector<std::string>& damages) {
  // Repairs the files of a killed part.
  const Recovered mended = recover(part, table, tasks, std::vector<bool>(tasks.size(), false));
  damages.insert(damages.end(), mended.damages.begin(), mended.damages.end());
  std::map<std::size_t, std::string> rows;
  const auto add = [&](const std::filesystem::path& file, std::size_t header) {
    std::ifstream stream(file, std::ios::binary);
    EvaluationTable::Row row;
    std::string line;
    for (std::size_t number = 1; std::getline(stream, line); ++number) {
      if (number <= header) continue;
      table.parse(line, row);
      const auto task = std::find_if(tasks.begin(), tasks.end(), [&row](const Task& one) {
        return one.run == row.run && one.realisation == row.realisation;
      });
      if (task != tasks.end()) rows[static_cast<std::size_t>(task - tasks.begin())] += line + '\n';
    }
  };
  add(Journal::main_file(part), 1);
  for (std::size_t task = 0; task < tasks.size(); ++task) add(Journal::part_file(part, task), 0);
  return rows;
}

void refuse_missing(const Plan& plan, const std::filesystem::path& directory,
                    const std::map<std::size_t, std::string>& finished) {
  if (finished.size() == plan.tasks.size()) return;
  std::size_t first = 0;
  while (finished.contains(first)) ++first;
  throw InputError(
      fmt::format("{}: {} of {} searches are not finished, the first is realisation {} of {}. Run the shards that are "
                  "missing, with the same -o",
                  directory.string(), plan.tasks.size() - finished.size(), plan.tasks.size(),
                  plan.tasks[first].realisation, plan.runs[plan.tasks[first].run].label));
}

}  // namespace

std::filesystem::path shard_folder(const std::filesystem::path& directory, const Share& share) {
  return own_folder(own_folder(directory / "shards") / fmt::format("{}of{}", share.part, share.of));
}

void gather_shards(const Plan& plan, const std::filesystem::path& directory,
                   const std::function<void(const std::string&)>& noticed) {
  const EvaluationTable table = plan.table();
  Facts facts = facts_of(plan);
  const std::string& input = plan.experiment->input_json;
  std::map<std::size_t, std::string> finished, rows;
  std::optional<std::string> level;  // of all parts
  const auto parts = parts_of(directory);
  if (parts.empty())
    throw InputError(fmt::format(
        "{}: holds no part of a run, so there is nothing to merge. Make the parts first, with `--shard k/N` "
        "and the same -o",
        directory.string()));
  for (const auto& part : parts) {
    const auto held = RunDirectory::reopen(part, {});  // refuses one that is still at work
    Checkpoint checkpoint = read_checkpoint(part);
    refuse_changes(part, checkpoint.facts, facts, input);
    const std::string& its_level = checkpoint.facts.vector_level;
    level = level && *level != its_level ? "several" : its_level;
    auto own = rows_of(part, table, plan.tasks, checkpoint.damages);
    if (noticed)
      for (const std::string& sentence : checkpoint.damages) noticed(sentence);
    for (const auto& [task, result] : checkpoint.finished) {
      if (task >= plan.tasks.size() || finished.contains(task)) continue;
      finished[task] = checkpoint_entry(task, result);
      rows[task] = std::move(own[task]);
    }
  }
  refuse_missing(plan, directory, finished);
  facts.vector_level = *level;
  make_folder(own_folder(directory / "parts"));
  for (const auto& [task, text] : rows) write_atomically(Journal::part_file(directory, task), text);
  write_atomically(Journal::main_file(directory), table.header());
  write_atomically(directory / "input.json", input);
  write_checkpoint(directory, facts, finished);
}

}  // namespace tunica::execution
