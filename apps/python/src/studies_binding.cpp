// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <pybind11/stl.h>
#include <tbb/global_control.h>

#include "cohort/results.hpp"
#include "cohort/results_folder.hpp"
#include "cohort/shares.hpp"
#include "comparison/stability_answer.hpp"
#include "execution/files.hpp"
#include "execution/interrupt.hpp"
#include "library.hpp"
#include "module.hpp"
#include "report/report.hpp"
#include "tunica/error.hpp"
#include "watching.hpp"

namespace tunica::python {

namespace {

using Folder = std::optional<std::string>;
using Listener = std::function<void(double, const std::string&)>;

/// Ends a study between two of its steps.
struct StudyStopped {};

/// Fits the specimens, and studies them together when all are there. False where Ctrl-C came first.
bool fit_and_study(const cohort::Opened& opened, const plugins::Catalogue& catalogue,
                   const cohort::FitSettings& settings, const Listener& listener) {
  const auto fitted = cohort::fit_share(
      opened.cohort, opened.table, opened.pattern, catalogue, settings, {}, [&](std::size_t done, std::size_t of) {
        if (listener)
          listener(static_cast<double>(done) / static_cast<double>(of), fmt::format("{} of {} specimens", done, of));
      });
  if (fitted.interrupted) return false;
  const auto found = cohort::collect(opened.cohort, opened.table, opened.pattern, catalogue, settings.results);
  if (!found.missing.empty())
    throw InputError(fmt::format("{}: {} of {} specimens changed while they were fitted; start the cohort again",
                                 settings.results.string(), found.missing.size(), opened.table.specimens.size()));
  cohort::make_results(opened, found, catalogue, settings.results, [&listener](const std::string& stage, double share) {
    if (listener) listener(share, stage);
    if (execution::InterruptWatch::interrupted()) throw StudyStopped{};
  });
  return true;
}

py::dict fit_cohort(const Library& library, const std::string& file, const Folder& directory, unsigned threads,
                    bool diagnose, const std::optional<bool>& reports, const py::object& progress) {
  const OneAtATime alone;
  Told told(progress);
  const cohort::Opened opened(file, diagnose);
  const auto plugins = library.catalogue();
  const auto catalogue = interruptible(*plugins);
  cohort::FitSettings settings;
  settings.results = cohort::results_folder(directory.value_or(""), opened.cohort.name);
  settings.reports = reports.value_or(opened.table.specimens.size() <= cohort::most_reports);
  settings.refusals = library.refusals();
  settings.interrupted = [] { return execution::InterruptWatch::interrupted(); };
  settings.noticed = [](const std::string& sentence) {
    const py::gil_scoped_acquire held;
    py::module_::import("warnings").attr("warn")(sentence);
  };
  execution::write_atomically(settings.results / "cohort.json", opened.cohort.text);
  const auto listener = told.function();
  const execution::InterruptWatch watch;
  py::dict outcome;
  outcome["directory"] = settings.results.string();
  outcome["ending"] = "finished";
  try {
    const py::gil_scoped_release free;
    const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, threads);
    if (!fit_and_study(opened, catalogue, settings, listener)) outcome["ending"] = "interrupted";
  } catch (...) {
    if (!execution::InterruptWatch::interrupted()) throw;  // what failed because of Ctrl-C is no failure
    outcome["ending"] = "interrupted";
  }
  told.finish();
  return outcome;
}

/// What `tunica stability --json` prints.
std::string stability(const Loaded& loaded, const std::string& model, const Folder& parameters, const std::string& run,
                      const std::optional<double>& to, const std::optional<std::array<std::string, 2>>& map,
                      std::size_t points, const Folder& directory) {
  const py::gil_scoped_release free;
  comparison::SimulationRequest values;
  values.model = model;
  values.run = run;
  if (parameters) values.parameters = *parameters;
  comparison::StabilityRequest request{to, map, points, {}};
  if (directory) request.directory = *directory;
  const auto subject = comparison::subject_of(loaded.experiment, *loaded.catalogue, values);
  const auto answer = comparison::judge_stability(loaded.experiment.name, subject, request);
  return comparison::stability_answer_json(subject, answer).dump();
}

/// One page of several folders, or of one folder in a separate file.
void write_page(const std::vector<std::string>& folders, const std::string& file) {
  const py::gil_scoped_release free;
  const auto beside = std::filesystem::absolute(file).parent_path();
  execution::write_atomically(file, report::report({folders.begin(), folders.end()}, beside));
}

}  // namespace

void add_studies(py::module_& module) {
  module.def("fit_cohort", &fit_cohort);
  module.def("stability", &stability);
  module.def("write_page", &write_page);
}

}  // namespace tunica::python
