// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "assembly/misfit.hpp"
#include "assembly/misfit_size.hpp"
#include "assembly/quality.hpp"
#include "comparison/certificate.hpp"
#include "comparison/conclusion.hpp"
#include "comparison/information.hpp"
#include "comparison/statistics.hpp"
#include "execution/plan.hpp"
#include "execution/results.hpp"
#include "execution/warning.hpp"
#include "search/calibration_problem.hpp"
#include "stability/admissibility.hpp"

namespace tunica::comparison {

/// Where the profile likelihood crosses its threshold; none = open, as far as the bound.
struct ProfileInterval {
  std::optional<double> lower, upper;
};

/// What draws from the posterior say of a parameter.
struct PosteriorMarginal {
  double mean = 0, sd = 0, lower = 0, median = 0, upper = 0;  ///< 2.5, 50 and 97.5 %
  double r_hat = 0, bulk = 0, tail = 0;                       ///< see posterior/convergence.hpp
};

/// Draws from the posterior of a run.
struct PosteriorSummary {
  std::string file;  ///< of the draws
  std::size_t chains = 0, draws = 0, warm_up = 0;
  std::size_t evaluations = 0, failures = 0;
  double acceptance = 0;                 ///< mean
  double r_hat = 0, effective_size = 0;  ///< the worst of all parameters
  bool converged = false, factor_known = true;
  std::size_t held_out_rows = 0, held_out_inside = 0;  ///< of the band of measurements
  /// A smooth misfit that the posterior allows for, as a share of the range of a channel.
  struct Discrepancy {
    double lower = 0, median = 0, upper = 0;  ///< 2.5, 50 and 97.5 %
    double none = 0;                          ///< probability that there is none
  };
  std::optional<Discrepancy> discrepancy;
};

/// One parameter at the best point of a run.
struct Estimate {
  enum class Bound { none, lower, upper };
  std::string name, unit;
  double value = 0, min = 0, max = 0;
  std::optional<Interval> ci95;            ///< from the noise of the data; none where they do not fix it
  std::optional<ProfileInterval> profile;  ///< where it was asked for
  std::optional<Interval> bootstrap;
  /// Value less what finite elements on a finer mesh would give; none where no test has one, or the data do not fix it.
  std::optional<double> mesh_bias;
  /// Whether that is more than a third of the half width of ci95.
  [[nodiscard]] bool mesh_bias_matters() const {
    return mesh_bias && ci95 && std::abs(*mesh_bias) > (ci95->second - ci95->first) / 6;
  }
  std::optional<PosteriorMarginal> posterior;
  /// Of a parameter with a value of its own in a state: that value less the one in the state of the models.
  struct StateDifference {
    std::string state, from;  ///< from: the parameter of the models
    double value = 0;
    std::optional<Interval> ci95;  ///< where the data fix both
  };
  std::optional<StateDifference> difference;
  bool straight = true;     ///< ci95 can be believed, see uncertainty/straightness.hpp
  bool identified = false;  ///< the data fix it, apart from a bound
  bool held = false;        ///< a constraint fixes it
  bool assessed = false;    ///< the point is a fit and was linearised, so that `identified` means something
  Bound at_bound = Bound::none;
  /// What its bounds are; and how many searches ended at each, with the least objective of those.
  assembly::FreeParameter::Bound lower_kind = assembly::FreeParameter::Bound::chosen, upper_kind = lower_kind;
  struct Stops {
    std::uint64_t count = 0;
    double objective = 0;
  };
  Stops stops_lower, stops_upper;
  SampleStatistics over_realisations;
};

/// One channel over its fitted, or its held-out, rows.
struct Quality {
  std::string test, channel, unit;
  bool held_out = false;
  assembly::Agreement agreement;
  std::string over = {};  ///< the abscissa that it is drawn over
};

/// Whether the best point behaves as a material, see stability_report.hpp.
struct StabilitySummary {
  struct OfModel {
    std::string name;
    stability::Admissibility verdict;
    std::vector<std::string> inadmissible;  ///< "1 - 2A - B = -0.2": inequalities of the model that do not hold
  };
  std::string imposed;                  ///< "h = 0.7"; empty = no constraint
  std::vector<OfModel> models;          ///< one a model of the run
  std::optional<double> ratio_to_free;  ///< objective over that of the best unconstrained run of the model

  /// Of all models together, see Admissibility.
  [[nodiscard]] std::optional<bool> transversely_stable() const;
};

/// The noise of one fitted channel, and what it rests on.
struct NoiseOf {
  std::string test, channel, unit;
  assembly::NoiseOrigin origin = assembly::NoiseOrigin::assumed;
  double sd = 0;  ///< median over the fitted rows
};

/// How far a channel is from its data, in units of their noise.
struct Deviation {
  std::string test, channel, unit;
  double mean = 0;             ///< ⟨|e|/σ⟩ over the fitted rows
  double sd = 0, largest = 0;  ///< median σ; largest |measured|
  double share = 0;            ///< ⟨|e|⟩ of the largest |measured|
};

/// Covariance of the parameters that the data fix, row after row; empty = none.
struct ParameterCovariance {
  struct Of {
    std::string name, unit;
    Scale scale = Scale::linear;
  };
  std::vector<Of> parameters;
  std::vector<double> values;  ///< in the units of the parameters
  std::vector<double> search;  ///< in the unit box: x = (p − min)/(max − min), or log(p/min)/log(max/min)
};

struct RunSummary {
  std::string label, model, optimizer;
  std::vector<std::string> tests;
  std::string objective_type;         ///< "least_squares"
  std::string group;                  ///< runs of one group have the same objective on the same tests and can be ranked
  bool has_result = false;            ///< some evaluation succeeded
  std::optional<double> target = {};  ///< of the objective, where the run has one
  Status status;         ///< of the best point, evaluated again; failed with the first reason without result
  double objective = 0;  ///< of the best evaluated point
  std::vector<double> per_test;
  std::vector<Estimate> parameters;
  std::vector<assembly::FixedParameter> fixed;
  std::vector<Quality> quality;
  /// How far the best point misses the data: against stated noise, and against noise that is estimated from the data.
  std::optional<assembly::Misfit> misfit, misfit_estimated;
  /// How large the misfit is that noise does not explain, of all fitted rows that count, and of each channel.
  std::optional<assembly::Size> size;
  std::vector<assembly::ChannelSize> sizes;
  std::optional<double> tolerance;     ///< share of the range, where the experiment states one
  std::optional<Deviation> deviation;  ///< of the channel that is worst; none where no row counts
  std::vector<NoiseOf> noise;
  std::vector<std::string> notes;  ///< remarks that are not warnings
  /// Of all predictions of the best point, by Layout::channels: half width of the 95 % interval that the noise of
  /// the data leaves them; and the range over the best points of all realisations. Each empty where there is none.
  std::vector<double> curve_ci95, curve_lowest, curve_highest;
  /// By the posterior: 2.5, 50 and 97.5 % of the curves, and 2.5 and 97.5 % of measurements. Each empty without.
  std::vector<double> posterior_lower, posterior_median, posterior_upper, measured_lower, measured_upper;
  ParameterCovariance covariance;
  std::vector<std::string> identifiability;  ///< sentences
  std::vector<std::string> uncertainty;      ///< sentences on profiles, bootstrap and posterior
  struct Draws {
    std::size_t made = 0, failed = 0;
  };
  std::optional<Draws> bootstrap;
  std::optional<PosteriorSummary> posterior;

  std::uint64_t realisations = 0, best_realisation = 0, best_id = 0;  ///< both from 1, as in evaluations.csv
  SampleStatistics objectives;                                        ///< of the realisations that have a result
  double success_rate = 0, threshold = 0;                             ///< of the objective, see success_threshold
  std::uint64_t successes = 0;
  Interval success_ci95{0, 1};                        ///< Wilson's, of the success rate
  SampleStatistics evaluations_to_target;             ///< of the successes: evaluations until the threshold was reached
  std::optional<double> expected_running_time;        ///< evaluations a success; none without success
  SampleStatistics evaluations_spent, seconds_spent;  ///< per realisation
  std::optional<Information> information;
  Certificate certificate;
  std::optional<StabilitySummary> stability;  ///< with a result
  std::uint64_t evaluations = 0, jacobians = 0, failures = 0, infeasible = 0;
  bool has_costly_tests = false;
  std::uint64_t simulated = 0, ended_early = 0, guide_evaluations = 0;  ///< see search::Tally; of costly tests
  std::string first_failure;
  /// What each test counted until the search had ended, by test; empty for tests that count nothing.
  std::vector<std::pair<std::string, std::vector<Effort>>> efforts;
  std::uint64_t faults = 0;  ///< realisations that ended because the optimiser threw
  std::string first_fault;
  bool one_course = false;                           ///< all of several realisations improved by the same steps
  std::vector<search::FailureKind> failure_reasons;  ///< most frequent first
  std::uint64_t searches = 0;                        ///< local searches, or realisations where there were none
  std::uint64_t given_up = 0;                        ///< realisations that the failure policy ended
  bool converged = false;  ///< the search that found the best point had, in the optimiser's own word
  std::string reason;      ///< its own reason for coming back
  search::StopReason stopped_by = search::StopReason::none;  ///< what ended the whole
  std::string stop_sentence;                                 ///< the same in words; empty for none
  double seconds = 0;                                        ///< Σ over realisations
  /// Evaluations and Jacobians spent for one success, each Jacobian counted as an evaluation; none without success.
  /// Unlike seconds it is the same on every machine.
  [[nodiscard]] std::optional<double> cost() const;
  std::optional<SearchLimit> limit = {};      ///< what would let the search go on
  std::vector<std::string> differs = {};      ///< from other runs of its model and optimizer, see run_differences()
  bool paired_starts = false;                 ///< was asked for
  std::vector<std::string> paired_with = {};  ///< labels of runs whose searches begin at the same points
  std::string withheld = {};                  ///< why there are no intervals, although the data may fix the parameters
};

struct Ranked {
  std::size_t run = 0;                    ///< index in Summary::runs
  std::optional<std::size_t> rank;        ///< within its group, from 1; none without a result
  std::optional<double> delta_aicc = {};  ///< AICc above the least of the group; where that compares several models
};

/// What a run of an experiment has shown.
struct Summary {
  std::string name;
  std::vector<RunSummary> runs;
  std::vector<Ranked> ranking;  ///< group after group; runs without a result last in theirs, never left out
  std::vector<execution::Warning> warnings;
  std::vector<std::string> identifiability;
};

/// Called with the current work, such as "profiles of gho/lm", because work after the searches can also be long.
using Told = std::function<void(const std::string& what)>;

/// Evaluates the best points again, ranks, counts successes, and says what should not be overlooked. `refusals`: why
/// plugins were refused; they go before the warnings of the plan and the data.
Summary summarise(const execution::Plan& plan, const std::vector<execution::RunResult>& results,
                  const std::vector<std::string>& refusals, const Told& told = {});

}  // namespace tunica::comparison
