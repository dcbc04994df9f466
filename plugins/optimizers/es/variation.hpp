// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "population.hpp"
#include "settings.hpp"

namespace tunica::es {

/// Boost's engine and ziggurat normals give the same numbers on every platform; the standard library's do not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double normal() { return normal_(engine_); }
  std::size_t below(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(uniform() * static_cast<double>(count)));
  }

 private:
  boost::random::mt19937_64 engine_;
  boost::random::normal_distribution<double> normal_;
};

/// Makes offspring of parents: recombination, mutation of the step sizes, mutation of the position, return into the
/// box. Holds what the strategy learns about directions, the covariance C of successful mutations. Parents are given
/// best first. Nothing is allocated after construction.
class Variation {
 public:
  Variation(const Settings& settings, std::size_t dimension);

  /// Step sizes an individual carries: one, or one an axis.
  [[nodiscard]] static std::size_t steps_each(Adaptation adaptation, std::size_t dimension) {
    return adaptation == Adaptation::axes ? dimension : 1;
  }
  /// Once a generation: the weighted means that global recombination uses.
  void prepare(const Population& parents, std::size_t count);
  /// Offspring i of the prepared parents.
  void make(const Population& parents, std::size_t count, Population& offspring, std::size_t i, Random& random);
  /// Self-adaptive steps: updates C by the mutations that led to the selected parents; those older than `first_mutant`
  /// have none.
  void learn(const Population& parents, std::size_t count, std::uint64_t first_mutant);
  /// Cumulative steps: updates C, the step and their paths by the best offspring of the generation, given by rank.
  void follow(const Population& offspring, std::span<const std::size_t> best);
  [[nodiscard]] bool cumulative() const { return settings_.step_control == StepControl::cumulative; }
  /// Largest standard deviation of a mutation along a coordinate, with the mean step of the prepared parents.
  [[nodiscard]] double spread() const;

 private:
  void weigh(std::size_t count);
  [[nodiscard]] double longest_step() const;
  void recombine(const Population& parents, std::size_t count, Population& offspring, std::size_t i, Random& random);
  void mutate(std::span<double> x, std::span<const double> origin, std::span<const double> steps, Random& random);

  const Settings& settings_;
  std::size_t n_, weighed_ = 0;
  double learning_, learning_axis_, covariance_rate_ = 0, effective_ = 1;
  double step_;  ///< cumulative: σ of all offspring
  std::uint64_t generation_ = 0;
  Eigen::MatrixXd covariance_, factor_, update_;
  Eigen::VectorXd step_path_, covariance_path_, shift_, whitened_;
  std::vector<double> weights_, mean_, mean_steps_, normals_;
};

}  // namespace tunica::es
