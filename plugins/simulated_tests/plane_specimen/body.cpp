// SPDX-License-Identifier: Apache-2.0
#include "body.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace

Body::Body(const Shape& shape, const Mesh& mesh, Ends ends) : mesh_(mesh) {
  for (const auto& element : mesh_.elements)
    for (std::size_t q = 0; q < 9; ++q) {
      const Mapped at(mesh_, element, gauss_place[q % 3], gauss_place[q / 3]);
      const double det = at.det();
      Elements<9, 9>::Gauss point{};
      for (std::size_t a = 0; a < 9; ++a) {
        point.x[a] = (at.by_s(a) * at.Yt - at.by_t(a) * at.Ys) / det;
        point.y[a] = (at.by_t(a) * at.Xs - at.by_s(a) * at.Xt) / det;
      }
      point.weight = std::abs(det) * gauss_weight[q % 3] * gauss_weight[q / 3];
      elements_.gauss.push_back(point);
    }
  elements_.nodes = mesh_.elements;
  hold(shape, ends);
  pattern_ = elements_.pattern(unknown_, none, unknowns());
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

}  // namespace tunica::plane
