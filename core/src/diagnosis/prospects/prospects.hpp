// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "diagnosis/naming/explanation.hpp"

namespace tunica::diagnosis {

/// The value of the explanation, the effects that could still be hidden, and the next step.
struct Prospects {
  std::optional<Gain> gain;  ///< of the extension, where there is one
  std::vector<Detectable> detectable;
  std::optional<NextExperiment> next;
  std::vector<Warning> warnings;  ///< about a run of the extension, and about the noise
};

Prospects prospects_of(const Inquiry& inquiry, const Analysis& analysis, const Explanation& explanation);

}  // namespace tunica::diagnosis
