// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/hypotheses/signatures.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/hypotheses/amplitude_range.hpp"

namespace tunica::diagnosis {

std::vector<Slope> slopes_of(const Extension& extended, const MechanismFactory& mechanism,
                             const std::vector<double>& null, const Eigen::VectorXd& bare, const Eigen::MatrixXd& J,
                             assembly::Workspace& workspace, bool quick) {
  using Side = MechanismFactory::Side;
  const Extension::Part& part = extended.parts().front();
  const AmplitudeRange range = range_of(mechanism, extended.additions().front());
  const double reach = std::max(range.plausible_max - mechanism.null, mechanism.null - range.plausible_min);
  const auto at = [&](double step, Eigen::VectorXd& into) {
    std::vector<double> free = null;
    for (const std::size_t member : part.amplitude) free[member] = part.null + step;
    return whitened(extended.assembly(), free, workspace, into, nullptr);
  };
  const auto one_sided = [&](double sign) -> Eigen::VectorXd {
    // 2 (f(h/2) − f(0))/(h/2) − (f(h) − f(0))/h = f′(0) + O(h²)
    Eigen::VectorXd half, whole;
    for (double step = 1e-3 * reach; step > 1e-9 * reach; step /= 10) {
      if (!at(sign * step, whole).ok()) continue;
      if (quick) return (whole - bare) / step;
      // A total change of a tenth of σ is large enough to resolve, and small enough to be nearly linear.
      if (const double change = (whole - bare).norm(); change > 0.1) {
        step *= 0.1 / change;
        if (!at(sign * step, whole).ok()) continue;
      }
      if (at(sign * step / 2, half).ok()) return (4 * (half - bare) - (whole - bare)) / step;
    }
    return {};
  };
  if (mechanism.side == Side::even) {
    Eigen::VectorXd near, far;
    for (double step = 0.02 * reach; step > 1e-6 * reach; step /= 10)
      if (at(step, near).ok() && at(2 * step, far).ok())
        return {{(16 * (near - bare) - (far - bare)) / (12 * step * step), Side::even}};
    return {};
  }
  const double sign = mechanism.plausible_max > mechanism.null ? 1 : -1;
  Eigen::VectorXd exact = Eigen::VectorXd::Zero(bare.size());
  if (extended.assembly().layout().jacobian_is_exact) {
    for (const std::size_t member : part.amplitude) exact += J.col(static_cast<Eigen::Index>(member));
    if (mechanism.side == Side::positive) return {{sign * exact, mechanism.side, sign}};
    if (mechanism.native.empty()) return {{exact, mechanism.side}};
    Eigen::VectorXd up = one_sided(1), down = one_sided(-1);
    constexpr double kink = 0.02;
    if (up.size() == 0 || down.size() == 0 || (up + down).norm() < kink * (up.norm() + down.norm()))
      return {{exact, mechanism.side}};
    return {{std::move(up), Side::positive, 1}, {std::move(down), Side::positive, -1}};
  }
  if (mechanism.side == Side::positive) {
    Eigen::VectorXd slope = one_sided(sign);
    return {{std::move(slope), mechanism.side, sign}};
  }
  Eigen::VectorXd up = one_sided(1);
  if (up.size() == 0) up = -one_sided(-1);
  return {{std::move(up), mechanism.side}};
}

}  // namespace tunica::diagnosis
