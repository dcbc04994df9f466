// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "diagnosis/file/record.hpp"
#include "diagnosis/hypotheses/hypothesis.hpp"
#include "diagnosis/request.hpp"
#include "diagnosis/result.hpp"

namespace tunica::diagnosis {

/// One possible mistake in the file. It is an exact transform of the data or their meaning, without a parameter; or one
/// or more mechanisms, each with its amplitude.
struct Correction {
  FileKind kind = FileKind::unit;
  std::vector<std::string> tests;
  bool common = false;   ///< the same mistake in all tests that can have it, not only in one
  std::string sentence;  ///< "the stresses of 'axial' are first Piola–Kirchhoff stresses, not Cauchy stresses"
  std::string mend;      ///< what to write into the file
  std::function<bool(Record&)> apply;
  double log_prior = 0;  ///< of this mistake, before the data
  /// Factors on the same numbers are rungs of one ladder, placed at their logarithms. If a rung is worse than the one
  /// before, later rungs are worse still. Empty: no ladder.
  std::string ladder = {};
  double rung = 0;
  std::vector<Addition> additions = {};  ///< of one mechanism, in place of `apply`
  std::vector<Change> changes = {};      ///< the correction for programs; empty: no change of keys corrects it
};

using Corrections = std::vector<Correction>;

/// All mistakes that these tests can have, with their shares of the prior: kinds of mistakes are equally likely, half
/// of each for mistakes that all tests share, half for those of one test, and equal shares within.
Corrections corrections_of(const Inquiry& inquiry, const Record& record, const experiment::RunEntry& run,
                           bool scale_is_seen);

/// The tests of a run that have rows to be fitted.
std::vector<std::string> fitted_tests(const Record& record, const experiment::RunEntry& run);

// The kinds, each by itself.
void add_stress_measures(const Record& record, const std::vector<std::string>& tests, Corrections& all);
void add_strain_definitions(const Record& record, const std::vector<std::string>& tests, Corrections& all);
void add_exchanges(const Record& record, const std::vector<std::string>& tests, Corrections& all);
void add_signs(const Record& record, const std::vector<std::string>& tests, Corrections& all);
/// `scale_is_seen`: the parameters do not absorb a common factor on all stresses.
void add_units(const Record& record, const std::vector<std::string>& tests, bool scale_is_seen, Corrections& all);
void add_tube_sizes(const Record& record, const std::vector<std::string>& tests, Corrections& all);
void add_angles(const Record& record, const experiment::RunEntry& run, const plugins::Catalogue& catalogue,
                Corrections& all);
void add_clocks(const Inquiry& inquiry, const Record& record, const experiment::RunEntry& run, Corrections& all);
/// Those with an amplitude: in each test, of sheets in each direction, and with one amplitude in all tests of a rig.
void add_calibrations(const Record& record, const std::vector<std::string>& tests, const plugins::Catalogue& catalogue,
                      Corrections& all);

/// The corrected statement, with fitted amplitudes.
std::string calibration_words(const Correction& correction, const std::vector<Amplitude>& amplitudes,
                              const plugins::Catalogue& catalogue);

/// One correction for each of the tests, and one for all where there are several.
struct Wording {
  std::string sentence, mend;
  std::vector<Change> changes = {};
};
void add_for_each_and_all(FileKind kind, const std::vector<std::string>& tests,
                          const std::function<Wording(const std::vector<std::string>&)>& words,
                          const std::function<bool(Record&, const std::string&)>& apply, Corrections& all);

/// "'a'", "'a' and 'b'".
std::string quoted(const std::vector<std::string>& names);

}  // namespace tunica::diagnosis
