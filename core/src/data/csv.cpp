// SPDX-License-Identifier: Apache-2.0
#include "data/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "data/file_text.hpp"
#include "data/nearest.hpp"
#include "data/table_place.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

/// Cuts a text into lines (LF, CRLF or CR) and lines into fields, keeping count of lines.
class Cutter {
 public:
  Cutter(const std::filesystem::path& file, std::string_view text) : file_(&file), text_(text) {}

  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] std::size_t line() const { return line_; }

  void skip_to_line(std::size_t line) {
    while (!at_end() && line_ < line) {
      at_ += rest_of_line().size();
      end_line();
    }
  }

  /// Skips blank and comment lines.
  void skip_comments() {
    while (!at_end()) {
      const std::string_view line = trimmed(rest_of_line());
      if (!line.empty() && line.front() != '#') return;
      at_ += rest_of_line().size();
      end_line();
    }
  }

  [[nodiscard]] std::string_view rest_of_line() const {
    const std::size_t end = text_.find_first_of("\r\n", at_);
    return text_.substr(at_, end == std::string_view::npos ? end : end - at_);
  }

  std::vector<std::string> fields(char delimiter) {
    std::vector<std::string> cells;
    bool more = true;
    while (more) {
      if (delimiter == ' ') skip_blanks();
      std::string cell = field(delimiter);
      more = !at_end() && text_[at_] != '\r' && text_[at_] != '\n';
      if (delimiter == ' ' && cell.empty() && !more) break;  // white space at the end of the line
      cells.push_back(std::move(cell));
      if (more) ++at_;  // the delimiter
      if (more && delimiter != ' ' && (at_end() || text_[at_] == '\r' || text_[at_] == '\n')) {
        cells.emplace_back();
        more = false;
      }
    }
    end_line();
    return cells;
  }

 private:
  void skip_blanks() {
    while (!at_end() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  [[nodiscard]] bool is_delimiter(char c, char delimiter) const {
    return c == delimiter || (delimiter == ' ' && c == '\t');
  }

  // A field up to the delimiter or the end of the line; in quotes it may hold both, and "" for a quote.
  std::string field(char delimiter) {
    std::size_t begin = at_;
    while (begin < text_.size() && text_[begin] == ' ') ++begin;
    if (begin < text_.size() && text_[begin] == '"') {
      at_ = begin;
      return quoted(delimiter);
    }
    const std::size_t start = at_;
    while (!at_end() && text_[at_] != '\r' && text_[at_] != '\n' && !is_delimiter(text_[at_], delimiter)) ++at_;
    return std::string(trimmed(text_.substr(start, at_ - start)));
  }

  std::string quoted(char delimiter) {
    const std::size_t opened = line_;
    std::string cell;
    for (++at_; !at_end(); ++at_) {
      const char c = text_[at_];
      if (c == '"' && at_ + 1 < text_.size() && text_[at_ + 1] == '"')
        ++at_;
      else if (c == '"')
        break;
      if (c == '\n') ++line_;
      cell += text_[at_];
    }
    if (at_end())
      throw InputError(fmt::format("{}, line {}: a quoted field opens here and never closes. Close it with \".",
                                   file_->string(), opened));
    ++at_;
    while (!at_end() && text_[at_] != '\r' && text_[at_] != '\n' && !is_delimiter(text_[at_], delimiter))
      cell += text_[at_++];
    return std::string(trimmed(cell));
  }

  void end_line() {
    if (at_end()) return;
    if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
    ++at_;
    ++line_;
  }

  const std::filesystem::path* file_;
  std::string_view text_;
  std::size_t at_ = 0, line_ = 1;
};

// Delimiters within quotes and within the brackets of a unit do not count.
char sniff_delimiter(std::string_view header) {
  std::size_t tabs = 0, semicolons = 0, commas = 0;
  bool quoted = false;
  int bracket = 0;
  for (const char c : header) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    bracket += c == '[' ? 1 : c == ']' && bracket > 0 ? -1 : 0;
    if (bracket > 0) continue;
    tabs += c == '\t';
    semicolons += c == ';';
    commas += c == ',';
  }
  return tabs > 0 ? '\t' : semicolons > 0 ? ';' : commas > 0 ? ',' : ' ';
}

/// The unit of "exx [1] - Lagrange", whose name is the whole; none of another text.
std::optional<std::string> unit_within(std::string_view text) {
  const std::size_t open = text.find('['), close = text.find("] - ");
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return std::nullopt;
  const std::string_view unit = trimmed(text.substr(open + 1, close - open - 1));
  return unit == "1" || stated_unit(unit) ? std::optional(std::string(unit)) : std::nullopt;
}

/// "stress [kPa]"; in round brackets only what is a unit: "stress (kPa)", not "stress (true)".
Csv::Column header_cell(const std::string& text) {
  if (const auto unit = unit_within(text)) return {text, text, unit};
  const bool round = text.ends_with(')');
  const std::size_t open = text.rfind(round ? '(' : '[');
  if (open == std::string::npos || !(round || text.back() == ']')) return {text, text, std::nullopt};
  const std::string_view view = text;
  std::string name(trimmed(view.substr(0, open)));
  if (round && (name.empty() || !stated_unit(view.substr(open)))) return {text, text, std::nullopt};
  return {text, std::move(name), std::string(trimmed(view.substr(open + 1, text.size() - open - 2)))};
}

// In a file delimited by white space the unit has become a cell of its own: "stress [kPa]", or two, "stress [N / m]".
std::vector<std::string> join_units(const std::vector<std::string>& cells) {
  std::vector<std::string> joined;
  for (const std::string& cell : cells) {
    const bool open = !joined.empty() && joined.back().find('[') != std::string::npos && joined.back().back() != ']';
    if (!joined.empty() && (open || cell.starts_with('[')))
      joined.back() += " " + cell;
    else
      joined.push_back(cell);
  }
  return joined;
}

/// A row of units under the names: every cell that is not empty is a unit, so that no cell is a number.
void read_unit_row(Cutter& cutter, const TableLayout& layout, Csv& csv) {
  cutter.skip_comments();
  if (cutter.at_end()) return;
  Cutter below = cutter;
  std::vector<std::string> cells = below.fields(csv.delimiter);
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  bool any = false;
  for (const std::string& cell : cells) {
    if (!cell.empty() && !stated_unit(cell)) return;
    any = any || !cell.empty();
  }
  if (!any || cells.size() > csv.columns.size()) return;
  if (layout.row_names) {
    const std::size_t names = layout.row_names->empty() ? 0 : csv.column(*layout.row_names);
    if (names < cells.size() && !cells[names].empty()) return;
  }
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (!cells[k].empty()) csv.columns[k].unit = stated_unit(cells[k]);
  cutter = below;
}

std::size_t first_line(const std::filesystem::path& file, std::string_view text) {
  Cutter cutter(file, text);
  cutter.skip_comments();
  return cutter.line();
}

/// Names and units of the columns. Where nothing is asked for by name, they may be missing.
void read_header(Cutter& cutter, const TableLayout& layout, Csv& csv) {
  const auto number = [&](const std::string& cell) { return looks_like_number(cell, csv.delimiter != ','); };
  Cutter below = cutter;
  std::vector<std::string> header = below.fields(csv.delimiter);
  if (csv.delimiter == ' ') header = join_units(header);
  if (header.empty())
    throw InputError(
        fmt::format("{}, line {}: found a line without a cell where the header is expected. Write a line "
                    "`name [unit]` with one name per column above the rows.",
                    csv.file.string(), csv.header_line));
  const bool nameless = std::all_of(header.begin(), header.end(), number);
  if (nameless && !layout.by_position)
    throw InputError(
        fmt::format("{}, line {}, column 1: found the number {} where the header is expected. Write a line "
                    "`name [unit]` with one name per column above the rows, or give columns by their number.",
                    csv.file.string(), csv.header_line, excerpt(header.front())));
  while (header.size() > 1 && header.back().empty()) header.pop_back();
  if (nameless) {
    for (std::size_t k = 0; k < header.size(); ++k)
      csv.columns.push_back({fmt::format("#{}", k + 1), fmt::format("#{}", k + 1), std::nullopt});
  } else {
    for (const std::string& cell : header) csv.columns.push_back(header_cell(cell));
    cutter = below;
    read_unit_row(cutter, layout, csv);
  }
  for (const auto& [name, unit] : layout.units) csv.columns[csv.column(name)].unit = unit;
}

}  // namespace

Csv parse_csv(const std::filesystem::path& file, std::string_view text, const TableLayout& layout) {
  std::string decoded;
  text = text_of(file, text, decoded);
  Csv csv;
  csv.file = file;
  csv.stated_decimal = layout.decimal;
  Cutter cutter(file, text);
  const std::optional<TablePlace> place =
      layout.skip_lines || layout.row_names ? std::nullopt : find_table(text, layout.delimiter);
  const bool nameless = place && !place->header && layout.by_position;
  if (layout.skip_lines)
    cutter.skip_to_line(*layout.skip_lines + 1);
  else if (place && (place->header || nameless))
    cutter.skip_to_line(nameless ? place->first_row : *place->header);
  cutter.skip_comments();
  if (cutter.at_end() && layout.skip_lines)
    throw InputError(fmt::format("{}: \"skip_lines\" is {}, and no table follows. The file has {} lines; correct it.",
                                 file.string(), *layout.skip_lines, cutter.line() - 1));
  if (cutter.at_end())
    throw InputError(
        fmt::format("{}, line 1: the file is empty{}. Expected a header line `name [unit]` and rows of numbers.",
                    file.string(), text.empty() ? "" : " but for comments"));
  csv.header_line = cutter.line();
  const bool moved = place && csv.header_line > first_line(file, text);
  csv.delimiter = layout.delimiter    ? *layout.delimiter
                  : moved || nameless ? place->delimiter
                                      : sniff_delimiter(cutter.rest_of_line());
  read_header(cutter, layout, csv);
  for (cutter.skip_comments(); !cutter.at_end(); cutter.skip_comments()) {
    Csv::Row row{cutter.line(), cutter.fields(csv.delimiter)};
    const auto surplus = row.cells.size() > csv.columns.size()
                             ? std::find_if(row.cells.begin() + static_cast<std::ptrdiff_t>(csv.columns.size()),
                                            row.cells.end(), [](const std::string& cell) { return !cell.empty(); })
                             : row.cells.end();
    if (surplus != row.cells.end())
      throw InputError(
          fmt::format("{}, line {}, column {}: found '{}' beyond the last of the {} columns the header names. "
                      "Name every column, and use a decimal point, or semicolons between the fields.",
                      file.string(), row.line, surplus - row.cells.begin() + 1, excerpt(*surplus), csv.columns.size()));
    row.cells.resize(csv.columns.size());
    const bool blank = std::all_of(row.cells.begin(), row.cells.end(), [](const auto& cell) { return cell.empty(); });
    if (blank) continue;  // spreadsheets write the cells of empty lines
    csv.rows.push_back(std::move(row));
  }
  if (csv.rows.empty())
    throw InputError(fmt::format("{}, line {}: the file ends after its header. Expected rows of numbers below it.",
                                 file.string(), csv.header_line));
  return csv;
}

std::optional<std::size_t> column_position(std::string_view name) {
  std::size_t position = 0;
  if (!name.starts_with('#')) return std::nullopt;
  const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), position);
  return error == std::errc() && end == name.data() + name.size() ? std::optional(position) : std::nullopt;
}

std::size_t Csv::column(std::string_view name) const {
  const auto called = [&](const Column& column) { return column.name == name; };
  const auto written = [&](const Column& column) { return column.text == name; };
  auto found = std::find_if(columns.begin(), columns.end(), called);
  if (found != columns.end()) {
    const auto second = std::find_if(found + 1, columns.end(), called);
    if (second != columns.end())
      throw InputError(fmt::format("{}, line {}: the columns {} and {} are both called '{}'. Rename one.",
                                   file.string(), header_line, found - columns.begin() + 1,
                                   second - columns.begin() + 1, excerpt(name)));
    return static_cast<std::size_t>(found - columns.begin());
  }
  found = std::find_if(columns.begin(), columns.end(), written);
  if (found != columns.end()) return static_cast<std::size_t>(found - columns.begin());
  if (const auto position = column_position(name)) {
    if (*position >= 1 && *position <= columns.size()) return *position - 1;
    throw InputError(fmt::format("{}, line {}: there is no column {}, the table has {}. Give a number that is there.",
                                 file.string(), header_line, *position, columns.size()));
  }
  std::vector<std::string> names;
  for (const Column& column : columns) names.push_back(excerpt(column.name));
  throw InputError(fmt::format("{}, line {}: there is no column '{}'. {}", file.string(), header_line, excerpt(name),
                               suggestion(name, names)));
}

void Csv::require_utf8(bool cells) const {
  const auto check = [this](std::size_t line, std::size_t column, const std::string& text) {
    if (!text::is_utf8(text))
      throw InputError(
          fmt::format("{}, line {}, column {}: found '{}', which is not UTF-8. Save the file as UTF-8 text.",
                      file.string(), line, column + 1, excerpt(text)));
  };
  for (std::size_t k = 0; k < columns.size(); ++k) {
    check(header_line, k, columns[k].text);
    check(header_line, k, columns[k].unit.value_or(""));  // from a line of its own
  }
  if (!cells) return;
  for (const Row& row : rows)
    for (std::size_t k = 0; k < row.cells.size(); ++k) check(row.line, k, row.cells[k]);
}

std::string Csv::place(std::size_t line, std::size_t column) const {
  return fmt::format("{}, line {}, column {} ('{}')", file.string(), line, column + 1, excerpt(columns[column].name));
}

char Csv::decimal_mark(const std::vector<std::size_t>& of_columns) const {
  if (stated_decimal) return *stated_decimal;
  bool comma = false;
  for (const Row& row : rows)
    for (const std::size_t column : of_columns) {
      if (row.cells[column].find('.') != std::string::npos) return '.';
      comma = comma || row.cells[column].find(',') != std::string::npos;
    }
  return comma && delimiter != ',' ? ',' : '.';
}

double Csv::number(const Row& row, std::size_t column, char decimal) const {
  const std::string& cell = row.cells[column];
  const auto refuse = [&](std::string_view found, std::string_view remedy) -> double {
    const auto is_header = [this](const Row& other) {
      return std::equal(other.cells.begin(), other.cells.end(), columns.begin(), columns.end(),
                        [](const std::string& text, const Column& named) { return text == named.text; });
    };
    const auto again = std::find_if(rows.begin(), rows.end(), is_header);
    throw InputError(fmt::format(
        "{}: found {} where a number is expected. {}{}", place(row.line, column), found, remedy,
        again == rows.end()
            ? ""
            : fmt::format(" The names of the columns come again in line {}: a second table begins there. Keep one of "
                          "them in the file, or choose its rows.",
                          again->line)));
  };
  constexpr std::string_view leave_out = "Correct the cell, or leave the row out with \"rows\" or \"where\".";
  if (cell.empty()) return refuse("an empty cell", leave_out);
  std::string digits = cell;
  if (decimal == ',') std::replace(digits.begin(), digits.end(), ',', '.');
  const char* begin = digits.data() + (digits.front() == '+' ? 1 : 0);
  double value = 0;
  const auto [end, error] = std::from_chars(begin, digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range && end == digits.data() + digits.size())
    return digits.find_first_of("eE") != std::string::npos &&
                   digits.find('-', digits.find_first_of("eE")) != std::string::npos
               ? 0.0  // smaller than any double
               : refuse(fmt::format("'{}', too large for a number,", excerpt(cell)), leave_out);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    const bool comma =
        cell.find(',') != std::string::npos && cell.find_first_not_of("+-0123456789.,eE") == std::string::npos;
    return refuse(
        fmt::format("'{}'", excerpt(cell)),
        comma ? "Use a decimal point, or decimal commas throughout with semicolons between the fields." : leave_out);
  }
  if (!std::isfinite(value)) return refuse(fmt::format("'{}'", excerpt(cell)), leave_out);
  return value;
}

}  // namespace tunica::data
