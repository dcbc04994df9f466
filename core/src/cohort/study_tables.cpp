// SPDX-License-Identifier: Apache-2.0
#include <map>

#include <fmt/format.h>

#include "cohort/study_output.hpp"
#include "comparison/fit_table.hpp"
#include "execution/files.hpp"
#include "text/csv.hpp"

namespace tunica::cohort {

namespace {

template <class Value>
std::string figure_cell(const std::optional<Value>& value) {
  return value ? fmt::format("{}", *value) : "";
}

void append_rows(const std::string& run, const std::string& before, const Analysis& analysis, std::string& text) {
  const auto begin = [&](const char* kind, const Coordinate& of, const std::string& factor, const std::string& group) {
    return fmt::format("{},{}{},{},{},{},{},", text::csv_cell(run), before, kind, text::csv_cell(of.name),
                       text::csv_cell(of.unit), text::csv_cell(factor), text::csv_cell(group));
  };
  for (std::size_t j = 0; j < analysis.coordinates.size(); ++j) {
    for (std::size_t g = 0; g < analysis.groups.size(); ++g) {
      const Estimated& mean = analysis.means[j][g];
      text += begin("mean", analysis.coordinates[j], "", analysis.groups[g]) +
              fmt::format("{},{},{},,,,,\n", mean.value, mean.lower, mean.upper);
    }
    const SpreadSummary& spread = analysis.spreads[j];
    text += begin("spread", analysis.coordinates[j], "", "") +
            fmt::format("{},{},{},,,,,\n", spread.sd, spread.lower, figure_cell(spread.upper));
  }
  for (const Effect& one : analysis.effects)
    for (const Coordinate& of : analysis.coordinates)
      if (of.name == one.of)
        text += begin("effect", of, one.factor, one.level) +
                fmt::format("{},{},{},{},{},{},{},{}\n", one.size.value, one.size.lower, one.size.upper, one.freedom,
                            one.p, one.p_holm, one.p_permutation, one.p_adjusted);
}

}  // namespace

std::string population_table(const Study& study) {
  std::string text = "run,kind,of,unit,factor,group,estimate,lower,upper,freedom,p,p_holm,p_permutation,p_adjusted\n";
  for (const PopulationStudy& one : study.populations) {
    if (one.problem.empty()) append_rows(one.run, "", one.parameters, text);
    if (one.readings.analysis) append_rows(one.run, "reading_", *one.readings.analysis, text);
  }
  return text;
}

std::string shrunken_table(const SpecimenTable& table, const Study& study) {
  std::string text = "specimen,run,parameter,unit,estimate,lower,upper,borrowed\n";
  for (const PopulationStudy& one : study.populations)
    for (std::size_t i = 0; i < one.shrunken.size(); ++i)
      for (std::size_t j = 0; j < one.shrunken[i].size(); ++j) {
        const ShrunkenParameter& of = one.shrunken[i][j];
        const Coordinate& coordinate = one.parameters.coordinates[j];
        text += fmt::format("{},{},{},{},{},{},{},{}\n", text::csv_cell(table.specimens[one.members.specimens[i]].id),
                            text::csv_cell(one.run), text::csv_cell(coordinate.name), text::csv_cell(coordinate.unit),
                            of.estimate.value, of.estimate.lower, of.estimate.upper, of.borrowed);
      }
  return text;
}

void write_bands(const std::filesystem::path& folder, const Study& study) {
  std::map<std::string, std::string> tables;
  for (const PopulationStudy& one : study.populations)
    for (const Band& band : one.bands) {
      std::string& text = tables[band.test];
      if (text.empty())
        text = fmt::format("run,group,channel,{} [{}],mean,lower,upper,unit\n", band.over, band.over_unit);
      for (std::size_t row = 0; row < band.abscissa.size(); ++row)
        text += fmt::format("{},{},{},{},{},{},{},{}\n", text::csv_cell(one.run), text::csv_cell(band.group),
                            text::csv_cell(band.channel), band.abscissa[row], band.mean[row], band.lower[row],
                            band.upper[row], text::csv_cell(band.unit));
    }
  for (const auto& [test, text] : tables)
    execution::write_atomically(folder / ("band_" + comparison::file_stem(test) + ".csv"), text);
}

}  // namespace tunica::cohort
