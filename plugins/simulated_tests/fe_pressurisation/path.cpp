// SPDX-License-Identifier: Apache-2.0
#include "path.hpp"

#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace tunica::fe {
namespace {

constexpr double shortest = 1. / 64;             ///< of what is left to go
constexpr double shortest_of_pressure = 1. / 8;  ///< below it the volume is raised instead
/// Of the volume's logarithm.
constexpr double first_filling = 0.02, most_filling = 0.5, least_filling = 1e-4;
constexpr double far_filling = 0.02;  ///< as `far`: the prediction is better
constexpr double far = 0.05;          ///< Newton's method may move the state so much, over the outer radius

/// y += a x
void add(double a, const State& x, State& y) {
  for (std::size_t i = 0; i < y.x.size(); ++i) y.x[i] += a * x.x[i];
  for (std::size_t i = 0; i < y.q.size(); ++i) y.q[i] += a * x.q[i];
}

void scale(double a, State& y) {
  for (double& value : y.x) value *= a;
  for (double& value : y.q) value *= a;
}

}  // namespace

Path::Path(Solver& solver, const Limits& limits) : solver_(solver), limits_(limits), state_(solver.rest()) {}

Status Path::begin() { return solver_.solve(load_, state_, Aim::state); }

Status Path::return_to(const Mark& mark) {
  load_ = mark.load;
  state_ = mark.state;
  has_previous_ = false;
  return solver_.solve(load_, state_, Aim::state);
}

/// At the last equilibrium, whose factor the solver still has.
void Path::predict(const Load& to, State& guess) {
  const double by = to.pressure - load_.pressure;
  guess = state_;
  if (by != 0) solver_.derive(solver_.by_pressure(), {}, slope_);
  if (to.stretch != load_.stretch) {
    solver_.derive({}, solver_.by_stretch(), stretch_slope_);
    add(to.stretch - load_.stretch, stretch_slope_, guess);
    has_previous_ = false;
  }
  if (by == 0) return;
  if (!has_previous_) {
    add(by, slope_, guess);
    return;
  }
  // Hermite's cubic through the last two states and their slopes, at t > 1.
  const double h = load_.pressure - before_.pressure, t = (to.pressure - before_.pressure) / h;
  scale(t * t * (3 - 2 * t), guess);
  add(h * t * t * (t - 1), slope_, guess);
  add((1 + 2 * t) * (1 - t) * (1 - t), previous_, guess);
  add(h * t * (1 - t) * (1 - t), previous_slope_, guess);
}

/// Why it goes no further than an equilibrium.
Status Path::stuck(const std::string& why, const Load& load, const State& state) const {
  return Status::failed(
      fmt::format("{} after pressure {:.5g} kPa, axial stretch {:.5g}, outer diameter {:.4g} times the unloaded one",
                  why, load.pressure, load.stretch, solver_.outer_radius(state) / solver_.mesh().outer));
}

/// From the guess to the equilibrium at `to`.
Status Path::accept(const Load& to, Aim aim) {
  if (Status status = solver_.solve(to, guess_, aim); !status.ok()) return status;
  const auto& moved = solver_.effort().steps;
  if (std::accumulate(moved.begin(), moved.end(), 0.) > far) return Status::failed("the state jumps");
  // A factor of a state before the last may be indefinite while the solution's is not.
  if (solver_.negative_pivots() > 0 && aim == Aim::state)
    if (Status status = solver_.solve(to, guess_, Aim::factor); !status.ok()) return status;
  if (solver_.negative_pivots() > 0) return Status::failed("the equilibrium is unstable");
  return {};
}

Status Path::step(const Load& to, Aim aim) {
  predict(to, guess_);
  return accept(to, aim);
}

/// Steps of the volume's logarithm, each predicted along the last, until one of them passes the pressure of `to`.
Status Path::fill(const Load& to, Aim aim) {
  const double sign = to.pressure > load_.pressure ? 1 : -1;
  Load load = load_;
  State state = state_, before, next;
  if (Status status = solver_.solve(load, state, Aim::factor); !status.ok()) return status;
  double volume = solver_.volume(state);
  const auto fail = [&](const std::string& why) {
    load_ = load;
    state_ = state;
    has_previous_ = false;
    return stuck(why, load, state);
  };
  for (double part = first_filling, last = 0; true;) {
    if (++steps_ > limits_.steps) return fail(fmt::format("{} load steps were not enough", limits_.steps));
    Load at = load;
    next = state;
    if (last > 0) {
      scale(1 + part / last, next);
      add(-part / last, before, next);
    }
    Status status = solver_.solve_volume(volume * std::exp(sign * part), at, next);
    const auto& moved = solver_.effort().steps;
    if (status.ok() && std::accumulate(moved.begin(), moved.end(), 0.) > far_filling)
      status = Status::failed("the state jumps");
    if (!status.ok() && (part /= 2) > least_filling && !solver_.late()) continue;
    if (!status.ok()) return fail(status.reason());
    if (sign * (at.pressure - load.pressure) <= 0) return fail("the pressure stops rising (limit pressure)");
    // The pressure rises, and yet the tube would leave this path, by a buckle or a bulge.
    if (solver_.negative_pivots() > 0) {
      if ((part /= 2) > least_filling) continue;
      return fail("the equilibrium becomes unstable, by a bulge or a buckle,");
    }
    const double reached = (to.pressure - load.pressure) / (at.pressure - load.pressure);
    if (reached <= 1) {
      guess_ = next;
      scale(reached, guess_);
      add(1 - reached, state, guess_);
      status = accept(to, aim);
      if (status.ok()) {
        state_ = guess_;
        load_ = to;
        has_previous_ = false;
        return {};
      }
      if ((part /= 2) > least_filling && !solver_.late()) continue;
      return fail(status.reason());
    }
    before = state;
    state = next;
    load = at;
    last = part;
    volume *= std::exp(sign * part);
    if (moved.size() <= 4) part = std::min(1.5 * part, most_filling);
  }
}

Status Path::go(const Load& to, Aim aim) {
  double part = 1;
  while (true) {
    if (++steps_ > limits_.steps)
      return stuck(fmt::format("{} load steps were not enough", limits_.steps), load_, state_);
    Load next{load_.stretch + part * (to.stretch - load_.stretch),
              load_.pressure + part * (to.pressure - load_.pressure)};
    if (part == 1) next = to;
    const Status status = step(next, part == 1 ? aim : Aim::state);
    if (status.ok()) {
      const bool pressure_alone = next.stretch == load_.stretch && next.pressure != load_.pressure;
      previous_ = state_;
      previous_slope_ = slope_;
      before_ = load_;
      has_previous_ = pressure_alone;
      state_ = guess_;
      load_ = next;
      if (part == 1) return {};
      part = std::min(1., 2 * part);
      continue;
    }
    part /= 2;
    // The factor is lost: the last equilibrium is found again, and left by its tangent.
    has_previous_ = false;
    if (solver_.late()) return stuck("the time limit is reached", load_, state_);
    if (part < shortest) return stuck(status.reason(), load_, state_);
    if (part < shortest_of_pressure && to.stretch == load_.stretch) return fill(to, aim);
    if (Status back = solver_.solve(load_, state_, Aim::state); !back.ok()) return back;
  }
}

}  // namespace tunica::fe
