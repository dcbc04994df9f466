// SPDX-License-Identifier: Apache-2.0
#include "calibration/examination.hpp"

#include <algorithm>
#include <chrono>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibration/timing.hpp"
#include "comparison/ranking.hpp"
#include "comparison/uncertainty.hpp"
#include "execution/memory_need.hpp"
#include "plugins/guarded.hpp"
#include "text/escaped.hpp"
#include "text/shell.hpp"
#include "uncertainty/identifiability.hpp"

namespace tunica::calibration {

namespace {

using Clock = std::chrono::steady_clock;

/// Median time of one evaluation, s.
double time_evaluation(const assembly::Assembly& assembly, const std::vector<double>& free, std::size_t tests) {
  auto workspace = assembly.evaluator().make_workspace();
  std::vector<double> per_test(tests);
  double objective = 0;
  return median_time(
      [&] { static_cast<void>(assembly.evaluator().evaluate(free, objective, per_test, {}, {}, *workspace)); },
      [] { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); });
}

/// Whether a test starts a program that the file names.
bool starts_program(const experiment::TestEntry& test) { return test.options.has("command"); }

/// Whether a test asks a server at an address that the file names.
bool asks_server(const experiment::TestEntry& test) { return test.options.has("offline") && test.options.has("url"); }

/// The programs that the tests of a run start, and the servers that they ask, in words; empty = none.
std::string programs_of(const experiment::Experiment& experiment, const execution::PlannedRun& run) {
  std::string words;
  for (const std::string& name : run.entry->tests) {
    const experiment::TestEntry& test = experiment.test(name);
    if (asks_server(test))
      words += fmt::format("{}test '{}' asks the server at {}", words.empty() ? "" : "; ", name,
                           text::excerpt(test.options.text("url"), 300));
    if (!starts_program(test)) continue;
    const auto command = nlohmann::json::parse(test.options.text("command"), nullptr, false);
    std::string line;
    if (command.is_array())
      for (const auto& word : command)
        line += (line.empty() ? "" : " ") + (word.is_string() ? word.get<std::string>() : word.dump());
    words += fmt::format("{}test '{}' runs: {}", words.empty() ? "" : "; ", name, text::excerpt(line, 300));
  }
  return words;
}

InitialPoint try_initial_point(const execution::PlannedRun& run) {
  const auto& assembly = *run.assembly;
  const auto& tests = run.entry->tests;
  InitialPoint point;
  std::vector<double> free;
  for (const auto& parameter : assembly.layout().parameters) free.push_back(parameter.initial);
  point.per_test.resize(tests.size());
  auto workspace = assembly.evaluator().make_workspace();
  const auto begun = Clock::now();
  point.status = assembly.evaluator().evaluate(free, point.objective, point.per_test, {}, {}, *workspace);
  point.seconds = std::chrono::duration<double>(Clock::now() - begun).count();
  if (point.status.kind() == Status::Kind::failed) return point;
  if (!assembly.layout().has_costly_tests) point.seconds = time_evaluation(assembly, free, tests.size());
  for (std::size_t test = 0; test < tests.size(); ++test) {
    OtherMeans other{tests[test]};
    other.status = assembly.evaluator().ask(
        test, free, [&](const Test& asked, const TestInput& input) { return asked.agreement(input, other.found); });
    if (!other.found.empty() || !other.status.ok()) point.other_means.push_back(std::move(other));
  }
  uncertainty::Identifiability found;
  point.analysed = uncertainty::identify(assembly, free, found, false).ok();
  if (point.analysed) point.sentences = found.sentences();
  return point;
}

std::vector<TestPath> paths_of(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue) {
  constexpr std::size_t drawing_columns = 60;
  std::vector<TestPath> paths;
  for (const auto& test : experiment.tests) {
    const auto& observables = catalogue.tests().find(test.type)->second.factory.observables;
    const data::Dataset dataset = data::read_dataset(test.data, observables);
    if (dataset.abscissae.empty()) continue;
    const auto& path = dataset.abscissae.front().second;
    if (!dataset.ordered && data::turning_points(path).size() < 3) continue;
    paths.push_back({test.name, dataset.ordered, data::past_of(dataset, observables),
                     data::path_words(dataset, observables), data::path_drawing(path, drawing_columns)});
  }
  return paths;
}

/// The interpretation of the files of testing machines.
std::vector<UnderstoodData> understood_of(const experiment::Experiment& experiment,
                                          const plugins::Catalogue& catalogue) {
  std::vector<UnderstoodData> found;
  for (const auto& test : experiment.tests) {
    const auto& observables = catalogue.tests().find(test.type)->second.factory.observables;
    if (auto lines = data::read_dataset(test.data, observables).understood; !lines.empty())
      found.push_back({test.name, std::move(lines)});
  }
  return found;
}

}  // namespace

bool agrees(const Agreement& one) { return one.difference <= one.expected; }

bool InitialPoint::good() const {
  if (status.kind() == Status::Kind::failed) return false;
  return std::all_of(other_means.begin(), other_means.end(), [](const OtherMeans& other) {
    return std::all_of(other.found.begin(), other.found.end(), agrees);
  });
}

bool Examination::good() const {
  return std::all_of(problems.begin(), problems.end(), [](const auto& problem) { return problem.initial.good(); });
}

Examination examine(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue, bool run_programs,
                    const std::function<void(const std::string&)>& told) {
  Examination found{experiment,
                    execution::make_plan(experiment, catalogue),
                    {},
                    {},
                    {},
                    paths_of(experiment, catalogue),
                    understood_of(experiment, catalogue)};
  execution::refuse_excess(execution::memory_need(found.plan, 1), execution::memory_limit());
  comparison::check_analysis(found.plan, catalogue);
  auto& warnings = found.warnings;
  warnings = found.plan.warnings;
  for (const auto& entry : experiment.models) {
    const auto model = plugins::create(catalogue.models().find(entry.type)->second, entry.options);
    if (const std::string& formula = model->describe().formula; !formula.empty())
      found.notes.push_back(fmt::format("model {}: {}", entry.name, formula));
  }
  std::set<std::string> posed;
  for (const auto& run : found.plan.runs) {
    const auto add = [&](execution::Warning added) {
      const auto same = [&](const auto& warning) { return warning.sentence == added.sentence; };
      if (std::none_of(warnings.begin(), warnings.end(), same)) warnings.push_back(std::move(added));
    };
    for (const auto& finding : run.assembly->layout().findings) add(execution::warning_of(finding));
    for (const auto& sentence : run.assembly->layout().warnings) add({execution::WarningKind::set_up, sentence});
    for (const auto& note : run.assembly->layout().notes)
      if (std::find(found.notes.begin(), found.notes.end(), note) == found.notes.end()) found.notes.push_back(note);
    std::string problem =
        fmt::format("model {}, {}", experiment.model_name(*run.entry), comparison::group_of(*run.entry));
    for (const auto& constraint : run.entry->constraints) problem += ", " + constraint.json;
    if (!posed.insert(problem).second) continue;
    const std::string programs = run_programs ? "" : programs_of(experiment, run);
    if (told && programs.empty() && run.assembly->layout().has_costly_tests)
      told(fmt::format("{}: simulating its tests at the initial point, and once more for each derivative", problem));
    found.problems.push_back({problem, &run, programs.empty() ? try_initial_point(run) : InitialPoint{}});
    found.problems.back().initial.not_run = programs;
  }
  return found;
}

experiment::Experiment offline(experiment::Experiment experiment) {
  for (experiment::TestEntry& test : experiment.tests)
    if (asks_server(test)) test.options.set("offline", true);
  return experiment;
}

std::string check_command(const experiment::Experiment& experiment, const std::string& file) {
  const bool starts = std::any_of(experiment.tests.begin(), experiment.tests.end(),
                                  [](const auto& test) { return starts_program(test) || asks_server(test); });
  std::vector<std::string> words{"tunica", "check", file};
  if (starts) words.emplace_back("--run-external");
  return text::quoted(words);
}

}  // namespace tunica::calibration
