// SPDX-License-Identifier: Apache-2.0
// Mechanisms that act on models.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "conformance/differences.hpp"
#include "conformance/mechanism_properties.hpp"
#include "conformance/model_batch.hpp"
#include "conformance/model_properties.hpp"

namespace tunica::conformance {
namespace {

constexpr std::size_t state_count = 40;
constexpr OutputSelection no_derivatives{true, true, true, false, false};

/// States at which the bare model is finite; no history yet.
Batch states(const WrappedModel& on, std::uint64_t seed) {
  Sampler sampler(seed);
  Batch batch;
  batch.count = state_count;
  batch.p = on.base;
  batch.C.resize(6 * state_count);
  for (std::size_t i = 0; i < state_count; ++i) {
    const Tensor C = sampler.right_cauchy_green();
    for (std::size_t c = 0; c < 6; ++c) batch.C[c * state_count + i] = C[c];
  }
  return batch;
}

std::vector<double> ask(const Model& model, Batch batch, std::vector<double> p, const OutputSelection& wanted) {
  batch.p = std::move(p);
  return answers(model, batch, wanted);
}

/// The last stress of a path from rest to each state and half way back, 1 s a step.
std::vector<double> path(const Model& model, const Batch& there, const std::vector<double>& p) {
  Batch step = there;
  step.p = p;
  step.time_step.assign(state_count, 1.0);
  if (model.describe().history_size > 0) step.state = answers(model, step, {false, false, false, false, true});
  for (std::size_t k = 0; k < step.C.size(); ++k) step.C[k] = 0.5 * (there.C[k] + (k < 3 * state_count ? 1 : 0));
  return answers(model, step, {false, true, false, false, false});
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), sizeof(double) * a.size()) == 0);
}

/// Relative to the largest of the other.
void see(Meter& meter, const std::vector<double>& one, const std::vector<double>& other, const std::string& what) {
  const double scale = scale_of(other);
  for (std::size_t i = 0; i < other.size(); ++i)
    if (!same(one[i], other[i]))
      meter.see(std::max(1e-17, std::abs(one[i] - other[i]) / scale),
                [&] { return fmt::format("{}: {:.17g} with the mechanism, {:.17g} without", what, one[i], other[i]); });
}

/// Whether the mechanism makes an incompressible model compressible. At its null the model then answers by
/// incompressible(), and S, which carries a pressure beside it, is not comparable.
bool releases_volume(const WrappedModel& on) {
  return on.with->describe().compressible && !on.bare->describe().compressible;
}
constexpr const char* pressure_differs =
    "the mechanism makes the model compressible: beside the null S carries a pressure that the bare model leaves open";

}  // namespace

std::vector<double> WrappedModel::at(double amplitude) const {
  std::vector<double> all = base;
  all.push_back(amplitude);
  for (std::size_t k = 1; k < mechanism.parameters.size(); ++k) all.push_back(mechanism.parameters[k].initial);
  return all;
}

Verdict parameters_stand_behind_those_of_the_base(const WrappedModel& on, std::uint64_t) {
  const std::string compared = "the parameters of the wrapped model with those of the base and the declared ones";
  const auto &base = on.bare->describe().parameters, &own = on.mechanism.parameters,
             &all = on.with->describe().parameters;
  if (all.size() != base.size() + own.size())
    return broken(compared, fmt::format("{} parameters, where the base has {} and the mechanism {}", all.size(),
                                        base.size(), own.size()));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Parameter& expected = k < base.size() ? base[k] : own[k - base.size()];
    if (all[k].name != expected.name || all[k].unit != expected.unit)
      return broken(compared, fmt::format("parameter {} is '{}' in {}, expected '{}' in {}", k + 1, all[k].name,
                                          all[k].unit, expected.name, expected.unit));
  }
  return {.compared = compared};
}

Verdict null_is_the_bare_model(const WrappedModel& on, std::uint64_t seed) {
  Meter meter("W, S, tangent and a path at the null with those of the bare model, bit for bit", 0);
  const Batch batch = states(on, seed);
  const std::vector<double> null = on.at(on.mechanism.null);
  const auto compare = [&](const std::vector<double>& one, const std::vector<double>& other, const char* what) {
    if (same_bits(one, other)) return;
    see(meter, one, other, what);
    meter.see(1e-17, [&] { return fmt::format("{}: zeros of different signs", what); });
  };
  if (releases_volume(on)) {
    if (!on.with->keeps_volume(null)) return broken(meter.verdict().compared, "keeps_volume() is false at the null");
    compare(ask(on.with->incompressible(), batch, on.base, no_derivatives),
            ask(*on.bare, batch, on.base, no_derivatives), "an answer of incompressible()");
    return meter.verdict();
  }
  compare(ask(*on.with, batch, null, no_derivatives), ask(*on.bare, batch, on.base, no_derivatives),
          "an answer at the null");
  compare(path(*on.with, batch, null), path(*on.bare, batch, on.base), "the stress of a path at the null");
  return meter.verdict();
}

Verdict limit_is_the_bare_model(const WrappedModel& on, std::uint64_t seed) {
  Meter meter("W, S and tangent next to the null with those at it", 1e-12);
  if (releases_volume(on)) return not_checked(meter.verdict().compared, pressure_differs);
  const Batch batch = states(on, seed);
  const double near = next_to_the_null(on.mechanism);
  for (const std::size_t kind : {0u, 1u, 2u}) {
    const OutputSelection wanted{kind == 0, kind == 1, kind == 2, false, false};
    const std::vector<double> bare = ask(*on.bare, batch, on.base, wanted),
                              far = ask(*on.with, batch, on.at(on.mechanism.plausible_max), wanted);
    // A strong effect is seen that close to the null too: ten times its share of the plausible one is granted.
    double effect = 0;
    for (std::size_t i = 0; i < bare.size(); ++i)
      if (std::isfinite(far[i])) effect = std::max(effect, std::abs(far[i] - bare[i]) / scale_of(bare));
    const double share = (near - on.mechanism.null) / (on.mechanism.plausible_max - on.mechanism.null);
    meter.allow(std::max(meter.tolerance(), 10 * share * effect));
    see(meter, ask(*on.with, batch, on.at(near), wanted), bare, fmt::format("next to the null, at {:.3g}", near));
  }
  return meter.verdict();
}

Verdict base_derivatives_at_the_null_are_those_of_the_base(const WrappedModel& on, std::uint64_t seed) {
  Meter meter("dS/dp by parameters of the base at the null with those of the bare model", 1e-12);
  if (releases_volume(on)) return not_checked(meter.verdict().compared, pressure_differs);
  if (!on.with->describe().parameter_derivatives || !on.bare->describe().parameter_derivatives)
    return not_checked(meter.verdict().compared,
                       "it declares no parameter derivatives; tunica differences predictions");
  const Batch batch = states(on, seed);
  constexpr OutputSelection wanted{false, false, false, true, false};
  std::vector<double> with = ask(*on.with, batch, on.at(on.mechanism.null), wanted);
  const std::vector<double> bare = ask(*on.bare, batch, on.base, wanted);
  with.resize(bare.size());
  see(meter, with, bare, "at the null");
  return meter.verdict();
}

Verdict derivative_at_the_null_matches_differences(const WrappedModel& on, std::uint64_t seed) {
  Meter meter("dS/d(amplitude) at the null with one-sided differences of S", 1e-6);
  if (releases_volume(on)) return not_checked(meter.verdict().compared, pressure_differs);
  if (!on.with->describe().parameter_derivatives)
    return not_checked(meter.verdict().compared,
                       "it declares no parameter derivatives; tunica differences predictions");
  const Batch batch = states(on, seed);
  const MechanismFactory& mechanism = on.mechanism;
  const double h = 2e-4 * (mechanism.plausible_max - mechanism.null);
  const auto stress = [&](double steps) {
    return ask(*on.with, batch, on.at(mechanism.null + steps * h), {false, true, false, false, false});
  };
  const std::vector<double> all = ask(*on.with, batch, on.at(mechanism.null), {false, false, false, true, false});
  const std::span<const double> exact = std::span(all).subspan(on.base.size() * 6 * state_count, 6 * state_count);
  const std::vector<double> f0 = stress(0), f1 = stress(1), f2 = stress(2), f3 = stress(3), f4 = stress(4);
  for (std::size_t i = 0; i < state_count; ++i) {
    double scale = 1e-6;
    for (std::size_t c = 0; c < 6; ++c) scale = std::max(scale, std::abs(exact[c * state_count + i]));
    for (std::size_t k = i; k < 6 * state_count; k += state_count) {
      // Of fourth order, and what rounding of the stress leaves in it.
      const double difference = (-25 * f0[k] + 48 * f1[k] - 36 * f2[k] + 16 * f3[k] - 3 * f4[k]) / (12 * h);
      const double rounding = 1e-13 * std::abs(f0[k]) / h, off = std::abs(exact[k] - difference);
      meter.see(std::isfinite(off) ? std::max(0.0, off - rounding) / scale : off, [&] {
        return fmt::format("dS/d{} = {:.10g} at {} = {:g}, differences give {:.10g}", mechanism.parameters[0].name,
                           exact[k], mechanism.parameters[0].name, mechanism.null, difference);
      });
    }
  }
  return meter.verdict();
}

Verdict amplitude_has_an_effect(const WrappedModel& on, std::uint64_t seed) {
  const std::string compared = "the stress of a path at the plausible amplitude with that at the null";
  const Batch batch = states(on, seed);
  if (same(path(*on.with, batch, on.at(on.mechanism.plausible_max)), path(*on.with, batch, on.at(on.mechanism.null))))
    return broken(compared,
                  fmt::format("{} states answer the same at {} = {:g} and {:g}", state_count,
                              on.mechanism.parameters[0].name, on.mechanism.plausible_max, on.mechanism.null));
  return {.compared = compared};
}

Verdict wrapped_model_is_a_model(const WrappedModel& on, std::uint64_t seed) {
  return has_properties<Model>(
      "the wrapped model with the properties of models", model_properties(),
      [&](const ModelProperty& property) { return property.check(*on.with, seed); },
      // A mechanism may be a stress at rest, as the tone of a muscle.
      [](const ModelProperty& property) {
        return property.function == deviatoric_stress_vanishes_at_rest || property.advisory;
      });
}

const std::vector<PropertyOf<WrappedModel>>& wrapped_model_properties() {
  static const std::vector<PropertyOf<WrappedModel>> properties{
      {"parameters_stand_behind_those_of_the_base", parameters_stand_behind_those_of_the_base},
      {"null_is_the_bare_model", null_is_the_bare_model},
      {"limit_is_the_bare_model", limit_is_the_bare_model},
      {"base_derivatives_at_the_null_are_those_of_the_base", base_derivatives_at_the_null_are_those_of_the_base},
      {"derivative_at_the_null_matches_differences", derivative_at_the_null_matches_differences},
      {"amplitude_has_an_effect", amplitude_has_an_effect},
      {"wrapped_model_is_a_model", wrapped_model_is_a_model}};
  return properties;
}

}  // namespace tunica::conformance
