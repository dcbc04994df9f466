// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cohort_diagnosis/profile.hpp"
#include "diagnosis/evidence/tolerance.hpp"

namespace tunica::cohort_diagnosis {

/// A column of the cohort's table: the level of every specimen, by its id.
struct Factor {
  std::string name;
  std::map<std::string, std::string> level;
};

struct Request {
  double alpha = 0.05;  ///< false alarms that are accepted, of the cohort as a whole
};

/// Amplitudes of a cause over specimens: their common mean with a 95 % interval, and how much specimens differ.
struct CommonAmplitude {
  std::string name, unit;
  double mean = 0, low = 0, high = 0;
  double spread = 0;
  bool squared = false;  ///< numbers are of the square of the amplitude: the mechanism is even
};

/// One explanation of the misfit of the whole cohort: a mechanism, or two together.
struct Explanation {
  std::vector<std::string> ids;
  std::vector<diagnosis::Place> places;
  std::vector<std::vector<std::pair<std::string, double>>> settings;
  double log_evidence = 0;  ///< over nothing, of its likeliest place and setting
  double log_weight = 0;    ///< over all places and settings, with the odds before the data
  double probability = 0;
  bool in_set = false;
};

/// The relation of a factor to the cause.
struct LevelEvidence {
  std::string level;
  std::size_t specimens = 0;
  double with = 0, without = 0;  ///< ln of the evidence that these specimens have the effect, and that they have not
  std::optional<CommonAmplitude> amplitude;
};
struct FactorEvidence {
  std::string factor;
  std::vector<LevelEvidence> levels;
  std::optional<std::string> only_in;  ///< the level that alone has the effect
  double probability_only = 0;         ///< that one level alone has it
};

/// "p = 0.003"; very small ones are said to be so.
std::string p_words(double p);

/// Why a specimen contradicts the verdict.
enum class ContradictionKind {
  not_seen,      ///< the others say that it should show the effect, and it does not
  other_size,    ///< it shows it, of a size or side that the others do not have
  other_cause,   ///< something else explains it better
  rest_is_left,  ///< the cause leaves what is no noise
  shows_effect   ///< nothing is wrong with the cohort or its group, but with this one
};
const char* code_of(ContradictionKind kind);
struct Contradiction {
  std::string specimen;
  ContradictionKind kind;
  std::string text;  ///< one clause, without a full stop
};

/// |r|² of one specimen without the cause, with its own amplitude, and with that of the others.
struct LeftOut {
  std::string specimen;
  std::size_t rows = 0;
  double without = 0, own = 0, foretold = 0;
};

/// A row of the picture mechanism × specimen: ln of the evidence over that of the base, by specimen.
struct MatrixRow {
  std::string id;
  diagnosis::Place place;
  std::vector<double> log_evidence;
};

enum class CohortReasonKind { no_alarm, many_explanations, not_clean, no_trace, single_place, one_specimen };
const char* code_of(CohortReasonKind kind);
struct CohortReason {
  CohortReasonKind kind;
  std::string text;
};

/// How far the model misses the specimens beyond noise, as a share of the range.
struct CohortSize {
  double rms = 0;  ///< squares averaged over specimens
  diagnosis::Tolerance tolerance;
  std::size_t within = 0;  ///< specimens that it is reached in, by the upper bound
};

struct CohortVerdict {
  diagnosis::Verdict verdict = diagnosis::Verdict::nothing_detected;
  std::vector<CohortReason> reasons;
  double p_value = 1;  ///< of all specimens together
  bool alarm = false;
  std::vector<Explanation> explanations;              ///< likeliest first; empty without an alarm
  std::size_t named = 0;                              ///< mechanisms in the best explanation
  std::vector<std::string> ambiguity_set;             ///< ids
  std::vector<std::vector<std::string>> look_alikes;  ///< explanations of the set by what looks alike
  std::vector<CommonAmplitude> amplitudes;            ///< of the best explanation
  std::vector<FactorEvidence> factors;
  std::vector<Contradiction> contradictions;
  std::vector<LeftOut> left_out;  ///< of a single mechanism; specimens left out one by one
  CohortSize size;
  double p_rest = 1;                   ///< of the smooth shapes that the best explanation leaves
  std::vector<std::string> specimens;  ///< in the order of the matrix
  std::vector<double> p_values;        ///< of each by itself
  /// How alike the mechanisms of the matrix look where they act best: mean |cosine| over the specimens, by rows of it.
  std::vector<std::vector<double>> likeness;
  std::vector<MatrixRow> matrix;  ///< likeliest mechanism first
};

}  // namespace tunica::cohort_diagnosis
