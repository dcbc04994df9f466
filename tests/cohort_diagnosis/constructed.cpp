// SPDX-License-Identifier: Apache-2.0
#include "constructed.hpp"

#include <cmath>

#include <Eigen/Cholesky>

namespace tunica::cohort_diagnosis {

SpecimenEvidence Constructed::specimen(const std::string& id, const std::vector<double>& amplitudes,
                                       std::mt19937_64& random) const {
  const auto count = static_cast<Eigen::Index>(ids.size());
  std::normal_distribution<double> normal;
  Eigen::VectorXd noise(count), effect(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    noise[k] = normal(random);
    effect[k] = amplitudes[static_cast<std::size_t>(k)] * length;
  }
  const Eigen::MatrixXd root = cosines.llt().matrixL();
  const Eigen::VectorXd t = cosines * effect + root * noise;
  SpecimenEvidence found;
  found.id = id;
  found.rows = 50;
  std::vector<std::int32_t> triangle;
  double largest = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    Profile profile;
    profile.id = ids[static_cast<std::size_t>(k)];
    profile.amplitude = "a";
    profile.unit = "1";
    profile.up = Half{t[k], length, static_cast<std::size_t>(k), 1, false, false, t[k]};
    if (two_sided) profile.down = Half{-t[k], length, static_cast<std::size_t>(k), -1, false, false, -t[k]};
    found.profiles.push_back(profile);
    for (Eigen::Index j = 0; j < k; ++j)
      triangle.push_back(static_cast<std::int32_t>(std::lround(cosines(k, j) / Likeness::unit)));
    largest = std::max(largest, std::abs(t[k]));
  }
  found.vectors = ids.size();
  found.likeness = Likeness(std::move(triangle));
  // Calibrated for as many independent scores: the p-value of the largest.
  found.p_value = 1 - std::pow(std::erf(largest / M_SQRT2), static_cast<double>(count));
  found.alarm = found.p_value < 0.05;
  return found;
}

std::vector<SpecimenEvidence> alike(const Constructed& rig, std::size_t count, const std::vector<double>& amplitudes,
                                    std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<SpecimenEvidence> all;
  for (std::size_t s = 0; s < count; ++s) all.push_back(rig.specimen("s" + std::to_string(s + 1), amplitudes, random));
  return all;
}

}  // namespace tunica::cohort_diagnosis
