// SPDX-License-Identifier: Apache-2.0
// The permitted dependencies and outcomes of calls of a test.
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "conformance/concurrency.hpp"
#include "conformance/differences.hpp"
#include "conformance/handout.hpp"
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

struct Output {
  const char* name;
  Values Prediction::*values;
};
constexpr std::array kinds_of_output{Output{"values", &Prediction::values}, Output{"jacobian", &Prediction::jacobian},
                                     Output{"abscissa_derivative", &Prediction::abscissa_derivative},
                                     Output{"diagnostics", &Prediction::diagnostics}};

/// All that the test answers at these parameters of the model; of one that is costly or has no derivatives less.
Prediction everything(const Simulation& s, const Values& p) {
  const bool cheap = !s.test.describe().costly;
  TestInput input = s.input();
  input.model_parameters = p;
  Prediction found = predict(s.test, input, {true, cheap, cheap, true});
  if (!found.status.ok()) found = predict(s.test, input, {true, false, false, true});
  if (!found.status.ok()) throw std::runtime_error("the test answers '" + found.status.reason() + "'");
  return found;
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

Verdict writes_its_outputs_and_nothing_else(const Simulation& s, std::uint64_t) {
  const std::string compared = "the memory around and in each output, in every combination, with that before the call";
  const bool exact = s.model.describe().parameter_derivatives && !s.test.describe().differencing,
             costly = s.test.describe().costly;
  for (unsigned k = 0; k < (costly ? 1 : 16); ++k) {
    const auto has = [&](unsigned output) { return costly || (k >> output & 1U) != 0; };
    try {
      static_cast<void>(predict(s.test, s.input(), {has(0), has(1) && exact, has(2), has(3)}));
    } catch (const MemoryFault& fault) {
      return broken(compared, fault.what());
    }
  }
  return {.compared = compared};
}

Verdict predictions_are_numbers(const Simulation& s, std::uint64_t) {
  const std::string compared = "every value and diagnostic of a prediction with a number";
  const Prediction found = predict(s.test, s.input(), {.diagnostics = true});
  if (!found.status.ok()) return broken(compared, "the test answers '" + found.status.reason() + "'");
  for (std::size_t i = 0; i < found.values.size(); ++i)
    if (!std::isfinite(found.values[i]))
      return broken(compared, fmt::format("{} is {} under the status ok", place(s, i), found.values[i]));
  for (std::size_t i = 0; i < found.diagnostics.size(); ++i)
    if (!std::isfinite(found.diagnostics[i]))
      return broken(compared, fmt::format("the diagnostic '{}' of row {} is {} under the status ok",
                                          s.test.describe().diagnostics[i / s.test.rows().count],
                                          i % s.test.rows().count + 1, found.diagnostics[i]));
  return {.compared = compared};
}

Verdict values_do_not_depend_on_the_other_outputs(const Simulation& s, std::uint64_t) {
  Meter meter("values and diagnostics alone with those beside all other outputs", 1e-10);
  const bool exact = s.model.describe().parameter_derivatives && !s.test.describe().differencing;
  const Prediction all = predict(s.test, s.input(), {true, exact, false, true});
  if (!all.status.ok())
    return broken(meter.verdict().compared, "with a Jacobian the test answers '" + all.status.reason() + "'");
  const Values alone = values_at(s, s.model_parameters, s.test_parameters);
  for (std::size_t i = 0; i < alone.size(); ++i)
    meter.see(std::abs(all.values[i] - alone[i]) / channel_scale(s, alone, i), [&] {
      return fmt::format("{} is {:.15g} alone, {:.15g} with a Jacobian", place(s, i), alone[i], all.values[i]);
    });
  const Values shown = predict(s.test, s.input(), {false, false, false, true}).diagnostics;
  const std::size_t n = s.test.rows().count;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const std::span<const double> of_kind = std::span(shown).subspan(i / n * n, n);
    meter.see(
        same(shown[i], all.diagnostics[i]) ? 0 : std::abs(shown[i] - all.diagnostics[i]) / scale_of(of_kind, 1e-6),
        [&] {
          return fmt::format("the diagnostic '{}' of row {} is {:.15g} alone, {:.15g} with a Jacobian",
                             s.test.describe().diagnostics[i / n], i % n + 1, shown[i], all.diagnostics[i]);
        });
  }
  if (const Status status = s.test.predict(s.input(), {}); !status.ok())
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
    // A frequency changes nothing where the material has no memory: the test then says so by its derivative.
    const Prediction with = predict(s.test, s.input(), {.abscissa_derivative = true});
    const auto from = with.abscissa_derivative.begin() + static_cast<std::ptrdiff_t>(k * own.size());
    if (with.status.ok() &&
        std::all_of(from, from + static_cast<std::ptrdiff_t>(own.size()), [](double x) { return x == 0; }))
      continue;
    Values moved = bound;
    for (double& one : moved) one += 1e-3;
    if (values_at(s, s.model_parameters, s.test_parameters, moved, k) == own)
      return broken(meter.verdict().compared,
                    "values stay the same where other abscissae '" + abscissae[k].observable + "' are handed in");
  }
  return meter.verdict();
}

Verdict predictions_repeat_themselves(const Simulation& s, std::uint64_t) {
  Meter meter("every output with the same call's later, among others", 0);
  const std::vector<Values> inputs = variations(s);
  std::vector<Prediction> reference;
  for (const Values& p : inputs) reference.push_back(everything(s, p));
  for (const bool backwards : {true, false})
    for (std::size_t step = 0; step < inputs.size(); ++step) {
      const std::size_t k = backwards ? inputs.size() - 1 - step : step;
      const Prediction again = everything(s, inputs[k]);
      for (const Output& output : kinds_of_output) {
        const Values &was = reference[k].*output.values, &is = again.*output.values;
        const double scale = scale_of(was, 1e-6);
        for (std::size_t i = 0; i < is.size(); ++i)
          meter.see(same(is[i], was[i]) ? 0 : std::max(1e-17, std::abs(is[i] - was[i]) / scale), [&] {
            return fmt::format("number {} of '{}', {}, was {:.17g} and is {:.17g}", i + 1, output.name,
                               place(s, i % size_of(s)), was[i], is[i]);
          });
      }
    }
  return meter.verdict();
}

Verdict concurrent_predictions_agree(const Simulation& s, std::uint64_t) {
  Meter meter("every output of many threads with that of one", 0);
  const std::vector<Values> inputs = variations(s);
  std::vector<Prediction> reference;
  std::vector<Values> alone;
  for (const Values& p : inputs) {
    reference.push_back(everything(s, p));
    alone.push_back(values_at(s, p, s.test_parameters));
  }
  const std::size_t calls = inputs.size();
  // Values alone as well: the shorter a call, the larger the part of it in which scratch is in use.
  const Race race = race_threads(2 * calls, [&](std::size_t k) {
    if (k >= calls) return same(alone[k - calls], values_at(s, inputs[k - calls], s.test_parameters));
    const Prediction now = everything(s, inputs[k]);
    return std::all_of(kinds_of_output.begin(), kinds_of_output.end(),
                       [&](const Output& output) { return same(reference[k].*output.values, now.*output.values); });
  });
  if (race.lost)
    meter.see(1, [&] {
      const Values& p = inputs[race.input % calls];
      return fmt::format("after {} calls by {} threads a call answered otherwise than alone, {} = {:.6g}", race.calls,
                         race.threads, parameter_name(s, 0), p.empty() ? 0 : p[0]);
    });
  meter.note(fmt::format("{} calls by {} threads", race.calls, race.threads));
  return meter.verdict();
}

Verdict failures_are_statuses(const Simulation& s, std::uint64_t) {
  const std::string compared = "the answer where the material cannot be evaluated with a failed status";
  for (const bool says_so : {false, true}) {
    const Unusable model(s.model, says_so);
    const std::vector<const Model*> layers(s.layers.size(), &model);
    const Status status = predict(s.test, {model, s.model_parameters, s.test_parameters, {}, layers}).status;
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
  const Status status = predict(s.test, s.input()).status;
  if (status.kind() != Status::Kind::failed)
    return broken(compared, fmt::format("the status is '{}'", name(status.kind())));
  if (std::none_of(status.reason().begin(), status.reason().end(), [](unsigned char c) { return std::isdigit(c); }))
    return broken(compared, "the reason names no row: " + status.reason());
  return {.compared = compared};
}

const std::vector<TestProperty>& test_properties() {
  static const std::vector<TestProperty> properties{
      {"writes_its_outputs_and_nothing_else", writes_its_outputs_and_nothing_else},
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
