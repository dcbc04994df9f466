// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cohort/diagnosis_study.hpp"
#include "cohort_diagnosis/verdict_json.hpp"
#include "text/csv.hpp"

namespace tunica::cohort {

using Json = nlohmann::ordered_json;

Json diagnosis_json(const SpecimenTable& table, const DiagnosisStudy& study) {
  Json json = study.none.empty() ? cohort_diagnosis::to_json(study.verdict) : Json{{"problem", study.none}};
  json["alpha"] = study.alpha;
  json["sentences"] = diagnosis_sentences(study);
  json["not_diagnosed"] = Json::array();
  for (const auto& [specimen, reason] : study.problems)
    json["not_diagnosed"].push_back({{"specimen", table.specimens[specimen].id}, {"reason", reason}});
  if (!study.extended.empty()) json["extended"] = {{"experiment", "extended.json"}, {"cohort", "extended_cohort.json"}};
  return json;
}

std::string mechanism_table(const SpecimenTable& table, const DiagnosisStudy& study) {
  std::string text = "specimen,";
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    if (k != table.id) text += text::csv_cell(table.columns[k].text) + ",";
  text += "p_value,mechanism,place,log_evidence\n";
  for (std::size_t s = 0; s < study.positions.size(); ++s) {
    const Specimen& specimen = table.specimens[study.positions[s]];
    std::string begin = text::csv_cell(specimen.id) + ",";
    for (std::size_t k = 0; k < specimen.cells.size(); ++k)
      if (k != table.id) begin += text::csv_cell(specimen.cells[k]) + ",";
    begin += fmt::format("{},", study.verdict.p_values[s]);
    if (study.verdict.matrix.empty()) text += begin + ",,\n";
    for (const auto& row : study.verdict.matrix)
      text += begin + fmt::format("{},{},{}\n", row.id, text::csv_cell(row.place.words()), row.log_evidence[s]);
  }
  return text;
}

}  // namespace tunica::cohort
