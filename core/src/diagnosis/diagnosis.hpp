// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/detection.hpp"
#include "diagnosis/hypotheses.hpp"
#include "diagnosis/noise_statement.hpp"
#include "diagnosis/scores.hpp"
#include "diagnosis/settings.hpp"

/// What the simulation gets wrong, why, and what is gained by adding the cause: docs/diagnosis.md.
namespace tunica::diagnosis {

enum class Verdict { nothing_detected, named, indistinguishable, unknown, suspect_data };
const char* name_of(Verdict verdict);

/// Where measured and predicted values disagree more than noise explains.
struct Misfit {
  std::string test, channel;
  std::string where;  ///< "stretch 1.3 … 1.6, measured above predicted by up to 3.1 σ"
  double p_value = 1;
  double from = 0, to = 0;  ///< of the abscissa
};

struct Amplitude {
  std::string name, unit;
  double value = 0, low = 0, high = 0;  ///< 95 % interval
  bool at_bound = false, plausible = true;
};

struct Cause {
  std::string id;
  Target target;
  /// Of what it takes of |r|² at finite amplitude (beside others: what is lost without it), where nothing is wrong and
  /// the mechanism is looked for in all its places.
  double p_value = 1;
  double probability = 0;  ///< that it is this one, of the mechanisms of the catalogue
  Amplitude amplitude;
  std::vector<Amplitude> nuisance;
  double retained = 0;  ///< share of its signature that a refit of the parameters does not absorb
  double gain = 0;      ///< of |r|² at finite amplitude
  std::string explanation;
  /// How far the parameters of the base model had gone to make up for it: name, without, with it.
  struct Shift {
    std::string name, unit;
    double before, after;
  };
  std::vector<Shift> shifts;
};

/// A mechanism as the only explanation, among all that were tried.
struct Ranked {
  std::string id;
  Target target;  ///< of its best hypothesis
  double probability = 0;
  double score = 0;            ///< T at the null, of the best hypothesis
  std::optional<double> gain;  ///< of |r|² at finite amplitude; none: too far behind to be fitted again
};

/// The least amplitude of a mechanism that would be found on these data with 80 % power, and named.
struct Detectable {
  std::string id, unit, absent;  ///< absent: why it leaves no trace; else empty
  Target target;
  /// Distances of the amplitude from its null; identifiable: infinite where another has the same signature.
  double detectable = 0, identifiable = 0;
  double null = 0;   ///< the amplitude that does nothing
  double reach = 0;  ///< the largest plausible distance from it
  double retained = 0;
  std::string closest;     ///< the other mechanism whose projected signature is most alike
  double correlation = 0;  ///< with it, absolute
};

struct HeldOut {
  std::string block;
  double before = 0, after = 0;  ///< root mean square of whitened errors
  double p_value = 1;            ///< of the block under the extension, parameter uncertainty included
  std::size_t rows = 0;
};

struct Gain {
  double before = 0, after = 0;  ///< |r|² in sample
  double expected_under_nothing = 0;
  std::vector<HeldOut> held_out;
  std::string best_wrong;  ///< the mechanism outside the ambiguity set that gains most
  double best_wrong_after = 0;
};

struct NextExperiment {
  std::string description;
  std::vector<std::string> separates;
  std::optional<std::size_t> repeats;
};

struct Admissibility {
  std::optional<bool> stable;
  std::string where, remedy;
  std::vector<std::string> sentences;
};

/// A mechanism, fitted again at finite amplitude beside all parameters.
struct Refitted {
  std::vector<Addition> additions;
  std::shared_ptr<Extended> extended;
  Fit fit;
};

struct Diagnosis {
  Settings settings;
  experiment::Experiment experiment;  ///< with noise stated for every channel
  experiment::RunEntry run;
  std::unique_ptr<assembly::Assembly> base;
  Fit fit;  ///< of the base
  std::vector<Curve> curves;
  std::vector<Candidate> candidates;
  std::vector<Direction> directions;
  std::vector<NoiseSource> noise;

  Verdict verdict = Verdict::nothing_detected;
  Detection::Verdict detection;        ///< of the base fit
  double p_after = 1;                  ///< of the residuals with the causes added
  std::optional<double> p_refits;      ///< of the detection, from full refits
  std::optional<double> alarm_factor;  ///< times the noise up to which the alarm stands
  std::optional<double> noise_factor;  ///< times the stated noise at which what is left would be clean
  std::vector<std::string> reasons;    ///< of the verdict, in sentences
  std::vector<Misfit> misfit;
  std::vector<GrossRow> gross;  ///< rows that were left out of everything
  std::vector<Cause> causes;    ///< of the best explanation first, then rivals
  std::vector<Cause> left_out;  ///< gross rows that the extension takes out beside its causes
  std::vector<Ranked> ranking;  ///< likeliest first; empty without an alarm
  /// Of each candidate the direction that explains these data best; none where it leaves no trace.
  std::vector<std::optional<std::size_t>> best_direction;
  std::size_t named = 0;  ///< how many of the causes make up the best explanation
  std::vector<std::string> ambiguity_set;
  std::vector<std::vector<std::string>> look_alikes;  ///< the ambiguity set by what looks alike; empty for groups
  bool unlisted = false;  ///< an effect that no mechanism lists may look like the causes together
  std::vector<std::vector<std::string>> alternatives;  ///< to a group that is named: what rivals it, likeliest first
  Admissibility admissibility;
  std::vector<Detectable> detectable;
  std::optional<Refitted> extension;
  std::vector<Refitted> rivals;  ///< the extension, and what explains the misfit as well
  std::optional<Gain> gain;
  std::optional<NextExperiment> next;
  std::vector<std::string> warnings;
};

/// Runs a whole diagnosis; docs/diagnosis.md says how. Deterministic given settings.seed, for any number of threads.
/// Throws InputError where data or names do not fit, std::runtime_error where the base model cannot be fitted.
Diagnosis diagnose(const experiment::Experiment& experiment, const Settings& settings,
                   const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
