// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

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
  bool changes_volume = false;  ///< from nothing: sets grow from first_terms() of such a material
};

/// The names of the kinds that a search from nothing is analysed with: a neo-Hookean term, and one of the volume where
/// the material changes it.
std::vector<std::string> first_terms(bool changes_volume, const plugins::Catalogue::Entry<ModelFactory>& writer);

/// The experiment in which the model is made of these terms, by the model that writes terms.
experiment::Experiment with_first_terms(experiment::Experiment experiment, const std::string& model,
                                        bool changes_volume, const plugins::Catalogue::Entry<ModelFactory>& writer);

}  // namespace tunica::discovery
