// SPDX-License-Identifier: Apache-2.0
// Compiled once a level with TUNICA_FLOOR_LEVEL = baseline, avx2 or avx512 and the flags of that level: see CMakeLists.
#include "floor_elements.hpp"

namespace tunica::bench::floors {
namespace {

#define TUNICA_TEXT_(word) #word
#define TUNICA_TEXT(word) TUNICA_TEXT_(word)

/// g = ∂W/∂c without the matrix: f e_a, with f = 2 k1 E exp(k2 E²) and its slope by E.
struct Fibre {
  double E, factor, f, slope;
};
inline Fibre fibre(const Energy& w, double ct, double cz, double cr) {
  double E = w.e[0] * ct + w.e[1] * cz + w.e[2] * cr - 1;
  E = E > 0 ? E : 0;
  const double factor = 2 * w.k1 * exponential(w.k2 * E * E);
  return {E, factor, factor * E, factor * (1 + 2 * w.k2 * E * E)};
}

/// P and Q: components of the pulled and the lateral axis among t, z. With c_r = 1/(c1 c2) and q = c_r/c2
///   σ = 2 (c1 g1 − c_r g_r) where c2 g2 = c_r g_r.
template <int P, int Q, bool wants_jacobian, int shapes, int steps>
double strip_of(const Energy& energy, const Strip& s) {
  const Energy w = energy;
  const double e1 = w.e[P], e2 = w.e[Q], er = w.e[2], half = w.mu / 2;
  const std::size_t n = s.n;
  const double* __restrict__ const pulled = s.pulled;
  const double* __restrict__ const measured = s.measured;
  double* __restrict__ const lateral = s.lateral;
  double* __restrict__ const residual = s.residual;
  double* __restrict__ const jacobian = s.jacobian;
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i) {
    const double c1 = pulled[i];
    double c2 = lateral[i], cr = 0, q = 0, stress = 0, by_lateral = 0, determinant = 0;
    Fibre x{};
    for (int step = 0; step < steps; ++step) {
      cr = 1 / (c1 * c2);
      q = cr / c2;
      const double E = e1 * c1 + e2 * c2 + er * cr - 1, positive = E > 0 ? E : 0;
      const double factor = 2 * w.k1 * exponential(w.k2 * positive * positive);
      x = {positive, factor, factor * positive, factor * (1 + 2 * w.k2 * positive * positive)};
      x.slope = E > 0 ? x.slope : 0;
      const double de = e2 - er * q, w1 = half + x.f * e1, w2 = half + x.f * e2, wr = half + x.f * er;
      const double radial = q * wr - cr * er * x.slope * de;
      determinant = w2 + c2 * e2 * x.slope * de + radial;
      by_lateral = c1 * e1 * x.slope * de + radial;
      const double change = (c2 * w2 - cr * wr) / determinant;
      c2 -= change;
      stress = 2 * (c1 * w1 - cr * wr) - 2 * change * by_lateral;
    }
    lateral[i] = c2;
    const double r = stress - measured[i];
    sum += r * r;
    if constexpr (wants_jacobian) {
      // At the state of the last step: dσ/dp = ∂σ/∂p − (∂σ/∂c2)/(∂F/∂c2) ∂F/∂p, F = c2 g2 − c_r g_r.
      residual[i] = r;
      const double used = cr, before = 1 / (c1 * used), ratio = by_lateral / determinant;
      const auto put = [&](int j, double g1, double g2, double gr) {
        jacobian[static_cast<std::size_t>(j) * n + i] =
            2 * (c1 * g1 - used * gr) - 2 * ratio * (before * g2 - used * gr);
      };
      put(0, 0.5, 0.5, 0.5);
      const double by_k1 = x.f / w.k1, by_k2 = x.f * x.E * x.E;
      put(1, by_k1 * e1, by_k1 * e2, by_k1 * er);
      put(2, by_k2 * e1, by_k2 * e2, by_k2 * er);
      for (int j = 0; j < shapes; ++j) {
        const double d1 = w.by_shape[j][P], d2 = w.by_shape[j][Q], dr = w.by_shape[j][2];
        const double dE = d1 * c1 + d2 * before + dr * used, turn = x.slope * dE;
        put(3 + j, turn * e1 + x.f * d1, turn * e2 + x.f * d2, turn * er + x.f * dr);
      }
    }
  }
  return sum;
}

template <int steps>
double strip_in(const Energy& w, const Strip& s) {
  if (s.jacobian == nullptr)
    return s.axial ? strip_of<1, 0, false, 0, steps>(w, s) : strip_of<0, 1, false, 0, steps>(w, s);
  if (w.shapes == 2) return s.axial ? strip_of<1, 0, true, 2, steps>(w, s) : strip_of<0, 1, true, 2, steps>(w, s);
  return s.axial ? strip_of<1, 0, true, 3, steps>(w, s) : strip_of<0, 1, true, 3, steps>(w, s);
}
double strip(const Energy& w, const Strip& s) {
  return s.steps <= 2 ? strip_in<2>(w, s) : s.steps == 3 ? strip_in<3>(w, s) : strip_in<4>(w, s);
}

template <bool wants_energy, bool wants_gradient, bool wants_hessian, int shapes>
void points_of(const Energy& energy, const Points& at) {
  const Energy w = energy;
  const std::size_t n = at.n;
  const double* __restrict__ const c = at.c;
  double* __restrict__ const W = at.energy;
  double* __restrict__ const g = at.gradient;
  double* __restrict__ const h = at.hessian;
  double* __restrict__ const dp = at.gradient_dp;
#pragma omp simd
  for (std::size_t i = 0; i < n; ++i) {
    const double ct = c[i], cz = c[n + i], cr = c[2 * n + i];
    const Fibre x = fibre(w, ct, cz, cr);
    if constexpr (wants_energy) W[i] = w.mu / 2 * (ct + cz + cr - 3) + (x.factor / 2 - w.k1) / w.k2;
    if constexpr (wants_gradient)
      for (int a = 0; a < 3; ++a) g[static_cast<std::size_t>(a) * n + i] = w.mu / 2 + x.f * w.e[a];
    if constexpr (wants_hessian) {
      const double slope = x.E > 0 ? x.slope : 0;
      h[i] = slope * w.e[0] * w.e[0];
      h[n + i] = slope * w.e[1] * w.e[1];
      h[2 * n + i] = slope * w.e[2] * w.e[2];
      h[3 * n + i] = slope * w.e[0] * w.e[1];
      h[4 * n + i] = slope * w.e[1] * w.e[2];
      h[5 * n + i] = slope * w.e[0] * w.e[2];
    }
    if constexpr (shapes > 0) {
      const double by_k1 = x.f / w.k1, by_k2 = x.f * x.E * x.E, slope = x.E > 0 ? x.slope : 0;
      for (int a = 0; a < 3; ++a) {
        const std::size_t to = static_cast<std::size_t>(a) * n + i;
        dp[to] = 0.5;
        dp[3 * n + to] = by_k1 * w.e[a];
        dp[6 * n + to] = by_k2 * w.e[a];
      }
      for (int j = 0; j < shapes; ++j) {
        const double* const d = w.by_shape[j];
        const double turn = slope * (d[0] * ct + d[1] * cz + d[2] * cr);
        for (int a = 0; a < 3; ++a) dp[static_cast<std::size_t>(9 + 3 * j + a) * n + i] = turn * w.e[a] + x.f * d[a];
      }
    }
  }
}

void points(const Energy& w, const Points& at) {
  if (at.gradient == nullptr) return points_of<true, false, false, 0>(w, at);
  if (at.hessian == nullptr) return points_of<false, true, false, 0>(w, at);
  if (at.gradient_dp == nullptr) return points_of<false, true, true, 0>(w, at);
  return w.shapes == 2 ? points_of<false, true, true, 2>(w, at) : points_of<false, true, true, 3>(w, at);
}

template <bool wants_jacobian>
double sheet_of(const Energy& energy, const Sheet& s) {
  const Energy w = energy;
  const std::size_t n = s.n;
  const double* __restrict__ const c = s.c;
  const double* __restrict__ const measured = s.measured;
  double* __restrict__ const residual = s.residual;
  double* __restrict__ const jacobian = s.jacobian;
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i) {
    const double ct = c[i], cz = c[n + i], cr = 1 / (ct * cz);
    const Fibre x = fibre(w, ct, cz, cr);
    const double normal = cr * (w.mu / 2 + x.f * w.e[2]);
    const double rt = 2 * (ct * (w.mu / 2 + x.f * w.e[0]) - normal) - measured[i];
    const double rz = 2 * (cz * (w.mu / 2 + x.f * w.e[1]) - normal) - measured[n + i];
    sum += rt * rt + rz * rz;
    if constexpr (wants_jacobian) {
      residual[i] = rt;
      residual[n + i] = rz;
      const auto put = [&](int j, double gt, double gz, double gr) {
        jacobian[static_cast<std::size_t>(2 * j) * n + i] = 2 * (ct * gt - cr * gr);
        jacobian[static_cast<std::size_t>(2 * j + 1) * n + i] = 2 * (cz * gz - cr * gr);
      };
      put(0, 0.5, 0.5, 0.5);
      const double by_k1 = x.f / w.k1, by_k2 = x.f * x.E * x.E, slope = x.E > 0 ? x.slope : 0;
      put(1, by_k1 * w.e[0], by_k1 * w.e[1], by_k1 * w.e[2]);
      put(2, by_k2 * w.e[0], by_k2 * w.e[1], by_k2 * w.e[2]);
      for (int j = 0; j < 2; ++j) {
        const double* const d = w.by_shape[j];
        const double turn = slope * (d[0] * ct + d[1] * cz + d[2] * cr);
        put(3 + j, turn * w.e[0] + x.f * d[0], turn * w.e[1] + x.f * d[1], turn * w.e[2] + x.f * d[2]);
      }
    }
  }
  return sum;
}

double sheet(const Energy& w, const Sheet& s) {
  return s.jacobian == nullptr ? sheet_of<false>(w, s) : sheet_of<true>(w, s);
}

/// With λz: r² = ri² + (R² − Ri²)/λz, c_t = r²/R², c_r = 1/(c_t c_z). In u = ln R equilibrium is
///   p = ∫ (σ_t − σ_r) d ln r,   d ln r = R²/(λz r²) du;   a change dy of ln ri changes r² by 2 ri² dy.
/// Lanes across pressures, a block of them at a time, so that no pressure waits for another one.
template <bool wants_jacobian, int steps>
double tube_of(const Energy& energy, const Tube& t) {
  constexpr std::size_t block = 8;
  const Energy w = energy;
  const std::size_t n = t.n;
  const double cz = t.cz, lz = __builtin_sqrt(cz), wall = t.outer * t.outer - t.inner * t.inner;
  const double span = __builtin_log(t.outer / t.inner);
  alignas(64) double y[block], wanted[block], ri2[block], p[block], slope[block], by[5][block];
  double sum = 0;
  for (std::size_t first = 0; first < n; first += block) {
    const auto at = [&](std::size_t l) { return first + l < n ? first + l : n - 1; };
    for (std::size_t l = 0; l < block; ++l) {
      y[l] = t.y[at(l)];
      wanted[l] = t.pressure[at(l)];
      for (int j = 0; j < 5; ++j) by[j][l] = 0;
    }
    for (int step = 0; step < steps; ++step) {
#pragma omp simd
      for (std::size_t l = 0; l < block; ++l) {
        ri2[l] = exponential(2 * y[l]);
        p[l] = slope[l] = 0;
      }
      for (std::size_t k = 0; k < t.sections; ++k) {
        const double R2 = t.node[k], gained = (R2 - t.inner * t.inner) / lz, weight = t.weight[k] * span * R2 / lz;
#pragma omp simd
        for (std::size_t l = 0; l < block; ++l) {
          const double r2 = ri2[l] + gained, ct = r2 / R2, cr = 1 / (ct * cz), wt = weight / r2;
          const Fibre x = fibre(w, ct, cz, cr);
          const double turn = x.E > 0 ? x.slope : 0, gt = w.mu / 2 + x.f * w.e[0], gr = w.mu / 2 + x.f * w.e[2],
                       difference = 2 * (ct * gt - cr * gr);
          p[l] += wt * difference;
          const double dct = 2 * ri2[l] / R2, dcr = -cr / ct * dct, curve = turn * (w.e[0] * dct + w.e[2] * dcr);
          slope[l] += wt * (2 * (dct * gt - dcr * gr + ct * curve * w.e[0] - cr * curve * w.e[2]) -
                            difference * 2 * ri2[l] / r2);
          if constexpr (wants_jacobian) {
            if (step < steps - 1) continue;
            const double along = 2 * wt * (ct * w.e[0] - cr * w.e[2]);
            by[0][l] += wt * (ct - cr);
            by[1][l] += along * x.f / w.k1;
            by[2][l] += along * x.f * x.E * x.E;
            for (int j = 0; j < 2; ++j) {
              const double* const d = w.by_shape[j];
              by[3 + j][l] +=
                  along * turn * (d[0] * ct + d[1] * cz + d[2] * cr) + 2 * wt * x.f * (ct * d[0] - cr * d[2]);
            }
          }
        }
      }
      for (std::size_t l = 0; l < block; ++l) y[l] -= (p[l] - wanted[l]) / slope[l];
    }
    for (std::size_t l = 0; l < block && first + l < n; ++l) {
      const std::size_t i = first + l;
      t.y[i] = y[l];
      const double ro = __builtin_sqrt(exponential(2 * y[l]) + wall / lz), r = ro / t.outer - t.measured[i];
      sum += r * r;
      if constexpr (wants_jacobian) {
        t.residual[i] = r;
        const double by_y = ri2[l] / (ro * t.outer) / slope[l];
        for (std::size_t j = 0; j < 5; ++j) t.jacobian[j * n + i] = -by[j][l] * by_y;
      }
    }
  }
  return sum;
}

template <int steps>
double tube_in(const Energy& w, const Tube& t) {
  return t.jacobian == nullptr ? tube_of<false, steps>(w, t) : tube_of<true, steps>(w, t);
}
double tube(const Energy& w, const Tube& t) {
  return t.steps <= 2 ? tube_in<2>(w, t) : t.steps == 3 ? tube_in<3>(w, t) : tube_in<4>(w, t);
}

void elements(const Energy& w, const Elements& m) {
  return m.matrix == nullptr ? elements_of<false>(w, m) : elements_of<true>(w, m);
}

/// Four columns into one of 128 rows, as a band factor does.
void multiply_add(double* to, const double* from, std::size_t repeats) {
  constexpr std::size_t n = 128;
  double* __restrict__ const a = to;
  const double* __restrict__ const b = from;
  for (std::size_t k = 0; k < repeats; ++k) {
    const double w = 1e-9 * static_cast<double>(k);
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) a[i] -= (w * b[i] + w * b[n + i]) + (w * b[2 * n + i] + w * b[3 * n + i]);
  }
}

}  // namespace

const Kernels& TUNICA_FLOOR_LEVEL() {
  static constexpr Kernels kernels{TUNICA_TEXT(TUNICA_FLOOR_LEVEL), strip, points, sheet, tube, elements, multiply_add};
  return kernels;
}

}  // namespace tunica::bench::floors
