// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/valley_words.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include "text/units.hpp"

namespace tunica::uncertainty {
namespace {

std::string unit_of(const std::string& name, const std::vector<ParameterInterval>& parameters) {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const ParameterInterval& candidate) { return candidate.name == name; });
  return found == parameters.end() ? "" : text::unit_suffix(found->unit);
}

/// "a", "a and b", "a, b and c"
std::string enumerate(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (k > 0) text += k + 1 == words.size() ? " and " : ", ";
    text += words[k];
  }
  return text;
}

std::string number_word(std::size_t count) {
  static const char* const words[] = {"no", "one", "two", "three", "four", "five", "six"};
  return count < std::size(words) ? words[count] : std::to_string(count);
}

std::string direction_text(const std::vector<std::pair<std::string, double>>& direction,
                           const std::vector<ParameterInterval>& parameters) {
  std::vector<std::string> steps;
  for (const auto& [name, change] : direction)
    steps.push_back(fmt::format("{} {:+.3g}{}", name, change, unit_of(name, parameters)));
  std::string text;
  for (const std::string& step : steps) text += (text.empty() ? "" : ", ") + step;
  return text;
}

}  // namespace

std::string with_uncertainty(double value, double half_width, const std::string& unit) {
  if (!(half_width > 0) || !std::isfinite(half_width)) return fmt::format("{:.6g}{}", value, text::unit_suffix(unit));
  // Two digits of the uncertainty, and the value to the same place, but never more digits than a double has.
  const int place = std::clamp(1 - static_cast<int>(std::floor(std::log10(half_width))), 0, 15);
  const int digits = static_cast<int>(std::floor(std::log10(std::max(std::abs(value), 1e-300))));
  if (place + digits > 9) return fmt::format("{:.9g} ± {:.1g}{}", value, half_width, text::unit_suffix(unit));
  if (half_width >= 100) return fmt::format("{:.4g} ± {:.2g}{}", value, half_width, text::unit_suffix(unit));
  // A wide interval must not round a value away that others publish: at least four digits of it.
  const int value_place = std::clamp(3 - digits, place, std::max(place, 6));
  return fmt::format("{:.{}f} ± {:.{}f}{}", value, value_place, half_width, place, text::unit_suffix(unit));
}

std::string in_words(const Valley& valley, const std::vector<ParameterInterval>& parameters,
                     const std::string& remedy) {
  std::string text;
  if (valley.parameters.size() == 1) {
    text = fmt::format("The data do not fix {}", valley.parameters.front());
  } else {
    text = fmt::format("The data do not fix {} separately", enumerate(valley.parameters));
  }
  if (!valley.fixed.empty()) {
    std::vector<std::string> known;
    for (const FixedCombination& fixed : valley.fixed) {
      known.push_back(fmt::format("{} = {}", fixed.name, with_uncertainty(fixed.value, fixed.ci95, fixed.unit)));
    }
    text += ": they fix " + enumerate(known) + ";";
  } else {
    text += ":";
  }
  std::vector<std::string> directions;
  for (const auto& direction : valley.directions)
    directions.push_back(fmt::format("({})", direction_text(direction, parameters)));
  const bool single = directions.size() == 1;
  text += fmt::format(" {} direction{} {} ", number_word(directions.size()), single ? "" : "s", enumerate(directions));
  if (valley.exact) {
    text += single ? "changes no prediction." : "change no prediction.";
  } else {
    text += single ? "changes the predictions so little that its uncertainty exceeds the bounds."
                   : "change the predictions so little that their uncertainty exceeds the bounds.";
  }
  if (!remedy.empty()) {
    std::string start = remedy;
    start[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(start[0])));
    text += fmt::format(" {} would fix {}.", start, single ? "it" : "them");
  }
  return text;
}

std::string bounds_in_words(const std::vector<ParameterInterval>& parameters) {
  std::string text;
  for (const bool natural : {false, true}) {
    std::vector<std::string> names;
    for (const ParameterInterval& parameter : parameters)
      if (parameter.at_bound && parameter.natural == natural)
        names.push_back(
            fmt::format("{} = {:.6g}{}", parameter.name, parameter.value, text::unit_suffix(parameter.unit)));
    if (names.empty()) continue;
    if (!text.empty()) text += ' ';
    const bool single = names.size() == 1;
    if (natural)
      text += fmt::format("{} {} at the natural end of {} range: there is nothing to widen, and no interval.",
                          enumerate(names), single ? "lies" : "lie", single ? "its" : "their");
    else
      text += fmt::format("{} {} at {}: widen {} where that is physical, or read the value{} as imposed, not found.",
                          enumerate(names), single ? "lies" : "lie", single ? "a bound" : "bounds",
                          single ? "it" : "them", single ? "" : "s");
  }
  return text;
}

}  // namespace tunica::uncertainty
