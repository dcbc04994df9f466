// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.hpp"

namespace tunica::report {

/// A result table, read as a report has to: what is missing is empty, what is no number is NaN, nothing throws once it
/// is read. Columns go by their name without the unit.
class Table {
 public:
  /// Nothing where there is no such file or it has no rows; `problem` says so where it exists and cannot be read.
  static std::optional<Table> read(const std::filesystem::path& file, std::string& problem);

  [[nodiscard]] const std::string& file_name() const { return name_; }
  [[nodiscard]] std::size_t rows() const { return csv_.rows.size(); }
  [[nodiscard]] const std::vector<data::Csv::Column>& columns() const { return csv_.columns; }
  [[nodiscard]] std::optional<std::size_t> find(std::string_view column) const;
  [[nodiscard]] const std::string& text(std::size_t row, std::size_t column) const;
  [[nodiscard]] double number(std::size_t row, std::size_t column) const;
  /// The same by name: "" and NaN where there is no such column.
  [[nodiscard]] const std::string& text(std::size_t row, std::string_view column) const;
  [[nodiscard]] double number(std::size_t row, std::string_view column) const;
  /// "stress [kPa]" as it stands in the header, without "[1]".
  [[nodiscard]] std::string title(std::size_t column) const;
  /// The rows of each value of a column, in the order of first appearance.
  [[nodiscard]] std::vector<std::pair<std::string, std::vector<std::size_t>>> groups(std::string_view column) const;

 private:
  std::string name_;
  data::Csv csv_;
};

}  // namespace tunica::report
