// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "tunica/model.hpp"

namespace tunica::indentation {

/// The shear modulus at rest, μ = E/3 with E = dσ/d ln λ of a free strip, and its derivatives by the parameters.
///
/// E is the difference (8 [σ(ε) − σ(−ε)] − [σ(2ε) − σ(−2ε)])/12ε of the stress at ln λ = ±ε, ±2ε with ε = 10⁻³: good to
/// 10⁻¹¹, and with exact derivatives by the parameters, which the model has of its stress.
struct ShearModulus {
  double value = 0;
  std::vector<double> by_parameter;

  /// Fails where the material is not isotropic: strips along t and z then differ, or their widths do.
  Status evaluate(const Model& model, std::span<const double> parameters, bool derivatives);
  /// After evaluate(): fails where a strip along t that is shortened by up to `strain`, or lengthened as far, does not
  /// bear the stress μ (λ² − 1/λ) of a neo-Hookean one within a twentieth.
  [[nodiscard]] Status neo_hookean(const Model& model, std::span<const double> parameters, double strain) const;
};

}  // namespace tunica::indentation
