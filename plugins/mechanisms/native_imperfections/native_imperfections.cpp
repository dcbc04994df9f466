// SPDX-License-Identifier: Apache-2.0
// Mechanisms that tests simulate themselves, as parameters of their own that rest at a null: the geometry of a tube and
// how a strip was cut. The parameters are declared as the tests declare them.
#include <utility>

#include "of_fields.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

using Side = MechanismFactory::Side;

const std::vector<std::string> tubes{"thick_wall_pressurisation", "fe_pressurisation"};
const std::vector<std::string> tubes_and_twisted{"thick_wall_pressurisation", "fe_pressurisation", "torsion"};

MechanismFactory residual_stress() {
  return {.id = "residual_stress",
          .cause = "The unloaded wall is not free of stress: a ring of it opens when it is cut.",
          .stage = tunica::Stage::test,
          .applies_to = tubes,
          .parameters = {{"opening_angle", "deg", 0, -90, 330, Scale::linear,
                          "The whole missing arc of the stress-free sector (twice Fung's angle).",
                          "Chuong, Fung, J. Biomech. Eng. 108:189 (1986)"}},
          .null = 0,
          .side = Side::both,
          .plausible_min = -60,
          .plausible_max = 300,
          .look_alikes = {"pressure_scale_error", "layered_wall", "pressure_offset"},
          .isolated_by = "the opening angle of a ring that is cut",
          .reference = "Chuong, Fung, J. Biomech. Eng. 108:189 (1986)",
          .origin = MechanismFactory::Origin::material,
          .native = "opening_angle",
          .shared = true};
}

MechanismFactory axial_stretch_error() {
  return {.id = "axial_stretch_error",
          .cause = "The tube was stretched more, or less, along its axis than was recorded.",
          .stage = tunica::Stage::test,
          .applies_to = tubes_and_twisted,
          .parameters = {{"value", "1", 0, -0.2, 0.2, Scale::linear, "True axial stretch minus the recorded one.", ""}},
          .null = 0,
          .side = Side::both,
          .plausible_min = -0.1,
          .plausible_max = 0.1,
          .look_alikes = {"axial_force_scale_error", "axial_force_offset", "geometry_error"},
          .isolated_by = "markers on the wall, or the same test at a second axial stretch",
          .reference = "van Loon, Klip, Bradley, Biorheology 14:181 (1977)",
          .native = "axial_stretch_error",
          .shared = true};
}

MechanismFactory tethering() {
  return {.id = "tethering",
          .cause = "Tissue around the tube supports it from outside as it widens.",
          .stage = tunica::Stage::test,
          .applies_to = tubes,
          .parameters = {{"stiffness", "kPa", 0, 0, 100, Scale::linear,
                          "Pressure from outside per outer diameter stretch gained since zero pressure.", ""}},
          .null = 0,
          .side = Side::positive,
          .plausible_min = 0,
          .plausible_max = 40,
          .look_alikes = {"pressure_scale_error", "layered_wall", "residual_stress"},
          .isolated_by = "the same test with the surrounding tissue taken off",
          .reference = "Liu, Dang, Garcia, Gregersen, Kassab, Am. J. Physiol. Heart 293:H3290 (2007)",
          .origin = MechanismFactory::Origin::material,
          .native = "tethering",
          .shared = true};
}

MechanismFactory layered_wall() {
  return {.id = "layered_wall",
          .cause = "The inner part of the wall is stiffer, or softer, than the outer part.",
          .stage = tunica::Stage::test,
          .applies_to = tubes,
          .parameters = {{"ratio", "1", 1, 0.1, 10, Scale::log,
                          "Stiffness of the inner layer over that of the outer one, their mean being kept.",
                          "Holzapfel, Gasser, Ogden, J. Elasticity 61:1 (2000)"}},
          .null = 1,
          .side = Side::both,
          .plausible_min = 0.1,
          .plausible_max = 10,
          .look_alikes = {"residual_stress", "pressure_scale_error", "axial_force_scale_error"},
          .isolated_by = "strips of the separated layers",
          .reference = "Holzapfel, Gasser, Ogden, J. Elasticity 61:1 (2000)",
          .origin = MechanismFactory::Origin::material,
          .options = {Option::number(
              "layer_interface", 0.5, {0.05, 0.95},
              "Where the layers meet: fraction of the thickness from inside. It takes the place of the "
              "test's own.")},
          .native = "layer_ratio",
          .shared = true,
          .scan = {{{"layer_interface", 0.5}}, {{"layer_interface", 2. / 3}}}};
}

MechanismFactory geometry_error() {
  return {
      .id = "geometry_error",
      .cause = "The wall is thicker, or thinner, than was measured; its outer radius is right.",
      .stage = tunica::Stage::test,
      .applies_to = tubes_and_twisted,
      .parameters = {{"gain", "1", 0, -0.5, 0.5, Scale::linear, "True over measured wall thickness, less one.", ""}},
      .null = 0,
      .side = Side::both,
      .plausible_min = -0.3,
      .plausible_max = 0.3,
      .look_alikes = {"axial_stretch_error", "axial_force_offset", "axial_force_scale_error"},
      .isolated_by = "a second measurement of the thickness, by microscopy of the section",
      .reference = "O'Leary, Doyle, McGloughlin, J. Biomech. 46:1955 (2013)",
      .native = "thickness_error",
      .shared = true};
}

MechanismFactory specimen_misalignment() {
  return {.id = "specimen_misalignment",
          .cause = "The strip was cut, or clamped, at an angle to the axis that it is named after.",
          .stage = tunica::Stage::test,
          .applies_to = {"uniaxial"},
          .parameters = {{"angle", "deg", 0, -15, 15, Scale::linear,
                          "Between the pulled direction and the nominal material axis.", ""}},
          .null = 0,
          .side = Side::even,
          .plausible_min = -10,
          .plausible_max = 10,
          .look_alikes = {"force_scale_error", "reference_length_error", "circumferential_fibres"},
          .isolated_by = "imaging of the fibre directions, or shear strains in the middle of the strip",
          .reference = "Pagano, Halpin, J. Compos. Mater. 2:18 (1968)",
          .directional = true,
          .native = "misalignment"};
}

}  // namespace

TUNICA_PLUGIN("native_imperfections", TUNICA_PLUGIN_VERSION) {
  for (auto* const factory :
       {residual_stress, axial_stretch_error, tethering, layered_wall, geometry_error, specimen_misalignment})
    registry.add(factory());
  for (MechanismFactory& factory : tunica::native::of_fields()) registry.add(std::move(factory));
}
