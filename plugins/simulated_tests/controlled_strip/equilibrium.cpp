// SPDX-License-Identifier: Apache-2.0
#include "equilibrium.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::controlled_strip {
namespace {

constexpr int iterations = 60, halvings = 30;
/// A step of Newton's method below this leaves an error of its square.
constexpr double settled = 1e-9;
/// The longest step, in l and in y: beyond it exponentials overflow before they slow the iteration down.
constexpr double longest = 0.5;

/// f = value of the controlled quantity − what is wanted, r = lateral. The equations of a prescribed stretch are linear
/// in l, so that the same steps serve both.
struct Step {
  double l = 0, y = 0;
};
bool step_of(const Slope& f, double wanted, const Slope& r, Step& step) {
  const double determinant = f.by_l * r.by_y - f.by_y * r.by_l;
  const double residual = f.value - wanted;
  step.l = -(residual * r.by_y - f.by_y * r.value) / determinant;
  step.y = -(f.by_l * r.value - r.by_l * residual) / determinant;
  return std::isfinite(step.l) && std::isfinite(step.y);
}

bool newton(StripPoint& point, const RestLength& rest, Control control, double wanted, double time_step, Place& at,
            bool by_parameters) {
  Place place = at;
  if (!point.evaluate(place.l, place.y, time_step)) return false;
  for (int k = 0; k < iterations; ++k) {
    Step step;
    if (!step_of(controlled(control, point, rest, place), wanted, point.lateral(), step)) return false;
    const double size = std::max(std::abs(step.l), std::abs(step.y));
    double share = std::min(1.0, longest / size);
    Place next;
    for (int half = 0;; ++half, share *= 0.5) {
      next = {place.l + share * step.l, place.y + share * step.y};
      const bool last = size < settled;
      if (point.evaluate(next.l, next.y, time_step, last && by_parameters) && std::isfinite(point.stress().value) &&
          std::isfinite(point.lateral().value))
        break;
      if (half == halvings) return false;
    }
    place = next;
    if (size >= settled) continue;
    at = place;
    return true;
  }
  return false;
}

}  // namespace

/// σ λ1^−k with the measured λ1: ∂/∂l = (∂σ/∂l − k σ ∂ ln λ1/∂l) λ1^−k. A prescribed stretch is the felt e^l itself.
Slope controlled(Control control, const StripPoint& point, const RestLength& rest, Place at) {
  if (control == Control::stretch) {
    const double stretch = std::exp(at.l);
    return {stretch, stretch, 0};
  }
  const RestLength::Measured measured = rest.measured(at.l);
  const double k = power(control), factor = std::exp(-k * measured.l);
  const Slope& stress = point.stress();
  return {stress.value * factor, (stress.by_l - k * stress.value * measured.by_felt) * factor, stress.by_y * factor};
}

bool find_equilibrium(StripPoint& point, const RestLength& rest, Control control, double value, double time_step,
                      Place& at, bool by_parameters) {
  // A stretch is known: the lateral faces begin where an isotropic strip would have them.
  Place guess = at;
  if (control == Control::stretch) {
    guess.l = std::log(value);
    guess.y -= guess.l - at.l;
  }
  if (newton(point, rest, control, value, time_step, guess, by_parameters)) {
    at = guess;
    return true;
  }
  if (!point.evaluate(at.l, at.y, time_step)) return false;
  const double before = controlled(control, point, rest, at).value;
  for (const int parts : {8, 64}) {
    Place trial = at;
    bool found = true;
    for (int k = 1; k <= parts && found; ++k) {
      const double part = k == parts ? value : before + (value - before) * k / parts;
      found = newton(point, rest, control, part, time_step, trial, by_parameters && k == parts);
    }
    if (!found) continue;
    at = trial;
    return true;
  }
  return false;
}

}  // namespace tunica::controlled_strip
