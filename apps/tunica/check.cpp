// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "answer.hpp"
#include "calibration/examination_json.hpp"
#include "data/loading_path.hpp"
#include "data/nearest.hpp"
#include "data/signal.hpp"
#include "execution/files.hpp"
#include "exit_codes.hpp"
#include "plugins/description.hpp"
#include "report/data_page.hpp"
#include "text/aside.hpp"
#include "text/lists.hpp"
#include "text/styled.hpp"
#include "text/units.hpp"
#include "text/wrapping.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

using text::columns;
using text::counted;
using text::hanging;
using text::pad;

/// "Cauchy stress": the measure as which a column of stress was read; empty for other channels.
std::string measure_of(const experiment::Experiment& experiment, const assembly::MeasuredChannel& channel) {
  if (channel.observable != "stress") return "";
  const auto test = std::find_if(experiment.tests.begin(), experiment.tests.end(),
                                 [&](const auto& entry) { return entry.name == channel.test; });
  if (test == experiment.tests.end()) return "";
  const std::string& measure = test->data.stress_measure;
  return measure == "cauchy"                  ? " Cauchy stress"
         : measure == "first_piola_kirchhoff" ? " nominal stress (first Piola-Kirchhoff)"
                                              : " second Piola-Kirchhoff stress";
}

void print_tests(const experiment::Experiment& experiment, const assembly::Assembly& assembly) {
  for (const auto& channel : assembly.layout().channels) {
    std::vector<double> values = channel.measured;
    std::erase_if(values, [](double value) { return std::isnan(value); });
    const auto [first, last] = std::minmax_element(channel.abscissa.begin(), channel.abscissa.end());
    const std::string over = channel.count == 0 ? ""
                                                : fmt::format(" over {} {:.4g} … {:.4g}{}", channel.abscissa_name,
                                                              *first, *last, text::unit_suffix(channel.abscissa_unit));
    std::string text = fmt::format("{} rows", channel.count);
    if (values.empty()) {
      answer("{}\n", hanging(fmt::format("  {}, {}: ", channel.test, channel.observable),
                             text + over + ", nothing measured: predicted only"));
      continue;
    }
    if (channel.held_out_rows() > 0) text += fmt::format(" ({} held out)", channel.held_out_rows());
    if (values.size() < channel.count) text += fmt::format(" ({} without a value)", channel.count - values.size());
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    text += fmt::format(", {:.4g} … {:.4g}{}{}", *low, *high, text::unit_suffix(channel.unit),
                        measure_of(experiment, channel) + over);
    text += fmt::format(", weight {:g}", channel.weight);
    text += channel.noise ? fmt::format(", noise {:g} + {:g} y", channel.noise->absolute, channel.noise->relative)
                          : std::string(", noise estimated");
    answer("{}\n", hanging(fmt::format("  {}, {}: ", channel.test, channel.observable), text));
  }
}

void print_parameters(const assembly::Assembly& assembly) {
  std::size_t width = 9;
  for (const auto& parameter : assembly.layout().parameters) width = std::max(width, columns(parameter.name));
  for (const auto& parameter : assembly.layout().fixed_parameters) width = std::max(width, columns(parameter.name));
  constexpr std::size_t widest = 28;  // so that a line has 80 columns; longer names stand above it
  width = std::min(width, widest);
  const auto cell = [width](const std::string& name) {
    return columns(name) <= width ? pad(name, width) : fmt::format("{}\n  {}", name, std::string(width, ' '));
  };
  answer("  {}  {:<6} {:>10} {:>10} {:>10}  scale\n", pad("parameter", width), "unit", "initial", "min", "max");
  for (const auto& parameter : assembly.layout().parameters)
    answer("  {}  {:<6} {:>10.5g} {:>10.5g} {:>10.5g}  {}{}\n", cell(parameter.name), parameter.unit, parameter.initial,
           parameter.min, parameter.max, parameter.scale == Scale::log ? "log" : "linear",
           parameter.prior ? fmt::format(", prior {:g} ± {:g}", parameter.prior->mean, parameter.prior->sd) : "");
  for (const auto& parameter : assembly.layout().fixed_parameters)
    answer("  {}  {:<6} {:>10.5g}  fixed\n", cell(parameter.name), parameter.unit, parameter.value);
}

std::string duration_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.3g} µs", 1e6 * seconds);
  if (seconds < 1) return fmt::format("{:.3g} ms", 1e3 * seconds);
  return seconds < 3600 ? fmt::format("{:.3g} s", seconds) : fmt::format("{:.3g} h", seconds / 3600);
}

/// The time that the budget of a run may take, if it is more than an hour.
void print_cost(const calibration::PosedProblem& problem) {
  const auto& entry = *problem.run->entry;
  const auto evaluations = entry.stop.max_evaluations * entry.realisations;
  const double most = problem.initial.seconds * static_cast<double>(evaluations);
  if (problem.run->assembly->layout().has_costly_tests && most > 3600)
    answer("{}\n", hanging("  ", fmt::format("the {} evaluations that a run may take last up to {} one after the "
                                             "other; for fewer, set \"max_evaluations\" in \"stop\" and \"starts\" "
                                             "of its optimiser",
                                             evaluations, duration_text(most))));
}

/// Comparisons of the tests with independent solutions.
void print_agreement(const calibration::OtherMeans& other) {
  for (const auto& one : other.found)
    answer("{}\n",
           hanging(fmt::format("  {} against ", other.test),
                   fmt::format("{}: differs by {:.2g}{}{}", one.with, one.difference, text::unit_suffix(one.unit),
                               calibration::agrees(one) ? ""
                                                        : fmt::format("; at most {:.2g} was expected. Take a "
                                                                      "finer mesh, or do not trust this simulation",
                                                                      one.expected))));
  if (!other.status.ok())
    answer("{}\n",
           hanging(fmt::format("  {}: ", other.test), "could not be checked by other means: " + other.status.reason()));
}

/// The paths that mechanisms with memory would take the rows for.
void print_paths(const std::vector<calibration::TestPath>& paths) {
  if (paths.empty()) return;
  answer("\npaths of loading, row after row\n");
  for (const auto& path : paths)
    answer("{}\n    {}\n",
           hanging(fmt::format("  {}: ", path.test),
                   path.words + (path.ordered ? "" : "; nobody says that this is the order")),
           path.drawing);
}

void print_initial_point(const calibration::PosedProblem& problem) {
  const auto& assembly = *problem.run->assembly;
  const auto& tests = problem.run->entry->tests;
  const auto& initial = problem.initial;
  if (!initial.not_run.empty()) {
    answer("{}\n", hanging("  the initial point is not evaluated: ",
                           initial.not_run + ". --run-external does so, as `tunica run` does"));
    return;
  }
  if (initial.status.kind() == Status::Kind::failed) {
    answer("{}\n", hanging("  the initial point cannot be evaluated: ", initial.status.reason()));
    return;
  }
  std::string text = fmt::format("objective {:.6g}", initial.objective);
  if (tests.size() > 1)
    for (std::size_t test = 0; test < tests.size(); ++test)
      text += fmt::format("{} {} {:.4g}", test == 0 ? " =" : " +", tests[test], initial.per_test[test]);
  answer("{}\n  one evaluation takes {}; derivatives are {}\n", hanging("  at the initial point: ", text),
         duration_text(initial.seconds), assembly.layout().jacobian_is_exact ? "exact" : "differenced");
  print_cost(problem);
  if (assembly.constraints().count() > 0)
    answer("{}\n",
           hanging(fmt::format("  {}: ", counted(assembly.constraints().count(), "constraint", "constraints")),
                   initial.status.ok() ? "kept at the initial point"
                                       : "broken at the initial point, which is no harm: " + initial.status.reason()));
  for (const auto& other : initial.other_means) print_agreement(other);
  const auto& parameters = assembly.layout().parameters;
  const bool chosen =
      std::any_of(parameters.begin(), parameters.end(), [](const auto& one) { return one.own_initial; });
  if (!chosen && !initial.sentences.empty())
    answer("{}\n", hanging("  set-up: ",
                           "the initial values are defaults, so that they say nothing of these data; `tunica "
                           "run` says what the data fix at the best point"));
  for (const auto& sentence : initial.sentences)
    if (chosen) answer("{}\n", hanging("  set-up, at the initial point: ", sentence));
  if (initial.analysed && initial.sentences.empty())
    answer("  set-up: the data fix every parameter at the initial point\n");
}

std::string but_for(std::size_t warnings) {
  return warnings == 0 ? "" : fmt::format(", but for the {} above", counted(warnings, "warning", "warnings"));
}

void print(const calibration::Examination& checked, const std::string& file) {
  const auto& [experiment, plan, warnings, notes, problems, paths, understood] = checked;
  answer("{}: {}, {}, {}, seed {}\n", data::excerpt(experiment.name),
         counted(experiment.models.size(), "model", "models"), counted(experiment.tests.size(), "test", "tests"),
         counted(experiment.runs.size(), "run", "runs"), experiment.seed);
  for (const auto& warning : warnings) answer("{}", text::caution_line(warning.text()).shown_on(answer_descriptor()));
  for (const auto& note : notes) answer("{}\n", hanging("  ", note));
  answer("\n");
  for (const auto& run : plan.runs)
    answer("{}: {} of at most {} evaluations\n", run.label,
           counted(run.entry->realisations, "realisation", "realisations"), run.entry->stop.max_evaluations);
  for (const auto& [test, lines] : understood) {
    answer("\n{}, as its file was understood\n", test);
    for (const auto& line : lines) answer("{}\n", hanging("  ", line));
  }
  print_paths(paths);
  for (const auto& problem : problems) {
    answer("\n{}\n", hanging("", problem.title));
    print_tests(experiment, *problem.run->assembly);
    print_parameters(*problem.run->assembly);
    print_initial_point(problem);
  }
  answer("\n{}\n",
         checked.good() && experiment.only_predicts
             ? fmt::format("In order{}. `tunica simulate` and `tunica stability` read it as it is; to fit, add "
                           "\"optimizers\" and \"runs\"",
                           but_for(warnings.size()))
         : checked.good() ? fmt::format("In order{}. Next: tunica run {}", but_for(warnings.size()), file)
                          : std::string("Not in order: see above. `tunica run` would still start."));
}

/// The data as they were understood, as one HTML file.
void write_data_page(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                     const std::filesystem::path& file) {
  std::vector<report::TestData> tests;
  for (const auto& entry : experiment.tests) {
    const auto& observables = catalogue.tests().find(entry.type)->second.factory.observables;
    report::TestData test{
        entry.name, "", data::read_signals(entry.data, observables), data::read_dataset(entry.data, observables), {}};
    test.words = fmt::format("{}; {}", entry.type, data::path_words(test.dataset, observables));
    for (const auto& observable : observables) test.units.emplace_back(observable.name, observable.unit);
    tests.push_back(std::move(test));
  }
  execution::write_atomically(file, report::data_page(experiment.name, tests));
}

int check(const GlobalOptions& global, const std::string& file, bool as_json, const std::string& page,
          bool run_external) {
  const Session session(global);
  const auto read = session.read(file, experiment::Purpose::prediction);
  const auto experiment = run_external ? read : calibration::offline(read);
  if (!page.empty()) write_data_page(experiment, session.catalogue(), page);
  const auto checked =
      calibration::examine(experiment, session.catalogue(), run_external,
                           [](const std::string& words) { text::aside("{}\n", text::hanging("", words)); });
  if (as_json)
    print_json(calibration::examination_json(checked));
  else
    print(checked, file);
  return checked.good() ? done : not_converged;
}

}  // namespace

void add_check(CLI::App& app, GlobalOptions& global, Action& action) {
  auto file = std::make_shared<std::string>();
  auto as_json = std::make_shared<bool>(false);
  auto page = std::make_shared<std::string>();
  auto run_external = std::make_shared<bool>(false);
  auto* verb =
      app.add_subcommand("check", "Dry run: check names, units, data, bounds, the initial point and identifiability");
  verb->add_option("experiment", *file, "Experiment file (JSON)")->required()->type_name("EXP");
  verb->add_flag("--json", *as_json, "Print one JSON object; `in_order` says whether the exit code is 0");
  verb->add_option("--page", *page, "Write a page that draws the data as they were understood")->type_name("FILE");
  verb->add_flag("--run-external", *run_external,
                 "Run the programs, and ask the servers, that the file names; without it they are shown only");
  verb->footer(
      "Examples:\n  tunica check experiment.json\n  tunica check experiment.json --plugin-path my_plugins\n"
      "  tunica check experiment.json --json | jq '.problems[].initial.identifiability'\n"
      "  tunica check experiment.json --page data.html\n\nWrites nothing else.");
  verb->callback([&global, &action, file, as_json, page, run_external] {
    action = [&global, file, as_json, page, run_external] {
      return check(global, *file, *as_json, *page, *run_external);
    };
  });
}

}  // namespace tunica::app
