// SPDX-License-Identifier: Apache-2.0
#include "of_fields.hpp"

namespace tunica::native {
namespace {

using Side = MechanismFactory::Side;

const std::vector<std::string> fields{"full_field"};

/// Where a sheet is not even, and along what direction. The scan begins a search every 45°.
MechanismFactory uneven(std::string id, Parameter amplitude, double plausible, std::string to_where) {
  MechanismFactory mechanism{
      .id = id,
      .stage = Stage::test,
      .applies_to = fields,
      .parameters = {std::move(amplitude), {"direction", "deg", 0, -180, 180, Scale::linear, std::move(to_where), ""}},
      .null = 0,
      .side = Side::both,
      .plausible_min = -plausible,
      .plausible_max = plausible,
      .native = id,
      .scan = {{{"direction", 0}}, {{"direction", 45}}, {{"direction", 90}}, {{"direction", 135}}}};
  return mechanism;
}

/// Excised tissue differs by 10 to 30 % in thickness over a specimen of centimetres.
MechanismFactory thickness_gradient() {
  MechanismFactory mechanism =
      uneven("thickness_gradient",
             {"slope", "1", 0, -1, 1, Scale::linear,
              "How much thicker the specimen is at one end than at the other, over its thickness in the middle.", ""},
             0.4, "From x counter-clockwise to where it becomes thicker.");
  mechanism.cause = "The specimen is thicker towards one end than towards the other.";
  mechanism.look_alikes = {"stiffer_half", "grip_tilt"};
  mechanism.isolated_by = "the thickness measured at both ends";
  mechanism.reference = "O'Leary, Doyle, McGloughlin, J. Biomech. 46:1955 (2013)";
  return mechanism;
}

/// Regions of one vessel differ by a factor of up to three in stiffness.
MechanismFactory stiffer_half() {
  MechanismFactory mechanism = uneven("stiffer_half",
                                      {"contrast", "1", 0, -0.8, 0.8, Scale::linear,
                                       "Stiffness of one half less that of the other, over their sum.", ""},
                                      0.5, "From x counter-clockwise to the middle of that half.");
  mechanism.cause = "One half of the specimen is stiffer than the other.";
  mechanism.look_alikes = {"thickness_gradient", "grip_tilt"};
  mechanism.isolated_by = "a strip cut from each half";
  mechanism.reference = "Bersi, Bellini, Di Achille, Humphrey, Genovese, Avril, J. Biomech. Eng. 138:071005 (2016)";
  mechanism.origin = MechanismFactory::Origin::material;
  return mechanism;
}

/// A clamp that lets go of more than a fifth is seen to.
MechanismFactory clamp_slip() {
  return {.id = "clamp_slip",
          .cause = "The specimen slips out of the clamp that the file takes for still.",
          .stage = Stage::test,
          .applies_to = fields,
          .parameters = {{"share", "1", 0, 0, 0.5, Scale::linear,
                          "How far the specimen slips out, over how far the opposite side has moved.", ""}},
          .null = 0,
          .side = Side::positive,
          .plausible_min = 0,
          .plausible_max = 0.2,
          .look_alikes = {"thickness_gradient", "stiffer_half", "oblique_pull"},
          .isolated_by = "marks on the clamp and on the specimen at its edge",
          .reference = "Riemersma, Schamhardt, J. Biomech. 15:619 (1982)",
          .native = "clamp_slip"};
}

/// 0.2 turns a grip by 6° where a sheet as wide as long is pulled to twice its length; joints of a load train give
/// less.
MechanismFactory grip_tilt() {
  return {
      .id = "grip_tilt",
      .cause = "The grip turns in the plane of the specimen as it pulls.",
      .stage = Stage::test,
      .applies_to = fields,
      .parameters = {{"share", "1", 0, -0.5, 0.5, Scale::linear,
                      "How much farther its upper or right end moves than its middle, over how far that moves.", ""}},
      .null = 0,
      .side = Side::both,
      .plausible_min = -0.2,
      .plausible_max = 0.2,
      .look_alikes = {"thickness_gradient", "stiffer_half", "oblique_pull"},
      .isolated_by = "marks on the grip",
      .reference = "ASTM E1012, alignment of testing frames",
      .native = "grip_tilt"};
}

MechanismFactory oblique_pull() {
  return {.id = "oblique_pull",
          .cause = "The grip moves at an angle to the specimen's axis.",
          .stage = Stage::test,
          .applies_to = fields,
          .parameters = {{"angle", "deg", 0, -20, 20, Scale::linear,
                          "From the normal of the moved side to the way that it goes; above 0 where its ux and uy have "
                          "the same sign.",
                          ""}},
          .null = 0,
          .side = Side::both,
          .plausible_min = -10,
          .plausible_max = 10,
          .look_alikes = {"grip_tilt", "clamp_slip"},
          .isolated_by = "marks on the grip",
          .reference = "ASTM E1012, alignment of testing frames",
          .native = "oblique_pull"};
}

}  // namespace

std::vector<MechanismFactory> of_fields() {
  return {clamp_slip(), grip_tilt(), oblique_pull(), thickness_gradient(), stiffer_half()};
}

}  // namespace tunica::native
