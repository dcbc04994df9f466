// SPDX-License-Identifier: Apache-2.0
#include "importing/sign.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/quantities.hpp"
#include "data/units.hpp"
#include "importing/sizes.hpp"
#include "importing/words.hpp"

namespace tunica::importing {
namespace {

using From = data::Quantity::Kind;

constexpr std::initializer_list<const char*> tension = {"tension", "tensile", "zugversuch", "traction"};

/// The lines before the header of a table.
std::string_view above(std::string_view bytes, std::size_t header_line) {
  std::size_t at = 0;
  for (std::size_t line = 1; line < header_line && at < bytes.size(); ++line)
    at = std::min(bytes.find('\n', at), bytes.size() - 1) + 1;
  return bytes.substr(0, at);
}

/// Length and least thickness, mm, of a specimen that is nearly as thick as it is long, within a factor of three: what
/// is pressed stands up, what is pulled is slender. None of another one, and where a size is not known.
std::optional<std::pair<double, double>> stub_of(const Json& specimen) {
  const auto size = [&](const char* key, const char* unit) {
    const auto found = specimen.find(key);
    if (found == specimen.end() || !found->is_string() || *found == "preload") return 0.0;
    return data::parse_quantity(found->get<std::string>(), unit);
  };
  const double length = size("gauge_length", "mm"), area = size("area", "mm2");
  const double thinnest = area > 0 ? std::sqrt(area) : std::min(size("width", "mm"), size("thickness", "mm"));
  if (!(length > 0) || 3 * thinnest <= length) return std::nullopt;
  return std::pair(length, thinnest);
}

/// Whether the numbers are positive, but for some that scatter about zero.
bool positive(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  const auto below = std::count_if(values.begin(), values.end(), [&](double one) { return one < -0.02 * largest; });
  return largest > 0 && 10 * static_cast<std::size_t>(below) < values.size();
}

}  // namespace

SignWords words_of_sign(const std::filesystem::path& file, std::string_view bytes, const data::Csv& csv,
                        const std::vector<ColumnGuess>& columns) {
  const auto name = words_of(file.stem().string()), before = words_of(above(bytes, csv.header_line));
  SignWords said;
  said.compression =
      has_any(name, {"compres", "stauch"}) || has_any(before, {"compression", "kompression", "druckversuch"});
  said.tension = has_any(name, tension) || has_any(before, tension);
  said.bending =
      has_any(name, {"flexur", "=bending", "biege"}) || has_any(before, {"flexur", "=bending", "biegeversuch"});
  std::vector<const data::Csv::Row*> rows;
  for (const data::Csv::Row& row : csv.rows) rows.push_back(&row);
  std::size_t forces = 0, below = 0;
  for (const ColumnGuess& column : columns) {
    said.tension = said.tension || (column.numeric && has_any(words_of(column.title), tension));
    if (column.quantity != "force" || column.set_point) continue;
    std::vector<double> values = numbers_of(csv, column.name, rows);
    for (double& value : values) value = -value;
    ++forces;
    below += positive(values) ? 1 : 0;
  }
  said.negative = forces > 0 && below == forces;
  return said;
}

std::optional<Question> question_of_sign(const Json& data, const data::Csv& csv,
                                         const std::vector<const data::Csv::Row*>& rows,
                                         const std::vector<Observable>& observables) {
  const auto sizes = data.contains("specimen") ? stub_of(data["specimen"]) : std::nullopt;
  if (!sizes) return std::nullopt;
  bool force = false, way = false;
  for (const auto& [name, column] : data["columns"].items()) {
    const From kind = data::quantity_named(name, observables)->kind;
    if (kind != From::force && kind != From::displacement) continue;
    const std::string title = column.is_string() ? column.get<std::string>() : fmt::format("#{}", column.get<int>());
    (kind == From::force ? force : way) = positive(numbers_of(csv, title, rows));
  }
  if (!force || !way) return std::nullopt;
  return Question{
      fmt::format(
          "The specimen is {:.3g} mm long and {:.3g} mm thick, as one to be pressed; all values are positive, and "
          "no word says what they count. Is it compression: positive; or tension: negative",
          sizes->first, sizes->second),
      "--compression positive or --compression negative", "positive"};
}

}  // namespace tunica::importing
