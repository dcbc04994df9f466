// SPDX-License-Identifier: Apache-2.0
#include "stability/transverse.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "tunica/detail/solve_strip.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::stability {
namespace {

constexpr double step = 5e-4;        // of l = ln λ1, in the five-point formula
constexpr double rest = 2.5 * step;  // closer to λ1 = 1 the slope is taken here
constexpr double tight = 1e-9;       // relative step of u; after it the error is its square

constexpr double no_minimum = 2;  // slope where λ2 = λ3 by symmetry, and W has no minimum there

/// One scratch a thread: constraints are evaluated concurrently, and thousands of times a second.
free_strip::Scratch& thread_scratch() {
  thread_local free_strip::Scratch instance;
  return instance;
}

}  // namespace

FreePath::FreePath(const Model& model, std::size_t axis, std::vector<double> stretches)
    : view_(model), axis_(axis), stretches_(std::move(stretches)) {
  for (const double stretch : stretches_) at_.push_back(std::abs(std::log(stretch)) < rest ? std::exp(rest) : stretch);
  start_ = free_strip::Start(at_);
}

std::string FreePath::strip_at(std::size_t row) const {
  return fmt::format("{} strip at stretch {:.6g}", axis_ == 0 ? "circumferential" : "axial", stretches_[row]);
}

Status FreePath::solve(StripPath path) const {
  std::size_t lost = StripPath::none;
  path.loaded = axis_;
  path.lost = &lost;
  start_.set(path);
  Status status = free_strip::solve(view_, path, thread_scratch());
  if (status.ok() || lost == StripPath::none) return status;
  return Status::failed(strip_at(lost) + ": " + status.reason());
}

/// The rows at exp(l + shift), from u there to their equilibria; they stay evaluated in the scratch.
Status FreePath::solve_shifted(const free_strip::Pull& pull, std::span<const double> stretch,
                               std::span<double> u) const {
  free_strip::Scratch& s = thread_scratch();
  free_strip::Batch batch(pull, stretch, s);
  std::optional<std::size_t> lost;
  Status status = free_strip::iterate(pull, stretch, tight, batch, u, lost);
  if (lost) return Status::failed(strip_at(*lost) + ": " + status.reason());
  if (!status.ok()) return status;
  for (std::size_t i = 0; i < u.size(); ++i) u[i] *= 1 + s.step[i];
  return batch.evaluate(u.data(), true);
}

/// A symmetric state has the slope 0 on its path, stable or not. Where it is no minimum of W over the lateral stretch,
/// any disturbance takes the strip away from it.
Status FreePath::mark_symmetric(const free_strip::Pull& pull, std::span<double> slope) const {
  if (!free_strip::is_symmetric(pull, at_)) return {};
  std::vector<double> u(at_.size());
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = 1 / at_[i];
  free_strip::Scratch& s = thread_scratch();
  free_strip::Batch batch(pull, at_, s);
  if (Status status = batch.evaluate(u.data(), false); !status.ok()) return status;
  for (std::size_t i = 0; i < u.size(); ++i)
    if (!(s.slope[i] > 0)) slope[i] = no_minimum;
  return {};
}

Status FreePath::slopes(std::span<const double> parameters, std::span<double> slope, std::span<double> slope_dp) const {
  const std::size_t n = at_.size();
  const bool exact = !slope_dp.empty() && view_.describe().parameter_derivatives;
  thread_local std::vector<double> y, stress_by_l, stretch, u;
  y.resize(exact ? n : 0);
  stress_by_l.resize(n);
  if (Status status = solve({.parameters = parameters,
                             .stretch = at_,
                             .stress = {},
                             .lateral = y,
                             .stress_by_l = stress_by_l,
                             .lateral_by_l = slope});
      !status.ok())
    return status;
  std::size_t bad = n;
  for (std::size_t i = 0; i < n; ++i) {
    slope[i] = -1 - slope[i];
    if (!std::isfinite(slope[i]) && bad == n) bad = i;
  }
  if (bad < n) return Status::failed(strip_at(bad) + ": the slope of the transverse stretch overflows");
  if (Status status = mark_symmetric({view_, parameters, axis_}, slope); !status.ok()) return status;
  if (slope_dp.empty()) return {};
  if (free_strip::is_symmetric({view_, parameters, axis_}, at_)) {
    std::fill(slope_dp.begin(), slope_dp.end(), 0.0);  // Ψ = 1 whatever the parameters
    return {};
  }
  if (!exact) return difference(parameters, slope_dp);
  // f'(l) ≈ [8 (f(l+δ) − f(l−δ)) − (f(l+2δ) − f(l−2δ))]/(12 δ), f = dy/dp; c has it with the opposite sign.
  static constexpr std::array<std::array<double, 2>, 4> stencil{{{-2, 1}, {-1, -8}, {1, 8}, {2, -1}}};
  std::fill(slope_dp.begin(), slope_dp.end(), 0.0);
  stretch.resize(n);
  u.resize(n);
  const free_strip::Pull pull{view_, parameters, axis_};
  for (const auto& [offset, weight] : stencil) {
    const double shift = offset * step;
    for (std::size_t i = 0; i < n; ++i) {
      stretch[i] = at_[i] * std::exp(shift);
      u[i] = std::exp(y[i] - (1 + slope[i]) * shift);
    }
    if (Status status = solve_shifted(pull, stretch, u); !status.ok()) return status;
    const free_strip::Batch there(pull, stretch, thread_scratch());
    for (std::size_t j = 0; j < parameters.size(); ++j)
      for (std::size_t i = 0; i < n; ++i) {
        double stress_p, y_p;
        there.by_parameter(i, j, stress_p, y_p);
        slope_dp[j * n + i] -= weight / (12 * step) * y_p;
      }
  }
  return {};
}

/// Central differences of the slopes, which are accurate to rounding; step ε^(1/3) of the parameter.
Status FreePath::difference(std::span<const double> parameters, std::span<double> slope_dp) const {
  const std::size_t n = at_.size();
  std::vector<double> moved(parameters.begin(), parameters.end()), above(n), below(n);
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const double h = 6e-6 * std::max(std::abs(parameters[j]), 1e-3);
    moved[j] = parameters[j] + h;
    if (Status status = slopes(moved, above, {}); !status.ok()) return status;
    moved[j] = parameters[j] - h;
    if (Status status = slopes(moved, below, {}); !status.ok()) return status;
    moved[j] = parameters[j];
    for (std::size_t i = 0; i < n; ++i) slope_dp[j * n + i] = (above[i] - below[i]) / (2 * h);
  }
  return {};
}

Status FreePath::states(std::span<const double> parameters, std::span<StripState> states) const {
  const std::size_t n = at_.size();
  std::vector<double> stress(n), y(n), stress_by_l(n), y_by_l(n);
  if (Status status = solve({.parameters = parameters,
                             .stretch = at_,
                             .stress = stress,
                             .lateral = y,
                             .stress_by_l = stress_by_l,
                             .lateral_by_l = y_by_l});
      !status.ok())
    return status;
  std::vector<double> slope(n);
  for (std::size_t i = 0; i < n; ++i) slope[i] = -1 - y_by_l[i];
  if (Status status = mark_symmetric({view_, parameters, axis_}, slope); !status.ok()) return status;
  for (std::size_t i = 0; i < n; ++i) {
    // Close to rest the row was solved a little farther out: back along the tangent, y = y' l, σ ∝ l.
    const bool moved = at_[i] != stretches_[i];
    const double l = std::log(stretches_[i]), y_i = moved ? y_by_l[i] * l : y[i];
    const double lambda2 = std::exp(y_i / 2), lambda3 = 1 / (stretches_[i] * lambda2);
    states[i] = {
        stretches_[i], lambda2, lambda3, stress[i] * (moved ? l / std::log(at_[i]) : 1), std::exp(-2 * (l + y_i)),
        slope[i]};
  }
  return {};
}

namespace {

constexpr double edge = 1 + Problem::constraint_tolerance;  // c ≤ tolerance counts as stable, as in the constraint

/// The results on the path from rest to one side.
struct Course {
  std::optional<double> first_unstable, stable_again;
  double reached = 1, worst = -std::numeric_limits<double>::infinity();
};

/// NaN without a solution.
double slope_at(const Model& model, std::span<const double> parameters, std::size_t axis, double stretch) {
  double slope = std::numeric_limits<double>::quiet_NaN();
  return FreePath(model, axis, {stretch}).slopes(parameters, {&slope, 1}, {}).ok()
             ? slope
             : std::numeric_limits<double>::quiet_NaN();
}

/// From rest to the stretch `limit`, above 1 or below.
Course follow(const Model& model, std::span<const double> parameters, std::size_t axis, double limit) {
  Course course;
  // Between a stable and an unstable stretch, to 1e-10.
  const auto crossing = [&](double stable, double unstable) {
    while (std::abs(unstable - stable) > 1e-10 * unstable) {
      const double middle = 0.5 * (stable + unstable);
      const double slope = slope_at(model, parameters, axis, middle);
      if (!std::isfinite(slope)) break;
      (slope > edge ? unstable : stable) = middle;
    }
    return 0.5 * (stable + unstable);
  };
  // Steps of half a per cent, in blocks, so that an overflow far out costs little.
  constexpr std::size_t block = 48;
  const bool pulled = limit > 1;
  const double growth = pulled ? 1.005 : 1 / 1.005;
  const auto within = [&](double stretch) { return pulled ? stretch <= limit : stretch >= limit; };
  for (double begin = std::exp(pulled ? rest : -rest); within(begin);) {
    std::vector<double> stretches;
    for (double at = begin; stretches.size() < block && within(at); at *= growth) stretches.push_back(at);
    if (!within(stretches.back() * growth) && stretches.back() != limit) stretches.push_back(limit);
    std::vector<double> slopes(stretches.size());
    while (!stretches.empty() &&
           !FreePath(model, axis, stretches).slopes(parameters, {slopes.data(), stretches.size()}, {}).ok())
      stretches.resize(stretches.size() / 2);
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      course.worst = std::max(course.worst, (slopes[i] - 1) / 2);
      if (!course.first_unstable && slopes[i] > edge)
        course.first_unstable = course.reached == 1 ? 1 : crossing(course.reached, stretches[i]);
      else if (course.first_unstable && !course.stable_again && slopes[i] <= edge)
        course.stable_again = crossing(stretches[i], course.reached);
      course.reached = stretches[i];
    }
    if (stretches.size() < block) break;
    begin = course.reached * growth;
  }
  return course;
}

std::optional<bool> stable_at(const Model& model, std::span<const double> parameters, std::size_t axis,
                              const std::vector<double>& stretches) {
  if (stretches.empty()) return std::nullopt;
  const auto stable = [](double slope) { return slope <= edge; };
  std::vector<double> slopes(stretches.size());
  if (FreePath(model, axis, stretches).slopes(parameters, slopes, {}).ok())
    return std::all_of(slopes.begin(), slopes.end(), stable);
  for (const double stretch : stretches)
    if (slope_at(model, parameters, axis, stretch) > edge) return false;
  return std::nullopt;
}

}  // namespace

TransverseVerdict judge_transverse(const Model& model, std::span<const double> parameters, std::size_t axis,
                                   const std::vector<double>& judged, double limit) {
  TransverseVerdict verdict;
  verdict.axis = axis;
  for (const double stretch : judged) {
    verdict.judged_from = std::min(verdict.judged_from, stretch);
    verdict.judged_to = std::max(verdict.judged_to, stretch);
  }
  const Course pulled = follow(model, parameters, axis, std::max(limit, verdict.judged_to));
  verdict.first_unstable = pulled.first_unstable;
  verdict.stable_again = pulled.stable_again;
  verdict.checked_to = pulled.reached;
  verdict.worst_slope = pulled.worst;
  if (verdict.judged_from < 1) {
    const Course pressed = follow(model, parameters, axis, verdict.judged_from);
    verdict.first_unstable_pressed = pressed.first_unstable;
    verdict.checked_from = pressed.reached;
    verdict.worst_slope = std::max(verdict.worst_slope, pressed.worst);
  }
  verdict.stable = stable_at(model, parameters, axis, judged);
  return verdict;
}

}  // namespace tunica::stability
