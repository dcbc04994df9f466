// SPDX-License-Identifier: Apache-2.0
#include "step_solver.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::field {
namespace {

constexpr const char* singular = "the stiffness is singular; narrow the bounds of the model's parameters";
constexpr const char* no_edges = "the edges do not follow from the points; give a smaller \"smoothing\"";
constexpr const char* not_found =
    "the edges that fit the points best were not found; narrow the bounds of the model's parameters";
// Of the size of the specimen: chords shrink by a fifth or faster, and edges alone by far more.
constexpr double precise_step = 1e-11, precise_edge = 1e-9;
constexpr double same_place = 1e-2;  ///< of the displacements
constexpr double near = 0.1;      ///< of the displacements: what Newton's method may have to move from the measured ones

double largest(const std::vector<double>& of) {
  double most = 0;
  for (const double x : of) most = std::isfinite(x) ? std::max(most, std::abs(x)) : x;
  return most;
}

double size(const Specimen& specimen) { return std::max(specimen.extent(0), specimen.extent(1)); }

}  // namespace

StepSolver::StepSolver(const Meshed& on, std::size_t step, Equilibrium& body)
    : on_(on),
      step_(step),
      body_(body),
      edges_(on.modes(), [this](const std::vector<double>& u) { return on_.at_points(this->step(), u); }),
      measured_(FieldRows::measured(on.rows().steps()[step])) {}

Eigen::VectorXd StepSolver::rest(const std::vector<double>& u) const { return measured_ - on_.at_points(step(), u); }

std::optional<std::string> StepSolver::settle() {
  const Equilibrium::State before = body_.state();
  if (!from_measured()) {
    body_.begin(before);
    if (auto problem = along_the_way()) return problem;
  }
  u_ = body_.displacements();
  f_ = body_.forces();
  return {};
}

/// Newton's method on the inside and the edges at once, several steps a factor as long as they shrink.
bool StepSolver::from_measured() {
  constexpr int rounds = 6, chords = 8;
  body_.begin({on_.start(step_), {}});
  double before = near * largest(body_.displacements());
  for (int round = 0; round < rounds; ++round) {
    if (!body_.linearise(false)) return false;
    edges_.linearise(body_);
    double moved = 0;
    for (int chord = 0; chord < chords; ++chord) {
      std::vector<double> du = body_.newton_step(), df(du.size(), 0.0), u = body_.displacements();
      for (std::size_t dof = 0; dof < u.size(); ++dof) u[dof] += du[dof];
      edges_.add(edges_.solve(rest(u)), du, df);
      const double step = largest(du);
      if (!std::isfinite(step) || (chord == 0 && step > before) || !body_.move_by(du)) return false;
      moved += step;
      if (step < precise_step * size(on_.specimen())) {
        // The edges fit best in the metric of their responses, so these have to be those of the solution.
        if (moved < same_place * largest(body_.displacements())) return true;
        break;
      }
      const bool slow = chord > 0 && step > 0.2 * before;
      before = step;
      if (slow) break;
    }
  }
  return false;
}

/// From the step before, with edges that begin as the points near them say.
std::optional<std::string> StepSolver::along_the_way() {
  constexpr int rounds = 4, chords = 6;
  std::vector<double> prescribed = on_.beginning(step_);
  if (auto problem = body_.move_to(prescribed)) return problem;
  for (int round = 0; round < rounds; ++round) {
    if (!body_.linearise(false)) return singular;
    edges_.linearise(body_);
    for (int chord = 0; chord < chords; ++chord) {
      const Eigen::VectorXd change = edges_.solve(rest(body_.displacements()));
      if (!change.allFinite()) return no_edges;
      edges_.add(change, prescribed);
      if (auto problem = body_.move_to(prescribed)) return problem;
      if (change.lpNorm<Eigen::Infinity>() < precise_edge * size(on_.specimen())) return {};
    }
  }
  return not_found;
}

std::optional<std::string> StepSolver::step_once(bool by_parameters) {
  body_.begin({on_.start(step_), {}});
  if (!body_.linearise(by_parameters)) return singular;
  edges_.linearise(body_);
  std::vector<double> du = body_.newton_step();
  u_ = body_.displacements();
  f_ = body_.forces();
  std::vector<double> df(u_.size(), 0.0), moved = u_;
  body_.add_force_change(du, df);
  for (std::size_t dof = 0; dof < u_.size(); ++dof) moved[dof] += du[dof];
  const Eigen::VectorXd change = edges_.solve(rest(moved));
  if (!change.allFinite()) return no_edges;
  edges_.add(change, du, df);
  for (std::size_t dof = 0; dof < u_.size(); ++dof) {
    u_[dof] += du[dof];
    f_[dof] += df[dof];
  }
  return {};
}

std::optional<std::string> StepSolver::linearise() {
  if (!body_.linearise(true)) return singular;
  edges_.linearise(body_);
  return {};
}

void StepSolver::by_parameter(std::size_t j, std::vector<double>& du, std::vector<double>& df) const {
  body_.by_parameter(j, du, df);
  edges_.follow(du, df);
}

}  // namespace tunica::field
