// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/refit_draws.hpp"

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

#include "diagnosis/causes.hpp"
#include "tunica/random.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t interval_draws = 199, interval_least = 100;

}  // namespace

double p_from_refits(const Diagnosis& d, const Detection& detection, std::size_t draws) {
  const Eigen::MatrixXf noise =
      noise_draws(d.curves, d.fit.residuals.size(), draws, derive_seed(d.settings.seed, "refits under nothing"));
  std::vector<Variable> variables;
  for (std::size_t j = 0; j < d.base->layout().parameters.size(); ++j) variables.push_back({j});
  std::vector<char> worse(draws, 0);
  std::atomic<std::size_t> finished = 0;
  tbb::parallel_for(std::size_t{0}, draws, [&](std::size_t b) {
    const auto workspace = d.base->evaluator().make_workspace();
    // Residuals of data simulated at the fit: those of the measured data drop out, the noise takes their place.
    const Eigen::VectorXd added = noise.col(static_cast<Eigen::Index>(b)).cast<double>() - d.fit.residuals;
    const Fit fit = least_squares(*d.base, variables, d.fit.free, *workspace, 60, {&added, nullptr});
    worse[b] = !fit.status.ok() || detection.judge(-fit.residuals).p <= d.detection.p;
    const double share = static_cast<double>(++finished) / static_cast<double>(draws);
    if (d.settings.progress) d.settings.progress("refits of simulated data", 0.2 + 0.2 * share);
  });
  return (1 + static_cast<double>(std::count(worse.begin(), worse.end(), 1))) / (static_cast<double>(draws) + 1);
}

void refine_intervals(Diagnosis& d, const plugins::Catalogue& catalogue) {
  const Refitted& extension = *d.extension;
  const Eigen::MatrixXf noise = noise_draws(d.curves, d.fit.residuals.size(), interval_draws,
                                            derive_seed(d.settings.seed, "refits of the extension"));
  const std::vector<Variable> variables = extension.extended->variables();
  std::vector<std::vector<double>> found(interval_draws);
  tbb::parallel_for(std::size_t{0}, interval_draws, [&](std::size_t b) {
    const auto workspace = extension.extended->assembly().evaluator().make_workspace();
    const Eigen::VectorXd added = noise.col(static_cast<Eigen::Index>(b)).cast<double>() - extension.fit.residuals;
    const Fit fit =
        least_squares(extension.extended->assembly(), variables, extension.fit.free, *workspace, 40, {&added, nullptr});
    if (fit.status.ok()) found[b] = fit.free;
  });
  std::erase_if(found, [](const auto& free) { return free.empty(); });
  if (found.size() < interval_least) return;
  for (std::size_t a = 0; a < d.named && a < extension.extended->parts().size(); ++a) {
    const std::size_t index = extension.extended->parts()[a].amplitude.front();
    std::vector<double> values;
    for (const auto& free : found) values.push_back(free[index]);
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
      return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
    };
    d.causes[a].amplitude.low = at(0.025), d.causes[a].amplitude.high = at(0.975);
    explain(d.causes[a], catalogue.mechanisms().at(d.causes[a].id).factory);
  }
}

}  // namespace tunica::diagnosis
