// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/hypotheses/hypothesis.hpp"

namespace tunica::diagnosis {

/// Whether the mechanism has an option of that name.
bool takes(const MechanismFactory& mechanism, const std::string& option);

/// The group that a mechanism belongs to: as it declares, else by the stage that it acts on.
CauseGroup group_of(const MechanismFactory& mechanism);

/// Whether the load on a test is taken off: its abscissa falls by a tenth of what it spans from its largest so far.
bool unloads(const assembly::Assembly& base, const std::string& test);

/// The clocks of the data, s; none where no fitted test has one.
struct Clock {
  double shortest = INFINITY, longest = 0;  ///< step and duration
  double pace = 0;                          ///< from row to row, on average
  bool missing = false;                     ///< in some test whose pace is open
  /// The possible pace of tests without a clock: too fast to relax, or that of the other tests.
  [[nodiscard]] std::vector<double> paces() const;
};
Clock clock_of(const experiment::Experiment& experiment, const experiment::RunEntry& run,
               const plugins::Catalogue& catalogue);
/// Whether the loading rate of a test is unknown: its rows are taken as a first loading, and have no time.
bool pace_is_open(const experiment::TestEntry& entry, const data::Dataset& dataset);

bool needs_clock(const MechanismFactory& mechanism);

/// Where to look for a mechanism: as it declares, or over the clock of the data for nuisance parameters in seconds.
std::vector<MechanismFactory::Setting> settings_to_try(const MechanismFactory& mechanism, const Clock& clock);

/// Tests and channels, one by one, where the mechanism may act; nothing for one that acts on the model.
std::vector<Place> single_places(const MechanismFactory& mechanism, const experiment::Experiment& experiment,
                                 const experiment::RunEntry& run, const assembly::Assembly& base);

/// A curve's mean shift restricted to single rows: one column a row, whitened like the residuals. Points of a field are
/// none: bad ones are left out by their quality.
void add_rows(const Hypothesis& whole, const assembly::Assembly& base, std::vector<Hypothesis>& into);

}  // namespace tunica::diagnosis
