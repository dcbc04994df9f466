// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "floors.hpp"

// For floors.cpp alone, which is compiled once a level: everything here is local to it.

// As <math.h> of glibc declares it, without what else comes with that header: libmvec has it for vectors.
extern "C" __attribute__((simd("notinbranch"))) double exp(double) noexcept;

namespace tunica::bench::floors {
namespace {

inline double exponential(double x) { return ::exp(x); }

constexpr std::size_t upper(std::size_t i, std::size_t j) { return i <= j ? j * (j + 1) / 2 + i : i * (i + 1) / 2 + j; }

#if defined(__AVX512F__)
constexpr std::size_t lanes = 8;
#elif defined(__AVX2__)
constexpr std::size_t lanes = 4;
#else
constexpr std::size_t lanes = 2;
#endif
using Lanes [[gnu::vector_size(8 * lanes)]] = double;

/// Lanes across the elements of a row. f = (r_R, r_Z, z_R, z_Z, r/R) is linear in the nodes; p = ∂w/∂f, A = ∂²w/∂f² of
/// w = W − q (J − 1) give the force Bᵀ p and the stiffness Bᵀ A B.
template <bool tangent>
void elements_of(const Energy& energy, const Elements& m) {
  const Energy w = energy;
  const std::size_t across = m.radial + 1, stride = 2 * (m.radial + 2) + 2, dofs = 2 * across * (m.axial + 1);
  const double h = (m.outer - m.inner) / static_cast<double>(m.radial), to_r = 2 / h;
  for (std::size_t i = 0; i < dofs; ++i) m.force[i] = 0;
  if (tangent)
    for (std::size_t i = 0; i < dofs * stride; ++i) m.matrix[i] = 0;
  for (std::size_t k = 0; k < m.axial; ++k) {
    const double height = m.layer[k + 1] - m.layer[k], to_z = 2 / height;
    for (std::size_t first = 0; first < m.radial; first += lanes) {
      Lanes x[8], q, place, F[8] = {}, G[8] = {}, K[36] = {};
      for (std::size_t l = 0; l < lanes; ++l) {
        const std::size_t e = first + l < m.radial ? first + l : m.radial - 1;
        place[l] = static_cast<double>(e);
        q[l] = m.q[k * m.radial + e];
        for (std::size_t a = 0; a < 4; ++a) {
          const std::size_t node = (k + a / 2) * across + e + a % 2;
          x[2 * a][l] = m.x[2 * node];
          x[2 * a + 1][l] = m.x[2 * node + 1];
        }
      }
#pragma GCC unroll 4
      for (int point = 0; point < 4; ++point) {
        const double root = 0.57735026918962576451, xi = point % 2 == 0 ? -root : root, eta = point < 2 ? -root : root;
        double nr[4], nz[4];
        Lanes N[4], f0{}, f1{}, f2{}, f3{}, f4{};
        const Lanes R = m.inner + h * (place + (1 + xi) / 2), over = 1 / R;
        for (int a = 0; a < 4; ++a) {
          const double sx = a % 2 == 0 ? -1 : 1, sy = a < 2 ? -1 : 1;
          N[a] = (1 + sx * xi) * (1 + sy * eta) / 4 * over;
          nr[a] = to_r * sx * (1 + sy * eta) / 4;
          nz[a] = to_z * sy * (1 + sx * xi) / 4;
          f0 += nr[a] * x[2 * a];
          f1 += nz[a] * x[2 * a];
          f2 += nr[a] * x[2 * a + 1];
          f3 += nz[a] * x[2 * a + 1];
          f4 += N[a] * x[2 * a];
        }
        const Lanes plane = f0 * f3 - f1 * f2;
        Lanes E = w.e[0] * f4 * f4 + w.e[1] * (f1 * f1 + f3 * f3) + w.e[2] * (f0 * f0 + f2 * f2) - 1, factor;
        E = E > 0 ? E : 0 * E;
        const Lanes power = w.k2 * E * E;
#pragma omp simd
        for (std::size_t l = 0; l < lanes; ++l) factor[l] = exponential(power[l]);
        factor *= 2 * w.k1;
        const Lanes dV = h * height / 4 * R, g = dV * factor * E, base = dV * w.mu, Q = dV * q;
        const Lanes gt = base + 2 * w.e[0] * g, gz = base + 2 * w.e[1] * g, gr = base + 2 * w.e[2] * g;
        const Lanes p[5] = {gr * f0 - Q * f4 * f3, gz * f1 + Q * f4 * f2, gr * f2 + Q * f4 * f1, gz * f3 - Q * f4 * f0,
                            gt * f4 - Q * plane};
        for (int a = 0; a < 4; ++a) {
          F[2 * a] += nr[a] * p[0] + nz[a] * p[1] + N[a] * p[4];
          F[2 * a + 1] += nr[a] * p[2] + nz[a] * p[3];
        }
        if constexpr (!tangent) continue;
        const Lanes j[5] = {dV * f4 * f3, -dV * f4 * f2, -dV * f4 * f1, dV * f4 * f0, dV * plane};
        const Lanes slope = dV * factor * (1 + 2 * power), s = E > 0 ? slope : 0 * slope;
        const Lanes v[5] = {2 * w.e[2] * f0, 2 * w.e[1] * f1, 2 * w.e[2] * f2, 2 * w.e[1] * f3, 2 * w.e[0] * f4};
        Lanes A[15];
        for (std::size_t c = 0; c < 5; ++c)
          for (std::size_t r = 0; r <= c; ++r) A[upper(r, c)] = s * v[r] * v[c];
        A[upper(0, 0)] += gr;
        A[upper(1, 1)] += gz;
        A[upper(2, 2)] += gr;
        A[upper(3, 3)] += gz;
        A[upper(4, 4)] += gt;
        A[upper(1, 2)] += Q * f4;
        A[upper(0, 3)] -= Q * f4;
        A[upper(0, 4)] -= Q * f3;
        A[upper(1, 4)] += Q * f2;
        A[upper(2, 4)] += Q * f1;
        A[upper(3, 4)] -= Q * f0;
        for (std::size_t b = 0; b < 4; ++b) {
          G[2 * b] += nr[b] * j[0] + nz[b] * j[1] + N[b] * j[4];
          G[2 * b + 1] += nr[b] * j[2] + nz[b] * j[3];
          Lanes tr[5], tz[5];
          for (std::size_t i = 0; i < 5; ++i) {
            tr[i] = A[upper(i, 0)] * nr[b] + A[upper(i, 1)] * nz[b] + A[upper(i, 4)] * N[b];
            tz[i] = A[upper(i, 2)] * nr[b] + A[upper(i, 3)] * nz[b];
          }
          for (std::size_t a = 0; a <= b; ++a) {
            K[upper(2 * a, 2 * b)] += nr[a] * tr[0] + nz[a] * tr[1] + N[a] * tr[4];
            K[upper(2 * a, 2 * b + 1)] += nr[a] * tz[0] + nz[a] * tz[1] + N[a] * tz[4];
            K[upper(2 * a + 1, 2 * b + 1)] += nr[a] * tz[2] + nz[a] * tz[3];
            if (a < b) K[upper(2 * a + 1, 2 * b)] += nr[a] * tr[2] + nz[a] * tr[3];
          }
        }
      }
      if constexpr (tangent) {
        const Lanes weight = m.gamma / ((m.inner + h * (place + 0.5)) * h * height);
        for (std::size_t b = 0; b < 8; ++b) {
          const Lanes heavy = weight * G[b];
          for (std::size_t a = 0; a <= b; ++a) K[upper(a, b)] += heavy * G[a];
        }
      }
      for (std::size_t l = 0; l < lanes && first + l < m.radial; ++l) {
        std::size_t dof[8];
        for (std::size_t a = 0; a < 4; ++a) {
          dof[2 * a] = 2 * ((k + a / 2) * across + first + l + a % 2);
          dof[2 * a + 1] = dof[2 * a] + 1;
        }
        for (std::size_t a = 0; a < 8; ++a) m.force[dof[a]] += F[a][l];
        if constexpr (tangent)
          for (std::size_t a = 0; a < 8; ++a) {
            double* const column = m.matrix + dof[a] * (stride - 1);
            for (std::size_t b = a; b < 8; ++b) column[dof[b]] += K[upper(a, b)][l];
          }
      }
    }
  }
}

}  // namespace
}  // namespace tunica::bench::floors
