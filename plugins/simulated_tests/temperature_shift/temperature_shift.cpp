// SPDX-License-Identifier: Apache-2.0
#include "temperature_shift.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace tunica::temperature_shift {
namespace {

constexpr double gas_constant = 8.31446261815324e-3;  // kJ/(mol K)

}  // namespace

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
    return std::exp(parameters[0] / gas_constant * (1 / T - 1 / T0));
  }
  return 1;
}

std::vector<double> shift_slopes(Shift shift, double T, double T0, std::span<const double> parameters) {
  if (shift == Shift::wlf) {
    const double below = parameters[1] + T - T0;
    return {-std::numbers::ln10 * (T - T0) / below, std::numbers::ln10 * parameters[0] * (T - T0) / (below * below)};
  }
  if (shift == Shift::arrhenius) return {(1 / T - 1 / T0) / gas_constant};
  return {};
}

std::array<Option, 2> shift_options() {
  return {Option::choice("shift", {"none", "wlf", "arrhenius"}, "none",
                         "How the temperature shifts times: time-temperature superposition."),
          Option::quantity("reference_temperature", "K", 0, "Temperature at which nothing is shifted.", 0.0)};
}

}  // namespace tunica::temperature_shift
