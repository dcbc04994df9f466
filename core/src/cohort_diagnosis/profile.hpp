// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/result.hpp"

namespace tunica::cohort_diagnosis {

/// What one specimen says of an amplitude on one side of its null, with all its parameters fitted again at each value.
/// With y ≥ 0 the distance from the null (of even mechanisms its square), twice the logarithm of the likelihood over
/// that of the base is
///
///   2 ℓ(y) = 2 t a y − (a y)²,   t = s̃ᵀr/|s̃|, a = |s̃|
///
/// in the linearisation. Where the specimen was fitted at finite amplitude ŷ, gaining G of |r|², the parabola is the
/// one with that maximum: t = √G, a = √G/ŷ.
struct Half {
  double t = 0, length = 0;
  std::size_t vector = 0;  ///< the unit vector of the specimen's residuals along which the amplitude shows
  double sign = 1;         ///< on it
  bool refitted = false;
  bool apart = false;  ///< of a row that no fit sees: the vector is zero, and nothing else looks like it
  double shown = 0;    ///< along that vector, of the residuals: t where nothing was fitted again
  std::optional<std::size_t> left = {};  ///< refitted: which entry of SpecimenEvidence::left is what it leaves

  bool operator==(const Half&) const = default;
};

/// A mechanism in one place, with given nuisance parameters, as one specimen sees it. `up`: amplitudes above the null.
struct Profile {
  std::string id;
  diagnosis::Place place;
  std::vector<std::pair<std::string, double>> setting;
  std::string amplitude, unit;  ///< name of the amplitude, and its unit
  double null = 0;
  bool even = false;
  std::optional<Half> up, down;

  bool operator==(const Profile&) const = default;
  /// The same for the same mechanism, place and setting in every specimen.
  [[nodiscard]] std::string key() const;
  /// The key without the setting.
  [[nodiscard]] std::string key_of_place() const;
  /// Gain of |r|² at its best amplitude on an admissible side, and that amplitude's signed distance from the null (of
  /// even mechanisms its square).
  [[nodiscard]] double gain() const;
  [[nodiscard]] double distance() const;
  /// The half on the side of the best amplitude: `up` where neither gains.
  [[nodiscard]] const Half& active() const;
  [[nodiscard]] double side() const;  ///< of active(): 1 or −1
};

/// A distance of profiles as an amplitude.
double amplitude_at(const Profile& profile, double distance);

}  // namespace tunica::cohort_diagnosis
