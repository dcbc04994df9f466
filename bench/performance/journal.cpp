// SPDX-License-Identifier: Apache-2.0
// A row of evaluations.csv: five parameters, two tests, buffered and written as in a run; beside fwrite of the same
// bytes.
#include "execution/journal.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "rows.hpp"

namespace tunica::bench {
namespace {

constexpr std::size_t rows = 2000;

struct Evaluations {
  std::vector<double> parameters, per_test;
  Status ok;

  Evaluations() {
    for (std::size_t k = 0; k < 5 * rows; ++k) parameters.push_back(10 + 9 * std::sin(1.7 * static_cast<double>(k)));
    for (std::size_t k = 0; k < 2 * rows; ++k) per_test.push_back(60 + 30 * std::cos(0.3 * static_cast<double>(k)));
  }
  [[nodiscard]] search::Record record(std::size_t k, std::uint64_t index) const {
    return {index,
            std::span(parameters).subspan(5 * k, 5),
            per_test[2 * k] + per_test[2 * k + 1],
            std::span(per_test).subspan(2 * k, 2),
            ok,
            1e-5 * static_cast<double>(index)};
  }
};

/// A journal that is begun anew before it gets large.
struct Book {
  static constexpr std::size_t most = 200 * rows;
  execution::EvaluationTable table{{{"gho/es",
                                     {{"mu", "kPa"}, {"kappa", "1"}, {"k1", "kPa"}, {"k2", "1"}, {"theta", "deg"}},
                                     {"circumferential_strip", "axial_strip"}}}};
  Evaluations evaluations;
  std::filesystem::path folder = scratch() / "journal";
  std::unique_ptr<execution::Journal> journal;
  std::uint64_t index = 0;

  void begin() {
    journal.reset();
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    journal = std::make_unique<execution::Journal>(folder, table, std::vector<execution::Task>{{0, 1}},
                                                   execution::Journal::Stored{});
    index = 0;
  }
  void write() {
    if (!journal || index >= most) begin();
    for (std::size_t k = 0; k < rows; ++k, ++index) journal->record(0, evaluations.record(k, index));
  }
};

struct Bytes {
  std::string text;
  std::FILE* file = nullptr;
  std::size_t written = 0;
  std::filesystem::path path = scratch() / "bytes";

  ~Bytes() {
    if (file != nullptr) std::fclose(file);
  }
  void write() {
    if (file == nullptr || written >= Book::most / rows) {
      if (file != nullptr) std::fclose(file);
      file = std::fopen(path.c_str(), "w");
      written = 0;
    }
    const std::size_t line = text.size() / rows;
    for (std::size_t k = 0; k < rows; ++k) std::fwrite(text.data() + k * line, 1, line, file);
    ++written;
  }
};

Prepared journal() {
  const auto book = std::make_shared<Book>();
  const auto bytes = std::make_shared<Bytes>();
  fmt::memory_buffer text;
  for (std::size_t k = 0; k < rows; ++k) book->table.append_row(text, 0, 1, book->evaluations.record(k, k));
  bytes->text.assign(text.data(), text.size());
  Prepared row;
  row.work = {[book] { book->write(); }, rows};
  row.floors = {{"fwrite of the same bytes", "", {[bytes] { bytes->write(); }, rows}}};
  row.facts = {{"bytes_per_row", static_cast<double>(text.size()) / rows}};
  return row;
}

}  // namespace

std::vector<Row> journal_rows() {
  return {{.name = "journal/row",
           .what = "a row of evaluations.csv",
           .unit = "row",
           .by = "",
           .sizes = {1},
           .make = [](std::size_t) { return journal(); }}};
}

}  // namespace tunica::bench
