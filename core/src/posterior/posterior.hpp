// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "posterior/bands.hpp"
#include "posterior/convergence.hpp"
#include "posterior/draws.hpp"

namespace tunica::posterior {

constexpr std::size_t chain_count = 4;
/// Chains agree below this R̂, and quantiles can be read from this effective sample size on (Vehtari et al. 2021).
constexpr double largest_r_hat = 1.01, least_effective_size = 400;

/// One parameter.
struct Marginal {
  double mean = 0, sd = 0;
  double lower = 0, median = 0, upper = 0;  ///< 2.5, 50 and 97.5 %
  Convergence convergence;
};

/// Draws from the posterior of a run (Question in target.hpp), and their statistics.
struct Posterior {
  Status status;                ///< failed: no draws
  bool complete = false;        ///< false: interrupted, or time was over; then there are no chains
  bool factor_known = true;     ///< all σ are stated, and nothing contradicts them
  bool factor_assumed = false;  ///< of a discrepancy: known for want of rows to estimate it from
  std::vector<Chain> chains;
  std::vector<Marginal> parameters;
  Bands bands;
  std::size_t evaluations = 0, failures = 0;

  [[nodiscard]] std::size_t draws() const { return chains.size() * (chains.empty() ? 0 : chains.front().draws()); }
  /// The worst of all parameters.
  [[nodiscard]] double r_hat() const;
  [[nodiscard]] double effective_size() const;
  [[nodiscard]] bool converged() const { return r_hat() <= largest_r_hat && effective_size() >= least_effective_size; }
};

/// `draws` of all four chains together, rounded up to a multiple of four. A chain depends on seed and number alone, so
/// that the outcome is the same for any number of threads. `measured` and `discrepancy` as in question_at(). Steps that
/// `memory` has of the same question are not made again, whatever number of draws they were made for.
Posterior sample(const assembly::Assembly& assembly, std::span<const double> best, std::size_t draws,
                 std::uint64_t seed, const std::function<bool()>& interrupted = {},
                 std::span<const double> measured = {}, bool discrepancy = false, Memory* memory = nullptr);

}  // namespace tunica::posterior
