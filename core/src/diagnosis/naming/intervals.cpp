// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/intervals.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "diagnosis/detection/noise_draws.hpp"
#include "diagnosis/naming/causes.hpp"
#include "tunica/random.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t interval_draws = 199, interval_least = 100;

/// All parameters of refits to data simulated from a refit; those that could not be made left out.
std::vector<std::vector<double>> simulated_refits(const Inquiry& inquiry, const Evidence& evidence,
                                                  const Refit& refit) {
  const Eigen::MatrixXf noise =
      noise_draws(evidence, interval_draws, derive_seed(inquiry.request.seed, "refits of the extension")).residuals;
  const std::vector<Variable> variables = refit.extension->variables();
  std::vector<std::vector<double>> found(interval_draws);
  tbb::parallel_for(std::size_t{0}, interval_draws, [&](std::size_t b) {
    const assembly::Assembly& assembly = refit.extension->assembly();
    const auto workspace = assembly.evaluator().make_workspace();
    const Eigen::VectorXd added = noise.col(static_cast<Eigen::Index>(b)).cast<double>() - refit.fit.residuals;
    const Fit fit = least_squares(assembly, variables, refit.fit.free, *workspace, 40, {&added, nullptr});
    if (fit.status.ok()) found[b] = fit.free;
  });
  std::erase_if(found, [](const auto& free) { return free.empty(); });
  return found;
}

}  // namespace

Explanation with_refitted_intervals(const Inquiry& inquiry, const Analysis& analysis, Explanation explanation) {
  Claim& claim = explanation.claim;
  if (!claim.best || inquiry.request.quick) return explanation;
  const std::vector<std::vector<double>> found = simulated_refits(inquiry, analysis.evidence, *claim.best);
  if (found.size() < interval_least) return explanation;
  const std::vector<Extension::Part>& parts = claim.best->extension->parts();
  for (std::size_t a = 0; a < claim.named && a < parts.size(); ++a) {
    const std::size_t index = parts[a].amplitude.front();
    std::vector<double> values;
    for (const auto& free : found) values.push_back(free[index]);
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
      return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
    };
    Cause& cause = claim.causes[a];
    cause.amplitude.low = at(0.025);
    cause.amplitude.high = at(0.975);
    cause.explanation = explanation_of(cause, inquiry.mechanism(cause.id));
  }
  return explanation;
}

}  // namespace tunica::diagnosis
