// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

#include "population/cohort.hpp"

/// Cohorts from functions that tunica does not have, for tests and for bench/cohorts. They share no code with models.
namespace simulated {

using tunica::population::Cohort;
using tunica::population::Expansion;
using tunica::population::Prior;

/// Predictions of one specimen, channel after channel, and their derivatives by ξ = log θ.
struct Curve {
  std::vector<std::string> parameters;
  std::vector<std::size_t> rows;  ///< of each channel
  void (*evaluate)(const Eigen::VectorXd& xi, Eigen::VectorXd& y, Eigen::MatrixXd& J);
  Eigen::VectorXd typical;    ///< log θ
  std::vector<double> noise;  ///< standard deviation by channel
};

/// σ = a (exp(b(λ − 1)) − 1), 20 rows to λ = 1.4.
const Curve& exponential();
/// A strip with three parameters: σ = μ (λ − 1/λ²) + 2 k1 λ (λ² − 1) exp(k2 (λ² − 1)²), 25 rows to λ = 1.35.
const Curve& strip();
/// The strip under a quarter of the noise.
const Curve& precise_strip();
/// A sheet under three ratios of biaxial stretch with five parameters, of which μ is weakly identified:
/// σ_t = μ (λ_t − 1/(λ_t³λ_z²)) + c (c1 E_t + c3 E_z) λ_t e^Q, Q = c1 E_t² + c2 E_z² + 2 c3 E_t E_z; σ_z alike.
const Curve& sheet();

/// Independent standard normal deviates, the same with every library: polar method of Marsaglia.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : generator_(seed) {}
  double operator()();
  Eigen::VectorXd vector(Eigen::Index size);
  double uniform() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 generator_;
};

/// Measured values y of every specimen; expand() searches the maximum a posteriori by damped Gauss–Newton.
struct Measured {
  const Curve* curve;
  std::vector<Eigen::VectorXd> y;

  std::optional<Expansion> expand(std::size_t specimen, const Prior& prior) const;
  Eigen::VectorXd misfits(std::size_t specimen, const Eigen::MatrixXd& points,
                          const std::vector<double>& variances) const;
};

/// A cohort of specimens with the values of ξ, measured with the noise of the curve. No factors, no animals yet.
Cohort cohort(const Curve& curve, const std::vector<Eigen::VectorXd>& xi, Normal& normal);
Cohort cohort_of(const Measured& measured);

/// A linear cohort: specimen i is known by information A_i about the value ξ_i, with noise held.
Cohort linear(const std::vector<Eigen::VectorXd>& values, const std::vector<Eigen::MatrixXd>& informations);

}  // namespace simulated
