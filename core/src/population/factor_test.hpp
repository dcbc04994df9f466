// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "population/arrangements.hpp"
#include "population/population.hpp"

namespace tunica::population {

/// How a set of p-values was adjusted for their number.
enum class Adjustment { westfall_young, holm };
inline constexpr text::Codes<Adjustment, 2> adjustment_codes = {
    {{Adjustment::westfall_young, "westfall_young_max_t"}, {Adjustment::holm, "holm"}}};

/// Difference of a level from the reference in one parameter, of the model with the factor.
struct Effect {
  Coefficient difference;
  std::size_t level = 0;
  /// exp of the difference and of its interval where the coordinate is a logarithm: the ratio of the levels.
  std::optional<double> ratio;
  std::optional<Interval> ratio_interval;
};

/// One parameter, all levels of the factor together.
struct ParameterTest {
  std::size_t parameter = 0;
  double f = 0, freedom = 0, freedom_below = 0;  ///< Wald's F of the model with the factor
  double p_value = 1;                            ///< of F
  double holm = 1;                               ///< Adjustment::holm of p_value over the parameters
  double permutation = 1;                        ///< permutation p-value of this parameter alone
  double westfall_young = 1;                     ///< Adjustment::westfall_young over the parameters
};

struct LikelihoodRatio {
  double statistic = 0, freedom = 0, p_value = 1;  ///< χ²: too small with few specimens
};

struct PermutationTest {
  Scheme scheme = Scheme::specimens;
  double possible = 0;  ///< distinct arrangements of the labels
  bool exhaustive = false;
  std::size_t used = 0;
  std::uint64_t seed = 0;
  double p_value = 1;   ///< of the factor as a whole
  double smallest = 1;  ///< the smallest p-value that these arrangements can give
};

struct FactorTest {
  std::size_t factor = 0;
  std::vector<Effect> effects;  ///< level by level, parameter by parameter
  std::vector<ParameterTest> parameters;
  LikelihoodRatio likelihood_ratio;
  PermutationTest permutation;
};

struct FactorTestOptions {
  std::size_t permutations = 4999;  ///< at most; all arrangements where there are no more
  std::uint64_t seed = 1;
};

/// Does the factor change a parameter? `population` was estimated with the factor in its design.
///
/// Permutation: the model without the factor gives expansions, Ω and φ, which do not know the labels. For each
/// arrangement of the labels the statistics are Wald's, at those: T = β_f·C_f⁻¹β_f for all parameters, T_j for one.
/// Whatever the shape of the distributions, p = #{T* ≥ T}/all, or (b + 1)/(m + 1) of m draws, is valid. P. H. Westfall,
/// S. S. Young, Resampling-Based Multiple Testing (1993), algorithm 2.8: step-down maxima of the same draws.
/// Likelihood ratio: both models by maximum likelihood on the expansions of the null.
FactorTest test_factor(const Cohort& cohort, const Population& population, std::size_t factor,
                       const FactorTestOptions& options = {});

}  // namespace tunica::population
