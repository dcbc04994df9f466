// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace tunica {

/// The scalar invariant a part of the energy is a function of:
///
///     x = i1 I1 + i2 I2 + fibre (M·CM) + normal C_rr + offset,   M = sin(angle) e_t + cos(angle) e_z,
///
/// with I1 = tr C, I2 = (I1² − tr C²)/2. The angle, in radians, is measured from the axial direction z. The same
/// struct holds the derivative of the coefficients with respect to one parameter.
template <class T>
struct InvariantOf {
  T i1 = T(0),        ///< weight of I1
      i2 = T(0),      ///< weight of I2
      fibre = T(0),   ///< weight of M·CM, the squared stretch along the fibres
      normal = T(0),  ///< weight of C_rr
      offset = T(0);  ///< added: −3 makes I1 vanish at rest, −1 that of fibres
  T angle = T(0);     ///< of the fibres from e_z, radians
};
/// The invariant at given parameters.
using Invariant = InvariantOf<double>;

/// ψ(x; p) at n values of x. Each output span has n entries, or is empty when not wanted; `value_dp` and
/// `first_dp` hold one row of n per response parameter (row j of parameter j at j·n). Overflow gives inf.
struct ResponseBatch {
  std::span<const double> x;   ///< invariants of n points
  std::span<double> value,     ///< ψ, kPa
      first,                   ///< dψ/dx
      second;                  ///< d²ψ/dx²
  std::span<double> value_dp,  ///< ∂ψ/∂p_j
      first_dp;                ///< ∂(dψ/dx)/∂p_j
};

/// One named part of a hyperelastic energy, W = Σ ψ_k(x_k): the matrix, a fibre family. Mechanisms transform parts
/// (dispersion changes the invariant of the fibres, stiffening the response of the matrix) or add more.
/// Thread-safe, evaluation is const; parameters are the whole model's, in its order and base units.
class EnergyPart {
 public:
  /// What the part stands for: mechanisms of the matrix (stiffening) or of fibres (dispersion) pick by it.
  enum class Role { matrix, fibre };
  /// When the part contributes: `always`; while x > 0; while the fibres are stretched, M·CM > 1. At the edge the
  /// right limit counts, so that rounding at rest decides nothing.
  enum class Active { always, argument_positive, fibre_stretched };

  /// What the owner of the part declares once; fixed for its life.
  struct Description {
    std::string name;                               ///< "matrix", "fibres"
    Role role = Role::matrix;                       ///< which mechanisms it is for
    Active active = Active::always;                 ///< applied by the model, not by respond()
    bool mirrored = false;                          ///< a second family at −angle, with the same ψ
    std::vector<std::size_t> invariant_parameters;  ///< model parameters that the invariant depends on
    std::vector<std::size_t> response_parameters;   ///< model parameters that ψ depends on at fixed x
    bool linear = false;                            ///< ψ'' = 0 everywhere: nobody asks for it
  };

  virtual ~EnergyPart() = default;
  [[nodiscard]] virtual const Description& describe() const = 0;  ///< asked once a batch
  /// The invariant, and (unless `derivatives` is empty) its derivative by each of `invariant_parameters`.
  virtual void invariant(std::span<const double> parameters, Invariant& value,
                         std::span<Invariant> derivatives) const = 0;
  /// ψ and its derivatives at the invariants batch.x, whether the part is active there or not.
  virtual void respond(std::span<const double> parameters, const ResponseBatch& batch) const = 0;
};

}  // namespace tunica
