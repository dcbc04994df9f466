// SPDX-License-Identifier: Apache-2.0
#include "row_change.hpp"
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

template class Row<1>;
template class Row<2>;

}  // namespace tunica::fe
