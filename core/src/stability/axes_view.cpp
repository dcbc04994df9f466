// SPDX-License-Identifier: Apache-2.0
#include "stability/axes_view.hpp"

#include <algorithm>
#include <array>

namespace tunica::stability {

Status AxesView::evaluate_axes(const AxisPoints& points, const AxisResponse& out) const {
  if (has_axes()) return model_.evaluate_axes(points, out);
  const std::size_t n = points.count, parameters = points.parameters.size();
  std::vector<double> C(6 * n), stress(6 * n), tangent(out.hessian.empty() ? 0 : 36 * n),
      stress_dp(out.gradient_dp.empty() ? 0 : 6 * n * parameters);
  std::copy_n(points.c.begin(), 3 * n, C.begin());
  if (Status status = model_.evaluate({n, C, points.parameters, {}, {}}, {out.energy, stress, tangent, stress_dp, {}});
      !status.ok())
    return status;
  if (!out.gradient.empty())
    std::transform(stress.begin(), stress.begin() + static_cast<std::ptrdiff_t>(3 * n), out.gradient.begin(),
                   [](double s) { return s / 2; });
  if (!out.hessian.empty()) {
    static constexpr std::array<std::array<std::size_t, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
    for (std::size_t k = 0; k < 6; ++k)
      for (std::size_t i = 0; i < n; ++i) out.hessian[k * n + i] = tangent[(6 * pair[k][0] + pair[k][1]) * n + i] / 4;
  }
  if (!out.gradient_dp.empty())
    for (std::size_t j = 0; j < parameters; ++j)
      for (std::size_t k = 0; k < 3 * n; ++k) out.gradient_dp[3 * j * n + k] = stress_dp[6 * j * n + k] / 2;
  return {};
}

}  // namespace tunica::stability
