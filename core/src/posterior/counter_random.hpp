// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "numerics/distributions.hpp"

namespace tunica::posterior {

/// Random numbers by counting: number k of a key is the finaliser of SplitMix64 at key + k γ, so that it depends on
/// both alone, and on no library. Source: Steele, Lea, Flood, Fast splittable pseudorandom number generators, OOPSLA
/// (2014).
class CounterRandom {
 public:
  explicit CounterRandom(std::uint64_t key) : state_(key) {}

  /// Uniform in (0, 1).
  double uniform() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (static_cast<double>((z ^ (z >> 31)) >> 11) + 0.5) * 0x1p-53;
  }
  double normal() { return numerics::normal_quantile(uniform()); }
  Eigen::VectorXd normals(Eigen::Index count) {
    Eigen::VectorXd numbers(count);
    for (double& number : numbers) number = normal();
    return numbers;
  }
  /// The key whose numbers are those that come next.
  [[nodiscard]] std::uint64_t state() const { return state_; }

 private:
  std::uint64_t state_;
};

}  // namespace tunica::posterior
