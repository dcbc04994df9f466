// SPDX-License-Identifier: Apache-2.0
#include "row.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/detail/vector_level.hpp"

namespace tunica::fe {

template <std::size_t Order>
Row<Order>::Row(const Mesh& mesh)
    : mesh_(mesh), n_(mesh.radial), h_((mesh.outer - mesh.inner) / static_cast<double>(n_)) {
  for (std::size_t g = 0; g < ng; ++g)
    for (std::size_t e = 0; e < n_; ++e)
      radius_.push_back(mesh.uniform() ? mesh.inner + h_ * (static_cast<double>(e) + 0.5 * (1 + element_.xi[g]))
                                       : mesh.edge(e) + (mesh.edge(e + 1) - mesh.edge(e)) * 0.5 * (1 + element_.xi[g]));
  measure_ = radius_;
  for (std::size_t e = 0; e < (mesh.uniform() ? 0 : n_); ++e) narrow_.push_back(h_ / (mesh.edge(e + 1) - mesh.edge(e)));
  for (std::size_t i = 0; i < (mesh.uniform() ? 0 : measure_.size()); ++i) measure_[i] /= narrow_[i % n_];
  for (std::size_t g = 0; g < ng; ++g)
    for (std::size_t a = 0; a < nn; ++a)
      for (std::size_t e = 0; e < n_; ++e) over_radius_.push_back(element_.shape[g][a] / radius_[g * n_ + e]);
  for (std::size_t i = 0; i < measure_.size(); ++i)
    unit_volume_.push_back(element_.weight[i / n_] * h_ / 4 * measure_[i]);
  x_.resize(dofs * n_);
  q_.resize(np * n_);
  f.resize(5 * ng * n_);
  C.resize(4 * ng * n_);
  first.resize(4 * ng * n_);
  second.resize(10 * ng * n_);
  p_.resize(5 * n_);
  a_.resize(15 * n_);
  scratch.resize(10 * n_);
  k.resize(dofs * (dofs + 1) / 2 * n_);
  force.resize(dofs * n_);
  coupling.resize(np * dofs * n_);
  c.resize(np * n_);
}

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

template <std::size_t Order>
void Row<Order>::take(const State& state, std::size_t row) {
  row_ = row;
  for (std::size_t a = 0; a < nn; ++a)
#pragma GCC ivdep
    for (std::size_t e = 0; e < n_; ++e) {
      const std::size_t dof = 2 * node(a, e, row);
      x_[2 * a * n_ + e] = state.x[dof];
      x_[(2 * a + 1) * n_ + e] = state.x[dof + 1];
    }
#pragma GCC ivdep
  for (std::size_t e = 0; e < n_; ++e)
    for (std::size_t m = 0; m < np; ++m) q_[m * n_ + e] = state.q[(row * n_ + e) * np + m];
  detail::vectorised([&] { deform(); });
}

/// f and C at every point of the lanes.
template <std::size_t Order>
void Row<Order>::deform() {
  const std::size_t all = ng * n_;
  for (std::size_t g = 0; g < ng; ++g) {
    interpolate(g, x_, f);
    const double* __restrict__ const f0 = f.data() + g * n_;
    const double* __restrict__ const f1 = f0 + all;
    const double* __restrict__ const f2 = f1 + all;
    const double* __restrict__ const f3 = f2 + all;
    const double* __restrict__ const f4 = f3 + all;
    double* __restrict__ const to = C.data() + g * n_;
#pragma GCC ivdep
    for (std::size_t e = 0; e < n_; ++e) {
      to[e] = f4[e] * f4[e];
      to[all + e] = f1[e] * f1[e] + f3[e] * f3[e];
      to[2 * all + e] = f0[e] * f0[e] + f2[e] * f2[e];
      to[3 * all + e] = f0[e] * f1[e] + f2[e] * f3[e];
    }
  }
}

template <std::size_t Order>
Status Row<Order>::evaluate(const Material& material, bool tangent, bool parameters) {
  if (parameters) first_dp.resize(4 * material.parameter_count() * ng * n_);
  return material.evaluate(ng * n_, C, first, tangent ? std::span<double>(second) : std::span<double>(),
                           parameters ? std::span<double>(first_dp) : std::span<double>(), row_);
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
#pragma GCC ivdep
  for (std::size_t e = 0; e < n_; ++e) {
    const double f0 = at[e], f1 = at[all + e], f2 = at[2 * all + e], f3 = at[3 * all + e], f4 = at[4 * all + e];
    const double wt = 2 * w[e], wz = 2 * w[all + e], wr = 2 * w[2 * all + e];
    double q = q_[e];
    if constexpr (np == 3) q += element_.xi[g] * q_[n_ + e] + element_.eta[g] * q_[2 * n_ + e];
    const double dV = weight * R[e], qf = q * f4;
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
  const double* __restrict__ const at = f.data() + g * n_;
  const double* __restrict__ const w = first.data() + g * n_;
  const double* __restrict__ const h = second.data() + g * n_;
  double* __restrict__ const a = a_.data();
  const double weight = area(g);
  const double* __restrict__ const R = measure_.data() + g * n_;
  double* __restrict__ const modulus = scratch.data();
#pragma GCC ivdep
  for (std::size_t e = 0; e < n_; ++e) {
    const double f0 = at[e], f1 = at[all + e], f2 = at[2 * all + e], f3 = at[3 * all + e], f4 = at[4 * all + e];
    const double wt = 2 * w[e], wz = 2 * w[all + e], wr = 2 * w[2 * all + e];
    double q = q_[e];
    if constexpr (np == 3) q += element_.xi[g] * q_[n_ + e] + element_.eta[g] * q_[2 * n_ + e];
    const double dV = weight * R[e];
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

/// Bᵀ A B, where ∂f/∂r_a = (N_R, N_Z, 0, 0, N/R) and ∂f/∂z_a = (0, 0, N_R, N_Z, 0).
template <std::size_t Order>
void Row<Order>::add_stiffness(std::size_t g) {
  const double to_z = 2 / height(row_), to_r = 2 / h_;
  const double* __restrict__ const A = a_.data();
  double* __restrict__ const T = scratch.data();
  const std::size_t n = n_;
  for (std::size_t b = 0; b < nn; ++b) {
    const double br = element_.by_xi[g][b] * to_r, bz = element_.by_eta[g][b] * to_z;
    const double* __restrict__ const bt = over_radius_.data() + (g * nn + b) * n;
    for (std::size_t i = 0; i < 5; ++i) {
      const double* __restrict__ const a0 = A + upper(i, 0) * n;
      const double* __restrict__ const a1 = A + upper(i, 1) * n;
      const double* __restrict__ const a2 = A + upper(i, 2) * n;
      const double* __restrict__ const a3 = A + upper(i, 3) * n;
      const double* __restrict__ const a4 = A + upper(i, 4) * n;
      double* __restrict__ const tr = T + i * n;
      double* __restrict__ const tz = T + (5 + i) * n;
#pragma GCC ivdep
      for (std::size_t e = 0; e < n; ++e) {
        tr[e] = a0[e] * br + a1[e] * bz + a4[e] * bt[e];
        tz[e] = a2[e] * br + a3[e] * bz;
      }
    }
    for (std::size_t a = 0; a <= b; ++a) {
      const double ar = element_.by_xi[g][a] * to_r, az = element_.by_eta[g][a] * to_z;
      const double* __restrict__ const at = over_radius_.data() + (g * nn + a) * n;
      double* __restrict__ const rr = k.data() + upper(2 * a, 2 * b) * n;
      double* __restrict__ const zr = k.data() + upper(2 * a + 1, 2 * b) * n;
      double* __restrict__ const rz = k.data() + upper(2 * a, 2 * b + 1) * n;
      double* __restrict__ const zz = k.data() + upper(2 * a + 1, 2 * b + 1) * n;
#pragma GCC ivdep
      for (std::size_t e = 0; e < n; ++e) {
        rr[e] += ar * T[e] + az * T[n + e] + at[e] * T[4 * n + e];
        rz[e] += ar * T[5 * n + e] + az * T[6 * n + e] + at[e] * T[9 * n + e];
        zz[e] += ar * T[7 * n + e] + az * T[8 * n + e];
      }
      if (a < b)
#pragma GCC ivdep
        for (std::size_t e = 0; e < n; ++e) zr[e] += ar * T[2 * n + e] + az * T[3 * n + e];
    }
  }
}

/// c = ∫ (J − 1) ψ dV and, with the tangent, G = ∂c/∂x.
template <std::size_t Order>
void Row<Order>::add_coupling(std::size_t g, bool tangent) {
  const std::size_t all = ng * n_;
  const double to_z = 2 / height(row_), to_r = 2 / h_, weight = area(g);
  const double* __restrict__ const at = f.data() + g * n_;
  const double* __restrict__ const R = measure_.data() + g * n_;
  double* __restrict__ const j = scratch.data();  // ∂J/∂f · dV, and (J − 1) dV
#pragma GCC ivdep
  for (std::size_t e = 0; e < n_; ++e) {
    const double f0 = at[e], f1 = at[all + e], f2 = at[2 * all + e], f3 = at[3 * all + e], f4 = at[4 * all + e];
    const double dV = weight * R[e], plane = f0 * f3 - f1 * f2;
    j[e] = dV * f4 * f3;
    j[n_ + e] = -dV * f4 * f2;
    j[2 * n_ + e] = -dV * f4 * f1;
    j[3 * n_ + e] = dV * f4 * f0;
    j[4 * n_ + e] = dV * plane;
    j[5 * n_ + e] = dV * (f4 * plane - 1);
  }
  for (std::size_t e = 0; e < narrow_.size(); ++e) {
    j[e] *= narrow_[e];
    j[2 * n_ + e] *= narrow_[e];
  }
  for (std::size_t m = 0; m < np; ++m) {
    const double mode = element_.mode[g][m];
    double* __restrict__ const mean = c.data() + m * n_;
#pragma GCC ivdep
    for (std::size_t e = 0; e < n_; ++e) mean[e] += mode * j[5 * n_ + e];
    for (std::size_t a = 0; a < (tangent ? nn : 0); ++a) {
      const double by_r = mode * element_.by_xi[g][a] * to_r, by_z = mode * element_.by_eta[g][a] * to_z;
      const double* __restrict__ const t = over_radius_.data() + (g * nn + a) * n_;
      double* __restrict__ const r = coupling.data() + (m * dofs + 2 * a) * n_;
      double* __restrict__ const z = r + n_;
#pragma GCC ivdep
      for (std::size_t e = 0; e < n_; ++e) {
        r[e] += by_r * j[e] + by_z * j[n_ + e] + mode * t[e] * j[4 * n_ + e];
        z[e] += by_r * j[2 * n_ + e] + by_z * j[3 * n_ + e];
      }
    }
  }
}

template <std::size_t Order>
void Row<Order>::integrate(bool sees_shear, bool tangent, double& stiffness) {
  detail::vectorised([&] { integrate_lanes(sees_shear, tangent, stiffness); });
}

template <std::size_t Order>
void Row<Order>::integrate_lanes(bool sees_shear, bool tangent, double& stiffness) {
  std::fill(force.begin(), force.end(), 0.0);
  std::fill(c.begin(), c.end(), 0.0);
  if (tangent) {
    std::fill(k.begin(), k.end(), 0.0);
    std::fill(coupling.begin(), coupling.end(), 0.0);
  }
  for (std::size_t g = 0; g < ng; ++g) {
    stress(g, sees_shear);
    if (!narrow_.empty()) narrow(p_, false);
    add_force(g, force.data());
    add_coupling(g, tangent);
    if (!tangent) continue;
    moduli(g, sees_shear, stiffness);
    if (!narrow_.empty()) narrow(a_, true);
    add_stiffness(g);
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

/// φ = B y is the f of y at a point: K y = ∫ Bᵀ A φ dV, G h = ∫ Bᵀ ∂J/∂f h dV, Gᵀ y = ∫ ψ ∂J/∂f · φ dV.
template <std::size_t Order>
void Row<Order>::multiply(bool sees_shear, std::span<const State> fields, std::span<double> forces,
                          std::span<double> dilations) {
  z_.resize(dofs * n_);
  phi_.resize(5 * ng * n_);
  moduli_.resize(15 * ng * n_);
  detail::vectorised([&] { multiply_lanes(sees_shear, fields, forces.data(), dilations.data()); });
}

template <std::size_t Order>
void Row<Order>::multiply_lanes(bool sees_shear, std::span<const State> fields, double* forces, double* dilations) {
  const std::size_t all = ng * n_, n = n_;
  std::fill_n(forces, fields.size() * dofs * n, 0.0);
  std::fill_n(dilations, fields.size() * np * n, 0.0);
  double unused = 0;
  for (std::size_t g = 0; g < ng; ++g) {
    moduli(g, sees_shear, unused);
    std::copy_n(a_.data(), 15 * n, moduli_.data() + 15 * g * n);
  }
  for (std::size_t d = 0; d < fields.size(); ++d) {
    take_field(fields[d].x);
    for (std::size_t g = 0; g < ng; ++g) {
      interpolate(g, z_, phi_);
      double* __restrict__ const h = scratch.data();
      for (std::size_t e = 0; e < n; ++e) {
        const double* const modes = fields[d].q.data() + (row_ * n + e) * np;
        h[e] = modes[0];
        if constexpr (np == 3) h[e] += element_.xi[g] * modes[1] + element_.eta[g] * modes[2];
      }
      const double* __restrict__ const at = f.data() + g * n;
      const double* __restrict__ const phi = phi_.data() + g * n;
      const double* __restrict__ const V = unit_volume_.data() + g * n;
      const double* __restrict__ const A = moduli_.data() + 15 * g * n;
      double* __restrict__ const p = p_.data();
      double* __restrict__ const c0 = dilations + d * np * n;
      const double height = this->height(row_), xi = element_.xi[g], eta = element_.eta[g];
#pragma GCC ivdep
      for (std::size_t e = 0; e < n; ++e) {
        const double f0 = at[e], f1 = at[all + e], f2 = at[2 * all + e], f3 = at[3 * all + e], f4 = at[4 * all + e];
        const double h0 = phi[e], h1 = phi[all + e], h2 = phi[2 * all + e], h3 = phi[3 * all + e],
                     h4 = phi[4 * all + e], dV = height * V[e];
        const double j0 = dV * f4 * f3, j1 = -dV * f4 * f2, j2 = -dV * f4 * f1, j3 = dV * f4 * f0,
                     j4 = dV * (f0 * f3 - f1 * f2);
        const auto times = [&](std::size_t i) {
          return (A[upper(i, 0) * n + e] * h0 + A[upper(i, 1) * n + e] * h1) +
                 (A[upper(i, 2) * n + e] * h2 + A[upper(i, 3) * n + e] * h3) + A[upper(i, 4) * n + e] * h4;
        };
        p[e] = times(0) - j0 * h[e];
        p[n + e] = times(1) - j1 * h[e];
        p[2 * n + e] = times(2) - j2 * h[e];
        p[3 * n + e] = times(3) - j3 * h[e];
        p[4 * n + e] = times(4) - j4 * h[e];
        const double change = (j0 * h0 + j1 * h1) + (j2 * h2 + j3 * h3) + j4 * h4;
        c0[e] += change;
        if constexpr (np == 3) {
          c0[n + e] += xi * change;
          c0[2 * n + e] += eta * change;
        }
      }
      if (!narrow_.empty()) narrow(p_, false);
      add_force(g, forces + d * dofs * n);
    }
  }
}

template <std::size_t Order>
void Row<Order>::take_field(std::span<const double> field) {
  for (std::size_t a = 0; a < nn; ++a)
#pragma GCC ivdep
    for (std::size_t e = 0; e < n_; ++e) {
      const std::size_t dof = 2 * node(a, e, row_);
      z_[2 * a * n_ + e] = field[dof];
      z_[(2 * a + 1) * n_ + e] = field[dof + 1];
    }
}

/// With φ the f of z and δC the change of C along it, d(z · force)/dp_j = ∫ ∂²W/∂C∂p_j · δC dV. The thickness t (1 + g)
/// moves the points of the mesh, by dR/dg = R − Ro =: ρ R, and stretches their elements along R; at fixed x is then
///   dV' = (1 + ρ) dV,   f' = −(f0, 0, f2, 0, ρ f4),   φ' likewise,
///   d(z · force)/dg = ∫ (1 + ρ) p · φ + φ · A f' + p · φ' dV.
template <std::size_t Order>
void Row<Order>::contract(const Material& material, std::span<const std::span<const double>> directions,
                          std::span<double> by) {
  const std::size_t count = material.parameter_count(), all = ng * n_, wanted = directions.size();
  const std::size_t components = material.sees_shear() ? 4 : 3;
  const bool closed = material.closing() != nullptr && material.closing()->differentiated();
  z_.resize(dofs * n_);
  phi_.resize(5 * all);
  thickened_.resize(5 * all);
  strain_.resize(4 * all);
  turned_.resize(closed ? 4 * all : 0);
  double unused = 0;
  detail::vectorised([&] {
    for (std::size_t g = 0; g < ng; ++g) {
      thicken(g, material.sees_shear(), unused);
      if (closed) turn(g, material.sees_shear());
    }
    for (std::size_t d = 0; d < wanted; ++d) {
      take_field(directions[d]);
      for (std::size_t g = 0; g < ng; ++g) interpolate(g, z_, phi_);
      along(by.subspan((count * wanted + d) * all, all));
      if (closed) by_closing_of(*material.closing(), components, by.subspan((count * wanted + d) * all), wanted);
      const double* __restrict__ const s = strain_.data();
      for (std::size_t j = 0; j < count; ++j) {
        double* __restrict__ const sum = by.data() + (j * wanted + d) * all;
        const double* __restrict__ const w = first_dp.data() + 4 * j * all;
#pragma GCC ivdep
        for (std::size_t i = 0; i < all; ++i)
          sum[i] += (w[i] * s[i] + w[all + i] * s[all + i]) + w[2 * all + i] * s[2 * all + i];
        if (components == 4)
#pragma GCC ivdep
          for (std::size_t i = 0; i < all; ++i) sum[i] += w[3 * all + i] * s[3 * all + i];
      }
    }
  });
}

/// δC dV along φ, and what the thickness does along it.
template <std::size_t Order>
void Row<Order>::along(std::span<double> thickness) {
  const std::size_t all = ng * n_;
  const double height = this->height(row_);
  const double* __restrict__ const at = f.data();
  const double* __restrict__ const phi = phi_.data();
  const double* __restrict__ const V = unit_volume_.data();
  const double* __restrict__ const p = thickened_.data();
  double* __restrict__ const strain = strain_.data();
  double* __restrict__ const sum = thickness.data();
#pragma GCC ivdep
  for (std::size_t i = 0; i < all; ++i) {
    const double f0 = at[i], f1 = at[all + i], f2 = at[2 * all + i], f3 = at[3 * all + i], f4 = at[4 * all + i];
    const double h0 = phi[i], h1 = phi[all + i], h2 = phi[2 * all + i], h3 = phi[3 * all + i], h4 = phi[4 * all + i],
                 dV = height * V[i];
    strain[i] = 2 * dV * f4 * h4;
    strain[all + i] = 2 * dV * (f1 * h1 + f3 * h3);
    strain[2 * all + i] = 2 * dV * (f0 * h0 + f2 * h2);
    strain[3 * all + i] = dV * (f0 * h1 + f1 * h0 + f2 * h3 + f3 * h2);
    sum[i] += (p[i] * h0 + p[all + i] * h1) + (p[2 * all + i] * h2 + p[3 * all + i] * h3) + p[4 * all + i] * h4;
  }
}

/// What stands before φ in d(z · force)/dg, with φ' moved on to p: its components 0 and 2 lose one p, that of r/R ρ p.
template <std::size_t Order>
void Row<Order>::thicken(std::size_t g, bool sees_shear, double& unused) {
  const std::size_t all = ng * n_;
  stress(g, sees_shear);
  moduli(g, sees_shear, unused);
  const double* __restrict__ const at = f.data() + g * n_;
  const double* __restrict__ const R = radius_.data() + g * n_;
  for (std::size_t i = 0; i < 5; ++i) {
    const double* __restrict__ const a0 = a_.data() + upper(i, 0) * n_;
    const double* __restrict__ const a2 = a_.data() + upper(i, 2) * n_;
    const double* __restrict__ const a4 = a_.data() + upper(i, 4) * n_;
    const double* __restrict__ const p = p_.data() + i * n_;
    double* __restrict__ const to = thickened_.data() + i * all + g * n_;
    // ρ, or 1 + ρ, or 1 times p
    const double constant = i == 4 || i % 2 == 1 ? 1 : 0, linear = i == 4 ? 0 : 1;
#pragma GCC ivdep
    for (std::size_t e = 0; e < n_; ++e) {
      const double rho = 1 - mesh_.outer / R[e];
      const double kept = constant + linear * rho;
      to[e] = kept * p[e] - (a0[e] * at[e] + a2[e] * at[2 * all + e] + a4[e] * rho * at[4 * all + e]);
    }
  }
}

/// How the derivatives of W by C change with u = ln λ₀², in t, z, r and s: W is a function of C_t eᵘ, C_z, C_r e⁻ᵘ and
/// s e^(−u/2), so that with k = (1, 0, −1, −½) it is ∂W_a/∂u = k_a W_a + Σ_b W_ab k_b C_b.
template <std::size_t Order>
void Row<Order>::turn(std::size_t g, bool sees_shear) {
  const std::size_t all = ng * n_;
  for (std::size_t i = g * n_; i < (g + 1) * n_; ++i) {
    const auto h = [&](std::size_t pair) { return second[pair * all + i]; };
    const double t = C[i], r = C[2 * all + i], s = sees_shear ? 0.5 * C[3 * all + i] : 0;
    turned_[i] = first[i] + h(0) * t - h(5) * r;
    turned_[all + i] = h(3) * t - h(4) * r;
    turned_[2 * all + i] = -first[2 * all + i] + h(5) * t - h(2) * r;
    if (!sees_shear) continue;
    turned_[i] -= h(7) * s;
    turned_[all + i] -= h(8) * s;
    turned_[2 * all + i] -= h(9) * s;
    turned_[3 * all + i] = -0.5 * first[3 * all + i] + h(7) * t - h(9) * r - h(6) * s;
  }
}

/// Adds what the closing of the wall and the factors of its layers do along the change of C.
template <std::size_t Order>
void Row<Order>::by_closing_of(const Closing& closing, std::size_t components, std::span<double> by,
                               std::size_t wanted) {
  const std::size_t all = ng * n_;
  for (std::size_t i = 0; i < all; ++i) {
    double by_square = 0, by_factor = 0;
    for (std::size_t a = 0; a < components; ++a) {
      by_square += turned_[a * all + i] * strain_[a * all + i];
      by_factor += first[a * all + i] * strain_[a * all + i];
    }
    for (std::size_t v = 0; v < geometry_count; ++v)
      by[v * wanted * all + i] += by_square * closing.log_square_by[v][i] + by_factor * closing.log_factor_by[v][i];
  }
}

/// J is of first order in 1/h and in 1/R: J' = −(1 + ρ) J, so that ((J − 1) dV)' = −(1 + ρ) dV.
template <std::size_t Order>
void Row<Order>::dilate(std::span<double> by) {
  std::fill(by.begin(), by.end(), 0.0);
  for (std::size_t g = 0; g < ng; ++g)
    for (std::size_t m = 0; m < np; ++m)
#pragma GCC ivdep
      for (std::size_t e = 0; e < n_; ++e)
        by[m * n_ + e] -=
            area(g) * (measure_[g * n_ + e] * (2 - mesh_.outer / radius_[g * n_ + e])) * element_.mode[g][m];
}

template class Row<1>;
template class Row<2>;

}  // namespace tunica::fe
