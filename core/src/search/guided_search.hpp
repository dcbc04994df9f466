// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "assembly/assembly.hpp"
#include "search/calibration_problem.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::search {

/// Minimises a costly problem with the help of a cheap one whose residuals are nearly the same.
///
///   1. The optimizer searches the cheap problem in the whole box; its best point becomes the centre x₀. A start that
///      an earlier stage has found is taken for the centre instead.
///   2. The costly problem is linearised at x₀: one evaluation with its Jacobian.
///   3. The optimizer searches the cheap problem, corrected to the first order at x₀ (correction.hpp), in a trust
///      region |x − x₀| ≤ Δ, and the costly problem is linearised at its best point x₁.
///   4. With q = (f(x₀) − f(x₁)) / (f(x₀) − m(x₁)), m the corrected problem: where f(x₁) < f(x₀), x₁ is the new centre;
///      Δ is halved where q < 1/4, quartered where the point was no better, and doubled where q > 3/4.
///   5. Again from 3, until Δ < `least_radius`, the costly problem has to stop, or `most_idle` corrected searches in
///      turn promised less than `promise` of the objective (and `perfect`, for perfect fits). Such a search costs no
///      simulation; the next one has a quarter of Δ, where random numbers find more.
///
/// Values and derivatives of the corrected problem equal those of the costly one at every centre. The search therefore
/// ends at a stationary point of the costly problem. All counted points and the answer belong to the costly problem.
/// The cheap problem only determines which of several minima is found.
///
/// Source: Alexandrov et al. (2001), see correction.hpp; the rule for Δ after A. R. Conn, N. I. M. Gould, Ph. L. Toint,
/// Trust-Region Methods (2000), algorithm 6.1.1.
class GuidedSearch {
 public:
  static constexpr double first_radius = 0.25, least_radius = 1e-7, promise = 1e-8, perfect = 1e-14;
  static constexpr int most_rounds = 40, most_idle = 3;
  /// Evaluations of a corrected search: a tenth of the limit of the whole search, but at least this many.
  static constexpr std::uint64_t least_evaluations = 4000;

  /// Minimises with a new object of the chosen optimizer.
  using Minimise = std::function<Optimizer::Outcome(Problem&)>;

  /// `settings` are those of the costly problem; its recording and its replay are not used. All must outlive the
  /// search.
  GuidedSearch(const assembly::Assembly& guide, const CalibrationProblem::Settings& settings, Minimise minimise)
      : guide_(guide), settings_(settings), minimise_(std::move(minimise)) {}

  /// `begun`: the start of the costly problem was found by an earlier stage.
  Optimizer::Outcome run(CalibrationProblem& costly, bool begun);
  /// Evaluations of the cheap problem so far.
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  /// A point of the unit box with all known values of the costly problem there.
  struct Linearised {
    std::vector<double> x, residuals, jacobian;
    double objective = 0, violation = 0;
  };
  /// Searches the cheap problem; empty when nothing could be evaluated. `found` is in the unit box of the whole.
  Best search(const Correction& correction, std::span<const double> start, std::uint64_t evaluations, int round);
  Correction uncorrected() const;
  /// False where the cheap problem cannot be evaluated at the centre.
  bool correct(const Linearised& at, double radius, Correction& correction) const;

  const assembly::Assembly& guide_;
  const CalibrationProblem::Settings& settings_;
  const Minimise minimise_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::uint64_t evaluations_ = 0;
};

}  // namespace tunica::search
