// SPDX-License-Identifier: Apache-2.0
// What calls of a test may depend on, and how they may end.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "conformance/concurrency.hpp"
#include "conformance/differences.hpp"
#include "conformance/model_batch.hpp"
#include "conformance/predictions.hpp"

namespace tunica::conformance {
namespace {

/// Parameters of several calls: those of the simulation, each with the model's first a little larger.
std::vector<Values> variations(const Simulation& s) {
  std::vector<Values> all;
  for (int k = 0; k < (s.test.describe().costly ? 2 : 8); ++k) {
    all.push_back(s.model_parameters);
    if (!all.back().empty()) all.back()[0] *= 1 + 0.01 * k;
  }
  return all;
}

/// A material that cannot be evaluated: its numbers are none, or it says so.
class Unusable final : public Model {
 public:
  Unusable(const Model& like, bool says_so) : description_(like.describe()), says_so_(says_so) {}
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints&, const MaterialResponse& out) const override {
    return answer({out.energy, out.stress, out.tangent, out.stress_dp, out.state});
  }
  Status evaluate_axes(const AxisPoints&, const AxisResponse& out) const override {
    return answer({out.energy, out.gradient, out.hessian, out.gradient_dp, {}});
  }

 private:
  [[nodiscard]] Status answer(std::array<std::span<double>, 5> outputs) const {
    if (says_so_) return Status::failed("this material cannot be evaluated");
    for (const auto& output : outputs) std::fill(output.begin(), output.end(), std::numeric_limits<double>::infinity());
    return {};
  }
  ModelDescription description_;
  bool says_so_;
};

}  // namespace

Verdict predictions_are_numbers(const Simulation& s, std::uint64_t) {
  const std::string compared = "every value and diagnostic of a prediction with a number";
  const std::size_t rows = size_of(s), diagnostics = s.test.describe().diagnostics.size() * s.test.rows().count;
  constexpr double post = -7.0e77, unset = std::numeric_limits<double>::quiet_NaN();
  Values values(rows + 2, unset), shown(diagnostics + 2, unset);
  values.front() = values.back() = shown.front() = shown.back() = post;
  const Status status =
      s.test.predict(s.input(), {std::span(values).subspan(1, rows), {}, {}, std::span(shown).subspan(1, diagnostics)});
  if (!status.ok()) return broken(compared, "the test answers '" + status.reason() + "'");
  if (values.front() != post || values.back() != post || shown.front() != post || shown.back() != post)
    return broken(compared, "the test writes beyond the memory of an output");
  for (std::size_t i = 0; i < rows; ++i)
    if (!std::isfinite(values[i + 1]))
      return broken(compared, fmt::format("{} is {} under the status ok", place(s, i), values[i + 1]));
  for (std::size_t i = 0; i < diagnostics; ++i)
    if (!std::isfinite(shown[i + 1]))
      return broken(compared, fmt::format("the diagnostic '{}' of row {} is {} under the status ok",
                                          s.test.describe().diagnostics[i / s.test.rows().count],
                                          i % s.test.rows().count + 1, shown[i + 1]));
  return {.compared = compared};
}

Verdict values_do_not_depend_on_the_other_outputs(const Simulation& s, std::uint64_t) {
  Meter meter("values alone with values beside Jacobian and diagnostics", 1e-10);
  const std::size_t rows = size_of(s), all = s.model_parameters.size() + s.test_parameters.size();
  const Values alone = values_at(s, s.model_parameters, s.test_parameters);
  const bool exact = s.model.describe().parameter_derivatives;
  Values values(rows), jacobian(exact ? all * rows : 0),
      diagnostics(s.test.describe().diagnostics.size() * s.test.rows().count);
  const TestInput input = s.input();
  if (const Status status = s.test.predict(input, {values, jacobian, {}, diagnostics}); !status.ok())
    return broken(meter.verdict().compared, "with a Jacobian the test answers '" + status.reason() + "'");
  for (std::size_t i = 0; i < rows; ++i)
    meter.see(std::abs(values[i] - alone[i]) / channel_scale(s, alone, i), [&] {
      return fmt::format("{} is {:.15g} alone, {:.15g} with a Jacobian", place(s, i), alone[i], values[i]);
    });
  if (const Status status = s.test.predict(input, {}); !status.ok())
    return broken(meter.verdict().compared, "asked for nothing the test answers '" + status.reason() + "'");
  return meter.verdict();
}

Verdict given_abscissae_replace_the_bound_ones(const Simulation& s, std::uint64_t) {
  Meter meter("values with values at the same abscissae, handed in", 1e-9);
  const Values own = values_at(s, s.model_parameters, s.test_parameters);
  const auto& abscissae = s.test.rows().abscissae;
  for (std::size_t k = 0; k < abscissae.size(); ++k) {
    const Values bound(abscissae[k].values.begin(), abscissae[k].values.end());
    const Values given = values_at(s, s.model_parameters, s.test_parameters, bound, k);
    for (std::size_t i = 0; i < own.size(); ++i)
      meter.see(std::abs(own[i] - given[i]) / channel_scale(s, own, i),
                [&] { return fmt::format("{} is {:.15g} as bound, {:.15g} as given", place(s, i), own[i], given[i]); });
    Values moved = bound;
    for (double& one : moved) one += 1e-3;
    if (values_at(s, s.model_parameters, s.test_parameters, moved, k) == own)
      return broken(meter.verdict().compared,
                    "values stay the same where other abscissae '" + abscissae[k].observable + "' are handed in");
  }
  return meter.verdict();
}

Verdict predictions_repeat_themselves(const Simulation& s, std::uint64_t) {
  Meter meter("predictions with the same call's later, among others", 0);
  const std::vector<Values> inputs = variations(s);
  std::vector<Values> reference;
  for (const Values& p : inputs) reference.push_back(values_at(s, p, s.test_parameters));
  for (const bool backwards : {true, false})
    for (std::size_t step = 0; step < inputs.size(); ++step) {
      const std::size_t k = backwards ? inputs.size() - 1 - step : step;
      const Values again = values_at(s, inputs[k], s.test_parameters);
      for (std::size_t i = 0; i < again.size(); ++i)
        meter.see(same(again[i], reference[k][i])
                      ? 0
                      : std::max(1e-17, std::abs(again[i] - reference[k][i]) / channel_scale(s, reference[k], i)),
                  [&] { return fmt::format("{} was {:.17g} and is {:.17g}", place(s, i), reference[k][i], again[i]); });
    }
  return meter.verdict();
}

Verdict concurrent_predictions_agree(const Simulation& s, std::uint64_t) {
  Meter meter("predictions of many threads with those of one", 0);
  const std::vector<Values> inputs = variations(s);
  std::vector<Values> reference;
  for (const Values& p : inputs) reference.push_back(values_at(s, p, s.test_parameters));
  const Race race = race_threads(
      inputs.size(), [&](std::size_t k) { return same(reference[k], values_at(s, inputs[k], s.test_parameters)); });
  if (race.lost)
    meter.see(1, [&] {
      return fmt::format("after {} calls by {} threads a call answered otherwise than alone, {} = {:.6g}", race.calls,
                         race.threads, parameter_name(s, 0), inputs[race.input].empty() ? 0 : inputs[race.input][0]);
    });
  meter.note(fmt::format("{} calls by {} threads", race.calls, race.threads));
  return meter.verdict();
}

Verdict failures_are_statuses(const Simulation& s, std::uint64_t) {
  const std::string compared = "the answer where the material cannot be evaluated with a failed status";
  for (const bool says_so : {false, true}) {
    const Unusable model(s.model, says_so);
    const std::vector<const Model*> layers(s.layers.size(), &model);
    Values values(size_of(s));
    const Status status =
        s.test.predict({model, s.model_parameters, s.test_parameters, {}, layers}, {values, {}, {}, {}});
    if (status.kind() != Status::Kind::failed)
      return broken(compared,
                    fmt::format("with {} the status is '{}'",
                                says_so ? "a model that fails" : "stresses that are infinite", name(status.kind())));
    if (status.reason().empty()) return broken(compared, "the failure has no reason");
  }
  return {.compared = compared};
}

Verdict overflow_is_a_status(const Simulation& s) {
  const std::string compared = "the answer where the energy overflows with a failed status that names the row";
  Values values(size_of(s));
  const Status status = s.test.predict(s.input(), {values, {}, {}, {}});
  if (status.kind() != Status::Kind::failed)
    return broken(compared, fmt::format("the status is '{}'", name(status.kind())));
  if (std::none_of(status.reason().begin(), status.reason().end(), [](unsigned char c) { return std::isdigit(c); }))
    return broken(compared, "the reason names no row: " + status.reason());
  return {.compared = compared};
}

const std::vector<TestProperty>& test_properties() {
  static const std::vector<TestProperty> properties{
      {"predictions_are_numbers", predictions_are_numbers},
      {"jacobian_matches_differences", jacobian_matches_differences},
      {"abscissa_derivative_matches_differences", abscissa_derivative_matches_differences},
      {"values_do_not_depend_on_the_other_outputs", values_do_not_depend_on_the_other_outputs},
      {"given_abscissae_replace_the_bound_ones", given_abscissae_replace_the_bound_ones},
      {"predictions_repeat_themselves", predictions_repeat_themselves},
      {"concurrent_predictions_agree", concurrent_predictions_agree},
      {"failures_are_statuses", failures_are_statuses}};
  return properties;
}

}  // namespace tunica::conformance
