// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "row.hpp"

/// What kernels of Row do at one Gauss point of every lane. They stand in a header because each kernel takes its own
/// copy of them into its instructions.
namespace tunica::fe {

/// r_R, r_Z, z_R, z_Z and r/R of a field r, z of the nodes, at Gauss point g of every lane.
template <std::size_t Order>
void Row<Order>::interpolate(std::size_t g, std::span<const double> nodes, std::span<double> at) const {
  const double to_z = 2 / height(row_), to_r = 2 / h_;
  const std::size_t all = ng * n_;
  double* __restrict__ const f0 = at.data() + g * n_;
  double* __restrict__ const f1 = f0 + all;
  double* __restrict__ const f2 = f1 + all;
  double* __restrict__ const f3 = f2 + all;
  double* __restrict__ const f4 = f3 + all;
  const double* __restrict__ const x = nodes.data();
  const double* __restrict__ const over_R = over_radius_.data() + g * nn * n_;
  double by_r[nn], by_z[nn];
  for (std::size_t a = 0; a < nn; ++a) {
    by_r[a] = element_.by_xi[g][a] * to_r;
    by_z[a] = element_.by_eta[g][a] * to_z;
  }
  const std::size_t n = n_;
#pragma GCC ivdep
  for (std::size_t e = 0; e < n; ++e) {
    double r_R = 0, r_Z = 0, z_R = 0, z_Z = 0, t = 0;
    for (std::size_t a = 0; a < nn; ++a) {
      const double r = x[2 * a * n + e], z = x[(2 * a + 1) * n + e];
      r_R += by_r[a] * r;
      r_Z += by_z[a] * r;
      z_R += by_r[a] * z;
      z_Z += by_z[a] * z;
      t += over_R[a * n + e] * r;
    }
    f0[e] = r_R;
    f1[e] = r_Z;
    f2[e] = z_R;
    f3[e] = z_Z;
    f4[e] = t;
  }
  for (std::size_t e = 0; e < narrow_.size(); ++e) {
    f0[e] *= narrow_[e];
    f2[e] *= narrow_[e];
  }
}

/// f, twice the derivatives of W by C without shear, the pressure and dV, of the lanes of Gauss point g.
template <std::size_t Order>
auto Row<Order>::lanes_at(std::size_t g) const {
  struct Lane {
    double f0, f1, f2, f3, f4, wt, wz, wr, q, dV;
  };
  return [
    at = f.data() + g * n_, w = first.data() + g * n_, R = measure_.data() + g * n_, modes = q_.data(), all = ng * n_,
    n = n_, weight = area(g), xi = element_.xi[g], eta = element_.eta[g]
  ](std::size_t e) __attribute__((always_inline)) {
    static_cast<void>(n);  // of nine-node elements
    double q = modes[e];
    if constexpr (np == 3) q += xi * modes[n + e] + eta * modes[2 * n + e];
    return Lane{at[e],           at[all + e],        at[2 * all + e],
                at[3 * all + e], at[4 * all + e],    2 * w[e],
                2 * w[all + e],  2 * w[2 * all + e], q,
                weight * R[e]};
  };
}

/// p at Gauss point g, times its weight.
template <std::size_t Order>
void Row<Order>::stress(std::size_t g, bool sees_shear) {
  const std::size_t all = ng * n_;
  const double* __restrict__ const at = f.data() + g * n_;
  const double* __restrict__ const w = first.data() + g * n_;
  double* __restrict__ const p = p_.data();
  const double weight = area(g);
  const double* __restrict__ const R = measure_.data() + g * n_;
  const auto lane = lanes_at(g);
#pragma GCC ivdep
  for (std::size_t e = 0; e < n_; ++e) {
    const auto [f0, f1, f2, f3, f4, wt, wz, wr, q, dV] = lane(e);
    const double qf = q * f4;
    // ∂C by f, and J = f4 (f0 f3 − f1 f2)
    p[e] = dV * (wr * f0 - qf * f3);
    p[n_ + e] = dV * (wz * f1 + qf * f2);
    p[2 * n_ + e] = dV * (wr * f2 + qf * f1);
    p[3 * n_ + e] = dV * (wz * f3 - qf * f0);
    p[4 * n_ + e] = dV * (wt * f4 - q * (f0 * f3 - f1 * f2));
  }
  if (!sees_shear) return;
#pragma GCC ivdep
  for (std::size_t e = 0; e < n_; ++e) {
    const double ws = weight * R[e] * w[3 * all + e];
    p[e] += ws * at[all + e];
    p[n_ + e] += ws * at[e];
    p[2 * n_ + e] += ws * at[3 * all + e];
    p[3 * n_ + e] += ws * at[2 * all + e];
  }
}

/// A at Gauss point g, times its weight; entry (i, j) at upper(i, j).
template <std::size_t Order>
void Row<Order>::moduli(std::size_t g, bool sees_shear, double& stiffness) {
  const std::size_t all = ng * n_;
  const double* __restrict__ const h = second.data() + g * n_;
  double* __restrict__ const a = a_.data();
  double* __restrict__ const modulus = scratch.data();
  const auto lane = lanes_at(g);
#pragma GCC ivdep
  for (std::size_t e = 0; e < n_; ++e) {
    const auto [f0, f1, f2, f3, f4, wt, wz, wr, q, dV] = lane(e);
    // ∂C_t/∂f = (0, 0, 0, 0, 2 f4), ∂C_z/∂f = (0, 2 f1, 0, 2 f3, 0), ∂C_r/∂f = (2 f0, 0, 2 f2, 0, 0)
    const double tt = 4 * h[e], zz = 4 * h[all + e], rr = 4 * h[2 * all + e], tz = 4 * h[3 * all + e],
                 zr = 4 * h[4 * all + e], tr = 4 * h[5 * all + e], qf = q * f4;
    a[upper(0, 0) * n_ + e] = dV * (rr * f0 * f0 + wr);
    a[upper(0, 1) * n_ + e] = dV * (zr * f0 * f1);
    a[upper(0, 2) * n_ + e] = dV * (rr * f0 * f2);
    a[upper(0, 3) * n_ + e] = dV * (zr * f0 * f3 - qf);
    a[upper(0, 4) * n_ + e] = dV * (tr * f0 * f4 - q * f3);
    a[upper(1, 1) * n_ + e] = dV * (zz * f1 * f1 + wz);
    a[upper(1, 2) * n_ + e] = dV * (zr * f1 * f2 + qf);
    a[upper(1, 3) * n_ + e] = dV * (zz * f1 * f3);
    a[upper(1, 4) * n_ + e] = dV * (tz * f1 * f4 + q * f2);
    a[upper(2, 2) * n_ + e] = dV * (rr * f2 * f2 + wr);
    a[upper(2, 3) * n_ + e] = dV * (zr * f2 * f3);
    a[upper(2, 4) * n_ + e] = dV * (tr * f2 * f4 + q * f1);
    a[upper(3, 3) * n_ + e] = dV * (zz * f3 * f3 + wz);
    a[upper(3, 4) * n_ + e] = dV * (tz * f3 * f4 - q * f0);
    a[upper(4, 4) * n_ + e] = dV * (tt * f4 * f4 + wt);
    modulus[e] = tt * f4 * f4 + zz * f3 * f3 + rr * f0 * f0 + std::abs(wt);
  }
  double largest = 0, sum = 0;
#pragma GCC ivdep
  for (std::size_t e = 0; e < n_; ++e) {
    largest = std::max(largest, modulus[e]);
    sum += modulus[e];
  }
  stiffness = std::isfinite(sum) ? std::max(stiffness, largest) : sum;
  if (sees_shear) add_shear(g);
}

/// What the energy adds to A where it depends on s = C_zr, ∂s/∂f = (f1, f0, f3, f2, 0).
template <std::size_t Order>
void Row<Order>::add_shear(std::size_t g) {
  const std::size_t all = ng * n_;
#pragma GCC ivdep
  for (std::size_t e = 0; e < n_; ++e) {
    const auto at = [&](std::size_t i) { return f[i * all + g * n_ + e]; };
    const auto h = [&](std::size_t i) { return second[i * all + g * n_ + e]; };
    const double dV = volume(g, e), ws = first[3 * all + g * n_ + e];
    const double s[5] = {at(1), at(0), at(3), at(2), 0};
    const double t[5] = {0, 0, 0, 0, 2 * at(4)}, z[5] = {0, 2 * at(1), 0, 2 * at(3), 0},
                 r[5] = {2 * at(0), 0, 2 * at(2), 0, 0};
    for (std::size_t j = 0; j < 5; ++j)
      for (std::size_t i = 0; i <= j; ++i)
        a_[upper(i, j) * n_ + e] += dV * (h(6) * s[i] * s[j] + h(7) * (t[i] * s[j] + s[i] * t[j]) +
                                          h(8) * (z[i] * s[j] + s[i] * z[j]) + h(9) * (r[i] * s[j] + s[i] * r[j]));
    a_[upper(0, 1) * n_ + e] += dV * ws;
    a_[upper(2, 3) * n_ + e] += dV * ws;
  }
}

template <std::size_t Order>
void Row<Order>::add_force(std::size_t g, double* to) {
  const double to_z = 2 / height(row_), to_r = 2 / h_;
  const double* __restrict__ const p = p_.data();
  for (std::size_t a = 0; a < nn; ++a) {
    const double by_r = element_.by_xi[g][a] * to_r, by_z = element_.by_eta[g][a] * to_z;
    const double* __restrict__ const t = over_radius_.data() + (g * nn + a) * n_;
    double* __restrict__ const r = to + 2 * a * n_;
    double* __restrict__ const z = r + n_;
#pragma GCC ivdep
    for (std::size_t e = 0; e < n_; ++e) {
      r[e] += by_r * p[e] + by_z * p[n_ + e] + t[e] * p[4 * n_ + e];
      z[e] += by_r * p[2 * n_ + e] + by_z * p[3 * n_ + e];
    }
  }
}

/// Derivatives by r_R and z_R, times the mean length over that of the lane: shape functions are those of mean elements.
template <std::size_t Order>
void Row<Order>::narrow(std::vector<double>& of, bool twice) const {
  for (std::size_t j = 0; j < 5; ++j)
    for (std::size_t i = twice ? 0 : j; i <= j; ++i) {
      const int times = (j == 0 || j == 2 ? 1 : 0) + (twice && (i == 0 || i == 2) ? 1 : 0);
      double* const at = of.data() + (twice ? upper(i, j) : j) * n_;
      for (int pass = 0; pass < times; ++pass)
        for (std::size_t e = 0; e < n_; ++e) at[e] *= narrow_[e];
    }
}

}  // namespace tunica::fe
