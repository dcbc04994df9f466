// SPDX-License-Identifier: Apache-2.0
// A data file, the first byte of the input being what the layout says of it: a table whose cells are numbers or
// refused.
#include <cmath>

#include "data/csv.hpp"
#include "fuzz/fuzzing.hpp"

using namespace tunica;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const unsigned choice = data[0];
  data::TableLayout layout;
  if (choice & 1) layout.skip_lines = choice >> 5;
  if (choice & 2) layout.delimiter = ",;\t "[choice >> 6];
  if (choice & 4) layout.decimal = choice & 32 ? ',' : '.';
  layout.by_position = choice & 8;
  if (choice & 16) layout.row_names = "";
  fuzzing::expect_read_or_refused([&] {
    const data::Csv csv = data::parse_csv("fuzzed.csv", fuzzing::text_of(data + 1, size - 1), layout);
    fuzzing::promise(!csv.columns.empty() && !csv.rows.empty(), "a table has columns and rows");
    for (const auto& row : csv.rows) fuzzing::promise(row.cells.size() >= csv.columns.size(), "a row has every cell");
    for (std::size_t column = 0; column < csv.columns.size(); ++column) {
      fuzzing::expect_read_or_refused([&] {
        const char decimal = csv.decimal_mark({column});
        for (const auto& row : csv.rows)
          fuzzing::promise(std::isfinite(csv.number(row, column, decimal)), "a number is finite");
      });
      fuzzing::expect_read_or_refused([&] { (void)csv.column(csv.columns[column].name); });
    }
  });
  return 0;
}
