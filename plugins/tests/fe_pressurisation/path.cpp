// SPDX-License-Identifier: Apache-2.0
#include "path.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace tunica::fe {
namespace {

constexpr double shortest = 1. / 64;  ///< of what is left to go
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

Status Path::begin() { return solver_.solve(load_, state_, false); }

Status Path::return_to(const Mark& mark) {
  load_ = mark.load, state_ = mark.state, has_previous_ = false;
  return solver_.solve(load_, state_, false);
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

Status Path::step(const Load& to, bool exact) {
  predict(to, guess_);
  if (Status status = solver_.solve(to, guess_, exact); !status.ok()) return status;
  const auto& moved = solver_.effort().steps;
  if (std::accumulate(moved.begin(), moved.end(), 0.) > far) return Status::failed("the state jumps");
  // A factor of a state before the last may be indefinite while the solution's is not.
  if (solver_.negative_pivots() > 0 && !exact)
    if (Status status = solver_.solve(to, guess_, true); !status.ok()) return status;
  if (solver_.negative_pivots() > 0) return Status::failed("the equilibrium is unstable, as beyond a limit pressure");
  return {};
}

Status Path::go(const Load& to, bool exact) {
  double part = 1;
  while (true) {
    if (++steps_ > limits_.steps) return Status::failed(fmt::format("{} load steps were not enough", limits_.steps));
    Load next{load_.stretch + part * (to.stretch - load_.stretch),
              load_.pressure + part * (to.pressure - load_.pressure)};
    if (part == 1) next = to;
    const Status status = step(next, exact && part == 1);
    if (status.ok()) {
      const bool pressure_alone = next.stretch == load_.stretch && next.pressure != load_.pressure;
      previous_ = state_, previous_slope_ = slope_, before_ = load_, has_previous_ = pressure_alone;
      state_ = guess_, load_ = next;
      if (part == 1) return {};
      part = std::min(1., 2 * part);
      continue;
    }
    part /= 2;
    // The factor is lost: the last equilibrium is found again, and left by its tangent.
    has_previous_ = false;
    if (part < shortest || solver_.late())
      return Status::failed(
          fmt::format("{} at pressure {:.5g} kPa, axial stretch {:.5g}", status.reason(), next.pressure, next.stretch));
    if (Status back = solver_.solve(load_, state_, false); !back.ok()) return back;
  }
}

}  // namespace tunica::fe
