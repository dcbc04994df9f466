// SPDX-License-Identifier: Apache-2.0
// What a record says of a test and is not so, with one amplitude: where its stretch begins, what the machine gave way,
// a zero that was taken under load, gauge lengths, offsets and gains of a sheet, and a channel that comes late.
//
// Of strips and sheets the force is right, and the stress was computed from it and the recorded stretch.
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "../abscissa_errors/corrected.hpp"
#include "../abscissa_errors/stress_measure.hpp"
#include "../channel_errors/misread.hpp"
#include "late.hpp"
#include "recorded_force.hpp"
#include "tunica/plugin.hpp"
#include "tunica/tests/decorated_test.hpp"

namespace tunica::record_errors {
namespace {

using Misrecorded = MechanismFactory::Misrecorded;
const std::vector<std::string> strips{"uniaxial"}, sheets{"biaxial"};

/// A stretch, and the stress along it.
struct Direction {
  std::size_t abscissa, channel;
  int power;  ///< force over area = stress · stretch^power
};

std::string stretch_beside(const std::string& stress) { return "stretch" + stress.substr(6); }
bool is_stress(const std::string& channel) { return channel.starts_with("stress"); }

/// Of a strip: its only direction.
std::size_t stress_of(const std::string& id, const TestRows& rows) {
  if (const auto channel = channel_index(rows, "stress")) return *channel;
  throw InputError(id +
                   ": the test's data have no 'stress', which the recorded stretch makes of the force; map a column to "
                   "'stress', or take the mechanism out");
}

Direction direction_of(const std::string& id, const Test& test, std::size_t channel) {
  const TestRows& rows = test.rows();
  const std::string stretch = stretch_beside(rows.channels[channel]);
  const std::optional<std::size_t> abscissa = abscissa_index(rows, stretch);
  if (!abscissa)
    throw InputError(id + ": the test's data have no '" + stretch +
                     "', which is what the mechanism corrects; map a column to '" + stretch +
                     "', or take the mechanism out");
  const std::optional<int> power = abscissa_errors::force_power(test, *abscissa, channel);
  if (!power)
    throw InputError(id + ": '" + rows.channels[channel] +
                     "' is no Cauchy, first or second Piola-Kirchhoff stress of a strip or a sheet; expected a test "
                     "such as uniaxial or biaxial; take the mechanism out");
  return {*abscissa, channel, *power};
}

/// The stresses that the option names, or all.
std::vector<std::size_t> stresses_of(const std::string& id, const Options& options, const TestRows& rows) {
  const std::string& wanted = options.text("channel");
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < rows.channels.size(); ++k)
    if (is_stress(rows.channels[k]) && (wanted.empty() || wanted == rows.channels[k])) found.push_back(k);
  if (found.empty())
    throw InputError(id + ": " +
                     (wanted.empty() ? std::string("the test's data have no stress")
                                     : "\"channel\" is '" + wanted + "', which is no stress of the test's data") +
                     "; expected a channel such as stress_axial; take the mechanism out, or name one that there is");
  return found;
}

Option channel_option() {
  return Option::text("channel", "", "The stress of the direction that is meant; left out, all of the test.");
}

/// The texts of a mechanism.
struct Explanation {
  std::string cause;
  std::vector<std::string> look_alikes;
  std::string isolated_by, reference;
};

MechanismFactory described(std::string id, std::vector<std::string> tests, Parameter amplitude, double least,
                           double most, Explanation texts) {
  return {.id = std::move(id),
          .cause = std::move(texts.cause),
          .stage = Stage::test,
          .applies_to = std::move(tests),
          .parameters = {std::move(amplitude)},
          .side = least < 0 ? MechanismFactory::Side::both : MechanismFactory::Side::positive,
          .plausible_min = least,
          .plausible_max = most,
          .look_alikes = std::move(texts.look_alikes),
          .isolated_by = std::move(texts.isolated_by),
          .reference = std::move(texts.reference)};
}

abscissa_errors::Correction moved(double c) { return {1, c, 0, 1}; }
abscissa_errors::Correction scaled(double gain) { return {1 + gain, 0, 1, 0}; }
abscissa_errors::Correction elongated(double gain) { return {1 + gain, -gain, 1, -1}; }
channel_errors::Reading offset(double c) { return {1, c, 0, 1}; }
channel_errors::Reading gained(double gain) { return {1 + gain, 0, 1, 0}; }

MechanismFactory displacement_offset() {
  MechanismFactory mechanism = described(
      "displacement_offset", strips,
      {"stretch", "1", 0, -0.5, 0.5, Scale::linear, "True less recorded stretch. The force is kept.", ""}, -0.15, 0.15,
      {"The displacement was not zeroed at the unloaded length: the strip was slack, or the zero lies elsewhere.",
       {"reference_length_error", "zeroed_at_preload", "force_offset"},
       "the length at which the load begins, read once more",
       "ASTM D412-16, Test Methods for Vulcanized Rubber in Tension"});
  mechanism.wrap_test = [id = mechanism.id, amplitude = mechanism.parameters.front()](
                            std::unique_ptr<Test> base, const Options&) -> std::unique_ptr<Test> {
    const Direction at = direction_of(id, *base, stress_of(id, base->rows()));
    return abscissa_errors::corrected(std::move(base), amplitude, moved, {at.abscissa, at.channel, at.power});
  };
  mechanism.calibration = [](const Misrecorded& at) {
    return fmt::format("the true stretches of {} are {:.3g} {} than recorded", at.tests, std::abs(at.amplitude),
                       at.amplitude < 0 ? "smaller" : "larger");
  };
  mechanism.question_only = true;
  return mechanism;
}

/// Those that see a strip by its force.
MechanismFactory by_force(MechanismFactory mechanism, Recorder recorder) {
  mechanism.wrap_test = [id = mechanism.id, amplitude = mechanism.parameters.front(), recorder](
                            std::unique_ptr<Test> base, const Options&) -> std::unique_ptr<Test> {
    const Direction at = direction_of(id, *base, stress_of(id, base->rows()));
    return recorder(std::move(base), amplitude, {at.abscissa, at.channel, at.power});
  };
  return mechanism;
}

MechanismFactory zeroed_at_preload() {
  MechanismFactory mechanism = by_force(
      described(
          "zeroed_at_preload", strips,
          {"stretch", "1", 0, 0, 0.5, Scale::linear, "Stretch at which force and length were zeroed, less 1.", ""}, 0,
          0.2,
          {"Force and length were both zeroed after the specimen had been loaded a little.",
           {"reference_length_error", "displacement_offset", "force_offset"},
           "the preload, and the length without it",
           "Carew, Garg, Barber, Vesely, Ann. Biomed. Eng. 32:548 (2004)"}),
      zeroed_under_load);
  mechanism.calibration = [](const Misrecorded& at) {
    return fmt::format("force and length of {} were zeroed under load, at a stretch of {:.4g}", at.tests,
                       1 + at.amplitude);
  };
  mechanism.question_only = true;
  return mechanism;
}

MechanismFactory machine_compliance() {
  MechanismFactory mechanism = by_force(
      described("machine_compliance", strips,
                {"compliance", "1/kPa", 0, 0, 0.01, Scale::linear,
                 "Stretch that load cell, frame and grips take, for each kPa of force over unloaded area.", ""},
                0, 0.002,
                {"Load cell, frame and grips give way under load, and the crosshead was taken for the specimen.",
                 {"reference_length_error", "force_scale_error", "matrix_stiffening"},
                 "markers on the specimen, or a steel bar in place of it",
                 "Kalidindi, Abusafieh, El-Danaf, Exp. Mech. 37:210 (1997)"}),
      given_way);
  mechanism.plausible_effect = 0.5;
  mechanism.calibration = [](const Misrecorded& at) {
    return fmt::format("frame and grips of {} take a stretch of {:.3g} for each kPa", at.tests, at.amplitude);
  };
  mechanism.question_only = true;
  return mechanism;
}

MechanismFactory sheet_prestretch() {
  MechanismFactory mechanism = described(
      "sheet_prestretch", sheets,
      {"stretch", "1", 0, -0.3, 0.3, Scale::linear,
       "True over recorded stretch, less 1; of a stretch that follows from a displacement or a strain, true over "
       "recorded elongation, less 1. The force is kept.",
       ""},
      -0.15, 0.15,
      {"The zero of the stretches of a sheet is no unloaded state, or a gauge length is wrong.",
       {"sheet_force_scale_error", "sheet_force_offset", "matrix_stiffening"},
       "markers on the sheet before it is mounted",
       "Sacks, J. Elasticity 61:199 (2000)"});
  mechanism.options = {channel_option()};
  mechanism.wrap_test = [id = mechanism.id, amplitude = mechanism.parameters.front()](
                            std::unique_ptr<Test> base, const Options& options) -> std::unique_ptr<Test> {
    const std::vector<std::size_t> stresses = stresses_of(id, options, base->rows());
    if (stresses.size() != 1)
      throw InputError(id + ": the test has several stresses; say which direction with \"channel\": " +
                       base->rows().channels[stresses[0]] + " or " + base->rows().channels[stresses[1]]);
    const Direction at = direction_of(id, *base, stresses.front());
    const bool elongation = base->rows().abscissae[at.abscissa].from_elongation;
    return abscissa_errors::corrected(std::move(base), amplitude, elongation ? elongated : scaled,
                                      {at.abscissa, at.channel, at.power});
  };
  mechanism.calibration = [](const Misrecorded& at) {
    return fmt::format("the true {}stretches of {} are {:.4g} times the recorded ones", at.direction, at.tests,
                       1 + at.amplitude);
  };
  mechanism.question_only = true;
  mechanism.by_channel = true;
  return mechanism;
}

MechanismFactory sheet_reading(MechanismFactory mechanism, channel_errors::Error error) {
  mechanism.options = {channel_option()};
  mechanism.wrap_test = [id = mechanism.id, amplitude = mechanism.parameters.front(), error](
                            std::unique_ptr<Test> base, const Options& options) -> std::unique_ptr<Test> {
    std::vector<std::size_t> stresses = stresses_of(id, options, base->rows());
    return channel_errors::misread(std::move(base), amplitude, error, {std::move(stresses), {}});
  };
  return mechanism;
}

const char* const load_cells = "ISO 7500-1:2018, Calibration and verification of static uniaxial testing machines";

MechanismFactory sheet_force_offset() {
  MechanismFactory mechanism =
      sheet_reading(described("sheet_force_offset", sheets,
                              {"value", "kPa", 0, -50, 50, Scale::linear,
                               "Stress that the load cell shows at no load, in the measure of the data.", ""},
                              -10, 10,
                              {"A load cell of the sheet was not zeroed.",
                               {"sheet_prestretch", "sheet_force_scale_error", "outliers"},
                               "a reading of the load cell without specimen",
                               load_cells}),
                    offset);
  mechanism.plausible_effect = 0.2;
  mechanism.calibration = [](const Misrecorded& at) {
    return fmt::format("the {}load cell of {} shows {:.3g} kPa at no load", at.direction, at.tests, at.amplitude);
  };
  mechanism.question_only = true;
  return mechanism;
}

MechanismFactory sheet_force_scale_error() {
  MechanismFactory mechanism = sheet_reading(
      described("sheet_force_scale_error", sheets,
                {"gain", "1", 0, -0.5, 1, Scale::linear, "Measured over true stress, less 1.", ""}, -0.3, 0.3,
                {"The gain of a load cell of the sheet, or the area that its force was divided by, is wrong.",
                 {"sheet_prestretch", "axial_fibres", "circumferential_fibres"},
                 "a known weight on the load cell",
                 load_cells}),
      gained);
  mechanism.calibration = [](const Misrecorded& at) {
    return fmt::format("the {}stresses of {} are {:.4g} times the true ones", at.direction, at.tests, 1 + at.amplitude);
  };
  mechanism.question_only = true;
  return mechanism;
}

MechanismFactory channel_lag() {
  MechanismFactory mechanism = described(
      "channel_lag", {},
      {"lag", "s", 0, 0, 100, Scale::linear, "Time by which the readings come late against what is prescribed.", ""}, 0,
      10,
      {"A channel comes late, by a filter or by another clock: its error grows with the rate.",
       {"viscoelasticity", "signal_drift", "stress_softening"},
       "the same loop at another rate",
       "Ljung, System Identification, 2nd ed. (1999), 14.2"});
  mechanism.memory = true;
  mechanism.wrap_test = [amplitude = mechanism.parameters.front()](std::unique_ptr<Test> base, const Options&) {
    return late(std::move(base), amplitude);
  };
  mechanism.calibration = [](const Misrecorded& at) {
    return fmt::format("the readings of {} come {:.3g} s late", at.tests, at.amplitude);
  };
  mechanism.question_only = true;
  return mechanism;
}

}  // namespace
}  // namespace tunica::record_errors

TUNICA_PLUGIN("record_errors", TUNICA_PLUGIN_VERSION) {
  for (auto* const factory : {tunica::record_errors::displacement_offset, tunica::record_errors::zeroed_at_preload,
                              tunica::record_errors::machine_compliance, tunica::record_errors::sheet_prestretch,
                              tunica::record_errors::sheet_force_offset, tunica::record_errors::sheet_force_scale_error,
                              tunica::record_errors::channel_lag})
    registry.add(factory());
}
