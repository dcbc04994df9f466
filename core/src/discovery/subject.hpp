// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::discovery {

/// What terms are added to: one model of an experiment, or nothing in its place.
struct Subject {
  experiment::Experiment experiment;  ///< with noise stated for every channel
  experiment::RunEntry run;
  std::string model;          ///< the entry of "models" that gets the terms
  bool from_nothing = false;  ///< the terms take the place of the model
  const plugins::Catalogue& catalogue;
};

/// The experiment in which the model is made of one neo-Hookean term: what a search from nothing is analysed with.
experiment::Experiment with_first_term(experiment::Experiment experiment, const std::string& model);

}  // namespace tunica::discovery
