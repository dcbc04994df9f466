// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "newton_step.hpp"
#include "tunica/maxwell_model.hpp"
#include "uniaxial.hpp"

namespace tunica::uniaxial {

/// The path of a strip whose memory is that of Maxwell branches: the same as Pass in memory_path.cpp, which asks the
/// model row by row, in blocks of rows that stay in the cache of first level.
///
/// Newton's method solves a block at a time, from what the blocks before left in memory, and begins where these point
/// to. Along the rows run only the recursions of h, of what Newton's steps do to it and of its derivatives by
/// parameters: all are linear. Derivatives go as many together as a vector of the machine holds.
class MaxwellPath {
 public:
  static constexpr std::size_t most_branches = 6;
  static constexpr std::size_t block = 64;  ///< rows

  /// `y`: ln λ2² of each row, as a first guess that of the elastic strip. Spans must outlive it.
  MaxwellPath(const Strip& strip, const TestInput& input, std::span<const double> stretch,
              std::span<const MaxwellModel::Branch> branches, std::span<double> y, const PathRows& rows);
  /// False where Newton's method does not end, or the status fails.
  bool solve(bool parameters, Status& status);

 private:
  template <std::size_t branches>
  bool solve_block(bool parameters, Status& status);
  Status evaluate_rest(bool parameters);
  Status evaluate(bool parameters);
  void enter();
  void leave();
  void choose_order(double half_way, double at_end);
  // Inlined into kernels, which know the vectors of the machine.
  [[gnu::always_inline]] inline void prepare();
  template <std::size_t branches>
  [[gnu::always_inline]] inline void remember(bool parameters);
  template <std::size_t branches>
  [[gnu::always_inline]] inline void follow();
  template <std::size_t branches, bool damped>
  [[gnu::always_inline]] inline bool step_along();
  template <std::size_t branches, std::size_t width>
  [[gnu::always_inline]] inline void differentiate(std::size_t first_parameter);

  const Strip& strip_;
  const TestInput& input_;
  std::span<const double> stretch_;
  std::span<const MaxwellModel::Branch> branches_;
  std::span<double> y_;
  const PathRows& rows_;
  std::size_t n_, count_, elastic_count_;
  std::size_t first_ = 0, size_ = 0;  ///< the rows of the block
  std::size_t order_ = 0;             ///< of the polynomial that points to the next block
  NewtonStep newton_;
};

}  // namespace tunica::uniaxial
