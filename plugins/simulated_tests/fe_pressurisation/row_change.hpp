// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "row_lanes.hpp"
#include "tunica/detail/vector_level.hpp"

/// How the equations of a row change, along fields and with parameters; a part of row.cpp.
namespace tunica::fe {

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

/// With δC the change of C along φ, the f of z, d(z · force)/dp_j = ∫ ∂²W/∂C∂p_j · δC dV. The thickness t (1 + g) moves
/// the points of the mesh, by dR/dg = R − Ro =: ρ R, and stretches their elements along R. At fixed x is then
///   dV' = (1 + ρ) dV,   f' = −(f0, 0, f2, 0, ρ f4),   φ' likewise,
///   d(z · force)/dg = ∫ (1 + ρ) p · φ + φ · A f' + p · φ' dV.
template <std::size_t Order>
void Row<Order>::change(const Material& material, std::span<double> by) {
  change_.resize(5 * ng * n_);
  const bool closed = material.closing() != nullptr && material.closing()->differentiated();
  turned_.resize(closed ? 4 * ng * n_ : 0);
  closed_.resize(turned_.size());
  detail::vectorised([&] { change_lanes(material, closed, by.data()); });
}

template <std::size_t Order>
void Row<Order>::change_lanes(const Material& material, bool closed, double* by) {
  const std::size_t count = material.parameter_count(), all = ng * n_;
  const bool sees_shear = material.sees_shear();
  for (std::size_t j = 0; j < count; ++j) {
    pull_back<false>(first_dp.data() + 4 * j * all, sees_shear);
    sum_forces(by + j * dofs * n_);
  }
  for (std::size_t g = 0; g < ng; ++g) thicken(g, sees_shear);
  if (closed)
    for (std::size_t g = 0; g < ng; ++g) turn(g, sees_shear);
  for (std::size_t v = 0; v < (closed ? std::size_t{geometry_count} : 1); ++v) {
    if (closed) {
      close(*material.closing(), v, sees_shear);
      if (v == by_thickness)
        pull_back<true>(closed_.data(), sees_shear);
      else
        pull_back<false>(closed_.data(), sees_shear);
    }
    sum_forces(by + (count + v) * dofs * n_);
  }
}

/// To change_: (∂C/∂f)ᵀ w dV at every point, w derivatives by C in t, z, r and s; or adds that.
template <std::size_t Order>
template <bool Adds>
void Row<Order>::pull_back(const double* w, bool sees_shear) {
  const std::size_t all = ng * n_;
  const double height = this->height(row_), shear = sees_shear ? 1 : 0;
  const double* __restrict__ const at = f.data();
  const double* __restrict__ const V = unit_volume_.data();
  const double* __restrict__ const w_s = w + (sees_shear ? 3 * all : 0);
  double* __restrict__ const p = change_.data();
#pragma GCC ivdep
  for (std::size_t i = 0; i < all; ++i) {
    const double f0 = at[i], f1 = at[all + i], f2 = at[2 * all + i], f3 = at[3 * all + i], f4 = at[4 * all + i];
    const double dV = height * V[i], wt = 2 * dV * w[i], wz = 2 * dV * w[all + i], wr = 2 * dV * w[2 * all + i],
                 ws = shear * dV * w_s[i];
    p[i] = (Adds ? p[i] : 0) + (wr * f0 + ws * f1);
    p[all + i] = (Adds ? p[all + i] : 0) + (wz * f1 + ws * f0);
    p[2 * all + i] = (Adds ? p[2 * all + i] : 0) + (wr * f2 + ws * f3);
    p[3 * all + i] = (Adds ? p[3 * all + i] : 0) + (wz * f3 + ws * f2);
    p[4 * all + i] = (Adds ? p[4 * all + i] : 0) + wt * f4;
  }
}

/// To the dofs: ∫ (∂f/∂x)ᵀ change_, the sum over the points in registers.
template <std::size_t Order>
void Row<Order>::sum_forces(double* to) {
  const std::size_t all = ng * n_, n = n_;
  const double to_z = 2 / height(row_), to_r = 2 / h_;
  double* __restrict__ const p = change_.data();
  for (std::size_t g = 0; g < (narrow_.empty() ? 0 : ng); ++g)
    for (const std::size_t component : {std::size_t{0}, std::size_t{2}})
#pragma GCC ivdep
      for (std::size_t e = 0; e < n; ++e) p[component * all + g * n + e] *= narrow_[e];
  for (std::size_t a = 0; a < nn; ++a) {
    double by_r[ng], by_z[ng];
    for (std::size_t g = 0; g < ng; ++g) {
      by_r[g] = element_.by_xi[g][a] * to_r;
      by_z[g] = element_.by_eta[g][a] * to_z;
    }
    const double* __restrict__ const t = over_radius_.data() + a * n;
    double* __restrict__ const r = to + 2 * a * n;
    double* __restrict__ const z = r + n;
#pragma GCC ivdep
    for (std::size_t e = 0; e < n; ++e) {
      double along_r = 0, along_z = 0;
      for (std::size_t g = 0; g < ng; ++g) {
        const double* __restrict__ const at = p + g * n + e;
        along_r += by_r[g] * at[0] + by_z[g] * at[all] + t[g * nn * n + e] * at[4 * all];
        along_z += by_r[g] * at[2 * all] + by_z[g] * at[3 * all];
      }
      r[e] = along_r;
      z[e] = along_z;
    }
  }
}

/// To change_: what stands before φ in d(z · force)/dg, with φ' moved on to p. Its components 0 and 2 lose one p, that
/// of r/R ρ p.
template <std::size_t Order>
void Row<Order>::thicken(std::size_t g, bool sees_shear) {
  const std::size_t all = ng * n_;
  stress(g, sees_shear);
  const double* __restrict__ const at = f.data() + g * n_;
  const double* __restrict__ const R = radius_.data() + g * n_;
  const double* const A = moduli_.data() + 15 * g * n_;
  for (std::size_t i = 0; i < 5; ++i) {
    const double* __restrict__ const a0 = A + upper(i, 0) * n_;
    const double* __restrict__ const a2 = A + upper(i, 2) * n_;
    const double* __restrict__ const a4 = A + upper(i, 4) * n_;
    const double* __restrict__ const p = p_.data() + i * n_;
    double* __restrict__ const to = change_.data() + i * all + g * n_;
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

/// To closed_: how the derivatives of W by C change with the closing of the wall and the factors of its layers.
template <std::size_t Order>
void Row<Order>::close(const Closing& closing, std::size_t v, bool sees_shear) {
  const std::size_t all = ng * n_;
  const double* __restrict__ const by_square = closing.log_square_by[v].data();
  const double* __restrict__ const by_factor = closing.log_factor_by[v].data();
  for (std::size_t a = 0; a < (sees_shear ? 4 : 3); ++a) {
    const double* __restrict__ const turned = turned_.data() + a * all;
    const double* __restrict__ const w = first.data() + a * all;
    double* __restrict__ const to = closed_.data() + a * all;
#pragma GCC ivdep
    for (std::size_t i = 0; i < all; ++i) to[i] = turned[i] * by_square[i] + w[i] * by_factor[i];
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

}  // namespace tunica::fe
