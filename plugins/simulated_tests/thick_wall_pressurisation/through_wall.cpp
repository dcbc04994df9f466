// SPDX-License-Identifier: Apache-2.0
#include "through_wall.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sector.hpp"

namespace tunica::thick_wall {
namespace {

constexpr int points_across = 34;  ///< in each layer

constexpr std::array<std::pair<const char*, const char*>, 8> columns{{{"unloaded_radius", "mm"},
                                                                      {"radius", "mm"},
                                                                      {"circumferential_stretch", "1"},
                                                                      {"axial_stretch", "1"},
                                                                      {"radial_stretch", "1"},
                                                                      {"circumferential_stress", "kPa"},
                                                                      {"axial_stress", "kPa"},
                                                                      {"radial_stress", "kPa"}}};

Snapshot table_of(const Sections& sections, std::size_t i, const Wall& wall, const Row& row) {
  const double y = row.y + row.step, lz = row.axial_stretch;
  const double outside = row.support_free > 0 ? support(wall, y, lz, row.support_free) : 0;
  const double sector2 = std::exp(2 * wall.iota), ri2 = std::exp(2 * y);
  const auto points = sections.across(i);
  Snapshot snapshot;
  for (const auto& [name, unit] : columns) snapshot.section.push_back({name, unit, std::vector<double>(points.size())});
  double further_out = 0;
  for (std::size_t k = points.size(); k-- > 0;) {
    const auto& at = points[k];
    const double area = (at.R2 - sector2) / wall.K;  // of the closed wall inside of the point, over π
    const double radial = -outside - further_out - 0.5 * at.share, ct = std::sqrt(at.c);
    const std::array<double, columns.size()> values{std::sqrt(wall.Ri * wall.Ri + area),
                                                    std::sqrt(ri2 + area / lz),
                                                    ct,
                                                    lz,
                                                    1 / (ct * lz),
                                                    radial + at.T,
                                                    radial + at.Z,
                                                    radial};
    for (std::size_t c = 0; c < columns.size(); ++c) snapshot.section[c].values[k] = values[c];
    further_out += at.share;
  }
  return snapshot;
}

}  // namespace

Status through_wall(const Tube& tube, const TestInput& input, std::span<const std::size_t> rows,
                    std::vector<Snapshot>& found) {
  std::vector<double> pressure, axial_stretch;
  if (Status status = prescribed(tube, input, pressure, axial_stretch); !status.ok()) return status;
  const Rule rule(points_across);
  const Layers layers(input);
  Wall wall(tube, input.test_parameters);
  Sections sections;
  Solution solution;
  constexpr double any_error = std::numeric_limits<double>::infinity();
  if (Status status = close_sector(tube, layers, rule, sections, wall, nullptr); !status.ok()) return status;
  sections.begin(layers, wall, rule);
  if (Status status = solve_rows(pressure, axial_stretch, false, sections, wall, any_error, solution); !status.ok())
    return status;
  if (Status status = evaluate_rows(solution.rows, {}, sections, wall); !status.ok()) return status;
  for (const std::size_t row : rows) {
    found.push_back(table_of(sections, row, wall, solution.rows[row]));
    found.back().row = row;
  }
  return {};
}

}  // namespace tunica::thick_wall
