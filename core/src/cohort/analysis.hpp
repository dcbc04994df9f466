// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cohort/members.hpp"
#include "population/factor_test.hpp"
#include "tunica/parameter.hpp"

namespace tunica::cohort {

/// A parameter, or a reading, in the coordinate in which it varies between specimens.
struct Coordinate {
  std::string name, unit;
  Scale scale = Scale::linear;
};

/// An estimate with its 95 % interval in natural terms.
struct Estimated {
  double value = 0, lower = 0, upper = 0;
};

/// What a level of a factor does to one coordinate, against the reference: a ratio where the scale is logarithmic, else
/// a difference. p-values but the first are of the factor: all its levels together.
struct Effect {
  std::string factor, level, reference, of;
  bool ratio = false;
  Estimated size;
  double freedom = 0;
  double p = 1;              ///< of t, of this level
  double p_holm = 1;         ///< of F, adjusted for all coordinates (Holm)
  double p_permutation = 1;  ///< by exchanging labels
  double p_adjusted = 1;     ///< the same, adjusted for all coordinates (Westfall–Young)
};

/// Whether a factor matters at all.
struct FactorSummary {
  std::string factor;
  population::LikelihoodRatio likelihood_ratio;
  population::PermutationTest permutation;
};

/// How specimens of one group differ.
struct SpreadSummary {
  double sd = 0;                ///< of the coordinate: about the relative spread where the scale is logarithmic
  double lower = 0;             ///< of the 95 % interval
  std::optional<double> upper;  ///< none: any spread is possible
  double of_animals = 0;
};

/// How many specimens (nested: animals) a study needs.
struct Planning {
  double detectable = 0;  ///< difference, or ratio, that as many as now, half in each group, show
  std::optional<std::size_t> for_fifth, for_half;  ///< a group, for a difference of 20 % and 50 %; log only
};

/// The population of some coordinates in words of the field.
struct Analysis {
  std::vector<Coordinate> coordinates;
  std::vector<std::string> groups;
  std::vector<std::vector<Estimated>> means;  ///< by coordinate and group; the median of specimens where log
  std::vector<SpreadSummary> spreads;         ///< by coordinate
  std::vector<Effect> effects;
  std::vector<FactorSummary> factors;
  std::vector<Planning> planning;  ///< by coordinate; empty where the data do not carry it
};

/// Tests every factor of the design, by `permutations` arrangements at most, and puts all of it together.
Analysis analyse(std::vector<Coordinate> coordinates, const Members& members, const population::Cohort& cohort,
                 const population::Population& population, std::size_t permutations, std::uint64_t seed);

}  // namespace tunica::cohort
