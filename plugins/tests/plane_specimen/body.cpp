// SPDX-License-Identifier: Apache-2.0
#include "body.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace tunica::plane {
namespace {

/// The quadratic functions that are 1 at −1, 0 or 1, and their slopes.
std::array<double, 3> line(double x) { return {0.5 * x * (x - 1), 1 - x * x, 0.5 * x * (x + 1)}; }
std::array<double, 3> slope(double x) { return {x - 0.5, -2 * x, x + 0.5}; }

/// The place of local coordinates (s, t), and ∂(X, Y)/∂(s, t).
struct Mapped {
  std::array<double, 3> Ns, Nt, ds, dt;
  double X = 0, Y = 0, Xs = 0, Xt = 0, Ys = 0, Yt = 0;

  Mapped(const Mesh& mesh, const std::array<std::size_t, 9>& element, double s, double t)
      : Ns(line(s)), Nt(line(t)), ds(slope(s)), dt(slope(t)) {
    for (std::size_t a = 0; a < 9; ++a) {
      const auto [x, y] = mesh.nodes[element[a]];
      X += N(a) * x;
      Y += N(a) * y;
      Xs += by_s(a) * x;
      Ys += by_s(a) * y;
      Xt += by_t(a) * x;
      Yt += by_t(a) * y;
    }
  }
  [[nodiscard]] double N(std::size_t a) const { return Ns[a % 3] * Nt[a / 3]; }
  [[nodiscard]] double by_s(std::size_t a) const { return ds[a % 3] * Nt[a / 3]; }
  [[nodiscard]] double by_t(std::size_t a) const { return Ns[a % 3] * dt[a / 3]; }
  [[nodiscard]] double det() const { return Xs * Yt - Xt * Ys; }
};

constexpr std::array<double, 3> gauss_place{-0.7745966692414833770, 0, 0.7745966692414833770};
constexpr std::array<double, 3> gauss_weight{5.0 / 9, 8.0 / 9, 5.0 / 9};
constexpr std::uint32_t nowhere = 0xffffffff;

}  // namespace

Body::Body(const Shape& shape, const Mesh& mesh, Ends ends) : mesh_(mesh) {
  for (const auto& element : mesh_.elements)
    for (std::size_t q = 0; q < 9; ++q) {
      const Mapped at(mesh_, element, gauss_place[q % 3], gauss_place[q / 3]);
      const double det = at.det();
      Gauss point{};
      for (std::size_t a = 0; a < 9; ++a) {
        point.x[a] = (at.by_s(a) * at.Yt - at.by_t(a) * at.Ys) / det;
        point.y[a] = (at.by_t(a) * at.Xs - at.by_s(a) * at.Xt) / det;
      }
      point.weight = std::abs(det) * gauss_weight[q % 3] * gauss_weight[q / 3];
      gauss_.push_back(point);
    }
  hold(shape, ends);
  make_pattern();
}

/// The grips at x = ±length/2 move apart by the pull; planes of symmetry are held.
void Body::hold(const Shape& shape, Ends ends) {
  const double end = shape.length / 2, near = 1e-9 * shape.length;
  grips_.assign(dofs(), 0);
  std::vector<bool> held(dofs(), false);
  for (std::size_t a = 0; a < mesh_.nodes.size(); ++a) {
    const auto [X, Y] = mesh_.nodes[a];
    const bool grip = std::abs(std::abs(X) - end) < near, middle = std::abs(Y) < near;
    if (grip) {
      held[2 * a] = true;
      grips_[2 * a] = X > 0 ? 0.5 : -0.5;
      if (ends == Ends::clamped || middle) held[2 * a + 1] = true;
    }
    if (mesh_.quarter && std::abs(X) < near) held[2 * a] = true;
    if (mesh_.quarter && middle) held[2 * a + 1] = true;
  }
  unknown_.assign(dofs(), none);
  for (std::size_t dof = 0; dof < dofs(); ++dof)
    if (!held[dof]) {
      unknown_[dof] = free_.size();
      free_.push_back(dof);
    }
}

void Body::make_pattern() {
  std::vector<Eigen::Triplet<double>> entries;
  const auto dof_of = [](const std::array<std::size_t, 9>& element, std::size_t k) {
    return 2 * element[k / 2] + k % 2;
  };
  for (const auto& element : mesh_.elements)
    for (std::size_t k = 0; k < 18; ++k)
      for (std::size_t l = 0; l <= k; ++l) {
        const std::size_t i = unknown_[dof_of(element, k)], j = unknown_[dof_of(element, l)];
        if (i != none && j != none)
          entries.emplace_back(static_cast<int>(std::max(i, j)), static_cast<int>(std::min(i, j)), 1.0);
      }
  const auto size = static_cast<Eigen::Index>(unknowns());
  pattern_.resize(size, size);
  pattern_.setFromTriplets(entries.begin(), entries.end());
  pattern_.makeCompressed();
  for (const auto& element : mesh_.elements) {
    std::array<std::uint32_t, 171> place;
    std::size_t at = 0;
    for (std::size_t k = 0; k < 18; ++k)
      for (std::size_t l = 0; l <= k; ++l, ++at) {
        const std::size_t i = unknown_[dof_of(element, k)], j = unknown_[dof_of(element, l)];
        place[at] = i == none || j == none
                        ? nowhere
                        : static_cast<std::uint32_t>(
                              &pattern_.coeffRef(static_cast<int>(std::max(i, j)), static_cast<int>(std::min(i, j))) -
                              pattern_.valuePtr());
      }
    places_.push_back(place);
  }
}

Reading Body::displacement(Vector point, std::size_t component) const {
  double sign = 1;
  if (mesh_.quarter) {  // mirror images move as the first quarter does, but for the sign
    if (point[component] < 0) sign = -1;
    for (double& x : point) x = std::abs(x);
  }
  for (const auto& element : mesh_.elements) {
    double s = 0, t = 0;
    for (int iteration = 0; iteration < 30; ++iteration) {
      const Mapped at(mesh_, element, s, t);
      const double X = at.X - point[0], Y = at.Y - point[1];
      const double step_s = -(X * at.Yt - Y * at.Xt) / at.det(), step_t = -(Y * at.Xs - X * at.Ys) / at.det();
      s += std::clamp(step_s, -1.0, 1.0);
      t += std::clamp(step_t, -1.0, 1.0);
      if (std::abs(s) > 3 || std::abs(t) > 3) break;
      if (std::abs(step_s) + std::abs(step_t) > 1e-12) continue;
      if (std::abs(s) > 1 + 1e-9 || std::abs(t) > 1 + 1e-9) break;
      const Mapped found(mesh_, element, s, t);
      Reading reading;
      for (std::size_t a = 0; a < 9; ++a)
        if (const double weight = found.N(a); std::abs(weight) > 1e-14)
          reading.emplace_back(2 * element[a] + component, sign * weight);
      return reading;
    }
  }
  return {};
}

void Body::strain(std::span<const double> u, std::vector<std::array<double, 4>>& F, Membrane& membrane) const {
  const std::size_t n = points();
  F.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto& element = mesh_.elements[i / 9];
    const Gauss& g = gauss_[i];
    double xx = 1, xy = 0, yx = 0, yy = 1;  // F_iJ = δ_iJ + Σ u_i ∂N/∂X_J
    for (std::size_t a = 0; a < 9; ++a) {
      const double ux = u[2 * element[a]], uy = u[2 * element[a] + 1];
      xx += ux * g.x[a];
      xy += ux * g.y[a];
      yx += uy * g.x[a];
      yy += uy * g.y[a];
    }
    F[i] = {xx, xy, yx, yy};
    membrane.C[i] = xx * xx + yx * yx;
    membrane.C[n + i] = xy * xy + yy * yy;
    membrane.C[2 * n + i] = xx * xy + yx * yy;
  }
}

void Body::forces(const std::vector<std::array<double, 4>>& F, std::span<const double> stress,
                  std::vector<double>& f) const {
  const std::size_t n = points();
  f.assign(dofs(), 0);
  for (std::size_t i = 0; i < n; ++i) {
    const auto& element = mesh_.elements[i / 9];
    const Gauss& g = gauss_[i];
    const auto [xx, xy, yx, yy] = F[i];
    const double S0 = g.weight * stress[i], S1 = g.weight * stress[n + i], S2 = g.weight * stress[2 * n + i];
    // P = F S
    const double Pxx = xx * S0 + xy * S2, Pxy = xx * S2 + xy * S1, Pyx = yx * S0 + yy * S2, Pyy = yx * S2 + yy * S1;
    for (std::size_t a = 0; a < 9; ++a) {
      f[2 * element[a]] += Pxx * g.x[a] + Pxy * g.y[a];
      f[2 * element[a] + 1] += Pyx * g.x[a] + Pyy * g.y[a];
    }
  }
}

void Body::stiffness(const std::vector<std::array<double, 4>>& F, const Membrane& membrane,
                     Eigen::SparseMatrix<double>& K, std::vector<double>& by_pull) const {
  using Strain = Eigen::Matrix<double, 3, 18>;
  const std::size_t n = points();
  double* const values = K.valuePtr();
  std::fill(values, values + K.nonZeros(), 0.0);
  by_pull.assign(dofs(), 0);
  Eigen::Matrix<double, 18, 18> element_K;
  for (std::size_t e = 0; e < mesh_.elements.size(); ++e) {
    const auto& element = mesh_.elements[e];
    element_K.setZero();
    for (std::size_t q = 0; q < 9; ++q) {
      const std::size_t i = 9 * e + q;
      const Gauss& g = gauss_[i];
      const auto [xx, xy, yx, yy] = F[i];
      Strain B;
      for (Eigen::Index a = 0; a < 9; ++a) {
        const double x = g.x[static_cast<std::size_t>(a)], y = g.y[static_cast<std::size_t>(a)];
        B(0, 2 * a) = xx * x;
        B(0, 2 * a + 1) = yx * x;
        B(1, 2 * a) = xy * y;
        B(1, 2 * a + 1) = yy * y;
        B(2, 2 * a) = xx * y + xy * x;
        B(2, 2 * a + 1) = yx * y + yy * x;
      }
      Eigen::Matrix3d D;
      for (Eigen::Index a = 0; a < 3; ++a)
        for (Eigen::Index b = 0; b < 3; ++b)
          D(a, b) = g.weight * membrane.tangent[static_cast<std::size_t>(3 * a + b) * n + i];
      element_K.noalias() += B.transpose() * (D * B);
      const double S0 = g.weight * membrane.stress[i], S1 = g.weight * membrane.stress[n + i],
                   S2 = g.weight * membrane.stress[2 * n + i];
      for (std::size_t a = 0; a < 9; ++a) {
        const double x = S0 * g.x[a] + S2 * g.y[a], y = S2 * g.x[a] + S1 * g.y[a];
        for (std::size_t b = 0; b <= a; ++b) {
          const double geometric = x * g.x[b] + y * g.y[b];
          element_K(static_cast<Eigen::Index>(2 * a), static_cast<Eigen::Index>(2 * b)) += geometric;
          element_K(static_cast<Eigen::Index>(2 * a + 1), static_cast<Eigen::Index>(2 * b + 1)) += geometric;
        }
      }
    }
    std::size_t at = 0;
    for (std::size_t k = 0; k < 18; ++k) {
      const std::size_t row = 2 * element[k / 2] + k % 2;
      for (std::size_t l = 0; l <= k; ++l, ++at) {
        const double value = element_K(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l));
        if (places_[e][at] != nowhere) values[places_[e][at]] += value;
        const std::size_t column = 2 * element[l / 2] + l % 2;
        by_pull[row] += value * grips_[column];
        if (l != k) by_pull[column] += value * grips_[row];
      }
    }
  }
}

}  // namespace tunica::plane
