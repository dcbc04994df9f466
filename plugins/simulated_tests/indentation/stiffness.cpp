// SPDX-License-Identifier: Apache-2.0
#include "stiffness.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "tunica/detail/solve_strip.hpp"

namespace tunica::indentation {
namespace {

constexpr double epsilon = 1e-3, different = 1e-6;
constexpr std::array<double, 4> weights{1, -8, 8, -1};  ///< over 12 ε, at ln λ = −2ε, −ε, ε, 2ε
constexpr std::array<double, 4> places{-2, -1, 1, 2};
/// Beyond these, stretches at which directions would show.
constexpr std::array<double, 2> wide{0.8, 1.25};

}  // namespace

Status ShearModulus::evaluate(const Model& model, std::span<const double> parameters, bool derivatives) {
  constexpr std::size_t n = places.size() + wide.size();
  std::array<double, n> stretch;
  for (std::size_t k = 0; k < places.size(); ++k) stretch[k] = std::exp(epsilon * places[k]);
  for (std::size_t k = 0; k < wide.size(); ++k) stretch[places.size() + k] = wide[k];
  std::array<std::array<double, n>, 2> stress, lateral;
  std::vector<double> stress_dp(derivatives ? parameters.size() * n : 0), lateral_dp(stress_dp.size());
  free_strip::Scratch scratch;
  for (const std::size_t axis : {1, 0}) {
    const bool last = axis == 0;
    const Status status = free_strip::solve(model,
                                            {.loaded = axis,
                                             .parameters = parameters,
                                             .stretch = stretch,
                                             .stress = stress[axis],
                                             .lateral = lateral[axis],
                                             .stress_dp = last ? std::span<double>(stress_dp) : std::span<double>(),
                                             .lateral_dp = last ? std::span<double>(lateral_dp) : std::span<double>()},
                                            scratch);
    if (!status.ok()) return status;
  }
  for (std::size_t k = 0; k < n; ++k) {
    const double narrow = -std::log(stretch[k]);  // y = −ln λ where both lateral stretches are alike
    if (std::abs(stress[0][k] - stress[1][k]) > different * std::abs(stress[0][k]) ||
        std::abs(lateral[0][k] - narrow) > different * std::abs(narrow) ||
        std::abs(lateral[1][k] - narrow) > different * std::abs(narrow))
      return Status::failed(
          "the material has directions, and the laws of the contact are of an isotropic one; choose "
          "an isotropic model");
  }
  value = 0;
  by_parameter.assign(derivatives ? parameters.size() : 0, 0);
  for (std::size_t k = 0; k < places.size(); ++k) {
    constexpr double third = 1. / 3;
    const double weight = third * weights[k] / (12 * epsilon);
    value += weight * stress[0][k];
    for (std::size_t j = 0; j < by_parameter.size(); ++j) by_parameter[j] += weight * stress_dp[j * n + k];
  }
  if (!std::isfinite(value))
    return Status::failed("the energy is undefined at rest; narrow the bounds of the parameters");
  return {};
}

Status ShearModulus::neo_hookean(const Model& model, std::span<const double> parameters, double strain) const {
  constexpr double alike = 0.05;
  if (!(strain > 0)) return {};
  const double shortest = 1 - strain, half = 1 - strain / 2;
  const std::array<double, 4> stretch{shortest, half, 1 / half, 1 / shortest};
  std::array<double, 4> stress, lateral;
  free_strip::Scratch scratch;
  if (Status status = free_strip::solve(
          model, {.loaded = 0, .parameters = parameters, .stretch = stretch, .stress = stress, .lateral = lateral},
          scratch);
      !status.ok())
    return status;
  for (std::size_t k = 0; k < stretch.size(); ++k) {
    const double ratio = stress[k] / (value * (stretch[k] * stretch[k] - 1 / stretch[k]));
    if (!(std::abs(ratio - 1) <= alike))
      return Status::failed(
          fmt::format("a strip at a stretch of {:.3g} bears {:.3g} times the stress of a neo-Hookean one, and the law "
                      "'deep' is of that; choose a neo-Hookean model, leave deeper rows out with \"where\", or choose "
                      "the law 'bonded' for small depths",
                      stretch[k], ratio));
  }
  return {};
}

}  // namespace tunica::indentation
