// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/hypotheses/hypothesis.hpp"
#include "discovery/subject.hpp"

namespace tunica::budget {

/// The registered model that an extension of the base is: it has as many parameters, and where it takes the place of
/// the base with all that was added to it, its fit predicts the same, |Δr|² < 1e-4. Additions to tests stay. Empty
/// where there is none. "gho" of an `hgo` with fibre dispersion.
std::string same_model(const discovery::Subject& subject, const diagnosis::Evidence& evidence,
                       const assembly::Assembly& extended, const diagnosis::Fit& fit,
                       const std::vector<diagnosis::Addition>& additions);

}  // namespace tunica::budget
