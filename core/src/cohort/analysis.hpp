// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cohort/design.hpp"
#include "population/mixed_model.hpp"
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
/// a difference.
struct Effect {
  std::string factor, level, reference, of;
  bool ratio = false;
  Estimated size;
  double freedom = 0;
  double p = 1;                         ///< of t
  double p_holm = 1;                    ///< adjusted for all coordinates and levels (Holm)
  std::optional<double> p_permutation;  ///< of the largest |t| over the levels of the factor
  std::optional<double> p_adjusted;     ///< the same, adjusted for all coordinates (Westfall–Young)
};

/// All that says whether a factor matters at all.
struct FactorTest {
  std::string factor;
  double likelihood_ratio = 0, freedom = 0, p = 1;  ///< −2 ln of the ratio, against χ²
  population::PermutationTest permutation;
};

/// How specimens of one group differ.
struct Spread {
  double sd = 0;                ///< of the coordinate: about the relative spread where the scale is logarithmic
  double lower = 0;             ///< of the 95 % interval
  std::optional<double> upper;  ///< none: any spread is possible
  double of_animals = 0;
};

/// How many specimens a study needs.
struct Planning {
  double detectable = 0;  ///< difference that as many specimens as now, half in each group, show
  std::optional<std::size_t> for_fifth, for_half;  ///< specimens a group for a difference of 20 % and 50 %; log only
};

/// The mixed model of some coordinates in words of the field.
struct Analysis {
  std::vector<Coordinate> coordinates;
  std::vector<Design::Group> groups;
  std::vector<std::vector<Estimated>> means;  ///< by coordinate and group; the median of specimens where log
  std::vector<Spread> spreads;                ///< by coordinate
  std::vector<Effect> effects;
  std::vector<FactorTest> factors;
  std::vector<Planning> planning;  ///< by coordinate; empty with fewer than four specimens
};

/// What the model says where a factor has no effect: the specimens expanded there, with the reduced design.
struct NullModel {
  std::vector<population::Individual> individuals;
  population::Estimates estimates;
};

struct AnalysisInput {
  const Design& design;
  const population::Structure& structure;
  const std::vector<population::Individual>& individuals;
  const population::Estimates& estimates;
  std::function<NullModel(std::size_t factor)> null;
  std::size_t permutations = 0;
  std::uint64_t seed = 1;
};

Analysis analyse(std::vector<Coordinate> coordinates, const AnalysisInput& input);

}  // namespace tunica::cohort
