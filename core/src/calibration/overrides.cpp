// SPDX-License-Identifier: Apache-2.0
#include "calibration/overrides.hpp"

#include <fmt/format.h>

#include "data/nearest.hpp"
#include "experiment/enum_names.hpp"
#include "experiment/limits.hpp"
#include "experiment/reader.hpp"
#include "tunica/error.hpp"

namespace tunica::calibration {

void apply(const Overrides& overrides, const plugins::Catalogue& catalogue, experiment::Experiment& experiment) {
  if (!overrides.seed && overrides.profiles.empty() && !overrides.bootstrap_draws && !overrides.posterior_draws &&
      overrides.keep_evaluations.empty() && !overrides.paired_starts && !overrides.discrepancy)
    return;
  auto& analysis = experiment.analysis;
  if (overrides.seed) experiment.seed = *overrides.seed;
  if (overrides.paired_starts) experiment.paired_starts = true;
  if (!overrides.profiles.empty()) {
    analysis.all_profiles = overrides.profiles == std::vector<std::string>{"all"};
    analysis.profiles = analysis.all_profiles ? std::vector<std::string>{} : overrides.profiles;
  }
  if (overrides.bootstrap_draws) {
    using namespace experiment::limits;
    if (*overrides.bootstrap_draws < least_draws || *overrides.bootstrap_draws > draws)
      throw InputError(fmt::format("the bootstrap is to draw {} data sets; expected a number from {} to {}",
                                   *overrides.bootstrap_draws, least_draws, draws));
    analysis.bootstrap_draws = *overrides.bootstrap_draws;
  }
  if (overrides.posterior_draws) {
    using namespace experiment::limits;
    if (*overrides.posterior_draws < least_posterior_draws || *overrides.posterior_draws > draws)
      throw InputError(fmt::format("{} draws are asked of the posterior; expected a number from {} to {}",
                                   *overrides.posterior_draws, least_posterior_draws, draws));
    analysis.posterior_draws = *overrides.posterior_draws;
  }
  if (overrides.discrepancy) {
    if (analysis.posterior_draws == 0) analysis.posterior_draws = experiment::limits::usual_posterior_draws;
    analysis.discrepancy = true;
  }
  if (!overrides.keep_evaluations.empty()) {
    const auto kept = text::value_of(experiment::kept_evaluations_names, overrides.keep_evaluations);
    if (!kept)
      throw InputError(fmt::format("--keep-evaluations: found '{}'; expected all or improvements",
                                   data::excerpt(overrides.keep_evaluations)));
    experiment.kept_evaluations = *kept;
  }
  experiment.input_json = experiment::write_input(experiment, catalogue);
}

}  // namespace tunica::calibration
