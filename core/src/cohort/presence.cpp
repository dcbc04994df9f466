// SPDX-License-Identifier: Apache-2.0
#include "cohort/presence.hpp"

#include <tbb/parallel_for.h>

#include "cohort/evidence.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {

std::vector<char> missing_records(const Specification& cohort, const SpecimenTable& table, const Template& pattern,
                                  const plugins::Catalogue& catalogue, const std::filesystem::path& results) {
  std::vector<char> missing(table.specimens.size(), 0);  // not bool: written side by side
  tbb::parallel_for(std::size_t{0}, missing.size(), [&](std::size_t k) {
    const Specimen& specimen = table.specimens[k];
    if (!specimen.problem.empty()) return;
    try {
      const std::string inputs = bind(cohort, pattern, specimen, catalogue).inputs;
      const auto stored = stored_record(results, specimen);
      missing[k] = !stored || stored->inputs != inputs || lacks_evidence(cohort, specimen, *stored, results);
    } catch (const InputError&) {
      // It cannot be read: the merge lists it with its reason.
    }
  });
  return missing;
}

std::vector<ShareProgress> progress_of_shares(const std::vector<char>& missing, std::size_t shares) {
  std::vector<ShareProgress> progress;
  for (std::size_t part = 1; part <= shares; ++part) progress.push_back({{part, shares}, 0, 0});
  for (std::size_t k = 0; k < missing.size(); ++k) {
    ShareProgress& one = progress[k % shares];  // as Share::holds has it
    ++one.specimens;
    one.missing += missing[k] != 0;
  }
  return progress;
}

}  // namespace tunica::cohort
