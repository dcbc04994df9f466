// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "population/covariance.hpp"
#include "population/design.hpp"

namespace tunica::population {

enum class Likelihood { full, restricted };
inline constexpr text::Codes<Likelihood, 2> likelihood_codes = {
    {{Likelihood::full, "ml"}, {Likelihood::restricted, "reml"}}};

/// A specimen after its own ξ has been integrated over N(m, Ω): −2 log likelihood as a function of its mean m,
///
///   value + 2 w·(m − ξ₀) + (m − ξ₀)·W (m − ξ₀),   T = (I + AΩ)⁻¹,  W = T A,  w = T g,  K = Ω T,
///   value = s − g·K g + log det(I + AΩ) + Σ_c n_c log φ_c.
///
/// With Ω = L Lᵀ, K = L (I + LᵀAL)⁻¹ Lᵀ: nothing is inverted that could be singular, neither A nor Ω. A − A K A would
/// be W as well, but loses every digit where A is large.
struct Marginal {
  Eigen::MatrixXd A, T, K, W;
  Eigen::VectorXd g, w, point;
  double value = 0;
};
std::vector<Marginal> integrate_specimens(const std::vector<Expansion>& expansions, const Variances& variances);

/// The means of the linear mixed model with given variances, after animals and β have been integrated or maximised.
struct Means {
  double value = 0;            ///< −2 log likelihood, without Expansion::normalisation and constants of REML
  Eigen::VectorXd beta;        ///< p q, see Design
  Eigen::MatrixXd covariance;  ///< of β
  std::vector<Eigen::VectorXd> animals;                 ///< a_k, empty where not nested
  std::vector<Eigen::VectorXd> of_specimen;             ///< m_i = X_i β + a
  std::vector<Eigen::MatrixXd> of_specimen_covariance;  ///< of m_i given all data, filled on demand
  bool fixed = true;                                    ///< false: the data do not fix β; nothing else holds
};
/// One integral after the other, each of a quadratic: of a over N(0, Ω_a) as above, then of β over all space (REML adds
/// log det of its information). F. Harville, JASA 72:320 (1977); M. J. Lindstrom, D. M. Bates, Biometrics 46:673
/// (1990). `animal_of` is empty where specimens are not nested. `uncertain`: fill of_specimen_covariance; under
/// Likelihood::full β counts as known there, as its gradient needs.
Means integrate_means(const std::vector<Marginal>& marginals, const Eigen::MatrixXd& rows,
                      const std::vector<std::size_t>& animal_of, const Eigen::MatrixXd& between, Likelihood likelihood,
                      bool uncertain);

/// ξ_i given all data: mean and covariance.
struct Posterior {
  Eigen::VectorXd mean, effect;  ///< ξ̂_i and b̂_i = ξ̂_i − m_i
  Eigen::MatrixXd covariance;
};
Posterior posterior(const Marginal& marginal, const Eigen::VectorXd& mean, const Eigen::MatrixXd& mean_covariance);

/// The linear mixed model of the expansions.
class LinearModel {
 public:
  LinearModel(const Cohort& cohort, const Design& design, const std::vector<Expansion>& expansions,
              Likelihood likelihood);

  /// F = −2 log L, and its gradient where asked for. Fisher's identity: the gradient of a marginal is the mean, over
  /// what was integrated, of the gradient given it. With v_i = w_i + W_i (m_i − ξ₀) and C_i the covariance of m_i,
  ///
  ///   ∂F/∂Ω = Σ_i W_i − v_i v_iᵀ − W_i C_i W_i,   ∂F/∂log φ_c = Σ_i n_c − E[|r_c(ξ_i)|²]/φ_c,
  ///
  /// and ∂F/∂Ω_a the same a level up.
  double value(const Variances& variances, VarianceGradient* gradient = nullptr) const;
  Means means(const Variances& variances, bool uncertain) const;

  const std::vector<Expansion>& expansions() const { return expansions_; }

 private:
  const std::vector<Expansion>& expansions_;
  const Design& design_;
  std::vector<std::size_t> animal_of_;
  std::size_t animals_;
  Likelihood likelihood_;
};

}  // namespace tunica::population
