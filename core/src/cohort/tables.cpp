// SPDX-License-Identifier: Apache-2.0
#include "cohort/tables.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "text/csv.hpp"
#include "text/lists.hpp"
#include "text/wrapping.hpp"

namespace tunica::cohort {

namespace {

std::string cell(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : ""; }

std::optional<double> least_r2(const Record::Run& run) {
  std::optional<double> least;
  for (const Record::Quality& one : run.quality)
    if (!one.held_out && one.r2 && (!least || *one.r2 < *least)) least = one.r2;
  return least;
}

}  // namespace

std::string column_cells(const SpecimenTable& table) {
  std::string text = "specimen,";
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    if (k != table.id) text += text::csv_cell(table.columns[k].text) + ",";
  return text;
}

std::string cells_of(const SpecimenTable& table, const Specimen& specimen) {
  std::string text = text::csv_cell(specimen.id) + ",";
  for (std::size_t k = 0; k < specimen.cells.size(); ++k)
    if (k != table.id) text += text::csv_cell(specimen.cells[k]) + ",";
  return text;
}

std::string parameter_table(const SpecimenTable& table, const Collection& found) {
  std::string text = column_cells(table) + "run,parameter,unit,estimate,lower,upper,at_bound,identified\n";
  for (std::size_t k = 0; k < table.specimens.size(); ++k) {
    const std::string begin = cells_of(table, table.specimens[k]);
    for (const Record::Run& run : found.records[k].runs)
      for (const Record::Parameter& one : run.parameters)
        text += fmt::format("{}{},{},{},{},{},{},{},{}\n", begin, text::csv_cell(run.label), text::csv_cell(one.name),
                            text::csv_cell(one.unit), one.value, cell(one.lower), cell(one.upper), one.at_bound,
                            one.identified ? 1 : 0);
  }
  return text;
}

std::string specimen_table(const SpecimenTable& table, const Collection& found) {
  std::string text = column_cells(table) + "folder,run,outcome,objective,least_r2,misfit,stable,warnings,reason\n";
  for (std::size_t k = 0; k < table.specimens.size(); ++k) {
    const Record& record = found.records[k];
    const std::string begin = cells_of(table, table.specimens[k]) + table.specimens[k].folder + ",";
    const std::string end = fmt::format("{},{}\n", record.warnings.size(), text::csv_cell(record.reason));
    const std::string outcome(text::code_of(outcome_codes, record.outcome));
    if (record.runs.empty()) text += fmt::format("{},{},,,,,{}", begin, outcome, end);
    for (const Record::Run& run : record.runs)
      text += fmt::format("{}{},{},{},{},{},{},{}", begin, text::csv_cell(run.label), outcome,
                          run.has_result ? fmt::format("{}", run.objective) : "", cell(least_r2(run)), cell(run.misfit),
                          run.stable ? (*run.stable ? "1" : "0") : "", end);
  }
  return text;
}

std::string outcome_words(const SpecimenTable& table, const Collection& found) {
  std::string words = fmt::format("{} of {} fitted\n", found.count(Outcome::fitted),
                                  text::counted(table.specimens.size(), "specimen", "specimens"));
  // Specimens that fail for the same reason stand together: a mistake in the template fails them all.
  std::map<std::string, std::vector<std::string>> reasons;
  std::vector<std::string> order;
  for (std::size_t k = 0; k < found.records.size(); ++k) {
    const Record& record = found.records[k];
    if (record.outcome == Outcome::fitted ||
        std::find(found.missing.begin(), found.missing.end(), k) != found.missing.end())
      continue;
    if (reasons[record.reason].empty()) order.push_back(record.reason);
    reasons[record.reason].push_back(record.id);
  }
  for (const std::string& reason : order)
    words += text::hanging(fmt::format("  {}: ", text::joined(reasons[reason])), reason) + "\n";
  return words;
}

}  // namespace tunica::cohort
