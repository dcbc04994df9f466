// SPDX-License-Identifier: Apache-2.0
#include "importing/columns.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "data/header_words.hpp"
#include "data/row_choice.hpp"
#include "data/table_place.hpp"
#include "data/units.hpp"
#include "importing/known_words.hpp"
#include "importing/words.hpp"
#include "text/escaped.hpp"
#include "tunica/error.hpp"

namespace tunica::importing {
namespace {

constexpr std::size_t values_kept = 50;
using Words = std::vector<std::string>;

/// Spellings of testing machines that UDUNITS does not know, or takes for something else.
std::string usual_unit(const std::string& unit, std::string_view base) {
  const std::string small = folded(unit);
  if (base == "mN")
    for (const auto& [rig, usual] :
         {std::pair{"lb", "lbf"}, std::pair{"lbs", "lbf"}, std::pair{"gr", "gf"}, std::pair{"gram", "gf"},
          std::pair{"grams", "gf"}, std::pair{"Newtons", "N"}, std::pair{"KN", "kN"}, std::pair{"Kgf", "kgf"}})
      if (small == rig) return usual;
  for (const auto& [rig, usual] :
       {std::pair{"KPa", "kPa"}, std::pair{"Kpa", "kPa"}, std::pair{"KPA", "kPa"}, std::pair{"Mpa", "MPa"},
        std::pair{"MPA", "MPa"}, std::pair{"secs", "s"}, std::pair{"Sec", "s"}, std::pair{"SEC", "s"},
        std::pair{"MM", "mm"}, std::pair{"um", "um"}, std::pair{"mmHG", "mmHg"}, std::pair{"mmhg", "mmHg"}})
    if (small == rig) return usual;
  return unit;
}

/// "N" of "Force_N", "Force / N", "Kraft in N", "Stress (KPa)".
std::string tail(const std::string& name) {
  std::string text = name;
  while (!text.empty() && (text.back() == ')' || text.back() == ']' || text.back() == ' ')) text.pop_back();
  const std::size_t slash = text.rfind(" / ");
  const std::size_t at = slash != std::string::npos ? slash + 2 : text.find_last_of(" _,([");
  const std::size_t bare = at == std::string::npos ? text.rfind('/') : at;
  return bare == std::string::npos ? "" : text.substr(bare + 1);
}

/// The unit in the last word of a name; capitals do not matter where only the other spelling is one.
std::optional<std::string> unit_in_name(const std::string& name, std::string_view base) {
  const std::string last = tail(name);
  std::string small = last;
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const std::string& spelling : {usual_unit(last, base), small})
    if (!spelling.empty() && spelling.find_first_not_of("0123456789") != std::string::npos && measures(spelling, base))
      return spelling;
  return std::nullopt;
}

std::string direction_in(const Words& words) {
  if (has_any(words, {"circ", "hoop", "=theta", "umfang", "=x", "=xx", "=exx", "=fx", "=ux", "=11", "=horizontal",
                      "transverse"}))
    return "circumferential";
  if (has_any(words, {"axial", "longitudinal", "=long", "=y", "=yy", "=eyy", "=fy", "=uy", "=22", "=vertical"}))
    return "axial";
  return {};
}

/// A diameter: the outer or the inner one, of which the name may say nothing; or how much it changed.
bool guess_diameter(ColumnGuess& guess, const Words& words) {
  const bool outer = has_any(words, {"=od"}), inner = has_any(words, {"=id"});
  if (!outer && !inner && !has_any(words, {"diameter", "diam", "durchmesser", "diametre", "diametro"})) return false;
  if (!guess.unit.empty() && !measures(guess.unit, "mm")) {
    guess.kind = "a diameter in " + guess.unit;
    return true;
  }
  const bool change = has_any(words, {"change", "=delta", "anderung", "difference", "variation"});
  guess.kind = change ? "change of diameter" : "diameter";
  if (change) return true;
  guess.quantity = outer || has_any(words, {"outer", "outside", "external", "aussen", "exter"}) ? "outer_diameter"
                   : inner || has_any(words, {"inner", "inside", "internal", "lumen", "innen", "inter"})
                       ? "inner_diameter"
                       : "diameter";
  return true;
}

void take_unit_of_name(ColumnGuess& guess, std::string_view base) {
  if (!guess.unit.empty()) {
    const std::string usual = usual_unit(guess.unit, base);
    guess.unit_from_name = guess.unit_from_name || usual != guess.unit;
    guess.unit = usual;
    return;
  }
  const auto unit = unit_in_name(guess.title, base);
  if (!unit || *unit == "1") return;
  guess.unit = *unit;
  guess.unit_from_name = true;
}

/// A component of a tensor: "E11", "S22", "P11".
const Word* component(const Words& words) {
  static constexpr Word strain{"e", "strain", "1"}, stress{"s", "stress", "kPa"};
  if (words.size() < 2 || !has_any(words, {"=11", "=22", "=xx", "=yy"})) return nullptr;
  if (words.front() == "e") return &strain;
  return words.front() == "s" || words.front() == "p" || words.front() == "t" ? &stress : nullptr;
}

const Word* meaning(const ColumnGuess& guess, const Words& words) {
  if (const Word* const found = component(words)) return found;
  for (const Word& word : known_words) {
    if (!has_word(words, word.word)) continue;
    const bool unit = guess.unit.empty() ? unit_in_name(guess.title, word.base).has_value()
                                         : measures(usual_unit(guess.unit, word.base), word.base);
    if (guess.unit.empty() ? word.needs_unit && !unit : !unit) continue;
    if (std::string_view(word.quantity) == "stretch" && guess.unit == "%") continue;
    return &word;
  }
  return nullptr;
}

/// "100 mN" of "mN/cm": what a force per length is on one metre of an edge; nothing of another unit.
std::optional<std::string> force_on_a_metre(const std::string& unit) {
  const std::size_t slash = unit.find('/');
  if (slash == std::string::npos || !measures(unit, "N/m")) return std::nullopt;
  const std::string force = unit.substr(0, slash), length = unit.substr(slash + 1);
  if (!measures(force, "mN") || !measures(length, "mm")) return std::nullopt;
  const double lengths = data::convert(1, "m", length);
  return lengths == 1 ? force : fmt::format("{:g} {}", lengths, force);
}

/// A force per length, as the tension of a membrane: "Tx [N/m]". Its unit becomes that of the force on one metre.
bool guess_tension(ColumnGuess& guess, const Words& words) {
  const auto force = force_on_a_metre(guess.unit);
  if (!force) return false;
  if (has_any(words, {"shear", "total", "=12", "=21", "=xy"})) return false;
  const bool x = has_any(words, {"=tx", "=t1", "=t11", "=nx", "=n1", "=n11"});
  const bool y = has_any(words, {"=ty", "=t2", "=t22", "=ny", "=n2", "=n22"});
  if (!x && !y && !has_any(words, {"tension", "force", "load", "stress", "kraft", "spannung", "=t", "=n"}))
    return false;
  guess.kind = guess.quantity = "force";
  guess.unit = *force;
  guess.per_metre = guess.unit_from_name = true;
  guess.direction = x ? "circumferential" : y ? "axial" : direction_in(words);
  return true;
}

void guess_quantity(ColumnGuess& guess, const Words& words) {
  guess.set_point = has_any(
      words, {"sollwert", "=soll", "=set", "setpoint", "command", "=cmd", "demand", "=target", "consigne", "consigna"});
  guess.compression = has_any(words, {"compres", "stauchung", "druckkraft", "druckspannung"});
  guess.rank = (guess.set_point ? 10 : 0) +
               (has_any(words, {"=min", "=max", "minimum", "maximum", "peak", "preload", "offset"}) ? 4 : 0) +
               (has_any(words, {"=abs", "absolute", "absolue", "absolut"}) ? 2 : 0) +
               (has_any(words, {"extensometer", "=stage", "capteur", "aufnehmer"}) ? 1 : 0) -
               (has_any(words, {"=avg", "average", "=mean"}) ? 1 : 0);
  if (has_any(words, {"shear"}) && has_any(words, {"=rate"})) {
    guess.kind = shearing;
    return;
  }
  for (const auto& [word, kind] : other_words)
    if (has_word(words, word) && !(measures(guess.unit, "s") && has_any(words, {"time", "zeit"}))) {
      guess.kind = kind;
      return;
    }
  if (guess_diameter(guess, words)) {
    take_unit_of_name(guess, "mm");
    return;
  }
  if (has_any(words, {"cycle", "zyklus", "zyklen", "ciclo"}) && !has_any(words, {"time", "zeit"})) {
    guess.quantity = guess.unit.empty() || guess.unit == "1" ? "cycle" : "";
    guess.kind = "cycle";
    return;
  }
  if (guess_tension(guess, words)) return;
  const Word* const word = meaning(guess, words);
  if (word == nullptr) return;
  guess.kind = word->quantity;
  take_unit_of_name(guess, word->base);
  if (has_any(words, {"=12", "=21", "=xy", "=exy", "shear"})) {
    guess.kind = "shear " + guess.kind;
    return;
  }
  const bool squared = has_any(words, {"squared", "square", "quadrat"}) ||
                       guess.title.find("^2") != std::string::npos || guess.title.find("²") != std::string::npos;
  if (guess.kind == "stretch" && squared) {
    guess.kind = "squared stretch";
    return;
  }
  if (guess.kind == "strain") guess.measure = data::strain_measure(words);
  if (guess.kind == "stress") guess.measure = data::stress_measure(words);
  if (guess.measure == "almansi" ||
      (guess.kind == "stress" && has_any(words, {"=kirchhoff"}) && !has_any(words, {"piola"}))) {
    guess.kind = guess.kind == "strain" ? "Almansi strain" : "Kirchhoff stress";
    return;
  }
  guess.indexed = component(words) != nullptr || has_any(words, {"=exx", "=eyy"});
  if (guess.kind == "force" && has_any(words, {"total"})) guess.kind = total_force;
  guess.quantity = guess.kind == total_force ? "" : word->quantity;
  guess.direction = direction_in(words);
  if (guess.quantity == "time" && has_any(words, {"cycle", "step"})) guess.rank += 2;
}

bool has(const std::vector<ColumnGuess>& columns, std::string_view quantity, std::string_view direction = {}) {
  return std::any_of(columns.begin(), columns.end(), [&](const ColumnGuess& column) {
    return column.quantity == quantity && (direction.empty() || column.direction == direction);
  });
}

/// "Force 1", "Force 2", "Disp 1", "Disp 2": two axes, where the load and the way both come in a pair.
void number_axes(std::vector<ColumnGuess>& columns) {
  const auto of = [&](std::initializer_list<const char*> quantities, const char* number) {
    std::vector<ColumnGuess*> found;
    for (ColumnGuess& column : columns)
      if (column.direction.empty() && !column.set_point && column.measure.empty() &&
          has_any(words_of(column.title), {number}) &&
          std::find(quantities.begin(), quantities.end(), column.quantity) != quantities.end())
        found.push_back(&column);
    return found;
  };
  const auto loads_1 = of({"force", "stress"}, "=1"), loads_2 = of({"force", "stress"}, "=2");
  const auto ways_1 = of({"displacement", "strain", "stretch", "length"}, "=1");
  const auto ways_2 = of({"displacement", "strain", "stretch", "length"}, "=2");
  if (loads_1.empty() || loads_2.empty() || ways_1.empty() || ways_2.empty()) return;
  for (const auto& list : {loads_1, ways_1})
    for (ColumnGuess* const column : list) column->direction = "circumferential";
  for (const auto& list : {loads_2, ways_2})
    for (ColumnGuess* const column : list) column->direction = "axial";
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
  std::vector<ColumnGuess> guesses;
  for (std::size_t k = 0; k < csv.columns.size(); ++k) {
    const data::Csv::Column& column = csv.columns[k];
    ColumnGuess guess;
    // A name twice, an empty one, and one that JSON cannot hold: the column is named by its place.
    const bool twice = std::count_if(csv.columns.begin(), csv.columns.end(),
                                     [&](const auto& other) { return other.name == column.name; }) > 1;
    const bool named = text::is_utf8(column.text) && !column.name.empty() && !twice;
    guess.name = named ? column.name : "#" + std::to_string(k + 1);
    guess.title = as_utf8(column.unit ? column.name : column.text);
    guess.unit = as_utf8(column.unit.value_or(""));
    guess.unit_from_name = !text::is_utf8(column.unit.value_or(""));
    if (guess.unit == "-") guess.unit = "1";
    std::size_t numbers = 0;
    std::set<std::string> seen;
    const char decimal = csv.decimal_mark({k});
    for (const data::Csv::Row& row : csv.rows) {
      const std::string& cell = row.cells[k];
      if (cell.empty()) continue;
      ++guess.filled;
      const bool number = data::looks_like_number(cell, csv.delimiter != ',');
      numbers += number ? 1 : 0;
      if (number && cell != "NaN" && cell != "nan") {
        try {
          const double value = csv.number(row, k, decimal);
          guess.largest = std::max(guess.largest, std::abs(value));
          if (guess.begins.size() < 2) guess.begins.push_back(value);
        } catch (const InputError&) {  // infinity, or the other decimal mark: the reader says so
        }
      }
      if (seen.size() < values_kept && seen.insert(cell).second) guess.values.push_back(cell);
    }
    guess.different = seen.size();
    guess.numeric = guess.filled > 0 && 10 * numbers >= 9 * guess.filled;
    if (guess.numeric) {
      guess.values.clear();
      guess_quantity(guess, words_of(guess.title));
      if (guess.different < 2 && guess.filled > 2) guess.rank += 3;
    }
    guesses.push_back(std::move(guess));
  }
  // A name that says nothing: the unit may, where nothing else is a force or a time, and one column alone has it.
  for (const auto& [base, quantity] : {std::pair{"mN", "force"}, std::pair{"s", "time"}}) {
    std::vector<ColumnGuess*> of_unit;
    for (ColumnGuess& guess : guesses)
      if (guess.numeric && guess.kind.empty() && guess.different > 1 && !guess.unit.empty() &&
          measures(guess.unit, base))
        of_unit.push_back(&guess);
    if (of_unit.size() == 1 && !has(guesses, quantity)) of_unit.front()->kind = of_unit.front()->quantity = quantity;
  }
  number_axes(guesses);
  return guesses;
}

std::string observable_titled(const std::string& title, const std::vector<Observable>& observables) {
  const auto plain = [](std::string text) {
    std::erase_if(text, [](char c) { return c == ' ' || c == '_' || c == '-'; });
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  const std::string titled = plain(folded(title));
  const auto known = std::ranges::find_if(known_titles, [&](const auto& one) { return titled == one.first; });
  const std::string other = known == std::end(known_titles) ? "" : known->second;
  // What a test can do without may need an option that nobody has given, as a temperature does.
  const auto found = std::ranges::find_if(observables, [&](const Observable& one) {
    return (one.required || one.role == Observable::Role::channel) && (plain(one.name) == titled || one.name == other);
  });
  return found == observables.end() ? "" : found->name;
}

bool counts_cycles(const ColumnGuess& column) {
  if (column.numeric) return column.quantity == "cycle";
  return column.different > 1 && has_any(words_of(column.title), {"cycle", "zyklus", "ciclo"}) &&
         std::all_of(column.values.begin(), column.values.end(),
                     [](const std::string& value) { return data::first_number(value).has_value(); });
}

bool parts_rows(const ColumnGuess& column, std::size_t rows) {
  return column.different > 1 && column.different < values_kept && 10 * column.filled >= 9 * rows &&
         3 * column.different <= column.filled;
}

Specimen likely_specimen(const std::vector<ColumnGuess>& columns) {
  if (has(columns, "pressure") &&
      (has(columns, "outer_diameter") || has(columns, "inner_diameter") || has(columns, "diameter")))
    return Specimen::tube;
  for (const char* measured : {"force", "stress"})
    if (has(columns, measured, "circumferential") && has(columns, measured, "axial")) return Specimen::sheet;
  return Specimen::strip;
}

}  // namespace tunica::importing
