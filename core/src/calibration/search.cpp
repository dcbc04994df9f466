// SPDX-License-Identifier: Apache-2.0
#include "calibration/search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace tunica::calibration {
namespace {

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

/// Coordinates may leave the unit box by rounding, no further.
constexpr double rounding = 1e-9;

Status check_point(std::span<const double> x) {
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (x[j] >= -rounding && x[j] <= 1 + rounding) continue;
    return Status::failed(fmt::format("the optimiser asked for coordinate {} = {}, outside the unit box", j, x[j]));
  }
  return {};
}

void check_length(std::size_t found, std::size_t expected, const char* what) {
  if (found != expected) {
    throw std::invalid_argument(
        fmt::format("the optimiser passed {} {} where the problem has {}", found, what, expected));
  }
}

}  // namespace

Assembly::WorkspacePointer WorkspacePool::take() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      Assembly::WorkspacePointer workspace = std::move(idle_.back());
      idle_.pop_back();
      return workspace;
    }
  }
  return assembly_.make_workspace();
}

void WorkspacePool::give(Assembly::WorkspacePointer workspace) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(workspace));
}

Common::Common(const Assembly& assembly_, const CalibrationProblem::Settings& settings_)
    : assembly(assembly_),
      settings(settings_),
      parameters(assembly.parameters().size()),
      tests(assembly.test_count()),
      start(settings.start.empty() ? assembly.initial_unit() : settings.start),
      watch(settings.elapsed_before),
      pool(assembly),
      replaying(static_cast<bool>(settings.replay)) {}

void Evaluations::grow(std::size_t count, bool jacobian, std::size_t parameter_count, std::size_t test_count) {
  calls.push_back({size(), count, jacobian});
  const std::size_t total = size() + count;
  parameters.resize(total * parameter_count), per_test.resize(total * test_count);
  objectives.resize(total), seconds.resize(total), statuses.resize(total);
}

void Evaluations::clear() {
  calls.clear(), parameters.clear(), per_test.clear(), objectives.clear(), seconds.clear(), statuses.clear();
}

Search::Search(Common& common, Ledger ledger_, std::optional<std::uint64_t> replay_from,
               const std::atomic<bool>* needless)
    : ledger(std::move(ledger_)), common_(common), replay_from_(replay_from), needless_(needless) {}

bool Search::should_stop() const {
  if (ledger.stopped()) return true;
  const auto& settings = common_.settings;
  if (needless_ != nullptr && *needless_) ledger.stop("not needed");
  if (settings.interrupted && settings.interrupted()) ledger.stop("interrupted");
  if (settings.stop.max_time && common_.watch.seconds() >= *settings.stop.max_time) ledger.stop("max_time");
  if (ledger.budget() == 0) ledger.stop("max_evaluations");
  return ledger.stopped();
}

Status Search::refusal() const { return Status::failed("stopped: " + ledger.stop_reason()); }

void Search::contradict(std::size_t slot, std::string what) {
  if (!made.contradiction.empty()) return;
  made.contradicted = slot;
  made.contradiction = fmt::format(
      "evaluation {} of the journal cannot be continued: {}. The experiment file, a plugin or the seed has changed "
      "since "
      "it was written; restore them, or start anew without --resume",
      *replay_from_ + ledger.tally().evaluations + (slot - made.calls.back().first) + 1, what);
}

bool Search::replay(std::span<const double> x, std::size_t slot) {
  if (!common_.replaying || !replay_from_ || !made.contradiction.empty()) return false;
  const std::uint64_t index = *replay_from_ + ledger.tally().evaluations + (slot - made.calls.back().first);
  if (!common_.settings.replay(index, entry_)) {
    common_.replaying = false;
    return false;
  }
  const std::size_t n = common_.parameters;
  const std::span<double> free = std::span(made.parameters).subspan(slot * n, n);
  common_.assembly.from_unit(x, free);
  if (entry_.parameters.size() != n || entry_.per_test.size() != common_.tests) {
    contradict(slot, fmt::format("it has {} parameters and {} tests where the run has {} and {}",
                                 entry_.parameters.size(), entry_.per_test.size(), n, common_.tests));
    return false;
  }
  for (std::size_t j = 0; j < n; ++j) {
    if (same_bits(entry_.parameters[j], free[j])) continue;
    contradict(slot, fmt::format("{} was {} and is now {}", common_.assembly.parameters()[j].name, entry_.parameters[j],
                                 free[j]));
    return false;
  }
  std::copy(entry_.per_test.begin(), entry_.per_test.end(),
            made.per_test.begin() + static_cast<std::ptrdiff_t>(slot * common_.tests));
  made.objectives[slot] = entry_.objective, made.statuses[slot] = entry_.status;
  made.seconds[slot] = entry_.seconds;
  common_.watch.catch_up(entry_.seconds);
  return true;
}

/// The evaluation proper; touches nothing but its slot, so that slots run side by side.
Status Search::evaluate_at(std::span<const double> x, std::size_t slot, std::span<double> residuals,
                           std::span<double> jacobian, Assembly::Workspace& workspace) {
  const std::size_t n = common_.parameters, tests = common_.tests;
  const std::span<double> free = std::span(made.parameters).subspan(slot * n, n);
  const std::span<double> per_test = std::span(made.per_test).subspan(slot * tests, tests);
  common_.assembly.from_unit(x, free);
  if (Status status = check_point(x); !status.ok()) return status;
  const auto evaluate = [&](std::span<const double> point) {
    common_.assembly.from_unit(point, free);
    return common_.assembly.evaluate(free, made.objectives[slot], per_test, residuals, jacobian, workspace,
                                     common_.settings.skip_costly);
  };
  Status status = evaluate(x);
  if (status.kind() == Status::Kind::failed && common_.settings.on_failure == experiment::OnFailure::retry) {
    if (const auto good = good_.nearest(x); !good.empty()) {
      status = continue_to(good, x, std::move(status), evaluate);
      common_.assembly.from_unit(x, free);
    }
  }
  if (status.kind() != Status::Kind::failed) common_.assembly.jacobian_to_unit(free, jacobian, workspace);
  return status;
}

void Search::count(std::span<const double> xs, const Evaluations::Call& call) {
  const std::size_t n = common_.parameters;
  for (std::size_t k = 0; k < call.size; ++k) {
    const std::size_t slot = call.first + k;
    const Status& status = made.statuses[slot];
    ledger.add(std::span(made.parameters).subspan(slot * n, n), made.objectives[slot], status, call.jacobian);
    if (status.ok() && common_.settings.on_failure == experiment::OnFailure::retry) good_.add(xs.subspan(k * n, n));
  }
}

Status Search::evaluate(std::span<const double> x, double& objective) {
  Status status;
  evaluate_batch(x, {&objective, 1}, {&status, 1});
  return status;
}

void Search::evaluate_batch(std::span<const double> xs, std::span<double> objectives, std::span<Status> statuses) {
  const std::size_t n = common_.parameters, asked = objectives.size();
  check_length(xs.size(), asked * n, "coordinates");
  check_length(statuses.size(), asked, "statuses");
  std::size_t count = 0;
  if (!should_stop()) {
    count = static_cast<std::size_t>(std::min<std::uint64_t>(asked, ledger.budget()));
    made.grow(count, false, n, common_.tests);
    const Evaluations::Call call = made.calls.back();
    std::size_t replayed = 0;
    while (replayed < count && replay(xs.subspan(replayed * n, n), call.first + replayed)) ++replayed;
    const auto evaluate_range = [&](std::size_t first, std::size_t last) {
      const WorkspacePool::Loan workspace(common_.pool);
      for (std::size_t k = first; k < last; ++k) {
        made.statuses[call.first + k] = evaluate_at(xs.subspan(k * n, n), call.first + k, {}, {}, *workspace);
      }
    };
    if (count - replayed <= 1 || tbb::this_task_arena::max_concurrency() == 1) {
      evaluate_range(replayed, count);
    } else {
      // The partitioner splits only as far as threads ask for work, so that tasks stay long against their overhead.
      // Isolated: a thread that waits here must not begin another search in between.
      tbb::this_task_arena::isolate([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(replayed, count),
                          [&](const auto& range) { evaluate_range(range.begin(), range.end()); });
      });
    }
    const double now = replayed < count ? common_.watch.seconds() : 0;
    std::fill(made.seconds.begin() + static_cast<std::ptrdiff_t>(call.first + replayed), made.seconds.end(), now);
    this->count(xs, call);
    for (std::size_t k = 0; k < count; ++k) {
      statuses[k] = made.statuses[call.first + k];
      if (statuses[k].kind() != Status::Kind::failed) objectives[k] = made.objectives[call.first + k];
    }
  }
  for (std::size_t k = count; k < asked; ++k) statuses[k] = refusal();
}

Status Search::linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                         std::span<double> jacobian) {
  const std::size_t n = common_.parameters, m = common_.assembly.residual_count();
  check_length(x.size(), n, "coordinates");
  check_length(residuals.size(), m, "residuals");
  if (!jacobian.empty()) check_length(jacobian.size(), m * n, "entries of the Jacobian");
  if (should_stop()) return refusal();
  made.grow(1, !jacobian.empty(), n, common_.tests);
  const Evaluations::Call call = made.calls.back();
  const std::size_t slot = call.first;
  const bool replayed = replay(x, slot);
  const double before = made.objectives[slot];
  const Status status_before = made.statuses[slot];
  const WorkspacePool::Loan workspace(common_.pool);
  made.statuses[slot] = evaluate_at(x, slot, residuals, jacobian, *workspace);  // residuals are not in the journal
  const Status& status = made.statuses[slot];
  if (replayed && status.kind() != status_before.kind()) {
    contradict(slot,
               fmt::format("its status was '{}' and is now '{}'", name(status_before.kind()), name(status.kind())));
  } else if (replayed && status.kind() != Status::Kind::failed && !same_bits(before, made.objectives[slot])) {
    contradict(slot, fmt::format("the objective was {} and is now {}", before, made.objectives[slot]));
  }
  if (!replayed) made.seconds[slot] = common_.watch.seconds();
  count(x, call);
  if (status.kind() != Status::Kind::failed) objective = made.objectives[slot];
  return status;
}

Status Search::constraints(std::span<const double> x, std::span<double> values, std::span<double> jacobian) const {
  const std::size_t n = common_.parameters, m = common_.assembly.constraint_count();
  check_length(x.size(), n, "coordinates");
  check_length(values.size(), m, "constraint values");
  if (!jacobian.empty()) check_length(jacobian.size(), m * n, "entries of the constraints' Jacobian");
  if (Status status = check_point(x); !status.ok()) return status;
  std::vector<double> free(n);
  common_.assembly.from_unit(x, free);
  if (Status status = common_.assembly.constraints(free, values, jacobian); !status.ok() || jacobian.empty())
    return status;
  const WorkspacePool::Loan workspace(common_.pool);
  common_.assembly.jacobian_to_unit(free, jacobian, *workspace);
  return {};
}

}  // namespace tunica::calibration
