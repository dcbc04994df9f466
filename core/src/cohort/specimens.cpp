// SPDX-License-Identifier: Apache-2.0
#include "cohort/specimens.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "data/nearest.hpp"
#include "data/sha256.hpp"
#include "text/lists.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {

namespace {

/// Letters, digits, '-', '_' and '.' stay, and as many of them as a file name has room for beside endings. An id that
/// had to change gets the beginning of its hash, so that two ids never share a folder.
std::string folder_of(const std::string& id) {
  constexpr std::size_t longest = 100;
  std::string name = id.substr(0, longest);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string_view("-_.").find(c) == std::string_view::npos)
      c = '-';
  if (name.front() == '.') name.front() = '-';
  return name == id ? name : name + "-" + data::sha256(id).substr(0, 8);
}

/// Whether a row has, in every column of `where`, one of the values given for it.
bool is_wanted(const SpecimenTable& table, const Specification& cohort, const std::vector<std::string>& cells) {
  std::map<std::size_t, bool> met;
  for (const auto& [name, value] : cohort.where) {
    const std::size_t column = table.column(name, cohort.table_place);
    met[column] = met[column] || cells[column] == value;
  }
  return std::all_of(met.begin(), met.end(), [](const auto& entry) { return entry.second; });
}

/// Duplicate ids, which do not identify a row.
void refuse_duplicates(SpecimenTable& table) {
  std::map<std::string, std::vector<std::string>> lines;
  for (const Specimen& specimen : table.specimens) lines[specimen.id].push_back(fmt::format("{}", specimen.line));
  for (Specimen& specimen : table.specimens)
    if (const auto& where = lines[specimen.id]; where.size() > 1)
      specimen.problem = fmt::format("the id '{}' stands in lines {} of {}. Give each specimen an id of its own",
                                     specimen.id, text::joined(where), table.file.string());
}

Factor factor_of(const FactorEntry& entry, SpecimenTable& table) {
  Factor factor;
  factor.column = entry.column;
  const std::size_t column = table.column(entry.column, entry.place);
  std::set<std::string> levels;
  for (Specimen& specimen : table.specimens) {
    if (specimen.cells[column].empty() && specimen.problem.empty())
      specimen.problem = fmt::format("{}, line {}: the factor '{}' has no value. Fill it in, or take the row out",
                                     table.file.string(), specimen.line, entry.column);
    if (specimen.problem.empty()) levels.insert(specimen.cells[column]);
  }
  factor.levels.assign(levels.begin(), levels.end());
  if (entry.reference) {
    const auto found = std::find(factor.levels.begin(), factor.levels.end(), *entry.reference);
    if (found == factor.levels.end())
      throw InputError(fmt::format("{}: no specimen has '{}' in the column '{}'. {}", entry.place, *entry.reference,
                                   entry.column, data::suggestion(*entry.reference, factor.levels)));
    std::rotate(factor.levels.begin(), found, found + 1);
  }
  if (factor.levels.size() < 2)
    factor.refusal = fmt::format("the factor '{}' has one level, '{}', so that there is nothing to compare",
                                 entry.column, factor.levels.empty() ? "" : factor.levels.front());
  for (const Specimen& specimen : table.specimens)
    factor.of.push_back(static_cast<std::size_t>(
        std::find(factor.levels.begin(), factor.levels.end(), specimen.cells[column]) - factor.levels.begin()));
  return factor;
}

}  // namespace

std::size_t SpecimenTable::column(const std::string& name, const std::string& place) const {
  std::vector<std::string> known;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].name == name || columns[k].text == name) return k;
    known.push_back(columns[k].name);
  }
  throw InputError(fmt::format("{}: the table {} has no column '{}'. {}", place, file.string(), name,
                               data::suggestion(name, known)));
}

SpecimenTable read_specimens(const Specification& cohort) {
  data::TableLayout layout;
  layout.row_names = cohort.id_column;
  const data::Csv csv = data::parse_csv(cohort.table, data::read_bytes(cohort.table), layout);
  csv.require_utf8(true);
  SpecimenTable table{cohort.table, csv.columns, 0, {}, {}};
  if (!cohort.id_column.empty()) table.id = table.column(cohort.id_column, cohort.table_place);
  const std::size_t id = table.id;
  const bool nested = !cohort.nested_in.empty();
  const std::size_t animal = nested ? table.column(cohort.nested_in, cohort.nested_place) : 0;
  for (const data::Csv::Row& row : csv.rows) {
    if (!is_wanted(table, cohort, row.cells)) continue;
    Specimen specimen{row.cells[id], {}, row.line, row.cells, row.cells[nested ? animal : id], {}};
    if (specimen.id.empty()) {
      specimen.id = fmt::format("line {}", row.line);
      specimen.problem = fmt::format("{}, line {}: the specimen has no id. Fill in the column '{}'",
                                     table.file.string(), row.line, csv.columns[id].name);
    }
    if (nested && specimen.animal.empty() && specimen.problem.empty())
      specimen.problem = fmt::format("{}, line {}: the column '{}' is empty. Say which animal the specimen is from",
                                     table.file.string(), row.line, cohort.nested_in);
    specimen.folder = folder_of(specimen.id);
    table.specimens.push_back(std::move(specimen));
  }
  if (table.specimens.empty())
    throw InputError(fmt::format("{}: no row is left of the {} in {}. Check \"where\"", cohort.table_place,
                                 csv.rows.size(), cohort.table.string()));
  refuse_duplicates(table);
  for (const FactorEntry& entry : cohort.factors) table.factors.push_back(factor_of(entry, table));
  return table;
}

}  // namespace tunica::cohort
