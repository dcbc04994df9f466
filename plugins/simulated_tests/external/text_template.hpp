// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tunica::external {

/// A text with places: "{{mu}}", "{{mu MPa}}" with a unit, "{{card}}". Everything else stays as it is, braces too.
class TextTemplate {
 public:
  struct Place {
    std::string name, unit;  ///< unit: empty = the base unit
  };
  explicit TextTemplate(std::string_view text);

  [[nodiscard]] const std::vector<Place>& places() const { return places_; }
  /// The text with `value` of each place written in.
  [[nodiscard]] std::string filled(const std::function<std::string(const Place&)>& value) const;

 private:
  std::vector<std::string> pieces_;  ///< around the places: one more than they are
  std::vector<Place> places_;
};

/// A number as solvers read it: the shortest text that is exact, with fewer digits where it has more than 19
/// characters, which is what the fields of CalculiX and Abaqus hold; twelve digits or more.
std::string number(double value);

}  // namespace tunica::external
