// SPDX-License-Identifier: Apache-2.0
#include "cohort/results.hpp"

#include <system_error>

#include "cohort/study_output.hpp"
#include "cohort/tables.hpp"
#include "execution/files.hpp"
#include "report/report.hpp"

namespace tunica::cohort {

namespace {

void write_results(const Opened& opened, const Collection& found, const Study& study,
                   const std::filesystem::path& results) {
  execution::write_atomically(results / "cohort.json", opened.cohort.text);
  execution::write_atomically(results / "parameters.csv", parameter_table(opened.table, found));
  execution::write_atomically(results / "specimens.csv", specimen_table(opened.table, found));
  execution::write_atomically(results / "population.csv", population_table(study));
  execution::write_atomically(results / "shrunken.csv", shrunken_table(opened.table, study));
  write_bands(results, study);
  // Files of an earlier diagnosis that this one would not overwrite.
  for (const char* name : {"mechanisms.csv", "extended.json", "extended_cohort.json"}) {
    std::error_code error;
    std::filesystem::remove(results / name, error);
  }
  if (study.diagnosis) {
    execution::write_atomically(results / "mechanisms.csv", mechanism_table(opened.table, *study.diagnosis));
    if (!study.diagnosis->extended.empty()) {
      execution::write_atomically(results / "extended.json", study.diagnosis->extended);
      execution::write_atomically(results / "extended_cohort.json", study.diagnosis->extended_cohort);
    }
  }
  execution::write_atomically(results / "result.json", study_json(opened.cohort, opened.table, found, study));
}

}  // namespace

Opened::Opened(const std::filesystem::path& file, bool diagnose)
    : cohort(read_specification(file)), table(read_specimens(cohort)), pattern(cohort, table) {
  if (diagnose && !cohort.diagnosis) cohort.diagnosis.emplace();
}

Study make_results(const Opened& opened, const Collection& found, const plugins::Catalogue& catalogue,
                   const std::filesystem::path& results,
                   const std::function<void(const std::string& stage, double share)>& told) {
  const Study found_together = study(opened.cohort, opened.table, opened.pattern, found, catalogue, results, told);
  write_results(opened, found, found_together, results);
  report::write_report(results);
  return found_together;
}

}  // namespace tunica::cohort
