// SPDX-License-Identifier: Apache-2.0
// Derivatives of models against differences.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "conformance/differences.hpp"
#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"

namespace tunica::conformance {
namespace {

/// Differences are good to better than this where they settle; a wrong term in a formula is off by orders more.
constexpr double derivative_tolerance = 1e-6;
constexpr double settled_below = 0.25 * derivative_tolerance;
constexpr std::size_t settled_states = 20;
/// First step in C; the last is 1/256 of it.
constexpr double first_step = 1e-2;

/// compare(point, at) at states until there are enough at which it says that differences can see the derivative: not
/// where the energy is too steep for them, next to a kink, or next to where it ends.
template <class Compare>
Verdict at_settled_states(const Model& model, std::uint64_t seed, Meter& meter, const Compare& compare) {
  Sampler sampler(seed);
  std::size_t seen = 0, tries = 0;
  while (seen < settled_states && tries < 10 * settled_states) {
    ++tries;
    const Point point = sampler.point(model);
    if (compare(point, evaluate(model, point.C, point.p))) ++seen;
  }
  if (seen < settled_states / 4)
    return broken(meter.verdict().compared,
                  fmt::format("at {} of {} states differences do not settle: W or S jumps, has a kink or noise nearly "
                              "everywhere",
                              tries - seen, tries));
  std::string note = sampler.drawn_again();
  if (seen < tries)
    note += fmt::format("{}{} of {} states left out, where differences do not settle", note.empty() ? "" : "; ",
                        tries - seen, tries);
  meter.note(note);
  return meter.verdict();
}

/// S = 2 ∂/∂C; an off-diagonal entry stands for C_ab and C_ba, so its derivative is that by C_ab itself.
double by_tensor(std::size_t c) { return c < 3 ? 2 : 1; }

/// Everything the model answers along component c of C; numbers that are none where it cannot answer.
template <class Pick>
std::vector<Difference> along(const Model& model, const Point& point, std::size_t c, const Pick& pick) {
  return differentiate(
      [&](double t) {
        Tensor C = point.C;
        C[c] += t;
        return pick(evaluate(model, C, point.p));
      },
      first_step);
}

}  // namespace

Verdict stress_is_the_gradient_of_the_energy(const Model& model, std::uint64_t seed) {
  // What history adds to the stress, damage on the way there for example, is no part of the energy.
  if (&model.elastic() != &model) return stress_is_the_gradient_of_the_energy(model.elastic(), seed);
  Meter meter("S with twice the difference of W over C", derivative_tolerance);
  return at_settled_states(model, seed, meter, [&](const Point& point, const Evaluated& at) {
    Tensor expected{}, uncertainty{};
    for (std::size_t c = 0; c < 6; ++c) {
      const auto slope = along(model, point, c, [](const Evaluated& e) { return std::vector<double>{e.energy}; });
      expected[c] = by_tensor(c) * slope[0].value;
      uncertainty[c] = by_tensor(c) * slope[0].uncertainty;
    }
    const double scale = std::max(scale_of(at.stress), scale_of(expected));
    if (!(*std::max_element(uncertainty.begin(), uncertainty.end()) <= settled_below * scale)) return false;
    for (std::size_t c = 0; c < 6; ++c)
      meter.see(std::abs(at.stress[c] - expected[c]) / scale, [&] {
        return fmt::format("S_{} = {:.10g}, differences of W give {:.10g},", component_names[c], at.stress[c],
                           expected[c]) +
               where(model, point);
      });
    return true;
  });
}

Verdict tangent_is_the_derivative_of_the_stress(const Model& model, std::uint64_t seed) {
  Meter meter("the tangent with twice the difference of S over C", derivative_tolerance);
  return at_settled_states(model, seed, meter, [&](const Point& point, const Evaluated& at) {
    std::vector<double> expected(36), uncertainty(36);
    for (std::size_t c = 0; c < 6; ++c) {
      const auto slope = along(
          model, point, c, [](const Evaluated& e) { return std::vector<double>(e.stress.begin(), e.stress.end()); });
      for (std::size_t a = 0; a < 6; ++a) {
        expected[6 * a + c] = by_tensor(c) * slope[a].value;
        uncertainty[6 * a + c] = by_tensor(c) * slope[a].uncertainty;
      }
    }
    // A stress that is linear in nothing has no tangent to be relative to; then it is the stress that counts.
    const double scale = std::max({scale_of(at.tangent), scale_of(expected), 1e-2 * scale_of(at.stress)});
    if (!(*std::max_element(uncertainty.begin(), uncertainty.end()) <= settled_below * scale)) return false;
    for (std::size_t k = 0; k < 36; ++k)
      meter.see(std::abs(at.tangent[k] - expected[k]) / scale, [&] {
        return fmt::format("2 dS_{}/dC_{} = {:.10g}, differences of S give {:.10g},", component_names[k / 6],
                           component_names[k % 6], at.tangent[k], expected[k]) +
               where(model, point);
      });
    return true;
  });
}

Verdict tangent_has_its_symmetries(const Model& model, std::uint64_t seed) {
  Meter meter("the tangent with its transpose", 1e-12);
  if (model.describe().history_size > 0) meter.allow(1e-9);  // sums of several tangents
  Sampler sampler(seed);
  for (std::size_t draw = 0; draw < settled_states; ++draw) {
    const Point point = sampler.point(model);
    const Evaluated at = evaluate(model, point.C, point.p);
    const double scale = std::max(scale_of(at.tangent), 1e-2 * scale_of(at.stress));
    for (std::size_t a = 0; a < 6; ++a)
      for (std::size_t b = 0; b < a; ++b)
        meter.see(std::abs(at.tangent[6 * a + b] - at.tangent[6 * b + a]) / scale, [&] {
          return fmt::format("entry ({0}, {1}) is {2:.10g} and ({1}, {0}) is {3:.10g},", component_names[a],
                             component_names[b], at.tangent[6 * a + b], at.tangent[6 * b + a]) +
                 where(model, point);
        });
  }
  meter.note(sampler.drawn_again());
  return meter.verdict();
}

Verdict parameter_derivatives_match_differences(const Model& model, std::uint64_t seed) {
  Meter meter("dS/dp with differences of S over each parameter", derivative_tolerance);
  const ModelDescription& description = model.describe();
  if (!description.parameter_derivatives)
    return not_checked(meter.verdict().compared, "the model declares none; tunica differences its predictions");
  if (description.parameters.empty()) return not_checked(meter.verdict().compared, "the model has no parameters");
  return at_settled_states(model, seed, meter, [&](const Point& point, const Evaluated& at) {
    std::vector<std::vector<Difference>> slopes;
    std::vector<double> scales;
    for (std::size_t j = 0; j < point.p.size(); ++j) {
      const Parameter& declared = description.parameters[j];
      const double value = point.p[j], size = declared.scale == Scale::log ? value : declared.max - declared.min;
      const double room = 0.5 * std::min(value - declared.min, declared.max - value);
      slopes.push_back(differentiate(
          [&](double t) {
            std::vector<double> p = point.p;
            p[j] += t;
            const Tensor stress = evaluate(model, point.C, p).stress;
            return std::vector<double>(stress.begin(), stress.end());
          },
          std::min(1e-2 * size, room)));
      // A derivative is negligible if a change of the parameter by its own size changes the stress by less than a
      // millionth.
      scales.push_back(scale_of(std::span(at.stress_dp).subspan(6 * j, 6), 1e-6 * scale_of(at.stress) / size));
      for (const Difference& slope : slopes.back()) scales[j] = std::max(scales[j], std::abs(slope.value));
      for (const Difference& slope : slopes.back())
        if (!(slope.uncertainty <= settled_below * scales[j])) return false;
    }
    for (std::size_t j = 0; j < slopes.size(); ++j)
      for (std::size_t c = 0; c < 6; ++c)
        meter.see(std::abs(at.stress_dp[6 * j + c] - slopes[j][c].value) / scales[j], [&] {
          return fmt::format("dS_{}/d{} = {:.10g}, differences give {:.10g},", component_names[c],
                             description.parameters[j].name, at.stress_dp[6 * j + c], slopes[j][c].value) +
                 where(model, point);
        });
    return true;
  });
}

}  // namespace tunica::conformance
