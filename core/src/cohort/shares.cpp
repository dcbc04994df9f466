// SPDX-License-Identifier: Apache-2.0
#include "cohort/shares.hpp"

#include <atomic>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "cohort/evidence.hpp"
#include "execution/first_failure.hpp"

namespace tunica::cohort {

ShareOutcome fit_share(const Specification& cohort, const SpecimenTable& table, const Template& pattern,
                       const plugins::Catalogue& catalogue, const FitSettings& settings, const Share& share,
                       const std::function<void(std::size_t done, std::size_t of)>& told) {
  std::vector<std::size_t> mine;
  for (std::size_t k = 0; k < table.specimens.size(); ++k)
    if (share.holds(k)) mine.push_back(k);
  ShareOutcome outcome;
  outcome.specimens = mine.size();
  std::atomic<std::size_t> done = 0, fitted = 0;
  std::atomic<bool> interrupted = false;
  execution::FirstFailure failure;
  const auto stopped = [&] { return settings.interrupted && settings.interrupted(); };
  tbb::parallel_for(
      std::size_t{0}, mine.size(),
      [&](std::size_t k) {
        if (failure.any()) return;
        if (stopped()) return void(interrupted = true);
        // A search runs parallel loops; a thread that waits for them must not begin another specimen.
        tbb::this_task_arena::isolate([&] {
          failure.guard([&] {
            const auto record = fit(cohort, pattern, table.specimens[mine[k]], catalogue, settings);
            if (!record) return void(interrupted = true);
            if (cohort.diagnosis && stopped()) return void(interrupted = true);
            gather_evidence(cohort, pattern, table.specimens[mine[k]], *record, catalogue, settings);
            if (record->outcome == Outcome::fitted) ++fitted;
            if (told) told(++done, mine.size());
          });
        });
      },
      tbb::simple_partitioner());
  failure.rethrow();
  outcome.fitted = fitted;
  outcome.interrupted = interrupted;
  return outcome;
}

}  // namespace tunica::cohort
