// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "assembly/whitening.hpp"
#include "uncertainty/refit.hpp"

namespace tunica::uncertainty {

/// The likelihood of a run near its best point: −2 ln L = Σ r² over the whitened residuals (whitening.hpp), up to a
/// constant. For `least_squares` with stated noise that is the run's objective.
struct Likelihood {
  assembly::Whitening whitening;
  RefitObjective target;
  Refit centre;         ///< the most likely point, from the best point of the run
  double quantile = 0;  ///< of standardised errors: an interval is where −2 ln L rises by its square
};

/// Failed in `centre.status` where the best point cannot be evaluated. `assembly` must outlive it. `measured` in the
/// layout of the predictions stands in for the data unless empty.
Likelihood likelihood_at(const assembly::Assembly& assembly, std::span<const double> best,
                         const LocalOptimizer& optimizer, std::uint64_t seed, std::span<const double> measured = {});

/// The profile of one parameter: it is held at values away from the centre, in the coordinate of the search, all others
/// are fitted again from the solution before, and
///
///   Δ(p) = min_{others} −2 ln L − (−2 ln L at the centre) = q²
///
/// bounds the interval; q² = 3.84 where all noise is stated (χ² with one degree of freedom), else the square of
/// Student's t, that is F(1, N − p). Steps adapt to a quarter of √q² each and end behind the threshold or at a bound.
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
  std::uint64_t evaluations = 0, failures = 0;
};

/// Profiles of these parameters, both sides of each side by side; the same for any number of threads. Once
/// `interrupted` returns true what is missing is left out.
std::vector<Profile> profiles(const assembly::Assembly& assembly, const Likelihood& likelihood,
                              const LocalOptimizer& optimizer, const std::vector<std::size_t>& parameters,
                              std::uint64_t seed, const std::function<bool()>& interrupted = {});

}  // namespace tunica::uncertainty
