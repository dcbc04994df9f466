// SPDX-License-Identifier: Apache-2.0
// Scores verdicts on the cases of the blind benchmark; opens the sealed truths once all verdicts are on disk.
#include <cstdio>
#include <fstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "table.hpp"

int main(int count, char** arguments) {
  using namespace blind::score;
  CLI::App app("Score of the blind benchmark of diagnosis. Exit code 1: a figure that has to be met is missed");
  std::string cases, results, look_alikes, markdown_file, json_file, heading, seconds;
  bool partial = false, reduced = false, selected = false;
  app.add_option("cases", cases, "folder that discovery_generator wrote")->required();
  app.add_option("--results", results, "folder of <case>/result.json; default: the cases'");
  app.add_option("--look-alikes", look_alikes, "JSON {id: [declared look-alikes]}");
  app.add_option("--markdown", markdown_file, "write the table here, besides standard output");
  app.add_option("--json", json_file, "write all figures here");
  app.add_option("--heading", heading, "first line of the table: date, seeds");
  app.add_option("--seconds", seconds, "JSON {case: seconds that its diagnosis took}");
  app.add_flag("--selected", selected, "not all classes, or a share of them: figures may be unmeasured");
  app.add_flag("--partial", partial, "leave cases without a verdict sealed, and score the rest");
  app.add_flag("--reduced", reduced,
               "few cases: a figure is missed where its whole 95 % interval misses, and may be unmeasured");
  try {
    app.parse(count, arguments);
    OpenedCases opened = open_cases(cases, results.empty() ? cases : results, partial);
    if (!seconds.empty()) add_seconds(opened.cases, seconds);
    const LookAlikes declared = look_alikes.empty() ? LookAlikes{} : read_look_alikes(look_alikes);
    Score score{figures(opened.cases, declared), class_figures(opened.cases, declared), time_figures(opened.cases),
                mistakes(opened.cases, declared), effects(opened.cases, declared)};
    if (selected) std::erase_if(score.figures, [](const Figure& figure) { return figure.cases == 0; });
    const std::string text = markdown(heading, score);
    fmt::print("{}", text);
    if (opened.sealed > 0) fmt::print("\n{} cases without a verdict stay sealed.\n", opened.sealed);
    if (!markdown_file.empty()) std::ofstream(markdown_file) << text;
    if (!json_file.empty()) std::ofstream(json_file) << as_json(score).dump(1) << "\n";
    std::size_t missed = 0;
    auto judged = score.figures;
    for (const auto* more : {&score.classes, &score.times}) judged.insert(judged.end(), more->begin(), more->end());
    for (const Figure& figure : judged) {
      const bool unmeasured = !reduced && !selected && figure.pass && figure.cases == 0;
      if (!unmeasured && !(reduced ? figure.surely_missed() : figure.missed())) continue;
      fmt::print(stderr, "discovery_score: {}: {}\n", unmeasured ? "not measured" : "missed", figure.name);
      ++missed;
    }
    for (const std::string& words : unnamed(score.effects)) {
      fmt::print(stderr, "discovery_score: missed: {}\n", words);
      ++missed;
    }
    return missed > 0 ? 1 : 0;
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  } catch (const InputError& problem) {
    fmt::print(stderr, "discovery_score: {}\n", problem.what());
    return 2;
  }
}
