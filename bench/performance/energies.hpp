// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string>

#include "floors.hpp"

namespace tunica::bench {

/// The energy of gho or holzapfel_2015 as the floors know it, at parameters in the order of the model; none for others.
/// θ is measured from the axial direction, so that a family has the squared cosines s = sin² θ of t and 1 − s of z.
inline std::optional<floors::Energy> fibre_energy(const std::string& type, std::span<const double> p) {
  const bool symmetric = type == "gho";
  if (!symmetric && type != "holzapfel_2015") return {};
  const std::size_t first = symmetric ? 2 : 3;  // of k1, k2, theta
  const double radian = std::numbers::pi / 180, angle = p[first + 2] * radian;
  const double s = std::sin(angle) * std::sin(angle), turn = std::sin(2 * angle) * radian;
  floors::Energy w{p[0], p[first], p[first + 1], {}, symmetric ? 2u : 3u, {}};
  if (symmetric) {  // E = κ I1 + (1 − 3κ) I4 − 1
    const double kappa = p[1], aligned = 1 - 3 * kappa;
    w = {p[0], p[2],
         p[3], {kappa + aligned * s, kappa + aligned * (1 - s), kappa},
         2,    {{1 - 3 * s, 1 - 3 * (1 - s), 1}, {aligned * turn, -aligned * turn, 0}, {}}};
  } else {  // E = A I1 + B I4 + (1 − 3A − B) c_r − 1
    const double A = p[1], B = p[2];
    w = {p[0], p[3],
         p[4], {A + B * s, A + B * (1 - s), 1 - 2 * A - B},
         3,    {{1, 1, -2}, {s, 1 - s, -1}, {B * turn, -B * turn, 0}}};
  }
  return w;
}

}  // namespace tunica::bench
