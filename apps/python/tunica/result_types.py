# SPDX-License-Identifier: Apache-2.0
# Written by docs/results_reference.py from schemas/. Do not edit it by hand.
"""The documents that tunica writes, as types for editors and mypy. docs/results-reference.md has the same with units.
Nothing here is needed to run."""
from __future__ import annotations

import sys
from typing import Literal

if sys.version_info >= (3, 11):
    from typing import NotRequired, TypedDict
else:
    from typing_extensions import NotRequired, TypedDict

#: Whether an amplitude is plausible.
Belief = Literal["plausible", "flagged", "beyond"]

#: How the extension predicts rows that it has not seen.
BlockVerdict = Literal["predicted", "not_predicted", "inconclusive"]

#: What a bound is.
BoundKind = Literal["chosen", "default", "symmetry", "physical"]

#: What a cause is a property of. Both groups are ranked by the same evidence.
CauseGroup = Literal["material", "rig"]

#: What the probability of a cause is worth.
CauseStanding = Literal["probable", "at_bound", "implausible", "rest_is_left"]

#: What the certificate says, the gravest first.
CertificateVerdict = Literal["not_checked", "failed", "objective_differs", "constraint_broken", "not_an_optimum",
    "ended_at_target", "better_neighbour", "no_neighbours", "confirmed"]

#: What is claimed of a cause.
Claim = Literal["consistent_with"]

#: Why a specimen does not go with the verdict.
CohortContradiction = Literal["not_seen", "other_size", "other_cause", "rest_is_left", "shows_effect"]

#: How an effect is expressed.
CohortEffectKind = Literal["ratio", "difference"]

#: What became of a specimen.
CohortOutcome = Literal["fitted", "no_result", "unreadable", "failed"]

#: What is read off a fitted curve.
CohortReadingKind = Literal["at", "slope", "integral"]

#: Why the verdict is what it is.
CohortReasonCode = Literal["no_alarm", "many_explanations", "not_clean", "no_trace", "single_place", "one_specimen"]

#: What a warning of a cohort is about.
CohortRemark = Literal["not_fitted", "factor_not_compared", "few_specimens", "few_animals", "same_data", "far_off",
    "often_at_bound"]

#: How a parameter is searched.
CohortScale = Literal["linear", "log"]

#: What a permutation exchanges between labels.
CohortScheme = Literal["specimens", "within_animals", "over_animals"]

#: How spreads of parameters go together.
CohortSpreadStructure = Literal["full", "diagonal"]

#: Where a tolerance comes from.
CohortToleranceOrigin = Literal["stated", "repeats", "cohort", "default"]

#: What the diagnosis of a cohort says.
CohortVerdict = Literal["nothing_detected", "named", "indistinguishable", "unknown", "suspect_data"]

#: Why the verdict is what it is.
DiagnosisReason = Literal["residuals_like_noise", "rows_miss_the_model", "no_trace", "no_trace_of_requested", "no_fit",
    "many_explanations", "shape_correction", "single_place", "at_bound", "implausible", "single_carrier", "gross_rows",
    "not_clean", "larger_noise", "lost_stability", "stability_restored", "restored_by_larger", "file_suspected",
    "file_as_likely", "terms_discovered", "leads", "several_lead", "unlisted_misfit", "anisotropy_seen",
    "rival_not_looked_for"]

#: What a diagnosis says.
DiagnosisVerdict = Literal["nothing_detected", "named", "indistinguishable", "unknown", "suspect_data", "discovered",
    "leading"]

#: What a warning of a diagnosis is about.
DiagnosisWarningKind = Literal["channel_without_weight", "constraints_not_applied", "test_held_out", "noise_estimated",
    "rows_correlated", "gross_rows_left_out", "optimizer_has_stages", "optimizer_failed", "base_fit_at_bound",
    "base_fit_not_optimal", "base_model", "noise_too_large", "noise_vanishes", "memory_not_looked_for", "order_assumed",
    "record", "run_differs_in_noise", "run_keeps_gross_rows", "run_takes_file_order"]

#: An axis of the specimen.
Direction = Literal["circumferential", "axial"]

#: Why the verdict of a discovery is what it is.
DiscoveryReason = Literal["residuals_like_noise", "terms_found", "form_open", "invariant_open", "not_an_energy",
    "rig_explains", "rig_rival", "name_explains", "not_clean", "no_term", "gross_rows", "specimens_agree",
    "specimens_left_over", "anisotropy_seen", "leads", "same_model", "searched_cheaper"]

#: What a run came to, the gravest first. The program returns 1 for every one before at_target.
Ending = Literal["no_result", "infeasible", "refuted", "mostly_failed", "not_an_optimum", "not_a_fit", "not_converged",
    "at_target", "short_of_optimum", "at_limit", "misses", "converged"]

#: Which fibres a term belongs to.
FibreFamily = Literal["axial", "circumferential", "diagonal"]

#: What speaks against a record or a header without a fit.
FileFinding = Literal["record_repeated", "record_coarse", "record_sign", "record_percent", "record_angle",
    "record_time", "header_measure", "header_strain"]

#: What the file may say that is not so.
FileMistake = Literal["stress_measure", "strain_definition", "exchange", "sign", "unit", "geometry", "angle", "clock",
    "calibration"]

#: How mistakes of the file compare with other causes.
FileStanding = Literal["not_looked_for", "far", "near", "ahead"]

#: How held-out rows of one observable are predicted.
HoldOutVerdict = Literal["predicted", "worse_than_fitted"]

#: What a term of the energy is a function of.
Invariant = Literal["I1", "I2", "stretches", "fibre", "I1*I2", "I1^2*I2", "I1*I2^2", "I1bar", "I2bar", "fibrebar", "J"]

#: How far a job is.
JobPhase = Literal["waiting", "running", "ended", "failed"]

#: How a term grows: ψ(x), where x is 0 at rest. docs/composed.md has the formulas.
Law = Literal["linear", "quadratic", "cubic", "power", "exponential", "exponential_square", "gent", "inverse_langevin",
    "logarithm", "spline", "logarithmic", "simo", "ogden"]

#: Which likelihood `aicc` and `bic` use.
Likelihood = Literal["stated", "estimated", "mixed"]

#: Why a mechanism is not looked for, or would not be seen.
MechanismAbsence = Literal["none", "no_trace", "absorbed", "no_clock", "already_there", "no_place", "not_applicable",
    "isotropic", "no_volume", "no_size", "no_past"]

#: What the noise of a channel rests on.
NoiseOrigin = Literal["stated", "replicates", "smooth_shapes", "assumed"]

#: What the noise of a channel rests on, in a diagnosis.
NoiseSource = Literal["stated", "replicates", "encompassing", "differences"]

#: What a run minimises; the page of experiment files has the formulas.
ObjectiveType = Literal["least_squares", "standardised_quadratic", "sum_of_norms"]

#: What an observable is to a test.
ObservableRole = Literal["prescribed", "clock", "measured"]

#: What an option takes.
OptionKind = Literal["flag", "integer", "number", "quantity", "choice", "text", "json"]

#: What became of a property of a plugin.
OutcomeOfProperty = Literal["ok", "noted", "FAILED", "not checked"]

#: What the causes leave.
Remainder = Literal["clean", "not_clean"]

#: How a parameter is searched.
Scale = Literal["linear", "log"]

#: How far a shard is.
ShardStanding = Literal["done", "running", "waiting", "stopped"]

#: On which side of the null amplitudes lie.
Side = Literal["positive", "both", "even"]

#: Which bound a value lies at.
SideOfBounds = Literal["lower", "upper"]

#: Whether a point could be evaluated.
Status = Literal["ok", "infeasible", "failed"]

#: What ended a search before its optimiser came back by itself.
StopReason = Literal["target", "stall", "max_evaluations", "max_time", "interrupted", "failure", "failure_rate",
    "nothing_succeeded", "optimizer_failure", "not_needed"]

#: Where a tolerance comes from.
ToleranceOrigin = Literal["stated", "repeats", "cohort", "default"]

#: Instructions that models were evaluated with. Levels differ in the last digits.
VectorLevel = Literal["baseline", "avx2", "avx512", "several"]

#: What a warning is about.
WarningKind = Literal["misfit_out_of_scale", "no_misfit", "noise_contradicted", "search_fell_short", "noise_too_large",
    "mesh_biases_parameters", "small_misfit", "no_result", "no_feasible_point", "not_repeatable", "not_evaluated_again",
    "not_linearised", "predicts_worse", "unstable", "ellipticity_lost", "drucker_lost", "free_faces_unstable",
    "inadmissible_parameters", "at_bound", "stopped_at_default_bound", "bound_in_comparison", "not_fixed_by_data",
    "failed_evaluations", "optimizer_failure", "same_course", "given_up", "depends_on_time", "prior", "held_out",
    "not_comparable", "other_model_preferred", "certificate_failed", "objective_differs", "not_an_optimum",
    "differenced_derivatives", "equal_realisations", "plugin_refused", "order_assumed", "record_broken",
    "record_softening", "record_jump", "record_repeated", "record_coarse", "record_sign", "record_time", "record_short",
    "record_percent", "record_size", "record_angle", "record_noise", "header_measure", "header_strain",
    "posterior_not_converged", "posterior_disagrees", "posterior_noise_assumed", "set_up"]


class Result(TypedDict):
    """result.json of `tunica run`, `diagnose` and `discover`. A file has what its verb found: `runs`, `diagnosis` or
    `discovery`. Numbers are in the unit that is beside them, else in base units (kPa, mm, mN, s, deg); null means not
    known. The schema is closed: a key that it does not list is a fault of this version. Readers ignore keys they do not
    know, since later versions add some."""
    #: Version of this format.
    format: Literal[1]
    #: Name of the experiment.
    name: str
    #: What a reader should know before the numbers; first in every report.
    warnings: list[str]
    #: The same warnings in the same order, for programs.
    warning_details: list[Warning]
    #: Runs from best to worst; runs with different tests or objectives form groups of their own. Empty but for `tunica
    #: run`.
    ranking: list[RankedRun]
    #: Parameter combinations the data do not fix, in words.
    identifiability: list[str]
    #: One entry for each run of the experiment. Empty but for `tunica run`.
    runs: list[Run]
    #: What `tunica diagnose` found.
    diagnosis: NotRequired[Diagnosis]
    #: What `tunica discover` found, or a diagnosis that went on to search for terms.
    discovery: NotRequired[Discovery]
    #: What the result was made with.
    provenance: Provenance


class Warning(TypedDict):
    """A warning, for programs."""
    #: What it is about.
    kind: WarningKind | DiagnosisWarningKind
    #: Name of the run; null: of the whole experiment.
    run: str | None
    #: Parameters, models, channels or tests; empty: the whole run.
    subjects: list[str]
    #: The warning without the name of the run.
    sentence: str


class RankedRun(TypedDict):
    """A run in the order of the ranking."""
    #: Within the group, from 1; null where nothing succeeded.
    rank: int | None
    #: Name of the run.
    run: str
    #: Objective and tests, in words. Only runs of one group are comparable.
    group: str
    #: At the best point; null without a result. Unit: of the objective.
    objective: float | None
    #: AICc above the least of the group, where models differ; else null.
    delta_aicc: float | None
    #: Realisations that succeeded.
    successes: int
    #: Evaluations spent for one success, failed realisations included; null without success. Unit: evaluations.
    expected_running_time: float | None
    #: Evaluations and Jacobians spent for one success; null without success. Runs of one rank are in this order. Unit:
    #: evaluations.
    cost: float | None
    #: Evaluations that failed.
    failures: int
    #: Why there is no result, or what is wrong with it; empty where nothing is.
    reason: str


class Run(TypedDict):
    """One entry of "runs" of the experiment."""
    #: Name of the run in tables and files.
    run: str
    #: Its entry of "models"; several, of layers, are joined.
    model: str
    #: Its entry of "optimizers".
    optimizer: str
    #: The tests that are fitted.
    tests: list[str]
    #: What is minimised.
    objective_type: ObjectiveType
    #: What the run has that others of its model and optimiser have not.
    differs_by: list[str]
    #: Runs whose searches begin at the same points; null where the experiment does not pair starts.
    paired_with: list[str] | None
    #: Searches with seeds of their own.
    realisations: int
    #: Null where no evaluation succeeded.
    best: Best | None
    #: By name: parameters that were held.
    fixed: dict[str, Quantity]
    #: Over realisations.
    statistics: RunStatistics
    #: Of all realisations.
    evaluations: int
    #: Of all realisations.
    jacobians: int
    #: Evaluations that failed.
    failures: int
    #: Evaluations that broke a constraint.
    infeasible: int
    #: What the first failed evaluation said; null where none failed.
    first_failure: str | None
    #: Whether the optimiser says so and nothing speaks against it, see ending_code.
    converged: bool
    #: What the run came to, in words.
    ending: str
    #: The same for programs.
    ending_code: Ending
    #: The limit that ended the search; null where none did.
    limit: RunLimit | None
    #: What ended the search, in a sentence.
    ended_by: str
    #: The same for programs; null where the optimiser came back by itself.
    stop_reason: StopReason | None
    #: Of all realisations. Unit: s.
    seconds: float
    #: Only of runs with costly tests.
    full_simulations: NotRequired[RunFullSimulations]
    #: By test and name: what it counted in this process until the search had ended, such as solver runs. Only where a
    #: test counts.
    efforts: NotRequired[dict[str, dict[str, int]]]


class Best(TypedDict):
    """The best evaluated point of all realisations."""
    #: By name: what was searched for.
    parameters: dict[str, Estimate]
    #: What the run minimised. Unit: of the objective.
    objective: float
    #: By name: how each test is met.
    per_test: dict[str, Fit]
    #: Transverse stability at every measured stretch; null where it was not assessed.
    stable: bool | None
    #: Whether it keeps the constraints.
    status: Status
    #: Why not; empty where it does.
    reason: str
    #: Whether it behaves as a material; null where it was not assessed.
    stability: Stability | None
    #: The one that found it, from 0.
    realisation: int
    #: Its id in evaluations.csv.
    evaluation: int
    #: Of the parameters that the data fix; null where they fix none.
    covariance: Covariance | None
    #: Akaike's criterion with small-sample correction, up to a constant of the data; null but for least_squares.
    aicc: float | None
    #: Schwarz's criterion; null as aicc.
    bic: float | None
    #: Which likelihood aicc and bic use; null without them.
    noise: Likelihood | None
    #: The noise of every fitted channel; least_squares weighs rows by 1/sd².
    channel_noise: list[ChannelNoise]
    #: Against stated noise; null where none is stated.
    misfit: Misfit | None
    #: Against noise that is estimated from replicates or smooth shapes; null without such channels.
    misfit_estimated: Misfit | None
    #: How large the misfit is; null without rows.
    misfit_size: MisfitSize | None
    #: By which intervals are wider than the stated noise makes them: times_the_noise where misfit contradicts it, else
    #: 1.
    interval_factor: float
    #: Why there are no intervals around a point that is not the optimum; null where there may be.
    intervals_withheld: str | None
    #: What should be known and is no reason to worry.
    notes: NotRequired[list[str]]
    #: Whether it is the optimum.
    certificate: Certificate
    #: How rows are predicted that were not fitted.
    hold_out: list[HeldOutChannel]
    #: What the data fix of these parameters, and what they do not.
    identifiability: NotRequired[list[str]]
    #: What to know of profiles, bootstrap and posterior.
    uncertainty: NotRequired[list[str]]
    #: Draws of the bootstrap. Only with --bootstrap.
    bootstrap: NotRequired[BestBootstrap]
    #: Draws from the posterior. Only with --posterior.
    posterior: NotRequired[BestPosterior]


class Estimate(TypedDict):
    """A parameter at the best point: its value, and what is known of it. All numbers in `unit`."""
    #: Its value. Unit: `unit`.
    value: float
    #: UDUNITS spelling; 1 where it has none.
    unit: str
    #: From the data's noise. Unit: `unit`.
    ci95: list[float] | None
    #: Whether the likelihood is a parabola as far as ci95 reaches; if not, a profile is the better answer. Null without
    #: ci95.
    ci95_reliable: bool | None
    #: The bound the value lies at; null where it lies at none.
    at_bound: SideOfBounds | None
    #: What that bound is; null where the value lies at none.
    bound_kind: BoundKind | None
    #: The lower bound. Unit: `unit`.
    min: float
    #: The upper bound. Unit: `unit`.
    max: float
    #: Of a parameter with a value of its own in a state: that value less the one of the models.
    difference: NotRequired[StateDifference]
    #: Where the profile likelihood crosses its threshold; null on a side where it stays below as far as the bound. Only
    #: with --profiles. Unit: `unit`.
    profile_ci95: NotRequired[list[float | None]]
    #: Value less what finite elements on a finer mesh would give, estimated in one linearised step. Only where a test
    #: compares itself with a finer mesh, and the data fix the parameter. Unit: `unit`.
    mesh_bias: NotRequired[float]
    #: Percentile interval of the residual bootstrap. Only with --bootstrap. Unit: `unit`.
    bootstrap_ci95: NotRequired[list[float] | None]
    #: 2.5 and 97.5 % of the draws from the posterior. Only with --posterior. Unit: `unit`.
    posterior_ci95: NotRequired[list[float] | None]
    #: What else the draws from the posterior say. Only with --posterior.
    posterior: NotRequired[EstimatePosterior]


#: How a parameter differs in a state of the specimen.
StateDifference = TypedDict("StateDifference", {
    #: The entry of states.
    "state": "str",
    #: The parameter of the models that it differs from.
    "from": "str",
    #: Its value less that one, in the unit of the parameter. Unit: `unit`.
    "value": "float",
    #: From the data's noise; null where they do not fix both. Unit: `unit`.
    "ci95": "list[float] | None",
})


class EstimatePosterior(TypedDict):
    """What else the draws from the posterior say. Only with --posterior."""
    #: Their mean. Unit: unit of the parameter.
    mean: float
    #: Their standard deviation. Unit: unit of the parameter.
    sd: float
    #: Their median. Unit: unit of the parameter.
    median: float
    #: Rank-normalised split R-hat; chains agree up to 1.01. Null where the parameter does not vary.
    r_hat: float | None
    #: Effective sample size of the centre. Null where the parameter does not vary.
    ess_bulk: float | None
    #: Effective sample size of the 5 and 95 % points, the smaller one. Null where the parameter does not vary.
    ess_tail: float | None


class Fit(TypedDict):
    """How one test is met at the best point."""
    #: Its share of the objective. Unit: of the objective.
    cost: float | None
    #: One entry for each channel; held-out rows have their own.
    channels: list[ChannelFit]


class ChannelFit(TypedDict):
    """How one channel is met."""
    #: Name of the observable.
    channel: str
    #: The prescribed quantity that it is drawn over; row: the number of the row.
    over: str
    #: These rows were not fitted.
    held_out: bool
    #: Rows that are compared.
    rows: int
    #: Of rmse.
    unit: str
    #: Root mean square error. Unit: `unit`.
    rmse: float
    #: 1 − SSE/SST; null where all values are equal.
    r2: float | None
    #: 100 ⟨|e − p|⟩/max(⟨|e|⟩, ⟨|p|⟩) of measured e and predicted p; null where both are zero. Unit: %.
    nmad: float | None


class Stability(TypedDict):
    """Whether the best point behaves as a material, asked for or not. Of one model the keys of stability_of_model, of
    several `models`."""
    #: The constraints of the run in short; null: none.
    imposed: str | None
    #: Objective over that of the best unconstrained run of the same model; null where there is none.
    ratio_to_free: float | None
    #: Of strips along each axis; empty where the model changes its volume.
    transverse: NotRequired[list[StripStability]]
    #: Whether the material stays elliptic.
    ellipticity: NotRequired[Condition]
    #: Drucker's condition, of isotropic models; null for others.
    drucker: NotRequired[Condition | None]
    #: Whether the energy has a minimum over the stretches of free faces; null where the model keeps its volume.
    free_faces: NotRequired[Condition | None]
    #: Inequalities of the model that do not hold, with their value.
    inadmissible: NotRequired[list[str]]
    #: All of it in words.
    sentences: NotRequired[list[str]]
    #: By name, in place of the other keys: each model of a run that has several.
    models: NotRequired[dict[str, StabilityOfModel]]


class StripStability(TypedDict):
    """Transverse stability of a strip along one axis. All numbers are stretches."""
    #: The axis that is pulled.
    direction: Direction
    #: Least stretch of a strip that was measured, or asked for by a constraint's range; null: none below 1.
    measured_from: float | None
    #: The largest; null: none above 1.
    measured_to: float | None
    #: At every measured stretch, and those asked for; null: there are none, or the response cannot be followed there.
    stable: bool | None
    #: From which the transverse stretch grows; null: nowhere.
    first_unstable: float | None
    #: From which it falls again; null: nowhere.
    stable_again: float | None
    #: Below which the transverse stretch falls under compression; null: nowhere.
    first_unstable_pressed: float | None
    #: The least stretch that was looked at.
    checked_from: float
    #: The largest.
    checked_to: float


class Condition(TypedDict):
    """One condition on a material, along several paths. All numbers are stretches."""
    #: As far as it could be asked; null where it could not be asked anywhere.
    holds: bool | None
    #: Where it is lost first; null: nowhere.
    first_lost: float | None
    #: The path on which it is lost, or weakest.
    path: str
    #: That every path of extension was followed to; null where one could not be followed at all.
    checked_to: float | None
    #: How far each path was followed: until the condition is lost or the response ends; below 1 where it is pressed;
    #: null: not at all.
    paths: dict[str, float | None]


class StabilityOfModel(TypedDict):
    """Whether a parameter set behaves as a material."""
    #: Of strips along each axis; empty where the model changes its volume.
    transverse: list[StripStability]
    #: Whether the material stays elliptic.
    ellipticity: Condition
    #: Drucker's condition, of isotropic models; null for others.
    drucker: Condition | None
    #: Whether the energy has a minimum over the stretches of free faces; null where the model keeps its volume.
    free_faces: Condition | None
    #: Inequalities of the model that do not hold, with their value.
    inadmissible: list[str]
    #: All of it in words.
    sentences: list[str]


class Covariance(TypedDict):
    """Of the n parameters that the data fix: n × n matrices, rows and columns in the order of `parameters`."""
    #: Names, n of them.
    parameters: list[str]
    #: Of the parameters, n of them.
    units: list[str]
    #: Covariance, n × n. Unit: units[i]·units[j].
    values: list[list[float]]
    #: n × n.
    correlation: list[list[float]]
    #: The same in the coordinate of the search: (p − min)/(max − min), or log(p/min)/log(max/min) on a log scale.
    search: CovarianceSearch


class CovarianceSearch(TypedDict):
    """The same in the coordinate of the search: (p − min)/(max − min), or log(p/min)/log(max/min) on a log scale."""
    #: Of the parameters, n of them.
    scales: list[Scale]
    #: Covariance, n × n.
    values: list[list[float]]


class ChannelNoise(TypedDict):
    """The noise of a fitted channel."""
    #: Name of the test.
    test: str
    #: Name of the observable.
    channel: str
    #: σ: the median over the fitted rows. Unit: `unit`.
    sd: float
    #: Of sd.
    unit: str
    #: What it rests on.
    origin: NoiseOrigin


class Misfit(TypedDict):
    """How the best point compares with the noise: χ² = Σ r²."""
    #: Sum of the squared residuals over σ.
    chi_square: float
    #: Rows with noise of that kind.
    rows: int
    #: Rows less their share of the free parameters.
    degrees_of_freedom: float
    #: chi_square/degrees_of_freedom.
    reduced_chi_square: float
    #: Its square root.
    times_the_noise: float
    #: Of so large a chi_square where the model and the noise are right.
    chance: float
    #: chance below 0.001, and reduced_chi_square above 1.5.
    contradicts_noise: bool
    #: chance below 0.001, and reduced_chi_square at most 1.5.
    small_but_real: bool


class MisfitSize(TypedDict):
    """How large the misfit is that noise does not explain, of all rows."""
    #: Root mean square. Unit: share of the range.
    rms: float
    #: Its upper 95 % bound. Unit: share of the range.
    rms_upper: float
    #: As "diagnosis" of the experiment states it; null where it does not. Unit: share of the range.
    tolerance: float | None
    #: The upper bound is within the tolerance; null without one.
    adequate: bool | None
    #: By test and observable, in units.
    channels: list[ChannelMisfit]


class ChannelMisfit(TypedDict):
    """Misfit beyond noise of one observable of one test."""
    #: Name of the test.
    test: str
    #: Name of the observable.
    channel: str
    #: Of the numbers.
    unit: str
    #: Of the observable over all tests of the same type. Unit: `unit`.
    range: float
    #: Root mean square beyond noise. Unit: `unit`.
    rms: float
    #: Its upper 95 % bound. Unit: `unit`.
    rms_upper: float
    #: Rows of the channel.
    rows: int


class Certificate(TypedDict):
    """What speaks for the best point being the optimum, and what against it."""
    #: In a sentence.
    verdict: str
    #: For programs.
    verdict_code: CertificateVerdict
    #: The point evaluated again by a process that knows only input.json and result.json; null where there was none.
    fresh_process: FreshProcess | None
    #: Small steps along parameters and along the principal directions of the residuals; null without a fresh process.
    neighbours: Neighbours | None
    #: Whether other realisations came to the same place.
    realisations: Agreement
    #: Parameters that lie at a bound.
    at_bounds: list[str]
    #: Values of constraints, and those within 1e-3 of their limit.
    constraints: CertificateConstraints


class FreshProcess(TypedDict):
    """The best point, evaluated by another process."""
    #: How it ended.
    status: Status
    #: There; null where it failed. Unit: of the objective.
    objective: float | None
    #: From the objective that the search recorded; null where it failed. Unit: of the objective.
    difference: float | None
    #: Bit for bit.
    identical: bool


class Neighbours(TypedDict):
    """What lies around the best point."""
    #: Neighbours that were evaluated.
    evaluated: int
    #: Those that break a constraint.
    infeasible: int
    #: Those that cannot be evaluated.
    failed: int
    #: A feasible neighbour is lower by more than rounding.
    better: bool
    #: The lowest feasible one; null where there is none.
    lowest: NeighboursLowest | None


class NeighboursLowest(TypedDict):
    """The lowest feasible one; null where there is none."""
    #: Its objective. Unit: of the objective.
    objective: float
    #: The parameter, or the direction of the residuals' curvature, that the step follows.
    along: str
    #: Signed; 0: a local search ended there. Unit: of the unit box.
    step: float


class Agreement(TypedDict):
    """Realisations within 1e-3 (relative) of the best objective, and how far their parameters are apart."""
    #: Those within.
    agree: int
    #: All realisations.
    of: int
    #: By parameter, over those that agree.
    spread: dict[str, AgreementSpread]


class AgreementSpread(TypedDict):
    """How far one parameter is apart."""
    #: The least value. Unit: `unit`.
    min: float
    #: The largest. Unit: `unit`.
    max: float
    #: Of both.
    unit: str
    #: Their difference over the width of the bounds.
    share_of_bounds: float


class CertificateConstraints(TypedDict):
    """Values of constraints, and those within 1e-3 of their limit."""
    #: All.
    count: int
    #: Within 1e-3 of their limit.
    active: int


class HeldOutChannel(TypedDict):
    """An observable of which some rows were fitted and others held out, over all tests of the run."""
    #: Name of the observable.
    channel: str
    #: Of both errors.
    unit: str
    #: Root mean square error of the fitted rows. Unit: `unit`.
    in_sample: float
    #: The same of the others. Unit: `unit`.
    held_out: float
    #: The test that is predicted worst.
    worst: str
    #: How they are predicted.
    verdict: HoldOutVerdict


class BestBootstrap(TypedDict):
    """Draws of the bootstrap. Only with --bootstrap."""
    #: Data sets that were fitted.
    draws: int
    #: Those that could not be.
    failed: int


class BestPosterior(TypedDict):
    """Draws from the posterior. Only with --posterior."""
    #: The file of the draws, as arviz.from_json() reads it.
    file: str
    #: Independent chains.
    chains: int
    #: Draws of all chains together.
    draws: int
    #: Draws before them that do not count.
    warm_up: int
    #: Simulations with derivatives.
    simulations: int
    #: Those that failed; the posterior takes their parameters for impossible.
    failed: int
    #: Share of the moves that were taken.
    acceptance: float
    #: The largest of all parameters.
    r_hat: float
    #: The smallest effective sample size of all parameters, of centre or tails.
    ess: float
    #: R-hat is at most 1.01, and the effective sample size at least 400.
    converged: bool
    #: All noise is stated, and χ² does not contradict it; if not, one common factor of it is unknown, and integrated
    #: out.
    noise_known: bool
    #: The smooth misfit beside the model that the posterior allows for. Only with --discrepancy.
    discrepancy: NotRequired[BestPosteriorDiscrepancy]
    #: Held-out rows whose noise is known, and the 95 % band of measurements.
    held_out: BestPosteriorHeldOut


class BestPosteriorDiscrepancy(TypedDict):
    """The smooth misfit beside the model that the posterior allows for. Only with --discrepancy."""
    #: 2.5 and 97.5 % of its size, as a share of the range of a channel.
    ci95: list[float] | None
    #: 50 % of its size.
    median: float
    #: Probability that there is none.
    none: float


class BestPosteriorHeldOut(TypedDict):
    """Held-out rows whose noise is known, and the 95 % band of measurements."""
    #: Those that there are.
    rows: int
    #: Those within the band.
    inside: int


class Quantity(TypedDict):
    """A value and its unit."""
    #: The value. Unit: `unit`.
    value: float
    #: UDUNITS spelling; 1 where it has none.
    unit: str


class RunStatistics(TypedDict):
    """The objective over realisations, and what its realisations cost."""
    #: Values that there are; the quartiles and the range are absent where it is 0.
    count: int
    #: Their mean. Unit: of what is counted.
    mean: float | None
    #: Their standard deviation; null with one. Unit: of what is counted.
    sd: float | None
    #: Of the mean. Unit: of what is counted.
    ci95: list[float] | None
    #: The least. Unit: of what is counted.
    min: NotRequired[float]
    #: Quartiles by linear interpolation (type 7). Unit: of what is counted.
    q1: NotRequired[float]
    #: The middle. Unit: of what is counted.
    median: NotRequired[float]
    #: The upper quartile. Unit: of what is counted.
    q3: NotRequired[float]
    #: The largest. Unit: of what is counted.
    max: NotRequired[float]
    #: Successes over realisations.
    success_rate: float | None
    #: Realisations that come to the threshold.
    successes: int
    #: Wilson's interval of the success rate.
    success_ci95: list[float] | None
    #: Objective up to which a realisation counts as a success; null without a result. Unit: of the objective.
    success_threshold: float | None
    #: Of the successes: evaluations until the threshold was reached. Unit: evaluations.
    evaluations_to_target: Sample
    #: Evaluations spent for one success, failed realisations included; null without success. Unit: evaluations.
    expected_running_time: float | None
    #: Of all realisations. Unit: evaluations.
    evaluations: Sample
    #: Of all realisations. Unit: s.
    seconds: Sample
    #: By name: each parameter over realisations.
    parameters: dict[str, Sample]


class Sample(TypedDict):
    """A quantity over realisations (seeds of the optimiser)."""
    #: Values that there are; the quartiles and the range are absent where it is 0.
    count: int
    #: Their mean. Unit: of what is counted.
    mean: float | None
    #: Their standard deviation; null with one. Unit: of what is counted.
    sd: float | None
    #: Of the mean. Unit: of what is counted.
    ci95: list[float] | None
    #: The least. Unit: of what is counted.
    min: NotRequired[float]
    #: Quartiles by linear interpolation (type 7). Unit: of what is counted.
    q1: NotRequired[float]
    #: The middle. Unit: of what is counted.
    median: NotRequired[float]
    #: The upper quartile. Unit: of what is counted.
    q3: NotRequired[float]
    #: The largest. Unit: of what is counted.
    max: NotRequired[float]


class RunLimit(TypedDict):
    """The limit that ended the search; null where none did."""
    #: The key of the experiment file that raises it.
    key: str
    #: Its value, as text.
    value: str


class RunFullSimulations(TypedDict):
    """Only of runs with costly tests."""
    #: Evaluations that simulated them.
    count: int
    #: Evaluations that ended at their cheap tests.
    ended_early: int
    #: Evaluations of cheaper tests that guided the search.
    guide_evaluations: int


class Diagnosis(TypedDict):
    """What the simulation gets wrong, and the cause."""
    #: For programs.
    verdict: DiagnosisVerdict
    #: Of the verdict, in sentences.
    reasons: list[str]
    #: The same reasons in the same order, for programs.
    reason_codes: list[DiagnosisReason]
    #: Share of false alarms that is accepted.
    alpha: float | None
    #: That noise alone looks like this; from refits of simulated data unless the diagnosis was quick.
    p_value: float | None
    #: True where p_value is an upper bound: so many refits cannot tell smaller ones apart. Absent otherwise.
    p_value_is_bound: NotRequired[Literal[True]]
    #: Of smooth shapes along the curves, by itself.
    p_smooth: float | None
    #: Of the marginal likelihood of all mechanisms, by itself.
    p_mechanisms: float | None
    #: By channel: where it misses its data.
    misfit: list[LocalMisfit]
    #: The best explanation first, then its rivals.
    causes: list[Cause]
    #: Causes the data cannot tell apart.
    ambiguity_set: list[str]
    #: Pairs of causes that together rival the pair that is named.
    alternatives: list[list[str]]
    #: Whether base and extension behave as a material.
    admissibility: DiagnosisAdmissibility
    #: By mechanism: what these data would show.
    detectable: list[Detectable]
    #: The model that is diagnosed.
    base: DiagnosisBase
    #: By what every channel is judged.
    noise: list[JudgedNoise]
    #: Of every mechanism that leaves a trace, at its best place; without a refit.
    scores: list[DiagnosisScores]
    #: Mechanisms as the only explanation, likeliest first; empty without an alarm.
    ranking: list[DiagnosisRanking]
    #: Pairs of mechanisms whose signatures correlate by more than 0.9 in these data.
    confusable: list[DiagnosisConfusable]
    #: What the file may say that is not so. Absent where the group is switched off, or mechanisms were asked for by
    #: name.
    file: NotRequired[FileFindings]
    #: The base with its causes. Absent without causes.
    extension: NotRequired[DiagnosisExtension]
    #: Absent where nothing was fitted.
    gain: NotRequired[Gain]
    #: Rows that differ from their neighbours as no mechanism makes them, left out of everything else. Absent without
    #: any.
    left_out: NotRequired[list[DiagnosisLeftOut]]
    #: The ambiguity set by what looks alike on these data (correlation above 0.9, also through others), the likeliest
    #: first in each. Absent without a set.
    look_alikes: NotRequired[list[list[str]]]
    #: The ambiguity set in words, one explanation each; where the budget has a tie, with places. Absent without causes.
    explanations: NotRequired[list[str]]
    #: True where one of the causes explains next to nothing without the others: together they may make up for an effect
    #: that no mechanism lists. Absent otherwise.
    unlisted: NotRequired[Literal[True]]
    #: p_value of the residuals with the causes added. Absent without causes.
    p_after: NotRequired[float | None]
    #: What the causes leave. Absent without causes.
    remainder: NotRequired[Remainder]
    #: Times the noise up to which the alarm holds.
    alarm_factor: NotRequired[float]
    #: Times the stated noise at which what the causes leave would be clean.
    noise_factor: NotRequired[float]
    #: How much of the misfit each cause takes.
    budget: NotRequired[MisfitBudget]
    #: Absent where nothing is to be told apart.
    next_experiment: NotRequired[DiagnosisNextExperiment]


#: Where one channel misses its data.
LocalMisfit = TypedDict("LocalMisfit", {
    #: Name of the test.
    "test": "str",
    #: Name of the observable.
    "channel": "str",
    #: In words.
    "where": "str",
    #: Least value of the abscissa there. Unit: of the abscissa.
    "from": "float",
    #: Largest value. Unit: of the abscissa.
    "to": "float",
    #: Of the channel by itself.
    "p_value": "float | None",
})


class Cause(TypedDict):
    """A mechanism that may be behind the misfit."""
    #: Of the mechanism.
    id: str
    #: What it is a property of.
    group: CauseGroup
    #: Where it acts; null: on the model.
    target: Target | None
    #: Of its score, by itself.
    p_value: float | None
    #: Among the mechanisms of the catalogue.
    probability: float | None
    #: What the probability is worth.
    standing: CauseStanding
    #: Its first parameter.
    amplitude: Amplitude
    #: Its other parameters.
    nuisance: list[Amplitude]
    #: Share of its signature that a refit of the parameters does not absorb.
    retained_fraction: float | None
    #: What it takes off |r|².
    gain: float
    #: How far the parameters of the base model had gone to make up for it.
    parameter_shifts: list[CauseParameterShifts]
    #: What is claimed of it.
    claim: Claim
    #: In words.
    explanation: str


class Target(TypedDict):
    """Where a mechanism acts; null where it acts on the only model."""
    #: Null where it acts alike in several.
    test: str | None
    #: Null where it acts on all of the test.
    channel: str | None
    #: Where it acts alike in several.
    tests: NotRequired[list[str]]
    #: Of the test's data, from 0.
    row: NotRequired[int]
    #: Where the tests have several, as layers do.
    model: NotRequired[str]


class Amplitude(TypedDict):
    """A parameter of a mechanism."""
    #: As the mechanism declares it.
    name: str
    #: Its value. Unit: `unit`.
    value: float
    #: Of value and ci95.
    unit: str
    #: From the data's noise. Unit: `unit`.
    ci95: list[float] | None
    #: Within what the mechanism declares to be plausible.
    plausible: bool


#: A parameter of the base.
CauseParameterShifts = TypedDict("CauseParameterShifts", {
    #: Its name.
    "parameter": "str",
    #: Of both values.
    "unit": "str",
    #: Its value without the cause. Unit: `unit`.
    "without": "float",
    #: Its value with it. Unit: `unit`.
    "with": "float",
})


class DiagnosisAdmissibility(TypedDict):
    """Whether base and extension behave as a material."""
    #: Null where it was not assessed.
    stable: bool | None
    #: Where the base loses stability; null: nowhere.
    where: str | None
    #: The mechanism that restores it; null: none does, or none is needed.
    remedy: str | None


class Detectable(TypedDict):
    """What these data would show of one mechanism. All distances are from `null`."""
    #: Of the mechanism.
    id: str
    #: The least that would be found; null: none would be. Unit: `unit`.
    detectable: float | None
    #: The least that would be told from others; null: another mechanism looks the same. Unit: `unit`.
    identifiable: float | None
    #: The amplitude that does nothing. Unit: `unit`.
    null: float
    #: The largest plausible distance; null: any is. Unit: `unit`.
    reach: float | None
    #: Of the amplitude.
    unit: str
    #: Where it acts; null: on the model.
    target: Target | None
    #: Share of its signature that a refit of the parameters does not absorb.
    retained_fraction: float | None
    #: The other mechanism whose signature is most like its own; null: there is none.
    closest: str | None
    #: With that one, absolute.
    correlation: float | None
    #: Why it would leave no trace in these data, in words; null: it would.
    absent: str | None
    #: The same for programs.
    absence: MechanismAbsence


class DiagnosisBase(TypedDict):
    """The model that is diagnosed."""
    #: Its entry of "models".
    model: str
    #: Of the rows whose noise is stated, as a run judges it; null where none is.
    misfit: Misfit | None
    #: By name.
    parameters: dict[str, Quantity]
    #: |r|².
    squares: float
    #: Values that were fitted.
    rows: int


class JudgedNoise(TypedDict):
    """By what a channel is judged."""
    #: Name of the test.
    test: str
    #: Name of the observable.
    channel: str
    #: Of the absolute part.
    unit: str
    #: What it rests on.
    source: NoiseSource
    #: Of every row. Unit: `unit`.
    absolute: float
    #: Of the measured value.
    relative: float
    #: Of neighbouring rows.
    correlation: float
    #: Degrees of freedom of an estimate; null: σ is taken as known.
    freedom: float | None
    #: σ by differences of neighbouring rows, to compare; null: not taken. Unit: `unit`.
    neighbours: float | None


class DiagnosisScores(TypedDict):
    """The score of a mechanism."""
    #: Of the mechanism.
    id: str
    #: What it is a property of.
    group: CauseGroup
    #: Of the score.
    p_value: float | None
    #: Where it acts; null: on the model.
    target: Target | None
    #: What |r|² would lose, linearly.
    score: float


class DiagnosisRanking(TypedDict):
    """A mechanism as the only explanation."""
    #: Of the mechanism.
    id: str
    #: What it is a property of.
    group: CauseGroup
    #: Where it acts; null: on the model.
    target: Target | None
    #: Among all.
    probability: float | None
    #: What |r|² would lose, linearly.
    score: float
    #: Of |r|² when fitted; null: too far behind to be fitted.
    gain: float | None


#: A pair.
DiagnosisConfusable = TypedDict("DiagnosisConfusable", {
    #: Of one mechanism.
    "id": "str",
    #: Of the other.
    "with": "str",
    #: Of their signatures.
    "correlation": "float | None",
})


class FileFindings(TypedDict):
    """What the file may say that is not so."""
    #: Found by inspection, without a fit: what a record says against itself, or a header against the file.
    suspect: list[FileFindingsSuspect]
    #: How the mistakes compare with other causes.
    standing: FileStanding
    #: Share of files that are expected to say what is not so.
    wrong_files: float | None
    #: Mistakes that were tried.
    tried: int
    #: By how much the likeliest mistake is ahead of the likeliest other cause; null where either is missing. Unit: BIC.
    lead: float | None
    #: The likeliest mistakes first.
    causes: list[FileCause]
    #: Mistakes that would leave no trace in these data.
    untellable: list[str]


class FileFindingsSuspect(TypedDict):
    """A suspicion."""
    #: For programs.
    code: FileFinding
    #: A question, with what to write.
    text: str


class FileCause(TypedDict):
    """A mistake of the file, weighed against the causes."""
    #: What is not so.
    kind: FileMistake
    #: Where.
    tests: list[str]
    #: What is so.
    sentence: str
    #: What to write into the file.
    mend: str
    #: The mend as a JSON Patch (RFC 6902) of the experiment file, without its comments. Left out where keys alone do
    #: not mend it: numbers of the data, or a stated noise, would have to change too. Left out also where the keys are
    #: those of numbered files, or units of several tables or of columns in several units.
    changes: NotRequired[list[FileChange]]
    #: Sum of whitened squares of the base model with the mistake mended.
    squares: float
    #: p_value of what it then leaves.
    p_after: float | None
    #: Among the mistakes that were tried.
    probability: float | None
    #: As good as the likeliest: one answer with it.
    near: bool
    #: The mechanism that acts as a mistake with an amplitude does.
    mechanism: NotRequired[str]
    #: Its fitted amplitudes, in base units: one, or one for each direction of a sheet. Unit: base unit.
    amplitudes: NotRequired[list[float]]


class FileChange(TypedDict):
    """One operation of a JSON Patch (RFC 6902)."""
    #: What is done: the value is added, in place of what was there.
    op: Literal['add']
    #: Where: a JSON pointer (RFC 6901).
    path: str
    #: What is written there: a word, an object of the experiment file, or a list of them.
    value: str | dict[str, str | float | dict[str, FileShare]] | list[dict[str, str | float | dict[str, FileShare]]]


class FileShare(TypedDict):
    """A parameter of several tests, which is one."""
    #: Name of what they share.
    share: str


class DiagnosisExtension(TypedDict):
    """The base with its causes. Absent without causes."""
    #: As extended.json has them.
    mechanisms: list[DiagnosisExtensionMechanisms]
    #: File name of the extended experiment.
    experiment: str


#: A mechanism that was added.
DiagnosisExtensionMechanisms = TypedDict("DiagnosisExtensionMechanisms", {
    #: Of the mechanism.
    "type": "str",
    #: The prefix of its parameters; absent of gross rows.
    "as": "NotRequired[str]",
    #: Where it acts; null: on the model.
    "target": "Target | None",
})


class Gain(TypedDict):
    """What the causes gain, also on rows that they have not seen."""
    #: What the causes take off |r|².
    in_sample: float | None
    #: |r|² without the causes.
    before: float
    #: |r|² with them.
    after: float
    #: What the best mechanism gains on average where there is nothing to find.
    expected_under_nothing: float
    #: Blocks of rows that were left out.
    held_out: list[HeldOutBlock]
    #: The explanation outside the ambiguity set that gains most; null where there is none.
    best_wrong: GainBestWrong | None


class HeldOutBlock(TypedDict):
    """Rows that were left out of the fit, and then predicted."""
    #: What was left out.
    block: str
    #: Values in it.
    rows: int
    #: Root mean square error without what was found. Unit: σ.
    before: float
    #: The same with it. Unit: σ.
    after: float
    #: Of the block as the extension predicts it.
    p_value: float | None
    #: How it is predicted.
    verdict: BlockVerdict


class GainBestWrong(TypedDict):
    """The explanation outside the ambiguity set that gains most; null where there is none."""
    #: Of its mechanisms.
    id: str
    #: What it takes off |r|².
    in_sample: float


class DiagnosisLeftOut(TypedDict):
    """A gross row."""
    #: Name of the test.
    test: str
    #: Name of the observable.
    channel: str
    #: Of the test's data, from 0.
    row: int
    #: Measured less predicted. Unit: σ.
    residual: float


class MisfitBudget(TypedDict):
    """How large the misfit is, what takes how much of it, and what is left. Shares of the misfit are of squares beyond
    noise."""
    #: Misfit that is not worth caring about. Unit: share of the range.
    tolerance: float
    #: Where it comes from.
    tolerance_origin: ToleranceOrigin
    #: Of the base. Unit: share of the range.
    rms: float
    #: Its upper 95 % bound. Unit: share of the range.
    rms_upper: float
    #: Causes in the order in which they were added.
    steps: list[BudgetStep]
    #: The upper bound of what is left is within the tolerance.
    adequate: bool
    #: Of the base.
    channels: list[ChannelMisfit]
    #: After the last step.
    rest: list[ChannelMisfit]
    #: The registered model that the base with these causes is, on these data. Absent where there is none.
    same_model: NotRequired[MisfitBudgetSameModel]
    #: Mechanisms that were not tried in some test for want of order or clock. Absent where there are none.
    not_looked_for: NotRequired[list[str]]
    #: The cause that leads. Absent where none does.
    lead: NotRequired[MisfitBudgetLead]
    #: What differs in a test that was of another state of the specimen; extended.json has it. Absent where that does
    #: not lead.
    state: NotRequired[MisfitBudgetState]
    #: Each cause as the only one, the largest share first. Absent where the causes leave noise.
    alone: NotRequired[list[Contender]]
    #: That no listed cause is behind the misfit. Absent without alone.
    unlisted_probability: NotRequired[float | None]
    #: What is left is rougher than a smooth misfit, so no cause leads. Absent without alone.
    rough: NotRequired[bool]


class BudgetStep(TypedDict):
    """A cause that was added, all parameters fitted again."""
    #: Of the mechanism; of a term its invariant and law.
    id: str
    #: It is a term of the energy.
    term: bool
    #: Where it acts; null: on the model.
    target: Target | None
    #: What it is a property of.
    group: CauseGroup
    #: Whether its amplitude is plausible.
    belief: Belief
    #: That it takes together with those before it. Unit: share of the misfit.
    share: float
    #: That it takes, averaged over all orders. Unit: share of the misfit.
    shapley: float
    #: Left after it. Unit: share of the range.
    rms: float
    #: Upper 95 % bound of what is left. Unit: share of the range.
    rms_upper: float


#: The registered model that the base with these causes is, on these data. Absent where there is none.
MisfitBudgetSameModel = TypedDict("MisfitBudgetSameModel", {
    #: Its type.
    "type": "str",
    #: Mechanisms that the base has.
    "with": "list[str]",
})


class MisfitBudgetLead(TypedDict):
    """The cause that leads. Absent where none does."""
    #: Of the mechanism; of a term its invariant and law.
    id: str
    #: The invariant that it is a law of, or acts like here; else the id.
    acts_like: str
    #: Where it acts; null: on the model.
    target: Target | None
    #: What it is a property of.
    group: CauseGroup


class MisfitBudgetState(TypedDict):
    """What differs in a test that was of another state of the specimen; extended.json has it. Absent where that does
    not lead."""
    #: Of the entry of states in extended.json.
    name: str
    #: Whose state it is.
    test: str
    #: Of the misfit beyond noise that it takes.
    share: float
    #: The fewest parameters that take nearly as much as all of them.
    changes: list[MisfitBudgetStateChanges]


class MisfitBudgetStateChanges(TypedDict):
    """A parameter with a value of its own in the state."""
    #: Its name.
    parameter: str
    #: UDUNITS spelling; 1 where it has none.
    unit: str
    #: In the other tests. Unit: `unit`.
    value: float
    #: In this test. Unit: `unit`.
    in_state: float


class Contender(TypedDict):
    """A cause as the only one."""
    #: Of the mechanism; of a term its invariant and law.
    id: str
    #: The invariant that it is a law of, or acts like here; else the id.
    acts_like: str
    #: It is a term of the energy.
    term: bool
    #: Where it acts; null: on the model.
    target: Target | None
    #: What it is a property of.
    group: CauseGroup
    #: Whether its amplitude is plausible.
    belief: Belief
    #: That it takes alone. Unit: share of the misfit.
    share: float
    #: With "no listed cause, only a smooth misfit" among the rivals.
    probability: float | None
    #: Left after it. Unit: share of the range.
    rms: float


class DiagnosisNextExperiment(TypedDict):
    """Absent where nothing is to be told apart."""
    #: In words.
    description: str
    #: Mechanisms that it tells apart.
    separates: list[str]
    #: How often to measure it; null where once is enough or it cannot be said.
    repeats: int | None


class Discovery(TypedDict):
    """Which terms the energy lacks, or is made of."""
    #: For programs.
    verdict: DiagnosisVerdict
    #: Why.
    reasons: list[DiscoveryReasonGiven]
    #: The model that the terms are added to; null from nothing.
    base: str | None
    #: The entry of "models" that gets the terms.
    model: str
    #: Share of false alarms that is accepted.
    alpha: float | None
    #: Explanations that hold 92.5 % of the probability, the offered one first.
    ambiguity_set: list[Rival]
    #: The likeliest mechanism that changes the energy too. Absent where none was fitted.
    name_of_the_catalogue: NotRequired[DiscoveryNameOfTheCatalogue]
    #: That noise alone looks like what the base leaves; null from nothing.
    p_before: float | None
    #: That noise alone looks like what the terms leave.
    p_after: float | None
    #: |r|² of the base; null from nothing.
    chi2_before: float | None
    #: |r|² with the terms.
    chi2_after: float
    #: Values that were fitted.
    rows: int
    #: Sets of terms that were fitted.
    sets_fitted: int
    #: Of the set that is offered.
    terms: list[Term]
    #: Whether the data differ at the same strain, which no energy can explain.
    path_dependence: DiscoveryPathDependence
    #: Blocks of rows that were left out; empty of a cohort.
    held_out: list[HeldOutBlock]
    #: Absent where nothing is to be told apart. Not of a cohort.
    next_experiment: NotRequired[DiscoveryNextExperiment]
    #: Of a cohort: what each specimen says.
    specimens: NotRequired[list[DiscoverySpecimens]]
    #: Of a cohort: specimens that cannot be read or fitted.
    left_out: NotRequired[list[DiscoveryLeftOut]]


class DiscoveryReasonGiven(TypedDict):
    """One reason for the verdict."""
    #: For programs.
    code: DiscoveryReason
    #: In a sentence.
    text: str


class Rival(TypedDict):
    """One explanation: terms, an error of the rig, or a mechanism with memory."""
    #: A set of terms.
    terms: NotRequired[list[TermKind]]
    #: Errors of the rig in place of terms.
    rig: NotRequired[list[str]]
    #: Mechanisms with memory in place of terms.
    memory: NotRequired[list[str]]
    #: Among all explanations.
    probability: float | None
    #: |r|² with it.
    chi2: float


class TermKind(TypedDict):
    """A term: what it is a function of, and how it grows."""
    #: What it is a function of.
    invariant: Invariant
    #: Of fibres.
    family: NotRequired[FibreFamily]
    #: How it grows.
    law: Law
    #: Of a curve: where its second derivative bends, on the axis of the invariant.
    knots: NotRequired[list[float]]


class DiscoveryNameOfTheCatalogue(TypedDict):
    """The likeliest mechanism that changes the energy too. Absent where none was fitted."""
    #: Of the mechanism.
    id: str
    #: |r|² with it.
    chi2: float


class Term(TypedDict):
    """A term of the set that is offered."""
    #: Prefix of its parameters.
    name: str
    #: What it is a function of.
    invariant: Invariant
    #: Of fibres.
    family: NotRequired[FibreFamily]
    #: How it grows.
    law: Law
    #: Of a curve: where its second derivative bends, on the axis of the invariant.
    knots: NotRequired[list[float]]
    #: Whether it is a law, and no free curve.
    closed: bool
    #: Of this invariant and law, among all sets.
    probability: float | None
    #: Of this invariant with any law; a sum, so rounding may lift it above 1.
    invariant_probability: float | None
    #: By name.
    parameters: NotRequired[dict[str, TermParameter]]
    #: Not of a cohort.
    curve: NotRequired[TermCurve]
    #: Of a cohort: specimens in which it shows.
    seen: NotRequired[int]
    #: Of a cohort: by specimen.
    curves: NotRequired[list[TermCurves]]


class TermParameter(TypedDict):
    """A parameter of a term. Of a cohort: the middle of the specimens, the least and the largest of them."""
    #: Its value. Unit: `unit`.
    value: float
    #: Lower end of its 95 % interval; null where it cannot be given. Unit: `unit`.
    low: float | None
    #: Upper end. Unit: `unit`.
    high: float | None
    #: Of the numbers.
    unit: str
    #: It lies at a bound. Not of a cohort.
    at_bound: NotRequired[bool]


class TermCurve(TypedDict):
    """dψ/dx over x of a term, m points."""
    #: Values of the invariant, m.
    x: list[float]
    #: dψ/dx, m. Unit: `unit`.
    slope: list[float]
    #: Lower end of a 95 % band, m. Unit: `unit`.
    low: list[float]
    #: Upper end, m. Unit: `unit`.
    high: list[float]
    #: Of slope.
    unit: str
    #: Least and largest x of the data.
    reach: list[float]


class TermCurves(TypedDict):
    """dψ/dx over x in one specimen, m points."""
    #: Its id.
    specimen: str
    #: Values of the invariant, m.
    x: list[float]
    #: dψ/dx, m. Unit: `unit`.
    slope: list[float]
    #: Of slope.
    unit: str


class DiscoveryPathDependence(TypedDict):
    """Whether the data differ at the same strain, which no energy can explain."""
    #: That noise alone differs so much.
    p_value: float | None
    #: Of the misfit beyond noise that differs at the same strain.
    share: float
    #: Tests or branches that differ, in words; empty where nothing can be compared.
    where: str


class DiscoveryNextExperiment(TypedDict):
    """Absent where nothing is to be told apart. Not of a cohort."""
    #: In words.
    description: str


class DiscoverySpecimens(TypedDict):
    """A specimen."""
    #: Its id.
    specimen: str
    #: Values that were fitted.
    rows: int
    #: As of the cohort.
    p_before: float | None
    #: As of the cohort.
    p_after: float | None
    #: |r|² of the base.
    chi2_before: float
    #: |r|² with the terms.
    chi2_after: float
    #: ln of the evidence of the terms over the base, from this specimen alone.
    gain: float
    #: Whether the others choose other invariants without it.
    needed: bool


class DiscoveryLeftOut(TypedDict):
    """A specimen."""
    #: Its id.
    specimen: str
    #: In a sentence.
    reason: str


class Provenance(TypedDict):
    """What a result was made with."""
    #: Version of the program.
    tunica: str
    #: Name and version of each plugin that took part.
    plugins: list[str]
    #: That built the program.
    compiler: str
    #: Operating system and processor that made the result, as "Linux 6.1.0, x86_64".
    system: str
    #: Instructions that models were evaluated with.
    vector_level: VectorLevel
    #: By name: their version.
    libraries: dict[str, str]
    #: Of all random numbers.
    seed: int
    #: Of input.json.
    input_sha256: str
    #: File name and SHA-256 of each data file.
    data: list[str]
    #: UTC, as 2026-11-28T03:04:05Z.
    date: str


class CohortResult(TypedDict):
    """result.json of `tunica cohort`; docs/cohort.md says how it comes about. Numbers are in the unit that is beside
    them, else in base units; null is a number that is not finite. The schema is closed: a key that it does not list is
    a fault of this version."""
    #: Version of this format.
    format: Literal[1]
    #: Of the cohort.
    name: str
    #: What a reader should know before the numbers.
    warnings: list[str]
    #: The same warnings in the same order, for programs.
    warning_details: list[CohortResultWarningDetails]
    #: Specimens, and what they have in common.
    cohort: CohortResultCohort
    #: Only with --diagnose, or "diagnosis" in the cohort file.
    diagnosis: NotRequired[CohortDiagnosis]
    #: What the result was made with.
    provenance: CohortResultProvenance


class CohortResultWarningDetails(TypedDict):
    """A warning of a cohort."""
    #: What it is about.
    kind: CohortRemark
    #: The warning.
    sentence: str
    #: Ids; empty: all.
    specimens: list[str]


class CohortResultCohort(TypedDict):
    """Specimens, and what they have in common."""
    #: In the order of the table.
    specimens: list[CohortSpecimen]
    #: One for each run.
    populations: list[CohortPopulation]


class CohortSpecimen(TypedDict):
    """What became of one specimen."""
    #: As the table has it.
    id: str
    #: Of its results.
    folder: str
    #: For programs.
    outcome: CohortOutcome
    #: Why it has no result; empty where it has.
    reason: str
    #: Kinds of its warnings.
    warnings: list[str]


class CohortPopulation(TypedDict):
    """What the specimens of one run have in common. With `problem` only run, model, specimens, readings."""
    #: Name of the run.
    run: str
    #: Its model.
    model: str
    #: That have a fit.
    specimens: int
    #: Numbers read off the curves.
    readings: CohortAnalysis
    #: Why there is no population.
    problem: NotRequired[str]
    #: Of the specimens; as many as specimens where the table names none.
    animals: NotRequired[int]
    #: How parameters go together.
    spread_structure: NotRequired[CohortSpreadStructure]
    #: Animals have several specimens.
    nested: NotRequired[bool]
    #: Specimens and population no longer move.
    converged: NotRequired[bool]
    #: Until then.
    rounds: NotRequired[int]
    #: Of the population.
    neg2_log_likelihood: NotRequired[float | None]
    #: Akaike's criterion.
    aic: NotRequired[float | None]
    #: Schwarz's criterion.
    bic: NotRequired[float | None]
    #: Of the model.
    parameters: NotRequired[CohortAnalysis]
    #: Specimens that the others do not predict (p below 0.05).
    outlying: NotRequired[list[CohortPopulationOutlying]]
    #: By channel: σ of the cohort over what the specimens' own fits say. Only with noise of the cohort.
    noise_factor: NotRequired[dict[str, float | None]]


class CohortAnalysis(TypedDict):
    """Parameters, or readings, of the population."""
    #: By name.
    of: dict[str, CohortCoordinate]
    #: Of every level but the reference, on each of them.
    effects: NotRequired[list[CohortEffect]]
    #: By factor.
    factors: NotRequired[list[CohortFactor]]
    #: Why there is no analysis.
    problem: NotRequired[str]


class CohortCoordinate(TypedDict):
    """A parameter or a reading: typical values by group, and how specimens differ. A reading also has what it reads,
    and its value in each specimen."""
    #: Of all numbers.
    unit: NotRequired[str]
    #: By group: the typical value, the median of specimens where the scale is log.
    means: NotRequired[dict[str, CohortEstimate]]
    #: Between specimens.
    spread: NotRequired[CohortSpread]
    #: Absent where the data do not carry it.
    planning: NotRequired[CohortPlanning]
    #: Of a reading: the test.
    test: NotRequired[str]
    #: Of a reading: the observable.
    channel: NotRequired[str]
    #: Of a reading.
    kind: NotRequired[CohortReadingKind]
    #: Of a reading: one abscissa or two, as the cohort file has them.
    at: NotRequired[list[str]]
    #: Of a reading, by specimen.
    specimens: NotRequired[dict[str, CohortEstimate]]
    #: Of a reading, by specimen: why there is no value.
    missing: NotRequired[dict[str, str]]


class CohortEstimate(TypedDict):
    """A value with its 95 % interval."""
    #: Null where it is not finite. Unit: of the parameter or reading.
    value: float | None
    #: Lower and upper end. Unit: of the parameter or reading.
    ci95: list[float | None]


class CohortSpread(TypedDict):
    """How specimens of one group differ."""
    #: Of the parameter or reading.
    scale: CohortScale
    #: About the relative spread where the scale is log; else in the unit of the parameter. Unit: of the parameter or
    #: reading.
    sd: float | None
    #: Of sd; null above: any spread is possible. Unit: of the parameter or reading.
    ci95: list[float | None]
    #: How animals differ. Only of nested cohorts. Unit: of the parameter or reading.
    of_animals: NotRequired[float]


class CohortPlanning(TypedDict):
    """How many specimens (nested: animals) a study needs."""
    #: Difference, or ratio, that as many as now, half in each group, show. Unit: of the parameter or reading.
    detectable: float | None
    #: It is a ratio.
    ratio: bool
    #: A group, for a difference of 20 %; null: more than can be said. Only where the scale is log.
    specimens_for_20_percent: NotRequired[int | None]
    #: The same for 50 %.
    specimens_for_50_percent: NotRequired[int | None]


class CohortEffect(TypedDict):
    """What a level of a factor does to one parameter or reading, against the reference."""
    #: A column of the table.
    factor: str
    #: One of its values.
    level: str
    #: The value it is compared with.
    reference: str
    #: The parameter or reading.
    of: str
    #: How it is expressed.
    kind: CohortEffectKind
    #: A ratio, or a difference in the unit of the parameter. Unit: of the parameter or reading.
    value: float | None
    #: Of value. Unit: of the parameter or reading.
    ci95: list[float | None]
    #: Degrees of freedom of t.
    freedom: float | None
    #: Of t, of this level.
    p: float | None
    #: Of all levels together, for all parameters (Holm).
    p_holm: float | None
    #: Of all levels together, by exchanging labels.
    p_permutation: float | None
    #: The same, for all parameters (Westfall and Young).
    p_adjusted: float | None


class CohortFactor(TypedDict):
    """Whether a factor matters at all."""
    #: A column of the table.
    factor: str
    #: Twice the logarithm.
    likelihood_ratio: float | None
    #: Its degrees of freedom.
    freedom: float | None
    #: By χ².
    p: float | None
    #: By exchanging labels.
    p_permutation: float | None
    #: Arrangements that were tried.
    permutations: int
    #: There are no others.
    all_arrangements: bool
    #: What carries the labels.
    exchanged: CohortScheme
    #: That so few arrangements can give.
    smallest_p: float | None


class CohortPopulationOutlying(TypedDict):
    """A specimen."""
    #: Its id.
    specimen: str
    #: Of one so far off, for all specimens together (Holm).
    p: float | None
    #: The parameter.
    farthest_in: str


class CohortDiagnosis(TypedDict):
    """One verdict on all specimens. With `problem` there is none, and only alpha, sentences, not_diagnosed."""
    #: Why there is no verdict.
    problem: NotRequired[str]
    #: For programs.
    verdict: NotRequired[CohortVerdict]
    #: Why.
    reasons: NotRequired[list[CohortReason]]
    #: Of all specimens together.
    p_value: NotRequired[float | None]
    #: p_value is below alpha.
    alarm: NotRequired[bool]
    #: Mechanisms in the best explanation.
    named: NotRequired[int]
    #: Ids of explanations that the data cannot tell apart.
    ambiguity_set: NotRequired[list[str]]
    #: The set by what looks alike.
    look_alikes: NotRequired[list[list[str]]]
    #: How far the model misses the specimens beyond noise.
    size: NotRequired[CohortDiagnosisSize]
    #: Of the smooth shapes that the best explanation leaves.
    p_rest: NotRequired[float | None]
    #: Likeliest first; empty without an alarm.
    explanations: NotRequired[list[CohortExplanation]]
    #: Of the best explanation.
    amplitudes: NotRequired[list[CohortAmplitude]]
    #: What each factor has to do with the cause.
    factors: NotRequired[list[CohortDiagnosisFactors]]
    #: Specimens that do not go with the verdict.
    contradictions: NotRequired[list[CohortDiagnosisContradictions]]
    #: Of a single mechanism; specimens left out one by one: |r|² of each.
    left_out: NotRequired[list[CohortDiagnosisLeftOut]]
    #: n ids, in the order of p_values and of the columns of the matrix.
    specimens: NotRequired[list[str]]
    #: Of each by itself, n.
    p_values: NotRequired[list[float | None]]
    #: m × m: how alike the mechanisms of the matrix look where they act best, the mean |cosine| over the specimens.
    likeness: NotRequired[list[list[float | None]]]
    #: m mechanisms, likeliest first.
    matrix: NotRequired[list[CohortDiagnosisMatrix]]
    #: Share of false alarms that is accepted, of the cohort as a whole.
    alpha: float
    #: All of it in words.
    sentences: list[str]
    #: Specimens without a diagnosis.
    not_diagnosed: list[CohortDiagnosisNotDiagnosed]
    #: Where a cause is named.
    extended: NotRequired[CohortDiagnosisExtended]


class CohortReason(TypedDict):
    """One reason for the verdict."""
    #: For programs.
    code: CohortReasonCode
    #: In a sentence.
    text: str


class CohortDiagnosisSize(TypedDict):
    """How far the model misses the specimens beyond noise."""
    #: Squares averaged over specimens. Unit: share of the range.
    rms: float | None
    #: Misfit that is not worth caring about. Unit: share of the range.
    tolerance: float | None
    #: Where it comes from.
    tolerance_origin: CohortToleranceOrigin
    #: Specimens whose misfit has its upper bound within the tolerance.
    within: int


class CohortExplanation(TypedDict):
    """One explanation of the misfit of the whole cohort: a mechanism, or two together."""
    #: Ids.
    mechanisms: list[str]
    #: ln over nothing, of its likeliest place and setting.
    log_evidence: float | None
    #: ln over all places and settings, with the odds before the data.
    log_weight: float | None
    #: Among all explanations.
    probability: float | None
    #: It is in the ambiguity set.
    in_set: bool
    #: One for each mechanism.
    places: list[CohortPlace]
    #: By mechanism: its other parameters, by name, in their units. Unit: of the parameter.
    settings: NotRequired[list[dict[str, float]]]


class CohortPlace(TypedDict):
    """Where a mechanism acts."""
    #: Empty: in the material.
    tests: list[str]
    #: Absent: on all of the test.
    channel: NotRequired[str]
    #: Of the test's data, from 0. Absent: on all rows.
    row: NotRequired[int]
    #: Where the tests have several.
    model: NotRequired[str]
    #: All of it in words.
    words: str


class CohortAmplitude(TypedDict):
    """The amplitudes of a cause over specimens."""
    #: Of the parameter.
    name: str
    #: Of the numbers; of their root where they are squared.
    unit: str
    #: Common to all. Unit: `unit`.
    mean: float | None
    #: Lower end of its 95 % interval. Unit: `unit`.
    low: float | None
    #: Upper end. Unit: `unit`.
    high: float | None
    #: Between specimens. Unit: `unit`.
    spread: float | None
    #: Numbers are of the square of the amplitude: the mechanism is even.
    squared: bool


class CohortDiagnosisFactors(TypedDict):
    """A factor."""
    #: A column of the table.
    factor: str
    #: The level that alone has the effect; null: none.
    only_in: str | None
    #: That one level alone has it.
    probability_only: float | None
    #: By level.
    levels: list[CohortLevelEvidence]


#: What the specimens of one level say.
CohortLevelEvidence = TypedDict("CohortLevelEvidence", {
    #: A value of the column.
    "level": "str",
    #: That have it.
    "specimens": "int",
    #: ln of the evidence that they have the effect.
    "with": "float | None",
    #: ln of the evidence that they have not.
    "without": "float | None",
    #: In them. Absent without an amplitude.
    "amplitude": "NotRequired[CohortAmplitude]",
})


class CohortDiagnosisContradictions(TypedDict):
    """A specimen."""
    #: Its id.
    specimen: str
    #: For programs.
    code: CohortContradiction
    #: One clause, without a full stop.
    text: str


class CohortDiagnosisLeftOut(TypedDict):
    """A specimen."""
    #: Its id.
    specimen: str
    #: Values of it.
    rows: int
    #: Without the cause.
    without: float | None
    #: With an amplitude of its own.
    own: float | None
    #: With that of the others.
    foretold: float | None


class CohortDiagnosisMatrix(TypedDict):
    """A mechanism."""
    #: Its id.
    mechanism: str
    #: Where it acts.
    place: CohortPlace
    #: ln over that of the base, by specimen: n.
    log_evidence: list[float | None]


class CohortDiagnosisNotDiagnosed(TypedDict):
    """A specimen."""
    #: Its id.
    specimen: str
    #: In a sentence.
    reason: str


class CohortDiagnosisExtended(TypedDict):
    """Where a cause is named."""
    #: The experiment with the cause.
    experiment: str
    #: The cohort that fits it.
    cohort: str


class CohortResultProvenance(TypedDict):
    """What the result was made with."""
    #: Of the program.
    version: str
    #: Of all random numbers.
    seed: int
    #: Of the cohort file.
    cohort_sha256: str
    #: Of what the specimens were made from.
    inputs_sha256: str


class Check(TypedDict):
    """`tunica check EXP --json`, and `tunica.check()`: a dry run."""
    #: Of the experiment.
    name: str
    #: Whether the exit code is 0.
    in_order: bool
    #: Of the experiment.
    seed: int
    #: What should be looked at, in sentences.
    warnings: list[str]
    #: The same for programs.
    warning_details: list[Warning]
    #: In the order of the experiment.
    runs: list[CheckRuns]
    #: What should be known and is no reason to worry.
    notes: list[str]
    #: What runs are about.
    problems: list[CheckedProblem]
    #: Of tests with a history.
    paths: list[CheckPaths]
    #: By test: what each column is taken for, a line each.
    understood: dict[str, list[str]]


class CheckRuns(TypedDict):
    """A run that would be made."""
    #: Its name in results.
    label: str
    #: Searches with seeds of their own.
    realisations: int
    #: Of each.
    max_evaluations: int


class CheckedProblem(TypedDict):
    """One problem: runs with the same model, tests and objective."""
    #: In words.
    title: str
    #: Its entry of "models".
    model: str
    #: That are fitted.
    tests: list[str]
    #: Values c ≤ 0 that it has.
    constraints: int
    #: Derivatives are no differences.
    exact_derivatives: bool
    #: Of its tests.
    channels: list[CheckedChannel]
    #: By name.
    parameters: dict[str, CheckedParameter]
    #: The initial point.
    initial: InitialPoint


class CheckedChannel(TypedDict):
    """A channel of a test."""
    #: Name of the test.
    test: str
    #: Name of the observable.
    observable: str
    #: Of range and noise.
    unit: str
    #: Of the test.
    rows: int
    #: Rows that are not fitted.
    held_out: int
    #: Of its rows in the objective.
    weight: float
    #: Rows that have a value.
    measured: int
    #: Least and largest value; null where none is measured. Absent without rows. Unit: `unit`.
    range: NotRequired[list[float] | None]
    #: What it is drawn over. Absent without rows.
    over: NotRequired[CheckedChannelOver]
    #: As the experiment states it; null where it does not.
    noise: CheckedChannelNoise | None


class CheckedChannelOver(TypedDict):
    """What it is drawn over. Absent without rows."""
    #: Of the prescribed quantity; row: the number of the row.
    name: str
    #: Of range.
    unit: str
    #: Least and largest value. Unit: `unit`.
    range: list[float]


class CheckedChannelNoise(TypedDict):
    """As the experiment states it; null where it does not."""
    #: Of every row. Unit: `unit`.
    absolute: float
    #: Of the measured value.
    relative: float


class CheckedParameter(TypedDict):
    """A parameter: free with initial value and bounds, or fixed. Numbers in `unit`."""
    #: UDUNITS spelling.
    unit: str
    #: Where searches may begin. Unit: `unit`.
    initial: NotRequired[float]
    #: Lower bound. Unit: `unit`.
    min: NotRequired[float]
    #: Upper bound. Unit: `unit`.
    max: NotRequired[float]
    #: How it is searched.
    scale: NotRequired[Scale]
    #: Absent without one.
    prior: NotRequired[CheckedParameterPrior]
    #: The value that is held. Unit: `unit`.
    fixed: NotRequired[float]


class CheckedParameterPrior(TypedDict):
    """Absent without one."""
    #: Its mean. Unit: `unit`.
    mean: float
    #: Its standard deviation. Unit: `unit`.
    sd: float


class InitialPoint(TypedDict):
    """The initial point, evaluated once. A point that cannot be evaluated has the status only."""
    #: "ok", or "infeasible: " or "failed: " and the reason; null where it was not run.
    status: str | None
    #: Why it was not run.
    not_run: NotRequired[str]
    #: There. Unit: of the objective.
    objective: NotRequired[float | None]
    #: By test: its share of the objective. Unit: of the objective.
    per_test: NotRequired[dict[str, float | None]]
    #: That the evaluation took. Unit: s.
    seconds: NotRequired[float]
    #: Tests that were predicted by other means as well.
    agreement: NotRequired[list[OtherMeans]]
    #: What the data fix at this point, in words; null where it was not analysed.
    identifiability: NotRequired[list[str] | None]


#: A test predicted by other means, or why that failed.
OtherMeans = TypedDict("OtherMeans", {
    #: Name of the test.
    "test": "str",
    #: The other means.
    "with": "NotRequired[str]",
    #: Of the numbers.
    "unit": "NotRequired[str]",
    #: Largest difference of both predictions. Unit: `unit`.
    "difference": "NotRequired[float | None]",
    #: Up to which it may differ. Unit: `unit`.
    "expected": "NotRequired[float | None]",
    #: Why it failed, as `status` of the initial point.
    "status": "NotRequired[str]",
})


class CheckPaths(TypedDict):
    """The path of a test."""
    #: Name of the test.
    test: str
    #: The order of its rows is known.
    ordered: bool
    #: So is what it bore before.
    past_known: bool
    #: All of it in words.
    words: str


class List(TypedDict):
    """`tunica list [WHAT] --json`. With WHAT only that list."""
    #: All there are, by name.
    models: NotRequired[list[Listed]]
    #: All there are, by name.
    tests: NotRequired[list[Listed]]
    #: All there are, by name.
    optimizers: NotRequired[list[Listed]]
    #: All there are, by name.
    mechanisms: NotRequired[list[Listed]]
    #: That are loaded.
    plugins: list[ListPlugins]
    #: Plugins that were refused, with the reason.
    refused: list[str]


class Listed(TypedDict):
    """What a plugin provides."""
    #: As experiment files spell it.
    name: str
    #: What it is.
    doc: str
    #: Its source in the literature; empty where it has none.
    reference: str
    #: Name and version of its plugin.
    plugin: str


class ListPlugins(TypedDict):
    """A plugin."""
    #: Its name.
    name: str
    #: Its version.
    version: str
    #: Its path.
    file: str


class Description(TypedDict):
    """`tunica describe NAME --json`, and `tunica.describe()`: one key for each kind that has something of the name."""
    #: The model of that name.
    model: NotRequired[DescribedModel]
    #: The test of that name.
    test: NotRequired[DescribedTest]
    #: The optimiser of that name.
    optimizer: NotRequired[DescribedOptimizer]
    #: The mechanism of that name.
    mechanism: NotRequired[DescribedMechanism]


class DescribedModel(TypedDict):
    """A model."""
    #: As experiment files spell it.
    name: str
    #: What it is.
    doc: str
    #: Its source in the literature; empty where it has none.
    reference: str
    #: Name and version of its plugin.
    plugin: str
    #: In the order of the declaration.
    parameters: list[DeclaredParameter]
    #: In the order of the declaration.
    options: list[DeclaredOption]
    #: Its energy. Absent where it says none.
    formula: NotRequired[str]
    #: Whether its volume may change.
    compressible: bool
    #: Numbers of history a point has; 0: no memory.
    history_size: int
    #: Parts that its energy is the sum of; empty where it is no sum.
    energy_parts: list[str]


class DeclaredParameter(TypedDict):
    """A parameter that a plugin declares."""
    #: In experiment files.
    name: str
    #: Of the numbers.
    unit: str
    #: Where searches may begin. Unit: `unit`.
    initial: float
    #: Default lower bound. Unit: `unit`.
    min: float
    #: Default upper bound. Unit: `unit`.
    max: float
    #: How it is searched.
    scale: Scale
    #: Of tests: the value it is held at unless the file frees it. Unit: `unit`.
    held_at: NotRequired[float]
    #: What it is.
    doc: str
    #: Source of value and range.
    reference: str


class DeclaredOption(TypedDict):
    """An option that a plugin declares."""
    #: In experiment files.
    name: str
    #: What it takes.
    kind: OptionKind
    #: It has no default.
    required: bool
    #: Absent where it is required. Unit: `unit`.
    default: NotRequired[bool | float | str]
    #: Of a quantity.
    unit: NotRequired[str]
    #: The least value. Unit: `unit`.
    min: NotRequired[float]
    #: The largest. Unit: `unit`.
    max: NotRequired[float]
    #: That there are.
    choices: NotRequired[list[str]]
    #: What it does.
    doc: str


class DescribedTest(TypedDict):
    """A test."""
    #: As experiment files spell it.
    name: str
    #: What it is.
    doc: str
    #: Its source in the literature; empty where it has none.
    reference: str
    #: Name and version of its plugin.
    plugin: str
    #: Columns that its data may have.
    observables: list[DescribedTestObservables]
    #: In the order of the declaration.
    parameters: list[DeclaredParameter]
    #: In the order of the declaration.
    options: list[DeclaredOption]
    #: Its wall may have several models.
    layers: bool


class DescribedTestObservables(TypedDict):
    """An observable."""
    #: In experiment files.
    name: str
    #: Base unit.
    unit: str
    #: What it is to the test.
    role: ObservableRole
    #: Data have to have it.
    required: bool
    #: What it is.
    doc: str


class DescribedOptimizer(TypedDict):
    """An optimiser."""
    #: As experiment files spell it.
    name: str
    #: What it is.
    doc: str
    #: Its source in the literature; empty where it has none.
    reference: str
    #: Name and version of its plugin.
    plugin: str
    #: What it asks of a problem, with default options.
    needs: DescribedOptimizerNeeds
    #: In the order of the declaration.
    options: list[DeclaredOption]


class DescribedOptimizerNeeds(TypedDict):
    """What it asks of a problem, with default options."""
    #: Residuals and their Jacobian.
    residuals: bool
    #: The gradient.
    gradient: bool
    #: Several points at once.
    batch: bool
    #: Constraints.
    constraints: bool
    #: Random numbers.
    random: bool


class DescribedMechanism(TypedDict):
    """A mechanism."""
    #: As experiment files spell it.
    name: str
    #: What it is.
    doc: str
    #: Its source in the literature; empty where it has none.
    reference: str
    #: Name and version of its plugin.
    plugin: str
    #: In the order of the declaration.
    parameters: list[DeclaredParameter]
    #: In the order of the declaration.
    options: list[DeclaredOption]
    #: The amplitude, its first parameter, that does nothing. Unit: of the amplitude.
    null: float
    #: Where amplitudes lie.
    side: Side
    #: Least and largest plausible amplitude; null: no limit. Unit: of the amplitude.
    plausible: list[float | None]
    #: Where not 0, the largest plausible amplitude is the one whose effect is this multiple of the range of the
    #: measured values; 0: as declared.
    plausible_effect: float
    #: It acts along directions.
    directional: bool
    #: Types of tests; empty: all.
    applies_to: list[str]
    #: Mechanisms with a similar effect.
    look_alikes: list[str]
    #: The experiment that tells it from them.
    isolated_by: str


class StabilityAnswer(TypedDict):
    """`tunica stability EXP --json`: whether a parameter set is a stable material."""
    #: Its entry of "models"; several, of layers, are joined.
    model: str
    #: Where the values come from, with the values.
    origin: str
    #: By name: what was judged, fixed ones included.
    parameters: dict[str, Quantity]
    #: Values outside the declared ranges.
    warnings: list[str]
    #: Transverse stability at every stretch that was asked for; null where it could not be followed.
    stable: bool | None
    #: As `best.stability` of result.json.
    stability: JudgedMaterial
    #: That were written.
    files: list[str]


class JudgedMaterial(TypedDict):
    """Of one model the keys of stability_of_model, of several `models`."""
    #: Of strips along each axis; empty where the model changes its volume.
    transverse: NotRequired[list[StripStability]]
    #: Whether the material stays elliptic.
    ellipticity: NotRequired[Condition]
    #: Drucker's condition, of isotropic models; null for others.
    drucker: NotRequired[Condition | None]
    #: Whether the energy has a minimum over the stretches of free faces; null where the model keeps its volume.
    free_faces: NotRequired[Condition | None]
    #: Inequalities of the model that do not hold, with their value.
    inadmissible: NotRequired[list[str]]
    #: All of it in words.
    sentences: NotRequired[list[str]]
    #: By name, in place of the other keys: each model of a run that has several.
    models: NotRequired[dict[str, StabilityOfModel]]


class PluginCheck(TypedDict):
    """`tunica plugin check FILE --json`."""
    #: Name and version.
    plugin: str
    #: As it was given.
    file: str
    #: Of what was tried.
    seed: int
    #: Whether the exit code is 0.
    passed: bool
    #: One for each property.
    findings: list[CheckedProperty]


#: A property of a part of a plugin.
CheckedProperty = TypedDict("CheckedProperty", {
    #: Of the part, in words: model, test or optimiser, for example.
    "kind": "str",
    #: Of the part.
    "name": "str",
    #: What it was checked with; empty: by itself.
    "with": "str",
    #: Its name in docs/plugin-check.md.
    "property": "str",
    #: What became of it.
    "outcome": "OutcomeOfProperty",
    #: What was held against what.
    "compared": "str",
    #: Largest error; relative unless `compared` says otherwise. Null where it is infinite.
    "worst": "float | None",
    #: Up to which it holds; 0 with a worst of 0: a matter of yes and no.
    "tolerance": "float | None",
    #: Where it does not hold. Absent where it does.
    "counter_example": "NotRequired[str]",
    #: Why it was not checked.
    "reason": "NotRequired[str]",
    #: What else to know.
    "note": "NotRequired[str]",
    #: That it took. Unit: s.
    "seconds": "float",
})


class Certificates(TypedDict):
    """`tunica certify DIR`, always JSON."""
    #: Runs with a best point.
    runs: list[CertifiedRun]


class CertifiedRun(TypedDict):
    """A best point, evaluated again."""
    #: How it ended.
    status: Status
    #: Why it failed or is infeasible; empty where it is neither.
    reason: str
    #: How far it breaks the constraints. Unit: of the constraints.
    violation: float | None
    #: Here. Unit: of the objective.
    objective: float | None
    #: Neighbours that were evaluated.
    evaluated: int
    #: Those that break a constraint.
    infeasible: int
    #: Those that cannot be evaluated.
    failed: int
    #: Those for which there was no time.
    left_out: int
    #: The lowest feasible neighbour; null where there is none.
    lowest: CertifiedRunLowest | None
    #: It is lower by more than rounding.
    better: bool
    #: Values of constraints.
    constraints: int
    #: Those within 1e-3 of their limit.
    active_constraints: int
    #: Name of the run.
    run: str
    #: The objective of result.json. Unit: of the objective.
    recorded: float | None
    #: From that. Unit: of the objective.
    difference: float | None
    #: Bit for bit.
    identical: bool


class CertifiedRunLowest(TypedDict):
    """The lowest feasible neighbour; null where there is none."""
    #: Its objective. Unit: of the objective.
    objective: float
    #: The parameter, or the direction of the residuals' curvature, that the step follows.
    along: str
    #: Signed; 0: a local search ended there. Unit: of the unit box.
    step: float
    #: Its free parameters, in the order of the run's. Unit: base unit.
    parameters: list[float]


class CohortStatus(TypedDict):
    """`tunica cohort status FILE -o DIR --json`."""
    #: Of the cohort.
    name: str
    #: All.
    specimens: int
    #: Those without a result.
    missing: int
    #: Why the queue was not asked; null where it was.
    queue_problem: str | None
    #: By number.
    shards: list[CohortStatusShards]
    #: The job that puts all together; null: none is known.
    merge: CohortStatusMerge | None
    #: Jobs that Slurm holds.
    held: list[CohortStatusHeld]


class CohortStatusShards(TypedDict):
    """A shard."""
    #: Its number.
    shard: int
    #: How far it is.
    standing: ShardStanding
    #: Of the shard.
    specimens: int
    #: Those without a result.
    missing: int
    #: The newest that was to make it; null: none is known.
    job: str | None
    #: In Slurm's words; null where Slurm has forgotten the job, or was not asked.
    state: str | None
    #: In Slurm's words.
    reason: str | None
    #: It runs on.
    nodes: str | None
    #: Of its log, where it stopped.
    last_words: str | None


class CohortStatusMerge(TypedDict):
    """The job that puts all together; null: none is known."""
    #: Its number.
    job: str
    #: How far it is.
    standing: JobPhase
    #: In Slurm's words.
    state: str
    #: In Slurm's words.
    reason: str | None
    #: Of its log, where it failed.
    last_words: str | None


class CohortStatusHeld(TypedDict):
    """A job."""
    #: Its number.
    job: str
    #: In Slurm's words.
    reason: str


class TakenRows(TypedDict):
    """`tunica data --json`: the rows that a fit takes."""
    #: By name, in the order of the file.
    tests: dict[str, TakenTest]


class TakenTest(TypedDict):
    """What a fit takes of the files of a test."""
    #: Values by `name [unit]`, one a row; null where nothing was measured. Unit: that of the key.
    columns: dict[str, list[float | None]]
    #: Names of the prescribed quantities.
    prescribed: list[str]
    #: Line of each row in the first file; empty where rows have none.
    lines: list[int]
    #: What each column was taken for, and which rows were taken.
    understood: list[str]
    #: Sentences.
    warnings: list[str]


class Simulation(TypedDict):
    """simulation.json of `tunica simulate -o DIR`; the predictions are CSV tables."""
    #: Of the experiment.
    name: str
    #: Its entry of "models".
    model: str
    #: That were simulated.
    tests: list[str]
    #: By name, fixed ones included.
    parameters: dict[str, Quantity]
    #: Where the values come from.
    source: str
    #: The same with the values.
    origin: str
    #: That was added to the predictions, relative; 0: none.
    noise: float
    #: Of that noise.
    seed: int
    #: Values outside the declared ranges.
    warnings: list[str]
    #: Predicted columns.
    curves: list[SimulationCurves]


class SimulationCurves(TypedDict):
    """A predicted column of a table."""
    #: Name of the test.
    test: str
    #: Its name.
    column: str
    #: The prescribed column that it is drawn over.
    over: str
    #: All prescribed columns of the table.
    prescribed: list[str]
