// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report/chart.hpp"
#include "report/grid.hpp"
#include "report/table.hpp"

namespace tunica::report {

/// The contents of a result folder, and the files that could not be read.
class Folder {
 public:
  enum class Kind { run, diagnosis, discovery, simulation, cohort };

  /// Throws InputError if the folder is missing, result.json is broken, or there is nothing to report. `address` is how
  /// the page reaches the folder, "" where the page lies in it.
  explicit Folder(std::filesystem::path path, std::string address = "");

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] const std::string& address() const { return address_; }
  [[nodiscard]] std::string name() const;
  /// A file of the folder as a command has it, where the reader stands as whoever named the folder.
  [[nodiscard]] std::string in_command(const std::string& file) const;
  [[nodiscard]] const Json& result() const { return result_; }
  /// None if there is no such table; problems() lists unreadable ones.
  [[nodiscard]] std::optional<Table> table(const std::string& file) const;
  /// The same of a JSON document.
  [[nodiscard]] std::optional<Json> document(const std::string& file) const;
  /// The same of a mesh.
  [[nodiscard]] std::optional<Grid> grid(const std::string& file) const;
  /// The names of the tables that begin so, in order.
  [[nodiscard]] std::vector<std::string> tables(const std::string& prefix) const;
  /// The same of a folder in it, with the way to them.
  [[nodiscard]] std::vector<std::string> tables_in(const std::string& folder, const std::string& prefix) const;
  [[nodiscard]] bool has(const std::string& file) const;
  [[nodiscard]] const std::vector<std::string>& problems() const { return problems_; }

 private:
  void read_result(const std::filesystem::path& file);
  void remember(const std::string& problem) const;
  std::filesystem::path path_;
  std::string address_;
  Kind kind_ = Kind::run;
  Json result_ = Json::object();
  mutable std::vector<std::string> problems_;
};

}  // namespace tunica::report
