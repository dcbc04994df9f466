// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "diagnosis/detection/analysis.hpp"
#include "diagnosis/naming/refits.hpp"

namespace tunica::discovery {

/// A mechanism of the catalogue as the only explanation, weighed as sets of terms are.
struct Rival {
  std::string id;
  diagnosis::Place place;
  bool in_the_energy = false;  ///< of the material, and without memory: it may be a name for the missing term
  bool remembers = false;
  double log_evidence = 0;  ///< with the prior
  double log_prior = 0;     ///< the errors of the rig share the weight of the terms
  double chi2 = 0;
  bool clean = false;     ///< what it leaves is noise
  bool plausible = true;  ///< the amplitude is what one would believe
};

/// Every mechanism that could be fitted, likeliest first. The errors of the rig together have the prior weight of the
/// terms together.
std::vector<Rival> rivals_of(const diagnosis::Inquiry& inquiry, const diagnosis::Analysis& analysis);

}  // namespace tunica::discovery
