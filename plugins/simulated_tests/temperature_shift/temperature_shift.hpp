// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "tunica/options.hpp"
#include "tunica/parameter.hpp"

namespace tunica::temperature_shift {

/// Time–temperature superposition: an oscillation of frequency f at temperature T is one of a_T f at T0, and a time t
/// is one of t/a_T.
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
/// ∂ ln a_T/∂p_j of each parameter of the shift.
std::vector<double> shift_slopes(Shift shift, double T, double T0, std::span<const double> parameters);
/// The options "shift" and "reference_temperature".
std::array<Option, 2> shift_options();

}  // namespace tunica::temperature_shift
