// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "text/codes.hpp"

/// Slurm's own commands, called with fixed words: sbatch, squeue, sacct, scancel, scontrol.
namespace tunica::cluster::slurm {

enum class Phase {
  waiting,  ///< for nodes, for another job, or after a requeue
  running,
  ended,  ///< its program returned 0
  failed
};
inline constexpr text::Codes<Phase, 4> phase_codes{
    {{Phase::waiting, "waiting"}, {Phase::running, "running"}, {Phase::ended, "ended"}, {Phase::failed, "failed"}}};

/// A job, or a task of a job array.
struct Task {
  std::string job;                  ///< the number that sbatch gave
  std::optional<std::size_t> part;  ///< its index in the array; none for a plain job
  std::string name, state, reason, nodes;
  Phase phase = Phase::waiting;

  [[nodiscard]] bool alive() const { return phase == Phase::waiting || phase == Phase::running; }
  /// It is held by a user, or by Slurm after a failed start, and waits until it is released.
  [[nodiscard]] bool held() const;
};

/// What a state of squeue or sacct means, TIMEOUT for example. sacct adds words to some: "CANCELLED by 0".
Phase phase_of(const std::string& state);

/// Tasks as `squeue --format=%F|%K|%j|%T|%r|%N` prints them; lines of another kind are left out.
std::vector<Task> tasks_of(const std::string& squeue);

/// The jobs of these names that Slurm still knows, those that ended a few minutes ago among them. Throws InputError
/// where squeue does not answer: without it the submitted jobs are unknown.
std::vector<Task> queue(const std::vector<std::string>& names);

/// The jobs of these numbers from the accounts; empty where a cluster keeps none.
std::vector<Task> accounts(const std::vector<std::string>& jobs);

/// The largest index of a job array, MaxArraySize − 1; none where Slurm does not answer.
std::optional<std::size_t> largest_index();

/// The resources that a job requests.
struct Order {
  std::string name, array;  ///< array: "1-7", empty for a plain job
  std::string after;        ///< numbers of jobs, joined by ':', after whose end it starts, however they end
  std::string time, memory, partition;
  unsigned threads = 1;
  std::filesystem::path folder;  ///< the job stands in it
  std::string log;               ///< below `folder`; %a is the index in the array
  std::filesystem::path script;
};

/// The words of sbatch for it.
std::vector<std::string> words_of(const Order& order);

/// Submits, and returns the number of the job. Throws InputError with what sbatch said.
std::string submit(const Order& order);

/// Cancels a job. A job that has already ended is not an error.
void cancel(const std::string& job);

}  // namespace tunica::cluster::slurm
