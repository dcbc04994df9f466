// SPDX-License-Identifier: Apache-2.0
// Whether draws from the posterior are what they say: rank histograms over data sets drawn from the prior, beside the
// band that holds each bin with probability 0.99, and the share of new rows within the 95 % band of measurements. Then
// how long draws take.   bench_posterior [sets] [draws] [gho|ogden|tube]
#include <chrono>
#include <cstdlib>

#include <fmt/ranges.h>

#include "plugins.hpp"
#include "posterior_ranks.hpp"

namespace {

using namespace tunica;

/// The counts that a bin has with probability 0.99 at least: binomial, 0.5 % at each side.
std::pair<std::size_t, std::size_t> band(std::size_t sets, double share) {
  std::size_t low = 0, high = sets;
  while (1 - numerics::binomial_at_least(low + 1, sets, share) <= 0.005) ++low;
  while (numerics::binomial_at_least(high, sets, share) <= 0.005) --high;
  return {low, high};
}

void calibrate(const char* name, const bench::Prior& prior, std::size_t sets) {
  constexpr std::size_t bins = 10;
  const auto found = bench::ranks(prior, sets, 1600, 20240817);
  const auto [low, high] = band(sets, 1.0 / bins);
  fmt::print("{}, {} data sets; each bin within {} … {} with probability 0.99\n", name, sets, low, high);
  for (std::size_t j = 0; j < found.names.size(); ++j) {
    const auto counts = found.histogram(j, bins);
    const auto outside = std::count_if(counts.begin(), counts.end(),
                                       [&, lo = low, hi = high](std::size_t one) { return one < lo || one > hi; });
    fmt::print("  {:<8} {:>3}   outside {}, χ² as large by chance {:.3f}\n", found.names[j], fmt::join(counts, " "),
               outside, found.chance(j, bins));
  }
  fmt::print("  new rows within their 95 % band: {:.2f} % of {}; chains that agree: {} of {}\n",
             100.0 * static_cast<double>(found.inside) / static_cast<double>(found.new_rows), found.new_rows,
             found.judged_converged, sets);
}

void measure(const bench::Prior& prior, std::size_t draws) {
  using Clock = std::chrono::steady_clock;
  std::vector<double> middle(prior.assembly->layout().parameters.size(), 0.5), free(middle.size());
  prior.assembly->box().from_unit(middle, free);
  std::vector<double> measured(prior.assembly->layout().prediction_count);
  const auto workspace = prior.assembly->evaluator().make_workspace();
  static_cast<void>(prior.assembly->evaluator().predict(free, measured, {}, *workspace));
  const auto begun = Clock::now();
  const auto made = posterior::sample(*prior.assembly, free, draws, 1, {}, measured);
  const double seconds = std::chrono::duration<double>(Clock::now() - begun).count();
  fmt::print("{} draws of two strips: {:.1f} s, {} simulations with derivatives, R-hat {:.4f}, ESS {:.0f}\n",
             made.draws(), seconds, made.evaluations, made.r_hat(), made.effective_size());
}

}  // namespace

int main(int count, char** arguments) {
  const auto sets = static_cast<std::size_t>(count > 1 ? std::atoi(arguments[1]) : 200);
  const auto draws = static_cast<std::size_t>(count > 2 ? std::atoi(arguments[2]) : 100000);
  const std::string only = count > 3 ? arguments[3] : "";
  const auto asked = [&](const char* name) { return sets > 0 && (only.empty() || only == name); };
  const auto gho = bench::gho_strips(bench::catalogue());
  if (asked("gho")) calibrate("gho, two strips", gho, sets);
  if (asked("ogden")) calibrate("ogden, rubber", bench::ogden_rubber(bench::catalogue()), sets);
  if (asked("tube")) calibrate("hgo, long tube", bench::hgo_tube(bench::catalogue()), sets);
  if (draws > 0) measure(gho, draws);
}
