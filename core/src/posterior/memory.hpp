// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tunica::posterior {

/// Where a chain stands after a move of its warm-up, or at a draw: all that what follows depends on.
struct Step {
  std::vector<double> z;                        ///< coordinates of target.hpp
  double log_density = 0;                       ///< there
  double acceptance = 0;                        ///< probability with which the tangent move was taken
  double size = 0;                              ///< of the next tangent move
  std::uint64_t random = 0;                     ///< state of the random numbers
  std::uint64_t evaluations = 0, failures = 0;  ///< so far, of this chain
};

/// What remembers the steps of the chains of a run, so that one that was killed goes on from them. Chains draw side by
/// side, each from one thread at a time.
class Memory {
 public:
  virtual ~Memory() = default;
  /// The steps that are kept of this question, chain by chain, each from its first one on; empty where what is kept
  /// belongs to another question.
  virtual std::vector<std::vector<Step>> recall(const std::string& question, std::size_t chains,
                                                std::size_t parameters) = 0;
  /// Step `index` of a chain, counted from 0. What is kept of that chain from there on is no longer right.
  virtual void keep(std::size_t chain, std::size_t index, const Step& step) = 0;
};

}  // namespace tunica::posterior
