// SPDX-License-Identifier: Apache-2.0
#include "imports/imported.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "calibration/examination.hpp"
#include "data/dataset.hpp"
#include "data/units.hpp"
#include "execution/files.hpp"
#include "importing/joined.hpp"
#include "tunica/error.hpp"

namespace tunica::imports {

namespace {

using importing::Answers;
using importing::Question;

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

/// A length that is greater than zero, with its unit; a bare number is taken for mm, and that is said.
void check_length(std::string& answer, const char* option, std::vector<std::string>& warnings) {
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
  warnings.push_back(fmt::format("{}: no unit is given; {} is assumed", option, answer));
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

std::filesystem::path output_of(const ImportRequest& request) {
  std::filesystem::path file = request.output;
  if (file.empty() && request.files.size() > 1)
    throw InputError("several files make one experiment. Name it with -o FILE, in Python with output=");
  if (file.empty()) file = std::filesystem::path(request.files.front()).stem().string() + ".json";
  if (std::filesystem::exists(file))
    throw InputError(fmt::format(
        "{}: there is such a file already. Name another one with -o FILE, in Python with output=", file.string()));
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

/// Checks the written file in the same way as `tunica check`.
void check_written(const plugins::Catalogue& catalogue, Imported& imported) {
  const auto experiment = experiment::read_experiment(imported.file, catalogue);
  const auto examined = calibration::examine(experiment, catalogue);
  for (const auto& warning : examined.warnings) imported.warnings.push_back(warning.text());
  for (const auto& test : experiment.tests) {
    if (test.data.preload || test.data.files.empty()) continue;
    const data::Dataset dataset =
        data::read_dataset(test.data, catalogue.tests().find(test.type)->second.factory.observables);
    if (const auto toe = toe_of(dataset)) imported.warnings.push_back(fmt::format("test '{}': {}", test.name, *toe));
  }
  for (const auto& problem : examined.problems)
    if (problem.initial.status.kind() == Status::Kind::failed)
      imported.warnings.push_back(
          fmt::format("{}: the initial point cannot be evaluated: {}", problem.title, problem.initial.status.reason()));
  for (const auto& [test, lines] : examined.understood)
    for (const auto& line : lines) imported.understood.push_back(fmt::format("{}: {}", test, line));
  imported.in_order = examined.good();
}

/// A file that is removed unless it is kept.
struct TakenBack {
  std::filesystem::path file;
  mutable bool keep = false;
  ~TakenBack() {
    std::error_code ignored;
    if (!keep && !file.empty()) std::filesystem::remove(file, ignored);
  }
};

/// Where the two files of a sheet are joined; empty = they are not.
std::filesystem::path joined_of(const ImportRequest& request, const std::filesystem::path& experiment) {
  if (!request.join) return {};
  std::filesystem::path joined = experiment;
  joined.replace_extension(".csv");
  if (std::filesystem::exists(joined))
    throw InputError(
        fmt::format("--join: there is a file {} already. Name another experiment with -o FILE, in Python with output=",
                    joined.string()));
  return joined;
}

/// The two files of a sheet become one beside the experiment.
void join_files(ImportRequest& request, const std::filesystem::path& joined, const plugins::Catalogue& catalogue) {
  execution::write_atomically(joined, importing::joined_table(request.answers));
  request.answers.files = {joined};
  request.answers.delimiter = request.answers.decimal = request.answers.skip_lines = "";
  const auto* const sheet = catalogue.first_test(Specimen::sheet);
  if (request.answers.test.empty() && sheet != nullptr) request.answers.test = sheet->factory.type;
}

void check_sizes(ImportRequest& request, std::vector<std::string>& warnings) {
  Answers& answers = request.answers;
  check_length(answers.width, "--width", warnings);
  check_length(answers.thickness, "--thickness", warnings);
  check_length(answers.height, "--height", warnings);
  check_length(answers.gauge_length, "--gauge-length", warnings);
  if (answers.gauge_length == "preload" && (answers.preload.empty() || answers.preload == "none"))
    throw InputError("--gauge-length preload: at which load? Add --preload, for example --preload 0.1N");
  check_length(answers.diameter, "--diameter", warnings);
  check_area(answers.area);
  const bool sides = !answers.width.empty() || (!answers.area.empty() && !answers.diameter.empty());
  if ((!answers.area.empty() || !answers.diameter.empty()) && sides)
    throw InputError("--width, --area and --diameter each give the section. Leave out all but one");
  if (!answers.height.empty() && !answers.gauge_length.empty())
    throw InputError("--height and --gauge-length each give the length at stretch 1. Leave out one");
}

}  // namespace

Imported import_files(ImportRequest request, const plugins::Catalogue& catalogue, const importing::Ask& ask,
                      const std::function<void(const std::vector<std::filesystem::path>&)>& making) {
  Imported imported;
  Answers& answers = request.answers;
  for (const std::string& file : request.files) answers.files.emplace_back(file);
  answers.table = request.table;
  check_sizes(request, imported.warnings);
  sort_out(request.directions, "--direction", {"circumferential", "axial"}, answers.direction, answers.directions);
  sort_out(request.compressions, "--compression", {"positive", "negative"}, answers.compression, answers.compressions);
  answers.options = pairs(request.options, "--set");
  answers.columns = pairs(request.columns, "--column");
  answers.units = pairs(request.units, "--unit");
  answers.where = pairs(request.where, "--where");
  imported.file = output_of(request);
  const std::filesystem::path joined = joined_of(request, imported.file);
  if (making) making({imported.file, joined});
  const TakenBack experiment_file{imported.file}, table_of_both{joined};
  if (!joined.empty()) join_files(request, joined, catalogue);
  std::vector<Question> unanswered;
  const importing::Ask asked = [&](const Question& question) {
    if (ask) return ask(question);
    unanswered.push_back(question);
    return question.example;
  };
  const auto folder = std::filesystem::absolute(imported.file).parent_path();
  auto proposal = importing::propose(answers, folder, catalogue, asked);
  if (!unanswered.empty()) refuse_unanswered(unanswered);
  execution::write_atomically(imported.file, proposal.experiment.dump(2) + '\n');
  imported.experiment = std::move(proposal.experiment);
  for (std::string& note : proposal.notes)  // several tests of one file say the same
    if (std::find(imported.notes.begin(), imported.notes.end(), note) == imported.notes.end())
      imported.notes.push_back(std::move(note));
  check_written(catalogue, imported);
  experiment_file.keep = table_of_both.keep = true;
  return imported;
}

}  // namespace tunica::imports
