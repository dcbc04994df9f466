// SPDX-License-Identifier: Apache-2.0
#include "comparison/warnings.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "comparison/bound_warnings.hpp"
#include "comparison/ranking.hpp"
#include "comparison/run_differences.hpp"
#include "text/lists.hpp"
#include "text/misfit_words.hpp"
#include "text/units.hpp"

namespace tunica::comparison {

namespace {

using execution::WarningKind;
using Warnings = std::vector<execution::Warning>;

/// The run of the same model under the same constraints, objective and tests that came clearly lower, and that a fresh
/// process has not refuted; none = null.
const RunSummary* lower_run(const execution::Plan& plan, const std::vector<RunSummary>& runs, std::size_t own) {
  constexpr double clearly = 0.99;
  const auto same = [](const experiment::ConstraintEntry& a, const experiment::ConstraintEntry& b) {
    return a.type == b.type && a.json == b.json;
  };
  const auto constraints = [&](std::size_t run) -> const auto& { return plan.runs[run].entry->constraints; };
  const RunSummary* lowest = nullptr;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].group != runs[own].group || runs[k].model != runs[own].model) continue;
    if (!runs[k].status.ok() || runs[k].certificate.refuted()) continue;
    const auto &a = constraints(k), &b = constraints(own);
    if (!std::equal(a.begin(), a.end(), b.begin(), b.end(), same)) continue;
    if (runs[k].objective < clearly * (lowest != nullptr ? lowest : &runs[own])->objective) lowest = &runs[k];
  }
  return lowest;
}

/// A diagnosis fits without constraints, so it does not explain a misfit that only constraints cause.
std::string diagnosis_advised(const execution::Plan& plan, std::size_t own) {
  const std::string command = fmt::format("tunica diagnose {}", plan.experiment->file.filename().string());
  const auto& entry = *plan.runs[own].entry;
  if (entry.constraints.empty()) return "Run " + command;
  return fmt::format(
      "Fit once without the constraints ({}), \"constraints\": []. What misfit is left then is for {} "
      "to explain, which drops them",
      constraints_in_words(entry), command);
}

void warn_of_contradicted_noise(const execution::Plan& plan, const std::vector<RunSummary>& runs, std::size_t own,
                                Warnings& warnings) {
  const RunSummary& run = runs[own];
  if (!run.misfit || !run.misfit->contradicts()) return;
  if (const RunSummary* const lower = lower_run(plan, runs, own)) {
    warnings.push_back({WarningKind::search_fell_short,
                        fmt::format("the search ended above the optimum: its objective is {:.5g}, and that of {} is "
                                    "{:.5g}, with the same model and tests. Its misfit says nothing of the model. Take "
                                    "the lower run, or give this one more evaluations",
                                    run.objective, lower->label, lower->objective),
                        run.label});
    return;
  }
  warnings.push_back(
      {WarningKind::noise_contradicted,
       fmt::format("the model misses the data by {:.2g} times the noise: χ² is {:.4g} on {:.4g} degrees of freedom. {}",
                   run.misfit->times(), run.misfit->chi_square, run.misfit->freedom, diagnosis_advised(plan, own)),
       run.label});
}

void warn_of_large_noise(const RunSummary& run, Warnings& warnings) {
  if (!run.misfit || !run.misfit->falls_short()) return;
  const Deviation& worst = *run.deviation;
  const std::string unit = text::unit_suffix(worst.unit);
  warnings.push_back({WarningKind::noise_too_large,
                      fmt::format("the rows scatter by {:.2g} times the stated noise: σ of '{}' of test '{}' is "
                                  "{:.3g}{}, and the measured values reach {:.3g}{}. Misfits can hide below it, and "
                                  "intervals are too wide. Correct the noise, or the unit of the data",
                                  run.misfit->times(), worst.channel, worst.test, worst.sd, unit, worst.largest, unit),
                      run.label,
                      {worst.test, worst.channel}});
}

/// Many rows detect a misfit that no eye sees. The warning states its size and its possible effect on parameters.
void warn_of_small_misfit(const execution::Plan& plan, const std::vector<RunSummary>& runs, std::size_t own,
                          Warnings& warnings) {
  const RunSummary& run = runs[own];
  for (const auto* misfit :
       {run.misfit ? &*run.misfit : nullptr, run.misfit_estimated ? &*run.misfit_estimated : nullptr}) {
    if (!misfit || !misfit->small_but_real() || !run.deviation) continue;
    const Deviation& worst = *run.deviation;
    const auto size = std::find_if(run.sizes.begin(), run.sizes.end(), [&](const assembly::ChannelSize& one) {
      return one.test == worst.test && one.channel == worst.channel;
    });
    if (size == run.sizes.end()) return;
    warnings.push_back(
        {WarningKind::small_misfit,
         fmt::format(
             "the model misses the data by a little, and really: χ²/ν is {:.3g}, which noise alone reaches with "
             "a chance of {:.1g}. In '{}' of test '{}' it {} ({:.2g}{}). Intervals count noise alone: "
             "if all of the misfit looks like one parameter, that one is off by {:.2g} half-widths. {}",
             misfit->per_freedom(), misfit->chance, worst.channel, worst.test, text::misses_by(size->of_range().rms),
             size->rms, text::unit_suffix(worst.unit), misfit->half_widths(), diagnosis_advised(plan, own)),
         run.label,
         {worst.test, worst.channel}});
    return;
  }
}

/// An impossibly large misfit means that the data, their units or their noise are wrong.
void warn_of_scale(const RunSummary& run, Warnings& warnings) {
  constexpr double most = 1000, least = 1e-9;  // mean deviation in units of the noise
  constexpr double same = 1e-9;                // of the largest value: equal but for rounding
  if (!run.deviation) return;
  const Deviation& worst = *run.deviation;
  const std::string unit = text::unit_suffix(worst.unit);
  const std::string scales =
      fmt::format("σ is {:.3g}{}, and the measured values reach {:.3g}{}", worst.sd, unit, worst.largest, unit);
  if (!(worst.mean <= most))
    warnings.push_back(
        {WarningKind::misfit_out_of_scale,
         fmt::format("NOT A FIT: '{}' of test '{}' lies {:.2g} times its noise away on average, so that objective and "
                     "intervals mean nothing: {}. Correct the unit or the noise, or take a model that can follow",
                     worst.channel, worst.test, worst.mean, scales),
         run.label,
         {worst.test, worst.channel}});
  else if (worst.mean < least)
    warnings.push_back(
        {WarningKind::no_misfit,
         fmt::format("NO MISFIT: the objective is {:.2g}, so that it ranks nothing and fixes no interval. {}",
                     run.objective,
                     worst.share < same ? "The model repeats the data to the last digit, as it does with data that it "
                                          "has made itself. Take measured data"
                                        : fmt::format("The noise of '{}' of test '{}' hides every deviation: {}. "
                                                      "Correct the unit or the noise",
                                                      worst.channel, worst.test, scales)),
         run.label,
         {worst.test, worst.channel}});
  else
    warn_of_large_noise(run, warnings);
}

void warn_of_missing_result(const RunSummary& run, const std::string& reasons, Warnings& warnings) {
  const std::string why = run.evaluations == 0 ? run.status.reason()
                                               : fmt::format("all {} evaluations failed; {}", run.evaluations, reasons);
  warnings.push_back({WarningKind::no_result, "no result: " + why, run.label});
}

void warn_of_broken_constraints(const RunSummary& run, Warnings& warnings) {
  warnings.push_back(
      {WarningKind::no_feasible_point,
       fmt::format("no feasible point was found in {} evaluations. The point with the least violation, {:.3g}, is "
                   "shown; it is not a fit. Its worst constraint is {}. Widen the bounds, or relax the constraints",
                   run.evaluations, run.status.violation(), run.status.reason()),
       run.label});
}

void warn_of_loose_parameters(const RunSummary& run, Warnings& warnings) {
  std::vector<std::string> names;
  for (const auto& parameter : run.parameters)
    if (parameter.assessed && !parameter.identified && !parameter.held && parameter.at_bound == Estimate::Bound::none)
      names.push_back(parameter.name);
  if (names.empty()) return;
  warnings.push_back(
      {WarningKind::not_fixed_by_data,
       fmt::format("the data do not fix {}{}{}", text::joined(names), names.size() > 1 ? " one by one" : "",
                   run.identifiability.empty() ? "" : "; see below what they do fix"),
       run.label, names});
}

/// Whether a model of the run has parts that stand for fibres.
bool has_fibres(const execution::PlannedRun& planned, const std::string& name) {
  const auto& models = planned.assembly->models();
  for (std::size_t m = 0; m < models.count(); ++m) {
    if (models.name(m) != name) continue;
    const auto parts = models.model(m).parts();
    return std::any_of(parts.begin(), parts.end(),
                       [](const auto& part) { return part->describe().role == EnergyPart::Role::fibre; });
  }
  return false;
}

/// `of_model`: "model 'media': " where the run has several, else empty.
void warn_of_instability(const RunSummary& run, const std::string& of_model, const StabilitySummary::OfModel& model,
                         bool fibres, Warnings& warnings) {
  const auto& verdict = model.verdict;
  const auto warn = [&](WarningKind kind, const std::string& sentence) {
    warnings.push_back({kind, of_model + sentence, run.label, {model.name}});
  };
  const char* const domain = verdict.changes_volume() ? "the stretches that are judged" : "the measured domain";
  for (const auto& strip : verdict.transverse)
    if (strip.stable == false) {
      const bool pulled = strip.first_unstable && *strip.first_unstable < strip.judged_to;
      const auto& from = pulled ? strip.first_unstable : strip.first_unstable_pressed;
      warn(WarningKind::unstable,
           fmt::format(
               "unstable: when the strip is {} along the {} axis, the transverse stretch λ3 {}{} (measured {}to "
               "{:.4g}); impose the constraint transverse_stability{}",
               pulled ? "pulled" : "pressed", strip.axis == 0 ? "circumferential" : "axial", pulled ? "grows" : "falls",
               from ? fmt::format(" {} stretch {:.4g}", pulled ? "from" : "below", *from) : "",
               strip.judged_from < 1 ? fmt::format("from {:.4g} ", strip.judged_from) : "", strip.judged_to,
               fibres ? ". Fibres are the more stable the more they are dispersed" : ""));
    }
  if (verdict.ellipticity.first_lost)
    warn(WarningKind::ellipticity_lost,
         fmt::format("ellipticity is lost at stretch {:.4g} in {}, within {}; finite elements will localise there",
                     *verdict.ellipticity.first_lost, verdict.ellipticity.path, domain));
  if (verdict.free_faces && verdict.free_faces->first_lost)
    warn(WarningKind::free_faces_unstable,
         fmt::format("the stretches of free faces are not stable at stretch {:.4g} in {}, within {}",
                     *verdict.free_faces->first_lost, verdict.free_faces->path, domain));
  if (verdict.drucker && verdict.drucker->first_lost)
    warn(WarningKind::drucker_lost, fmt::format("Drucker's condition is lost at stretch {:.4g} in {}, within {}",
                                                *verdict.drucker->first_lost, verdict.drucker->path, domain));
  if (!model.inadmissible.empty())
    warn(WarningKind::inadmissible_parameters,
         fmt::format("the parameters are not admissible: {} must not be negative; impose the constraint "
                     "admissible_parameters",
                     text::joined(model.inadmissible)));
}

void warn_of_instability(const execution::PlannedRun& planned, const RunSummary& run, Warnings& warnings) {
  if (!run.stability) return;
  const auto& models = run.stability->models;
  for (const auto& model : models)
    warn_of_instability(run, models.size() > 1 ? fmt::format("model '{}': ", model.name) : std::string(), model,
                        has_fibres(planned, model.name), warnings);
}

/// "600 times: …; 3 times: …", or the first where there is one kind.
std::string reasons_text(const RunSummary& run) {
  constexpr std::size_t told = 3;
  const auto& kinds = run.failure_reasons;
  if (kinds.size() < 2) return "the first: " + run.first_failure;
  std::string text;
  for (std::size_t k = 0; k < std::min(told, kinds.size()); ++k)
    text +=
        fmt::format("{}{}: {}", k == 0 ? "" : "; ", text::counted(kinds[k].count, "time", "times"), kinds[k].example);
  return kinds.size() > told ? text + "; and other reasons" : text;
}

void warn_of_failures(const RunSummary& run, Warnings& warnings) {
  if (!run.has_result) return;
  if (run.failures > 0) {
    const double share =
        100 * static_cast<double>(run.failures) / static_cast<double>(std::max<std::uint64_t>(run.evaluations, 1));
    warnings.push_back({WarningKind::failed_evaluations,
                        fmt::format("{} of {} evaluations failed ({:.3g} %); {}", run.failures, run.evaluations, share,
                                    reasons_text(run)),
                        run.label});
  }
  if (run.faults > 0)
    warnings.push_back({WarningKind::optimizer_failure,
                        fmt::format("an error of the optimiser ended {} of {} realisations: {}", run.faults,
                                    run.realisations, run.first_fault),
                        run.label});
  if (run.one_course)
    warnings.push_back(
        {WarningKind::same_course,
         fmt::format(
             "all {0} realisations{1} improved by the same steps, because they begin at the same initial values. "
             "This is one search, counted {0} times. Set \"initial\": \"random\" for statistics over starting "
             "points",
             run.realisations - run.faults, run.faults == 0 ? "" : " without such an error"),
         run.label});
  if (run.given_up > 0)
    warnings.push_back({WarningKind::given_up,
                        fmt::format("on_failure gave up {} of {} realisations before their budget was spent",
                                    run.given_up, run.realisations),
                        run.label});
}

void warn_of_set_up(const execution::PlannedRun& planned, const RunSummary& run, Warnings& warnings) {
  if (planned.entry->stop.max_time)
    warnings.push_back({WarningKind::depends_on_time,
                        "max_time is set. Where it ends a search, the result depends on the speed of the machine, and "
                        "a repetition may differ",
                        run.label});
  const auto& parameters = planned.assembly->layout().parameters;
  const auto priors =
      std::count_if(parameters.begin(), parameters.end(), [](const auto& one) { return one.prior.has_value(); });
  if (priors > 0)
    warnings.push_back({WarningKind::prior,
                        fmt::format("{} of its parameters {} a prior, which is part of the objective", priors,
                                    text::agreeing(static_cast<std::size_t>(priors), "has", "have")),
                        run.label});
}

}  // namespace

std::vector<execution::Warning> warnings_of(const execution::Plan& plan, const std::vector<RunSummary>& runs,
                                            const std::vector<Ranked>& ranking) {
  Warnings warnings;
  for (const auto& run : runs)
    if (!run.has_result) warn_of_missing_result(run, reasons_text(run), warnings);
  for (const auto& run : runs)
    if (run.has_result && run.status.kind() == Status::Kind::infeasible) warn_of_broken_constraints(run, warnings);
  for (const auto& run : runs)
    if (run.status.ok()) warn_of_scale(run, warnings);
  for (std::size_t run = 0; run < runs.size(); ++run) warn_of_contradicted_noise(plan, runs, run, warnings);
  for (std::size_t run = 0; run < runs.size(); ++run)
    if (runs[run].status.ok()) warn_of_small_misfit(plan, runs, run, warnings);
  for (auto& warning : preferences(runs, ranking)) warnings.push_back(std::move(warning));
  for (std::size_t run = 0; run < runs.size(); ++run)
    if (runs[run].status.ok())  // of the others the constraint says it
      warn_of_instability(plan.runs[run], runs[run], warnings);
  for (const auto& run : runs) warn_of_bounds(run, warnings);
  for (const auto& run : runs)
    if (run.has_result) warn_of_default_bounds(run, warnings);
  for (const auto& run : runs)
    if (run.status.ok()) warn_of_loose_parameters(run, warnings);
  for (const auto& run : runs) warn_of_failures(run, warnings);
  for (std::size_t run = 0; run < runs.size(); ++run) warn_of_set_up(plan.runs[run], runs[run], warnings);
  for (const auto& test : plan.experiment->tests)
    if (test.hold_out.all || test.hold_out.rows)
      warnings.push_back({WarningKind::held_out,
                          fmt::format("test {}: {} held out: predicted and scored, never fitted", test.name,
                                      test.hold_out.all ? "all rows are" : "some rows are"),
                          "",
                          {test.name}});
  std::set<std::string> groups;
  for (const auto& run : runs) groups.insert(run.group);
  if (groups.size() > 1)
    warnings.push_back({WarningKind::not_comparable,
                        "the runs differ in objective or tests, so their objectives cannot be compared; they are "
                        "ranked within groups"});
  return warnings;
}

}  // namespace tunica::comparison
