// SPDX-License-Identifier: Apache-2.0
#include "mesh.hpp"

#include <algorithm>
#include <map>

namespace tunica::field {
namespace {

double twice_area(const Vector& a, const Vector& b, const Vector& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

/// Gives every edge one node in its middle.
class Middles {
 public:
  explicit Middles(std::vector<Vector>& nodes) : nodes_(nodes) {}
  std::size_t of(std::size_t a, std::size_t b) {
    const auto [found, is_new] = known_.try_emplace(std::minmax(a, b), nodes_.size());
    if (is_new) nodes_.push_back({0.5 * (nodes_[a][0] + nodes_[b][0]), 0.5 * (nodes_[a][1] + nodes_[b][1])});
    return found->second;
  }

 private:
  std::vector<Vector>& nodes_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> known_;
};

}  // namespace

Mesh with_middles(const std::vector<Vector>& nodes, const std::vector<std::array<std::size_t, 3>>& triangles) {
  Mesh mesh;
  std::map<std::size_t, std::size_t> used;
  for (const auto& triangle : triangles)
    for (const std::size_t node : triangle)
      if (used.try_emplace(node, mesh.nodes.size()).second) mesh.nodes.push_back(nodes[node]);
  Middles middles(mesh.nodes);
  for (const auto& triangle : triangles) {
    std::size_t a = used.at(triangle[0]), b = used.at(triangle[1]), c = used.at(triangle[2]);
    if (twice_area(mesh.nodes[a], mesh.nodes[b], mesh.nodes[c]) < 0) std::swap(b, c);
    mesh.triangles.push_back({a, b, c, middles.of(a, b), middles.of(b, c), middles.of(c, a)});
  }
  return mesh;
}

Mesh refined(const Mesh& mesh) {
  Mesh fine;
  fine.nodes = mesh.nodes;
  // The middle of half an edge lies on the parabola of the edge: (3 a + 6 m − b)/8.
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> halves;
  const auto half = [&](std::size_t a, std::size_t m, std::size_t b) {
    const auto [found, is_new] = halves.try_emplace(std::minmax(a, m), fine.nodes.size());
    if (is_new) {
      const auto& n = mesh.nodes;
      fine.nodes.push_back({(3 * n[a][0] + 6 * n[m][0] - n[b][0]) / 8, (3 * n[a][1] + 6 * n[m][1] - n[b][1]) / 8});
    }
    return found->second;
  };
  for (const auto& [a, b, c, ab, bc, ca] : mesh.triangles) {
    const auto inner = [&](std::size_t m, std::size_t n) {
      fine.nodes.push_back({0.5 * (fine.nodes[m][0] + fine.nodes[n][0]), 0.5 * (fine.nodes[m][1] + fine.nodes[n][1])});
      return fine.nodes.size() - 1;
    };
    const std::size_t at_a = inner(ab, ca), at_b = inner(ab, bc), at_c = inner(bc, ca);
    fine.triangles.push_back({a, ab, ca, half(a, ab, b), at_a, half(a, ca, c)});
    fine.triangles.push_back({ab, b, bc, half(b, ab, a), half(b, bc, c), at_b});
    fine.triangles.push_back({ca, bc, c, at_c, half(c, bc, b), half(c, ca, a)});
    fine.triangles.push_back({ab, bc, ca, at_b, at_c, at_a});
  }
  return fine;
}

}  // namespace tunica::field
