// SPDX-License-Identifier: Apache-2.0
// Stretch read off the grips of a testing machine that gives way: part of what the crosshead moved was taken up by the
// load cell and the fixtures, in proportion to the force, and the strip was stretched less,
//
//   λ = m − κ y(λ),
//
// m the measured stretch, κ ≥ 0 the compliance by unit of stress, y the stress of the strip in the data's measure
// (the first Piola–Kirchhoff stress is the force over the unloaded section; with another measure κ is a secant).
#include <cmath>

#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

class GripComplianceTest final : public Test {
 public:
  GripComplianceTest(std::unique_ptr<Test> base, const Parameter& compliance, std::size_t abscissa, std::size_t channel)
      : base_(std::move(base)), description_(base_->describe()), abscissa_(abscissa), channel_(channel) {
    description_.parameters.push_back(compliance), description_.nulls.push_back(0);
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const double kappa = input.test_parameters.back();
    const std::size_t n = rows().count, size = rows().channels.size() * n;
    TestInput bare = input;
    bare.test_parameters = input.test_parameters.first(input.test_parameters.size() - 1);
    const std::size_t own = output.jacobian.empty() ? 0 : output.jacobian.size() - size;
    std::vector<std::span<const double>> columns(input.abscissae.begin(), input.abscissae.end());
    if (columns.empty())
      for (const TestRows::Column& column : rows().abscissae) columns.push_back(column.values);
    const std::span<const double> measured = columns[abscissa_];
    std::vector<double> stretch(measured.begin(), measured.end()), y(size), slope(rows().abscissae.size() * size);
    const std::size_t at = channel_ * n, by = abscissa_ * size + channel_ * n;
    if (kappa != 0) {
      // Newton's method for λ + κ y(λ) = m, row by row: the stress of a row depends on its own stretch.
      columns[abscissa_] = stretch, bare.abscissae = columns;
      double change = 1;
      for (int iteration = 0; change > 1e-13; ++iteration) {
        if (iteration == 50)
          return Status::failed("grip_compliance: no stretch balances the grips; lower the compliance");
        if (Status status = base_->predict(bare, {y, {}, slope, {}}); !status.ok()) return status;
        change = 0;
        for (std::size_t i = 0; i < n; ++i) {
          const double step = (measured[i] - stretch[i] - kappa * y[at + i]) / (1 + kappa * slope[by + i]);
          stretch[i] += step, change = std::max(change, std::abs(step));
        }
        if (!std::isfinite(change)) return Status::failed("grip_compliance: the grips give way without end");
      }
    }
    const bool derivatives = !output.jacobian.empty() || (kappa != 0 && !output.abscissa_derivative.empty());
    if (Status status =
            base_->predict(bare, {output.values, output.jacobian.first(own),
                                  kappa == 0 ? output.abscissa_derivative : std::span<double>(), output.diagnostics});
        !status.ok())
      return status;
    if (!derivatives) return {};
    if (Status status = base_->predict(bare, {y, {}, slope, {}}); !status.ok()) return status;
    // dλ/dκ = −y/(1 + κ y'), dλ/dp = −κ ∂y/∂p/(1 + κ y'), dλ/dm = 1/(1 + κ y'), y the stress that pulls at the grips
    for (std::size_t i = 0; i < n; ++i) {
      const double give = 1 / (1 + kappa * slope[by + i]);
      for (std::size_t first = 0; !output.jacobian.empty() && first < own; first += size) {
        const double moved = -kappa * output.jacobian[first + at + i] * give;
        for (std::size_t row = i; kappa != 0 && row < size; row += n)
          output.jacobian[first + row] += slope[abscissa_ * size + row] * moved;
      }
      for (std::size_t row = i; row < size; row += n) {
        const double by_stretch = slope[abscissa_ * size + row];
        if (!output.jacobian.empty()) output.jacobian[own + row] = -by_stretch * y[at + i] * give;
        if (kappa != 0 && !output.abscissa_derivative.empty())
          output.abscissa_derivative[abscissa_ * size + row] = by_stretch * give;
      }
    }
    return {};
  }

 private:
  std::unique_ptr<Test> base_;
  TestDescription description_;
  std::size_t abscissa_, channel_;
};

std::size_t place(const auto& names, const std::string& name) {
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == name) return k;
  throw InputError("grip_compliance: the test's data have no '" + name +
                   "', which the grips act on; map a column to it");
}

}  // namespace

TUNICA_PLUGIN("grip_compliance", "1.0.0") {
  MechanismFactory mechanism{};
  mechanism.id = "grip_compliance";
  mechanism.cause = "The grips and the load cell gave way, and the strip was stretched less than the crosshead moved.";
  mechanism.stage = tunica::Stage::test;
  mechanism.applies_to = {"uniaxial"};
  mechanism.parameters = {{"compliance", "1/kPa", 0, 0, 0.05, Scale::linear, "Stretch lost by unit of stress.", ""}};
  mechanism.null = 0, mechanism.side = MechanismFactory::Side::positive;
  mechanism.plausible_min = 0, mechanism.plausible_max = 0.01;
  mechanism.look_alikes = {"reference_length_error", "force_scale_error", "matrix_stiffening"};
  mechanism.isolated_by = "a steel strip in the same grips, or stretch from marks on the specimen";
  mechanism.reference = "ISO 37:2017, which asks for marks on the specimen";
  mechanism.shared = true;
  mechanism.wrap_test = [own = mechanism.parameters.front()](std::unique_ptr<Test> base, const Options&) {
    std::vector<std::string> abscissae;
    for (const TestRows::Column& column : base->rows().abscissae) abscissae.push_back(column.observable);
    const std::size_t abscissa = place(abscissae, "stretch"), channel = place(base->rows().channels, "stress");
    return std::make_unique<GripComplianceTest>(std::move(base), own, abscissa, channel);
  };
  registry.add(std::move(mechanism));
}
