// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tunica/model.hpp"

/// The properties every Model must have, as checks that return an empty string or a counter-example in words. They
/// serve the conformance tests of the built-in models and of decorated ones.
namespace tunica::testing {

using Tensor = std::array<double, 6>;  // tt, zz, rr, tz, zr, tr

/// Seeded states and parameters: C = FᵀF with F = 1 + entries up to ±0.25, parameters inside their bounds, away from
/// the edges by 5 % of the range (of the logarithm where the scale is logarithmic), stiff exponents capped so that
/// exp stays finite, and limits of extension beyond the sampled states.
class Sampler {
 public:
  explicit Sampler(std::uint64_t seed) : engine_(seed) {}
  Tensor right_cauchy_green();
  std::vector<double> parameters(const ModelDescription& description);

 private:
  std::mt19937_64 engine_;
};

struct Evaluated {
  double energy = 0;
  Tensor stress{};
  std::array<double, 36> tangent{};
  std::vector<double> stress_dp;
};
/// One point, everything the model offers; history models at equilibrium from rest.
Evaluated evaluate(const Model& model, const Tensor& C, std::span<const double> parameters);

using Check = std::string (*)(const Model&, std::uint64_t seed);
std::string stress_is_the_gradient_of_the_energy(const Model& model, std::uint64_t seed);
std::string tangent_is_the_derivative_of_the_stress(const Model& model, std::uint64_t seed);
std::string tangent_has_its_symmetries(const Model& model, std::uint64_t seed);
std::string parameter_derivatives_match_differences(const Model& model, std::uint64_t seed);
std::string response_is_objective(const Model& model, std::uint64_t seed);
std::string response_has_the_symmetry_of_the_wall(const Model& model, std::uint64_t seed);
std::string deviatoric_stress_vanishes_at_rest(const Model& model, std::uint64_t seed);
std::string batch_equals_single_points(const Model& model, std::uint64_t seed);
std::string concurrent_calls_agree(const Model& model, std::uint64_t seed);
std::string axes_path_agrees_with_tensors(const Model& model, std::uint64_t seed);
std::string axes_parameter_derivatives_agree_with_tensors(const Model& model, std::uint64_t seed);

struct Property {
  const char* name;
  Check check;
};
const std::vector<Property>& model_properties();

}  // namespace tunica::testing
