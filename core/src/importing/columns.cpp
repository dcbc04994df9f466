// SPDX-License-Identifier: Apache-2.0
#include "importing/columns.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "data/row_choice.hpp"
#include "data/table_place.hpp"
#include "data/units.hpp"
#include "tunica/error.hpp"

namespace tunica::importing {
namespace {

constexpr std::size_t values_kept = 50;

/// A quantity, what its columns are called, and the base unit that its unit must convert to. The first that fits.
struct Word {
  const char* part;  ///< of the name in small letters; a single letter or two must be a word of its own
  const char* quantity;
  const char* base;
};
constexpr Word words[] = {{"cycle", "cycle", "1"},
                          {"zyklus", "cycle", "1"},
                          {"outer_diameter", "outer_diameter", "mm"},
                          {"outer diameter", "outer_diameter", "mm"},
                          {"od", "outer_diameter", "mm"},
                          {"inner_diameter", "inner_diameter", "mm"},
                          {"inner diameter", "inner_diameter", "mm"},
                          {"id", "inner_diameter", "mm"},
                          {"diameter", "outer_diameter", "mm"},
                          {"pressure", "pressure", "kPa"},
                          {"druck", "pressure", "kPa"},
                          {"stretch", "stretch", "1"},
                          {"lambda", "stretch", "1"},
                          {"strain", "strain", "1"},
                          {"dehnung", "strain", "1"},
                          {"stress", "stress", "kPa"},
                          {"spannung", "stress", "kPa"},
                          {"force", "force", "mN"},
                          {"load", "force", "mN"},
                          {"kraft", "force", "mN"},
                          {"transducer", "force", "mN"},
                          {"balance", "force", "mN"},
                          {"displacement", "displacement", "mm"},
                          {"extension", "displacement", "mm"},
                          {"elongation", "displacement", "mm"},
                          {"travel", "displacement", "mm"},
                          {"stroke", "displacement", "mm"},
                          {"crosshead", "displacement", "mm"},
                          {"position", "displacement", "mm"},
                          {"weg", "displacement", "mm"},
                          {"length", "length", "mm"},
                          {"size", "length", "mm"},
                          {"time", "time", "s"},
                          {"zeit", "time", "s"},
                          {"t", "time", "s"}};

std::string small(std::string_view text) {
  std::string letters(text);
  std::transform(letters.begin(), letters.end(), letters.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return letters;
}

bool is_letter(char letter) { return std::isalpha(static_cast<unsigned char>(letter)) != 0; }

/// A short word must stand alone: "od" is not in "model".
bool has_word(const std::string& name, std::string_view part) {
  const std::size_t at = name.find(part);
  if (at == std::string::npos || part.size() > 2) return at != std::string::npos;
  const std::size_t end = at + part.size();
  return (at == 0 || !is_letter(name[at - 1])) && (end == name.size() || !is_letter(name[end]));
}

/// "N" of "Force_N", "Force / N", "Kraft in N".
std::string tail(const std::string& name) {
  const std::size_t at = name.find_last_of(" _/,");
  return at == std::string::npos ? "" : name.substr(at + 1);
}

/// The unit in the last word of a name; capitals do not matter where only the other spelling is one.
std::optional<std::string> unit_in_name(const std::string& name, std::string_view base) {
  const std::string last = tail(name);
  for (const std::string& spelling : {last, small(last)})
    if (!spelling.empty() && measures(spelling, base)) return spelling;
  return std::nullopt;
}

std::string direction_in(const std::string& name) {
  if (name.find("circ") != std::string::npos || has_word(name, "x")) return "circumferential";
  if (name.find("axial") != std::string::npos || name.find("long") != std::string::npos || has_word(name, "y"))
    return "axial";
  return {};
}

void guess_quantity(ColumnGuess& guess, const std::string& title) {
  const std::string name = small(title);
  for (const Word& word : words) {
    if (!has_word(name, word.part)) continue;
    if (!guess.unit.empty() && !measures(guess.unit, word.base)) continue;
    guess.quantity = word.quantity;
    guess.direction = direction_in(name);
    const auto unit = guess.unit.empty() ? unit_in_name(title, word.base) : std::nullopt;
    if (unit && *unit != "1") {
      guess.unit = *unit;
      guess.unit_from_name = true;
    }
    return;
  }
  // A name that says nothing: the unit may.
  for (const auto& [base, quantity] : {std::pair{"mN", "force"}, std::pair{"s", "time"}})
    if (!guess.unit.empty() && measures(guess.unit, base)) guess.quantity = quantity;
}

bool has(const std::vector<ColumnGuess>& columns, std::string_view quantity, std::string_view direction = {}) {
  return std::any_of(columns.begin(), columns.end(), [&](const ColumnGuess& column) {
    return column.quantity == quantity && (direction.empty() || column.direction == direction);
  });
}

}  // namespace

bool measures(std::string_view unit, std::string_view base) {
  if (base == "mN" && (unit == "g" || unit == "kg" || unit == "mg")) return true;
  try {
    static_cast<void>(data::convert(1, unit, base));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::vector<ColumnGuess> guess_columns(const data::Csv& csv) {
  csv.require_utf8(false);  // the proposal names them
  std::vector<ColumnGuess> guesses;
  for (std::size_t k = 0; k < csv.columns.size(); ++k) {
    const data::Csv::Column& column = csv.columns[k];
    ColumnGuess guess;
    guess.name = column.name;
    guess.unit = column.unit.value_or("");
    std::size_t numbers = 0, filled = 0;
    std::set<std::string> seen;
    for (const data::Csv::Row& row : csv.rows) {
      const std::string& cell = row.cells[k];
      if (cell.empty()) continue;
      ++filled;
      numbers += data::looks_like_number(cell, csv.delimiter != ',') ? 1 : 0;
      if (guess.values.size() < values_kept && seen.insert(cell).second) guess.values.push_back(cell);
    }
    guess.numeric = filled > 0 && 10 * numbers >= 9 * filled;
    if (guess.numeric) {
      guess.values.clear();
      guess_quantity(guess, column.text);
    }
    guesses.push_back(std::move(guess));
  }
  return guesses;
}

bool counts_cycles(const ColumnGuess& column) {
  if (column.numeric) return column.quantity == "cycle";
  const std::string name = small(column.name);
  return column.values.size() > 1 && (has_word(name, "cycle") || has_word(name, "zyklus")) &&
         std::all_of(column.values.begin(), column.values.end(),
                     [](const std::string& value) { return data::first_number(value).has_value(); });
}

std::string likely_test(const std::vector<ColumnGuess>& columns) {
  if (has(columns, "pressure") && (has(columns, "outer_diameter") || has(columns, "inner_diameter")))
    return "thick_wall_pressurisation";
  for (const char* measured : {"force", "stress"})
    if (has(columns, measured, "circumferential") && has(columns, measured, "axial")) return "biaxial";
  return "uniaxial";
}

}  // namespace tunica::importing
