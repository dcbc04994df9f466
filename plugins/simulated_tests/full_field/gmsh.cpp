// SPDX-License-Identifier: Apache-2.0
// Meshes by Gmsh (Geuzaine, Remacle, Int. J. Numer. Meth. Eng. 79:1309, 2009). The library takes a tenth of a second to
// load, so it is opened where a mesh is asked for and not when the plugin is.
#include <filesystem>
#include <map>
#include <mutex>

#include <dlfcn.h>
#include <fmt/format.h>
#include <gmshc.h>

#include "mesh.hpp"
#include "tunica/error.hpp"

namespace tunica::field {
namespace {

/// The library and, where it is not there, why.
const std::pair<void*, std::string>& library() {
  static const std::pair<void*, std::string> opened = [] {
    void* const found = dlopen(TUNICA_GMSH_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    return std::pair(found, std::string(found == nullptr ? dlerror() : ""));
  }();
  return opened;
}

template <class Function>
Function* symbol(const char* name) {
  if (library().first == nullptr)
    throw InputError(
        fmt::format("full_field: the library of Gmsh, {}, cannot be opened ({}); install it (Debian: libgmsh4.8)",
                    TUNICA_GMSH_LIBRARY, library().second));
  auto* const found = reinterpret_cast<Function*>(dlsym(library().first, name));
  if (found == nullptr)
    throw InputError(fmt::format("full_field: {} has no function {}; install Gmsh 4.8", TUNICA_GMSH_LIBRARY, name));
  return found;
}

/// What Gmsh itself says of its last fault.
std::string last_error() {
  char* text = nullptr;
  int failed = 0;
  symbol<decltype(gmshLoggerGetLastError)>("gmshLoggerGetLastError")(&text, &failed);
  const std::string words = failed == 0 && text != nullptr ? text : "it does not say what";
  if (text != nullptr) symbol<decltype(gmshFree)>("gmshFree")(text);
  return words;
}

/// Calls a function of Gmsh; its own fault becomes an exception.
#define TUNICA_GMSH(function, ...)                                                                          \
  do {                                                                                                      \
    int failed = 0;                                                                                         \
    symbol<decltype(function)>(#function)(__VA_ARGS__ __VA_OPT__(, ) & failed);                             \
    if (failed != 0)                                                                                        \
      throw InputError(                                                                                     \
          fmt::format("full_field: Gmsh could not mesh: {}; correct \"mesh\" or \"shape\"", last_error())); \
  } while (false)

/// Gmsh has one state for the whole process.
class Session {
 public:
  Session() : lock_(mutex()) {
    TUNICA_GMSH(gmshInitialize, 0, nullptr, 0);
    TUNICA_GMSH(gmshOptionSetNumber, "General.Terminal", 0);
    TUNICA_GMSH(gmshOptionSetNumber, "General.NumThreads", 1);
  }
  ~Session() {
    int failed = 0;
    symbol<decltype(gmshFinalize)>("gmshFinalize")(&failed);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  std::lock_guard<std::mutex> lock_;
};

/// Memory that Gmsh allocates.
template <class T>
struct Array {
  T* values = nullptr;
  std::size_t size = 0;
  Array() = default;
  ~Array() { symbol<decltype(gmshFree)>("gmshFree")(values); }
  Array(const Array&) = delete;
  Array& operator=(const Array&) = delete;
};

constexpr int triangle_3 = 2, triangle_6 = 9;
constexpr double around_a_hole = 32;  ///< triangles at least

Mesh current_mesh(double factor, const std::string& source) {
  Array<std::size_t> tags, element_tags, element_nodes;
  Array<double> places, parametric;
  TUNICA_GMSH(gmshModelMeshGetNodes, &tags.values, &tags.size, &places.values, &places.size, &parametric.values,
              &parametric.size, -1, -1, 0, 0);
  std::map<std::size_t, std::size_t> number;
  std::vector<Vector> nodes;
  for (std::size_t k = 0; k < tags.size; ++k) {
    number[tags.values[k]] = nodes.size();
    nodes.push_back({factor * places.values[3 * k], factor * places.values[3 * k + 1]});
  }
  Array<int> types;
  TUNICA_GMSH(gmshModelMeshGetElementTypes, &types.values, &types.size, 2, -1);
  if (types.size == 0)
    throw InputError(
        fmt::format("full_field: {} has no elements in a plane; give a mesh of triangles in x and y", source));
  if (types.size > 1 || (types.values[0] != triangle_3 && types.values[0] != triangle_6))
    throw InputError(fmt::format(
        "full_field: {} has other elements than triangles of three or six nodes; give a mesh of one of them", source));
  const std::size_t count = types.values[0] == triangle_3 ? 3 : 6;
  TUNICA_GMSH(gmshModelMeshGetElementsByType, types.values[0], &element_tags.values, &element_tags.size,
              &element_nodes.values, &element_nodes.size, -1, 0, 1);
  std::vector<std::array<std::size_t, 3>> corners;
  Mesh mesh;
  mesh.nodes = nodes;
  for (std::size_t at = 0; at + count <= element_nodes.size; at += count) {
    std::array<std::size_t, 6> triangle{};
    for (std::size_t a = 0; a < count; ++a) triangle[a] = number.at(element_nodes.values[at + a]);
    corners.push_back({triangle[0], triangle[1], triangle[2]});
    mesh.triangles.push_back(triangle);
  }
  if (count == 3) return with_middles(nodes, corners);
  // Nodes that no triangle has, such as a centre of an arc, are left out.
  std::map<std::size_t, std::size_t> used;
  Mesh kept;
  for (auto triangle : mesh.triangles) {
    for (std::size_t& node : triangle) {
      const auto [found, is_new] = used.try_emplace(node, kept.nodes.size());
      if (is_new) kept.nodes.push_back(nodes[node]);
      node = found->second;
    }
    const Vector &a = kept.nodes[triangle[0]], &b = kept.nodes[triangle[1]], &c = kept.nodes[triangle[2]];
    if ((b[0] - a[0]) * (c[1] - a[1]) < (c[0] - a[0]) * (b[1] - a[1])) {
      std::swap(triangle[1], triangle[2]);
      std::swap(triangle[3], triangle[5]);
    }
    kept.triangles.push_back(triangle);
  }
  return kept;
}

}  // namespace

Mesh mesh_from_file(const std::string& file, double factor) {
  if (!std::filesystem::is_regular_file(file))
    throw InputError(fmt::format("full_field: the mesh file {} does not exist; correct \"mesh\"", file));
  const Session session;
  TUNICA_GMSH(gmshOpen, file.c_str());
  return current_mesh(factor, file);
}

Mesh mesh_of(const Outline& outline, double size) {
  const Session session;
  TUNICA_GMSH(gmshModelAdd, "specimen");
  int tag = 0;
  {
    int failed = 0;
    tag = symbol<decltype(gmshModelOccAddRectangle)>("gmshModelOccAddRectangle")(
        outline.corner[0], outline.corner[1], 0, outline.size[0], outline.size[1], -1, 0, &failed);
    if (failed != 0) throw InputError("full_field: Gmsh cannot make the rectangle; check its size");
  }
  std::vector<int> body{2, tag}, holes;
  for (const Outline::Circle& hole : outline.holes) {
    int failed = 0;
    const int disk = symbol<decltype(gmshModelOccAddDisk)>("gmshModelOccAddDisk")(
        hole.centre[0], hole.centre[1], 0, hole.radius, hole.radius, -1, &failed);
    if (failed != 0) throw InputError("full_field: Gmsh cannot make a hole; check its radius");
    holes.insert(holes.end(), {2, disk});
  }
  if (!holes.empty()) {
    Array<int> left;
    int** map = nullptr;
    std::size_t* map_sizes = nullptr;
    std::size_t maps = 0;
    TUNICA_GMSH(gmshModelOccCut, body.data(), body.size(), holes.data(), holes.size(), &left.values, &left.size, &map,
                &map_sizes, &maps, -1, 1, 1);
    auto* const release = symbol<decltype(gmshFree)>("gmshFree");
    for (std::size_t k = 0; k < maps; ++k) release(map[k]);
    release(map);
    release(map_sizes);
    if (left.size == 0) throw InputError("full_field: the holes leave nothing of the rectangle; check their radii");
  }
  TUNICA_GMSH(gmshModelOccSynchronize);
  TUNICA_GMSH(gmshOptionSetNumber, "Mesh.MeshSizeMax", size);
  TUNICA_GMSH(gmshOptionSetNumber, "Mesh.MeshSizeFromCurvature", around_a_hole);
  TUNICA_GMSH(gmshOptionSetNumber, "Mesh.ElementOrder", 2);
  TUNICA_GMSH(gmshModelMeshGenerate, 2);
  return current_mesh(1, "the mesh of the shape");
}

}  // namespace tunica::field
