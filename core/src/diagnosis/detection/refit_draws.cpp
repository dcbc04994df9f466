// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/detection/refit_draws.hpp"

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

#include "diagnosis/detection/noise_draws.hpp"
#include "tunica/random.hpp"

namespace tunica::diagnosis {

double p_from_refits(const Inquiry& inquiry, const Evidence& evidence, const Detector& detector,
                     const Detection& measured, std::size_t draws) {
  const assembly::Assembly& base = *evidence.base;
  const Fit& fit = evidence.fit;
  const Draws noise = noise_draws(evidence, draws, derive_seed(inquiry.request.seed, "refits under nothing"));
  const std::vector<Variable> variables = all_variables(base);
  std::vector<char> worse(draws, 0);
  std::atomic<std::size_t> finished = 0;
  tbb::parallel_for(std::size_t{0}, draws, [&](std::size_t b) {
    const auto workspace = base.evaluator().make_workspace();
    // Residuals of data simulated at the fit: simulated noise replaces the residuals of the measured data.
    Eigen::VectorXd simulated = noise.residuals.col(static_cast<Eigen::Index>(b)).cast<double>();
    const Eigen::VectorXd precision = noise.precision_of_rows(static_cast<Eigen::Index>(b));
    if (precision.size() > 0) simulated = simulated.cwiseQuotient(precision.cwiseSqrt()).eval();
    const Eigen::VectorXd added = simulated - fit.residuals;
    const Fit refit = least_squares(base, variables, fit.free, *workspace, 60, {&added, nullptr});
    worse[b] = !refit.status.ok() || detector.test(-refit.residuals, precision).p <= measured.p;
    const double share = static_cast<double>(++finished) / static_cast<double>(draws);
    inquiry.report("refits of simulated data", 0.2 + 0.2 * share);
  });
  return (1 + static_cast<double>(std::count(worse.begin(), worse.end(), 1))) / (static_cast<double>(draws) + 1);
}

}  // namespace tunica::diagnosis
