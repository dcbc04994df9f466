// SPDX-License-Identifier: Apache-2.0
// Mechanisms that act on tests.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

#include "conformance/differences.hpp"
#include "conformance/mechanism_properties.hpp"
#include "conformance/model_batch.hpp"
#include "conformance/predictions.hpp"

namespace tunica::conformance {
namespace {

using Side = MechanismFactory::Side;

Prediction prediction(const WrappedTest& on, const Test& test, const Values& own, bool jacobian) {
  Prediction found =
      conformance::predict(test, {*on.material.model, on.material.parameters, own}, {.jacobian = jacobian});
  if (!found.status.ok()) throw std::runtime_error("the test answers '" + found.status.reason() + "'");
  return found;
}

bool is_differenced(const WrappedTest& on) { return on.bare->describe().differencing.has_value(); }

double plausible(const WrappedTest& on) { return on.mechanism.plausible_max - on.mechanism.null; }

Simulation simulation(const WrappedTest& on, double amplitude) {
  return {*on.with, *on.material.model, on.material.parameters, on.at(amplitude), {}};
}

}  // namespace

std::vector<double> WrappedTest::at(double value) const {
  std::vector<double> moved = own;
  moved[amplitude] = value;
  return moved;
}

Verdict parameters_stand_behind_those_of_the_base(const WrappedTest& on, std::uint64_t) {
  const std::string compared = "the parameters of the wrapped test with those of the base and the declared ones";
  if (!on.mechanism.native.empty()) return not_checked(compared, "it stands for a parameter of the test");
  const auto &base = on.bare->describe().parameters, &own = on.mechanism.parameters,
             &all = on.with->describe().parameters;
  if (all.size() != base.size() + own.size())
    return broken(compared, fmt::format("{} parameters, where the base has {} and the mechanism {}", all.size(),
                                        base.size(), own.size()));
  for (std::size_t k = 0; k < all.size(); ++k) {
    // The unit may be that of the channel it acts on.
    const Parameter& expected = k < base.size() ? base[k] : own[k - base.size()];
    if (all[k].name != expected.name)
      return broken(compared, fmt::format("parameter {} is '{}', expected '{}'", k + 1, all[k].name, expected.name));
  }
  if (on.with->describe().nulls.size() != all.size())
    return broken(compared, fmt::format("{} nulls for {} parameters", on.with->describe().nulls.size(), all.size()));
  return {.compared = compared};
}

Verdict null_is_the_bare_test(const WrappedTest& on, std::uint64_t) {
  Meter meter("predictions and Jacobian at the null with those of the bare test, bit for bit", 0);
  if (on.own[on.amplitude] != on.mechanism.null)
    return broken(meter.verdict().compared,
                  fmt::format("the test holds the amplitude at {:g}, the mechanism declares the null {:g}",
                              on.own[on.amplitude], on.mechanism.null));
  for (const bool jacobian : {true, false}) {
    if (jacobian && is_differenced(on)) continue;
    const Prediction bare = prediction(on, *on.bare, on.bare_own, jacobian),
                     with = prediction(on, *on.with, on.own, jacobian);
    const auto compare = [&](const Values& one, const Values& other, const char* what) {
      if (other.empty() || std::memcmp(one.data(), other.data(), sizeof(double) * other.size()) == 0) return;
      const double scale = scale_of(other);
      for (std::size_t i = 0; i < other.size(); ++i)
        if (std::bit_cast<std::uint64_t>(one[i]) != std::bit_cast<std::uint64_t>(other[i]))
          meter.see(std::max(1e-17, std::abs(one[i] - other[i]) / scale), [&] {
            return fmt::format("{} {}: {:.17g} with the mechanism at its null, {:.17g} without", what, i + 1, one[i],
                               other[i]);
          });
    };
    compare(with.values, bare.values, "prediction");
    compare(with.jacobian, bare.jacobian, "entry of the Jacobian");
  }
  return meter.verdict();
}

Verdict limit_is_the_bare_test(const WrappedTest& on, std::uint64_t) {
  Meter meter("predictions next to the null with those at it, in each channel", 1e-12);
  const double near = next_to_the_null(on.mechanism);
  if (on.bare->describe().costly) meter.allow(1e-9);  // solved to a tolerance
  const Values bare = prediction(on, *on.bare, on.bare_own, false).values,
               with = prediction(on, *on.with, on.at(near), false).values;
  const Simulation s = simulation(on, near);
  for (std::size_t i = 0; i < bare.size(); ++i)
    meter.see(std::abs(with[i] - bare[i]) / channel_scale(s, bare, i), [&] {
      return fmt::format("{}: {:.15g} at {:.3g}, {:.15g} at the null", place(s, i), with[i], near, bare[i]);
    });
  return meter.verdict();
}

/// One-sided differences of fourth order, on each admissible side.
Verdict derivative_at_the_null_matches_differences(const WrappedTest& on, std::uint64_t) {
  const bool costly = on.bare->describe().costly;
  Meter meter("d(prediction)/d(amplitude) at the null with one-sided differences", 1e-6);
  if (is_differenced(on))
    return not_checked(meter.verdict().compared, "the test has no derivatives: the host differences it as stated");
  const Prediction at = prediction(on, *on.with, on.own, true);
  const std::size_t size = at.values.size();
  const std::span<const double> column =
      std::span(at.jacobian).subspan((on.material.parameters.size() + on.amplitude) * size, size);
  const Simulation s = simulation(on, on.mechanism.null);
  for (const double side : {1., -1.}) {
    if (side < 0 && on.mechanism.side == Side::positive) continue;
    const double h = side * 2e-3 * plausible(on);
    const auto moved = [&](double steps) {
      return prediction(on, *on.with, on.at(on.mechanism.null + steps * h), false).values;
    };
    const Values f1 = moved(1), f2 = moved(2), f3 = moved(3), f4 = moved(4);
    for (std::size_t i = 0; i < size; ++i) {
      const double difference = (-25 * at.values[i] + 48 * f1[i] - 36 * f2[i] + 16 * f3[i] - 3 * f4[i]) / (12 * h);
      const double value = channel_scale(s, at.values, i), largest = channel_scale(s, column, i);
      const double rounding = (costly ? 1e-9 : 1e-12) * value / std::abs(h), off = std::abs(column[i] - difference);
      meter.see(std::isfinite(off) ? std::max(0.0, off - rounding) / largest : off, [&] {
        return fmt::format("{}: {:.10g}, differences to the {} give {:.10g}", place(s, i), column[i],
                           side > 0 ? "right" : "left", difference);
      });
    }
  }
  return meter.verdict();
}

Verdict amplitude_has_an_effect(const WrappedTest& on, std::uint64_t) {
  const std::string compared = "predictions at a plausible amplitude with those at the null";
  const double moved = on.mechanism.null + 0.3 * plausible(on);
  if (prediction(on, *on.with, on.at(moved), false).values == prediction(on, *on.with, on.own, false).values)
    return broken(compared, fmt::format("no prediction changes between {} = {:g} and {:g}",
                                        on.mechanism.parameters[0].name, on.mechanism.null, moved));
  if (is_differenced(on)) return {.compared = compared};
  const Prediction at = prediction(on, *on.with, on.own, true);
  const auto column = std::span(at.jacobian)
                          .subspan((on.material.parameters.size() + on.amplitude) * at.values.size(), at.values.size());
  const bool seen = std::any_of(column.begin(), column.end(), [](double entry) { return entry != 0; });
  if (seen == (on.mechanism.side == Side::even))
    return broken(compared, seen ? "the first derivative at the null is not zero, and the side is declared even"
                                 : "the first derivative at the null is zero, and the side is not declared even");
  return {.compared = compared};
}

Verdict wrapped_test_is_a_test(const WrappedTest& on, std::uint64_t) {
  const Simulation s = simulation(on, on.mechanism.null + 0.3 * plausible(on));
  const bool costly = on.bare->describe().costly;
  return has_properties<Simulation>(
      "the wrapped test with the properties of tests", test_properties(),
      [&](const TestProperty& property) { return property.check(s); },
      // Differences of load steps are not that sharp.
      [&](const TestProperty& property) {
        return costly && property.function != given_abscissae_replace_the_bound_ones;
      });
}

const std::vector<PropertyOf<WrappedTest>>& wrapped_test_properties() {
  static const std::vector<PropertyOf<WrappedTest>> properties{
      {"parameters_stand_behind_those_of_the_base", parameters_stand_behind_those_of_the_base},
      {"null_is_the_bare_test", null_is_the_bare_test},
      {"limit_is_the_bare_test", limit_is_the_bare_test},
      {"derivative_at_the_null_matches_differences", derivative_at_the_null_matches_differences},
      {"amplitude_has_an_effect", amplitude_has_an_effect},
      {"wrapped_test_is_a_test", wrapped_test_is_a_test}};
  return properties;
}

}  // namespace tunica::conformance
