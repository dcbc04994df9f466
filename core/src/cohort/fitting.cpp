// SPDX-License-Identifier: Apache-2.0
#include "cohort/fitting.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "calibration/overrides.hpp"
#include "comparison/fit_table.hpp"
#include "comparison/provenance.hpp"
#include "comparison/result_json.hpp"
#include "data/sha256.hpp"
#include "execution/files.hpp"
#include "execution/realisation.hpp"
#include "experiment/parse.hpp"
#include "plugins/guarded.hpp"
#include "report/report.hpp"
#include "tunica/error.hpp"
#include "tunica/random.hpp"

namespace tunica::cohort {

namespace {

constexpr const char* record_file = "record.json";

struct Interrupted {};

Record::Parameter parameter_of(const comparison::Estimate& estimate, Scale scale) {
  Record::Parameter parameter{
      estimate.name, estimate.unit, scale, estimate.value, estimate.min, estimate.max, {}, {}, "", estimate.identified};
  if (estimate.ci95) {
    parameter.lower = estimate.ci95->first;
    parameter.upper = estimate.ci95->second;
  }
  if (estimate.at_bound != comparison::Estimate::Bound::none)
    parameter.at_bound = estimate.at_bound == comparison::Estimate::Bound::lower ? "lower" : "upper";
  return parameter;
}

double largest_of(const assembly::Layout& layout, const std::string& test, const std::string& channel) {
  double largest = 0;
  for (const assembly::MeasuredChannel& view : layout.channels)
    if (view.test == test && view.observable == channel)
      for (const double value : view.measured) largest = std::fmax(largest, std::abs(value));  // NaN: not measured
  return largest;
}

Record::Run run_of(const comparison::RunSummary& summary, const assembly::Layout& layout) {
  Record::Run run;
  run.label = summary.label;
  run.model = summary.model;
  run.has_result = summary.has_result && summary.status.ok();
  run.reason = run.has_result ? "" : summary.status.reason();
  run.evaluations = summary.evaluations;
  if (!summary.has_result) return run;
  run.objective = summary.objective;
  for (std::size_t k = 0; k < summary.parameters.size(); ++k)
    run.parameters.push_back(parameter_of(summary.parameters[k], layout.parameters[k].scale));
  for (const comparison::Quality& one : summary.quality)
    run.quality.push_back({one.test, one.channel, one.unit, one.held_out, one.agreement.r2, one.agreement.rmse,
                           largest_of(layout, one.test, one.channel)});
  if (summary.stability) run.stable = summary.stability->transversely_stable();
  if (summary.misfit && summary.misfit->judged()) run.misfit = summary.misfit->times();
  return run;
}

/// Of measured values over their first abscissa, as a person would compare two curves: whatever the files look like.
std::string hash_of_curves(const assembly::Layout& layout) {
  std::string curves;
  for (const assembly::MeasuredChannel& view : layout.channels)
    for (std::size_t row = 0; row < view.count; ++row)
      curves += fmt::format("{:.10g} {:.10g}\n", view.abscissa[row], view.measured[row]);
  return data::sha256(curves);
}

std::vector<execution::RunResult> search(const execution::Plan& plan, const std::function<bool()>& interrupted) {
  execution::Surroundings surroundings;
  surroundings.record = [](const search::Record&) {};
  surroundings.replay = [](std::uint64_t, search::JournalEntry&) { return false; };
  surroundings.interrupted = [&interrupted] { return interrupted && interrupted(); };
  std::vector<execution::RunResult> results(plan.runs.size());
  for (const execution::Task& task : plan.tasks) {
    const auto searched = [&] {
      return execution::run_realisation(plan.runs[task.run], task.realisation, *plan.experiment, surroundings);
    };
    auto result = searched();
    if (result.memory_lacked) result = searched();  // a record is kept, and would say of the specimen what is not of it
    if (result.memory_lacked) throw plugins::MemoryLack(result.reason);
    if (!result.finished) throw Interrupted{};
    results[task.run].realisations.push_back(std::move(result));
  }
  return results;
}

void fit_into(Record& record, const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
              const std::filesystem::path& folder, const FitSettings& settings) {
  const auto plan = execution::make_plan(experiment, catalogue);
  record.data = hash_of_curves(plan.runs.front().assembly->layout());
  const auto summary = comparison::summarise(plan, search(plan, settings.interrupted), settings.refusals);
  for (std::size_t k = 0; k < summary.runs.size(); ++k)
    record.runs.push_back(run_of(summary.runs[k], plan.runs[k].assembly->layout()));
  for (const execution::Warning& warning : summary.warnings)
    record.warnings.push_back({std::string(execution::code(warning.kind)), warning.text()});
  record.outcome = Outcome::fitted;
  for (const Record::Run& run : record.runs)
    if (!run.has_result && record.outcome == Outcome::fitted) {
      record.outcome = Outcome::no_result;
      record.reason = fmt::format("{}: {}", run.label, run.reason);
    }
  execution::write_atomically(folder / "input.json", experiment.input_json);
  comparison::write_fit_tables(folder, plan, summary);
  execution::write_atomically(folder / "result.json",
                              comparison::result_json(summary, comparison::provenance_of(plan)));
  if (settings.reports) report::write_report(folder);
}

void make_folder(const std::filesystem::path& folder) { execution::make_folder(folder); }

}  // namespace

Record unreadable(const Specimen& specimen) {
  Record record;
  record.id = specimen.id;
  record.outcome = Outcome::unreadable;
  record.reason = specimen.problem;
  return record;
}

Bound bind(const Specification& cohort, const Template& pattern, const Specimen& specimen,
           const plugins::Catalogue& catalogue) {
  const std::string text = pattern.of(specimen);
  Bound bound{experiment::parse_experiment(text, cohort.experiment, catalogue), {}};
  experiment::Experiment& experiment = bound.experiment;
  experiment.name = specimen.id;
  calibration::Overrides overrides;
  overrides.seed = derive_seed(cohort.seed, "specimen " + specimen.id);
  calibration::apply(overrides, catalogue, experiment);
  const std::string all = fmt::format("{}\n{}\n{}\n", comparison::version(), *overrides.seed, text);
  std::string files;
  for (const experiment::TestEntry& test : experiment.tests)
    for (const auto& file : test.data.files) files += data::sha256(data::read_bytes(file)) + "\n";
  bound.inputs = data::sha256(all + files);
  return bound;
}

std::filesystem::path folder_of(const std::filesystem::path& results, const Specimen& specimen) {
  return results / "specimens" / specimen.folder;
}

std::optional<Record> stored_record(const std::filesystem::path& results, const Specimen& specimen) {
  const auto file = folder_of(results, specimen) / record_file;
  if (!std::filesystem::exists(file)) return {};
  auto record = record_of(execution::read_text(file));
  return record && record->id == specimen.id ? record : std::nullopt;
}

std::optional<Record> fit(const Specification& cohort, const Template& pattern, const Specimen& specimen,
                          const plugins::Catalogue& catalogue, const FitSettings& settings) {
  const auto begin = std::chrono::steady_clock::now();
  if (!specimen.problem.empty()) return unreadable(specimen);
  Record record;
  record.id = specimen.id;
  const auto folder = folder_of(settings.results, specimen);
  make_folder(folder);
  try {
    const Bound bound = bind(cohort, pattern, specimen, catalogue);
    record.inputs = bound.inputs;
    auto stored = stored_record(settings.results, specimen);
    if (stored && stored->inputs == record.inputs && !stored->runs.empty()) return stored;
    if (const auto file = folder / record_file; settings.noticed && !stored && std::filesystem::exists(file))
      settings.noticed(fmt::format(
          "{}: its checksum does not fit, or another version wrote it; the specimen is fitted again", file.string()));
    fit_into(record, bound.experiment, catalogue, folder, settings);
  } catch (const Interrupted&) {
    return {};
  } catch (const execution::WriteFailure&) {
    throw;
  } catch (const std::bad_alloc&) {  // says nothing of the specimen
    throw;
  } catch (const InputError& problem) {
    record.outcome = Outcome::unreadable;
    record.reason = problem.what();
  } catch (const std::exception& problem) {
    record.outcome = Outcome::failed;
    record.reason = problem.what();
  }
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  execution::write_atomically(folder / record_file, to_json(record));
  return record;
}

}  // namespace tunica::cohort
