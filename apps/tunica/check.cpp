// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "calibration/identifiability.hpp"
#include "comparison/ranking.hpp"
#include "comparison/text.hpp"
#include "comparison/uncertainty.hpp"
#include "execution/plan.hpp"
#include "exit_codes.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

using comparison::columns;
using comparison::counted;
using comparison::hanging;
using comparison::pad;

void print_tests(const calibration::Assembly& assembly) {
  for (const auto& channel : assembly.channels()) {
    const auto held_out = std::count(channel.fitted.begin(), channel.fitted.end(), false);
    const auto [low, high] = std::minmax_element(channel.measured.begin(), channel.measured.end());
    const auto [first, last] = std::minmax_element(channel.abscissa.begin(), channel.abscissa.end());
    std::string text = fmt::format("{} rows", channel.count);
    if (held_out > 0) text += fmt::format(" ({} held out)", held_out);
    if (channel.count > 0)
      text += fmt::format(", {:.4g} … {:.4g}{} over {} {:.4g} … {:.4g}{}", *low, *high,
                          channel.unit == "1" ? "" : " " + channel.unit, channel.abscissa_name, *first, *last,
                          channel.abscissa_unit == "1" ? "" : ' ' + channel.abscissa_unit);
    text += fmt::format(", weight {:g}", channel.weight);
    text += channel.noise ? fmt::format(", noise {:g} + {:g} y", channel.noise->absolute, channel.noise->relative)
                          : std::string(", noise estimated");
    fmt::print("{}\n", hanging(fmt::format("  {}, {}: ", channel.test, channel.observable), text));
  }
}

void print_parameters(const calibration::Assembly& assembly) {
  std::size_t width = 9;
  for (const auto& parameter : assembly.parameters()) width = std::max(width, columns(parameter.name));
  for (const auto& parameter : assembly.fixed_parameters()) width = std::max(width, columns(parameter.name));
  fmt::print("  {}  {:<6} {:>10} {:>10} {:>10}  scale\n", pad("parameter", width), "unit", "initial", "min", "max");
  for (const auto& parameter : assembly.parameters())
    fmt::print("  {}  {:<6} {:>10.5g} {:>10.5g} {:>10.5g}  {}{}\n", pad(parameter.name, width), parameter.unit,
               parameter.initial, parameter.min, parameter.max, parameter.scale == Scale::log ? "log" : "linear",
               parameter.prior ? fmt::format(", prior {:g} ± {:g}", parameter.prior->mean, parameter.prior->sd) : "");
  for (const auto& parameter : assembly.fixed_parameters())
    fmt::print("  {}  {:<6} {:>10.5g}  fixed\n", pad(parameter.name, width), parameter.unit, parameter.value);
}

/// Median time of one evaluation, over a fifth of a second at most.
std::string time_evaluation(const calibration::Assembly& assembly, const std::vector<double>& free, std::size_t tests) {
  using Clock = std::chrono::steady_clock;
  auto workspace = assembly.make_workspace();
  std::vector<double> per_test(tests), times;
  double objective = 0;
  const auto end = Clock::now() + std::chrono::milliseconds(200);
  for (auto now = Clock::now(); now < end && times.size() < 1001;) {
    static_cast<void>(assembly.evaluate(free, objective, per_test, {}, {}, *workspace));
    const auto after = Clock::now();
    times.push_back(std::chrono::duration<double, std::micro>(after - now).count());
    now = after;
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  const double median = times[times.size() / 2];
  return median < 1000 ? fmt::format("{:.3g} µs", median) : fmt::format("{:.3g} ms", median / 1000);
}

/// What the tests find of themselves by other means; false where more than discretisation separates them.
bool print_agreement(const calibration::Assembly& assembly, const std::vector<std::string>& tests,
                     const std::vector<double>& free) {
  bool good = true;
  for (std::size_t test = 0; test < tests.size(); ++test) {
    std::vector<Agreement> found;
    const auto status = assembly.ask(
        test, free, [&](const Test& asked, const TestInput& input) { return asked.agreement(input, found); });
    for (const auto& one : found) {
      const bool agrees = one.difference <= one.expected;
      good = good && agrees;
      fmt::print("{}\n", hanging(fmt::format("  {} against ", tests[test]),
                                 fmt::format("{}: differs by {:.2g}{}{}", one.with, one.difference,
                                             one.unit == "1" ? "" : ' ' + one.unit,
                                             agrees ? ""
                                                    : fmt::format("; NOT MORE THAN {:.2g} WAS EXPECTED: take a "
                                                                  "finer mesh, or do not trust this simulation",
                                                                  one.expected))));
    }
    if (!status.ok())
      fmt::print("{}\n", hanging(fmt::format("  {}: ", tests[test]),
                                 "could not be checked by other means: " + status.reason()));
  }
  return good;
}

/// False when the initial point cannot be evaluated.
bool print_initial_point(const execution::PlannedRun& run) {
  const auto& assembly = *run.assembly;
  std::vector<double> free;
  for (const auto& parameter : assembly.parameters()) free.push_back(parameter.initial);
  std::vector<double> per_test(run.entry->tests.size());
  auto workspace = assembly.make_workspace();
  double objective = 0;
  const auto status = assembly.evaluate(free, objective, per_test, {}, {}, *workspace);
  if (status.kind() == Status::Kind::failed) {
    fmt::print("{}\n", hanging("  the initial point cannot be evaluated: ", status.reason()));
    return false;
  }
  std::string text = fmt::format("objective {:.6g}", objective);
  if (per_test.size() > 1)
    for (std::size_t test = 0; test < per_test.size(); ++test)
      text += fmt::format("{} {} {:.4g}", test == 0 ? " =" : " +", run.entry->tests[test], per_test[test]);
  fmt::print("{}\n  one evaluation takes {}; derivatives are {}\n", hanging("  at the initial point: ", text),
             time_evaluation(assembly, free, per_test.size()), assembly.jacobian_is_exact() ? "exact" : "differenced");
  if (assembly.constraint_count() > 0)
    fmt::print("{}\n", hanging(fmt::format("  {}: ", counted(assembly.constraint_count(), "constraint", "constraints")),
                               status.ok() ? "kept at the initial point"
                                           : "broken at the initial point, which is no harm: " + status.reason()));
  const bool agrees = print_agreement(assembly, run.entry->tests, free);
  calibration::Identifiability found;
  if (calibration::identify(assembly, free, found).ok()) {
    const auto sentences = found.sentences();
    for (const auto& sentence : sentences) fmt::print("{}\n", hanging("  set-up, at the initial point: ", sentence));
    if (sentences.empty()) fmt::print("  set-up: the data fix every parameter at the initial point\n");
  }
  return agrees;
}

int check(const GlobalOptions& global, const std::string& file) {
  const Session session(global);
  const auto experiment = session.read(file);
  const auto plan = execution::make_plan(experiment, session.catalogue());
  comparison::check_analysis(plan, session.catalogue());
  fmt::print("{}: {}, {}, {}, seed {}\n", experiment.name, counted(experiment.models.size(), "model", "models"),
             counted(experiment.tests.size(), "test", "tests"), counted(experiment.runs.size(), "run", "runs"),
             experiment.seed);
  std::vector<std::string> warnings = plan.warnings;
  for (const auto& run : plan.runs)
    for (const auto& warning : run.assembly->warnings())
      if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) warnings.push_back(warning);
  for (const auto& warning : warnings) fmt::print("{}\n", hanging("  ! ", warning));
  bool good = true;
  fmt::print("\n");
  for (const auto& run : plan.runs)
    fmt::print("{}: {} of at most {} evaluations\n", run.label,
               counted(run.entry->realisations, "realisation", "realisations"), run.entry->stop.max_evaluations);
  std::set<std::string> shown;
  for (const auto& run : plan.runs) {
    // Runs that differ only in the optimiser pose the same problem.
    std::string problem =
        fmt::format("model {}, {}", experiment.model_name(*run.entry), comparison::group_of(*run.entry));
    for (const auto& constraint : run.entry->constraints) problem += ", " + constraint.json;
    if (!shown.insert(problem).second) continue;
    fmt::print("\n{}\n", hanging("", problem));
    print_tests(*run.assembly);
    print_parameters(*run.assembly);
    good = print_initial_point(run) && good;
  }
  fmt::print("\n{}\n", good ? fmt::format("In order. Next: tunica run {}", file)
                            : std::string("Not in order: see above. Searches begin all the same."));
  return good ? done : not_converged;
}

}  // namespace

void add_check(CLI::App& app, GlobalOptions& global, Action& action) {
  auto file = std::make_shared<std::string>();
  auto* verb = app.add_subcommand("check", "Dry run: names, units, data, bounds, the initial point, identifiability");
  verb->add_option("experiment", *file, "Experiment file (JSON)")->required()->type_name("EXP");
  verb->footer(
      "Examples:\n  tunica check experiment.json\n  tunica check experiment.json --plugin-path my_plugins\n\nWrites "
      "nothing.");
  verb->callback([&global, &action, file] { action = [&global, file] { return check(global, *file); }; });
}

}  // namespace tunica::app
