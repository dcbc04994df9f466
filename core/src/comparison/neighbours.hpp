// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "execution/warning.hpp"

namespace tunica::comparison {

/// How points of a field err together: with the residuals e in units of their noise and pairs of one step and channel,
///
///     ρ(d) = ⟨e_i e_j⟩/⟨e²⟩ over pairs a distance d apart,   V = 1 + Σ_d n(d) ρ(d)
///
/// with n(d) the mean number of points at that distance. n points then say of what is smooth no more than n/V points
/// that err each by itself, and intervals that take them for such are too narrow by √V (Bayley, Hammersley, Suppl. J.
/// R. Stat. Soc. 8:184, 1946). The sum runs from the nearest points to where ρ falls below two of its standard
/// deviations.
struct Neighbours {
  double nearest = 0;      ///< ρ of each point and the one nearest to it
  double deviation = 0;    ///< of `nearest`, where each errs by itself
  double inflation = 1;    ///< V
  std::size_t points = 0;  ///< residuals

  /// By chance in less than one of 100 000 fields, and by so much that intervals change.
  [[nodiscard]] bool err_together() const {
    return points > 0 && nearest > 0.1 && nearest > 4.5 * deviation && inflation > 1.1;
  }
};

/// A point of a field, and its residual in units of its noise.
struct FieldPoint {
  double x, y, e;
};
using FieldFrame = std::vector<FieldPoint>;  ///< of one step and channel

/// Of large fields every few points i are paired with all j, so that no more than 2e8 pairs are looked at.
Neighbours neighbours(const std::vector<FieldFrame>& frames);

/// What to say of points that err together. A noise that is not stated cannot be multiplied: the cure is another.
execution::Warning neighbours_warning(const std::string& test, const Neighbours& found, bool noise_stated);

/// A warning for each field of the run whose points err together, from its fitted rows; `predictions` of all rows.
void warn_of_neighbours(const assembly::Assembly& assembly, const std::vector<double>& predictions,
                        const std::string& label, std::vector<execution::Warning>& warnings);

}  // namespace tunica::comparison
