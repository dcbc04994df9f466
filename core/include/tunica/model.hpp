// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tunica/axis_step.hpp"
#include "tunica/energy_part.hpp"
#include "tunica/parameter.hpp"
#include "tunica/status.hpp"
#include "tunica/strip_path.hpp"

/// The interfaces that plugins implement, and their shared declarations. docs/sdk.md gives a reading order.
namespace tunica {

/// The properties of a model. They never change during the model's life.
struct ModelDescription {
  /// Name in experiment files, for example "gho".
  std::string type = {};
  /// The parameters. Their order is the order of every parameter span below.
  std::vector<Parameter> parameters = {};
  /// Number of state variables (doubles) of a material point; 0 = no memory.
  std::size_t history_size = 0;
  /// Whether evaluate_axes() is implemented. Point tests are then several times faster.
  bool principal_axes = false;
  /// Whether `stress_dp` and `gradient_dp` are exact. If false the host differences predictions; a model with history
  /// is differenced over its whole path.
  bool parameter_derivatives = true;
  /// Functions of the parameters that data may determine although they do not determine the parameters themselves.
  std::vector<Combination> combinations = {};
  /// Inequalities value ≥ 0 of an admissible material, beyond the bounds of single parameters. The host checks them at
  /// every result, and imposes them if the experiment file asks for it. `remedy` is not used.
  std::vector<Combination> admissible = {};
  /// Whether evaluate_axes() writes `energy_dp`. Memory in principal axes may need it.
  bool energy_derivatives = false;
  /// Doubles of state that remember() carries for a point in principal axes; 0 = the model remembers in tensors only,
  /// or not at all. With it, tests have exact derivatives along the whole path.
  std::size_t axis_history_size = 0;
  /// The energy in mathematical notation, for a model whose formula depends on its options; may be empty.
  std::string formula = {};
  /// Whether the volume may change: S = 2 ∂W/∂C is then the whole stress, and vanishes at rest. Tests solve for the
  /// stretches of their free faces instead of a pressure; a test that cannot refuses the model.
  bool compressible = false;
};

/// The input of one evaluation: a batch of n material points as a structure of arrays.
///
/// Component c of point i is at [c·n + i]. Tensors are symmetric and have six components in the order tt, zz, rr, tz,
/// zr, tr, with t circumferential, z axial and r radial. An off-diagonal entry is the tensor component, not twice it.
struct MaterialPoints {
  /// n, the number of points; any number from 0.
  std::size_t count = 0;
  /// 6n entries: the right Cauchy–Green tensor C = FᵀF in material axes. det C need not be 1.
  std::span<const double> C;
  /// The model's parameters, in the order and base units of the description; the same for all points.
  std::span<const double> parameters;
  /// n entries ≥ 0: time since the previous step, in s. Empty = equilibrium, loading is infinitely slow.
  std::span<const double> time_step;
  /// history_size·n entries: the state after the previous step. Empty = every point starts from rest.
  std::span<const double> state;
};

/// The output of one evaluation, in memory of the caller. An empty span means "not wanted".
///
/// Layout as in MaterialPoints. Spans do not overlap each other or the inputs.
struct MaterialResponse {
  /// n entries: energy W per reference volume, kPa.
  std::span<double> energy;
  /// 6n entries: second Piola–Kirchhoff stress S = 2 ∂W/∂C plus the stress from history, without pressure, kPa.
  std::span<double> stress;
  /// 36n entries: 2 ∂S_a/∂C_b in tensor components, kPa; row (a, b) of point i at [(6a + b)n + i]. With history it is
  /// the derivative of this step, consistent with the stress.
  std::span<double> tangent;
  /// n_p·6n entries: ∂S_c/∂p_j of point i at [(6j + c)n + i].
  std::span<double> stress_dp;
  /// history_size·n entries: the new state. It never aliases the old one.
  std::span<double> state;
};

/// The input of an evaluation in principal axes: points whose C is diagonal in material axes.
struct AxisPoints {
  /// n, the number of points.
  std::size_t count = 0;
  /// 3n entries: squared stretches c = (c_t, c_z, c_r), component-major.
  std::span<const double> c;
  /// The model's parameters, in the order and base units of the description.
  std::span<const double> parameters;
};

/// First and second derivatives of W by the squared stretches. An empty span means "not wanted".
struct AxisResponse {
  /// n entries: W, kPa.
  std::span<double> energy;
  /// 3n entries: g_a = ∂W/∂c_a, so that S_aa = 2 g_a.
  std::span<double> gradient;
  /// 6n entries: ∂²W/∂c_a∂c_b in the order tt, zz, rr, tz, zr, tr.
  std::span<double> hessian;
  /// n_p·3n entries: ∂g_a/∂p_j of point i at [(3j + a)n + i].
  std::span<double> gradient_dp;
  /// n_p·n entries: ∂W/∂p_j of point i at [j·n + i]. Wanted only together with gradient_dp, and only if
  /// ModelDescription::energy_derivatives is true.
  std::span<double> energy_dp = {};
};

/// The constitutive response of a material.
///
/// Mathematics: an energy W(C; p) per reference volume, defined for det C ≠ 1 as well, and S = 2 ∂W/∂C. Unless
/// ModelDescription::compressible is true, S has no pressure and no isochoric split. Only its deviatoric part then
/// vanishes at rest, and the test enforces incompressibility. Physics: docs/theory.md.
///
/// Required: describe() and evaluate().
/// Optional: evaluate_axes(), the fast path of point tests; remember(), the fast path for models with memory; parts(),
/// which lets mechanisms change an energy that is a sum. Few authors implement this interface directly: tunica/models/
/// has bases that need only the energy.
///
/// Threads: every method is const and is called concurrently, so members must not hold mutable scratch. A call is a
/// trial: it reads the old state and writes the new one. A second call must give the same bits.
/// Failure: where the energy overflows or is undefined, write non-finite numbers at that point; the test or the host
/// turns them into a status. Return a status other than ok only if no point could be evaluated. Do not throw.
/// Ownership: the model owns the results of describe() and parts() for its whole life. Spans are valid during the call.
class Model {
 public:
  virtual ~Model() = default;
  /// The properties of the model. Called at any time and by any thread, so it returns a member.
  [[nodiscard]] virtual const ModelDescription& describe() const = 0;
  /// Evaluates a batch. Writes the outputs that are not empty, and nothing else.
  virtual Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const = 0;
  /// Evaluates a batch in principal axes. Called only if ModelDescription::principal_axes is true.
  virtual Status evaluate_axes([[maybe_unused]] const AxisPoints& points,
                               [[maybe_unused]] const AxisResponse& response) const {
    return Status::failed("this model has no principal-axes path");
  }
  /// Optional: solves the equilibrium of a free strip inside the model, which saves one call per iteration. Returns
  /// false if the model leaves this to the test. A decorated model must not forward the call unless it changes nothing.
  /// At parameters that make the model isotropic, a solution must have λ2 = λ3; a model that iterates returns false
  /// there. `status` is the outcome. A row without equilibrium is a failure, and *strip.lost is its index.
  virtual bool solve_strip([[maybe_unused]] const StripPath& strip, [[maybe_unused]] Status& status) const {
    return false;
  }
  /// The terms of the energy that mechanisms can change. Return either all of them, with sum W, or none.
  [[nodiscard]] virtual std::span<const std::unique_ptr<EnergyPart>> parts() const { return {}; }
  /// The model without memory whose response in principal axes remember() changes. Its parameters are the first ones.
  [[nodiscard]] virtual const Model& elastic() const { return *this; }
  /// Whether the material keeps its volume at these parameters. All results are then those of incompressible(), bit for
  /// bit; only derivatives by parameters are those of the compressible model.
  [[nodiscard]] virtual bool keeps_volume([[maybe_unused]] std::span<const double> parameters) const {
    return !describe().compressible;
  }
  /// The model that keeps its volume, where keeps_volume() is true. Its parameters are the first ones.
  [[nodiscard]] virtual const Model& incompressible() const { return *this; }
  /// Whether memory changes anything at these parameters. If not, all results are those of elastic(), bit for bit.
  [[nodiscard]] virtual bool remembers([[maybe_unused]] std::span<const double> parameters) const { return false; }
  /// One step of one point along its path in principal axes: adds memory to the response of elastic(), and advances the
  /// state. Called only if ModelDescription::axis_history_size is not 0: first at rest, then row by row.
  virtual void remember([[maybe_unused]] const AxisStep& step) const {}
};

}  // namespace tunica
