// SPDX-License-Identifier: Apache-2.0
#include "tube.hpp"

namespace tunica::thick_wall {
std::vector<Parameter> own_parameters() {
  return {{"opening_angle", "deg", 0, -90, 330, Scale::linear,
           "Residual stress: the whole missing arc of the stress-free sector (twice Fung's angle).",
           "Chuong, Fung, J. Biomech. Eng. 108:189 (1986)"},
          axial_stretch_error_parameter(),
          {"tethering", "kPa", 0, 0, 100, Scale::linear,
           "Support from outside: pressure per outer diameter stretch gained since zero pressure.", ""},
          thickness_error_parameter(),
          {"layer_ratio", "1", 1, 0.1, 10, Scale::log,
           "Stiffness of the inner layer over that of the outer one, their mean over the thickness being kept.", ""}};
}

std::vector<double> own_nulls() { return {0, 0, 0, 0, 1}; }

Tube bind(const TestSetup& setup) {
  Tube tube{TubeRows(setup, "thick_wall_pressurisation"), 0.5, false, 0};
  tube.layer_interface = setup.options.number("layer_interface");
  tube.same_thickness = setup.options.text("sector") == "same_thickness";
  tube.gauss_points = static_cast<std::size_t>(setup.options.integer("gauss_points"));
  if (tube.gauss_points == 1)
    throw InputError(
        "thick_wall_pressurisation: \"gauss_points\" is 1, which integrates nothing well; give 2 or more, "
        "or 0 to have the number chosen");
  return tube;
}

}  // namespace tunica::thick_wall
