// SPDX-License-Identifier: Apache-2.0
// A mechanism as a lab would write one for its own machine, with the public headers alone: the spindle that moves the
// grips runs out of true, and the stress of a strip shows
//
//   measured = true + a sin(2π λ/0.1).
#include <cmath>
#include <numbers>

#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

constexpr double period = 0.1;  // of the stretch

class Rippled final : public Test {
 public:
  Rippled(std::unique_ptr<Test> base, const Parameter& amplitude)
      : base_(std::move(base)), description_(base_->describe()) {
    description_.parameters.push_back(amplitude);
    description_.nulls.push_back(0);
    const TestRows& bare = base_->rows();
    shape_.assign(bare.count * bare.channels.size(), 0.0);
    for (std::size_t k = 0; k < bare.channels.size(); ++k)
      for (std::size_t i = 0; i < bare.count && bare.channels[k] == "stress"; ++i)
        shape_[k * bare.count + i] = std::sin(2 * std::numbers::pi * bare.abscissae.front().values[i] / period);
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const double a = input.test_parameters.back();
    const std::size_t size = shape_.size(), bare = output.jacobian.empty() ? 0 : output.jacobian.size() - size;
    TestInput inner = input;
    inner.test_parameters = input.test_parameters.first(input.test_parameters.size() - 1);
    Status status = base_->predict(
        inner, {output.values, output.jacobian.first(bare), output.abscissa_derivative, output.diagnostics});
    if (!status.ok()) return status;
    for (std::size_t i = 0; i < size && !output.jacobian.empty(); ++i) output.jacobian[bare + i] = shape_[i];
    for (std::size_t i = 0; i < size && a != 0 && !output.values.empty(); ++i) output.values[i] += a * shape_[i];
    return {};
  }

 private:
  std::unique_ptr<Test> base_;
  TestDescription description_;
  std::vector<double> shape_;
};

}  // namespace

TUNICA_PLUGIN("our_machine", "0.3") {
  MechanismFactory mechanism{};
  mechanism.id = "grip_ripple";
  mechanism.cause = "The spindle of the grips runs out of true: the stress ripples once a turn.";
  mechanism.stage = tunica::Stage::test;
  mechanism.applies_to = {"uniaxial"};
  mechanism.parameters = {{"height", "kPa", 0, -20, 20, Scale::linear, "Height of the ripple.", ""}};
  mechanism.side = MechanismFactory::Side::both;
  mechanism.plausible_min = -5;
  mechanism.plausible_max = 5;
  mechanism.look_alikes = {"signal_drift"};
  mechanism.isolated_by = "a run with a spring in the grips";
  mechanism.reference = "our machine's manual";
  mechanism.shared = true;
  mechanism.wrap_test = [own = mechanism.parameters.front()](std::unique_ptr<Test> base, const Options&) {
    return std::make_unique<Rippled>(std::move(base), own);
  };
  registry.add(std::move(mechanism));
}
