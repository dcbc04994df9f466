// SPDX-License-Identifier: Apache-2.0
#include "shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tunica::plane {
namespace {

/// Elements over a rectangle of (2 columns + 1) × (2 rows + 1) nodes, the first index running along a row. With
/// `closed`, the last column of nodes is the first one.
void connect(Mesh& mesh, std::size_t columns, std::size_t rows, bool closed) {
  const std::size_t wide = closed ? 2 * columns : 2 * columns + 1;
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      std::array<std::size_t, 9> element;
      for (std::size_t b = 0; b < 3; ++b)
        for (std::size_t a = 0; a < 3; ++a) element[3 * b + a] = (2 * j + b) * wide + (2 * i + a) % wide;
      mesh.elements.push_back(element);
    }
}

/// Places of 2 count + 1 nodes from 0 to the end of the last stretch; every stretch begins with a node between
/// elements.
std::vector<double> places(const std::vector<double>& ends, std::size_t count) {
  std::vector<double> at{0};
  double begin = 0;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const double share = (ends[k] - begin) / ends.back();
    const auto elements =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(share * static_cast<double>(count))));
    for (std::size_t i = 1; i <= 2 * elements; ++i)
      at.push_back(begin + (ends[k] - begin) * static_cast<double>(i) / static_cast<double>(2 * elements));
    begin = ends[k];
  }
  return at;
}

/// Strips and dog-bones: straight columns of nodes across the width.
Mesh profile(const Shape& shape, std::size_t along, std::size_t across, bool quarter) {
  const double end = shape.length / 2;
  std::vector<double> ends{end};
  if (shape.kind == Shape::Kind::dog_bone) {
    const double rise = (shape.width - shape.gauge_width) / 2,
                 arc = std::sqrt(std::max(0.0, rise * (2 * shape.fillet - rise)));
    ends = {shape.gauge_section / 2};
    if (const double foot = ends[0] + arc; foot < end * (1 - 1e-9)) ends.push_back(foot);
    ends.push_back(end);
  }
  std::vector<double> x = places(ends, std::max<std::size_t>(1, (along + 1) / 2));
  if (!quarter) {
    std::vector<double> both;
    for (std::size_t i = x.size(); i-- > 1;) both.push_back(-x[i]);
    both.insert(both.end(), x.begin(), x.end());
    x = std::move(both);
  }
  const std::size_t rows = quarter ? std::max<std::size_t>(1, (across + 1) / 2) : across;
  Mesh mesh;
  mesh.quarter = quarter;
  for (std::size_t j = 0; j <= 2 * rows; ++j)
    for (const double at : x) {
      const double share = static_cast<double>(j) / static_cast<double>(2 * rows);
      mesh.nodes.push_back({at, shape.half_width(at) * (quarter ? share : 2 * share - 1)});
    }
  connect(mesh, (x.size() - 1) / 2, rows, false);
  return mesh;
}

/// Around the hole: rays from its edge to the outline. One ray meets the corner of each quarter; elements grow
/// outwards.
Mesh ring(const Shape& shape, std::size_t along, std::size_t across, bool quarter) {
  const double l = shape.length / 2, w = shape.width / 2, corner = std::atan2(w, l);
  const std::size_t columns = std::max<std::size_t>(2, along), rows = std::max<std::size_t>(1, across);
  const auto before = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::lround(static_cast<double>(columns) * w / (w + l))), 1, columns - 1);
  std::vector<Vector> outline;  // over the first quarter
  for (std::size_t i = 0; i <= 2 * before; ++i)
    outline.push_back({l, w * static_cast<double>(i) / static_cast<double>(2 * before)});
  const std::size_t after = columns - before;
  for (std::size_t i = 1; i <= 2 * after; ++i)
    outline.push_back({l * (1 - static_cast<double>(i) / static_cast<double>(2 * after)), w});
  std::vector<double> angles;
  for (std::size_t i = 0; i <= 2 * columns; ++i)
    angles.push_back(i <= 2 * before ? corner * static_cast<double>(i) / static_cast<double>(2 * before)
                                     : corner + (std::numbers::pi / 2 - corner) * static_cast<double>(i - 2 * before) /
                                                    static_cast<double>(2 * after));
  Mesh mesh;
  mesh.quarter = quarter;
  const std::size_t wide = quarter ? 2 * columns + 1 : 8 * columns;
  for (std::size_t j = 0; j <= 2 * rows; ++j)
    for (std::size_t i = 0; i < wide; ++i) {
      const std::size_t turn = i / (2 * columns),
                        place = turn % 2 == 0 ? i % (2 * columns) : 2 * columns - i % (2 * columns);
      const std::size_t at = quarter ? i : place;
      const double sx = quarter || turn == 0 || turn == 3 ? 1 : -1, sy = quarter || turn < 2 ? 1 : -1;
      const double t = static_cast<double>(j) / static_cast<double>(2 * rows), out = t * (0.35 + 0.65 * t);
      const Vector inner{shape.hole * std::cos(angles[at]), shape.hole * std::sin(angles[at])};
      mesh.nodes.push_back(
          {sx * (inner[0] + out * (outline[at][0] - inner[0])), sy * (inner[1] + out * (outline[at][1] - inner[1]))});
    }
  connect(mesh, quarter ? columns : 4 * columns, rows, !quarter);
  return mesh;
}

}  // namespace

double Shape::half_width(double x) const {
  if (kind != Kind::dog_bone) return width / 2;
  const double beyond = std::abs(x) - gauge_section / 2;
  if (beyond <= 0) return gauge_width / 2;
  if (beyond >= fillet) return width / 2;
  return std::min(width / 2, gauge_width / 2 + fillet - std::sqrt(fillet * fillet - beyond * beyond));
}

Mesh mesh_of(const Shape& shape, std::size_t along, std::size_t across, bool quarter) {
  return shape.kind == Shape::Kind::with_a_hole ? ring(shape, along, across, quarter)
                                                : profile(shape, along, across, quarter);
}

}  // namespace tunica::plane
