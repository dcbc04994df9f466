// SPDX-License-Identifier: Apache-2.0
// bench_cohorts [COHORTS [PERMUTATIONS [CURVE]]]: coverage, false alarms and bias over simulated cohorts, as a table in
// Markdown; docs/cohort_statistics.md has it. Cohort k of setting s has the seed 100000 s + k.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string_view>

#include <fmt/core.h>

#include "population/study.hpp"

namespace {

std::string range(const std::vector<simulated::Share>& shares) {
  double low = 1, high = 0;
  for (const auto& share : shares) {
    low = std::min(low, share.value());
    high = std::max(high, share.value());
  }
  return fmt::format("{:.1f}–{:.1f}", 100 * low, 100 * high);
}

std::string range(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return fmt::format("{:.2f}–{:.2f}", *low, *high);
}

}  // namespace

int main(int count, char** arguments) {
  const std::size_t cohorts = count > 1 ? std::strtoul(arguments[1], nullptr, 10) : 200;
  const std::size_t permutations = count > 2 ? std::strtoul(arguments[2], nullptr, 10) : 999;
  fmt::print("{} cohorts a setting, {} permutations at most; lowest and highest of the parameters\n\n", cohorts,
             permutations);
  fmt::print(
      "| curve | parameters | n | spread | mean covered, % | effect covered, % | spread covered, % | "
      "spread/truth | borrowed | false effect, whole | false effect, any | found, any | unconverged | s |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::uint64_t number = 0;
  for (const auto& [curve, name] : {std::pair(&simulated::strip(), "strip"), std::pair(&simulated::sheet(), "sheet"),
                                    std::pair(&simulated::precise_strip(), "strip, a quarter of the noise")})
    for (const std::size_t specimens : {6u, 12u, 30u})
      for (const double spread : {0.2, 0.4}) {
        ++number;
        if (count > 3 && name != std::string_view(arguments[3])) continue;
        const auto begin = std::chrono::steady_clock::now();
        const auto found = simulated::study({curve, name, specimens, spread}, cohorts, 100000 * number, permutations);
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
        fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.3f} | {:.3f} | {:.3f} | {} | {:.0f} |\n", name,
                   curve->parameters.size(), specimens, spread, range(found.means), range(found.effects),
                   range(found.spreads), range(found.spread_ratio), range(found.borrowed), found.false_whole.value(),
                   found.false_any.value(), found.found_any.value(), found.unconverged, time.count());
        std::fflush(stdout);
      }
}
