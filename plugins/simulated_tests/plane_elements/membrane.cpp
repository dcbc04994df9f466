// SPDX-License-Identifier: Apache-2.0
#include "membrane.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::plane {
namespace {

constexpr std::array<std::size_t, 3> in_plane{0, 1, 3};  ///< tt, zz, tz among tt, zz, rr, tz, zr, tr
constexpr std::array<double, 3> twice{1, 1, 2};          ///< an off-diagonal entry counts twice
constexpr std::size_t rr = 2;

}  // namespace

Membrane::Membrane(const Model& model, std::span<const double> parameters, std::array<double, 2> along, Faces faces)
    : model_(model), parameters_(parameters), faces_(faces) {
  const auto [t, z] = along;
  dyad_ = {{{t * t, z * z, t * z}, {z * z, t * t, -t * z}, {-t * z, t * z, 0.5 * (t * t - z * z)}}};
}

void Membrane::resize(std::size_t n) {
  n_ = n;
  C.assign(3 * n, 0);
  stress.assign(3 * n, 0);
  tangent.assign(9 * n, 0);
  normal.assign(n, 1);
  C6_.assign(6 * n, 0);
  S6_.assign(6 * n, 0);
  A6_.assign(36 * n, 0);
}

bool Membrane::respond(bool with_tangent, bool with_parameters) {
  const std::size_t n = n_;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t c = 0; c < 3; ++c)
      C6_[in_plane[c] * n + i] = C[i] * dyad_[0][c] + C[n + i] * dyad_[1][c] + 2 * C[2 * n + i] * dyad_[2][c];
    C6_[rr * n + i] = normal[i];
  }
  return model_
      .evaluate({n, C6_, parameters_, {}, {}}, {{},
                                                S6_,
                                                {A6_.data(), with_tangent ? A6_.size() : 0},
                                                {S6_dp_.data(), with_parameters ? S6_dp_.size() : 0},
                                                {}})
      .ok();
}

/// Newton's method on S_rr(u) = 0 of every point, in ln u.
bool Membrane::free_the_faces() {
  constexpr int most = 30;
  for (int iteration = 0; iteration < most; ++iteration) {
    if (!respond(true, false)) return false;
    double largest = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double u = normal[i], slope = S6_[rr * n_ + i] + 0.5 * u * A6_[(6 * rr + rr) * n_ + i];
      const double step = -S6_[rr * n_ + i] / slope;
      if (!std::isfinite(step) || !(slope > 0)) return false;
      largest = std::max(largest, std::abs(step));
      normal[i] = u * std::exp(std::clamp(step, -0.5, 0.5));
    }
    if (largest < 1e-9) return true;
  }
  return false;
}

bool Membrane::evaluate(bool with_tangent, bool with_parameters) {
  const std::size_t n = n_, count = parameters_.size();
  with_tangent = with_tangent || (with_parameters && faces_ == Faces::free);
  if (with_parameters) {
    S6_dp_.resize(6 * count * n);
    stress_dp.resize(3 * count * n);
  }
  const bool incompressible = faces_ == Faces::incompressible, free = faces_ == Faces::free;
  if (free && !free_the_faces()) return false;
  if (incompressible)
    for (std::size_t i = 0; i < n; ++i) {
      const double det = C[i] * C[n + i] - C[2 * n + i] * C[2 * n + i];
      if (!(det > 0)) return false;
      normal[i] = 1 / det;
    }
  if (!respond(with_tangent || free, with_parameters)) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const double xx = C[i], yy = C[n + i], xy = C[2 * n + i], u = normal[i];
    const double det = xx * yy - xy * xy;
    const Plane G{yy / det, xx / det, -xy / det};
    const double S_rr = S6_[rr * n + i];
    const auto turned = [&](const std::vector<double>& of, std::size_t first, std::size_t a) {
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c) sum += twice[c] * dyad_[a][c] * of[(first + in_plane[c]) * n + i];
      return sum;
    };
    for (std::size_t a = 0; a < 3; ++a) {
      const double s = turned(S6_, 0, a) - (incompressible ? u * S_rr * G[a] : 0);
      if (!std::isfinite(s)) return false;
      stress[a * n + i] = s;
    }
    Plane A_rr;
    double A_rrrr = 0;
    if (with_tangent) {
      A_rrrr = A6_[(6 * rr + rr) * n + i];
      for (std::size_t a = 0; a < 3; ++a) A_rr[a] = turned(A6_, 6 * rr, a);
      // G⊙G of xx, yy, xy.
      const std::array<Plane, 3> GG{{{G[0] * G[0], G[2] * G[2], G[0] * G[2]},
                                     {G[2] * G[2], G[1] * G[1], G[1] * G[2]},
                                     {G[0] * G[2], G[1] * G[2], 0.5 * (G[0] * G[1] + G[2] * G[2])}}};
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = a; b < 3; ++b) {
          double A = 0;
          for (std::size_t c = 0; c < 3; ++c) A += twice[c] * dyad_[a][c] * turned(A6_, 6 * in_plane[c], b);
          if (free) A -= A_rr[a] * A_rr[b] / A_rrrr;
          if (incompressible)
            A += -u * (A_rr[a] * G[b] + G[a] * A_rr[b]) + u * u * A_rrrr * G[a] * G[b] +
                 2 * u * S_rr * (G[a] * G[b] + GG[a][b]);
          tangent[(3 * a + b) * n + i] = tangent[(3 * b + a) * n + i] = A;
        }
    }
    for (std::size_t j = 0; with_parameters && j < count; ++j) {
      const double by_rr = S6_dp_[(6 * j + rr) * n + i];
      for (std::size_t a = 0; a < 3; ++a)
        stress_dp[(3 * j + a) * n + i] = turned(S6_dp_, 6 * j, a) - (free             ? A_rr[a] * by_rr / A_rrrr
                                                                     : incompressible ? u * by_rr * G[a]
                                                                                      : 0);
    }
  }
  return true;
}

}  // namespace tunica::plane
