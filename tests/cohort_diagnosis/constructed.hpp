// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>
#include <vector>

#include "cohort_diagnosis/combination.hpp"

namespace tunica::cohort_diagnosis {

/// Evidence of specimens as it would be if all were linear: mechanisms "first", "second", … with given cosines between
/// what they leave, amplitudes that are there, and unit noise.
struct Constructed {
  std::vector<std::string> ids{"first", "second", "third"};
  Eigen::MatrixXd cosines = Eigen::MatrixXd::Identity(3, 3);
  bool two_sided = true;
  double length = 2;  ///< |s̃| of every mechanism

  /// A specimen in which the mechanisms have these amplitudes.
  [[nodiscard]] SpecimenEvidence specimen(const std::string& id, const std::vector<double>& amplitudes,
                                          std::mt19937_64& random) const;
};

/// s1, s2, …, all with these amplitudes.
std::vector<SpecimenEvidence> alike(const Constructed& rig, std::size_t count, const std::vector<double>& amplitudes,
                                    std::uint64_t seed);

}  // namespace tunica::cohort_diagnosis
