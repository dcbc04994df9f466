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
#include "tunica/tests/decorated_test.hpp"

namespace {

using namespace tunica;

class GripComplianceTest final : public DecoratedTest {
 public:
  GripComplianceTest(std::unique_ptr<Test> base, const Parameter& compliance, std::size_t abscissa, std::size_t channel)
      : DecoratedTest(std::move(base), compliance, 0), abscissa_(abscissa), channel_(channel) {}

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const double kappa = amplitude(input);
    const std::size_t n = rows().count, size = prediction_count();
    TestInput bare = DecoratedTest::bare(input);
    const std::span<double> by_base = base_jacobian(output), by_kappa = own_jacobian(output);
    std::vector<std::span<const double>> columns = abscissae(input, rows());
    const std::span<const double> measured = columns[abscissa_];
    std::vector<double> stretch(measured.begin(), measured.end()), y(size), slope(columns.size() * size);
    const std::size_t at = channel_ * n, by = abscissa_ * size + channel_ * n;
    if (kappa != 0) {
      // Newton's method for λ + κ y(λ) = m, row by row: the stress of a row depends on its own stretch.
      columns[abscissa_] = stretch;
      bare.abscissae = columns;
      double change = 1;
      for (int iteration = 0; change > 1e-13; ++iteration) {
        if (iteration == 50)
          return Status::failed("grip_compliance: no stretch balances the grips; lower the compliance");
        if (Status status = base().predict(bare, {y, {}, slope, {}}); !status.ok()) return status;
        change = 0;
        for (std::size_t i = 0; i < n; ++i) {
          const double step = (measured[i] - stretch[i] - kappa * y[at + i]) / (1 + kappa * slope[by + i]);
          stretch[i] += step;
          change = std::max(change, std::abs(step));
        }
        if (!std::isfinite(change)) return Status::failed("grip_compliance: the grips give way without end");
      }
    }
    const bool derivatives = !output.jacobian.empty() || (kappa != 0 && !output.abscissa_derivative.empty());
    if (Status status =
            base().predict(bare, {output.values, by_base, kappa == 0 ? output.abscissa_derivative : std::span<double>(),
                                  output.diagnostics});
        !status.ok())
      return status;
    if (!derivatives) return {};
    if (Status status = base().predict(bare, {y, {}, slope, {}}); !status.ok()) return status;
    // dλ/dκ = −y/(1 + κ y'), dλ/dp = −κ ∂y/∂p/(1 + κ y'), dλ/dm = 1/(1 + κ y'), y the stress that pulls at the grips
    for (std::size_t i = 0; i < n; ++i) {
      const double give = 1 / (1 + kappa * slope[by + i]);
      for (std::size_t first = 0; first < by_base.size(); first += size) {
        const double moved = -kappa * by_base[first + at + i] * give;
        for (std::size_t row = i; kappa != 0 && row < size; row += n)
          by_base[first + row] += slope[abscissa_ * size + row] * moved;
      }
      for (std::size_t row = i; row < size; row += n) {
        const double by_stretch = slope[abscissa_ * size + row];
        if (!by_kappa.empty()) by_kappa[row] = -by_stretch * y[at + i] * give;
        if (kappa != 0 && !output.abscissa_derivative.empty())
          output.abscissa_derivative[abscissa_ * size + row] = by_stretch * give;
      }
    }
    return {};
  }

 private:
  std::size_t abscissa_, channel_;
};

std::size_t mapped(std::optional<std::size_t> index, const std::string& name) {
  if (index) return *index;
  throw InputError("grip_compliance: the test's data have no '" + name +
                   "', which the grips act on; map a column to it");
}

}  // namespace

TUNICA_PLUGIN("grip_compliance", "1.0.0") {
  const Parameter compliance{"compliance", "1/kPa", 0, 0, 0.05, Scale::linear, "Stretch lost by unit of stress.", ""};
  registry.add(MechanismFactory{
      .id = "grip_compliance",
      .cause = "The grips and the load cell gave way, and the strip was stretched less than the crosshead moved.",
      .stage = Stage::test,
      .applies_to = {"uniaxial"},
      .parameters = {compliance},
      .side = MechanismFactory::Side::positive,
      .plausible_max = 0.01,
      .look_alikes = {"reference_length_error", "force_scale_error", "matrix_stiffening"},
      .isolated_by = "a steel strip in the same grips, or stretch from marks on the specimen",
      .reference = "ISO 37:2017, which asks for marks on the specimen",
      .shared = true,
      .wrap_test = [compliance](std::unique_ptr<Test> base, const Options&) {
        const std::size_t stretch = mapped(abscissa_index(base->rows(), "stretch"), "stretch");
        const std::size_t stress = mapped(channel_index(base->rows(), "stress"), "stress");
        return std::make_unique<GripComplianceTest>(std::move(base), compliance, stretch, stress);
      }});
}
