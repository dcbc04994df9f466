// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "diagnosis/output/fitted_experiment.hpp"
#include "discovery/output/outputs.hpp"
#include "experiment/reader.hpp"

namespace tunica::discovery {

std::string extended_experiment(const Discovery& d, const plugins::Catalogue& catalogue) {
  if (!d.best || !d.best->set || d.terms.empty()) return {};
  return extended_experiment(*d.best, d.analysis, catalogue);
}

std::string extended_experiment(const SetFit& fit, const diagnosis::Analysis& analysis,
                                const plugins::Catalogue& catalogue) {
  experiment::Experiment experiment = fit.set->experiment();
  // What was asked of the discovery has been answered.
  experiment.discovery.reset();
  return experiment::write_input(diagnosis::fitted_experiment(std::move(experiment), analysis.evidence.run,
                                                              fit.set->assembly(), fit.fit.free, "", catalogue),
                                 catalogue);
}

}  // namespace tunica::discovery
