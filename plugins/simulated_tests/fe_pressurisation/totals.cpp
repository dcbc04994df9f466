// SPDX-License-Identifier: Apache-2.0
#include "totals.hpp"

namespace tunica::fe {

void total_derivatives(const Sample& sample, const thick_wall::Wall& wall, const thick_wall::SectorDerivative& sector,
                       std::size_t model_parameters, std::vector<Observed>& totals) {
  totals.assign(model_parameters + (wall.layered ? thick_wall::layer_ratio : thick_wall::own_count), {});
  const auto add = [&](std::size_t total, double factor, std::size_t direction) {
    if (factor == 0) return;
    for (std::size_t c = 0; c < 3; ++c) totals[total][c] += factor * sample.by[direction][c];
  };
  for (std::size_t j = 0; j < model_parameters; ++j) {
    add(j, 1, j);
    add(j, sector.by_parameter[j], model_parameters + along_sector);
  }
  const std::size_t by = model_parameters;
  add(by + thick_wall::opening_angle, wall.closing_by_angle, by + along_closing);
  add(by + thick_wall::opening_angle, sector.by_closing * wall.closing_by_angle, by + along_sector);
  add(by + thick_wall::axial_stretch_error, 1, by + along_stretch);
  add(by + thick_wall::tethering, 1 / wall.Ro, by + along_support);
  // Sampled is by the relative change of the true thickness: V' = 2 Ri (Ro − Ri).
  const double relative = wall.area_by_error / (2 * wall.Ri * (wall.Ro - wall.Ri));
  add(by + thick_wall::thickness_error, relative, by + along_thickness);
  add(by + thick_wall::thickness_error, sector.by_area * wall.area_by_error, by + along_sector);
  if (wall.layered) return;
  add(by + thick_wall::layer_ratio, 1, by + along_ratio);
  add(by + thick_wall::layer_ratio, sector.by_ratio, by + along_sector);
}

}  // namespace tunica::fe
