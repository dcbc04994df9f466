// SPDX-License-Identifier: Apache-2.0
// A strip under a prescribed stress, or force over its unloaded section: creep and recovery. The stretch λ1 follows
// from
//
//   σ(λ1, λ2; past) λ1^−k = given,   0 = r(λ1, λ2; past),
//
// k = 0, 1, 2 for Cauchy, first and second Piola-Kirchhoff stress: two equations a row (Findley, Lai, Onaran, Creep and
// Relaxation of Nonlinear Viscoelastic Materials, 1976, chapter 1). Between rows the stretch goes in a straight line;
// the option "steps" puts points between, at which the load is interpolated in time.
#include <algorithm>
#include <cmath>
#include <memory>

#include "controlled_strip.hpp"

namespace tunica::controlled_strip {
namespace {

class Creep final : public Test {
 public:
  explicit Creep(const TestSetup& setup)
      : strip_(strip_of(setup, "creep")),
        temperature_(temperature_of(setup, "creep")),
        description_(description_of_strip(strip_, temperature_)),
        parts_(setup.options.count("steps")) {
    for (const auto& column : setup.rows.abscissae)
      if (column.observable == "stress") stress_.assign(column.values.begin(), column.values.end());
    if (stress_.empty()) throw InputError("creep: no rows, or no column mapped to 'stress'; map one in \"columns\"");
    for (std::size_t i = 0; i < stress_.size(); ++i)
      if (!std::isfinite(stress_[i]))
        throw InputError("creep: row " + std::to_string(i + 1) + " has a stress that is not finite; correct the cell");
    time_.assign(setup.rows.time.begin(), setup.rows.time.end());
    check_steps("creep", static_cast<double>(stress_.size()) * static_cast<double>(parts_));
    rows_.count = stress_.size();
    rows_.abscissae = {{"stress", stress_}};
    rows_.channels = setup.rows.channels;
    rows_.time = time_;
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const std::span<const double> stress =
        input.abscissae.empty() ? std::span<const double>(stress_) : input.abscissae[0];
    // Points between rows would make a row depend on the load of the row before.
    const bool between = strip_.timed && output.abscissa_derivative.empty();
    std::vector<LoadStep> steps;
    for (std::size_t i = 0; i < stress.size(); ++i) {
      const std::size_t parts = between && i > 0 && time_[i] > time_[i - 1] ? parts_ : 1;
      for (std::size_t k = 1; k < parts; ++k) {
        const double part = static_cast<double>(k) / static_cast<double>(parts);
        steps.push_back({time_[i - 1] + part * (time_[i] - time_[i - 1]), strip_.measure,
                         stress[i - 1] + part * (stress[i] - stress[i - 1])});
      }
      steps.push_back({strip_.timed ? time_[i] : 0, strip_.measure, stress[i], 0, false, i});
    }
    return follow_shifted(strip_, temperature_, steps, input, output);
  }

 private:
  Strip strip_;
  Temperature temperature_;
  TestDescription description_;
  std::size_t parts_;
  std::vector<double> stress_, time_;
  TestRows rows_;
};

}  // namespace

TestFactory creep_factory() {
  using Role = Observable::Role;
  using Kind = Observable::Kind;
  std::vector<Observable> observables{
      {"stress", "kPa", Role::abscissa, true, "Prescribed stress along the strip.", Kind::stress},
      {"time", "s", Role::time, false, "Time since the unloaded state.", Kind::plain},
      {"stretch", "1", Role::channel, false, "Measured stretch along the strip.", Kind::stretch}};
  for (Observable& lateral : lateral_channels()) observables.push_back(std::move(lateral));
  std::vector<Option> options{
      direction_option(), Option::integer("steps", 1, {1, 1000}, "Steps of the simulation from one row to the next.")};
  add_common_options(options);
  TestFactory made{"creep",
                   "A strip under a prescribed stress or force, lateral faces free: creep, recovery, cycles of load.",
                   "Findley, Lai, Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials (1976)",
                   std::move(options),
                   std::move(observables),
                   [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<Creep>(setup); },
                   all_parameters()};
  made.specimen = Specimen::strip;
  return made;
}

}  // namespace tunica::controlled_strip
