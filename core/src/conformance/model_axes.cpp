// SPDX-License-Identifier: Apache-2.0
// The fast path of models, along principal axes, against their tensors.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "conformance/axes_answers.hpp"
#include "conformance/differences.hpp"
#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"

namespace tunica::conformance {
namespace {

constexpr int axes_draws = 20;
constexpr double axes_tolerance = 1e-12;

}  // namespace

Verdict axes_path_agrees_with_tensors(const Model& model, std::uint64_t seed) {
  Meter meter("evaluate_axes with evaluate at C without shear", axes_tolerance);
  const ModelDescription& description = model.describe();
  if (!description.principal_axes)
    return not_checked(meter.verdict().compared, "the model declares no principal-axes path");
  Sampler sampler(seed);
  for (int draw = 0; draw < axes_draws; ++draw) {
    const Point point = sampler.diagonal_point(model);
    const Evaluated tensor = evaluate(model, point.C, point.p);
    const AxesAnswers axes =
        axes_answers(model, std::span(point.C).first(3), point.p, {.gradient_dp = false, .energy_dp = false});
    const auto see = [&](const std::string& what, double one, double other, double scale) {
      meter.see(std::abs(one - other) / scale, [&] {
        return fmt::format("{} is {:.15g} from evaluate_axes, {:.15g} from evaluate,", what, one, other) +
               where(model, point);
      });
    };
    see("W", axes.energy[0], tensor.energy, std::max(std::abs(tensor.energy), 1e-3 * scale_of(tensor.stress)));
    for (std::size_t a = 0; a < 3; ++a)
      see(fmt::format("S of axis {}", a), 2 * axes.gradient[a], tensor.stress[a], scale_of(tensor.stress));
    constexpr std::array<std::array<std::size_t, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
    for (std::size_t k = 0; k < 6; ++k)
      see(fmt::format("the tangent of axes {} and {}", pair[k][0], pair[k][1]), 4 * axes.hessian[k],
          tensor.tangent[6 * pair[k][0] + pair[k][1]],
          std::max(scale_of(tensor.tangent), 1e-3 * scale_of(tensor.stress)));
  }
  meter.note(sampler.drawn_again());
  return meter.verdict();
}

/// ∂W/∂p against differences of W: evaluate() has no such output.
Verdict axes_energy_derivatives_match_differences(const Model& model, std::uint64_t seed) {
  Meter meter("dW/dp of evaluate_axes with differences of W over each parameter", 1e-6);
  const ModelDescription& description = model.describe();
  if (!description.principal_axes || !description.energy_derivatives || !description.parameter_derivatives)
    return not_checked(meter.verdict().compared, "the model declares no energy_derivatives along axes");
  Sampler sampler(seed);
  for (int draw = 0; draw < axes_draws; ++draw) {
    const Point point = sampler.diagonal_point(model);
    const std::span<const double> c = std::span(point.C).first(3);
    const AxesAnswers at = axes_answers(model, c, point.p);
    for (std::size_t j = 0; j < point.p.size(); ++j) {
      const Parameter& declared = description.parameters[j];
      const double value = point.p[j], size = declared.scale == Scale::log ? value : declared.max - declared.min;
      const double room = 0.5 * std::min(value - declared.min, declared.max - value);
      const Difference slope = differentiate(
          [&](double t) {
            std::vector<double> p = point.p;
            p[j] += t;
            return axes_answers(model, c, p, {true, false, false, false, false}).energy;
          },
          std::min(1e-2 * size, room))[0];
      const double scale =
          std::max({std::abs(at.energy_dp[j]), std::abs(slope.value), 1e-6 * std::abs(at.energy[0] / size), 1e-300});
      if (!(slope.uncertainty <= 0.25 * meter.tolerance() * scale)) continue;
      meter.see(std::abs(at.energy_dp[j] - slope.value) / scale, [&] {
        return fmt::format("dW/d{} = {:.10g}, differences give {:.10g},", declared.name, at.energy_dp[j], slope.value) +
               where(model, point);
      });
    }
  }
  meter.note(sampler.drawn_again());
  return meter.verdict();
}

Verdict axes_parameter_derivatives_agree_with_tensors(const Model& model, std::uint64_t seed) {
  Meter meter("dg/dp of evaluate_axes with dS/dp of evaluate", axes_tolerance);
  const ModelDescription& description = model.describe();
  if (!description.principal_axes || !description.parameter_derivatives)
    return not_checked(meter.verdict().compared, description.principal_axes
                                                     ? "the model declares no parameter derivatives"
                                                     : "the model declares no principal-axes path");
  Sampler sampler(seed);
  for (int draw = 0; draw < axes_draws; ++draw) {
    const Point point = sampler.diagonal_point(model);
    const Evaluated tensor = evaluate(model, point.C, point.p);
    const AxesAnswers axes = axes_answers(model, std::span(point.C).first(3), point.p);
    for (std::size_t j = 0; j < point.p.size(); ++j) {
      const auto row = std::span(tensor.stress_dp).subspan(6 * j, 6);
      const double scale = scale_of(row, 1e-6 * scale_of(tensor.stress) / std::max(1e-300, std::abs(point.p[j])));
      for (std::size_t a = 0; a < 3; ++a)
        meter.see(std::abs(2 * axes.gradient_dp[3 * j + a] - row[a]) / scale, [&] {
          return fmt::format("dS of axis {} by {} is {:.15g} from evaluate_axes, {:.15g} from evaluate,", a,
                             description.parameters[j].name, 2 * axes.gradient_dp[3 * j + a], row[a]) +
                 where(model, point);
        });
    }
  }
  meter.note(sampler.drawn_again());
  return meter.verdict();
}

}  // namespace tunica::conformance
