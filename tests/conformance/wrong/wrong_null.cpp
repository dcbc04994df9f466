// SPDX-License-Identifier: Apache-2.0
// A wrong gain of the stress, by way of other units: at the null the last digit may be another one.
#include <algorithm>

#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

class Misread final : public Test {
 public:
  Misread(std::unique_ptr<Test> base, Parameter gain) : base_(std::move(base)), description_(base_->describe()) {
    description_.parameters.push_back(std::move(gain));
    description_.nulls.push_back(0);
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    const std::size_t own = input.test_parameters.size() - 1, size = rows().count * rows().channels.size();
    const double gain = input.test_parameters[own];
    TestInput bare = input;
    bare.test_parameters = input.test_parameters.first(own);
    TestOutput out = output;
    std::vector<double> values(size);
    out.values = values;
    if (!output.jacobian.empty()) out.jacobian = output.jacobian.first(output.jacobian.size() - size);
    if (Status status = base_->predict(bare, out); !status.ok()) return status;
    constexpr double mmHg = 0.133322387415;
    const auto scaled = [&](double value) { return value / mmHg * (1 + gain) * mmHg; };
    for (std::size_t i = 0; i < output.values.size(); ++i) output.values[i] = scaled(values[i]);
    for (double& entry : out.jacobian) entry = scaled(entry);
    for (double& entry : output.abscissa_derivative) entry = scaled(entry);
    if (!output.jacobian.empty())
      std::copy(values.begin(), values.end(), output.jacobian.end() - static_cast<std::ptrdiff_t>(size));
    return {};
  }

 private:
  std::unique_ptr<Test> base_;
  TestDescription description_;
};

}  // namespace

TUNICA_PLUGIN("wrong_null", "0.1.0") {
  MechanismFactory mechanism{};
  mechanism.id = "wrong_gain";
  mechanism.cause = "The gain of the load cell is wrong.";
  mechanism.stage = Stage::test;
  mechanism.applies_to = {"uniaxial"};
  mechanism.parameters = {{"gain", "1", 0, -0.5, 0.5, Scale::linear, "Measured over true stress, less one.", ""}};
  mechanism.null = 0;
  mechanism.side = MechanismFactory::Side::both;
  mechanism.plausible_min = -0.2;
  mechanism.plausible_max = 0.2;
  mechanism.isolated_by = "a known weight";
  mechanism.wrap_test = [own = mechanism.parameters.front()](std::unique_ptr<Test> base, const Options&) {
    return std::make_unique<Misread>(std::move(base), own);
  };
  registry.add(std::move(mechanism));
}
