// SPDX-License-Identifier: Apache-2.0
#include "data/units.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "data/quantities.hpp"
#include "diagnosis/file/changes.hpp"
#include "diagnosis/file/correction.hpp"
#include "text/lists.hpp"
#include "tunica/error.hpp"

namespace tunica::diagnosis {
namespace {

/// The factor on numbers whose unit, area or prefix differs from the file's statement.
constexpr std::array factors{
    1000.0, 9.80665, 10.0, 10.19716, 7.500617, 6.894757, 4.448222, 4.0, 2.0, 1.359510, 4 / 3.14159265358979};

constexpr std::array stress_units{"Pa", "kPa", "MPa", "mmHg", "cmH2O", "psi", "bar", "mbar", "kgf/cm2", "gf/mm2"},
    force_units{"mN", "N", "gf", "kgf", "lbf", "uN", "kN", "cN", "ozf", "mgf"},
    length_units{"mm", "um", "cm", "m", "in", "nm", "dm", "km", "ft", "pm"};

/// Numbers of a test that share a unit.
struct Numbers {
  std::string name;                   ///< "stresses"
  std::vector<std::string> channels;  ///< those that are channels
  std::string abscissa = {};          ///< or an abscissa
};

/// The unit that differs by the factor from the column's declared unit; none if no usual unit does.
std::optional<std::string> unit_of_factor(const std::string& stated, double factor) {
  constexpr double as_good_as = 0.001;
  for (const auto* const units : {&stress_units, &force_units, &length_units})
    for (const char* const unit : *units) try {
        if (std::abs(data::convert(1, unit, stated) / factor - 1) < as_good_as) return unit;
      } catch (const InputError&) {
        break;  // it measures something else
      }
  return std::nullopt;
}

/// The columns of a test that hold these numbers, and the unit that makes the factor out of the one that all of them
/// are said to have.
struct Columns {
  std::vector<std::string> names;
  std::optional<std::string> unit;
};

Columns columns_of(const Record& record, const std::string& test, const Numbers& numbers, double factor) {
  const experiment::TestEntry& entry = record.test(test);
  Columns found;
  std::set<std::string> units;
  for (const auto& [name, column] : entry.data.columns) {
    const auto quantity = data::quantity_named(name, record.observables(entry.name));
    if (!quantity) continue;
    const std::string& observable = quantity->observable->name;
    if (observable != numbers.abscissa &&
        std::find(numbers.channels.begin(), numbers.channels.end(), observable) == numbers.channels.end())
      continue;
    found.names.push_back(column);
    std::string stated = quantity->unit;
    for (const auto& [source, from] : record.data(entry.name).source_columns)
      if (source == observable && !from.second.empty()) stated = from.second;
    for (const auto& [named, own] : entry.data.layout.units)
      if (named == column) stated = own;
    units.insert(stated);
  }
  if (units.size() == 1) found.unit = unit_of_factor(*units.begin(), factor);
  return found;
}

std::string mending(const Record& record, const std::vector<std::string>& tests, const Numbers& numbers,
                    double factor) {
  const Columns columns = columns_of(record, tests.front(), numbers, factor);
  const std::string where = fmt::format("{} of {}", quoted(columns.names), quoted(tests));
  return columns.unit ? fmt::format("the unit {} for {}, in its header or with \"units\"", *columns.unit, where)
                      : fmt::format("{} times {:.6g}: in a unit, an area or a thickness", where, factor);
}

/// Another unit in each test; none if one of them has no unit with this factor, or cannot have it.
std::vector<Change> changes_of(const Record& record, const std::vector<std::string>& tests, const Numbers& numbers,
                               double factor) {
  std::vector<Change> changes;
  for (const std::string& test : tests) {
    const Columns columns = columns_of(record, test, numbers, factor);
    if (!columns.unit || !change_units(record.test(test), columns.names, *columns.unit, changes)) return {};
  }
  return changes;
}

std::string scaled_words(const std::vector<std::string>& tests, const Numbers& numbers, double factor) {
  return factor >= 1
             ? fmt::format("the {} of {} are {:.6g} times what the file says", numbers.name, quoted(tests), factor)
             : fmt::format("the {} of {} are 1/{:.6g} of what the file says", numbers.name, quoted(tests), 1 / factor);
}

void add_ladder(const Record& record, const std::vector<std::string>& tests, bool common, const Numbers& numbers,
                Corrections& all) {
  for (const double up : factors)
    for (const double factor : {up, 1 / up}) {
      all.push_back(
          {FileKind::unit, tests, common, scaled_words(tests, numbers, factor), mending(record, tests, numbers, factor),
           [tests, numbers, factor](Record& read) {
             for (const std::string& test : tests) {
               if (!numbers.abscissa.empty() &&
                   !read.map_abscissa(test, numbers.abscissa, [&](double value) { return factor * value; }))
                 return false;
               for (const std::string& channel : numbers.channels)
                 if (channel_of(read.data(test), channel) != nullptr && !read.scale_channel(test, channel, factor))
                   return false;
             }
             return true;
           },
           0, fmt::format("{} of {}", numbers.name, text::joined(tests)), std::log(factor)});
      all.back().changes = changes_of(record, tests, numbers, factor);
    }
}

std::vector<std::string> channels_with_unit(const Record& record, const std::string& test, std::string_view unit) {
  std::vector<std::string> names;
  for (const data::Channel& channel : record.data(test).channels)
    if (channel.unit == unit) names.push_back(channel.observable);
  return names;
}

/// What has units of its own in a test: stresses, forces, lengths, pressures.
std::vector<Numbers> numbers_in(const Record& record, const std::string& test) {
  std::vector<Numbers> found;
  if (auto stresses = channels_with_unit(record, test, "kPa"); !stresses.empty())
    found.push_back({"stresses", std::move(stresses)});
  if (auto forces = channels_with_unit(record, test, "mN"); !forces.empty())
    found.push_back({"forces", std::move(forces)});
  if (abscissa_of(record.data(test), "pressure") != nullptr) found.push_back({"pressures", {}, "pressure"});
  return found;
}

/// The stresses of all tests, whatever their type; none where a test has other numbers that set the scale.
void add_all_stresses(const Record& record, const std::vector<std::string>& tests, Corrections& all) {
  Numbers stresses{"stresses", {}};
  for (const std::string& test : tests) {
    const std::vector<Numbers> found = numbers_in(record, test);
    if (found.size() != 1 || found.front().name != "stresses") return;
    for (const std::string& channel : found.front().channels)
      if (std::find(stresses.channels.begin(), stresses.channels.end(), channel) == stresses.channels.end())
        stresses.channels.push_back(channel);
  }
  add_ladder(record, tests, true, stresses, all);
}

}  // namespace

void add_units(const Record& record, const std::vector<std::string>& tests, bool scale_is_seen, Corrections& all) {
  std::vector<std::string> types;
  for (const std::string& test : tests)
    if (std::find(types.begin(), types.end(), record.test(test).type) == types.end())
      types.push_back(record.test(test).type);
  if (scale_is_seen) add_all_stresses(record, tests, all);
  for (const std::string& type : types) {
    std::vector<std::string> alike;
    for (const std::string& test : tests)
      if (record.test(test).type == type) alike.push_back(test);
    for (const Numbers& numbers : numbers_in(record, alike.front())) {
      // All stresses there are: their scale is that of the moduli.
      const bool whole = types.size() == 1 && numbers.name == "stresses";
      if (!whole && alike.size() > 1) add_ladder(record, alike, true, numbers, all);
    }
    for (const std::string& test : alike)
      for (const Numbers& numbers : numbers_in(record, test)) {
        if (tests.size() > 1 || numbers.name != "stresses") add_ladder(record, {test}, false, numbers, all);
        if (numbers.channels.size() < 2) continue;
        for (const std::string& channel : numbers.channels)
          add_ladder(record, {test}, false, {fmt::format("values of {}", channel), {channel}}, all);
      }
  }
}

}  // namespace tunica::diagnosis
