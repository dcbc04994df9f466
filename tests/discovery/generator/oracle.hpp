// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "sealed_case.hpp"

namespace blind {

/// What the data allow to whoever knows the noise and the base parameters: the scores of the method – a smooth omnibus
/// and the largest projected score of the catalogue, calibrated jointly – at the truth, on the very data of the case.
struct OracleVerdict {
  double p_value = 1;
  bool detected = false;                   ///< at 5 %
  std::string first;                       ///< the likeliest effect
  std::map<std::string, double> likeness;  ///< of other effects to it on these data: largest correlations above 0.9
};
OracleVerdict ask_oracle(const SealedCase& made);

}  // namespace blind
