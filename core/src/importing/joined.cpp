// SPDX-License-Identifier: Apache-2.0
#include "importing/joined.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "importing/columns.hpp"
#include "importing/options.hpp"
#include "importing/sizes.hpp"
#include "tunica/error.hpp"

namespace tunica::importing {
namespace {

struct Part {
  data::Csv csv;
  std::vector<ColumnGuess> columns;
  std::string direction;
};

std::string direction_of(const std::filesystem::path& file, const Answers& answers) {
  const std::string stem = file.stem().string();
  for (const auto& [name, direction] : answers.directions)
    if (name == stem) return direction;
  const std::string named = direction_named(stem);
  if (named.empty())
    throw InputError(
        fmt::format("--join: the name of {} does not say its direction. Add --direction '{}=axial' or "
                    "--direction '{}=circumferential'.",
                    file.string(), stem, stem));
  return named;
}

std::string in_quotes(const std::string& text) {
  std::string cell = "\"";
  for (const char letter : text) cell += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return cell + '"';
}

std::size_t time_of(const Part& part) {
  const auto found = std::find_if(part.columns.begin(), part.columns.end(),
                                  [](const ColumnGuess& one) { return one.numeric && one.quantity == "time"; });
  return static_cast<std::size_t>(found - part.columns.begin());
}

void require_same_times(const Part& a, const Part& b) {
  const std::size_t at = time_of(a), beside = time_of(b);
  if (at == a.columns.size() || beside == b.columns.size()) return;
  const char decimal_a = a.csv.decimal_mark({at}), decimal_b = b.csv.decimal_mark({beside});
  const double step = a.columns[at].largest / static_cast<double>(a.csv.rows.size());
  for (std::size_t row = 0; row < a.csv.rows.size(); ++row) {
    const double one = a.csv.number(a.csv.rows[row], at, decimal_a);
    const double other = b.csv.number(b.csv.rows[row], beside, decimal_b);
    if (std::abs(one - other) > 0.1 * step)
      throw InputError(fmt::format(
          "--join: {}, line {}, has the time {}, and {}, line {}, has {}. Bring both to the same "
          "times.",
          a.csv.file.string(), a.csv.rows[row].line, one, b.csv.file.string(), b.csv.rows[row].line, other));
  }
}

}  // namespace

std::string joined_table(const Answers& answers) {
  if (answers.files.size() != 2)
    throw InputError("--join: expected two files, one of each direction of the sheet. Name both");
  std::vector<Part> parts;
  for (const auto& file : answers.files) {
    Part part{data::parse_csv(file, data::read_bytes(file), layout_of(answers)), {}, direction_of(file, answers)};
    part.columns = guess_columns(part.csv);
    parts.push_back(std::move(part));
  }
  const Part &a = parts[0], &b = parts[1];
  if (a.direction == b.direction)
    throw InputError(
        fmt::format("--join: both files are {}. Say the direction of each with --direction NAME=axial", a.direction));
  if (a.csv.rows.size() != b.csv.rows.size())
    throw InputError(fmt::format("--join: {} has {} rows, and {} has {}. Rows go together one by one: cut both alike.",
                                 a.csv.file.string(), a.csv.rows.size(), b.csv.file.string(), b.csv.rows.size()));
  require_same_times(a, b);
  std::string header;
  std::vector<std::string> lines(a.csv.rows.size());
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (std::size_t column = 0; column < parts[k].columns.size(); ++column) {
      const ColumnGuess& guess = parts[k].columns[column];
      const bool time = guess.quantity == "time";
      const std::string mark = header.empty() ? "" : ",";
      if (!guess.numeric && guess.filled > 0 && k == 0) {  // a label: rows are chosen by it, and both files have it
        header += mark + in_quotes(guess.title);
        for (std::size_t row = 0; row < lines.size(); ++row)
          lines[row] += mark + in_quotes(parts[k].csv.rows[row].cells[column]);
      }
      if (!guess.numeric || guess.quantity.empty() || (time && k > 0)) continue;
      header += mark + in_quotes(guess.title + (time ? "" : " " + parts[k].direction) +
                                 (guess.unit.empty() ? "" : " [" + guess.unit + "]"));
      const char decimal = parts[k].csv.decimal_mark({column});
      for (std::size_t row = 0; row < lines.size(); ++row) {
        std::string cell = parts[k].csv.rows[row].cells[column];
        if (decimal == ',') std::replace(cell.begin(), cell.end(), ',', '.');
        lines[row] += mark + cell;
      }
    }
  std::string text = fmt::format("# {} and {}, row by row\n{}\n", a.csv.file.filename().string(),
                                 b.csv.file.filename().string(), header);
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

}  // namespace tunica::importing
