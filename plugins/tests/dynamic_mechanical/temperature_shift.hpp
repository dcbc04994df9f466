// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "tunica/parameter.hpp"

namespace tunica::dynamic_mechanical {

/// Time–temperature superposition: an oscillation of frequency f at temperature T is one of a_T f at T0.
///
///     WLF:        log10 a_T = −C1 (T − T0)/(C2 + T − T0)
///     Arrhenius:  ln a_T = E/R (1/T − 1/T0)
///
/// (Williams, Landel, Ferry, J. Am. Chem. Soc. 77:3701, 1955, eq. 6; Ferry 1980, chapter 11)
enum class Shift { none, wlf, arrhenius };

Shift shift_named(const std::string& name);
/// The parameters of a shift: C1 and C2, or E.
std::vector<Parameter> shift_parameters(Shift shift);
/// a_T at temperature T with reference T0, both in K. Not finite, or not above 0, where the law has no value.
double shift_factor(Shift shift, double T, double T0, std::span<const double> parameters);

}  // namespace tunica::dynamic_mechanical
