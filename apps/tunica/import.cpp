// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "answer.hpp"
#include "data/units.hpp"
#include "exit_codes.hpp"
#include "imports/imported.hpp"
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

int import(const GlobalOptions& global, const imports::ImportRequest& request) {
  const Session session(global);
  const bool terminal = isatty(STDIN_FILENO) != 0 && isatty(STDERR_FILENO) != 0;
  std::optional<UnfinishedResults> written;
  const imports::Imported imported =
      imports::import_files(request, session.catalogue(), terminal ? importing::Ask(ask_on_terminal) : importing::Ask(),
                            [&](const std::vector<std::filesystem::path>& files) {
                              supervised::unfinished(files);
                              written.emplace(files, "interrupted; nothing is left behind\n");
                            });
  written->keep();
  supervised::unfinished({});
  for (const std::string& warning : imported.warnings) say_wrapped_warning(warning);
  for (const std::string& note : imported.notes) answer("{}\n", text::hanging("", note));
  answer("\n");
  for (const std::string& line : imported.understood) answer("{}\n", text::hanging("", line));
  const auto& first = imported.experiment["tests"].front();
  const std::string file = imported.file.string();
  answer("\n\"data\": {}\n\n{}: {}\nNext: tunica check {}\n", first["data"].dump(2), file,
         imported.in_order ? "checked, in order" : "checked, not in order: see above", file);
  return done;
}

}  // namespace

void add_import(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<imports::ImportRequest>();
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
  text("--height", answers.height, "Height of a specimen that is pressed or sheared: displacements are divided by it",
       "LENGTH");
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
  verb->add_flag("--together", answers.together, "The files are tests of one specimen: fit them together");
  verb->footer(
      "Examples:\n"
      "  tunica import strip.csv --width 5mm --thickness 1.2mm --gauge-length 20mm\n"
      "  tunica import rig/*.csv --specimens specimens.csv -o experiment.json\n"
      "  tunica import tube.csv --each test --thickness 0.77mm --set outer_radius=2.3mm\n\n"
      "On a terminal it asks for what the files do not say. `tunica check` shows what was understood.");
  verb->callback([&global, &action, options] { action = [&global, options] { return import(global, *options); }; });
}

}  // namespace tunica::app
