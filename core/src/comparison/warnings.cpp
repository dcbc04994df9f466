// SPDX-License-Identifier: Apache-2.0
#include "comparison/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace tunica::comparison {

namespace {

void warn_of_bounds(const RunSummary& run, std::vector<std::string>& warnings) {
  for (const auto& parameter : run.parameters) {
    if (parameter.at_bound == Estimate::Bound::none) continue;
    const bool upper = parameter.at_bound == Estimate::Bound::upper;
    const std::string unit = parameter.unit == "1" ? "" : ' ' + parameter.unit;
    warnings.push_back(
        fmt::format("{}: {} = {:.6g}{} IS AT ITS {} BOUND ({:.6g}{}): the best value may lie beyond it; "
                    "widen the bound if physics allows it, else doubt the model",
                    run.label, parameter.name, parameter.value, unit, upper ? "UPPER" : "LOWER",
                    upper ? parameter.max : parameter.min, unit));
  }
}

void warn_of_loose_parameters(const RunSummary& run, std::vector<std::string>& warnings) {
  std::vector<std::string> names;
  for (const auto& parameter : run.parameters)
    if (parameter.assessed && !parameter.identified && !parameter.held && parameter.at_bound == Estimate::Bound::none)
      names.push_back(parameter.name);
  if (!names.empty())
    warnings.push_back(fmt::format("{}: the data do not fix {}{}; what they do fix is said below", run.label,
                                   fmt::join(names, ", "), names.size() > 1 ? " one by one" : ""));
}

/// `who`: the run, and the model where it has several.
void warn_of_instability(const std::string& who, const StabilitySummary::OfModel& model,
                         std::vector<std::string>& warnings) {
  const auto& verdict = model.verdict;
  for (const auto& strip : verdict.transverse)
    if (strip.stable == false) {
      const bool pulled = strip.first_unstable && *strip.first_unstable < strip.judged_to;
      const auto& from = pulled ? strip.first_unstable : strip.first_unstable_pressed;
      warnings.push_back(fmt::format(
          "{}: UNSTABLE: {} along the {} axis, the transverse stretch λ3 {}{} (measured {}to {:.4g}); impose the "
          "constraint transverse_stability, or take a model with dispersed fibres",
          who, pulled ? "pulled" : "pressed", strip.axis == 0 ? "circumferential" : "axial", pulled ? "grows" : "falls",
          from ? fmt::format(" {} stretch {:.4g}", pulled ? "from" : "below", *from) : "",
          strip.judged_from < 1 ? fmt::format("from {:.4g} ", strip.judged_from) : "", strip.judged_to));
    }
  if (verdict.ellipticity.first_lost)
    warnings.push_back(
        fmt::format("{}: ELLIPTICITY IS LOST at stretch {:.4g} in {}, within the measured domain: finite "
                    "elements will localise there",
                    who, *verdict.ellipticity.first_lost, verdict.ellipticity.path));
  if (verdict.drucker && verdict.drucker->first_lost)
    warnings.push_back(
        fmt::format("{}: DRUCKER'S CONDITION IS LOST at stretch {:.4g} in {}, within the measured domain", who,
                    *verdict.drucker->first_lost, verdict.drucker->path));
  if (!model.inadmissible.empty())
    warnings.push_back(
        fmt::format("{}: the parameters are NOT ADMISSIBLE: {} must not be negative; impose the constraint "
                    "admissible_parameters",
                    who, fmt::join(model.inadmissible, ", ")));
}

void warn_of_instability(const RunSummary& run, std::vector<std::string>& warnings) {
  if (!run.stability) return;
  const auto& models = run.stability->models;
  for (const auto& model : models)
    warn_of_instability(models.size() > 1 ? fmt::format("{}, model '{}'", run.label, model.name) : run.label, model,
                        warnings);
}

/// "600 times: …; 3 times: …", or the first where there is one kind.
std::string reasons_text(const RunSummary& run) {
  constexpr std::size_t told = 3;
  const auto& kinds = run.failure_reasons;
  if (kinds.size() < 2) return "the first: " + run.first_failure;
  std::string text;
  for (std::size_t k = 0; k < std::min(told, kinds.size()); ++k)
    text += fmt::format("{}{} times: {}", k == 0 ? "" : "; ", kinds[k].count, kinds[k].example);
  return kinds.size() > told ? text + "; and other reasons" : text;
}

void warn_of_failures(const RunSummary& run, std::vector<std::string>& warnings) {
  if (run.failures == 0 || !run.has_result) return;
  const double share =
      100 * static_cast<double>(run.failures) / static_cast<double>(std::max<std::uint64_t>(run.evaluations, 1));
  warnings.push_back(fmt::format("{}: {} of {} evaluations failed ({:.3g} %); {}", run.label, run.failures,
                                 run.evaluations, share, reasons_text(run)));
  if (run.faults > 0)
    warnings.push_back(fmt::format("{}: {} of {} realisations ENDED BY AN ERROR of the optimiser: {}", run.label,
                                   run.faults, run.realisations, run.first_fault));
  if (run.one_course)
    warnings.push_back(fmt::format(
        "{}: all {} realisations improved by the same steps, for they begin at the same initial values: this is one "
        "search, counted {} times. For a statistic over starting points set \"initial\": \"random\"",
        run.label, run.realisations, run.realisations));
  if (run.given_up > 0)
    warnings.push_back(
        fmt::format("{}: {} of {} realisations were GIVEN UP by on_failure before their budget was spent", run.label,
                    run.given_up, run.realisations));
}

}  // namespace

std::vector<std::string> warnings_of(const execution::Plan& plan, const std::vector<RunSummary>& runs) {
  std::vector<std::string> warnings;
  for (const auto& run : runs)
    if (!run.has_result)
      warnings.push_back(fmt::format(
          "{}: NO RESULT: {}", run.label,
          run.evaluations == 0 ? "nothing was evaluated"
                               : fmt::format("all {} evaluations failed; {}", run.evaluations, reasons_text(run))));
  for (const auto& run : runs)
    if (run.has_result && run.status.kind() == Status::Kind::infeasible)
      warnings.push_back(
          fmt::format("{}: NO FEASIBLE POINT WAS FOUND in {} evaluations: shown is the least violation, {:.3g}, not a "
                      "fit; its worst "
                      "is {}. Widen the bounds, or ask for less",
                      run.label, run.evaluations, run.status.violation(), run.status.reason()));
  for (const auto& run : runs)
    if (run.status.ok()) warn_of_instability(run, warnings);  // of the others the constraint says it
  for (const auto& run : runs) warn_of_bounds(run, warnings);
  for (const auto& run : runs)
    if (run.status.ok()) warn_of_loose_parameters(run, warnings);
  for (const auto& run : runs) warn_of_failures(run, warnings);
  for (std::size_t run = 0; run < runs.size(); ++run) {
    const auto& entry = *plan.runs[run].entry;
    if (entry.stop.max_time)
      warnings.push_back(
          fmt::format("{}: max_time is set: where it ends a search the result depends on the speed of the "
                      "machine, and a repetition may differ",
                      runs[run].label));
    const auto& parameters = plan.runs[run].assembly->layout().parameters;
    const auto priors =
        std::count_if(parameters.begin(), parameters.end(), [](const auto& p) { return p.prior.has_value(); });
    if (priors > 0)
      warnings.push_back(fmt::format("{}: {} of its parameters have a prior, which is part of the objective",
                                     runs[run].label, priors));
  }
  for (const auto& test : plan.experiment->tests)
    if (test.hold_out.all || test.hold_out.rows)
      warnings.push_back(fmt::format("test {}: {} held out: predicted and scored, never fitted", test.name,
                                     test.hold_out.all ? "all rows are" : "some rows are"));
  std::set<std::string> groups;
  for (const auto& run : runs) groups.insert(run.group);
  if (groups.size() > 1)
    warnings.push_back(
        "the runs differ in objective or tests, so that their objectives cannot be compared; they are ranked "
        "within groups");
  return warnings;
}

}  // namespace tunica::comparison
