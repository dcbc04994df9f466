// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/evidence/misfit_size.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::budget {

/// The experiment with one test in a state of its own, in which the fewest parameters differ that do.
struct ProposedState {
  std::string name, test;
  struct Change {
    std::string parameter, unit;
    double value, in_state;  ///< of the other tests, of this one
  };
  std::vector<Change> changes;
  double share = 0;  ///< of the misfit beyond noise that these take
  experiment::Experiment experiment;
  std::shared_ptr<const assembly::Assembly> assembly;
  diagnosis::Fit fit;
};

/// Adds the parameter that takes most, again and again, until the state takes nine tenths of `whole`, which it takes
/// where all differ; with more than three, all do. None where the test has a state already, or no fit succeeds.
std::optional<ProposedState> proposed_state(const diagnosis::Evidence& evidence, const diagnosis::MisfitSize& size,
                                            const std::string& test, double whole, const plugins::Catalogue& catalogue);

}  // namespace tunica::budget
