// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "population/alternation.hpp"

namespace tunica::population {

struct Interval {
  double lower = 0, upper = 0;
};

/// A coefficient of the design: the mean of a parameter in the reference groups, or the effect of a level on it.
struct Coefficient {
  std::size_t parameter = 0, column = 0;
  double value = 0, standard_error = 0, freedom = 0;
  Interval interval;   ///< by Student's t
  double p_value = 1;  ///< two-sided, of no effect; 1 for the mean of the reference
};

/// Standard deviation ω_j of a parameter, over specimens or over animals.
struct Spread {
  std::size_t parameter = 0;
  bool between = false;  ///< over animals
  double value = 0;
  /// Profile likelihood, χ² with one degree of freedom. An upper end of infinity: not found within 20 scales.
  Interval interval;
  bool at_zero = false;  ///< the likelihood falls off a spread of zero
};

struct Individual {
  Eigen::VectorXd mean;        ///< ξ̂_i, shrunken towards the population
  Eigen::MatrixXd covariance;  ///< of ξ_i given all data
  Eigen::VectorXd effect;      ///< b̂_i
  /// Var(b_j | own data, population)/ω_j²: 0, all from the specimen's own data; 1, all borrowed from the others.
  Eigen::VectorXd borrowed;
  bool failed = false;  ///< its last search failed, and an earlier expansion stands for it
};

/// One likelihood of the whole cohort; compare models by `deviance`, `aic`, `bic` of Likelihood::full.
struct Evidence {
  double deviance = 0;      ///< −2 log L
  double parameters = 0;    ///< means (not for REML), spreads, correlations, noises
  double aic = 0, bic = 0;  ///< deviance + 2 k, and + k log(specimens)
};

struct Options {
  std::vector<std::size_t> factors{};        ///< in the design
  std::optional<Shape> within{}, between{};  ///< none: chosen
  double confidence = 0.95;
  bool intervals_of_spreads = true;
  bool maximum_likelihood = true;  ///< a second fit, for Evidence of Likelihood::full
};

struct Population {
  Design design;
  std::vector<std::size_t> place;  ///< of the sorted specimens that `design` and `alternation` are about
  ChosenShape within;
  std::optional<ChosenShape> between;
  std::vector<Coefficient> coefficients;  ///< column by column of the design, parameter by parameter
  Eigen::VectorXd beta;
  Eigen::MatrixXd beta_covariance;
  Eigen::MatrixXd omega, omega_between;  ///< Ω, and Ω_a (empty: not nested)
  std::vector<Spread> spreads;
  std::vector<double> noise;             ///< φ_c
  std::vector<Individual> individuals;   ///< in the caller's order
  std::vector<Eigen::VectorXd> animals;  ///< a_k, in the caller's order
  Eigen::VectorXd borrowed;              ///< mean over specimens
  Evidence reml;
  std::optional<Evidence> ml;
  std::size_t rounds = 0;
  bool converged = false;
  Alternation alternation;  ///< of the sorted cohort
};

/// The population that the specimens come from: ξ_i = B x_i + a + b_i, y = f(ξ_i) + e; see docs/cohort_statistics.md.
/// The same bits for any number of threads and any order of specimens. Throws InputError as sorted(), design(),
/// alternate().
Population estimate(const Cohort& cohort, const Options& options = {});

}  // namespace tunica::population
