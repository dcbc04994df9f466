// SPDX-License-Identifier: Apache-2.0
#include "discovery/request.hpp"

namespace tunica::discovery {

Request request_of(const experiment::Experiment& experiment) {
  Request request;
  request.seed = experiment.seed;
  const diagnosis::Request of_diagnosis = diagnosis::request_of(experiment);
  request.model = of_diagnosis.model;
  request.tolerance = of_diagnosis.tolerance;
  if (!experiment.discovery) return request;
  const experiment::DiscoveryEntry& entry = *experiment.discovery;
  request.model = entry.model.value_or(request.model);
  request.from_nothing = entry.from_nothing;
  request.invariants = entry.invariants;
  request.laws = entry.laws;
  request.most_terms = entry.most_terms.value_or(0);
  request.most_parameters = entry.most_parameters.value_or(0);
  request.alpha = entry.alpha.value_or(request.alpha);
  return request;
}

diagnosis::Request analysis_request(const Request& request) {
  diagnosis::Request of_analysis;
  of_analysis.model = request.model;
  of_analysis.alpha = request.alpha;
  of_analysis.tolerance = request.tolerance;
  of_analysis.from_scaffold = request.from_nothing;
  of_analysis.quick = request.quick;
  of_analysis.seed = request.seed;
  return of_analysis;
}

}  // namespace tunica::discovery
