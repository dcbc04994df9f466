// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tunica {

/// The coefficients of a scalar invariant that a part of an energy depends on:
///
///     x = i1 I1 + i2 I2 + fibre M·CM + normal C_rr + across M·C e_r + offset,   M = sin(angle) e_t + cos(angle) e_z,
///
/// with I1 = tr C and I2 = (I1² − tr C²)/2. The angle is in radians, from the axial direction z towards the
/// circumferential direction t. The term `across` is shear between the fibres and the wall's normal, and zero in
/// principal axes. The same struct holds derivatives of the coefficients by one parameter.
template <class T>
struct InvariantOf {
  T i1 = T(0),        ///< weight of I1
      i2 = T(0),      ///< weight of I2
      fibre = T(0),   ///< weight of M·CM, the squared stretch along the fibres
      normal = T(0),  ///< weight of C_rr
      across = T(0),  ///< weight of M·C e_r = M_t C_tr + M_z C_zr, which couples fibres and normal
      offset = T(0);  ///< added; −3 makes I1 vanish at rest, −1 the squared stretch of fibres
  T angle = T(0);     ///< of the fibres from e_z, radians
};
/// An invariant at given parameters.
using Invariant = InvariantOf<double>;

/// The response ψ(x; p) of a part at n values of x.
///
/// Every output span has n entries, or is empty if it is not wanted. The two derivatives by parameters have one row of
/// n entries for each of Description::response_parameters: row j begins at j·n. Overflow yields inf, not an error.
struct ResponseBatch {
  std::span<const double> x;   ///< invariants of n points
  std::span<double> value,     ///< ψ, kPa
      first,                   ///< dψ/dx, kPa
      second;                  ///< d²ψ/dx², kPa
  std::span<double> value_dp,  ///< ∂ψ/∂p_j
      first_dp;                ///< ∂(dψ/dx)/∂p_j
};

/// One named part of a hyperelastic energy, W = Σ ψ_k(x_k): the matrix, or a pair of fibre families.
///
/// Mechanisms change parts or add more: dispersion changes the invariant of fibres, stiffening the response of the
/// matrix. Most authors write no subclass: LawPart makes a part from the formula of ψ and the coefficients of x.
///
/// Parameters: the full vector of the model, in its order and base units. Threads: every method is const and is called
/// concurrently. Failure: no exceptions; overflow yields inf.
/// Ownership: the model owns its parts; what describe() returns lives as long as the part.
class EnergyPart {
 public:
  /// The constituent that the part describes. Mechanisms of the matrix or of the fibres select parts by it.
  enum class Role {
    matrix,  ///< ground substance, elastin, rubber
    fibre    ///< a family of fibres, or a mirrored pair of them
  };
  /// Where the part contributes. At the edge, the limit from the active side counts, so rounding at rest does not
  /// matter.
  enum class Active {
    always,             ///< everywhere
    argument_positive,  ///< while x > 0
    fibre_stretched     ///< while M·CM > 1
  };

  /// The declaration of a part, fixed for its life.
  struct Description {
    /// Name in messages and reports, for example "matrix" or "fibres".
    std::string name;
    /// The constituent, which selects the mechanisms that apply.
    Role role = Role::matrix;
    /// Where it contributes. The model applies this; respond() does not.
    Active active = Active::always;
    /// Whether a second family at −angle has the same ψ.
    bool mirrored = false;
    /// Indices of the model parameters that the invariant depends on.
    std::vector<std::size_t> invariant_parameters;
    /// Indices of the model parameters that ψ depends on at fixed x.
    std::vector<std::size_t> response_parameters;
    /// Whether ψ'' = 0 everywhere. The kernels then never ask for `second`.
    bool linear = false;
  };

  virtual ~EnergyPart() = default;
  /// The declaration. Called once a batch, so it returns a member.
  [[nodiscard]] virtual const Description& describe() const = 0;
  /// Sets the invariant at these parameters and, unless `derivatives` is empty, its derivative by each of
  /// Description::invariant_parameters, in that order.
  virtual void invariant(std::span<const double> parameters, Invariant& value,
                         std::span<Invariant> derivatives) const = 0;
  /// Evaluates ψ and its derivatives at the invariants batch.x, whether or not the part is active there.
  virtual void respond(std::span<const double> parameters, const ResponseBatch& batch) const = 0;
};

}  // namespace tunica
