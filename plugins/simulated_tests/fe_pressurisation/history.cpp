// SPDX-License-Identifier: Apache-2.0
#include "history.hpp"

#include <algorithm>
#include <map>

namespace tunica::fe {
namespace {

constexpr double first_part = 1. / 4096, growth = 4;  ///< of a time step, where a row is not found at once

/// States without pressure at equilibrium, by axial stretch.
Status free_states(Simulation& simulation, std::span<const Load> loads, std::map<double, State>& free) {
  Solver& solver = simulation.solver();
  solver.hold_ends(simulation.tube().ends == Ends::clamped);
  Path path(solver, {simulation.tube().steps});
  if (Status status = path.begin(); !status.ok()) return status;
  for (const Load& load : loads) {
    if (free.contains(load.stretch)) continue;
    if (Status status = path.go({load.stretch, 0}, Aim::state); !status.ok()) return status;
    free.emplace(load.stretch, path.state());
  }
  return {};
}

/// The state jumps where a long time passes at once: then first as if hardly any had, and more of it little by little.
Status reach(Path& path, const Load& load, History& history) {
  const Path::Mark before = path.mark();
  Status status = path.go(load, Aim::state);
  if (status.ok() || !history.timed || history.time_step == 0) return status;
  const double whole = history.time_step;
  for (double part = first_part; part <= 1; part *= growth) {
    history.time_step = part * whole;
    if (part == first_part)
      if (Status back = path.return_to(before); !back.ok()) return back;
    if (Status next = path.go(load, Aim::state); !next.ok()) return next;
  }
  return {};
}

}  // namespace

Status follow_history(Simulation& simulation, Material& material, std::span<const Load> loads,
                      std::span<const double> time, double support, std::vector<Sample>& samples,
                      std::size_t& failed_at) {
  Solver& solver = simulation.solver();
  const Tube& tube = simulation.tube();
  samples.assign(loads.size(), {});
  failed_at = 0;
  solver.assembly().support = {};
  solver.set_time_limit(tube.time_limit);
  material.follow(nullptr);
  if (Status status = solver.begin(material); !status.ok()) return status;
  const bool hold_later = tube.ends == Ends::clamped_after_stretch;
  std::map<double, State> free;
  if (hold_later || support != 0)
    if (Status status = free_states(simulation, loads, free); !status.ok()) return status;

  History history;
  history.timed = !time.empty();
  material.follow(&history);
  solver.hold_ends(tube.ends == Ends::clamped);
  Path path(solver, {tube.steps});
  for (std::size_t i = 0; i < loads.size(); ++i) {
    failed_at = i;
    if (history.timed) history.time_step = i == 0 ? std::max(0.0, time[0]) : time[i] - time[i - 1];
    if (i == 0)
      if (Status status = path.begin(); !status.ok()) return status;
    if (!free.empty() && (i == 0 || loads[i].stretch != loads[i - 1].stretch)) {
      if (i == 0)
        if (Status status = path.go({loads[i].stretch, 0}, Aim::state); !status.ok()) return status;
      const State& at = free.at(loads[i].stretch);
      if (hold_later) {
        solver.hold_at(at);
        solver.hold_ends(true);
      }
      if (support != 0) solver.assembly().support = support_of(solver, at, support);
      if (Status status = path.return_to(path.mark()); !status.ok()) return status;
    }
    if (Status status = reach(path, loads[i], history); !status.ok()) return status;
    samples[i].value = path.observed();
    if (Status status = solver.assembly().remember(material, path.state()); !status.ok()) return status;
    std::swap(history.before, history.after);
  }
  material.follow(nullptr);
  return {};
}

}  // namespace tunica::fe
