// SPDX-License-Identifier: Apache-2.0
// Errors of what is prescribed: a pressure transducer not zeroed or with a wrong gain, true = measured + c or
// (1 + γ) measured, and the length that the stretch of a strip refers to: true = (1 + ε) measured where the machine
// recorded the length, true − 1 = (1 + ε) (measured − 1) where it recorded the elongation.
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "corrected.hpp"
#include "stress_measure.hpp"
#include "tunica/plugin.hpp"
#include "tunica/tests/decorated_test.hpp"

namespace tunica::abscissa_errors {
namespace {

Correction shifted(double c) { return {1, c, 0, 1}; }
Correction scaled(double gamma) { return {1 + gamma, 0, 1, 0}; }
Correction elongated(double epsilon) { return {1 + epsilon, -epsilon, 1, -1}; }

std::size_t abscissa_named(const std::string& id, const std::string& name, const TestRows& rows) {
  if (const std::optional<std::size_t> index = abscissa_index(rows, name)) return *index;
  throw InputError(id + ": the test's data have no '" + name +
                   "', which is what the mechanism corrects; map a column to '" + name +
                   "', or take the mechanism out");
}

/// A strip's stress was computed from a force that is right, and from the measured stretch m: σ = P m, S = P/m. With
/// the true stretch λ = s m the data are P(λ) m = σ(λ)/s and P(λ)/m = s S(λ); P(λ) as it is.
Where of_strip(const std::string& id, const Test& strip) {
  const TestRows& rows = strip.rows();
  Where where{.abscissa = abscissa_named(id, "stretch", rows)};
  const std::optional<std::size_t> stress = channel_index(rows, "stress");
  if (!stress) return where;
  where.channel = *stress;
  const std::optional<int> power = force_power(strip, where.abscissa, where.channel);
  if (!power)
    throw InputError(id +
                     ": the test's stress is no Cauchy, first or second Piola-Kirchhoff stress of a strip with "
                     "free lateral faces; expected a test such as uniaxial; take the mechanism out");
  where.power = *power;
  return where;
}

MechanismFactory described(std::string id, std::string cause, std::vector<std::string> tests, Parameter amplitude,
                           double plausible) {
  return {.id = std::move(id),
          .cause = std::move(cause),
          .stage = tunica::Stage::test,
          .applies_to = std::move(tests),
          .parameters = {std::move(amplitude)},
          .side = MechanismFactory::Side::both,
          .plausible_min = -plausible,
          .plausible_max = plausible};
}

MechanismFactory pressure_error(MechanismFactory mechanism, Error error) {
  mechanism.shared = true;
  mechanism.reference = "Humphrey, Kang, Sakarda, Anjanappa, Ann. Biomed. Eng. 21:33 (1993)";
  mechanism.wrap_test = [id = mechanism.id, amplitude = mechanism.parameters.front(), error](
                            std::unique_ptr<Test> base, const Options&) -> std::unique_ptr<Test> {
    const std::size_t pressure = abscissa_named(id, "pressure", base->rows());
    return corrected(std::move(base), amplitude, error, {.abscissa = pressure});
  };
  return mechanism;
}

std::vector<MechanismFactory> factories() {
  const std::vector<std::string> tubes{"thick_wall_pressurisation", "fe_pressurisation"};
  MechanismFactory offset = pressure_error(
      described("pressure_offset", "The pressure transducer was not zeroed, or stood higher or lower than the tube.",
                tubes, {"value", "kPa", 0, -5, 5, Scale::linear, "True less measured pressure.", ""}, 2),
      shifted);
  offset.look_alikes = {"residual_stress", "pressure_scale_error", "tethering"};
  offset.isolated_by = "a reading of the transducer at the height of the open tube";

  MechanismFactory gain = pressure_error(
      described("pressure_scale_error", "The pressure transducer's gain is wrong.", tubes,
                {"gain", "1", 0, -0.5, 0.5, Scale::linear, "True over measured pressure, less one.", ""}, 0.2),
      scaled);
  gain.look_alikes = {"residual_stress", "tethering", "layered_wall"};
  gain.isolated_by = "a water column of known height on the transducer";

  MechanismFactory length = described(
      "reference_length_error", "The unloaded length of the strip was taken wrong: too long, or slack, or under load.",
      {"uniaxial"},
      {"strain", "1", 0, -0.2, 0.2, Scale::linear,
       "True over measured stretch, less one; of a stretch that follows from a displacement or a strain, true over "
       "measured elongation, less one. The force is kept.",
       ""},
      0.1);
  length.look_alikes = {"force_scale_error", "specimen_misalignment", "force_offset"};
  length.isolated_by = "markers on the unloaded strip, or a second clamping";
  length.reference = "Sacks, J. Elasticity 61:199 (2000)";
  length.calibration = [](const MechanismFactory::Misrecorded& at) {
    return fmt::format("the true {}stretches of {} are {:.4g} times the recorded ones", at.direction, at.tests,
                       1 + at.amplitude);
  };
  length.wrap_test = [id = length.id, amplitude = length.parameters.front()](std::unique_ptr<Test> base,
                                                                             const Options&) -> std::unique_ptr<Test> {
    const Where where = of_strip(id, *base);
    const bool elongation = base->rows().abscissae[where.abscissa].from_elongation;
    return corrected(std::move(base), amplitude, elongation ? elongated : scaled, where);
  };
  return {offset, gain, length};
}

}  // namespace
}  // namespace tunica::abscissa_errors

TUNICA_PLUGIN("abscissa_errors", TUNICA_PLUGIN_VERSION) {
  for (auto& mechanism : tunica::abscissa_errors::factories()) registry.add(std::move(mechanism));
}
