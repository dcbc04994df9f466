// SPDX-License-Identifier: Apache-2.0
#include <bit>

#include <fmt/format.h>

#include "data/csv.hpp"
#include "data/dataset.hpp"
#include "properties.hpp"
#include "text/csv.hpp"
#include "text/escaped.hpp"

namespace tunica::data {
namespace {

std::string written(double value, char decimal) {
  std::string text = fmt::format("{}", value);
  if (const std::size_t at = text.find('.'); at != std::string::npos) text[at] = decimal;
  return text;
}

RC_GTEST_PROP(Reader, EveryNumberOfATableReadsBackBitForBit, ()) {
  const std::size_t columns = *rc::gen::inRange<std::size_t>(2, 6);
  const auto table = *properties::table(columns);
  const char delimiter = *rc::gen::element(',', ';', '\t');
  const char decimal = delimiter == ',' ? '.' : *rc::gen::element('.', ',');
  const std::string line_end = *rc::gen::element<std::string>("\n", "\r\n");
  std::string text = *rc::gen::element<std::string>("", "\xEF\xBB\xBF");
  for (std::size_t column = 0; column < columns; ++column)
    text += fmt::format("{}column{}", column == 0 ? "" : std::string(1, delimiter), column);
  for (const auto& row : table) {
    text += line_end;
    for (std::size_t column = 0; column < columns; ++column)
      text += (column == 0 ? "" : std::string(1, delimiter)) + written(row[column], decimal);
  }
  const Csv csv = parse_csv("table.csv", text + line_end);
  RC_ASSERT(csv.columns.size() == columns);
  RC_ASSERT(csv.rows.size() == table.size());
  for (std::size_t column = 0; column < columns; ++column) {
    const char mark = csv.decimal_mark({column});
    for (std::size_t row = 0; row < table.size(); ++row) {
      const double read = csv.number(csv.rows[row], column, mark);
      RC_ASSERT(std::bit_cast<std::uint64_t>(read) == std::bit_cast<std::uint64_t>(table[row][column]));
    }
  }
}

RC_GTEST_PROP(Reader, EveryCellThatIsWrittenReadsBack, ()) {
  const auto cells = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::string>>(
      rc::gen::container<std::string>(rc::gen::elementOf(std::string("ab1 ,;\"'#[]\t|.")))));
  std::string text = "id,note\n";
  for (std::size_t row = 0; row < cells.size(); ++row) text += fmt::format("s{},{}\n", row, text::csv_cell(cells[row]));
  TableLayout layout;
  layout.row_names = "";
  const Csv csv = parse_csv("table.csv", text, layout);
  RC_ASSERT(csv.rows.size() == cells.size());
  const auto trimmed = [](const std::string& cell) {
    const std::size_t first = cell.find_first_not_of(" \t"), last = cell.find_last_not_of(" \t");
    return first == std::string::npos ? std::string() : cell.substr(first, last - first + 1);
  };
  for (std::size_t row = 0; row < cells.size(); ++row)
    RC_ASSERT(trimmed(text::cell_text(csv.rows[row].cells[1])) == trimmed(text::escaped(cells[row])));
}

/// The rows that a range takes are those of a slice in Python.
RC_GTEST_PROP(Reader, ARangeOfRowsIsASlice, ()) {
  const auto count = *rc::gen::inRange<std::ptrdiff_t>(0, 50);
  const auto first = *rc::gen::inRange<std::ptrdiff_t>(-60, 60);
  const auto last = *rc::gen::inRange<std::ptrdiff_t>(-60, 60);
  const bool open = *rc::gen::arbitrary<bool>();
  const auto place = [count](std::ptrdiff_t at) {
    return std::max<std::ptrdiff_t>(0, std::min(at < 0 ? at + count : at, count));
  };
  const std::ptrdiff_t begin = place(first), end = open ? count : place(last);
  RowRange range;
  range.first = first;
  if (!open) range.last = last;
  const auto [found_begin, found_end] = range.among(static_cast<std::size_t>(count));
  for (std::ptrdiff_t row = 0; row < count; ++row) {
    const auto at = static_cast<std::size_t>(row);
    RC_ASSERT((row >= begin && row < end) == (at >= found_begin && at < found_end));
  }
}

}  // namespace
}  // namespace tunica::data
