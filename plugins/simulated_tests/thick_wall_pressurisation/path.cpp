// SPDX-License-Identifier: Apache-2.0
#include "path.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace tunica::thick_wall {
namespace {

constexpr double largest_step = 0.1, largest_after_success = 0.5;  ///< of y = ln ri
constexpr double largest_axial_step = 0.1;                         ///< of ln λz
constexpr double smallest_step = 1e-9;
constexpr double farthest = 4.6;                                        ///< the inner radius may grow a hundredfold
constexpr double good_enough = 1e-3, settled_to = 1e-6, nearby = 0.05;  ///< of y
constexpr int budget = 1000;                                            ///< evaluations for one segment

}  // namespace

Status Path::begin(Equilibrium& at) {
  at = {.y = std::log(wall_.Ri)};
  const Section rest{at.axial_stretch, at.y};
  if (Status status = sections_.evaluate({&rest, 1}, {}); !status.ok()) return status;
  const WallForces forces = sections_.forces(0);
  at.p = forces.p;
  at.p_y = forces.p_y;
  at.p_axial = forces.p_axial;
  if (std::isfinite(at.p) && std::isfinite(at.p_axial) && at.p_y > 0) return {};
  return Status::failed(at.p_y <= 0 ? "the unloaded tube is not stable" : "the energy overflows in the unloaded tube");
}

/// Newton's correction of y towards the trial's own pressure, and the slopes there.
Path::Trouble Path::evaluate(Equilibrium& trial, double support_free, double& correction) {
  const Section section{trial.axial_stretch, trial.y};
  if (!sections_.evaluate({&section, 1}, {}).ok()) return Trouble::overflow;
  const WallForces forces = sections_.forces(0);
  double p = forces.p;
  trial.p_y = forces.p_y;
  trial.p_axial = forces.p_axial;
  if (trial.supported) {
    p += support(wall_, trial.y, trial.axial_stretch, support_free);
    trial.p_y += support_slope(wall_, trial.y, trial.axial_stretch);
  }
  if (!std::isfinite(p) || !std::isfinite(trial.p_y)) return Trouble::overflow;
  if (!(trial.p_y > 0)) return Trouble::falling;
  correction = (trial.p - p) / trial.p_y;
  return Trouble::none;
}

/// Newton's method at the trial's axial stretch and pressure from its y, until the next correction is small, and half
/// as long as the move before; it is applied without being evaluated again. `step` is what the predictor moved.
Path::Trouble Path::correct(Equilibrium& trial, double support_free, double step) {
  double before = std::abs(step), correction = 0;
  for (int iteration = 0; iteration < 5; ++iteration) {
    if (const Trouble found = evaluate(trial, support_free, correction); found != Trouble::none) return found;
    const double size = std::abs(correction);
    if (!(size <= 0.5 * before + good_enough)) return Trouble::not_contracting;
    trial.y += correction;
    if (size <= settled_to || (size <= good_enough && size <= 0.5 * before)) return Trouble::none;
    before = size;
  }
  return Trouble::not_contracting;
}

/// Where fibres are just left or taken up, p_y changes a hundredfold within 1e-3, and a correction that looked small
/// was short. The next step must not begin at such a state, however small it is: plain Newton's method brings it to its
/// own pressure, near by and on a rising branch, or leaves it as it is.
void Path::settle(Equilibrium& at, double support_free) {
  at.settled = true;
  Equilibrium exact = at;
  double correction = 1;
  for (int iteration = 0; iteration < 20 && std::abs(correction) > settled_to; ++iteration) {
    if (evaluate(exact, support_free, correction) != Trouble::none) return;
    exact.y += correction;
    if (!(std::abs(exact.y - at.y) <= nearby)) return;
  }
  if (std::abs(correction) <= settled_to) at = exact;
}

Status Path::follow(Equilibrium& at, double axial_stretch, double p, double support_free) {
  const double from_axial = at.axial_stretch, from_p = at.p, begun = at.y;
  const bool same_axial = axial_stretch == from_axial;
  if (!same_axial) at.has_before = false;
  if (support_free > 0 && wall_.tether != 0 && !at.supported) {  // nothing yet: this is where it begins to act
    at.p_y += support_slope(wall_, at.y, at.axial_stretch);
    at.supported = true;
    at.has_before = false;
  }
  double done = 0, share = 1, cap = largest_step;
  if (!same_axial) share = std::min(1., largest_axial_step / std::abs(std::log(axial_stretch / from_axial)));
  const double largest_share = share;
  Trouble last = Trouble::none;
  for (int trial = 0; trial < budget && done < 1; ++trial) {
    Equilibrium next = at;
    const double end = done + share >= 1 ? 1 : done + share;
    next.axial_stretch = end == 1 ? axial_stretch : from_axial + end * (axial_stretch - from_axial);
    next.p = end == 1 ? p : from_p + end * (p - from_p);
    const double dp = next.p - at.p;
    double step = (dp - at.p_axial * (next.axial_stretch - at.axial_stretch)) / at.p_y;
    if (at.has_before && at.p != at.before_p) {
      const double bend = 0.5 * dp * dp * (1 / at.p_y - at.before_u) / (at.p - at.before_p);
      if (std::abs(bend) < 0.5 * std::abs(step)) step += bend;
    }
    if (!(std::abs(step) <= cap * (1 + 1e-9))) {
      share *= std::clamp(0.9 * cap / std::abs(step), 1e-6, 0.9);
      if (share < 1e-12) break;
      continue;
    }
    if (std::abs(next.y + step - begun) > farthest) {
      last = Trouble::none;
      break;
    }
    next.y += step;
    last = correct(next, support_free, step);
    if (last == Trouble::none && same_axial && std::abs(dp) > 0 && std::abs(step) > 1e-3 &&
        !rises(dp, next.y - at.y, at.p_y, next.p_y))
      last = Trouble::not_contracting;  // look closer
    if (last != Trouble::none) {
      if (!at.settled) {
        settle(at, support_free);
        continue;
      }
      share = 0.5 * (end - done);
      cap = largest_step;
      if (std::abs(step) < smallest_step || share < 1e-12) break;
      continue;
    }
    next.settled = false;
    next.has_before = same_axial;
    next.before_p = at.p;
    next.before_u = 1 / at.p_y;
    at = next;
    done = end;
    share = std::min(2 * share, largest_share);
    cap = std::min(1.5 * cap, largest_after_success);
  }
  return done == 1 ? Status() : Status::failed(words(at, last, p));
}

std::string Path::words(const Equilibrium& at, Trouble trouble, double p) const {
  const std::string reached = fmt::format("{:.6g} kPa at axial stretch {:.6g} and outer diameter stretch {:.6g}", at.p,
                                          at.axial_stretch, outer_radius(wall_, at.y, at.axial_stretch) / wall_.Ro);
  if (trouble == Trouble::overflow)
    return fmt::format("the energy overflows or is undefined on the path from rest, beyond {}", reached);
  if (p < at.p) return fmt::format("the tube collapses on the path from rest: {} was reached", reached);
  return fmt::format("the pressure stops rising on the path from rest (limit pressure): {} was reached", reached);
}

}  // namespace tunica::thick_wall
