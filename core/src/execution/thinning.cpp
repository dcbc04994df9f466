// SPDX-License-Identifier: Apache-2.0
#include "execution/thinning.hpp"

#include <fstream>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "execution/files.hpp"
#include "execution/journal.hpp"
#include "tunica/error.hpp"

namespace tunica::execution {
namespace {

/// The lines of a journal that improved on the lines before them.
std::string improvements(const std::filesystem::path& file, const EvaluationTable& table) {
  std::ifstream stream(file, std::ios::binary);
  std::string line, kept;
  std::getline(stream, line);
  kept = line + '\n';
  std::map<std::pair<std::size_t, std::uint64_t>, search::Best> best;  // by run and realisation
  EvaluationTable::Row row;
  search::JournalEntry entry;
  while (std::getline(stream, line)) {
    table.parse(line, row);
    table.values(row, entry);
    if (entry.ended_early || entry.status.kind() == Status::Kind::failed) continue;
    search::Best found{entry.parameters, entry.objective, row.index, entry.status.violation()};
    search::Best& so_far = best[{row.run, row.realisation}];
    if (!found.better_than(so_far)) continue;
    so_far = std::move(found);
    kept += line + '\n';
  }
  return kept;
}

}  // namespace

void thin_evaluations(const Plan& plan, const std::filesystem::path& directory) {
  Checkpoint checkpoint = read_checkpoint(directory);
  if (!checkpoint.facts.thinned) {
    checkpoint.facts.thinned = true;
    write_checkpoint(directory, checkpoint);
  }
  const auto file = Journal::main_file(directory);
  write_atomically(file, improvements(file, plan.table()));
}

void refuse_unfinished(const std::filesystem::path& directory, const Checkpoint& checkpoint, std::size_t tasks) {
  if (checkpoint.finished.size() == tasks && checkpoint.damages.empty()) return;
  throw InputError(
      fmt::format("{}: {} of {} searches are not in checkpoint.json any more, and evaluations.csv holds improvements "
                  "only, so that they cannot be made again from it; start anew with another -o",
                  directory.string(), tasks - std::min(tasks, checkpoint.finished.size()), tasks));
}

Recovered thinned_journal(const Checkpoint& checkpoint, std::size_t tasks) {
  Recovered found;
  found.evaluations.resize(tasks);
  found.stored.rows.assign(tasks, 0);
  for (const auto& [task, result] : checkpoint.finished)
    if (task < tasks) found.stored.rows[task] = result.tally.evaluations;
  found.stored.head = tasks - 1;
  return found;
}

}  // namespace tunica::execution
