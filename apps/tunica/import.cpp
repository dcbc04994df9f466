// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "answer.hpp"
#include "data/dataset.hpp"
#include "data/units.hpp"
#include "execution/files.hpp"
#include "exit_codes.hpp"
#include "importing/proposal.hpp"
#include "messages.hpp"
#include "text/aside.hpp"
#include "text/wrapping.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

using importing::Answers;
using importing::Question;

struct ImportOptions {
  Answers answers;
  std::vector<std::string> files, options, columns, units, where;
  std::string table, output;
};

importing::Pairs pairs(const std::vector<std::string>& texts, std::string_view option) {
  importing::Pairs found;
  for (const std::string& text : texts) {
    const std::size_t at = text.rfind('=');
    if (at == std::string::npos || at == 0 || at + 1 == text.size())
      throw InputError(fmt::format("{} {}: expected a name and a value. Write NAME=VALUE", option, text));
    found.emplace_back(text.substr(0, at), text.substr(at + 1));
  }
  return found;
}

/// Asks on the terminal until the answer makes sense.
std::string ask_on_terminal(const Question& question) {
  for (;;) {
    text::aside("{} (for example {}): ", question.text, question.example);
    std::string answer;
    if (!std::getline(std::cin, answer))
      throw InputError(fmt::format("no answer to '{}'. Give {}", question.text, question.option));
    if (answer.empty()) continue;
    if (!question.length || answer == "preload") return answer;
    try {
      if (data::parse_quantity(answer, "mm") > 0) return answer;
      text::aside("It must be greater than zero.\n");
    } catch (const InputError& problem) {
      text::aside("{}\n", problem.what());
    }
  }
}

/// A length that is greater than zero, with its unit; a bare number is taken for mm, and that is said.
void check_length(std::string& answer, const char* option) {
  if (answer.empty() || answer == "preload") return;
  double length = 0;
  try {
    length = data::parse_quantity(answer, "mm");
  } catch (const InputError& problem) {
    throw InputError(fmt::format("{} is no length: {}", option, problem.what()));
  }
  if (!(length > 0)) throw InputError(fmt::format("{} {}: it must be greater than zero. Correct it", option, answer));
  if (answer.find_first_not_of("0123456789.+-eE ") != std::string::npos) return;
  answer += " mm";
  say_wrapped_warning(fmt::format("{}: no unit is given; {} is assumed", option, answer));
}

[[noreturn]] void refuse_unanswered(const std::vector<Question>& questions) {
  std::vector<std::string> lines;
  std::set<std::string> named;
  for (const Question& question : questions)
    if (named.insert(question.option).second)
      lines.push_back(fmt::format("{} ({}, for example {})", question.option, question.text, question.example));
  throw InputError(fmt::format("the files do not say everything. Give {}", fmt::join(lines, "; ")));
}

std::filesystem::path output_of(const ImportOptions& options) {
  std::filesystem::path file = options.output;
  if (file.empty() && options.files.size() > 1)
    throw InputError("several files make one experiment. Name it with -o FILE");
  if (file.empty()) file = std::filesystem::path(options.files.front()).stem().string() + ".json";
  if (std::filesystem::exists(file))
    throw InputError(fmt::format("{}: there is such a file already. Name another one with -o FILE", file.string()));
  return file;
}

/// A long flat beginning, which a preload cuts off and a model of rubber cannot follow.
std::optional<std::string> toe_of(const data::Dataset& dataset) {
  constexpr double small = 0.01, long_enough = 0.3;
  if (dataset.abscissae.empty() || dataset.channels.empty() || dataset.count < 10) return std::nullopt;
  const auto& [abscissa, path] = dataset.abscissae.front();
  const auto& load = dataset.channels.front().values;
  double most = 0;
  for (const double value : load)
    if (std::abs(value) > most) most = std::abs(value);
  std::size_t row = 0;
  while (row < load.size() && !(std::abs(load[row]) > small * most)) ++row;
  const auto [low, high] = std::minmax_element(path.begin(), path.end());
  if (row == load.size() || std::abs(path[row] - path.front()) < long_enough * (*high - *low)) return std::nullopt;
  return fmt::format(
      "up to a {} of {:.4g} the {} stays below 1 % of its largest value: a toe. If the specimen hung slack there, cut "
      "it "
      "off with --preload, for example --preload 0.1N, and take --gauge-length preload",
      abscissa, path[row], dataset.channels.front().observable);
}

/// What was written is read as `tunica check` will read it; what it refuses is taken back.
std::vector<std::string> warnings_about(const std::filesystem::path& file, const Session& session) {
  try {
    std::vector<std::string> warnings;
    const auto experiment = session.read(file);
    for (const auto& test : experiment.tests) {
      data::Dataset dataset =
          data::read_dataset(test.data, session.catalogue().tests().find(test.type)->second.factory.observables);
      if (!test.data.preload)
        if (auto toe = toe_of(dataset)) dataset.warnings.push_back(std::move(*toe));
      for (const std::string& warning : dataset.warnings)
        warnings.push_back(fmt::format("test '{}': {}", test.name, warning));
    }
    return warnings;
  } catch (const InputError&) {
    std::filesystem::remove(file);
    throw;
  }
}

int import(const GlobalOptions& global, ImportOptions options) {
  const Session session(global);
  Answers& answers = options.answers;
  for (const std::string& file : options.files) answers.files.emplace_back(file);
  answers.table = options.table;
  check_length(answers.width, "--width");
  check_length(answers.thickness, "--thickness");
  check_length(answers.gauge_length, "--gauge-length");
  if (answers.gauge_length == "preload" && (answers.preload.empty() || answers.preload == "none"))
    throw InputError("--gauge-length preload: at which load? Add --preload, for example --preload 0.1N");
  answers.options = pairs(options.options, "--set");
  answers.columns = pairs(options.columns, "--column");
  answers.units = pairs(options.units, "--unit");
  answers.where = pairs(options.where, "--where");
  const std::filesystem::path file = output_of(options);
  std::vector<Question> unanswered;
  const bool terminal = isatty(STDIN_FILENO) != 0 && isatty(STDERR_FILENO) != 0;
  const importing::Ask ask = [&](const Question& question) {
    if (terminal) return ask_on_terminal(question);
    unanswered.push_back(question);
    return question.example;
  };
  const auto folder = std::filesystem::absolute(file).parent_path();
  const auto proposal = importing::propose(answers, folder, session.catalogue(), ask);
  if (!unanswered.empty()) refuse_unanswered(unanswered);
  execution::write_atomically(file, proposal.experiment.dump(2) + '\n');
  for (const std::string& warning : warnings_about(file, session)) say_wrapped_warning(warning);
  for (const std::string& note : proposal.notes) answer("{}\n", text::hanging("", note));
  const auto& first = proposal.experiment["tests"].front();
  answer("\n\"data\": {}\n\n{}\nNext: tunica check {}\n", first["data"].dump(2), file.string(), file.string());
  return done;
}

}  // namespace

void add_import(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<ImportOptions>();
  Answers& answers = options->answers;
  auto* verb = app.add_subcommand("import", "Read files of a testing machine and write a first experiment from them");
  verb->add_option("file", options->files, "Data files as the machine wrote them; a test of each")
      ->required()
      ->type_name("FILE");
  verb->add_option("-o,--output", options->output, "Experiment file to write (default: name of the data file)")
      ->type_name("FILE");
  verb->add_option("--test", answers.test, "Type of the test (default: from the columns)")->type_name("NAME");
  verb->add_option("--model", answers.model, "Model to begin with")->type_name("NAME");
  const auto text = [&](const char* name, std::string& value, const char* doc, const char* type) {
    verb->add_option(name, value, doc)->type_name(type);
  };
  text("--width", answers.width, "Width of the specimen across the force", "LENGTH");
  text("--thickness", answers.thickness, "Thickness of the specimen, or of the wall of a tube", "LENGTH");
  text("--gauge-length", answers.gauge_length, "Length at stretch 1; \"preload\": the length there", "LENGTH");
  text("--specimens", options->table, "Table of sizes: a row that has the name of the file, columns width, thickness",
       "FILE");
  text("--direction", answers.direction, "Direction of a strip", "circumferential|axial");
  text("--stress-measure", answers.stress_measure, "Measure of stresses in the file",
       "cauchy|first_piola_kirchhoff|second_piola_kirchhoff");
  text("--cycle", answers.cycle, "last, all, none, or a number", "CYCLE");
  text("--branch", answers.branch, "Branch of the cycles", "loading|unloading|none");
  text("--preload", answers.preload, "Load at which the test begins", "LOAD");
  text("--each", answers.each, "A test for each value of this column", "COLUMN");
  const auto list = [&](const char* name, std::vector<std::string>& values, const char* doc, const char* type) {
    verb->add_option(name, values, doc)->type_name(type)->allow_extra_args(false);
  };
  list("--column", options->columns, "Column of a quantity; may be repeated", "QUANTITY=COLUMN");
  list("--unit", options->units, "Unit of a column; may be repeated", "COLUMN=UNIT");
  list("--where", options->where, "Use only rows that match; may be repeated", "COLUMN=VALUE");
  list("--set", options->options, "Option of the test; may be repeated", "KEY=VALUE");
  verb->footer(
      "Examples:\n"
      "  tunica import strip.csv --width 5mm --thickness 1.2mm --gauge-length 20mm\n"
      "  tunica import rig/*.csv --specimens specimens.csv -o experiment.json\n"
      "  tunica import tube.csv --each test --thickness 0.77mm --set outer_radius=2.3mm\n\n"
      "On a terminal it asks for what the files do not say. `tunica check` shows what was understood.");
  verb->callback([&global, &action, options] { action = [&global, options] { return import(global, *options); }; });
}

}  // namespace tunica::app
