// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tunica/energy_part.hpp"
#include "tunica/parameter.hpp"
#include "tunica/status.hpp"

/// What plugins are written against; docs/sdk.md says in which order to read it.
namespace tunica {

/// What a model says of itself; it never changes during the model's life.
struct ModelDescription {
  std::string type;                       ///< "gho"
  std::vector<Parameter> parameters;      ///< order of every parameter span below
  std::size_t history_size = 0;           ///< doubles of state a material point carries; 0 = no memory
  bool principal_axes = false;            ///< evaluate_axes() is implemented
  bool parameter_derivatives = true;      ///< false: the host differences (whole paths, for models with history)
  std::vector<Combination> combinations;  ///< known invariances, see Combination
  /// Inequalities value ≥ 0 that an admissible material keeps, beyond the bounds of single parameters; the host checks
  /// them at every result and imposes them on demand. `remedy` is not used.
  std::vector<Combination> admissible = {};
};

/// A batch of n material points, structure of arrays: component c of point i at [c·n + i].
struct MaterialPoints {
  std::size_t count = 0;               ///< n
  std::span<const double> C;           ///< 6n; right Cauchy–Green tensor in material axes: tt, zz, rr, tz, zr, tr
  std::span<const double> parameters;  ///< in the order and base units of the description
  std::span<const double> time_step;   ///< n, in s, ≥ 0; empty = equilibrium (infinitely slow)
  std::span<const double> state;       ///< history_size·n, old state; empty = every point at rest
};

/// Outputs into memory of the caller; an empty span means "not wanted".
struct MaterialResponse {
  std::span<double> energy;  ///< n; W per reference volume, kPa
  std::span<double> stress;  ///< 6n; S = 2 ∂W/∂C (+ what history adds), second Piola–Kirchhoff without pressure, kPa
  std::span<double> tangent;    ///< 36n; row (a,b) of point i at [(6a+b)n + i]: 2 ∂S_a/∂C_b, tensor components
  std::span<double> stress_dp;  ///< n_p·6n; ∂S/∂p_j at [(6j+c)n + i]
  std::span<double> state;      ///< history_size·n, new state; may not alias the old one
};

/// Points whose C is diagonal in material axes, given by the squared stretches c = (c_t, c_z, c_r).
struct AxisPoints {
  std::size_t count = 0;               ///< n
  std::span<const double> c;           ///< 3n, component-major
  std::span<const double> parameters;  ///< in the order and base units of the description
};

/// First and second derivatives of W by the squared stretches; empty = not wanted.
struct AxisResponse {
  std::span<double> energy;       ///< n
  std::span<double> gradient;     ///< 3n; g_a = ∂W/∂c_a, so that S_aa = 2 g_a
  std::span<double> hessian;      ///< 6n; ∂²W/∂c_a∂c_b in the order tt, zz, rr, tz, zr, tr
  std::span<double> gradient_dp;  ///< n_p·3n; ∂g_a/∂p_j at [(3j+a)n + i]
};

/// The constitutive response of a material.
///
/// Mathematics: an energy W(C; p) per reference volume, defined for det C ≠ 1 too; S = 2 ∂W/∂C carries no pressure
/// and no isochoric split, so S at rest need not vanish, only its deviatoric part. Incompressibility is the test's
/// affair. Sizes and layout: see the structs above; a whole batch in one virtual call.
/// Required: describe, evaluate. Optional: evaluate_axes (the fast path of point tests) where the description says
/// so; parts, for energies that are sums over invariants (mechanisms then can transform them).
/// Threads: every method is const and safe to call concurrently; no mutable scratch. A trial evaluation never
/// commits state: the old state is read, the new one written to the caller's memory.
/// Failure: a point where the energy overflows or is undefined yields non-finite numbers at that point, and the
/// test turns them into a status; a status other than ok means that no point could be evaluated. No exceptions.
/// Ownership: the model owns what describe() and parts() refer to, for its whole life.
/// Source: physics as in docs/theory.md.
class Model {
 public:
  virtual ~Model() = default;
  /// Asked at any time, by any thread; cheap.
  [[nodiscard]] virtual const ModelDescription& describe() const = 0;
  /// Energy, stress and derivatives of a batch; writes what `response` has room for, and nothing else.
  virtual Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const = 0;
  /// The same in principal axes, called only where ModelDescription::principal_axes says so.
  virtual Status evaluate_axes(const AxisPoints& points, const AxisResponse& response) const {
    static_cast<void>(points), static_cast<void>(response);
    return Status::failed("this model has no principal-axes path");
  }
  /// The terms of the energy that mechanisms can transform; empty where it is no sum over invariants.
  [[nodiscard]] virtual std::span<const std::unique_ptr<EnergyPart>> parts() const { return {}; }
};

}  // namespace tunica
