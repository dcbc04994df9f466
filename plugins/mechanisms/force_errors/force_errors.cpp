// SPDX-License-Identifier: Apache-2.0
// Errors of a load cell: not zeroed, or with another gain than it was calibrated to; of strips, whose stress is
// measured = true + c or (1 + γ) true, and of tubes, where true = measured + c or (1 + γ) measured.
#include <algorithm>
#include <memory>
#include <utility>

#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

/// measured = gain · true + shift, and its derivatives by the amplitude.
struct Reading {
  double gain = 1, shift = 0;
  double gain_slope = 0, shift_slope = 0;
};
using Error = Reading (*)(double amplitude);

Reading shifted(double c) { return {1, c, 0, 1}; }
Reading scaled(double gamma) { return {1 + gamma, 0, 1, 0}; }
Reading shifted_back(double c) { return {1, -c, 0, -1}; }
Reading scaled_back(double gamma) { return {1 / (1 + gamma), 0, -1 / ((1 + gamma) * (1 + gamma)), 0}; }

/// The base test with another reading of one channel; the amplitude stands behind the base's own parameters.
class MisreadTest final : public Test {
 public:
  MisreadTest(std::unique_ptr<Test> base, const std::string& id, const std::string& channel, const Parameter& amplitude,
              Error error)
      : base_(std::move(base)), description_(base_->describe()), error_(error) {
    const auto& channels = base_->rows().channels;
    const auto found = std::find(channels.begin(), channels.end(), channel);
    if (found == channels.end()) {
      throw InputError(id + ": the test's data have no channel '" + channel +
                       "', which is what the mechanism shifts; map a column to '" + channel +
                       "', or take the mechanism out");
    }
    channel_ = static_cast<std::size_t>(found - channels.begin());
    description_.parameters.push_back(amplitude);
    description_.nulls.push_back(0);
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const std::size_t own = input.test_parameters.size() - 1;
    const double amplitude = input.test_parameters[own];
    const Reading reading = error_(amplitude);
    const std::size_t n = rows().count, column = rows().channels.size() * n, first = channel_ * n;
    const std::size_t bare = output.jacobian.empty() ? 0 : output.jacobian.size() - column;
    TestInput without = input;
    without.test_parameters = input.test_parameters.first(own);
    // The derivative by a gain is the true value.
    std::vector<double> kept;
    std::span<double> values = output.values;
    if (bare > 0 && values.empty() && reading.gain_slope != 0) kept.resize(column), values = kept;
    Status status =
        base_->predict(without, {values, output.jacobian.first(bare), output.abscissa_derivative, output.diagnostics});
    if (!status.ok()) return status;
    if (bare > 0) {
      const auto by_amplitude = output.jacobian.subspan(bare);
      std::fill(by_amplitude.begin(), by_amplitude.end(), 0.0);
      for (std::size_t i = first; i < first + n; ++i)
        by_amplitude[i] = reading.shift_slope + (reading.gain_slope != 0 ? reading.gain_slope * values[i] : 0);
    }
    if (amplitude == 0) return {};  // not even 0 is added at the null: −0 would change its sign
    for (double& value : output.values.empty() ? output.values : output.values.subspan(first, n))
      value = reading.gain * value + reading.shift;
    const auto scale = [&](std::span<double> columns) {
      for (std::size_t at = 0; at < columns.size(); at += column)
        for (double& derivative : columns.subspan(at + first, n)) derivative *= reading.gain;
    };
    scale(output.jacobian.first(bare));
    scale(output.abscissa_derivative);
    return {};
  }
  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override {
    return base_->agreement(bare(input), found);
  }
  Status snapshots(const TestInput& input, std::span<const std::size_t> rows,
                   std::vector<Snapshot>& found) const override {
    return base_->snapshots(bare(input), rows, found);
  }

 private:
  static TestInput bare(TestInput input) {
    input.test_parameters = input.test_parameters.first(input.test_parameters.size() - 1);
    return input;
  }

  std::unique_ptr<Test> base_;
  TestDescription description_;
  Error error_;
  std::size_t channel_ = 0;
};

MechanismFactory reading(MechanismFactory mechanism, const std::string& channel, Error error) {
  mechanism.wrap_test = [id = mechanism.id, channel, amplitude = mechanism.parameters.front(), error](
                            std::unique_ptr<Test> base, const Options&) -> std::unique_ptr<Test> {
    return std::make_unique<MisreadTest>(std::move(base), id, channel, amplitude, error);
  };
  return mechanism;
}

const std::vector<std::string> tubes{"thick_wall_pressurisation", "fe_pressurisation"};

MechanismFactory described(std::string id, std::string cause, std::vector<std::string> tests, Parameter amplitude,
                           double plausible, std::vector<std::string> look_alikes, std::string isolated_by) {
  return {.id = std::move(id),
          .cause = std::move(cause),
          .stage = tunica::Stage::test,
          .applies_to = std::move(tests),
          .parameters = {std::move(amplitude)},
          .null = 0,
          .side = MechanismFactory::Side::both,
          .plausible_min = -plausible,
          .plausible_max = plausible,
          .look_alikes = std::move(look_alikes),
          .isolated_by = std::move(isolated_by),
          .reference = "",
          .options = {}};
}

std::vector<MechanismFactory> factories() {
  const std::string not_zeroed = "The load cell was not zeroed: every force reading carries the same error.";
  const std::string gain = "The load cell's gain, or the area its force was divided by, is wrong.";
  return {reading(described("force_offset", not_zeroed, {"uniaxial"},
                            {"value", "kPa", 0, -50, 50, Scale::linear,
                             "Stress the load cell shows at no load, in the data's measure.", ""},
                            10, {"active_tone", "signal_drift", "reference_length_error"},
                            "a reading of the load cell without specimen"),
                  "stress", shifted),
          reading(described("force_scale_error", gain, {"uniaxial"},
                            {"gain", "1", 0, -0.5, 1, Scale::linear, "Measured over true stress, less one.", ""}, 0.2,
                            {"reference_length_error", "specimen_misalignment"}, "a known weight on the load cell"),
                  "stress", scaled),
          reading(described("axial_force_offset", not_zeroed, tubes,
                            {"value", "mN", 0, -1000, 1000, Scale::linear, "True less measured axial force.", ""}, 100,
                            {"axial_stretch_error", "tethering"}, "a reading of the load cell without specimen"),
                  "axial_force", shifted_back),
          reading(described("axial_force_scale_error", "The load cell's gain is wrong.", tubes,
                            {"gain", "1", 0, -0.5, 1, Scale::linear, "True over measured axial force, less one.", ""},
                            0.2, {"pressure_scale_error", "axial_stretch_error"}, "a known weight on the load cell"),
                  "axial_force", scaled_back)};
}

}  // namespace

TUNICA_PLUGIN("force_errors", TUNICA_PLUGIN_VERSION) {
  for (auto& mechanism : factories()) registry.add(std::move(mechanism));
}
