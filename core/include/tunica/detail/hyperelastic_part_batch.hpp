// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "tunica/detail/vector_level.hpp"
#include "tunica/energy_part.hpp"

/// The kernels of Hyperelastic: chunks of points on the stack, plain loops that the compiler vectorises.
namespace tunica::hyperelastic {

using Parts = std::vector<std::unique_ptr<EnergyPart>>;

constexpr std::size_t chunk = 64;  ///< points at a time
constexpr std::size_t max_model_parameters = 64;
constexpr std::size_t max_part_parameters = 16;  ///< invariant or response parameters of one part

/// The structural tensor A of an invariant x = A : C + i2 I2 + offset for one fibre family, components tt, zz, rr, tz,
/// zr, tr.
struct Structure {
  double tt = 0, zz = 0, rr = 0, tz = 0, i2 = 0, offset = 0, zr = 0, tr = 0;
};

/// Sine and cosine of a fibre angle; `side` is +1 or −1: the family at +angle or at −angle.
struct Direction {
  double s = 0, c = 1;
  Direction() = default;
  Direction(const Invariant& v, double side) {
    if (v.angle != 0) {
      s = side * std::sin(v.angle);
      c = std::cos(v.angle);
    }
    if (std::abs(c) < 1e-15) c = 0;  // 90 degrees: what rounding leaves would be multiplied by exponentials
  }
};

inline Structure structure(const Invariant& v, const Direction& m) {
  return {v.i1 + v.fibre * m.s * m.s, v.i1 + v.fibre * m.c * m.c, v.i1 + v.normal, v.fibre * m.s * m.c, v.i2, v.offset,
          0.5 * v.across * m.c,       0.5 * v.across * m.s};
}

/// Derivative of the structure by a parameter; d holds the derivative of the coefficients, for the family at +angle.
inline Structure structure_derivative(const Invariant& v, const Invariant& d, const Direction& m, double side) {
  const double turn = side * d.angle, by_angle = v.fibre * turn;  // ∂s = c turn, ∂c = −s turn
  const double sc = m.s * m.c;
  return {d.i1 + d.fibre * m.s * m.s + 2 * sc * by_angle,
          d.i1 + d.fibre * m.c * m.c - 2 * sc * by_angle,
          d.i1 + d.normal,
          d.fibre * sc + (m.c * m.c - m.s * m.s) * by_angle,
          d.i2,
          d.offset,
          0.5 * (d.across * m.c - v.across * m.s * turn),
          0.5 * (d.across * m.s + v.across * m.c * turn)};
}

/// n, filled up to whole vectors of the level.
inline std::size_t filled(std::size_t n) {
  const std::size_t width = detail::lanes_of(detail::vector_level());
  return (n + width - 1) / width * width;
}

/// Response of one part at up to `chunk` points; what is not wanted stays untouched. Rows are filled up to whole
/// vectors with the last point, so that no value depends on its place; row j of the derivatives by parameters begins at
/// [j·lanes].
struct PartBatch {
  using Row = std::array<double, chunk>;
  PartBatch() {}  // leaves the arrays as they are: every entry that is read was written before
  alignas(64) Row x, value, first, second;
  alignas(64) std::array<double, chunk * max_part_parameters> value_dp, first_dp;
  std::size_t lanes = 0;  ///< set by respond()

  struct Wants {
    bool value = false, first = false, second = false, parameters = false, value_parameters = false;
  };

  /// At the first m entries of x.
  void respond(const EnergyPart& part, std::span<const double> parameters, std::size_t m, Wants wants) {
    const std::size_t np = part.describe().response_parameters.size();
    lanes = filled(m);
    for (std::size_t i = m; i < lanes; ++i) x[i] = x[m - 1];
    part.respond(parameters, {{x.data(), lanes},
                              {value.data(), wants.value ? lanes : 0},
                              {first.data(), wants.first ? lanes : 0},
                              {second.data(), wants.second ? lanes : 0},
                              {value_dp.data(), wants.value_parameters ? np * lanes : 0},
                              {first_dp.data(), wants.parameters ? np * lanes : 0}});
  }

  /// Silences the points where the part does not contribute. `edge` − tolerance counts as active: at rest rounding
  /// must not decide, and the right limit counts. So does NaN.
  void switch_off_below(const Row& argument, double edge, std::size_t np, std::size_t m, Wants wants) {
    constexpr double tolerance = 1e-12;
    const auto silence = [&argument, edge, m](double* row) {
      TUNICA_LANES
      for (std::size_t i = 0; i < m; ++i) {
        const double kept = row[i];
        row[i] = argument[i] < edge - tolerance ? 0 : kept;
      }
    };
    if (wants.value) silence(value.data());
    if (wants.first) silence(first.data());
    if (wants.second) silence(second.data());
    for (std::size_t j = 0; wants.parameters && j < np; ++j) silence(first_dp.data() + j * lanes);
    for (std::size_t j = 0; wants.value_parameters && j < np; ++j) silence(value_dp.data() + j * lanes);
  }
};

}  // namespace tunica::hyperelastic
