// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// The result of a diagnosis as plain data: no fit, no model, no calculation. Codes are the stable names beside
/// sentences in result.json; sentences may change, codes do not.
namespace tunica::diagnosis {

enum class Verdict {
  nothing_detected,
  named,
  indistinguishable,
  unknown,
  suspect_data,
  discovered,  ///< no mechanism, but a term of the energy that no name fits
  leading      ///< one cause takes most of the misfit, and the rest is not noise
};
const char* code_of(Verdict verdict);

/// Why the verdict is what it is.
enum class ReasonKind {
  residuals_like_noise,
  rows_miss_the_model,
  no_trace,
  no_trace_of_requested,
  no_fit,
  many_explanations,
  shape_correction,
  single_place,
  at_bound,
  implausible,
  single_carrier,
  gross_rows,
  not_clean,
  larger_noise,
  lost_stability,
  stability_restored,
  restored_by_larger,
  terms_discovered,
  file_suspected,  ///< a mistake in the file explains the misfit
  file_as_likely,  ///< a mistake in the file is as likely as any other explanation
  leads,
  several_lead,
  unlisted_misfit,
  anisotropy_seen,
  rival_not_looked_for
};
const char* code_of(ReasonKind kind);

struct Reason {
  ReasonKind kind;
  std::string text;  ///< one clause, without a full stop
};

enum class WarningKind {
  channel_without_weight,
  constraints_not_applied,
  test_held_out,
  noise_estimated,
  rows_correlated,
  gross_rows_left_out,
  optimizer_has_stages,
  optimizer_failed,
  base_fit_not_optimal,
  base_fit_at_bound,
  base_model,
  noise_too_large,
  noise_vanishes,
  memory_not_looked_for,
  order_assumed,
  record,
  run_differs_in_noise,
  run_keeps_gross_rows,
  run_takes_file_order
};
const char* code_of(WarningKind kind);

struct Warning {
  WarningKind kind;
  std::string text;
};

/// What a cause is a property of: causes are ranked by the same evidence, and shown in these two groups.
enum class CauseGroup { material, rig };
const char* code_of(CauseGroup group);

/// Kinds of mistakes in a file.
enum class FileKind {
  stress_measure,     ///< Cauchy, first or second Piola–Kirchhoff
  strain_definition,  ///< engineering, logarithmic, Green–Lagrange, squares, percent
  exchange,           ///< the two directions for one another
  sign,               ///< compression for tension
  unit,               ///< a factor: a unit, a prefix, an area
  geometry,           ///< radii, diameters, thickness and forces of a tube
  angle,              ///< from the other axis, or radians
  clock,              ///< the unit of the time
  calibration         ///< a zero, a gain, a length, a compliance or a lag, with one amplitude
};
const char* code_of(FileKind kind);

/// Why a mechanism is not looked for, or would not be seen.
enum class Absence {
  none,            ///< it leaves a trace
  no_trace,        ///< the predictions do not depend on it
  absorbed,        ///< a refit of the parameters takes it all
  no_clock,        ///< the data have no time
  already_there,   ///< the base has it
  no_place,        ///< no test of a kind that it acts on
  not_applicable,  ///< the mechanism refuses the base
  isotropic,       ///< it acts along directions, and the base has none
  no_volume,       ///< the volume would change, and no measured lateral stretch or volume shows it
  no_size,         ///< it needs sizes of the specimen that the file does not say
  no_past          ///< it has memory, and the history of a test is unknown
};
const char* code_of(Absence absence);
/// Whether the effect may be in the data all the same.
bool can_hide(Absence absence);

/// Where a mechanism acts.
struct Place {
  std::vector<std::string> tests;       ///< empty: the model; several: one amplitude in all of them
  std::string channel = {};             ///< of a mechanism that takes one
  std::optional<std::size_t> row = {};  ///< of a mechanism that takes rows; none = the whole curve
  std::string model = {};               ///< where a run has several, and no tests are named
  std::size_t file_row = 0;             ///< the number that `row` has in the file; of no meaning without it

  bool operator==(const Place& other) const {
    return tests == other.tests && channel == other.channel && row == other.row && model == other.model;
  }
  /// "in the material", "in the material of 'media'", "in the test 'strip'", "alike in the tests 'a', 'b'", "in the
  /// channel 'stress' of the test 'strip', row 12"
  [[nodiscard]] std::string words() const;
};

/// A row that differs from its neighbours in a way that no mechanism explains.
struct GrossRow {
  std::string test, channel;
  std::size_t row = 0;
  std::size_t file_row = 0;  ///< the number that it has in the file
  double residual = 0;       ///< in σ
  std::string where;         ///< "stretch 1.25, measured 14 kPa"
};

/// Where measured and predicted values disagree more than noise explains.
struct Misfit {
  std::string test, channel;
  std::string where;  ///< "stretch 1.3 … 1.6: measured lies above the prediction by 3.1 σ on average over 9 rows"
  double p_value = 1;
  double from = 0, to = 0;  ///< of the abscissa
};

struct Amplitude {
  std::string name, unit;
  double value = 0, low = 0, high = 0;  ///< 95 % interval
  bool at_bound = false, plausible = true;
};

/// An operation of a JSON Patch (RFC 6902) of the experiment file: the value is added there, in place of what was
/// there.
struct Change {
  std::string path, value;  ///< a JSON pointer; JSON
};

/// A mistake that the file may have: with it mended, the base model is fitted again.
struct FileCause {
  FileKind kind = FileKind::unit;
  std::vector<std::string> tests;
  std::string sentence;        ///< "the stresses of 'axial' are first Piola–Kirchhoff stresses, not Cauchy ones"
  std::string mend;            ///< "\"stress_measure\": \"first_piola_kirchhoff\" in the data of 'axial'"
  double squares = 0;          ///< |r|² of the base model then
  double p_after = 0;          ///< of what it then leaves
  double probability = 0;      ///< among the mistakes that were tried
  bool near = false;           ///< as good as the likeliest of them: one answer with it
  std::string mechanism = {};  ///< that stands for it, where it has an amplitude
  std::vector<Amplitude> amplitudes = {};  ///< of it
  std::vector<Change> changes = {};        ///< the mend, where it is a matter of keys of the experiment file
};

/// How a mistake of the file stands against causes in the material and in the rig.
enum class FileStanding {
  not_looked_for,  ///< the group is switched off, or nothing is wrong
  far,             ///< none leaves noise, or another cause is clearly ahead
  near,            ///< as likely as the others: a question
  ahead            ///< clearly ahead of all others
};
const char* code_of(FileStanding standing);

/// What the record of a test says against itself, or its header against the file: seen without a fit.
struct Suspect {
  std::string code;  ///< "record_repeated", "header_measure"
  std::string text;
};

/// What came of the group `file`.
struct FileFindings {
  FileStanding standing = FileStanding::not_looked_for;
  double wrong_files = 0;         ///< share of files that are expected to say what is not so
  std::size_t tried = 0;          ///< mistakes
  std::vector<FileCause> causes;  ///< likeliest first
  /// By how much, in units of BIC, the likeliest mistake is ahead of the likeliest other cause.
  std::optional<double> lead;
  std::vector<std::string> untellable;  ///< mistakes that leave no trace in these data
  std::vector<Suspect> suspect = {};    ///< found by inspection
};

struct Cause {
  std::string id;
  Place place;
  CauseGroup group = CauseGroup::material;
  /// Of the fall of |r|² at finite amplitude (beside others: of its rise without the cause), where nothing is wrong and
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
struct RankedMechanism {
  std::string id;
  Place place;  ///< of its best hypothesis
  double probability = 0;
  double score = 0;            ///< T at the null, of the best hypothesis
  std::optional<double> gain;  ///< of |r|² at finite amplitude; none: too far behind to be fitted again
  CauseGroup group = CauseGroup::material;
};

/// The least amplitude of a mechanism that would be found on these data with 80 % power, and named.
struct Detectable {
  std::string id, unit, absent;  ///< absent: why it leaves no trace; else empty
  Absence absence = Absence::none;
  Place place;
  /// Distances of the amplitude from its null; identifiable: infinite where another has the same signature.
  double detectable = 0, identifiable = 0;
  double null = 0;         ///< the amplitude that does nothing
  double reach = 0;        ///< the largest plausible distance from it
  bool one_sided = false;  ///< the amplitude goes one way from its null
  double retained = 0;
  std::string closest;     ///< the other mechanism whose projected signature is most alike
  double correlation = 0;  ///< with it, absolute
};

/// What the probability of a cause is worth. It compares mechanisms of the catalogue, so it says nothing where none of
/// them is the answer.
enum class Standing {
  probable,     ///< it is what it says
  at_bound,     ///< the amplitude ended at its bound
  implausible,  ///< the amplitude is beyond what is plausible
  rest_is_left  ///< what the causes leave is not noise
};
const char* code_of(Standing standing);

/// What the extension makes of rows that it has not seen.
enum class BlockVerdict { predicted, not_predicted, inconclusive };
const char* code_of(BlockVerdict verdict);

struct HeldOut {
  std::string block;
  double before = 0, after = 0;  ///< root mean square of whitened errors
  double p_value = 1;            ///< of the block under the extension, parameter uncertainty included
  std::size_t rows = 0;
  BlockVerdict verdict = BlockVerdict::inconclusive;
};

/// The explanation outside the ambiguity set that leaves least.
struct Rejected {
  std::string id;    ///< "geometry_error", of several "a + b"
  double after = 0;  ///< |r|²
};

struct Gain {
  double before = 0, after = 0;  ///< |r|² in sample
  double expected_under_nothing = 0;
  std::vector<HeldOut> held_out;
  std::optional<Rejected> best_rejected;
};

struct NextExperiment {
  std::string description;
  std::vector<std::string> separates;
  std::optional<std::size_t> repeats;
};

/// Whether the base fit behaves as a material where it was measured; none: it could not be told.
struct Admissibility {
  std::optional<bool> stable;
  std::string where, remedy;
  std::vector<std::string> sentences;
};

}  // namespace tunica::diagnosis
