// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace tunica {

/// Declares that a model's memory consists only of a factor on the stress of elastic(); a class derived from Model may
/// also derive from this. The factor follows from energies alone:
///
///   S = η(W, Wmax) S_elastic,   W: energy of elastic() counted from rest,   Wmax: the largest so far.
///
/// Lateral equilibrium of an incompressible specimen with free faces is that of elastic(), whatever η is. remember()
/// computes this row by row. With this declaration, a test may compute all rows of a path at once, with the same
/// numbers to rounding.
///
/// Threads: as Model. Ownership: the caller's; spans are valid during the call.
class EnergyScaledModel {
 public:
  EnergyScaledModel() = default;
  EnergyScaledModel(const EnergyScaledModel&) = delete;
  EnergyScaledModel& operator=(const EnergyScaledModel&) = delete;
  virtual ~EnergyScaledModel() = default;

  /// The n rows of a path, in loading order.
  struct ScaledPath {
    /// Of the whole model, in the order and base units of its description.
    std::span<const double> parameters;
    /// W, kPa.
    std::span<const double> energy;
    /// The largest |S_aa| of elastic(), kPa.
    std::span<const double> stress;
  };
  /// What the model writes, n numbers each.
  struct Factors {
    /// η.
    std::span<double> eta;
    /// ∂η/∂W, 1/kPa.
    std::span<double> by_energy;
    /// ∂η/∂Wmax, 1/kPa.
    std::span<double> by_largest;
    /// The row whose energy is Wmax; n = none yet.
    std::span<std::size_t> largest;
    /// ∂η/∂p of the k-th parameter after those of elastic() at [k·n + i]; empty = not wanted.
    std::span<double> by_own;
  };
  /// Writes the factors of all rows, also of none; false if the model has any other memory.
  virtual bool scale_path(const ScaledPath& path, const Factors& factors) const = 0;
};

}  // namespace tunica
