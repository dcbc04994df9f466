// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/result.hpp"
#include "tunica/mechanism.hpp"

namespace tunica::diagnosis {

/// Amplitudes that are plausible, and the bounds of the search.
struct AmplitudeRange {
  double plausible_min, plausible_max, min, max;
};

/// A mechanism at work: what is added to the experiment.
struct Addition {
  std::string id;
  Place place;
  MechanismFactory::Setting setting;         ///< nuisance parameters and number options where the search begins
  std::optional<AmplitudeRange> range = {};  ///< from the data; none: as the mechanism declares
  std::string as = {};                       ///< of several side by side, the name, from Extension; empty = the id
  /// Seconds from row to row in the tests without time; none: slow enough for the material to relax.
  std::optional<double> pace = {};

  /// The prefix of its parameters.
  [[nodiscard]] const std::string& name() const { return as.empty() ? id : as; }
};

/// One amplitude that may differ from its null, and its effect on the data.
struct Hypothesis {
  const MechanismFactory* mechanism = nullptr;
  Addition addition;
  Eigen::VectorXd signature;  ///< ∂ whitened prediction/∂ amplitude at the null (even: by its square)
  MechanismFactory::Side side = MechanismFactory::Side::both;
  double sign = 1;  ///< −1: a positive score means an amplitude below the null
  /// The signature of amplitudes half as large as plausible ones, per unit of amplitude, where it is another than at
  /// the null.
  bool at_large = false;
};

/// A mechanism that takes part, or why it does not.
struct Candidate {
  std::string id;
  const MechanismFactory* mechanism = nullptr;
  std::vector<Hypothesis> hypotheses;   ///< over places and settings; empty: it leaves no trace in these data
  std::string absent;                   ///< why, in words
  Absence absence = Absence::no_trace;  ///< why; of no meaning where there are hypotheses
  /// Tests in which the mechanism is not considered, or whose material it cannot act on: it has memory, and their past
  /// is unknown.
  std::set<std::string> without_past = {};
};

}  // namespace tunica::diagnosis
