// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "tunica/status.hpp"

namespace tunica::es {

/// What selection sees of an individual: feasible before infeasible before failed, infeasible ones by their violation
/// (Deb 2000), then the objective, then the order of evaluation, which breaks ties the same way everywhere. Under a
/// constant penalty all violations are 0 here.
struct Fitness {
  Status::Kind kind = Status::Kind::failed;
  double violation = 0;
  double objective = 0;  ///< 0 when failed
  std::uint64_t index = 0;

  friend bool operator<(const Fitness& a, const Fitness& b) {
    if (a.kind != b.kind) return a.kind < b.kind;
    if (a.violation != b.violation) return a.violation < b.violation;
    if (a.objective != b.objective) return a.objective < b.objective;
    return a.index < b.index;
  }
};

/// Individuals side by side in flat arrays, allocated once: rows of positions x, of the mutation vectors that led
/// to them (in units of the step, as it was realised inside the box), and of their own step sizes.
class Population {
 public:
  Population(std::size_t capacity, std::size_t dimension, std::size_t steps)
      : n_(dimension),
        k_(steps),
        positions_(capacity * n_),
        mutations_(capacity * n_),
        steps_(capacity * k_),
        fitness_(capacity) {}

  [[nodiscard]] std::span<double> position(std::size_t i) { return {positions_.data() + i * n_, n_}; }
  [[nodiscard]] std::span<double> mutation(std::size_t i) { return {mutations_.data() + i * n_, n_}; }
  [[nodiscard]] std::span<double> steps(std::size_t i) { return {steps_.data() + i * k_, k_}; }
  [[nodiscard]] Fitness& fitness(std::size_t i) { return fitness_[i]; }
  [[nodiscard]] std::span<const double> position(std::size_t i) const { return {positions_.data() + i * n_, n_}; }
  [[nodiscard]] std::span<const double> mutation(std::size_t i) const { return {mutations_.data() + i * n_, n_}; }
  [[nodiscard]] std::span<const double> steps(std::size_t i) const { return {steps_.data() + i * k_, k_}; }
  [[nodiscard]] const Fitness& fitness(std::size_t i) const { return fitness_[i]; }
  [[nodiscard]] std::span<const double> positions(std::size_t count) const { return {positions_.data(), count * n_}; }
  [[nodiscard]] std::size_t capacity() const { return fitness_.size(); }

  void copy(std::size_t to, const Population& other, std::size_t from) {
    std::ranges::copy(other.position(from), position(to).begin());
    std::ranges::copy(other.mutation(from), mutation(to).begin());
    std::ranges::copy(other.steps(from), steps(to).begin());
    fitness_[to] = other.fitness_[from];
  }

 private:
  std::size_t n_, k_;
  std::vector<double> positions_, mutations_, steps_;
  std::vector<Fitness> fitness_;
};

}  // namespace tunica::es
