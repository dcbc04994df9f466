// SPDX-License-Identifier: Apache-2.0
#include "importing/tension.hpp"

#include <fmt/format.h>

#include "data/quantities.hpp"
#include "tunica/error.hpp"

namespace tunica::importing {

std::string tension_of(const data::Csv& csv, const std::vector<ColumnGuess>& columns,
                       const std::vector<std::pair<std::string, std::string>>& mapped, const TestFactory& factory,
                       const Answers& answers) {
  const ColumnGuess *tense = nullptr, *force = nullptr;
  for (const auto& [name, column] : mapped) {
    const data::Quantity::Kind kind = data::quantity_named(name, factory.observables)->kind;
    if (kind != data::Quantity::Kind::force && kind != data::Quantity::Kind::plate_force) continue;
    const ColumnGuess& guess = columns[csv.column(column)];
    (guess.per_metre ? tense : force) = &guess;
  }
  if (tense == nullptr) return {};
  if (factory.specimen == Specimen::block)
    throw InputError(fmt::format(
        "{}, line {}: '{}' is a force per length, and a block bears a force on its plates. Name another column with "
        "--column.",
        csv.file.string(), csv.header_line, tense->title));
  if (force != nullptr)
    throw InputError(fmt::format(
        "{}, line {}: '{}' is a force per length, and '{}' a force. A test takes one kind; name the right columns with "
        "--column.",
        csv.file.string(), csv.header_line, tense->title, force->title));
  for (const auto& [option, given] : {std::pair{"--width", &answers.width}, std::pair{"--area", &answers.area},
                                      std::pair{"--diameter", &answers.diameter}})
    if (!given->empty())
      throw InputError(
          fmt::format("{}: '{}' is a force per length, which needs the thickness only. Leave {} out, or give the unit "
                      "of a force with "
                      "--unit.",
                      option, tense->title, option));
  return tense->title;
}

}  // namespace tunica::importing
