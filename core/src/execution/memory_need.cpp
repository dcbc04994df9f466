// SPDX-License-Identifier: Apache-2.0
#include "execution/memory_need.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::execution {

namespace {

// Measured: 10 kB per realisation with es and one parameter. A realisation has a result, its improvements, a meter, a
// checkpoint entry (twice while it is written) and a row of the tables.
constexpr double realisation_bytes = 10000, realisation_parameter_bytes = 100;
constexpr double draw_bytes = 300, number_bytes = sizeof(double);
constexpr double posterior_number_bytes = 5 * number_bytes;  // kept, sorted, ranked, and as text
constexpr double copies = 4;  // of predictions and derivatives, in evaluator, optimiser and linear algebra

std::string size_text(double bytes) {
  constexpr double GiB = 1024.0 * 1024 * 1024;
  return bytes < GiB ? fmt::format("{:.0f} MiB", bytes / (1024 * 1024)) : fmt::format("{:.3g} GiB", bytes / GiB);
}

}  // namespace

std::vector<MemoryShare> memory_need(const Plan& plan, unsigned threads) {
  double realisations = 0, of_realisations = 0, of_draws = 0, of_posterior = 0, numbers = 0, rows = 0;
  const auto draws = static_cast<double>(plan.experiment->analysis.bootstrap_draws);
  const auto posterior = static_cast<double>(plan.experiment->analysis.posterior_draws);
  for (const auto& run : plan.runs) {
    const assembly::Layout& layout = run.assembly->layout();
    const auto free = static_cast<double>(layout.parameters.size());
    const auto count = static_cast<double>(run.entry->realisations);
    realisations += count;
    of_realisations += count * (realisation_bytes + realisation_parameter_bytes * free);
    of_draws += draws * (draw_bytes + number_bytes * free);
    of_posterior += posterior * posterior_number_bytes * (free + 2);
    rows = std::max(rows, static_cast<double>(layout.prediction_count));
    numbers = std::max(numbers, static_cast<double>(layout.prediction_count) * (free + 1));
  }
  return {{of_realisations, fmt::format("{:.0f} realisations", realisations), "lower \"realisations\" of the runs"},
          {of_draws, fmt::format("{:.0f} draws of the bootstrap", draws), "lower \"draws\" of the bootstrap"},
          {of_posterior, fmt::format("{:.0f} draws of the posterior", posterior), "lower \"draws\" of the posterior"},
          {numbers * number_bytes * copies * threads, fmt::format("{:.0f} rows in {} threads", rows, threads),
           "use fewer threads (-j), or fewer rows (\"rows\", \"resample\")"}};
}

void refuse_excess(const std::vector<MemoryShare>& need, double limit) {
  double sum = 0;
  for (const MemoryShare& share : need) sum += share.bytes;
  if (!(sum > limit)) return;
  const auto& most = *std::max_element(need.begin(), need.end(),
                                       [](const auto& one, const auto& other) { return one.bytes < other.bytes; });
  throw InputError(
      fmt::format("the experiment needs about {} of memory, most of it for {} ({}), and this process may "
                  "have {}; {}",
                  size_text(sum), most.what, size_text(most.bytes), size_text(limit), most.remedy));
}

}  // namespace tunica::execution
