// SPDX-License-Identifier: Apache-2.0
#include "data/units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <udunits2.h>

#include "data/nearest.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

const std::vector<std::string> common_units = {
    "kPa",  "Pa",    "hPa",    "MPa",     "GPa",   "mmHg",   "cmH2O", "bar",   "mbar",   "psi",      "N/mm2",
    "N/m2", "N/cm2", "gf/mm2", "kgf/cm2", "mm",    "um",     "nm",    "cm",    "m",      "in",       "mN",
    "uN",   "N",     "kN",     "gf",      "kgf",   "lbf",    "s",     "ms",    "min",    "h",        "Hz",
    "1/s",  "%/s",   "1/min",  "%/min",   "mm/s",  "mm/min", "um/s",  "kPa/s", "mmHg/s", "mmHg/min", "deg",
    "rad",  "1",     "%",      "N/m",     "mN/mm", "mm2",    "mm3"};

// "-" is how data files say "no unit".
std::string_view spelling(std::string_view unit) {
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
  while (!unit.empty() && unit.back() == ' ') unit.remove_suffix(1);
  return unit.empty() || unit == "-" || unit == "–" ? std::string_view("1") : unit;
}

// UDUNITS stops at an unbalanced bracket without an error, and reads "s since 2000-01-01" as a date.
bool well_formed(std::string_view unit) {
  int depth = 0;
  for (const char c : unit) {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    const auto byte = static_cast<unsigned char>(c);
    const bool usual =
        std::isalnum(byte) || byte >= 0x80 || std::string_view(" %/*^-+.()_").find(c) != std::string_view::npos;
    if (depth < 0 || !usual) return false;
  }
  return depth == 0 && unit.size() <= 100 && unit.find('@') == std::string_view::npos &&
         unit.find("since") == std::string_view::npos;
}

/// The unit system with the spellings of this field added. UDUNITS is not thread-safe and never shares its objects
/// here: every access holds the mutex.
class UnitSystem {
 public:
  static UnitSystem& instance() {
    static UnitSystem system;  // lives to the end of the process; parse results are cached in it
    return system;
  }

  bool knows(std::string_view unit) {
    const std::scoped_lock lock(mutex_);
    return find(spelling(unit)) != nullptr;
  }

  double convert(double value, std::string_view from, std::string_view to) {
    if (from == to) return value;
    const std::scoped_lock lock(mutex_);
    const auto key = std::make_pair(std::string(spelling(from)), std::string(spelling(to)));
    auto found = affine_.find(key);
    if (found == affine_.end()) found = affine_.emplace(key, affine(key.first, key.second)).first;
    return found->second.first * value + found->second.second;
  }

 private:
  UnitSystem() {
    ut_set_error_message_handler(ut_ignore);  // messages are ours
    system_ = ut_read_xml(nullptr);
    if (system_ == nullptr)
      throw InputError(
          "the units database of UDUNITS-2 was not found. Install the Debian package libudunits2-data, or let "
          "UDUNITS2_XML_PATH name its file udunits2.xml.");
    const Unit degree(ut_parse(system_, "arc_degree", UT_UTF8));
    if (degree) ut_map_symbol_to_unit("deg", UT_ASCII, degree.get());
  }

  const ut_unit* find(std::string_view unit) {
    const auto cached = units_.find(unit);
    if (cached != units_.end()) return cached->second.get();
    Unit parsed(well_formed(unit) ? ut_parse(system_, std::string(unit).c_str(), UT_UTF8) : nullptr);
    return units_.emplace(std::string(unit), std::move(parsed)).first->second.get();
  }

  const ut_unit* require(const std::string& unit) {
    const ut_unit* found = find(unit);
    if (found == nullptr)
      throw InputError(
          fmt::format("unknown unit '{}'. {}Units are spelled as in UDUNITS-2, for example kPa, MPa, mmHg, "
                      "N/mm2, mm, um, mN, s, min, 1/s, deg, %.",
                      excerpt(unit), question(unit)));
    return found;
  }

  static std::string question(std::string_view unit) {
    const std::string near = nearest(unit, common_units);
    return near.empty() ? "" : fmt::format("Did you mean '{}'? ", near);
  }

  // For UDUNITS a radian is the number 1 and a second is convertible to a hertz; to a person who writes one where the
  // other belongs both are mistakes.
  static bool is_angle(const ut_unit* unit) {
    char text[256];
    const int length = ut_format(unit, text, sizeof text, UT_ASCII | UT_DEFINITION);
    if (length < 0 || length >= static_cast<int>(sizeof text)) return false;
    return std::string_view(text, static_cast<std::size_t>(length)).find("rad") != std::string_view::npos;
  }

  static bool same_dimension(const ut_unit* a, const ut_unit* b) {
    const Unit ratio(ut_divide(a, b));
    return ratio && ut_is_dimensionless(ratio.get()) != 0 && is_angle(a) == is_angle(b);
  }

  std::pair<double, double> affine(const std::string& from, const std::string& to) {
    const ut_unit *source = require(from), *target = require(to);
    struct Free {
      void operator()(cv_converter* converter) const { cv_free(converter); }
    };
    const std::unique_ptr<cv_converter, Free> converter(
        same_dimension(source, target) ? ut_get_converter(const_cast<ut_unit*>(source), const_cast<ut_unit*>(target))
                                       : nullptr);
    if (!converter)
      throw InputError(
          fmt::format("the unit '{}' cannot be converted to '{}': they measure different things", excerpt(from), to));
    const double offset = cv_convert_double(converter.get(), 0);
    return {without_rounding(cv_convert_double(converter.get(), 1) - offset), offset};
  }

  // Factors are decimal numbers by definition; the last-place error of the way through SI units is taken off, so that
  // 1 mmHg is 0.133322387415 kPa to the bit. Factors with π are farther from a short decimal and stay.
  static double without_rounding(double factor) {
    const std::string digits = fmt::format("{:.15g}", factor);
    double decimal = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), decimal);
    return std::abs(decimal - factor) <= 2.5e-16 * std::abs(factor) ? decimal : factor;
  }

  std::mutex mutex_;
  ut_system* system_ = nullptr;
  std::map<std::string, Unit, std::less<>> units_;
  std::map<std::pair<std::string, std::string>, std::pair<double, double>> affine_;
};

}  // namespace

double convert(double value, std::string_view from, std::string_view to) {
  return UnitSystem::instance().convert(value, from, to);
}

bool is_unit(std::string_view unit) { return UnitSystem::instance().knows(unit); }

double parse_quantity(std::string_view text, std::string_view base_unit) {
  const auto refuse = [&](std::string_view reason) -> double {
    throw InputError(fmt::format("'{}' is not a quantity: {}. Expected a number and a unit, for example \"1.5 {}\".",
                                 excerpt(text), reason, base_unit == "1" ? "%" : base_unit));
  };
  std::string_view rest = text;
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  if (rest.starts_with('+')) rest.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error == std::errc::result_out_of_range) return refuse("the number is too large or too small");
  if (error != std::errc()) return refuse("it does not begin with a number");
  if (!std::isfinite(value)) return refuse("the number is not finite");
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  while (!rest.empty() && rest.back() == ' ') rest.remove_suffix(1);
  if (rest.empty()) return value;
  if (rest.front() == ',') return refuse("a decimal comma is not read here, write a point");
  // "0.01/s": the number belongs to the unit 1/s.
  const std::string unit = fmt::format("{}{}", rest.front() == '/' ? "1" : "", rest);
  if (std::string_view("0123456789.+*").find(unit.front()) != std::string_view::npos && rest.front() != '/')
    return refuse(fmt::format("'{}' follows the number", excerpt(rest)));
  const double converted = convert(value, unit, base_unit);
  if (!std::isfinite(converted)) return refuse("the number is too large");
  return converted;
}

std::string unit_in_name(const std::string& name, std::string_view base) {
  constexpr std::array<std::string_view, 15> usual{"N",  "mN", "kN", "uN", "Pa", "kPa", "MPa", "mmHg",
                                                   "mm", "um", "cm", "ms", "s",  "min", "deg"};
  const std::size_t at = name.find_last_of("_/");
  if (at == std::string::npos || at == 0 || base == "1") return {};
  const std::string unit = name.substr(at + 1);
  if (std::find(usual.begin(), usual.end(), unit) == usual.end()) return {};
  try {
    (void)convert(1, unit, base);
    return unit;
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace tunica::data
