// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "tunica/maxwell_model.hpp"
#include "uniaxial.hpp"

namespace tunica::uniaxial {

/// What passes along a path share: y = ln λ2² of every row is looked for.
struct PathRows {
  std::span<const double> stretch;
  std::span<const double> u;          ///< λ2²
  std::span<double> step, before;     ///< of Newton's method in y, and the one before
  std::span<double> stress;           ///< σ11 with the step in it
  std::span<double> stress_dp, y_dp;  ///< total derivatives by parameter j of row i at [j·n + i]
};

/// Newton's step in y where r is at_step and dr/dy is −1/by_residual; the same damping for all kinds of memory.
struct NewtonStep {
  static constexpr double farthest = 1e10;
  double largest = 0;  ///< of all rows
  bool sound = true;   ///< no row was lost
  [[gnu::always_inline]] double take(double at_step, double slope, double by_residual, bool rests, double& before) {
    double step = at_step * by_residual;
    sound = sound && (rests || (slope > 0 && std::abs(step) < farthest));
    largest = std::max(largest, std::abs(step));
    step = std::clamp(step, -0.6, 1.5);
    // Where fibres switch, steps may go to and fro across the kink.
    if (step * before < 0 && std::abs(step) > 0.5 * std::abs(before)) step *= 0.5;
    return before = step;
  }
};

/// One pass along the path of a strip whose memory is that of Maxwell branches, in columns over all rows: the same as
/// Pass in memory_path.cpp, which asks the model row by row.
///
/// The recursions of h, of what Newton's steps do to it and of its derivatives by parameters are linear, so that they
/// are the only loops that go from row to row; derivatives by four parameters go together.
class MaxwellPass {
 public:
  static constexpr std::size_t most_branches = 6;

  MaxwellPass(const Strip& strip, const TestInput& input, const PathRows& rows, bool symmetric,
              std::span<const MaxwellModel::Branch> branches);
  Status run(bool parameters);
  [[nodiscard]] bool sound() const { return newton_.sound; }
  [[nodiscard]] double largest_step() const { return newton_.largest; }

 private:
  Status evaluate(bool parameters);
  void relax();
  void prepare();
  void prepare_parameter(std::size_t parameter);
  // Inlined into kernels, which know the vectors of the machine.
  template <std::size_t branches>
  [[gnu::always_inline]] inline void follow();
  template <std::size_t branches>
  [[gnu::always_inline]] inline void differentiate(std::size_t first);

  const Strip& strip_;
  const TestInput& input_;
  const PathRows& rows_;
  std::span<const MaxwellModel::Branch> branches_;
  std::size_t n_, points_, count_, elastic_count_;
  bool symmetric_;
  NewtonStep newton_;
};

}  // namespace tunica::uniaxial
