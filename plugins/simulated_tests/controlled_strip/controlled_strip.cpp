// SPDX-License-Identifier: Apache-2.0
#include "controlled_strip.hpp"

#include <limits>

#include "../loading_order/loading_order.hpp"

namespace tunica::controlled_strip {

Control measure_of(const std::string& stress_measure) {
  return stress_measure == "first_piola_kirchhoff"    ? Control::nominal
         : stress_measure == "second_piola_kirchhoff" ? Control::second
                                                      : Control::cauchy;
}

Strip strip_of(const TestSetup& setup, const char* type) {
  Strip strip;
  strip.type = type;
  strip.loaded = setup.options.text("direction") == "circumferential" ? 0 : 1;
  strip.measure = measure_of(setup.stress_measure);
  strip.rows = setup.rows.count;
  strip.timed = !setup.rows.time.empty();
  strip.has_set = setup.options.flag("permanent_set");
  for (const std::string& channel : setup.rows.channels)
    strip.channels.push_back(channel == "stress"               ? Channel::stress
                             : channel == "transverse_stretch" ? Channel::transverse_stretch
                             : channel == "normal_stretch"     ? Channel::normal_stretch
                                                               : Channel::stretch);
  check_loading_order(type, setup.rows.time);
  return strip;
}

void check_steps(const char* type, double count) {
  constexpr double most = 1e7;
  if (count > most)
    throw InputError(std::string(type) + ": the simulation would take " + std::to_string(count) +
                     " steps, more than 10000000; lower \"steps\", or leave out rows or cycles");
}

Option direction_option() {
  return Option::choice("direction", {"circumferential", "axial"}, {}, "Material axis the strip is pulled along.");
}

std::vector<Observable> lateral_channels() {
  using Role = Observable::Role;
  return {{"transverse_stretch", "1", Role::channel, false, "In-plane stretch across the strip.",
           Observable::Kind::stretch},
          {"normal_stretch", "1", Role::channel, false, "Stretch through the thickness.", Observable::Kind::stretch}};
}

namespace {

Parameter set_parameter() {
  return {"permanent_set",
          "1",
          0.1,
          0,
          0.9,
          Scale::linear,
          "Part of the largest stretch less one by which the strip stays longer.",
          "Diani, Fayolle, Gilormini 2009"};
}

}  // namespace

void add_common_options(std::vector<Option>& options) {
  options.push_back({"permanent_set", Option::Kind::flag, false,
                     "Whether the strip stays longer after it has been stretched, by a parameter of the test."});
  options.push_back(
      Option::quantity("temperature", "K", 0, "Temperature of the test; the option shift needs it.", 0.0));
  for (Option& option : temperature_shift::shift_options()) options.push_back(std::move(option));
}

std::vector<Parameter> all_parameters() {
  using temperature_shift::Shift;
  std::vector<Parameter> all{set_parameter()};
  for (const Shift shift : {Shift::wlf, Shift::arrhenius})
    for (Parameter& parameter : temperature_shift::shift_parameters(shift)) all.push_back(std::move(parameter));
  return all;
}

TestDescription description_of_strip(const Strip& strip, const Temperature& temperature) {
  TestDescription description;
  if (strip.has_set) description.parameters.push_back(set_parameter());
  for (Parameter& parameter : temperature_shift::shift_parameters(temperature.shift))
    description.parameters.push_back(std::move(parameter));
  description.nulls.assign(description.parameters.size(), std::numeric_limits<double>::quiet_NaN());
  description.diagnostics = {"transverse_stretch", "normal_stretch"};
  description.diagnostic_units = {"1", "1"};
  description.path_derivatives = true;
  return description;
}

}  // namespace tunica::controlled_strip

TUNICA_PLUGIN("controlled_strip", TUNICA_PLUGIN_VERSION) {
  registry.add(tunica::controlled_strip::creep_factory());
  registry.add(tunica::controlled_strip::loading_segments_factory());
}
