// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "tunica/model.hpp"

namespace tunica::conformance {

using Tensor = std::array<double, 6>;
inline constexpr std::array<const char*, 6> component_names{"tt", "zz", "rr", "tz", "zr", "tr"};
using Matrix = Eigen::Matrix3d;  // axes t, z, r

Tensor to_tensor(const Matrix& C);
Matrix to_matrix(const Tensor& C);

struct Point {
  Tensor C;
  std::vector<double> p;
};
/// " at C = […], parameters mu = 10, …": for counter-examples.
std::string where(const Model& model, const Point& point);

struct Evaluated {
  double energy = 0;
  Tensor stress{};
  std::array<double, 36> tangent{};
  std::vector<double> stress_dp;
  std::vector<double> state;  ///< the new one

  [[nodiscard]] bool finite() const;
};
/// One point, everything the model offers; history models at equilibrium from rest. Throws std::runtime_error where the
/// model answers with another status than ok, and MemoryFault (handout.hpp) for writes elsewhere or left out.
Evaluated evaluate(const Model& model, const Tensor& C, std::span<const double> parameters);

/// Seeded states and parameters: C = FᵀF with F = 1 + entries up to ±0.25, parameters inside their bounds, away from
/// the edges by 5 % of the range (of the logarithm where the scale is logarithmic).
class Sampler {
 public:
  explicit Sampler(std::uint64_t seed) : engine_(seed) {}
  Tensor right_cauchy_green();
  std::vector<double> parameters(const std::vector<Parameter>& declared);
  std::vector<double> parameters(const ModelDescription& description) { return parameters(description.parameters); }
  /// A state and parameters at which all that the model offers is finite: energies may overflow or end within the
  /// bounds, so it is drawn until then. Throws std::runtime_error where that does not happen.
  Point point(const Model& model);
  /// The same with shear taken out.
  Point diagonal_point(const Model& model);
  /// "7 of 27 states drawn again: not finite there", or nothing.
  [[nodiscard]] std::string drawn_again() const;
  std::mt19937_64& engine() { return engine_; }

 private:
  Point finite_point(const Model& model, bool shear);
  std::mt19937_64 engine_;
  std::size_t drawn_ = 0, again_ = 0;
};

}  // namespace tunica::conformance
