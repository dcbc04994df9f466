// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bitset>

#include "tunica/detail/strip_lanes.hpp"

/// Derivatives of W(l, y) by parameters and along a free strip; the notation of strip_lanes.hpp.
namespace tunica::hyperelastic {

/// x_y and ½ x_l of a part.
struct StripSlopes {
  StripSlopes() {}
  alignas(64) StripLanes::Row y, l;
};

/// Weights ψ' and ψ'' of a part, sets its slopes and adds its second derivatives to those of W.
[[gnu::always_inline]] inline void begin_derivatives(StripLanes& s, const StripPart& p, StripSlopes& slopes,
                                                     std::size_t lanes) {
  const double a1 = p.x.a1, a2 = p.x.a2, a3 = p.x.a3, i2 = p.x.i2;
  TUNICA_LANES
  for (std::size_t i = 0; i < lanes; ++i) {
    const double c1 = s.c1[i], u = s.u[i], c3 = s.c3[i];
    const double p12 = i2 * (c1 * u), p23 = i2 * (u * c3), p31 = i2 * (c3 * c1);
    const double x1 = a1 * c1, x2 = a2 * u, x3 = a3 * c3;
    s.first[i] *= s.weight[i];
    s.second[i] *= s.weight[i];
    slopes.y[i] = x2 - x3 + (p12 - p31);
    slopes.l[i] = x1 - x3 + (p12 - p23);
  }
  if (p.is_linear) return;  // begin_strip() and its like have added it
  TUNICA_LANES
  for (std::size_t i = 0; i < lanes; ++i) {
    const double c1 = s.c1[i], u = s.u[i], c3 = s.c3[i], y = slopes.y[i], l = slopes.l[i];
    const double p12 = i2 * (c1 * u), p23 = i2 * (u * c3), p31 = i2 * (c3 * c1), x3 = a3 * c3;
    s.by_yy[i] += s.second[i] * y * y + s.first[i] * (a2 * u + x3 + p12 + p31);
    s.by_ly[i] += s.second[i] * y * l + s.first[i] * (x3 + p12);
    s.by_ll[i] += s.second[i] * l * l + s.first[i] * (a1 * c1 + x3 + p12 + p23);
  }
}

/// W_yp and ½ W_lp, for the parameters that some part depends on.
struct StripByParameters {
  StripByParameters() {}
  alignas(64) std::array<StripLanes::Row, max_model_parameters> y, l;
  std::bitset<max_model_parameters> written;
  bool along_path = false;              ///< l holds ½ W_lp − f W_yp instead, and y nothing
  alignas(64) StripLanes::Row follows;  ///< f = ½ W_ly/W_yy; set by follow_path()

  /// Adds w ∂ψ'/∂p to a parameter of the response.
  [[gnu::always_inline]] void add_response(const StripLanes& s, const StripSlopes& slopes, const double* first_dp,
                                           std::size_t parameter, std::size_t lanes) {
    add(parameter, lanes, [&](std::size_t i, double& by_y, double& by_l) {
      const double by = s.weight[i] * first_dp[i];
      by_y = by * slopes.y[i];
      by_l = by * slopes.l[i];
    });
  }
  /// Adds what a parameter of the invariant does; `d` holds the derivatives of the invariant's coefficients.
  [[gnu::always_inline]] void add_invariant(const StripLanes& s, const StripSlopes& slopes, const Structure& d,
                                            bool axial, std::size_t parameter, std::size_t lanes) {
    const double d1 = axial ? d.zz : d.tt, d2 = axial ? d.tt : d.zz, d3 = d.rr, i2 = d.i2, offset = d.offset;
    add(parameter, lanes, [&](std::size_t i, double& by_y, double& by_l) {
      const double c1 = s.c1[i], u = s.u[i], c3 = s.c3[i];
      const double p12 = i2 * (c1 * u), p23 = i2 * (u * c3), p31 = i2 * (c3 * c1);
      const double x1 = d1 * c1, x2 = d2 * u, x3 = d3 * c3;
      const double bent = s.second[i] * (x1 + x2 + x3 + (p12 + p23 + p31) + offset);
      by_y = bent * slopes.y[i] + s.first[i] * (x2 - x3 + (p12 - p31));
      by_l = bent * slopes.l[i] + s.first[i] * (x1 - x3 + (p12 - p23));
    });
  }

  /// From here on along the path; W_yy and ½ W_ly are complete.
  [[gnu::always_inline]] void follow_path(const StripLanes& s, std::size_t lanes) {
    along_path = true;
    TUNICA_LANES
    for (std::size_t i = 0; i < lanes; ++i) follows[i] = s.by_ly[i] / s.by_yy[i];
  }
  /// x' = ½ x_l − f x_y takes the place of ½ x_l.
  [[gnu::always_inline]] void turn_slopes(StripSlopes& slopes, std::size_t lanes) const {
    TUNICA_LANES
    for (std::size_t i = 0; i < lanes; ++i) slopes.l[i] -= follows[i] * slopes.y[i];
  }
  /// As add_response(), along the path.
  [[gnu::always_inline]] void add_response_along(const StripLanes& s, const StripSlopes& slopes, const double* first_dp,
                                                 std::size_t parameter, std::size_t lanes) {
    add_along(parameter, lanes, [&](std::size_t i) { return s.weight[i] * first_dp[i] * slopes.l[i]; });
  }
  /// As add_invariant(), along the path: w ψ'' x_p x' + w ψ' x'_p.
  [[gnu::always_inline]] void add_invariant_along(const StripLanes& s, const StripSlopes& slopes, const Structure& d,
                                                  bool axial, std::size_t parameter, std::size_t lanes) {
    const double d1 = axial ? d.zz : d.tt, d2 = axial ? d.tt : d.zz, d3 = d.rr, i2 = d.i2, offset = d.offset;
    add_along(parameter, lanes, [&](std::size_t i) {
      const double c1 = s.c1[i], u = s.u[i], c3 = s.c3[i];
      const double p12 = i2 * (c1 * u), p23 = i2 * (u * c3), p31 = i2 * (c3 * c1);
      const double x1 = d1 * c1, x2 = d2 * u, x3 = d3 * c3;
      const double slope = x1 - x3 + (p12 - p23) - follows[i] * (x2 - x3 + (p12 - p31));
      return s.second[i] * (x1 + x2 + x3 + (p12 + p23 + p31) + offset) * slopes.l[i] + s.first[i] * slope;
    });
  }
  /// Adds factor · x' of an invariant with these coefficients.
  [[gnu::always_inline]] void add_slope_along(const StripLanes& s, double factor, const Structure& a, bool axial,
                                              std::size_t parameter, std::size_t lanes) {
    const double a1 = factor * (axial ? a.zz : a.tt), a2 = factor * (axial ? a.tt : a.zz), a3 = factor * a.rr,
                 i2 = factor * a.i2;
    add_along(parameter, lanes, [&](std::size_t i) {
      const double c1 = s.c1[i], u = s.u[i], c3 = s.c3[i];
      const double p12 = i2 * (c1 * u), p23 = i2 * (u * c3), p31 = i2 * (c3 * c1);
      return a1 * c1 - a3 * c3 + (p12 - p23) - follows[i] * (a2 * u - a3 * c3 + (p12 - p31));
    });
  }

 private:
  /// The first part that has something to say sets the row of a parameter.
  template <class Value>
  [[gnu::always_inline]] void add_along(std::size_t parameter, std::size_t lanes, const Value& value) {
    double* const row = l[parameter].data();
    if (written[parameter]) {
      TUNICA_LANES
      for (std::size_t i = 0; i < lanes; ++i) row[i] += value(i);
      return;
    }
    TUNICA_LANES
    for (std::size_t i = 0; i < lanes; ++i) row[i] = value(i);
    written.set(parameter);
  }

  /// The first part that has something to say sets the rows of a parameter.
  template <class Row>
  [[gnu::always_inline]] void add(std::size_t parameter, std::size_t lanes, const Row& row) {
    double* const by_y = y[parameter].data();
    double* const by_l = l[parameter].data();
    if (written[parameter]) {
      TUNICA_LANES
      for (std::size_t i = 0; i < lanes; ++i) {
        double own_y, own_l;
        row(i, own_y, own_l);
        by_y[i] += own_y;
        by_l[i] += own_l;
      }
      return;
    }
    TUNICA_LANES
    for (std::size_t i = 0; i < lanes; ++i) {
      double own_y, own_l;
      row(i, own_y, own_l);
      by_y[i] = own_y;
      by_l[i] = own_l;
    }
    written.set(parameter);
  }
};

}  // namespace tunica::hyperelastic
