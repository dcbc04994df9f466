// SPDX-License-Identifier: Apache-2.0
#include "specimen.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::field {
namespace {

/// The quadratic functions of a triangle at (s, t), and their slopes.
struct Functions {
  std::array<double, 6> N, s, t;
  Functions(double x, double y) {
    const double a = 1 - x - y;
    N = {a * (2 * a - 1), x * (2 * x - 1), y * (2 * y - 1), 4 * a * x, 4 * x * y, 4 * y * a};
    s = {1 - 4 * a, 4 * x - 1, 0, 4 * (a - x), 4 * y, -4 * y};
    t = {1 - 4 * a, 0, 4 * y - 1, -4 * x, 4 * x, 4 * (a - y)};
  }
};

/// The place of local coordinates, with ∂(X, Y)/∂(s, t).
struct Mapped : Functions {
  double X = 0, Y = 0, Xs = 0, Xt = 0, Ys = 0, Yt = 0;
  Mapped(const Mesh& mesh, const std::array<std::size_t, 6>& triangle, double x, double y) : Functions(x, y) {
    for (std::size_t a = 0; a < 6; ++a) {
      const auto [px, py] = mesh.nodes[triangle[a]];
      X += N[a] * px;
      Y += N[a] * py;
      Xs += s[a] * px;
      Ys += s[a] * py;
      Xt += t[a] * px;
      Yt += t[a] * py;
    }
  }
  [[nodiscard]] double det() const { return Xs * Yt - Xt * Ys; }
  [[nodiscard]] double by_x(std::size_t a) const { return (s[a] * Yt - t[a] * Ys) / det(); }
  [[nodiscard]] double by_y(std::size_t a) const { return (t[a] * Xs - s[a] * Xt) / det(); }
};

constexpr double sixth = 1.0 / 6;
constexpr std::array<Vector, 3> in_triangle{{{sixth, sixth}, {4 * sixth, sixth}, {sixth, 4 * sixth}}};
constexpr double allowance = 0.05;  ///< of a triangle, by which a point may lie outside

}  // namespace

Specimen::Specimen(Mesh mesh, const std::array<std::array<bool, 2>, 4>& held) : mesh_(std::move(mesh)) {
  low_ = high_ = mesh_.nodes.front();
  for (const Vector& node : mesh_.nodes)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      low_[axis] = std::min(low_[axis], node[axis]);
      high_[axis] = std::max(high_[axis], node[axis]);
    }
  const double near = 1e-6 * std::max(extent(0), extent(1));
  std::vector<bool> is_held(dofs(), false);
  for (std::size_t side = 0; side < 4; ++side) {
    const std::size_t axis = axis_of(side);
    const double end = outwards(side) > 0 ? high_[axis] : low_[axis];
    for (std::size_t a = 0; a < mesh_.nodes.size(); ++a) {
      if (std::abs(mesh_.nodes[a][axis] - end) > near) continue;
      sides_[side].push_back(a);
      for (std::size_t c = 0; c < 2; ++c)
        if (held[side][c]) is_held[2 * a + c] = true;
    }
  }
  unknown_.assign(dofs(), none);
  for (std::size_t dof = 0; dof < dofs(); ++dof)
    if (!is_held[dof]) {
      unknown_[dof] = free_.size();
      free_.push_back(dof);
    }
  make_elements();
  pattern_ = elements_.pattern(unknown_, none, free_.size());
}

void Specimen::make_elements() {
  elements_.nodes = mesh_.triangles;
  for (const auto& triangle : mesh_.triangles) {
    std::array<double, 4> box{1e300, -1e300, 1e300, -1e300};
    for (const std::size_t node : triangle)
      for (std::size_t axis = 0; axis < 2; ++axis) {
        box[2 * axis] = std::min(box[2 * axis], mesh_.nodes[node][axis]);
        box[2 * axis + 1] = std::max(box[2 * axis + 1], mesh_.nodes[node][axis]);
      }
    // A curved edge leaves the box of its nodes by less than this margin.
    const double margin = 2 * allowance * std::max(box[1] - box[0], box[3] - box[2]);
    boxes_.push_back({box[0] - margin, box[1] + margin, box[2] - margin, box[3] + margin});
    for (const auto& [s, t] : in_triangle) {
      const Mapped at(mesh_, triangle, s, t);
      if (!(at.det() > 0))
        throw InputError(fmt::format(
            "full_field: the triangle at ({:g}, {:g}) mm is turned inside out; correct the mesh", at.X, at.Y));
      plane::Elements<6, 3>::Gauss point{};
      for (std::size_t a = 0; a < 6; ++a) {
        point.x[a] = at.by_x(a);
        point.y[a] = at.by_y(a);
      }
      point.weight = at.det() * sixth;
      elements_.gauss.push_back(point);
      gauss_places_.push_back({at.X, at.Y});
    }
  }
}

double Specimen::area() const {
  double sum = 0;
  for (const auto& point : elements_.gauss) sum += point.weight;
  return sum;
}

double Specimen::gap(std::size_t side, const std::vector<Vector>& points) const {
  const std::size_t axis = axis_of(side);
  const double end = outwards(side) > 0 ? high_[axis] : low_[axis];
  double nearest = 1e300;
  for (const Vector& point : points) nearest = std::min(nearest, std::abs(point[axis] - end));
  return nearest;
}

std::optional<Place> Specimen::find(Vector point) const {
  std::optional<Place> best;
  double best_outside = allowance;
  for (std::size_t e = 0; e < boxes_.size(); ++e) {
    const auto& box = boxes_[e];
    if (point[0] < box[0] || point[0] > box[1] || point[1] < box[2] || point[1] > box[3]) continue;
    const auto& triangle = mesh_.triangles[e];
    double s = 1.0 / 3, t = 1.0 / 3;
    for (int iteration = 0; iteration < 20; ++iteration) {
      const Mapped at(mesh_, triangle, s, t);
      const double X = at.X - point[0], Y = at.Y - point[1];
      const double step_s = -(X * at.Yt - Y * at.Xt) / at.det(), step_t = -(Y * at.Xs - X * at.Ys) / at.det();
      s += step_s;
      t += step_t;
      if (!(std::abs(s) + std::abs(t) < 10)) break;
      if (std::abs(step_s) + std::abs(step_t) > 1e-12) continue;
      const double outside = std::max({-s, -t, s + t - 1, 0.0});
      if (outside >= best_outside && outside > 0) break;
      const Mapped found(mesh_, triangle, s, t);
      const Place place{triangle, found.N};
      if (outside <= 1e-9) return place;
      best = place;
      best_outside = outside;
      break;
    }
  }
  return best;
}

}  // namespace tunica::field
