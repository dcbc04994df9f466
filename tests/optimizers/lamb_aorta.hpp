// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include <ceres/jet.h>

#include "conformance/function_problem.hpp"

namespace tunica::testing {

using namespace conformance;

struct Strip {
  bool circumferential;
  std::vector<double> stretch, stress;
};

/// Rows 0:240:6 of one of the measured strips, as the example carries them.
inline std::optional<Strip> lamb_aorta_strip(bool circumferential) {
  std::ifstream file(std::filesystem::path(TUNICA_SOURCE_DIR) / "examples" / "lamb_aorta" /
                     (circumferential ? "circumferential.csv" : "axial.csv"));
  if (!file) return std::nullopt;
  Strip strip{circumferential, {}, {}};
  bool header = true;
  int row = 0;
  for (std::string line; std::getline(file, line) && row < 240;) {
    if (line.starts_with('#')) continue;
    if (std::exchange(header, false)) continue;
    if (row++ % 6 != 0) continue;
    std::istringstream cells(line);
    char comma = 0;
    cells >> strip.stretch.emplace_back() >> comma >> strip.stress.emplace_back();
  }
  return strip;
}

/// Stress of a strip of the non-symmetric dispersion model of Holzapfel et al. (2015), both families alike
/// (physics: W = μ/2 (I1 − 3) + k1/k2 [exp(k2 E²) − 1], E = Σ a_i λ_i² − 1 for E > 0, with
/// a_t = A + B sin²θ, a_z = A + B cos²θ, a_r = 1 − 2A − B). Written out directly, so that the optimisers can be
/// judged on the real problem without the models and tests of the product.
template <class T>
struct HolzapfelStrip {
  T mu, k1, k2, loading, transverse, normal;  ///< a_i of the three axes of the strip

  HolzapfelStrip(const T* p, bool circumferential) : mu(p[0]), k1(p[3]), k2(p[4]) {
    using std::sin, std::cos, ceres::sin, ceres::cos;
    const T s = sin(p[5]), c = cos(p[5]);
    loading = circumferential ? p[1] + p[2] * s * s : p[1] + p[2] * c * c;
    transverse = circumferential ? p[1] + p[2] * c * c : p[1] + p[2] * s * s;
    normal = T(1) - T(2) * p[1] - p[2];
  }
  /// λ_a ∂W/∂λ_a at the incompressible state (l, l2): σ11 for `first`, else σ22, which vanishes.
  template <class S>
  S stress(double l, const S& l2, bool first) const {
    using std::exp, ceres::exp;
    const S s1 = S(l * l), s2 = l2 * l2, s3 = S(1) / (s1 * s2);
    const S e = loading * s1 + transverse * s2 + normal * s3 - S(1);
    const S w = e > S(0) ? S(2) * k1 * e * exp(k2 * e * e) : S(0);
    return first ? mu * (s1 - s3) + S(2) * w * (loading * s1 - normal * s3)
                 : mu * (s2 - s3) + S(2) * w * (transverse * s2 - normal * s3);
  }
  /// σ22 and its derivative with respect to l2.
  double transverse_equilibrium(double l, double l2, double& slope) const {
    const double s1 = l * l, s2 = l2 * l2, s3 = 1 / (s1 * s2), ds2 = 2 * l2, ds3 = -2 * s3 / l2;
    const double e = loading * s1 + transverse * s2 + normal * s3 - 1, de = transverse * ds2 + normal * ds3;
    const double x = e > 0 ? 2 * k1 * std::exp(k2 * e * e) : 0;
    const double w = x * e, dw = x * (1 + 2 * k2 * e * e) * de;
    const double arm = transverse * s2 - normal * s3, darm = transverse * ds2 - normal * ds3;
    slope = mu * (ds2 - ds3) + 2 * (dw * arm + w * darm);
    return mu * (s2 - s3) + 2 * w * arm;
  }
};

/// The two-strip calibration of the newborn lamb aorta with `sum_of_norms`: six parameters, a valley along which
/// (A, B, θ) are free, optimum 66.1000. `strict` fails outside A + B ≥ 0, 1 − 2A − B ≥ 0 as a careful model would.
inline std::optional<Function> lamb_aorta(bool strict = false) {
  const std::optional<Strip> circumferential = lamb_aorta_strip(true), axial = lamb_aorta_strip(false);
  if (!circumferential || !axial) return std::nullopt;
  Function function;
  function.name = "lamb_aorta";
  function.dimension = 6;
  const std::size_t rows = circumferential->stretch.size();
  function.residual_count = 2 * rows;
  function.blocks = {{0, rows, 1, ResidualBlock::Loss::root}, {rows, rows, 1, ResidualBlock::Loss::root}};
  function.start.assign(6, 0.5);
  function.optimum = 66.1000;
  function.residuals = [strips = std::vector<Strip>{*circumferential, *axial}, strict, rows](
                           std::span<const double> x, std::span<double> r, std::span<double> jacobian) {
    using Jet = ceres::Jet<double, 6>;
    constexpr double width[] = {100, 1.0 / 3, 1, 100, 3, 1.5707963267948966};
    double p[6];
    Jet q[6];
    for (int i = 0; i < 6; ++i) {
      p[i] = x[static_cast<std::size_t>(i)] * width[i];
      q[i] = Jet(p[i], i);
      q[i].v[i] = width[i];
    }
    if (strict && 1 - 2 * p[1] - p[2] < 0) return false;
    for (const Strip& strip : strips) {
      const HolzapfelStrip<double> plain(p, strip.circumferential);
      const HolzapfelStrip<Jet> exact(q, strip.circumferential);
      const std::size_t offset = strip.circumferential ? 0 : rows;
      double l2 = 1;
      for (std::size_t i = 0; i < rows; ++i) {
        const double l = strip.stretch[i];
        double low = 0.1, high = 3, slope = 1;
        for (int iteration = 0; iteration < 60; ++iteration) {
          const double g = plain.transverse_equilibrium(l, l2, slope);
          if (!(std::abs(g) < 1e300)) return false;
          (g > 0 ? high : low) = l2;
          double next = l2 - g / slope;
          if (!(next >= low && next <= high)) next = 0.5 * (low + high);
          const double step = std::abs(next - l2);
          l2 = next;
          if (step < 1e-9) break;
        }
        if (jacobian.empty()) {
          r[offset + i] = plain.stress(l, l2, true) - strip.stress[i];
        } else {
          // Implicit differentiation: one Newton step from the converged root, with the plain slope.
          const Jet root = Jet(l2) - exact.stress(l, Jet(l2), false) / slope;
          const Jet residual = exact.stress(l, root, true) - strip.stress[i];
          r[offset + i] = residual.a;
          for (std::size_t j = 0; j < 6; ++j) jacobian[(offset + i) * 6 + j] = residual.v[static_cast<int>(j)];
        }
        if (!std::isfinite(r[offset + i])) return false;
      }
    }
    return true;
  };
  return function;
}

}  // namespace tunica::testing
