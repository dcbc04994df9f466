// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cohort/diagnosis_study.hpp"
#include "cohort/tables.hpp"
#include "cohort_diagnosis/verdict_json.hpp"
#include "results/keys.hpp"
#include "text/csv.hpp"

namespace tunica::cohort {

namespace key = results::key;

using Json = nlohmann::ordered_json;

Json diagnosis_json(const SpecimenTable& table, const DiagnosisStudy& study) {
  Json json = study.none.empty() ? cohort_diagnosis::to_json(study.verdict) : Json{{key::problem, study.none}};
  json[key::alpha] = study.alpha;
  json[key::sentences] = diagnosis_sentences(study);
  json[key::not_diagnosed] = Json::array();
  for (const NotDiagnosed& one : study.problems)
    json[key::not_diagnosed].push_back({{key::specimen, table.specimens[one.position].id}, {key::reason, one.reason}});
  if (!study.extended.empty())
    json[key::extended] = {{key::experiment, "extended.json"}, {key::cohort, "extended_cohort.json"}};
  return json;
}

std::string mechanism_table(const SpecimenTable& table, const DiagnosisStudy& study) {
  std::string text = column_cells(table) + "p_value,mechanism,place,log_evidence\n";
  for (std::size_t s = 0; s < study.positions.size(); ++s) {
    const Specimen& specimen = table.specimens[study.positions[s]];
    const std::string begin = cells_of(table, specimen) + fmt::format("{},", study.verdict.p_values[s]);
    if (study.verdict.matrix.empty()) text += begin + ",,\n";
    for (const auto& row : study.verdict.matrix)
      text += begin + fmt::format("{},{},{}\n", row.id, text::csv_cell(row.place.words()), row.log_evidence[s]);
  }
  return text;
}

}  // namespace tunica::cohort
