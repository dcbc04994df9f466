// SPDX-License-Identifier: Apache-2.0
// Errors of what is read: load cells and cameras not zeroed or with another gain than they were calibrated to, readings
// that drift, and readings that are wrong at some rows. Of strips measured = true + c or (1 + γ) true, of tubes true =
// measured + c or (1 + γ) measured.
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "target.hpp"
#include "tunica/plugin.hpp"

namespace tunica::channel_errors {
namespace {

Reading shifted(double c) { return {1, c, 0, 1}; }
Reading scaled(double gamma) { return {1 + gamma, 0, 1, 0}; }
Reading shifted_back(double c) { return {1, -c, 0, -1}; }
Reading scaled_back(double gamma) { return {1 / (1 + gamma), 0, -1 / ((1 + gamma) * (1 + gamma)), 0}; }

const std::vector<std::string> tubes{"thick_wall_pressurisation", "fe_pressurisation"};
const std::vector<std::string> diameters{"outer_diameter", "inner_diameter", "outer_diameter_stretch",
                                         "inner_diameter_stretch"};

/// The texts of a mechanism.
struct Explanation {
  std::string cause;
  std::vector<std::string> look_alikes;
  std::string isolated_by, reference;
};

MechanismFactory described(std::string id, std::vector<std::string> tests, Parameter amplitude, double plausible,
                           Explanation texts) {
  return {.id = std::move(id),
          .cause = std::move(texts.cause),
          .stage = tunica::Stage::test,
          .applies_to = std::move(tests),
          .parameters = {std::move(amplitude)},
          .null = 0,
          .side = MechanismFactory::Side::both,
          .plausible_min = -plausible,
          .plausible_max = plausible,
          .look_alikes = std::move(texts.look_alikes),
          .isolated_by = std::move(texts.isolated_by),
          .reference = std::move(texts.reference)};
}

/// Misreads those of the channels that the test has.
MechanismFactory reading(MechanismFactory mechanism, std::vector<std::string> channels, Error error) {
  mechanism.shared = mechanism.applies_to == tubes;
  mechanism.wrap_test = [id = mechanism.id, channels = std::move(channels), amplitude = mechanism.parameters.front(),
                         error](std::unique_ptr<Test> base, const Options&) -> std::unique_ptr<Test> {
    std::vector<std::size_t> found = channels_named(id, channels, base->rows());
    return misread(std::move(base), amplitude, error, {std::move(found), {}});
  };
  return mechanism;
}

/// The shift of one channel; `share` is the fraction of it in each row.
template <class Share>
MechanismFactory partly_shifted(MechanismFactory mechanism, Share share) {
  mechanism.wrap_test = [id = mechanism.id, amplitude = mechanism.parameters.front(), share](
                            std::unique_ptr<Test> base, const Options& options) -> std::unique_ptr<Test> {
    const TestRows& rows = base->rows();
    const std::size_t channel = channel_chosen(id, options, rows);
    const Parameter own = in_unit_of(rows.channels[channel], amplitude);
    Where where{{channel}, share(id, options, rows)};
    return misread(std::move(base), own, shifted, std::move(where));
  };
  return mechanism;
}

/// An offset in the unit of its channel is plausible up to a fifth of the channel's range.
MechanismFactory by_range(MechanismFactory mechanism) {
  mechanism.plausible_effect = 0.2;
  return mechanism;
}

/// The question that a known weight on the load cell, or a reading without specimen, settles.
MechanismFactory settled(MechanismFactory mechanism,
                         std::function<std::string(const MechanismFactory::Misrecorded&)> words) {
  mechanism.calibration = std::move(words);
  return mechanism;
}

std::vector<MechanismFactory> of_known_channels() {
  const std::string load_cells = "ISO 7500-1:2018, Calibration and verification of static uniaxial testing machines";
  const std::string tube_rigs = "Humphrey, Kang, Sakarda, Anjanappa, Ann. Biomed. Eng. 21:33 (1993)";
  const std::string not_zeroed = "The load cell was not zeroed: every force reading carries the same error.";
  return {
      settled(reading(by_range(described("force_offset", {"uniaxial"},
                                         {"value", "kPa", 0, -50, 50, Scale::linear,
                                          "Stress the load cell shows at no load, in the data's measure.", ""},
                                         10,
                                         {not_zeroed,
                                          {"outliers", "reference_length_error", "active_tone"},
                                          "a reading of the load cell without specimen",
                                          load_cells})),
                      {"stress"}, shifted),
              [](const MechanismFactory::Misrecorded& at) {
                return fmt::format("the {}load cell of {} shows {:.3g} kPa at no load", at.direction, at.tests,
                                   at.amplitude);
              }),
      settled(
          reading(described("force_scale_error", {"uniaxial"},
                            {"gain", "1", 0, -0.5, 1, Scale::linear, "Measured over true stress, less one.", ""}, 0.2,
                            {"The load cell's gain, or the area its force was divided by, is wrong.",
                             {"reference_length_error", "specimen_misalignment", "permanent_set"},
                             "a known weight on the load cell",
                             load_cells}),
                  {"stress"}, scaled),
          [](const MechanismFactory::Misrecorded& at) {
            return fmt::format("the {}stresses of {} are {:.4g} times the true ones", at.direction, at.tests,
                               1 + at.amplitude);
          }),
      reading(
          by_range(described("axial_force_offset", tubes,
                             {"value", "mN", 0, -1000, 1000, Scale::linear, "True less measured axial force.", ""}, 100,
                             {not_zeroed,
                              {"axial_force_scale_error", "axial_stretch_error", "outliers"},
                              "a reading of the load cell without specimen",
                              load_cells})),
          {"axial_force"}, shifted_back),
      reading(described("axial_force_scale_error", tubes,
                        {"gain", "1", 0, -0.5, 1, Scale::linear, "True over measured axial force, less one.", ""}, 0.2,
                        {"The load cell's gain is wrong.",
                         {"axial_force_offset", "axial_stretch_error", "outliers"},
                         "a known weight on the load cell",
                         load_cells}),
              {"axial_force"}, scaled_back),
      reading(described("diameter_scale_error", tubes,
                        {"gain", "1", 0, -0.2, 0.2, Scale::linear, "True over measured diameter, less one.", ""}, 0.1,
                        {"The camera's scale, or the unloaded diameter that readings were divided by, is wrong.",
                         {"outliers", "residual_stress", "geometry_error"},
                         "a rod of known diameter in place of the tube",
                         tube_rigs}),
              diameters, scaled_back)};
}

std::vector<MechanismFactory> of_chosen_channels() {
  constexpr double widest = 1000, plausible = 100;  // in the channel's unit: force in mN, stress in kPa
  MechanismFactory drift =
      described("signal_drift", {},
                {"value", "1", 0, -widest, widest, Scale::linear,
                 "What the channel shows too much at the end of the recording, in the channel's base unit.", ""},
                plausible,
                {"A sensor drifts: its reading runs away steadily while the test lasts.",
                 {"viscoelasticity", "stress_softening", "force_offset"},
                 "a reading at no load after the test, or the same loading in reverse",
                 "JCGM 200:2012, International vocabulary of metrology, 4.21 instrumental drift"});
  drift.options = {channel_option()};
  drift.memory = true;  // without a clock the row stands for it
  MechanismFactory outliers =
      described("outliers", {},
                {"value", "1", 0, -widest, widest, Scale::linear,
                 "What the channel shows too much at these rows, in the channel's base unit.", ""},
                plausible,
                {"Some readings, or one whole curve, do not belong to the others: a slip, a bubble, a mistyped number.",
                 {"force_offset", "diameter_scale_error", "axial_force_offset"},
                 "the same test once more",
                 "Cook, Weisberg, Residuals and Influence in Regression (1982)"});
  outliers.stage = tunica::Stage::data;
  outliers.options = {channel_option(), rows_option()};
  return {partly_shifted(std::move(drift),
                         [](const std::string& id, const Options&, const TestRows& rows) { return elapsed(id, rows); }),
          partly_shifted(std::move(outliers), [](const std::string& id, const Options& options, const TestRows& rows) {
            return rows_chosen(id, options, rows.count);
          })};
}

}  // namespace
}  // namespace tunica::channel_errors

TUNICA_PLUGIN("channel_errors", TUNICA_PLUGIN_VERSION) {
  for (auto& mechanism : tunica::channel_errors::of_known_channels()) registry.add(std::move(mechanism));
  for (auto& mechanism : tunica::channel_errors::of_chosen_channels()) registry.add(std::move(mechanism));
}
