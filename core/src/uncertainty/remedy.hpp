// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"

namespace tunica::uncertainty {

/// The experiment that would determine a direction left free by the tests of a run, if the model does not name one.
///
/// Of some tests with prescribed deformation in the plane of the wall – a sheet stretched equally both ways, along one
/// axis at fixed length of the other, and at 45° to the axes – up to the largest stretch of the run, the one whose
/// stresses change most along the direction, to first order and relative to their largest value:
///
///   s = max_i |∂S_i/∂p · d| / max_i |S_i|,   S the in-plane stress with S_rr = 0, that is S − S_rr C_rr C⁻¹.
///
/// The present tests have such an s too, of their predictions; a test that does not see the direction at least three
/// times as well is not recommended. With several directions it must see each. One or two sentences that begin with a
/// space. `steps` are changes of the free parameters in base units, one vector a direction.
std::string remedy_in_words(const assembly::Assembly& assembly, std::span<const double> free,
                            const std::vector<std::vector<double>>& steps);

}  // namespace tunica::uncertainty
