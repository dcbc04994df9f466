// SPDX-License-Identifier: Apache-2.0
#include "budget/discover.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <unistd.h>

#include "answer.hpp"
#include "batch.hpp"
#include "calibration/examination.hpp"
#include "cohort/discovery_folder.hpp"
#include "cohort/discovery_study.hpp"
#include "data/read_bytes.hpp"
#include "diagnosis/evidence/base_fit.hpp"
#include "discovery/output/folder.hpp"
#include "discovery/output/outputs.hpp"
#include "discovery/wishes.hpp"
#include "execution/files.hpp"
#include "execution/interrupt.hpp"
#include "execution/run_directory.hpp"
#include "exit_codes.hpp"
#include "finite_range.hpp"
#include "messages.hpp"
#include "report/report.hpp"
#include "stages.hpp"
#include "supervisor.hpp"
#include "text/terminal.hpp"
#include "text/wrapping.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "unfinished_results.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct DiscoverOptions {
  std::string file, directory, share;
  unsigned threads = static_cast<unsigned>(tbb::info::default_concurrency());
  discovery::Wishes wishes;
  bool batch = false;
};

std::string discovery_interrupted() {
  return fmt::format(
      "{}interrupted; an unfinished discovery leaves nothing behind. Start it again with the same "
      "command\n",
      text::Terminal::of(STDERR_FILENO).redraws ? "\r\033[K" : "");
}

/// The folder for results, and the parts of its path that were created for them.
struct Output {
  std::vector<std::filesystem::path> made;
  execution::RunDirectory directory;

  Output(const std::filesystem::path& requested, const std::string& name)
      : made(to_be_made(requested)),
        directory(execution::RunDirectory::create(requested.empty() ? std::nullopt : std::optional(requested), name)) {
    if (requested.empty()) made.insert(made.begin(), directory.path());
  }

 private:
  static std::vector<std::filesystem::path> to_be_made(const std::filesystem::path& requested) {
    const std::filesystem::path first = requested.empty() ? "results" : requested;
    if (std::filesystem::exists(first)) return {};
    return {first};
  }
};

void tell(const std::vector<diagnosis::Warning>& warnings) {
  for (const diagnosis::Warning& warning : warnings) answer("{}\n", text::hanging("warning: ", warning.text));
  if (!warnings.empty()) answer("\n");
}

int discover(const GlobalOptions& global, const DiscoverOptions& options) {
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  const Session session(global);
  const auto experiment = session.read(options.file);
  const auto request = request_of(experiment, options.wishes);
  Output output(options.directory, experiment.name);
  discovery::Discovery found;
  try {
    supervised::unfinished(output.made, output.directory.path());
    UnfinishedResults folder(output.made, discovery_interrupted());
    Stages stages(global.quiet);
    found = budget::discover(experiment, request, session.catalogue(),
                             [&stages](const std::string& what, double share) { stages.tell(what, share); });
    folder.keep();
  } catch (const diagnosis::BaseFitFailure& problem) {
    say_error(fmt::format("{}. Run `{}`, which evaluates the initial point and shows what fails", problem.what(),
                          calibration::check_command(experiment, options.file)));
    return not_converged;
  }
  const execution::InterruptWatch watch;  // writing takes a moment, and is not left half done
  execution::NewResults results(output.directory);
  const bool extended = discovery::write_discovery(output.directory.path(), found, experiment, session.catalogue());
  results.complete();
  tell(found.warnings);
  const auto page = report::write_report(output.directory.path());
  answer("{}\nReport:   {}\nResults:  {}\n", discovery::summary(found).shown_on(answer_descriptor()), page.string(),
         (output.directory.path() / "result.json").string());
  if (extended) answer("Try:      tunica run {}\n", (output.directory.path() / "extended.json").string());
  return done;
}

/// Whether the file describes a cohort: it names specimens and the experiment of each.
bool is_cohort(const std::string& file) {
  const auto json = tunica::detail::parse_json(data::read_bytes(file), false, true);
  return json.is_object() && json.contains("specimens") && json.contains("experiment");
}

/// The terms that all specimens of a cohort have in common.
int discover_cohort(const GlobalOptions& global, const DiscoverOptions& options) {
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  const Session session(global);
  const cohort::Specification specification = cohort::read_specification(options.file);
  const cohort::SpecimenTable table = cohort::read_specimens(specification);
  const cohort::Template pattern(specification, table);
  const bool quick = !specification.diagnosis || specification.diagnosis->quick;
  const auto asked = [&](const experiment::Experiment& experiment) {
    discovery::Request request = request_of(experiment, options.wishes);
    request.quick = request.quick || quick;  // the others make up for what a quick one does not see
    if (!options.wishes.seed) request.seed = specification.seed;
    return request;
  };
  Output output(options.directory, specification.name);
  std::optional<cohort::DiscoveryStudy> study;
  {
    supervised::unfinished(output.made, output.directory.path());
    UnfinishedResults folder(output.made, discovery_interrupted());
    Stages stages(global.quiet);
    study = cohort::study_discovery(specification, table, pattern, session.catalogue(), asked,
                                    [&stages](const std::string& what, double share) { stages.tell(what, share); });
    folder.keep();
  }
  const execution::InterruptWatch watch;  // writing takes a moment, and is not left half done
  const std::filesystem::path& folder = output.directory.path();
  execution::NewResults results(output.directory);
  cohort::write_discovery(folder, *study, specification, table, session.catalogue());
  results.complete();
  tell(study->found.warnings);
  const auto page = report::write_report(folder);
  answer("{}\nReport:   {}\nResults:  {}\n", cohort::discovery_words(*study).shown_on(answer_descriptor()),
         page.string(), (folder / "terms.csv").string());
  if (!study->extended.empty()) answer("Try:      tunica cohort {}\n", (folder / "extended_cohort.json").string());
  return done;
}

int discover_batch(const GlobalOptions& global, const DiscoverOptions& options) {
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  const Session session(global);
  return run_batch({options.file, options.directory, options.share, "discoveries", global.quiet},
                   [&](const std::filesystem::path& of_case, const std::filesystem::path& results) {
                     const auto experiment = session.read(of_case / "experiment.json");
                     const auto found =
                         budget::discover(experiment, request_of(experiment, options.wishes), session.catalogue());
                     execution::make_folder(results);
                     discovery::write_discovery(results, found, experiment, session.catalogue());
                   });
}

}  // namespace

void add_discover(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<DiscoverOptions>();
  auto* verb = app.add_subcommand("discover", "Find the terms that the energy lacks, or is made of");
  verb->add_option("experiment", options->file, "Experiment or cohort file (JSON)")->required()->type_name("EXP");
  verb->add_option("-o,--output", options->directory, "New folder for the results; results/<name>-<n> without it")
      ->type_name("DIR");
  verb->add_option("--model", options->wishes.model, "The base, instead of the file's")->type_name("NAME");
  verb->add_flag("--from-nothing", options->wishes.from_nothing, "The terms make up the whole energy; no base is kept");
  verb->add_option("--invariants", options->wishes.invariants,
                   "Only functions of these, separated by commas: I1,I2,stretches,'fibre axial'")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("INVARIANTS");
  verb->add_option("--laws", options->wishes.laws, "Only these laws, separated by commas")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("LAWS");
  verb->add_option("--most-terms", options->wishes.most_terms, "The most terms; 3 without it, from nothing 4")
      ->check(CLI::Range(1, 6))
      ->type_name("N");
  verb->add_option("--most-parameters", options->wishes.most_parameters,
                   "The most parameters of the terms together; as many as it takes without it")
      ->check(CLI::Range(1, 20))
      ->type_name("N");
  verb->add_option("-j,--threads", options->threads, "Threads; all of the machine without it")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  verb->add_option("--seed", options->wishes.seed, "Root seed instead of the one in the file")
      ->check(seed_number())
      ->type_name("S");
  verb->add_option("--alpha", options->wishes.alpha, "Share of false alarms that is accepted, instead of the file's")
      ->check(FiniteRange(0.0001, 0.5))
      ->type_name("A");
  verb->add_flag("--quick", options->wishes.quick, "The alarm from linear draws only: a second instead of several");
  auto* batch =
      verb->add_flag("--batch", options->batch,
                     "EXP is a folder of folders with an experiment.json each; those with a result.json are skipped");
  verb->add_option("--shard", options->share, "With --batch: only part k of N of the folders, as 2/7")
      ->needs(batch)
      ->type_name("k/N");
  verb->add_flag("--quiet", global.quiet, "Nothing on stderr but errors");
  verb->footer(
      "Examples:\n"
      "  tunica discover experiment.json\n"
      "  tunica discover experiment.json --from-nothing -o results/a\n"
      "  tunica discover experiment.json --invariants I1,I2 --most-terms 2\n"
      "  tunica discover cohort.json -o results/tissue\n"
      "  tunica discover --batch --quick cases/\n\n"
      "Writes report.html, result.json, extended.json (the experiment with the terms: `tunica run` takes it),\n"
      "residuals.csv and input.json. Of a cohort the terms are common to all specimens, their parameters each\n"
      "specimen's own: terms.csv, extended_cohort.json. Exit code 0 whatever the verdict.");
  verb->callback([&global, &action, options] {
    action = [&global, options] {
      if (options->batch) return discover_batch(global, *options);
      return is_cohort(options->file) ? discover_cohort(global, *options) : discover(global, *options);
    };
  });
}

}  // namespace tunica::app
