// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../plane_elements/membrane.hpp"
#include "meshed.hpp"

namespace tunica::field {

/// Displacements of every step, by dof, of a neo-Hookean sheet between the measured edges: what the field would be
/// about where no point lies, as along a hole. Its ratio λ/μ is the one of a few that comes closest to the first step.
/// `faces` is `held` in plane strain. Empty where no equilibrium is found.
std::vector<std::vector<double>> reference_fields(const Meshed& on, bool plane_strain);

}  // namespace tunica::field
