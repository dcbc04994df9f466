// SPDX-License-Identifier: Apache-2.0
#include "effects.hpp"

namespace blind {
namespace {

using Where = Effect::Where;

/// An effect of the material that is one number.
template <double Tissue::*member>
void set_tissue(World& world, const Protocol&, const HiddenEffect& hidden) {
  world.tissue.*member = hidden.amplitude();
}
/// Of one tube or of all.
template <double TubeFaults::*member>
void set_tubes(World& world, const Protocol&, const HiddenEffect& hidden) {
  for (std::size_t i = 0; i < world.tubes.size(); ++i)
    if (hidden.target.tube.value_or(i) == i) world.tubes[i].*member = hidden.amplitude();
}
template <double StripFaults::*member>
void set_strip(World& world, const Protocol&, const HiddenEffect& hidden) {
  world.strips[*hidden.target.strip].*member = hidden.amplitude();
}

Effect of_material(std::string id, std::string unit, double null, double high, decltype(Effect::apply) apply,
                   std::vector<Effect::Nuisance> nuisances = {}) {
  return {.id = std::move(id),
          .unit = std::move(unit),
          .where = Where::material,
          .null = null,
          .low = null,
          .high = high,
          .nuisances = std::move(nuisances),
          .apply = std::move(apply)};
}
Effect of_tube(std::string id, std::string unit, Where where, double low, double high, decltype(Effect::apply) apply) {
  return {.id = std::move(id),
          .unit = std::move(unit),
          .where = where,
          .null = 0,
          .low = low,
          .high = high,
          .apply = std::move(apply)};
}
Effect of_strip(std::string id, std::string unit, double largest, decltype(Effect::apply) apply) {
  return {.id = std::move(id),
          .unit = std::move(unit),
          .where = Where::strip,
          .null = 0,
          .low = -largest,
          .high = largest,
          .apply = std::move(apply)};
}

std::vector<Effect> of_the_material() {
  return {of_material("fibre_dispersion", "1", 0, 0.3, set_tissue<&Tissue::kappa>),
          of_material("axial_fibres", "kPa", 0, 50,
                      [](World& world, const Protocol&, const HiddenEffect& hidden) {
                        world.tissue.axial_k = hidden.amplitude();
                        world.tissue.axial_k2 = hidden.nuisance.at("k2");
                      },
                      {{"k2", 0.3, 3, {0.03, 0.3, 1, 3, 10}}}),
          of_material("circumferential_fibres", "kPa", 0, 50,
                      [](World& world, const Protocol&, const HiddenEffect& hidden) {
                        world.tissue.around_k = hidden.amplitude();
                        world.tissue.around_k2 = hidden.nuisance.at("k2");
                      },
                      {{"k2", 0.3, 3, {0.03, 0.3, 1, 3, 10}}}),
          of_material("matrix_stiffening", "1", 0, 5, set_tissue<&Tissue::stiffening>),
          of_material("chain_extensibility", "1", 0, 0.2, set_tissue<&Tissue::inverse_limit>),
          of_material("second_invariant", "kPa", 0, 50, set_tissue<&Tissue::second_invariant>),
          of_material("fibre_recruitment", "1", 1, 1.5, set_tissue<&Tissue::recruitment>),
          of_material("active_tone", "kPa", 0, 100, set_tissue<&Tissue::tone>),
          of_material("stress_softening", "1", 0, 0.8,
                      [](World& world, const Protocol&, const HiddenEffect& hidden) {
                        world.tissue.softening = hidden.amplitude();
                        world.tissue.softening_width = hidden.nuisance.at("m");
                      },
                      {{"m", 0.2, 1, {0.1, 0.3, 1, 3}}}),
          of_material("viscoelasticity", "1", 0, 3,
                      [](World& world, const Protocol&, const HiddenEffect& hidden) {
                        world.tissue.branch = hidden.amplitude();
                        world.tissue.relaxation = hidden.nuisance.at("tau");
                      },
                      {{"tau", 2, 60, {0.5, 2, 6, 20, 60, 200}}})};
}

std::vector<Effect> of_the_tubes() {
  using enum Where;
  std::vector<Effect> all = {
      of_tube("residual_stress", "deg", all_tubes, -60, 300, set_tubes<&TubeFaults::opening_angle>),
      of_tube("axial_stretch_error", "1", tube_or_all, -0.1, 0.1, set_tubes<&TubeFaults::axial_stretch>),
      of_tube("tethering", "kPa", all_tubes, 0, 40, set_tubes<&TubeFaults::support>),
      of_tube("geometry_error", "1", all_tubes, -0.3, 0.3, set_tubes<&TubeFaults::thickness>),
      of_tube("pressure_offset", "kPa", tube_or_all, -2, 2, set_tubes<&TubeFaults::pressure_offset>),
      of_tube("pressure_scale_error", "1", tube_or_all, -0.2, 0.2, set_tubes<&TubeFaults::pressure_gain>),
      of_tube("diameter_scale_error", "1", tube_or_all, -0.1, 0.1, set_tubes<&TubeFaults::diameter_gain>),
      of_tube("axial_force_offset", "mN", tube_or_all, -100, 100, set_tubes<&TubeFaults::force_offset>),
      of_tube("axial_force_scale_error", "1", tube_or_all, -0.2, 0.2, set_tubes<&TubeFaults::force_gain>)};
  all.push_back({.id = "layered_wall",
                 .unit = "1",
                 .where = all_tubes,
                 .null = 1,
                 .low = 0.1,
                 .high = 10,
                 .nuisances = {{"interface", 0, 1, {1. / 2, 2. / 3}, {1. / 2, 2. / 3}}},
                 .logarithmic = true,
                 .apply = [](World& world, const Protocol&, const HiddenEffect& hidden) {
                   for (TubeFaults& tube : world.tubes) {
                     tube.layer_ratio = hidden.amplitude();
                     tube.interface = hidden.nuisance.at("interface");
                   }
                 }});
  return all;
}

std::vector<Effect> of_the_records() {
  std::vector<Effect> all = {of_strip("reference_length_error", "1", 0.1, set_strip<&StripFaults::reference_length>),
                             of_strip("force_scale_error", "1", 0.2, set_strip<&StripFaults::gain>),
                             of_strip("force_offset", "kPa", 10, set_strip<&StripFaults::offset>),
                             of_strip("specimen_misalignment", "deg", 10, set_strip<&StripFaults::misalignment>)};
  all.back().even = true;
  all.push_back(of_strip("permanent_set", "1", 0.6, set_strip<&StripFaults::set>));
  all.back().low = 0;
  all.push_back({.id = "signal_drift",
                 .unit = "",
                 .where = Where::channel,
                 .null = 0,
                 .low = -0.3,
                 .high = 0.3,
                 .apply = [](World& world, const Protocol&, const HiddenEffect& hidden) {
                   world.channels[*hidden.target.channel].drift = hidden.amplitude();
                 }});
  all.push_back({.id = "outliers",
                 .unit = "",
                 .where = Where::points,
                 .null = 0,
                 .low = -0.5,
                 .high = 0.5,
                 .apply = [](World& world, const Protocol& protocol, const HiddenEffect& hidden) {
                   const std::size_t channel = *hidden.target.channel, count = channels(protocol)[channel].count;
                   for (std::size_t i = 0; i < count; ++i)
                     if (hidden.target.row.value_or(i) == i) world.shifts.push_back({channel, i, hidden.amplitude()});
                 }});
  return all;
}

}  // namespace

const std::vector<Effect>& catalogue() {
  static const std::vector<Effect> all = [] {
    std::vector<Effect> made = of_the_material();
    for (const auto& part : {of_the_tubes(), of_the_records()}) made.insert(made.end(), part.begin(), part.end());
    return made;
  }();
  return all;
}

const std::vector<Effect>& outsiders() {
  using enum Where;
  const auto resembling = [](Effect made, std::string look_alike) {
    made.look_alike = std::move(look_alike);
    return made;
  };
  static const std::vector<Effect> all = {
      resembling(of_material("quadratic_matrix", "kPa", 0, 50, set_tissue<&Tissue::quadratic_matrix>),
                 "matrix_stiffening"),
      resembling(of_material("axial_matrix", "kPa", 0, 50, set_tissue<&Tissue::axial_stiffening>), "axial_fibres"),
      resembling(of_strip("bent_load_cell", "1", 0.5, set_strip<&StripFaults::bend>), "force_scale_error"),
      resembling(of_tube("bent_pressure_sensor", "1", tube_or_all, -0.4, 0.4, set_tubes<&TubeFaults::pressure_bend>),
                 "pressure_scale_error"),
      resembling({.id = "warming",
                  .unit = "",
                  .where = channel,
                  .null = 0,
                  .low = -0.3,
                  .high = 0.3,
                  .apply =
                      [](World& world, const Protocol&, const HiddenEffect& hidden) {
                        world.channels[*hidden.target.channel].quadratic_drift = hidden.amplitude();
                      }},
                 "signal_drift"),
      resembling({.id = "slipping_tube",
                  .unit = "1",
                  .where = tube_or_all,
                  .null = 0,
                  .low = 0,
                  .high = 0.2,
                  .apply = set_tubes<&TubeFaults::slip>},
                 "axial_stretch_error"),
      of_material("fibre_power", "1", 0, 2, set_tissue<&Tissue::fibre_power>),
      of_strip("friction", "kPa", 20, set_strip<&StripFaults::friction>),
      {.id = "slipping_grips",
       .unit = "1",
       .where = strip,
       .null = 0,
       .low = 0,
       .high = 0.15,
       .apply = set_strip<&StripFaults::slip>},
      {.id = "clamped_width",
       .unit = "1",
       .where = strip,
       .null = 0,
       .low = 0,
       .high = 0.8,
       .apply = set_strip<&StripFaults::clamp>},
      {.id = "oval_tube",
       .unit = "1",
       .where = all_tubes,
       .null = 0,
       .low = 0,
       .high = 0.2,
       .apply = set_tubes<&TubeFaults::ovality>},
      {.id = "hum",
       .unit = "",
       .where = channel,
       .null = 0,
       .low = -0.3,
       .high = 0.3,
       .apply = [](World& world, const Protocol&, const HiddenEffect& hidden) {
         world.channels[*hidden.target.channel].hum = hidden.amplitude();
       }}};
  return all;
}

}  // namespace blind
