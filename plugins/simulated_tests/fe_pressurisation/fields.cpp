// SPDX-License-Identifier: Apache-2.0
#include "fields.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::fe {
namespace {

struct Quantity {
  const char* name;
  const char* unit;
};
constexpr std::array<Quantity, 10> quantities{{{"circumferential_stretch", "1"},
                                               {"axial_stretch", "1"},
                                               {"radial_stretch", "1"},
                                               {"circumferential_stress", "kPa"},
                                               {"axial_stress", "kPa"},
                                               {"radial_stress", "kPa"},
                                               {"shear_stress", "kPa"},
                                               {"pressure", "kPa"},
                                               {"volume_ratio", "1"},
                                               {"fibre_stretch", "1"}}};
using Values = std::array<double, quantities.size()>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The angle of the first family of fibres from the axis, in radians; NaN where there is none.
double fibre_angle(const Model& model, std::span<const double> parameters) {
  for (const auto& part : model.parts()) {
    if (part->describe().role != EnergyPart::Role::fibre) continue;
    Invariant x;
    part->invariant(parameters, x, {});
    return x.angle;
  }
  return none;
}

/// By column of elements; empty where a layer has no fibres.
std::vector<double> angles_of(const Mesh& mesh, const TestInput& input) {
  std::vector<double> angles;
  std::size_t first = 0;
  for (std::size_t layer = 0; layer < mesh.columns.size(); ++layer) {
    const Model& model = input.layers.empty() ? input.model : *input.layers[layer];
    const std::size_t count = model.describe().parameters.size();
    const double angle = fibre_angle(model, input.model_parameters.subspan(first, count));
    if (!std::isfinite(angle)) return {};
    angles.insert(angles.end(), mesh.columns[layer], angle);
    first += count;
  }
  return angles;
}

/// Stretches are those of the line elements that lay along t, z and r in the stress-free state.
Values values_of(const Point& at, double angle) {
  const auto [f0, f1, f2, f3, f4] = at.f;
  const auto [rr, zz, tt, rz] = at.stress();
  const double s = std::sin(angle), c = std::cos(angle), cz = f1 * f1 + f3 * f3, t = f4 * at.closing;
  return {t,
          std::sqrt(cz),
          std::sqrt(f0 * f0 + f2 * f2) / at.closing,
          tt,
          zz,
          rr,
          rz,
          at.q,
          f4 * (f0 * f3 - f1 * f2),
          std::sqrt(t * t * s * s + cz * c * c)};
}

Snapshot snapshot_of(const Mesh& mesh, const State& state, const std::vector<Point>& points,
                     const std::vector<double>& angles) {
  Snapshot snapshot;
  Snapshot::Field moved{"displacement", "mm", 3, false, {}};
  for (std::size_t k = 0; k < mesh.planes(); ++k)
    for (std::size_t i = 0; i < mesh.across(); ++i) {
      const double r = state.x[2 * mesh.node(i, k)], z = state.x[2 * mesh.node(i, k) + 1];
      snapshot.points.insert(snapshot.points.end(), {r, z, 0});
      moved.values.insert(moved.values.end(), {r - mesh.radius(i), z - mesh.layer[k], 0});
    }
  snapshot.fields.push_back(std::move(moved));
  const std::size_t families = angles.empty() ? quantities.size() - 1 : quantities.size();
  const auto angle_at = [&](const Point& point) { return angles.empty() ? none : angles[point.column]; };
  for (std::size_t q = 0; q < families; ++q)
    snapshot.fields.push_back({quantities[q].name, quantities[q].unit, 1, true, {}});

  const std::size_t each = points.size() / (mesh.radial * mesh.axial);
  for (std::size_t k = 0; k + 1 < mesh.planes(); ++k)
    for (std::size_t i = 0; i + 1 < mesh.across(); ++i) {
      for (const std::size_t node :
           {mesh.node(i, k), mesh.node(i + 1, k), mesh.node(i + 1, k + 1), mesh.node(i, k + 1)})
        snapshot.cells.push_back(node);
      Values mean{};
      const std::size_t element = k / mesh.order * mesh.radial + i / mesh.order;
      for (std::size_t g = 0; g < each; ++g) {
        const Values at = values_of(points[element * each + g], angle_at(points[element * each + g]));
        for (std::size_t q = 0; q < families; ++q) mean[q] += at[q] / static_cast<double>(each);
      }
      for (std::size_t q = 0; q < families; ++q) snapshot.fields[1 + q].values.push_back(mean[q]);
    }

  // The Gauss points nearest to mid-length, from inside.
  const double lowest = std::ranges::min_element(points, {}, &Point::Z)->Z;
  std::vector<const Point*> section;
  for (const Point& point : points)
    if (point.Z == lowest) section.push_back(&point);
  std::ranges::sort(section, {}, [](const Point* point) { return point->R; });
  snapshot.section = {{"unloaded_radius", "mm", {}}, {"radius", "mm", {}}};
  for (std::size_t q = 0; q < families; ++q) snapshot.section.push_back({quantities[q].name, quantities[q].unit, {}});
  for (const Point* point : section) {
    const Values at = values_of(*point, angle_at(*point));
    snapshot.section[0].values.push_back(point->R);
    snapshot.section[1].values.push_back(point->R * point->f[4]);
    for (std::size_t q = 0; q < families; ++q) snapshot.section[2 + q].values.push_back(at[q]);
  }
  return snapshot;
}

}  // namespace

Status snapshots_of(const Tube& tube, const TestInput& input, const Material& material, std::span<const Load> loads,
                    std::span<const std::size_t> rows, std::vector<Snapshot>& found) {
  const std::vector<double> angles = angles_of(mesh_of(tube), input);
  Simulation simulation(tube);
  std::vector<Sample> samples;
  std::vector<Point> points;
  for (const std::size_t row : rows) {
    std::size_t failed_at = 0;
    const std::array<Load, 1> load{loads[row]};
    if (Status status = simulation.run(material, load, {}, samples, failed_at); !status.ok()) return status;
    if (Status status = simulation.solver().assembly().points(material, simulation.last(), points); !status.ok())
      return status;
    found.push_back(snapshot_of(simulation.solver().mesh(), simulation.last(), points, angles));
    found.back().row = row;
  }
  return {};
}

}  // namespace tunica::fe
