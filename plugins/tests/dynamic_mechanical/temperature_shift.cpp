// SPDX-License-Identifier: Apache-2.0
#include "temperature_shift.hpp"

#include <cmath>
#include <limits>

namespace tunica::dynamic_mechanical {

Shift shift_named(const std::string& name) {
  return name == "wlf" ? Shift::wlf : name == "arrhenius" ? Shift::arrhenius : Shift::none;
}

std::vector<Parameter> shift_parameters(Shift shift) {
  const char* const source = "Williams, Landel, Ferry 1955, eq. 6";
  if (shift == Shift::wlf)
    return {{"c1", "1", 8.86, 0, 100, Scale::linear, "First constant of the WLF shift.", source},
            {"c2", "K", 101.6, 1, 1000, Scale::linear, "Second constant of the WLF shift.", source}};
  if (shift == Shift::arrhenius)
    return {{"activation_energy", "kJ/mol", 80, 0, 1000, Scale::linear, "Activation energy of the Arrhenius shift.",
             "Ferry 1980, chapter 11"}};
  return {};
}

double shift_factor(Shift shift, double T, double T0, std::span<const double> parameters) {
  if (shift == Shift::wlf) {
    const double below = parameters[1] + T - T0;
    if (!(below > 0)) return std::numeric_limits<double>::quiet_NaN();
    return std::pow(10, -parameters[0] * (T - T0) / below);
  }
  if (shift == Shift::arrhenius) {
    constexpr double R = 8.31446261815324e-3;  // kJ/(mol K)
    return std::exp(parameters[0] / R * (1 / T - 1 / T0));
  }
  return 1;
}

}  // namespace tunica::dynamic_mechanical
