// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "tunica/detail/hyperelastic_part_batch.hpp"
#include "tunica/detail/vector_level.hpp"

/// Free strips of a sum of parts, W = Σ w ψ(x): Newton's method over lanes, with the derivatives of W(l, y) that
/// strip_path.hpp defines. On a strip an invariant is x = a1 c1 + a2 c2 + a3 c3 + i2 I2 + offset, and with p_ab = i2
/// c_a c_b
///
///     x_y = a2 c2 − a3 c3 + p12 − p31,          x_yy = a2 c2 + a3 c3 + p12 + p31,
///     ½ x_l = a1 c1 − a3 c3 + p12 − p23,        ½ x_ly = a3 c3 + p12,          ¼ x_ll = a1 c1 + a3 c3 + p12 + p23,
///
/// so that ½ W_ly = Σ w (ψ'' x_y ½ x_l + ψ' ½ x_ly), and alike for the others. Everything lies on the stack, a chunk of
/// rows at a time.
namespace tunica::hyperelastic {

/// An invariant along a strip, and where its part is off: while x < edge, or while f1 c1 + f2 c2 < fibre_edge.
struct StripInvariant {
  double a1, a2, a3, i2, offset;
  double weight;              ///< 2 for a mirrored pair
  double edge;                ///< −∞ where x decides nothing
  double f1, f2, fibre_edge;  ///< 0, 0, −1 where the fibres' own stretch decides nothing
};

/// Up to `chunk` rows. The last vector is filled up with copies of the last row.
struct StripLanes {
  using Row = std::array<double, chunk>;
  StripLanes() {}                               // leaves the arrays as they are: entries that are read were written
  alignas(64) Row c1, u, c3;                    ///< squared stretches: along, across, through the thickness
  alignas(64) Row x, weight, first, second;     ///< of one part: invariant, w or 0, ψ', ψ''
  alignas(64) Row by_y, by_l, by_yy, by_ly;     ///< W_y, ½ W_l, W_yy, ½ W_ly
  alignas(64) Row by_ll;                        ///< ¼ W_ll
  alignas(64) Row step, stress;                 ///< Newton's, relative to u; σ after it, to first order
  alignas(64) Row u_before, r_before, u_per_r;  ///< of the pass before: u, W_y, ∂u/∂W_y
  alignas(64) Row bend, bend_before;            ///< at nodes: ½ W_ly/W_yy at the u of this pass, and the pass before
};

/// One part along a strip.
struct StripPart {
  const EnergyPart* part;
  const EnergyPart::Description* description;
  Invariant invariant;
  Direction direction;
  StripInvariant x;
  double slope;                                      ///< w ψ' of a linear part
  std::array<double, max_part_parameters> slope_dp;  ///< ∂ψ'/∂p of a linear part, by the parameters of its response
  bool is_linear;  ///< ψ'' = 0, x linear in C: adds a constant to the derivatives of W by c
};

/// x of a part, and its weight. What is off has the weight 0, and x = 0, where every law is finite; NaN is not off.
[[gnu::always_inline]] inline void strip_invariant(StripLanes& s, const StripInvariant& v, std::size_t lanes) {
  const double a1 = v.a1, a2 = v.a2, a3 = v.a3, i2 = v.i2, offset = v.offset, w = v.weight, edge = v.edge;
  const double f1 = v.f1, f2 = v.f2, fibre_edge = v.fibre_edge;
  TUNICA_LANES
  for (std::size_t i = 0; i < lanes; ++i) {
    const double c1 = s.c1[i], u = s.u[i], c3 = s.c3[i];
    const double x = a1 * c1 + a2 * u + a3 * c3 + i2 * (c1 * u + u * c3 + c3 * c1) + offset;
    const bool off = (x < edge) | (f1 * c1 + f2 * u < fibre_edge);
    s.x[i] = off ? 0 : x;
    s.weight[i] = off ? 0 : w;
  }
}

/// c3, and the derivatives of W that the linear parts make; `linear` are theirs by c1, c2, c3.
[[gnu::always_inline]] inline void begin_strip(StripLanes& s, const std::array<double, 3>& linear, std::size_t lanes) {
  const double k1 = linear[0], k2 = linear[1], k3 = linear[2];
  TUNICA_LANES
  for (std::size_t i = 0; i < lanes; ++i) {
    const double c1 = s.c1[i], u = s.u[i], c3 = 1 / (c1 * u), m2 = k2 * u, m3 = k3 * c3;
    s.c3[i] = c3;
    s.by_y[i] = m2 - m3;
    s.by_l[i] = k1 * c1 - m3;
    s.by_yy[i] = m2 + m3;
    s.by_ly[i] = m3;
  }
}

/// Adds a part, ψ' and ψ'' of which are known.
[[gnu::always_inline]] inline void add_to_strip(StripLanes& s, const StripInvariant& v, std::size_t lanes) {
  const double a1 = v.a1, a2 = v.a2, a3 = v.a3, i2 = v.i2;
  TUNICA_LANES
  for (std::size_t i = 0; i < lanes; ++i) {
    const double c1 = s.c1[i], u = s.u[i], c3 = s.c3[i];
    const double first = s.weight[i] * s.first[i], second = s.weight[i] * s.second[i];
    const double p12 = i2 * (c1 * u), p23 = i2 * (u * c3), p31 = i2 * (c3 * c1);
    const double x1 = a1 * c1, x2 = a2 * u, x3 = a3 * c3;
    const double x_y = x2 - x3 + (p12 - p31), x_l = x1 - x3 + (p12 - p23), bent = second * x_y;
    s.by_y[i] += first * x_y;
    s.by_l[i] += first * x_l;
    s.by_yy[i] += bent * x_y + first * (x2 + x3 + (p12 + p31));
    s.by_ly[i] += bent * x_l + first * (x3 + p12);
  }
}

/// Newton's step, NaN where W has no minimum over y, and σ after it.
[[gnu::always_inline]] inline void end_strip(StripLanes& s, std::size_t lanes) {
  TUNICA_LANES
  for (std::size_t i = 0; i < lanes; ++i) {
    const double yy = s.by_yy[i], quotient = -s.by_y[i] / yy;
    s.step[i] = yy > 0 ? quotient : std::numeric_limits<double>::quiet_NaN();
    s.stress[i] = 2 * (s.by_l[i] + s.by_ly[i] * quotient);
  }
}

/// The same four for energies of linear parts and one more without I2, which most are, in two loops: before the law is
/// asked, and afterwards.
[[gnu::always_inline]] inline void begin_single(StripLanes& s, const StripInvariant& v, std::size_t lanes) {
  const double a1 = v.a1, a2 = v.a2, a3 = v.a3, offset = v.offset, w = v.weight, edge = v.edge;
  TUNICA_LANES
  for (std::size_t i = 0; i < lanes; ++i) {
    const double c1 = s.c1[i], u = s.u[i], c3 = 1 / (c1 * u);
    s.c3[i] = c3;
    const double x = a1 * c1 + a2 * u + a3 * c3 + offset;
    s.x[i] = x < edge ? 0 : x;
    s.weight[i] = x < edge ? 0 : w;
  }
}
[[gnu::always_inline]] inline void end_single(StripLanes& s, const StripInvariant& v,
                                              const std::array<double, 3>& linear, std::size_t lanes) {
  const double a1 = v.a1, a2 = v.a2, a3 = v.a3, k1 = linear[0], k2 = linear[1], k3 = linear[2];
  TUNICA_LANES
  for (std::size_t i = 0; i < lanes; ++i) {
    const double c1 = s.c1[i], u = s.u[i], c3 = s.c3[i];
    const double first = s.weight[i] * s.first[i], second = s.weight[i] * s.second[i];
    const double x2 = a2 * u, x3 = a3 * c3, x_y = x2 - x3, x_l = a1 * c1 - x3, bent = second * x_y;
    const double m2 = k2 * u, m3 = k3 * c3;
    const double y = m2 - m3 + first * x_y, yy = m2 + m3 + (bent * x_y + first * (x2 + x3));
    const double l = k1 * c1 - m3 + first * x_l, ly = m3 + (bent * x_l + first * x3);
    const double quotient = -y / yy;
    s.by_y[i] = y;
    s.by_yy[i] = yy;
    s.by_ly[i] = ly;
    s.step[i] = yy > 0 ? quotient : std::numeric_limits<double>::quiet_NaN();
    s.stress[i] = 2 * (l + ly * quotient);
  }
}

}  // namespace tunica::hyperelastic
