// SPDX-License-Identifier: Apache-2.0
#include "search/oracle.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include "assembly/workspace.hpp"
#include "plugins/calls.hpp"
#include "plugins/casualties.hpp"

namespace tunica::search {
namespace {

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

/// Coordinates may leave the unit box only by rounding.
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

std::size_t workers_for(std::size_t pieces) {
  return std::min(static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()), pieces);
}

/// Isolated: a thread that waits here must not begin another search in between.
template <class Work>
void on_workers(std::size_t workers, const Work& work) {
  if (workers <= 1) return work();
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(
        std::size_t{0}, workers, [&](std::size_t) { work(); }, tbb::simple_partitioner());
  });
}

}  // namespace

assembly::WorkspacePointer WorkspacePool::take() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      assembly::WorkspacePointer workspace = std::move(idle_.back());
      idle_.pop_back();
      return workspace;
    }
  }
  return assembly_.evaluator().make_workspace();
}

void WorkspacePool::give(assembly::WorkspacePointer workspace) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(workspace));
}

SharedState::SharedState(const assembly::Assembly& assembly_, const CalibrationProblem::Settings& settings_)
    : assembly(assembly_),
      settings(settings_),
      box(settings.correction ? assembly.box().between(settings.correction->lower, settings.correction->upper)
                              : assembly.box()),
      parameters(assembly.layout().parameters.size()),
      tests(assembly.layout().test_count),
      start(settings.start.empty() ? box.initial() : settings.start),
      watch(settings.elapsed_before),
      pool(assembly),
      replaying(static_cast<bool>(settings.replay)) {}

Oracle::Oracle(SharedState& shared, Ledger ledger_, std::optional<std::uint64_t> replay_from,
               const std::atomic<bool>* needless)
    : ledger(std::move(ledger_)), shared_(shared), replay_from_(replay_from), needless_(needless) {}

bool Oracle::should_stop() const {
  if (ledger.stopped()) return true;
  const auto& settings = shared_.settings;
  if (needless_ != nullptr && *needless_) ledger.stop(StopReason::not_needed);
  if (settings.interrupted && settings.interrupted()) ledger.stop(StopReason::interrupted);
  if (settings.stop.max_time && shared_.watch.seconds() >= *settings.stop.max_time) ledger.stop(StopReason::max_time);
  if (ledger.budget() == 0) ledger.stop(StopReason::max_evaluations);
  return ledger.stopped();
}

Status Oracle::refusal() const { return Status::failed("stopped: " + ledger.stop_sentence()); }

void Oracle::contradict(std::size_t slot, std::string what) {
  if (!made.contradiction.empty()) return;
  made.contradicted = slot;
  made.contradiction = fmt::format(
      "evaluation {} of the journal cannot be continued: {}. The experiment file, a plugin or the seed has changed "
      "since it was written; restore them, or start anew without --resume",
      *replay_from_ + ledger.tally().evaluations + (slot - made.calls.back().first) + 1, what);
}

bool Oracle::replay(std::span<const double> x, std::size_t slot) {
  if (!shared_.replaying || !replay_from_ || !made.contradiction.empty()) return false;
  const std::uint64_t index = *replay_from_ + ledger.tally().evaluations + (slot - made.calls.back().first);
  if (!shared_.settings.replay(index, entry_)) {
    shared_.replaying = false;
    return false;
  }
  const std::size_t n = shared_.parameters;
  const std::span<double> free = std::span(made.parameters).subspan(slot * n, n);
  shared_.box.from_unit(x, free);
  if (entry_.parameters.size() != n || entry_.per_test.size() != shared_.tests) {
    contradict(slot, fmt::format("it has {} parameters and {} tests where the run has {} and {}",
                                 entry_.parameters.size(), entry_.per_test.size(), n, shared_.tests));
    return false;
  }
  for (std::size_t j = 0; j < n; ++j) {
    if (same_bits(entry_.parameters[j], free[j])) continue;
    contradict(slot, fmt::format("{} was {} and is now {}", shared_.assembly.layout().parameters[j].name,
                                 entry_.parameters[j], free[j]));
    return false;
  }
  std::copy(entry_.per_test.begin(), entry_.per_test.end(),
            made.per_test.begin() + static_cast<std::ptrdiff_t>(slot * shared_.tests));
  made.objectives[slot] = entry_.objective;
  made.statuses[slot] = entry_.status;
  made.seconds[slot] = entry_.seconds;
  made.ended_early[slot] = entry_.ended_early ? 1 : 0;
  shared_.watch.catch_up(entry_.seconds);
  return true;
}

/// The evaluation proper. It writes only to its slot, so slots run in parallel.
Status Oracle::evaluate_at(std::span<const double> x, std::size_t slot, std::span<double> residuals,
                           std::span<double> jacobian, assembly::Workspace& workspace, bool bound_only) {
  const std::size_t n = shared_.parameters, tests = shared_.tests;
  const std::span<double> free = std::span(made.parameters).subspan(slot * n, n);
  const std::span<double> per_test = std::span(made.per_test).subspan(slot * tests, tests);
  shared_.box.from_unit(x, free);
  if (Status status = check_point(x); !status.ok()) return status;
  const auto& max_time = shared_.settings.stop.max_time;
  const plugins::Call whole{nullptr, "evaluation", nullptr, nullptr,
                            max_time ? shared_.watch.reaches(*max_time) : plugins::Clock::time_point::max()};
  const plugins::CallScope scope(whole);
  const assembly::CostlyTests costly = bound_only                     ? assembly::CostlyTests::nowhere
                                       : shared_.settings.skip_costly ? assembly::CostlyTests::where_feasible
                                                                      : assembly::CostlyTests::everywhere;
  const Correction* const correction = shared_.settings.correction;
  if (correction != nullptr && residuals.empty()) {
    workspace.residuals.resize(correction->offset.size());
    residuals = workspace.residuals;
  }
  const auto evaluate = [&](std::span<const double> point) {
    if (point.data() != x.data()) shared_.box.from_unit(point, free);
    return shared_.assembly.evaluator().evaluate(free, made.objectives[slot], per_test, residuals, jacobian, workspace,
                                                 costly);
  };
  Status status = evaluate(x);
  if (status.kind() == Status::Kind::failed && shared_.settings.on_failure == experiment::OnFailure::retry) {
    if (const auto good = good_.nearest(x); !good.empty()) {
      status = continue_to(good, x, status, evaluate);
      shared_.box.from_unit(x, free);
    }
  }
  plugins::set_evaluated();
  if (status.kind() == Status::Kind::failed) shared_.watch.add(plugins::take_time_lost());
  if (status.kind() == Status::Kind::failed) return status;
  if (!jacobian.empty()) shared_.box.jacobian_to_unit(free, jacobian);
  if (correction != nullptr) {
    made.objectives[slot] = correction->apply(x, shared_.assembly.layout().blocks, residuals, jacobian);
    if (!std::isfinite(made.objectives[slot])) return Status::failed("the corrected objective overflows");
  }
  return status;
}

bool Oracle::is_over() const {
  const auto& settings = shared_.settings;
  return (settings.interrupted && settings.interrupted()) ||
         (settings.stop.max_time && shared_.watch.seconds() >= *settings.stop.max_time);
}

std::size_t Oracle::keep(std::size_t replayed, std::size_t known) {
  const Evaluations::Call call = made.calls.back();
  const auto& interrupted = shared_.settings.interrupted;
  if (interrupted && interrupted()) {
    const auto begin = made.statuses.begin() + static_cast<std::ptrdiff_t>(call.first);
    const auto broken_off =
        std::find_if(begin + static_cast<std::ptrdiff_t>(replayed), begin + static_cast<std::ptrdiff_t>(known),
                     [](const Status& status) { return status.kind() == Status::Kind::failed; });
    known = static_cast<std::size_t>(broken_off - begin);
  }
  if (known < call.size) made.cut_call(known, shared_.parameters, shared_.tests);
  return known;
}

void Oracle::count(std::span<const double> xs, const Evaluations::Call& call) {
  const std::size_t n = shared_.parameters;
  for (std::size_t k = 0; k < call.size; ++k) {
    const std::size_t slot = call.first + k;
    const Status& status = made.statuses[slot];
    ledger.add(std::span(made.parameters).subspan(slot * n, n), made.objectives[slot], status, call.jacobian,
               made.extent(slot, shared_.tests));
    if (status.ok() && shared_.settings.on_failure == experiment::OnFailure::retry) good_.add(xs.subspan(k * n, n));
  }
}

Status Oracle::evaluate(std::span<const double> x, double& objective) {
  Status status;
  evaluate_batch(x, {&objective, 1}, {&status, 1});
  return status;
}

std::size_t Oracle::evaluate_slots(std::span<const double> xs, std::size_t first, std::span<const std::size_t> points,
                                   bool bound_only) {
  const std::size_t n = shared_.parameters, count = points.size();
  // Cheap points come in groups, because a single one is not worth a thread.
  const std::size_t least = bound_only || !shared_.assembly.layout().has_costly_tests ? 4 : 1;
  const std::size_t workers = workers_for((count + least - 1) / least);
  // Each worker takes half of its share of the rest, down to one point. All workers then end within one evaluation
  // (guided self-scheduling: C. D. Polychronopoulos, D. J. Kuck, IEEE Trans. Comput. 36 (1987) 1425).
  std::atomic<std::size_t> next = 0, end = count;
  const auto work = [&] {
    std::size_t from = next.load(std::memory_order_relaxed);
    if (from >= end) return;
    const WorkspacePool::Loan workspace(shared_.pool);
    while (from < end) {
      const std::size_t to = from + std::max<std::size_t>(1, (count - from) / (2 * workers));
      if (!next.compare_exchange_weak(from, to, std::memory_order_relaxed)) continue;
      for (std::size_t k = from; k < std::min(to, end.load(std::memory_order_relaxed)); ++k) {
        if (is_over()) {
          for (std::size_t last = end; k < last && !end.compare_exchange_weak(last, k);) {
          }
          return;
        }
        made.statuses[first + points[k]] =
            evaluate_at(xs.subspan(points[k] * n, n), first + points[k], {}, {}, *workspace, bound_only);
      }
      from = next.load(std::memory_order_relaxed);
    }
  };
  on_workers(workers, work);
  return end;
}

/// In the order of their lower bounds, until no remaining point can be among the lowest.
void Oracle::simulate_early(std::span<const double> xs, const Evaluations::Call& call, std::size_t replayed) {
  const std::size_t n = shared_.parameters;
  on_workers(workers_for(early_.size()), [&] {
    const WorkspacePool::Loan workspace(shared_.pool);
    while (!is_over()) {
      const auto taken = early_.take();
      if (!taken) return;
      const std::size_t slot = call.first + taken->point;
      if (taken->point >= replayed)
        made.statuses[slot] = evaluate_at(xs.subspan(taken->point * n, n), slot, {}, {}, *workspace);
      const bool counts = made.statuses[slot].ok() && made.ended_early[slot] == 0;
      early_.found(*taken, counts ? std::optional(made.objectives[slot]) : std::nullopt);
    }
  });
}

std::size_t Oracle::evaluate_lowest(std::span<const double> xs, std::size_t best, std::size_t replayed) {
  const Evaluations::Call call = made.calls.back();
  points_.resize(call.size - replayed);
  std::iota(points_.begin(), points_.end(), replayed);
  const auto& settings = shared_.settings;
  // A lower bound would hide failures, so it is used only under the policy that ignores them.
  const bool early = settings.end_early && settings.skip_costly && best < call.size &&
                     shared_.assembly.layout().has_costly_tests && settings.max_failure_rate >= 1 &&
                     settings.on_failure == experiment::OnFailure::penalise;
  if (!early) return replayed + evaluate_slots(xs, call.first, points_, false);
  // Bounds of replayed points are computed again, because the order of work depends on them.
  const auto first = static_cast<std::ptrdiff_t>(call.first), known = static_cast<std::ptrdiff_t>(replayed);
  const auto tests = static_cast<std::ptrdiff_t>(shared_.tests);
  const std::vector<double> objectives(made.objectives.begin() + first, made.objectives.begin() + first + known);
  const std::vector<double> per_test(made.per_test.begin() + first * tests,
                                     made.per_test.begin() + (first + known) * tests);
  const std::vector<Status> statuses(made.statuses.begin() + first, made.statuses.begin() + first + known);
  points_.resize(call.size);
  std::iota(points_.begin(), points_.end(), std::size_t{0});
  const std::size_t bounded = evaluate_slots(xs, call.first, points_, true);
  // The choice of simulated points depends on the bounds of all points and on all simulated values.
  const auto broken_off = [&](bool incomplete) {
    if (!settings.interrupted || !settings.interrupted()) return false;
    const auto fresh = made.statuses.begin() + first + known;
    return incomplete || std::any_of(fresh, made.statuses.end(),
                                     [](const Status& status) { return status.kind() == Status::Kind::failed; });
  };
  if (broken_off(bounded < call.size)) return replayed;
  const std::vector<double> bounds(made.objectives.begin() + first, made.objectives.end());
  const std::vector<double> costs(made.per_test.begin() + first * tests, made.per_test.end());
  early_.clear();
  for (std::size_t k = 0; k < bounded; ++k)
    if (made.statuses[call.first + k].ok()) early_.add(k, made.objectives[call.first + k]);
  std::copy(objectives.begin(), objectives.end(), made.objectives.begin() + first);
  std::copy(per_test.begin(), per_test.end(), made.per_test.begin() + first * tests);
  std::copy(statuses.begin(), statuses.end(), made.statuses.begin() + first);
  early_.begin(best);
  simulate_early(xs, call, replayed);
  if (broken_off(!early_.is_complete())) return replayed;
  const auto left = early_.left();
  for (const std::size_t k : left) made.ended_early[call.first + k] = 1;
  for (const std::size_t k : left.first(early_.needless())) {  // what is written of them is their bound
    if (k < replayed) continue;
    made.objectives[call.first + k] = bounds[k];
    made.statuses[call.first + k] = {};
    std::copy_n(costs.begin() + static_cast<std::ptrdiff_t>(k) * tests, tests,
                made.per_test.begin() + (first + static_cast<std::ptrdiff_t>(k)) * tests);
  }
  return std::max(bounded, replayed);
}

void Oracle::evaluate_best(std::span<const double> xs, std::size_t best, std::span<double> objectives,
                           std::span<Status> statuses) {
  const std::size_t n = shared_.parameters, asked = objectives.size();
  check_length(xs.size(), asked * n, "coordinates");
  check_length(statuses.size(), asked, "statuses");
  std::size_t count = 0;
  if (!should_stop()) {
    count = static_cast<std::size_t>(std::min<std::uint64_t>(asked, ledger.budget()));
    made.grow(count, false, n, shared_.tests);
    Evaluations::Call call = made.calls.back();
    std::size_t replayed = 0;
    while (replayed < count && replay(xs.subspan(replayed * n, n), call.first + replayed)) ++replayed;
    if (replayed < count) {
      call.size = keep(replayed, evaluate_lowest(xs, best, replayed));
      if (call.size < count) static_cast<void>(should_stop());  // notes why, for the refusals
      count = call.size;
    }
    const double now = replayed < count ? shared_.watch.seconds() : 0;
    std::fill(made.seconds.begin() + static_cast<std::ptrdiff_t>(call.first + replayed), made.seconds.end(), now);
    this->count(xs, call);
    for (std::size_t k = 0; k < count; ++k) {
      statuses[k] = made.statuses[call.first + k];
      if (statuses[k].kind() != Status::Kind::failed) objectives[k] = made.objectives[call.first + k];
    }
  }
  for (std::size_t k = count; k < asked; ++k) statuses[k] = refusal();
}

Status Oracle::linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                         std::span<double> jacobian) {
  const std::size_t n = shared_.parameters, m = shared_.assembly.layout().residual_count;
  check_length(x.size(), n, "coordinates");
  check_length(residuals.size(), m, "residuals");
  if (!jacobian.empty()) check_length(jacobian.size(), m * n, "entries of the Jacobian");
  if (should_stop()) return refusal();
  made.grow(1, !jacobian.empty(), n, shared_.tests);
  const Evaluations::Call call = made.calls.back();
  const std::size_t slot = call.first;
  const bool replayed = replay(x, slot);
  const double before = made.objectives[slot];
  const Status status_before = made.statuses[slot];
  const WorkspacePool::Loan workspace(shared_.pool);
  shared_.assembly.evaluator().remember(&secant_, *workspace);
  made.statuses[slot] = evaluate_at(x, slot, residuals, jacobian, *workspace);  // residuals are not in the journal
  shared_.assembly.evaluator().remember(nullptr, *workspace);
  if (!replayed && keep(0, 1) == 0) {
    static_cast<void>(should_stop());
    return refusal();
  }
  const Status& status = made.statuses[slot];
  if (replayed && status.kind() != status_before.kind()) {
    contradict(slot,
               fmt::format("its status was '{}' and is now '{}'", name(status_before.kind()), name(status.kind())));
  } else if (replayed && status.kind() != Status::Kind::failed && !same_bits(before, made.objectives[slot])) {
    contradict(slot, fmt::format("the objective was {} and is now {}", before, made.objectives[slot]));
  }
  if (!replayed) made.seconds[slot] = shared_.watch.seconds();
  count(x, call);
  if (status.kind() != Status::Kind::failed) objective = made.objectives[slot];
  return status;
}

Status Oracle::constraints(std::span<const double> x, std::span<double> values, std::span<double> jacobian) const {
  const std::size_t n = shared_.parameters, m = shared_.assembly.constraints().count();
  check_length(x.size(), n, "coordinates");
  check_length(values.size(), m, "constraint values");
  if (!jacobian.empty()) check_length(jacobian.size(), m * n, "entries of the constraints' Jacobian");
  if (Status status = check_point(x); !status.ok()) return status;
  std::vector<double> free(n);
  shared_.box.from_unit(x, free);
  if (Status status = shared_.assembly.constraints().evaluate(free, values, jacobian); !status.ok() || jacobian.empty())
    return status;
  shared_.box.jacobian_to_unit(free, jacobian);
  return {};
}

}  // namespace tunica::search
