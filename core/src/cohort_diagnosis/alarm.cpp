// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/alarm.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/distributions.hpp"

namespace tunica::cohort_diagnosis {

double p_of_cohort(const Specimens& specimens) {
  constexpr double least = 1e-12;  // no calibration says more
  double sum = 0;
  for (const SpecimenEvidence* one : specimens) sum -= 2 * std::log(std::clamp(one->p_value, least, 1.0));
  return sum > 0 ? numerics::chi_squared_above(sum, 2 * static_cast<double>(specimens.size())) : 1;
}

}  // namespace tunica::cohort_diagnosis
