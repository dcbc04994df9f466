// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "uncertainty/identifiability.hpp"

namespace tunica::uncertainty {

/// "The data do not fix A, B and theta separately: they fix 2A + B = 0.797 ± 0.004 and …; one direction (A +0.31,
/// B -0.62) changes no prediction. An off-axis strip would fix it."
std::string in_words(const Valley& valley, const std::vector<ParameterInterval>& parameters, const std::string& remedy);

/// "kappa = 0 is at a bound: …", or empty when none is.
std::string bounds_in_words(const std::vector<ParameterInterval>& parameters);

/// A value with the digits that its uncertainty leaves: "0.7967 ± 0.0041 kPa".
std::string with_uncertainty(double value, double half_width, const std::string& unit);

}  // namespace tunica::uncertainty
