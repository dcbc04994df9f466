// SPDX-License-Identifier: Apache-2.0
#include "data/table_place.hpp"

#include <algorithm>
#include <charconv>
#include <vector>

#include "data/units.hpp"

namespace tunica::data {
namespace {

constexpr std::size_t least_rows = 3;
constexpr std::size_t lines_read = 2000;  ///< a table that begins later is not looked for

struct TextLine {
  std::size_t number;
  std::string_view text;
};

std::vector<TextLine> lines_with_text(std::string_view text) {
  std::vector<TextLine> lines;
  std::size_t number = 1;
  for (std::size_t at = 0; at < text.size() && lines.size() < lines_read; ++number) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
    if (const auto content = trimmed(line); !content.empty() && content.front() != '#') lines.push_back({number, line});
  }
  return lines;
}

std::vector<std::string_view> cells_of(std::string_view line, char delimiter) {
  std::vector<std::string_view> cells;
  bool quoted = false;
  std::size_t begin = 0;
  if (delimiter == ' ') line = trimmed(line);
  for (std::size_t at = 0; at <= line.size(); ++at) {
    // Within a cell a quote is a letter, as in the modulus G".
    if (at < line.size() && line[at] == '"' &&
        (quoted || trimmed(line.substr(begin, at - begin)).empty() || line[at - 1] == '"'))
      quoted = !quoted;
    const bool separates =
        at < line.size() && !quoted && (line[at] == delimiter || (delimiter == ' ' && line[at] == '\t'));
    if (at < line.size() && !separates) continue;
    std::string_view cell = trimmed(line.substr(begin, at - begin));
    begin = at + 1;
    if (delimiter == ' ' && cell.empty()) continue;
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    cells.push_back(cell);
  }
  return cells;
}

enum class Cell : char { empty, text, number };

struct CellLine {
  std::size_t number;
  std::vector<Cell> cells;
};

CellLine classified(const TextLine& line, char delimiter) {
  CellLine found{line.number, {}};
  for (const std::string_view cell : cells_of(line.text, delimiter))
    found.cells.push_back(cell.empty()                                ? Cell::empty
                          : looks_like_number(cell, delimiter != ',') ? Cell::number
                                                                      : Cell::text);
  return found;
}

/// Lines [first, last) of a table, and what their fields have in common.
struct Run {
  std::size_t first = 0, last = 0;
  std::vector<Cell> cells;
  [[nodiscard]] std::size_t rows() const { return last - first; }
  [[nodiscard]] auto numbers() const { return std::count(cells.begin(), cells.end(), Cell::number); }
  [[nodiscard]] std::size_t values() const { return rows() * static_cast<std::size_t>(numbers()); }
  [[nodiscard]] double share() const {
    return cells.empty() ? 0 : static_cast<double>(numbers()) / static_cast<double>(cells.size());
  }
};

/// An empty field says nothing; elsewhere a run has either numbers or text.
bool joins(Run& run, const std::vector<Cell>& cells) {
  if (cells.size() != run.cells.size()) return false;
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (cells[k] != Cell::empty && run.cells[k] != Cell::empty && cells[k] != run.cells[k]) return false;
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (run.cells[k] == Cell::empty) run.cells[k] = cells[k];
  return true;
}

Run largest_run(const std::vector<CellLine>& lines) {
  Run best, run;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (run.rows() == 0 || !joins(run, lines[k].cells)) run = {k, k, lines[k].cells};
    run.last = k + 1;
    if (run.cells.size() > 1 && run.rows() >= least_rows && run.values() > best.values()) best = run;
  }
  return best;
}

/// Whether most numbers of a run stand under text: unnamed channels have their number as a name.
bool names_most(const Run& run, const std::vector<Cell>& cells) {
  std::ptrdiff_t named = 0;
  for (std::size_t c = 0; c < run.cells.size(); ++c)
    named += run.cells[c] == Cell::number && cells[c] == Cell::text ? 1 : 0;
  return named > 0 && 2 * named >= run.numbers();
}

/// Above a run, past rows that it lost to a text in a column of numbers, and past a row of units.
std::optional<std::size_t> header_of(const Run& run, const std::vector<TextLine>& texts,
                                     const std::vector<CellLine>& lines, char delimiter) {
  for (std::size_t k = run.first; k-- > 0;) {
    const auto& cells = lines[k].cells;
    if (cells.size() < run.cells.size()) return std::nullopt;
    bool names = true, units = true;
    for (std::size_t c = 0; c < run.cells.size(); ++c)
      names = names && (run.cells[c] != Cell::number || cells[c] == Cell::text);
    for (const std::string_view cell : cells_of(texts[k].text, delimiter))
      units = units && (cell.empty() || stated_unit(cell).has_value());
    const bool above = k > 0 && lines[k - 1].cells.size() >= run.cells.size();
    if (names && units && above && names_most(run, lines[k - 1].cells)) return k - 1;
    if (names && !(units && above)) return k;
  }
  return std::nullopt;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

bool looks_like_number(std::string_view cell, bool comma) {
  std::string digits(cell);
  if (comma) std::replace(digits.begin(), digits.end(), ',', '.');
  const std::size_t sign = digits.starts_with('+') ? 1 : 0;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data() + sign, digits.data() + digits.size(), value);
  return !digits.empty() && error != std::errc::invalid_argument && end == digits.data() + digits.size();
}

std::optional<std::string> stated_unit(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() > 1 && ((cell.front() == '(' && cell.back() == ')') || (cell.front() == '[' && cell.back() == ']')))
    cell = trimmed(cell.substr(1, cell.size() - 2));
  if (cell.empty() || looks_like_number(cell, true) || !is_unit(cell)) return std::nullopt;
  return std::string(cell);
}

std::optional<TablePlace> find_table(std::string_view text, std::optional<char> delimiter) {
  const std::vector<TextLine> texts = lines_with_text(text);
  std::optional<TablePlace> found;
  Run best;
  for (const char candidate : {'\t', ';', ',', ' '}) {
    if (delimiter && *delimiter != candidate) continue;
    std::vector<CellLine> lines;
    for (const TextLine& line : texts) lines.push_back(classified(line, candidate));
    const Run run = largest_run(lines);
    if (run.values() < best.values() || (run.values() == best.values() && run.share() <= best.share())) continue;
    best = run;
    const auto header = header_of(run, texts, lines, candidate);
    found =
        TablePlace{header ? std::optional(lines[*header].number) : std::nullopt, lines[run.first].number, candidate};
  }
  return found;
}

}  // namespace tunica::data
