// SPDX-License-Identifier: Apache-2.0
// A load cell that was not zeroed: measured stress = true stress + c, in the stress measure of the data.
#include <algorithm>
#include <memory>
#include <utility>

#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

constexpr const char* shifted_channel = "stress";

Parameter value() {
  return {"value", "kPa", 0, -50, 50, Scale::linear, "Stress the load cell shows at no load, in the data's measure.",
          ""};
}

/// The base test with c added to the predictions of one channel; its parameter stands behind the base's own.
class OffsetTest final : public Test {
 public:
  explicit OffsetTest(std::unique_ptr<Test> base) : base_(std::move(base)), description_(base_->describe()) {
    const auto& channels = base_->rows().channels;
    const auto found = std::find(channels.begin(), channels.end(), shifted_channel);
    if (found == channels.end()) {
      throw InputError(
          "force_offset: the test's data have no channel 'stress', which is what the mechanism shifts; map a column "
          "to 'stress', or take the mechanism out");
    }
    channel_ = static_cast<std::size_t>(found - channels.begin());
    description_.parameters.push_back(value());
    description_.nulls.push_back(0);
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const std::size_t own = input.test_parameters.size() - 1;
    const double offset = input.test_parameters[own];
    const std::size_t n = rows().count, column = rows().channels.size() * n;
    const std::size_t bare = output.jacobian.empty() ? 0 : output.jacobian.size() - column;
    TestInput without = input;
    without.test_parameters = input.test_parameters.first(own);
    Status status = base_->predict(
        without, {output.values, output.jacobian.first(bare), output.abscissa_derivative, output.diagnostics});
    if (!status.ok()) return status;
    // Not even 0 is added at the null: −0 would change its sign.
    if (!output.values.empty() && offset != 0) {
      for (double& stress : output.values.subspan(channel_ * n, n)) stress += offset;
    }
    if (!output.jacobian.empty()) {
      const auto by_offset = output.jacobian.subspan(bare);
      std::fill(by_offset.begin(), by_offset.end(), 0.0);
      std::fill_n(by_offset.begin() + static_cast<std::ptrdiff_t>(channel_ * n), n, 1.0);
    }
    return {};
  }

 private:
  std::unique_ptr<Test> base_;
  TestDescription description_;
  std::size_t channel_ = 0;
};

MechanismFactory factory() {
  MechanismFactory mechanism{.id = "force_offset",
                             .cause = "The load cell was not zeroed: every force reading carries the same error.",
                             .stage = tunica::Stage::test,
                             .applies_to = {"uniaxial"},
                             .parameters = {value()},
                             .null = 0,
                             .side = MechanismFactory::Side::both,
                             .plausible_min = -10,
                             .plausible_max = 10,
                             .look_alikes = {"active_tone", "signal_drift", "reference_length_error"},
                             .isolated_by = "a reading of the load cell without specimen",
                             .reference = "",
                             .options = {}};
  mechanism.wrap_test = [](std::unique_ptr<Test> base, const Options&) -> std::unique_ptr<Test> {
    return std::make_unique<OffsetTest>(std::move(base));
  };
  return mechanism;
}

}  // namespace

TUNICA_PLUGIN("force_offset", TUNICA_PLUGIN_VERSION) { registry.add(factory()); }
