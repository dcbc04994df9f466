// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "uniaxial.hpp"

namespace tunica::uniaxial {

struct Scratch;  ///< of one thread

/// The free strip pulled along a material axis, for models with a principal-axes path: all rows at once.
///
/// With the squared stretches c = (λ1², u = λ2², 1/(λ1² u)) and g_a = ∂W/∂c_a:
///   σ11 = 2 (c1 g1 − c3 g3),   0 = r = 2 (u g2 − c3 g3)       (physics: docs/theory.md, uniaxial strip)
/// Newton's method on r(y), y = ln u, runs over a whole batch. Its start: r is first solved at a few Chebyshev
/// points of the stretch range, and λ1 u (1 for an isotropic material, smooth in λ1) interpolated to the rows. The
/// last step is not evaluated again but applied to first order, which leaves an error of its square.
class AxesPath {
 public:
  explicit AxesPath(const Strip& strip);
  Status predict(const Strip& strip, const TestInput& input, const TestOutput& output) const;

 private:
  Status solve_start(const Strip& strip, const TestInput& input, std::span<const double> stretch, Scratch& scratch,
                     std::span<double> u) const;

  std::vector<double> nodes_;          ///< stretches of the Chebyshev points; empty = too few rows to pay
  std::vector<double> interpolation_;  ///< rows × nodes, node-major: weight of node k for row i at [k·n + i]
};

}  // namespace tunica::uniaxial
