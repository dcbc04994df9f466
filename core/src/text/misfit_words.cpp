// SPDX-License-Identifier: Apache-2.0
#include "text/misfit_words.hpp"

#include <fmt/format.h>

namespace tunica::text {

std::string percent(double share) {
  const double value = 100 * share;
  return fmt::format("{:.{}f} %", value, value < 0.995 ? 2 : value < 9.95 ? 1 : 0);
}

std::string misses_by(double rms) { return fmt::format("misses by {} of the range", percent(rms)); }

std::string against_tolerance(double rms, double upper, double tolerance, std::string_view origin) {
  constexpr double nearly = 1.2;
  const char* const reached = upper <= tolerance          ? "reached"
                              : rms <= nearly * tolerance ? "nearly reached"
                                                          : "not reached";
  return fmt::format("tolerance {} ({}): {}", percent(tolerance), origin, reached);
}

}  // namespace tunica::text
