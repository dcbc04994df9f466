// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "population/mixed_model.hpp"

namespace tunica::population {

/// A factor as columns of the design: level l of specimen i is `of[i]`; column `first + l − 1` indicates it.
struct FactorColumns {
  Eigen::Index first = 1;
  std::size_t levels = 2;
  std::vector<std::size_t> of;
};

/// What may be exchanged where a factor has no effect.
enum class Exchange {
  specimens,  ///< each specimen is an animal
  within,     ///< specimens of one animal: the factor varies within animals
  animals     ///< whole animals: the factor is the same in each
};

struct PermutationTest {
  Exchange exchange = Exchange::specimens;
  bool all = false;  ///< every arrangement was made, else so many random ones
  std::size_t made = 0;
  double smallest_p = 1;      ///< that these specimens can give
  std::vector<double> p;      ///< by parameter: of the largest |t| over the levels
  std::vector<double> p_any;  ///< the same, adjusted for all parameters (Westfall–Young, single step)
};

/// Permutation test of a factor. `null`: estimates of the model without its columns, of which the spreads are taken, so
/// that nothing but the arrangement of the labels changes; `individuals` with all columns, their data expanded about
/// what the null model says. The statistic is |b/se| by generalised least squares.
///
/// p = (1 + number of arrangements that reach the statistic)/(1 + arrangements) of random ones; without the ones where
/// all were made (B. Phipson, G. K. Smyth, Stat. Appl. Genet. Mol. Biol. 9:39, 2010). Adjusted: the largest statistic
/// of all parameters is compared (P. H. Westfall, S. S. Young, Resampling-Based Multiple Testing, 1993). Deterministic
/// given the seed, for any number of threads.
PermutationTest permutation_test(std::span<const Individual> individuals, const FactorColumns& factor,
                                 const Estimates& null, std::size_t draws, std::uint64_t seed);

}  // namespace tunica::population
