// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "population/maximise.hpp"

namespace tunica::population {

/// The estimates from a cohort.
struct Form {
  Design design;
  Shape within = Shape::diagonal;
  std::optional<Shape> between;  ///< none: not nested
  Likelihood likelihood = Likelihood::restricted;
};

/// Where the two steps agree: expansions at the maxima a posteriori, variances of the largest likelihood.
struct Alternation {
  std::vector<Expansion> expansions;
  Maximum maximum;
  Variances variances;
  Means means;  ///< with of_specimen_covariance
  std::size_t rounds = 0;
  bool converged = false;
  std::vector<std::size_t> failures;  ///< specimens whose last expansion failed; an earlier one stands for it
};

/// Lindstrom and Bates (Biometrics 46:673, 1990): (1) expand every specimen about its maximum a posteriori, side by
/// side; (2) the linear mixed model of the expansions; again until β moves by less than 1e-4 of its standard error and
/// spreads and log φ by less than 1e-4. −2 log L of the last round is Laplace's approximation with J·J as curvature.
///
/// Priors are safer than estimates, and equal to them where the steps agree. A prior is 1e-3 scales wide at least, so
/// that it has a precision where a spread is zero; step 2 takes the spread as it is. Its mean stays within a scale of
/// the points of expansion: a quadratic about a point where a parameter hardly acts leads anywhere. And where the steps
/// answer each other in a cycle, priors go a part of the way only, a smaller one each time.
///
/// `from`: an alternation of the same cohort to start at. Throws InputError where a specimen cannot be expanded at all,
/// or where all specimens together do not fix a parameter.
Alternation alternate(const Cohort& cohort, const Form& form, const Alternation* from = nullptr);

/// Ω⁻¹ of the priors, 1e-3 scales wide at least.
Eigen::MatrixXd prior_precision(const Cohort& cohort, const Variances& variances);

/// Step 2 alone, on given expansions.
Alternation refitted(const Cohort& cohort, const Form& form, const Alternation& from);

/// −2 log L with the constants: normalisation, and (rows − p q) log 2π instead of rows log 2π for REML.
double deviance(const Alternation& alternation, Likelihood likelihood);

}  // namespace tunica::population
