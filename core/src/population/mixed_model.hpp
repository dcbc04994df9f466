// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "population/quadratic.hpp"

/// The statistics of a cohort: how specimens differ, and whether groups of them do. docs/cohort.md has the model.
namespace tunica::population {

/// One specimen: what its data say of its coordinates ξ, the row of its design, and the animal it is from.
struct Individual {
  Peak data;
  Eigen::VectorXd design;  ///< 1, then an indicator for each level of a factor but the reference
  std::size_t animal = 0;  ///< equal numbers = the same animal
};

/// The mixed model: ξ_i = B x_i + a + b_i with a ~ N(0, Ω_a) of the animal and b_i ~ N(0, Ω) of the specimen.
struct Structure {
  bool full = false;    ///< Ω may have covariances, else it is diagonal
  bool nested = false;  ///< animals have a spread of their own (diagonal)
};

struct Estimates {
  Eigen::MatrixXd B;           ///< parameters × columns of the design
  Eigen::MatrixXd covariance;  ///< of vec B, column after column
  Eigen::MatrixXd omega, omega_animals;
  double neg2_likelihood = 0, neg2_restricted = 0;
  std::size_t spread_parameters = 0;
  bool converged = false;

  [[nodiscard]] Eigen::VectorXd mean(const Eigen::VectorXd& design) const { return B * design; }
  /// Covariance of B x.
  [[nodiscard]] Eigen::MatrixXd mean_covariance(const Eigen::VectorXd& design) const;
};

/// Standard deviations beyond which no spread is searched for, in the coordinates as they are given. Below the first
/// a spread counts as zero.
constexpr double least_spread = 1e-4, largest_spread = 10;

/// −2 ln of the likelihood with all b, a integrated out, as a quadratic in vec B. Specimens of an animal have to stand
/// together where `omega_animals` is not zero.
Quadratic fixed_effects(std::span<const Individual> individuals, const Eigen::MatrixXd& omega,
                        const Eigen::MatrixXd& omega_animals);

/// Restricted maximum likelihood of Ω and Ω_a (D. A. Harville, J. Am. Stat. Assoc. 72:320, 1977), generalised least
/// squares of B. `held`: a spread of the diagonal that keeps its value, for profiles.
Estimates estimate(std::span<const Individual> individuals, const Structure& structure,
                   const std::optional<std::pair<std::size_t, double>>& held = {}, bool restricted = true);

/// 95 % interval of the standard deviation of each coordinate between specimens: where the profile of −2 ln of the
/// restricted likelihood rises by 3.84. Ends at zero where the data allow it; the upper end is none where they allow
/// any.
struct SpreadInterval {
  double lower = 0;
  std::optional<double> upper;
};
std::vector<SpreadInterval> spread_intervals(std::span<const Individual> individuals, const Structure& structure,
                                             const Estimates& estimates);

/// What the data of an animal's specimens say of its deviation a, given B.
Eigen::VectorXd animal_deviation(std::span<const Individual> of_animal, const Estimates& estimates);

}  // namespace tunica::population
