// SPDX-License-Identifier: Apache-2.0
#include "step_solver.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::field {
namespace {

constexpr const char* singular = "the stiffness is singular; narrow the bounds of the model's parameters";
constexpr const char* no_edges = "the edges do not follow from the points; give a smaller \"smoothing\"";
// Of the size of the specimen: chords shrink by a fifth or faster.
constexpr double precise_step = 1e-11;
constexpr double loose_step = 1e-5, loose_edge = 1e-4;  ///< of the displacements
constexpr double same_place = 1e-6;                     ///< of the displacements
constexpr double near = 0.1;  ///< of the displacements: what Newton's method may have to move from the measured ones

double largest(const std::vector<double>& of) {
  double most = 0;
  for (const double x : of) most = std::isfinite(x) ? std::max(most, std::abs(x)) : x;
  return most;
}

double size(const Specimen& specimen) { return std::max(specimen.extent(0), specimen.extent(1)); }

}  // namespace

StepSolver::StepSolver(const Meshed& on, std::size_t step, Equilibrium& body, const FlawedSheet* flaws)
    : on_(on),
      step_(step),
      body_(body),
      flaws_(flaws),
      edges_(flaws != nullptr ? flaws->modes() : on.modes(),
             [this](const std::vector<double>& u) { return on_.at_points(this->step(), u); }),
      measured_(FieldRows::measured(on.rows().steps()[step])) {}

Eigen::VectorXd StepSolver::rest(const std::vector<double>& u) const { return measured_ - on_.at_points(step(), u); }

std::vector<double> StepSolver::with_flaws(std::vector<double> u) const {
  if (flaws_ != nullptr) flaws_->move_edges(u);
  return u;
}

std::optional<std::string> StepSolver::settle(bool by_parameters) {
  const Equilibrium::State before = body_.state();
  bool near_by = begin_as_measured() && converge(by_parameters);
  if (!near_by) {
    body_.begin(before);
    if (auto problem = along_the_way()) return problem;
    const Equilibrium::State reached = body_.state();
    near_by = converge(by_parameters);
    if (!near_by) body_.begin(reached);
    if (!near_by && !body_.stay()) return singular;
  }
  u_ = body_.displacements();
  f_ = body_.forces();
  if (near_by) {
    body_.return_to_linearised();
  } else if (by_parameters) {
    if (!body_.linearise(true)) return singular;
    edges_.linearise(body_);
  }
  return {};
}

/// −K⁻¹ f on the inside, and the change of the edges that then fits the points best.
StepSolver::Change StepSolver::next() const {
  Change change{body_.newton_step(), std::vector<double>(body_.displacements().size(), 0.0)};
  std::vector<double> u = body_.displacements();
  for (std::size_t dof = 0; dof < u.size(); ++dof) u[dof] += change.u[dof];
  body_.add_force_change(change.u, change.f);
  edges_.add(edges_.solve(rest(u)), change.u, change.f);
  return change;
}

bool StepSolver::begin_as_measured() {
  if (on_.has_starts()) body_.begin({with_flaws(on_.start(step_)), {}});
  return on_.has_starts();
}

/// Newton's method on the inside and the edges at once, several steps a factor as long as they shrink. The
/// last factor is that of the solution, so that it has the derivatives too. What the points leave makes each new factor
/// move the edges again, by a share of the time before: so the first step of a round is held against that of the round
/// before.
bool StepSolver::converge(bool by_parameters) {
  constexpr int rounds = 12, chords = 8;
  double before = 0, most = near * largest(body_.displacements());
  const double enough = precise_step * size(on_.specimen());
  for (int round = 0; round < rounds; ++round) {
    if (!body_.linearise(by_parameters && round > 0)) return false;
    edges_.linearise(body_);
    double moved = 0;
    for (int chord = 0; chord < chords; ++chord) {
      const Change change = next();
      const double step = largest(change.u);
      if (!std::isfinite(step) || (chord == 0 && step > most) || !body_.move_by(change.u)) return false;
      if (chord == 0) most = step;
      moved += step;
      if (step < enough) {
        // The edges fit best in the metric of their responses, so these have to be those of the solution.
        if (round > 0 && moved < same_place * largest(body_.displacements())) return true;
        break;
      }
      const bool slow = chord > 0 && step > 0.2 * before;
      before = step;
      if (slow) break;
    }
  }
  return false;
}

/// From the step before, with edges that begin as the points near them say, by the method of Levenberg and Marquardt
/// (Moré, Lecture Notes in Mathematics 630:105, 1978). Far from the parameters of the points, undamped steps lead to
/// edges that no material bears. There the best edges are found to a share of the misfit only.
std::optional<std::string> StepSolver::along_the_way() {
  constexpr int trials = 30;
  constexpr double least_damping = 0.02, most_damping = 10, little = 1e-3;
  std::vector<double> prescribed = with_flaws(on_.beginning(step_));
  if (auto problem = body_.move_to(prescribed)) return problem;
  double damping = 0, before = 0;
  bool fresh = true;
  Eigen::VectorXd left = rest(body_.displacements());
  for (int trial = 0; trial < trials && damping < most_damping; ++trial) {
    if (fresh) {
      if (!body_.linearise(false)) return singular;
      edges_.linearise(body_);
    }
    const Eigen::VectorXd change = edges_.solve(left, damping);
    if (!change.allFinite()) return no_edges;
    const double length = change.lpNorm<Eigen::Infinity>();
    const Equilibrium::State state = body_.state();
    std::vector<double> next = prescribed;
    edges_.add(change, next);
    const bool arrived = !body_.move_to(next);
    Eigen::VectorXd then = arrived ? rest(body_.displacements()) : left;
    const bool small = damping == 0 && length < loose_edge * largest(body_.displacements());
    const double gain = 1 - then.squaredNorm() / left.squaredNorm();
    if (arrived && (small || gain >= 0)) {
      if (small || (damping > 0 && gain < little)) return {};
      prescribed = std::move(next);
      left.swap(then);
      if (gain > 0.1 || damping == 0) damping = damping > least_damping ? damping / 5 : 0;
      fresh = damping > 0 || (!fresh && length > 0.2 * before);
      before = length;
    } else {
      body_.begin(state);
      if (!body_.stay()) return singular;
      fresh = false;
      damping = std::max(5 * damping, least_damping);
    }
  }
  return {};
}

std::optional<std::string> StepSolver::nearly_settle(bool by_parameters) {
  begin_as_measured();
  const Equilibrium::State begun = body_.state();
  if (!body_.linearise(false)) return singular;
  edges_.linearise(body_);
  const std::vector<double> f = body_.forces();
  const Change first = next();
  const double step = largest(first.u);
  if (!std::isfinite(step)) return no_edges;
  const bool tried = step <= near * largest(begun.u);
  const bool near_by = tried && chase(first);
  if (tried && !near_by) {
    body_.begin(begun);
    if (!body_.linearise(false)) return singular;
    edges_.linearise(body_);
  }
  u_ = body_.displacements();
  f_ = near_by ? body_.forces() : f;
  if (!near_by)
    for (std::size_t dof = 0; dof < u_.size(); ++dof) {
      u_[dof] += first.u[dof];
      f_[dof] += first.f[dof];
    }
  if (by_parameters && !body_.stay_with_parameters()) return singular;
  return {};
}

/// Several steps a factor as long as they shrink, and a new factor as long as the steps of a round did.
bool StepSolver::chase(Change change) {
  constexpr int rounds = 3, chords = 8;
  const double enough = loose_step * largest(body_.displacements());
  for (int round = 0; round < rounds; ++round) {
    const double first = largest(change.u);
    double before = 1e300;
    for (int chord = 0; chord < chords; ++chord) {
      const double step = largest(change.u);
      if (!(step < 0.2 * before)) break;
      if (!body_.move_by(change.u)) return false;
      if (step < enough) return true;
      before = step;
      change = next();
    }
    if (!(largest(change.u) < first) || round + 1 == rounds || !body_.linearise(false)) return false;
    edges_.linearise(body_);
    change = next();
  }
  return false;
}

void StepSolver::by_parameter(std::size_t j, std::vector<double>& du, std::vector<double>& df) const {
  body_.by_parameter(j, du, df);
  edges_.follow(du, df);
}

bool StepSolver::by_flaw(std::size_t q, std::vector<double>& du, std::vector<double>& df) const {
  const Mode edges = flaws_->edges_by(q, u_);
  const std::vector<double> weights = flaws_->weights_by(q);
  if (edges.empty() && weights.empty()) return false;
  if (edges.empty())
    body_.by_weight(weights, du, df);
  else
    body_.by_edge(edges, du, df);
  edges_.follow(du, df);
  return true;
}

}  // namespace tunica::field
