// SPDX-License-Identifier: Apache-2.0
#include "tube.hpp"

namespace tunica::thick_wall {

std::vector<Parameter> own_parameters(bool layered) {
  std::vector<Parameter> all = {
      {"opening_angle", "deg", 0, -90, 330, Scale::linear,
       "Residual stress: the whole missing arc of the stress-free sector (twice Fung's angle).",
       "Chuong, Fung, J. Biomech. Eng. 108:189 (1986)"},
      axial_stretch_error_parameter(),
      {"tethering", "kPa", 0, 0, 100, Scale::linear,
       "Support from outside: pressure per outer diameter stretch gained since zero pressure.", ""},
      thickness_error_parameter(),
      {"layer_ratio", "1", 1, 0.1, 10, Scale::log,
       "Stiffness of the inner layer over that of the outer one, their mean over the thickness being kept.", ""}};
  if (layered) all.pop_back();
  return all;
}

std::vector<double> own_nulls(bool layered) {
  return layered ? std::vector<double>{0, 0, 0, 0} : std::vector<double>{0, 0, 0, 0, 1};
}

Tube bind(const TestSetup& setup, const char* name) {
  Tube tube{TubeRows(setup, name), !setup.layers.empty(), {}, false, 0};
  const double interface = setup.options.number("layer_interface");
  if (tube.layered && interface != default_interface)
    throw InputError(tube.test +
                     ": \"layer_interface\" says where layer_ratio parts a wall of one model, and \"layers\" are given "
                     "too; leave one of them out");
  if (!tube.layered) tube.interfaces = {interface};
  double inside = 0;
  for (std::size_t k = 0; k + 1 < setup.layers.size(); ++k) {
    inside += setup.layers[k];
    tube.interfaces.push_back(inside / (tube.outer_radius - tube.inner_radius));
  }
  tube.same_thickness = setup.options.text("sector") == "same_thickness";
  return tube;
}

std::vector<Option> wall_options() {
  return {Option::choice(
              "sector", {"equilibrium", "same_thickness"}, "equilibrium",
              "What fixes the radius of the stress-free sector with an opening angle: that the unloaded tube is in "
              "equilibrium at its measured outer radius, or that the sector is as thick as the wall."),
          Option::number("layer_interface", default_interface, {0.05, 0.95},
                         "Where layer_ratio parts the wall of one model: fraction of the thickness from inside.")};
}

}  // namespace tunica::thick_wall
