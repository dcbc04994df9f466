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
#include "calibration/examination.hpp"
#include "data/dataset.hpp"
#include "data/units.hpp"
#include "execution/files.hpp"
#include "exit_codes.hpp"
#include "importing/joined.hpp"
#include "importing/proposal.hpp"
#include "messages.hpp"
#include "supervisor.hpp"
#include "text/aside.hpp"
#include "text/wrapping.hpp"
#include "tunica/error.hpp"
#include "unfinished_results.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

using importing::Answers;
using importing::Question;

struct ImportOptions {
  Answers answers;
  std::vector<std::string> files, options, columns, units, where, directions, compressions;
  std::string table, output;
  bool join = false;
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
    text::aside("{} ({} {}): ", question.text, question.likely ? "Enter for" : "for example", question.example);
    std::string answer;
    if (!std::getline(std::cin, answer))
      throw InputError(fmt::format("no answer to '{}'. Give {}", question.text, question.option));
    if (answer.empty() && question.likely) return question.example;
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

/// "axial" for all, or "TEST=axial" for one.
void sort_out(const std::vector<std::string>& texts, std::string_view option, const std::vector<std::string>& words,
              std::string& all, importing::Pairs& single) {
  for (const std::string& text : texts) {
    const std::size_t at = text.rfind('=');
    const std::string value = at == std::string::npos ? text : text.substr(at + 1);
    if (std::find(words.begin(), words.end(), value) == words.end())
      throw InputError(fmt::format("{} {}: expected {}. Write one of these words, or NAME=VALUE with one", option, text,
                                   fmt::join(words, " or ")));
    if (at == std::string::npos)
      all = value;
    else
      single.emplace_back(text.substr(0, at), value);
  }
}

void check_area(const std::string& area) {
  if (area.empty()) return;
  try {
    if (data::parse_quantity(area, "mm2") > 0) return;
  } catch (const InputError& problem) {
    throw InputError(fmt::format("--area is no area: {}", problem.what()));
  }
  throw InputError(fmt::format("--area {}: it must be greater than zero. Correct it", area));
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

/// What was written is checked as `tunica check` will. Whether all is in order.
bool checked(const std::filesystem::path& file, const Session& session) {
  const auto experiment = session.read(file);
  const auto examined = calibration::examine(experiment, session.catalogue());
  for (const auto& warning : examined.warnings) say_wrapped_warning(warning.text());
  for (const auto& test : experiment.tests) {
    if (test.data.preload || test.data.files.empty()) continue;
    const data::Dataset dataset =
        data::read_dataset(test.data, session.catalogue().tests().find(test.type)->second.factory.observables);
    if (const auto toe = toe_of(dataset)) say_wrapped_warning(fmt::format("test '{}': {}", test.name, *toe));
  }
  for (const auto& problem : examined.problems)
    if (problem.initial.status.kind() == Status::Kind::failed)
      say_wrapped_warning(
          fmt::format("{}: the initial point cannot be evaluated: {}", problem.title, problem.initial.status.reason()));
  return examined.good();
}

/// Where the two files of a sheet are joined; empty = they are not.
std::filesystem::path joined_of(const ImportOptions& options, const std::filesystem::path& experiment) {
  if (!options.join) return {};
  std::filesystem::path joined = experiment;
  joined.replace_extension(".csv");
  if (std::filesystem::exists(joined))
    throw InputError(
        fmt::format("--join: there is a file {} already. Name another experiment with -o FILE", joined.string()));
  return joined;
}

/// The two files of a sheet become one beside the experiment.
void join_files(ImportOptions& options, const std::filesystem::path& joined) {
  execution::write_atomically(joined, importing::joined_table(options.answers));
  options.answers.files = {joined};
  options.answers.delimiter = options.answers.decimal = options.answers.skip_lines = "";
  if (options.answers.test.empty()) options.answers.test = "biaxial";
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
  check_length(answers.diameter, "--diameter");
  check_area(answers.area);
  const bool sides = !answers.width.empty() || (!answers.area.empty() && !answers.diameter.empty());
  if ((!answers.area.empty() || !answers.diameter.empty()) && sides)
    throw InputError("--width, --area and --diameter each give the section. Leave out all but one");
  sort_out(options.directions, "--direction", {"circumferential", "axial"}, answers.direction, answers.directions);
  sort_out(options.compressions, "--compression", {"positive", "negative"}, answers.compression, answers.compressions);
  answers.options = pairs(options.options, "--set");
  answers.columns = pairs(options.columns, "--column");
  answers.units = pairs(options.units, "--unit");
  answers.where = pairs(options.where, "--where");
  const std::filesystem::path file = output_of(options);
  const std::filesystem::path joined = joined_of(options, file);
  supervised::unfinished({file, joined});
  UnfinishedResults written({file, joined}, "interrupted; nothing is left behind\n");
  if (!joined.empty()) join_files(options, joined);
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
  const bool in_order = checked(file, session);
  written.keep();
  supervised::unfinished({});
  for (const std::string& note : proposal.notes) answer("{}\n", text::hanging("", note));
  const auto& first = proposal.experiment["tests"].front();
  answer("\n\"data\": {}\n\n{}: {}\nNext: tunica check {}\n", first["data"].dump(2), file.string(),
         in_order ? "checked, in order" : "checked, not in order: see above", file.string());
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
  text("--area", answers.area, "Area of the section, in place of width and thickness", "AREA");
  text("--diameter", answers.diameter, "Diameter of a cylinder, in place of width and thickness", "LENGTH");
  text("--strain-measure", answers.strain_measure, "Definition of strains in the file", "engineering|true|green");
  text("--stress-measure", answers.stress_measure, "Measure of stresses in the file",
       "cauchy|first_piola_kirchhoff|second_piola_kirchhoff");
  text("--cycle", answers.cycle, "last, all, none, or a number", "CYCLE");
  text("--branch", answers.branch, "Branch of the cycles", "loading|unloading|none");
  text("--preload", answers.preload, "Load at which the test begins", "LOAD");
  text("--each", answers.each, "A test for each value of this column", "COLUMN");
  text("--delimiter", answers.delimiter, "What stands between cells (default: found)", ",|;|tab|space");
  text("--decimal", answers.decimal, "Decimal mark (default: found)", ".|,");
  text("--skip-lines", answers.skip_lines, "Lines above the header (default: found)", "N");
  text("--rows", answers.rows, "Rows to use, from 0, the last exclusive", "FIRST:LAST:STEP");
  for (const auto& [name, words] : std::initializer_list<std::pair<const char*, std::vector<std::string>>>{
           {"--strain-measure", {"engineering", "true", "green"}},
           {"--delimiter", {",", ";", "tab", "space"}},
           {"--decimal", {".", ","}}})
    verb->get_option(name)->check(CLI::IsMember(words));
  verb->get_option("--skip-lines")->check(CLI::Range(0, 1000000));
  const auto list = [&](const char* name, std::vector<std::string>& values, const char* doc, const char* type) {
    verb->add_option(name, values, doc)->type_name(type)->allow_extra_args(false);
  };
  list("--column", options->columns, "Column of a quantity; may be repeated", "QUANTITY=COLUMN");
  list("--unit", options->units, "Unit of a column; may be repeated", "COLUMN=UNIT");
  list("--where", options->where, "Use only rows that match; may be repeated", "COLUMN=VALUE");
  list("--direction", options->directions, "Direction of every strip, or of one test; may be repeated",
       "[TEST=]circumferential|axial");
  list("--compression", options->compressions,
       "Sign that compression has in the file, or in one column; may be repeated", "[COLUMN=]positive|negative");
  list("--set", options->options, "Option of the test; may be repeated", "KEY=VALUE");
  verb->add_flag("--join", options->join, "The two files are the two directions of one sheet, row by row");
  verb->footer(
      "Examples:\n"
      "  tunica import strip.csv --width 5mm --thickness 1.2mm --gauge-length 20mm\n"
      "  tunica import rig/*.csv --specimens specimens.csv -o experiment.json\n"
      "  tunica import tube.csv --each test --thickness 0.77mm --set outer_radius=2.3mm\n\n"
      "On a terminal it asks for what the files do not say. `tunica check` shows what was understood.");
  verb->callback([&global, &action, options] { action = [&global, options] { return import(global, *options); }; });
}

}  // namespace tunica::app
