// SPDX-License-Identifier: Apache-2.0
#include "cohort/collection.hpp"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "cohort/evidence.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {

std::size_t Collection::count(Outcome outcome) const {
  return static_cast<std::size_t>(
      std::count_if(records.begin(), records.end(), [outcome](const Record& one) { return one.outcome == outcome; }));
}

Collection collect(const Specification& cohort, const SpecimenTable& table, const Template& pattern,
                   const plugins::Catalogue& catalogue, const std::filesystem::path& results) {
  Collection found;
  found.records.resize(table.specimens.size());
  std::vector<char> missing(table.specimens.size(), 0);  // not bool: written side by side
  tbb::parallel_for(std::size_t{0}, table.specimens.size(), [&](std::size_t k) {
    const Specimen& specimen = table.specimens[k];
    Record& record = found.records[k];
    record = unreadable(specimen);
    if (!specimen.problem.empty()) return;
    try {
      const std::string inputs = bind(cohort, pattern, specimen, catalogue).inputs;
      auto stored = stored_record(results, specimen);
      if (stored && stored->inputs == inputs && !lacks_evidence(cohort, specimen, *stored, results))
        record = std::move(*stored);
      else
        missing[k] = 1;
    } catch (const InputError& problem) {
      record.reason = problem.what();
    }
  });
  for (std::size_t k = 0; k < missing.size(); ++k)
    if (missing[k]) found.missing.push_back(k);
  return found;
}

}  // namespace tunica::cohort
