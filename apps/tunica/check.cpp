// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "check.hpp"
#include "comparison/ranking.hpp"
#include "comparison/uncertainty.hpp"
#include "data/nearest.hpp"
#include "describe.hpp"
#include "execution/plan.hpp"
#include "exit_codes.hpp"
#include "text/lists.hpp"
#include "text/styled.hpp"
#include "text/units.hpp"
#include "text/wrapping.hpp"
#include "uncertainty/identifiability.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

using text::columns;
using text::counted;
using text::hanging;
using text::pad;

void print_tests(const assembly::Assembly& assembly) {
  for (const auto& channel : assembly.layout().channels) {
    const auto held_out = std::count(channel.fitted.begin(), channel.fitted.end(), false);
    const auto [low, high] = std::minmax_element(channel.measured.begin(), channel.measured.end());
    const auto [first, last] = std::minmax_element(channel.abscissa.begin(), channel.abscissa.end());
    std::string text = fmt::format("{} rows", channel.count);
    if (held_out > 0) text += fmt::format(" ({} held out)", held_out);
    if (channel.count > 0)
      text += fmt::format(", {:.4g} … {:.4g}{} over {} {:.4g} … {:.4g}{}", *low, *high, text::unit_suffix(channel.unit),
                          channel.abscissa_name, *first, *last, text::unit_suffix(channel.abscissa_unit));
    text += fmt::format(", weight {:g}", channel.weight);
    text += channel.noise ? fmt::format(", noise {:g} + {:g} y", channel.noise->absolute, channel.noise->relative)
                          : std::string(", noise estimated");
    fmt::print("{}\n", hanging(fmt::format("  {}, {}: ", channel.test, channel.observable), text));
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
  fmt::print("  {}  {:<6} {:>10} {:>10} {:>10}  scale\n", pad("parameter", width), "unit", "initial", "min", "max");
  for (const auto& parameter : assembly.layout().parameters)
    fmt::print("  {}  {:<6} {:>10.5g} {:>10.5g} {:>10.5g}  {}{}\n", cell(parameter.name), parameter.unit,
               parameter.initial, parameter.min, parameter.max, parameter.scale == Scale::log ? "log" : "linear",
               parameter.prior ? fmt::format(", prior {:g} ± {:g}", parameter.prior->mean, parameter.prior->sd) : "");
  for (const auto& parameter : assembly.layout().fixed_parameters)
    fmt::print("  {}  {:<6} {:>10.5g}  fixed\n", cell(parameter.name), parameter.unit, parameter.value);
}

/// Median time of one evaluation, over a fifth of a second at most, s.
double time_evaluation(const assembly::Assembly& assembly, const std::vector<double>& free, std::size_t tests) {
  using Clock = std::chrono::steady_clock;
  auto workspace = assembly.evaluator().make_workspace();
  std::vector<double> per_test(tests), times;
  double objective = 0;
  const auto end = Clock::now() + std::chrono::milliseconds(200);
  for (auto now = Clock::now(); now < end && times.size() < 1001;) {
    static_cast<void>(assembly.evaluator().evaluate(free, objective, per_test, {}, {}, *workspace));
    const auto after = Clock::now();
    times.push_back(std::chrono::duration<double>(after - now).count());
    now = after;
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

std::string duration_text(double seconds) {
  return seconds < 1e-3 ? fmt::format("{:.3g} µs", 1e6 * seconds) : fmt::format("{:.3g} ms", 1e3 * seconds);
}

bool agrees(const Agreement& one) { return one.difference <= one.expected; }

/// What the tests find of themselves by other means.
void print_agreement(const InitialPoint::OtherMeans& other) {
  for (const auto& one : other.found)
    fmt::print("{}\n",
               hanging(fmt::format("  {} against ", other.test),
                       fmt::format("{}: differs by {:.2g}{}{}", one.with, one.difference, text::unit_suffix(one.unit),
                                   agrees(one) ? ""
                                               : fmt::format("; NOT MORE THAN {:.2g} WAS EXPECTED: take a "
                                                             "finer mesh, or do not trust this simulation",
                                                             one.expected))));
  if (!other.status.ok())
    fmt::print("{}\n", hanging(fmt::format("  {}: ", other.test),
                               "could not be checked by other means: " + other.status.reason()));
}

void print_initial_point(const CheckedProblem& problem) {
  const auto& assembly = *problem.run->assembly;
  const auto& tests = problem.run->entry->tests;
  const auto& initial = problem.initial;
  if (initial.status.kind() == Status::Kind::failed) {
    fmt::print("{}\n", hanging("  the initial point cannot be evaluated: ", initial.status.reason()));
    return;
  }
  std::string text = fmt::format("objective {:.6g}", initial.objective);
  if (tests.size() > 1)
    for (std::size_t test = 0; test < tests.size(); ++test)
      text += fmt::format("{} {} {:.4g}", test == 0 ? " =" : " +", tests[test], initial.per_test[test]);
  fmt::print("{}\n  one evaluation takes {}; derivatives are {}\n", hanging("  at the initial point: ", text),
             duration_text(initial.seconds), assembly.layout().jacobian_is_exact ? "exact" : "differenced");
  if (assembly.constraints().count() > 0)
    fmt::print(
        "{}\n",
        hanging(fmt::format("  {}: ", counted(assembly.constraints().count(), "constraint", "constraints")),
                initial.status.ok() ? "kept at the initial point"
                                    : "broken at the initial point, which is no harm: " + initial.status.reason()));
  for (const auto& other : initial.other_means) print_agreement(other);
  for (const auto& sentence : initial.sentences)
    fmt::print("{}\n", hanging("  set-up, at the initial point: ", sentence));
  if (initial.analysed && initial.sentences.empty())
    fmt::print("  set-up: the data fix every parameter at the initial point\n");
}

Checked examine(const experiment::Experiment& experiment, const execution::Plan& plan) {
  Checked checked{experiment, plan, plan.warnings, {}};
  auto& warnings = checked.warnings;
  std::set<std::string> posed;
  for (const auto& run : plan.runs) {
    for (const auto& sentence : run.assembly->layout().warnings) {
      const auto same = [&](const auto& warning) { return warning.sentence == sentence; };
      if (std::none_of(warnings.begin(), warnings.end(), same))
        warnings.push_back({execution::WarningKind::set_up, sentence});
    }
    std::string problem =
        fmt::format("model {}, {}", experiment.model_name(*run.entry), comparison::group_of(*run.entry));
    for (const auto& constraint : run.entry->constraints) problem += ", " + constraint.json;
    if (posed.insert(problem).second) checked.problems.push_back({problem, &run, try_initial_point(run)});
  }
  return checked;
}

void print(const Checked& checked, const std::string& file) {
  const auto& [experiment, plan, warnings, problems] = checked;
  fmt::print("{}: {}, {}, {}, seed {}\n", data::excerpt(experiment.name),
             counted(experiment.models.size(), "model", "models"), counted(experiment.tests.size(), "test", "tests"),
             counted(experiment.runs.size(), "run", "runs"), experiment.seed);
  for (const auto& warning : warnings) fmt::print("{}", text::caution_line(warning.text()).shown_on(STDOUT_FILENO));
  fmt::print("\n");
  for (const auto& run : plan.runs)
    fmt::print("{}: {} of at most {} evaluations\n", run.label,
               counted(run.entry->realisations, "realisation", "realisations"), run.entry->stop.max_evaluations);
  for (const auto& problem : problems) {
    fmt::print("\n{}\n", hanging("", problem.title));
    print_tests(*problem.run->assembly);
    print_parameters(*problem.run->assembly);
    print_initial_point(problem);
  }
  fmt::print("\n{}\n", checked.good() ? fmt::format("In order. Next: tunica run {}", file)
                                      : std::string("Not in order: see above. Searches begin all the same."));
}

int check(const GlobalOptions& global, const std::string& file, bool as_json) {
  const Session session(global);
  const auto experiment = session.read(file);
  const auto plan = execution::make_plan(experiment, session.catalogue());
  comparison::check_analysis(plan, session.catalogue());
  const auto checked = examine(experiment, plan);
  if (as_json)
    print_json(check_json(checked));
  else
    print(checked, file);
  return checked.good() ? done : not_converged;
}

}  // namespace

bool InitialPoint::good() const {
  if (status.kind() == Status::Kind::failed) return false;
  return std::all_of(other_means.begin(), other_means.end(), [](const OtherMeans& other) {
    return std::all_of(other.found.begin(), other.found.end(), agrees);
  });
}

bool Checked::good() const {
  return std::all_of(problems.begin(), problems.end(), [](const auto& problem) { return problem.initial.good(); });
}

InitialPoint try_initial_point(const execution::PlannedRun& run) {
  const auto& assembly = *run.assembly;
  const auto& tests = run.entry->tests;
  InitialPoint point;
  std::vector<double> free;
  for (const auto& parameter : assembly.layout().parameters) free.push_back(parameter.initial);
  point.per_test.resize(tests.size());
  auto workspace = assembly.evaluator().make_workspace();
  point.status = assembly.evaluator().evaluate(free, point.objective, point.per_test, {}, {}, *workspace);
  if (point.status.kind() == Status::Kind::failed) return point;
  point.seconds = time_evaluation(assembly, free, tests.size());
  for (std::size_t test = 0; test < tests.size(); ++test) {
    InitialPoint::OtherMeans other{tests[test], {}, {}};
    other.status = assembly.evaluator().ask(
        test, free, [&](const Test& asked, const TestInput& input) { return asked.agreement(input, other.found); });
    if (!other.found.empty() || !other.status.ok()) point.other_means.push_back(std::move(other));
  }
  uncertainty::Identifiability found;
  point.analysed = uncertainty::identify(assembly, free, found).ok();
  if (point.analysed) point.sentences = found.sentences();
  return point;
}

void add_check(CLI::App& app, GlobalOptions& global, Action& action) {
  auto file = std::make_shared<std::string>();
  auto as_json = std::make_shared<bool>(false);
  auto* verb = app.add_subcommand("check", "Dry run: names, units, data, bounds, the initial point, identifiability");
  verb->add_option("experiment", *file, "Experiment file (JSON)")->required()->type_name("EXP");
  verb->add_flag("--json", *as_json, "One JSON object; `in_order` says whether the exit code is 0");
  verb->footer(
      "Examples:\n  tunica check experiment.json\n  tunica check experiment.json --plugin-path my_plugins\n"
      "  tunica check experiment.json --json | jq '.problems[].initial.identifiability'\n\nWrites nothing.");
  verb->callback([&global, &action, file, as_json] {
    action = [&global, file, as_json] { return check(global, *file, *as_json); };
  });
}

}  // namespace tunica::app
