// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "assembly/whitening.hpp"
#include "uncertainty/refit.hpp"

namespace tunica::uncertainty {

/// The objective of a run near its best point, with what turns its rise into that of −2 ln L. It is the one that the
/// run has minimised, and the noise is that of its best point throughout (whitening.hpp), so that the estimate is where
/// the profile is lowest. For `least_squares` with stated noise, weights 1 and no contradiction J = −2 ln L.
struct Likelihood {
  assembly::Whitening whitening;
  RefitObjective target;         ///< J
  Refit centre;                  ///< its minimum, from the best point of the run
  std::vector<double> scales;    ///< λ_j of sandwich.hpp: ΔJ/λ_j rises as −2 ln L
  double gain = 0;               ///< J at the best point of the run, less that of the centre
  std::vector<double> measured;  ///< what stands in for the data; empty: nothing
  double quantile = 0;           ///< of standardised errors: an interval is where −2 ln L rises by its square
};

/// Failed in `centre.status` where the best point cannot be evaluated. `assembly` must outlive it. `measured` in the
/// layout of the predictions stands in for the data unless empty.
Likelihood likelihood_at(const assembly::Assembly& assembly, std::span<const double> best,
                         const LocalOptimizer& optimizer, std::uint64_t seed, std::span<const double> measured = {});

/// The profile of one parameter: it is held at values away from the centre, in the coordinate of the search, all others
/// are fitted again from the solution before, and
///
///   Δ(p) = (min_{others} J − J at the centre)/λ_p = q²
///
/// bounds the interval; q² = 3.84 where all noise is stated and fits (χ² with one degree of freedom), else the square
/// of Student's t, that is F(1, N − p). To first order the ends are those of the linearised interval, whatever the
/// objective. Steps adapt to a quarter of √q² each and end behind the threshold or at a bound.
/// Source: D. M. Bates, D. G. Watts, Nonlinear Regression Analysis and Its Applications (1988), section 6.1;
/// A. Raue et al., Bioinformatics 25:1923 (2009).
struct Profile {
  struct Point {
    double value = 0;  ///< base unit
    double delta = 0;
    std::vector<double> free;
  };
  struct End {
    enum class Kind { crossed, open, failed };
    Kind kind = Kind::open;  ///< open: below the threshold as far as the bound; failed: refits failed before
    double value = 0;        ///< where it crosses, or as far as it was followed
  };
  std::size_t parameter = 0;  ///< index among the free ones
  std::vector<Point> points;  ///< ascending in value, the centre among them
  double threshold = 0;
  End lower, upper;
  double lowest = 0;  ///< least Δ; below zero: the centre was not the optimum
  double gain = 0;    ///< Δ of the best point of the run above the centre
  std::uint64_t evaluations = 0, failures = 0;
};

/// Profiles of these parameters, both sides of each side by side; the same for any number of threads. Once
/// `interrupted` returns true what is missing is left out.
std::vector<Profile> profiles(const assembly::Assembly& assembly, const Likelihood& likelihood,
                              const LocalOptimizer& optimizer, const std::vector<std::size_t>& parameters,
                              std::uint64_t seed, const std::function<bool()>& interrupted = {});

}  // namespace tunica::uncertainty
