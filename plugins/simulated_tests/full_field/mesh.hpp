// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "../plane_elements/elements.hpp"

namespace tunica::field {

using plane::Vector;

/// Triangles of six nodes, mm: the corners counter-clockwise, then the middles of edges 1–2, 2–3 and 3–1.
struct Mesh {
  std::vector<Vector> nodes;
  std::vector<std::array<std::size_t, 6>> triangles;
};

/// A rectangle from its lower left corner, less circles; mm.
struct Outline {
  struct Circle {
    Vector centre;
    double radius;
  };
  Vector corner{}, size{};
  std::vector<Circle> holes;
};

/// Six-node triangles from those of three nodes: an edge's middle is halfway. Nodes that no triangle uses are left
/// out, and triangles that run clockwise are turned.
Mesh with_middles(const std::vector<Vector>& nodes, const std::vector<std::array<std::size_t, 3>>& triangles);

/// Each triangle in four.
Mesh refined(const Mesh& mesh);

/// The mesh in a file that Gmsh reads (.msh, .inp, .unv, .vtk), its lengths times `factor`. Throws InputError.
Mesh mesh_from_file(const std::string& file, double factor);

/// Meshes an outline with triangles of edge length `size`, mm, smaller and with curved edges at holes. Throws
/// InputError.
Mesh mesh_of(const Outline& outline, double size);

}  // namespace tunica::field
