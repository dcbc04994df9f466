// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "assembly/assembly.hpp"
#include "tunica/status.hpp"

namespace tunica::uncertainty {

/// The information of the data about one free parameter at the best point.
struct ParameterInterval {
  std::string name, unit;
  double value = 0;
  double ci95 = std::numeric_limits<double>::quiet_NaN();  ///< half width; NaN when at a bound or not identified
  /// The ends of the interval: x ± its half width in the unit box, within the bounds. Not symmetric on a log scale.
  double lower = std::numeric_limits<double>::quiet_NaN(), upper = std::numeric_limits<double>::quiet_NaN();
  bool straight = true;   ///< the linearised interval can be believed, see straightness.hpp; else a profile is better
  bool at_bound = false;  ///< within 1e-6 of the range
  bool natural = false;   ///< of a bound beyond which there is nothing: a symmetry, or a physical end
  bool held = false;      ///< active constraints leave it no room: what its value is worth is not for the data to say
  bool identified = false;
};

/// A combination of parameters that the data fix although they leave its arguments free.
struct FixedCombination {
  std::string name, unit;
  double value = 0, ci95 = 0;  ///< ± half width
};

/// Parameters that the data do not fix one by one.
struct Valley {
  std::vector<std::string> parameters;
  /// Steps along the valley, one per dimension of it: parameter and change, in base units; their lengths say nothing.
  std::vector<std::vector<std::pair<std::string, double>>> directions;
  bool exact = true;  ///< no prediction changes along it; false: so little that the uncertainty exceeds the bounds
  std::vector<FixedCombination> fixed;
  std::string sentence;
};

struct Identifiability {
  std::vector<ParameterInterval> parameters;  ///< as Layout::parameters
  std::vector<double> singular_values;        ///< descending
  /// Positions of the parameters that the data fix, and their covariance V S⁻² Vᵀ in the unit box, row after row: what
  /// ci95 comes from. Empty where there is none.
  std::vector<std::size_t> fixed_by_data;
  std::vector<double> covariance;
  std::vector<Valley> valleys;
  std::string constrained;  ///< sentence on active constraints; empty = none
  /// Half widths of the 95 % intervals of the fitted curves, one a prediction, held-out rows included; empty where the
  /// data leave nothing to say.
  std::vector<double> curve_ci95;

  /// For `identifiability` of result.json: one a valley, one for all parameters at bounds.
  [[nodiscard]] std::vector<std::string> sentences() const;
};

/// Smallest ratio of singular values at which a direction counts as seen by the data; differences see less sharply.
constexpr double weakest_exact = 1e-7, weakest_differenced = 1e-5;

/// Linearises about `free`. Let G = diag(1/σ) ∂ŷ/∂x over the fitted rows, x the unit box, σ the noise of a
/// channel (and a row (p − mean)/sd per prior), with the singular
/// value decomposition G = U S Vᵀ. Then the most likely x has covariance V S⁻² Vᵀ (Laplace); that of the objective
/// which was minimised follows by sandwich.hpp, and is written V S⁻² Vᵀ again. Direction v_k is weak when
///
///   s_k < weakest·s_1 (no prediction changes), or 1/s_k > 1 (its standard deviation exceeds the box).
///
/// A parameter has the interval ci95 = t √Σ_k (v_k)²/s_k², with the 97.5 % point of Student's t at N − p degrees of
/// freedom (of the normal distribution where all noise is stated), in the coordinate of the search. It is identified
/// when no direction without effect moves it by a hundredth of the box per unit length, and its interval does not fill
/// the box. Parameters at a bound leave the computation, directions across active constraints (c > −1e-4) and channels
/// of weight 0 too. Weak directions that share parameters form a valley; of the model's combinations those are named as
/// fixed whose gradient is orthogonal to all of them (to 1e-3) and that have an argument in it.
///
/// The fitted curve ŷ_i has the interval t √Σ_k min(1, 1/s_k²) (g_i·v_k)² about it, g_i = ∂ŷ_i/∂x (delta method,
/// pointwise; G. A. F. Seber, C. J. Wild, Nonlinear Regression (1989), section 5.1): where the curve is, not where the
/// next measurement will be.
///
/// Where bounds and active constraints leave no direction there is nothing to compute: no interval, and a sentence. A
/// point that breaks a constraint (c > 1e-4) lies on no border; it is linearised as if there were none.
///
/// σ is that of whitening.hpp: where `is_fit` and χ² contradicts stated noise, all intervals are √(χ²/ν) times as wide.
///
/// Returns failed when the point cannot be evaluated or has no fitted rows.
Status identify(const assembly::Assembly& assembly, std::span<const double> free, Identifiability& found,
                bool is_fit = true);

}  // namespace tunica::uncertainty
