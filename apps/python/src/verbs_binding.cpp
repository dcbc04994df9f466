// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>
#include <pybind11/stl.h>
#include <tbb/global_control.h>

#include "arrays.hpp"
#include "budget/diagnosed.hpp"
#include "budget/discover.hpp"
#include "calibration/calibrate.hpp"
#include "calibration/examination_json.hpp"
#include "calibration/overrides.hpp"
#include "cards/card.hpp"
#include "cards/card_name.hpp"
#include "cohort/discovery_folder.hpp"
#include "comparison/certify.hpp"
#include "comparison/simulation_record.hpp"
#include "data/nearest.hpp"
#include "data/units.hpp"
#include "discovery/output/folder.hpp"
#include "discovery/wishes.hpp"
#include "execution/files.hpp"
#include "execution/interrupt.hpp"
#include "execution/run_directory.hpp"
#include "exporting/fitted_material.hpp"
#include "imports/imported.hpp"
#include "library.hpp"
#include "module.hpp"
#include "report/report.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"
#include "watching.hpp"

namespace tunica::python {

namespace {

using Folder = std::optional<std::string>;

/// A fresh process is what a Python function answers: the text that certify() printed there, or why there is none.
calibration::Certified ask(const py::object& certify, const std::filesystem::path& directory,
                           const std::filesystem::path& points) {
  const py::gil_scoped_acquire lock;
  try {
    const auto [answer, missing] =
        certify(directory.string(), points.string()).cast<std::pair<std::string, std::string>>();
    return {answer, missing};
  } catch (const std::exception& problem) {
    return {"", problem.what()};
  }
}

py::dict run(const Loaded& loaded, const Folder& directory, bool resume, unsigned threads,
             const std::optional<std::uint64_t>& seed, const std::vector<std::string>& profiles,
             const std::optional<std::uint64_t>& bootstrap, const std::optional<std::uint64_t>& posterior,
             bool discrepancy, bool paired_starts, const py::object& progress, const py::object& certify) {
  const OneAtATime alone;
  Told told(progress);
  experiment::Experiment experiment = loaded.experiment;
  calibration::apply({seed, profiles, bootstrap, posterior, {}, paired_starts, discrepancy}, *loaded.catalogue,
                     experiment);
  calibration::Options options;
  if (directory) options.directory = *directory;
  options.resume = resume;
  options.threads = threads;
  options.refusals = loaded.refusals;
  options.told = told.function();
  if (options.told)
    options.concluding = [&options](const std::string& what) { options.told(1, "after the searches: " + what); };
  options.noticed = [](const std::string& sentence) {
    const py::gil_scoped_acquire held;
    py::module_::import("warnings").attr("warn")(sentence);
  };
  if (!certify.is_none())
    options.certify = [&certify](const std::filesystem::path& folder, const std::filesystem::path& points) {
      return ask(certify, folder, points);
    };
  calibration::Outcome outcome;
  {
    const py::gil_scoped_release free;
    outcome = calibration::calibrate(experiment, *loaded.catalogue, options);
  }
  told.finish();
  using Ending = calibration::Outcome::Ending;
  py::dict found;
  found["directory"] = outcome.directory.string();
  found["ending"] = outcome.ending == Ending::finished      ? "finished"
                    : outcome.ending == Ending::interrupted ? "interrupted"
                                                            : "write_failure";
  found["write_failure"] = outcome.write_failure;
  found["sound"] = outcome.ending == Ending::finished && outcome.sound();
  return found;
}

std::string check(const Loaded& loaded, bool run_programs) {
  const py::gil_scoped_release free;
  const auto experiment = run_programs ? loaded.experiment : calibration::offline(loaded.experiment);
  const auto checked = calibration::examine(experiment, *loaded.catalogue, run_programs);
  return calibration::examination_json(checked).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

py::dict simulate(const Loaded& loaded, const std::string& model, const Folder& parameters, const std::string& run,
                  double noise, const std::optional<std::uint64_t>& seed, const std::vector<std::string>& fields,
                  const Folder& directory) {
  comparison::SimulationRequest request;
  request.model = model;
  if (parameters) request.parameters = *parameters;
  request.run = run;
  request.noise = noise;
  request.seed = seed.value_or(loaded.experiment.seed);
  comparison::Simulation simulation;
  comparison::Subject subject;
  py::dict found;
  {
    const py::gil_scoped_release free;
    subject = comparison::subject_of(loaded.experiment, *loaded.catalogue, request);
    simulation = comparison::simulate_with_fields(loaded.experiment, *loaded.catalogue, request, subject, fields);
    if (directory) {
      const auto folder = execution::RunDirectory::create(std::filesystem::path(*directory), loaded.experiment.name);
      execution::NewResults results(folder);
      comparison::write_simulation(folder.path(), loaded.experiment, request, subject, simulation);
      results.complete();
      report::write_report(folder.path());
    }
  }
  py::dict tables;
  for (const auto& table : simulation.tables) {
    py::dict columns;
    for (std::size_t k = 0; k < table.headers.size(); ++k)
      columns[table.headers[k].c_str()] = array_of(table.columns[k]);
    tables[table.test.c_str()] = columns;
  }
  py::dict values;
  const auto& free = subject.assembly->layout().parameters;
  for (std::size_t j = 0; j < free.size(); ++j) values[free[j].name.c_str()] = subject.free[j];
  for (const auto& fixed : subject.assembly->layout().fixed_parameters) values[fixed.name.c_str()] = fixed.value;
  found["model"] = subject.model;
  found["tables"] = tables;
  found["parameters"] = values;
  found["warnings"] = subject.warnings;
  return found;
}

diagnosis::Request request_of(const Loaded& loaded, const std::optional<std::uint64_t>& seed,
                              const std::optional<double>& alpha, const std::vector<std::string>& mechanisms,
                              bool quick) {
  diagnosis::Request request = diagnosis::request_of(loaded.experiment);
  if (seed) request.seed = *seed;
  if (alpha) request.alpha = *alpha;
  request.quick = quick;
  std::vector<std::string> known;
  for (const auto& [id, entry] : loaded.catalogue->mechanisms()) known.push_back(id);
  for (const std::string& id : mechanisms)
    if (!loaded.catalogue->mechanisms().contains(id))
      throw InputError(
          fmt::format("mechanisms: no loaded plugin provides the mechanism '{}'. {}", id, data::suggestion(id, known)));
  if (!mechanisms.empty()) request.mechanisms = mechanisms;
  return request;
}

/// Ends a diagnosis between two of its steps.
struct Stopped {};

/// A new folder, which is taken away again unless something was written to it.
class NewFolder {
 public:
  NewFolder(const Folder& requested, const std::string& name)
      : results_were_there_(requested || std::filesystem::exists("results")),
        folder_(execution::RunDirectory::create(
            requested ? std::optional<std::filesystem::path>(*requested) : std::nullopt, name)) {}
  ~NewFolder() {
    std::error_code full;
    std::filesystem::remove(path(), full);
    if (!results_were_there_) std::filesystem::remove(path().parent_path(), full);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }

 private:
  bool results_were_there_;
  execution::RunDirectory folder_;
};

/// Searches and writes unless interrupted: `search` receives a listener, and returns a writer.
template <class Search>
py::dict searched(const Loaded& loaded, const Folder& directory, unsigned threads, const py::object& progress,
                  const Search& search) {
  const OneAtATime alone;
  Told told(progress);
  const auto catalogue = interruptible(*loaded.catalogue);
  const auto listener = told.function();
  const NewFolder folder(directory, loaded.experiment.name);
  const execution::InterruptWatch watch;
  py::dict outcome;
  outcome["directory"] = folder.path().string();
  outcome["ending"] = "finished";
  try {
    const py::gil_scoped_release free;
    const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, threads);
    search(catalogue, folder.path(), [&](const std::string& stage, double share) {
      if (listener) listener(share, stage);
      if (execution::InterruptWatch::interrupted()) throw Stopped{};
    });
    report::write_report(folder.path());
  } catch (...) {
    if (!execution::InterruptWatch::interrupted()) throw;  // what failed because of Ctrl-C is no failure
    outcome["ending"] = "interrupted";
  }
  told.finish();
  return outcome;
}

py::dict diagnose(const Loaded& loaded, const Folder& directory, unsigned threads,
                  const std::optional<std::uint64_t>& seed, const std::optional<double>& alpha,
                  const std::vector<std::string>& mechanisms, bool quick, const py::object& progress) {
  const auto request = request_of(loaded, seed, alpha, mechanisms, quick);
  return searched(
      loaded, directory, threads, progress,
      [&](const plugins::Catalogue& catalogue, const std::filesystem::path& folder, const diagnosis::Progress& told) {
        const auto found = budget::diagnosed(loaded.experiment, request, catalogue, true, told);
        budget::write_diagnosis(folder, found, loaded.experiment, *loaded.catalogue);
      });
}

py::dict discover(const Loaded& loaded, const Folder& directory, unsigned threads, const py::dict& options,
                  const py::object& progress) {
  discovery::Wishes wishes;
  wishes.seed = options["seed"].cast<std::optional<std::uint64_t>>();
  wishes.alpha = options["alpha"].cast<std::optional<double>>();
  wishes.most_terms = options["most_terms"].cast<std::optional<std::size_t>>();
  wishes.most_parameters = options["most_parameters"].cast<std::optional<std::size_t>>();
  wishes.invariants = options["invariants"].cast<std::vector<std::string>>();
  wishes.laws = options["laws"].cast<std::vector<std::string>>();
  wishes.model = options["model"].cast<std::string>();
  wishes.from_nothing = options["from_nothing"].cast<bool>();
  wishes.quick = options["quick"].cast<bool>();
  const auto request = discovery::request_of(loaded.experiment, wishes, "");
  return searched(
      loaded, directory, threads, progress,
      [&](const plugins::Catalogue& catalogue, const std::filesystem::path& folder, const diagnosis::Progress& told) {
        const auto found = budget::discover(loaded.experiment, request, catalogue, told);
        discovery::write_discovery(folder, found, loaded.experiment, *loaded.catalogue);
      });
}

/// What `tunica export` prints.
std::string export_card(const Library& library, const std::string& result, const std::string& target,
                        const std::string& run, const std::string& model, const std::string& units,
                        const std::string& name, const std::optional<double>& bulk_ratio, const std::string& density,
                        const std::string& subroutine) {
  const auto fitted = exporting::fitted_material({result, run, model}, *library.catalogue());
  if (!subroutine.empty() && std::filesystem::exists(subroutine))
    throw InputError(fmt::format("subroutine '{}': is there already; name a new file", subroutine));
  std::optional<double> mass;
  if (!density.empty()) mass = cards::density_of(density);
  std::string card = cards::write_card(cards::target_of(target), fitted.material,
                                       {.name = name.empty() ? cards::card_name(fitted.name) : name,
                                        .units = cards::unit_system(units),
                                        .bulk_ratio = bulk_ratio,
                                        .density = mass,
                                        .subroutine = !subroutine.empty(),
                                        .remarks = fitted.remarks});
  if (!subroutine.empty()) execution::write_atomically(subroutine, cards::uanisohyper_inv());
  return card;
}

/// Texts of the command line: single ones under the names of options, and lists.
py::dict import_files(const Library& library, const std::map<std::string, std::string>& texts,
                      const std::map<std::string, std::vector<std::string>>& lists, bool join, bool together) {
  imports::ImportRequest request;
  auto& answers = request.answers;
  const std::map<std::string, std::string*> places = {{"test", &answers.test},
                                                      {"model", &answers.model},
                                                      {"width", &answers.width},
                                                      {"thickness", &answers.thickness},
                                                      {"height", &answers.height},
                                                      {"gauge_length", &answers.gauge_length},
                                                      {"area", &answers.area},
                                                      {"diameter", &answers.diameter},
                                                      {"strain_measure", &answers.strain_measure},
                                                      {"stress_measure", &answers.stress_measure},
                                                      {"cycle", &answers.cycle},
                                                      {"branch", &answers.branch},
                                                      {"preload", &answers.preload},
                                                      {"each", &answers.each},
                                                      {"delimiter", &answers.delimiter},
                                                      {"decimal", &answers.decimal},
                                                      {"skip_lines", &answers.skip_lines},
                                                      {"rows", &answers.rows},
                                                      {"specimens", &request.table},
                                                      {"output", &request.output}};
  for (const auto& [name, text] : texts) *places.at(name) = text;
  const std::map<std::string, std::vector<std::string>*> several = {
      {"files", &request.files},    {"columns", &request.columns},      {"units", &request.units},
      {"where", &request.where},    {"direction", &request.directions}, {"compression", &request.compressions},
      {"options", &request.options}};
  for (const auto& [name, list] : lists) *several.at(name) = list;
  request.join = join;
  answers.together = together;
  const auto catalogue = library.catalogue();
  imports::Imported imported;
  {
    const py::gil_scoped_release free;
    imported = imports::import_files(std::move(request), *catalogue, {});
  }
  py::dict found;
  found["file"] = imported.file.string();
  found["notes"] = imported.notes;
  found["understood"] = imported.understood;
  found["warnings"] = imported.warnings;
  found["in_order"] = imported.in_order;
  return found;
}

/// What `tunica certify FOLDER --best-points POINTS` prints.
std::string certify(const Library& library, const std::string& folder, const std::string& points) {
  const auto loaded = library.read((std::filesystem::path(folder) / "input.json").string());
  const py::gil_scoped_release free;
  const auto plan = execution::make_plan(loaded->experiment, *loaded->catalogue);
  return comparison::certify(plan, execution::read_text(points), nullptr, loaded->catalogue.get());
}

}  // namespace

void add_verbs(py::module_& module) {
  module.def("run", &run);
  module.def("check", &check);
  module.def("simulate", &simulate);
  module.def("diagnose", &diagnose);
  module.def("discover", &discover);
  module.def("certify", &certify);
  module.def("import_files", &import_files);
  module.def("export_card", &export_card);
  module.def("check_levels", [](const std::string& text) {
    if (detail::excess_of_levels(text) != std::string::npos)
      throw InputError(fmt::format("more than {} levels of nesting", detail::deepest_json));
  });
  module.def("write_report", [](const std::string& folder) { return report::write_report(folder).string(); });
}

}  // namespace tunica::python
