// SPDX-License-Identifier: Apache-2.0
#include "studio/rig_files.hpp"

#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/signal.hpp"
#include "data/table_file.hpp"
#include "experiment/experiment.hpp"
#include "importing/columns.hpp"
#include "imports/imported.hpp"
#include "studio/project_folder.hpp"
#include "text/escaped.hpp"
#include "text/shell.hpp"
#include "tunica/error.hpp"

namespace tunica::app::studio {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;
using importing::Answers;

namespace {

/// Options of `tunica import` by their names; those of one text.
constexpr std::array<std::pair<const char*, std::string Answers::*>, 19> texts{
    {{"test", &Answers::test},
     {"model", &Answers::model},
     {"width", &Answers::width},
     {"thickness", &Answers::thickness},
     {"height", &Answers::height},
     {"gauge-length", &Answers::gauge_length},
     {"area", &Answers::area},
     {"diameter", &Answers::diameter},
     {"strain-measure", &Answers::strain_measure},
     {"stress-measure", &Answers::stress_measure},
     {"cycle", &Answers::cycle},
     {"branch", &Answers::branch},
     {"preload", &Answers::preload},
     {"each", &Answers::each},
     {"delimiter", &Answers::delimiter},
     {"decimal", &Answers::decimal},
     {"skip-lines", &Answers::skip_lines},
     {"rows", &Answers::rows},
     {"direction", &Answers::direction}}};
/// Those that may be repeated.
constexpr std::array<std::pair<const char*, std::vector<std::string> imports::ImportRequest::*>, 5> lists{
    {{"set", &imports::ImportRequest::options},
     {"column", &imports::ImportRequest::columns},
     {"unit", &imports::ImportRequest::units},
     {"where", &imports::ImportRequest::where},
     {"compression", &imports::ImportRequest::compressions}}};

/// The form as a request, and as the command that says the same.
struct Form {
  imports::ImportRequest request;
  std::vector<std::string> words{"tunica", "import"};
  std::map<std::string, std::string> asked;
};

/// "--unit 'Load=UNIT'" and "N" → {"--unit", "Load=N"}; where an option has two forms, the one that the answer names.
std::vector<std::string> words_of(std::string option, const std::string& answer) {
  if (const auto second = option.find("--", 2); second != std::string::npos)
    option = option.find(answer + "=", second) != std::string::npos ? option.substr(second) : option.substr(0, second);
  const auto begin = option.find('\''), end = option.rfind('\'');
  if (begin == std::string::npos || end == begin) return {option, answer};
  std::string value = option.substr(begin + 1, end - begin - 1);
  const auto equals = value.rfind('=');
  if (equals != std::string::npos && value.substr(0, equals) != answer) value = value.substr(0, equals + 1) + answer;
  return {option.substr(0, option.find(' ')), value};
}

Form form_of(const nlohmann::json& asked) {
  Form form;
  for (const auto& name : asked.at("files")) {
    form.request.files.push_back(file_inside(name).string());
    form.words.push_back(form.request.files.back());
  }
  if (form.request.files.empty()) throw InputError("no file is chosen; drop one, or take one of the list");
  const auto answers = asked.value("answers", nlohmann::json::object());
  for (const auto& [name, member] : texts)
    if (const auto text = answers.value(name, std::string()); !text.empty()) {
      form.request.answers.*member = text;
      form.words.insert(form.words.end(), {fmt::format("--{}", name), text});
    }
  form.request.directions.clear();
  for (const auto& [name, member] : lists)
    for (const std::string& text : answers.value(name, std::vector<std::string>())) {
      (form.request.*member).push_back(text);
      form.words.insert(form.words.end(), {fmt::format("--{}", name), text});
    }
  if (asked.contains("asked"))
    for (const auto& [option, text] : asked["asked"].items())
      if (const auto answer = text.get<std::string>(); !answer.empty()) {
        form.asked[option] = answer;
        const auto words = words_of(option, answer);
        form.words.insert(form.words.end(), words.begin(), words.end());
      }
  return form;
}

json numbers(const std::vector<double>& values) {
  constexpr std::size_t most = 60000;
  json list = json::array();
  const std::size_t shown = std::min(values.size(), most);
  for (std::size_t k = 0; k < shown; ++k) {
    const double value = values[shown < 2 ? 0 : k * (values.size() - 1) / (shown - 1)];
    list.push_back(std::isfinite(value) ? json(value) : json(nullptr));
  }
  return list;
}

std::vector<double> as_numbers(const std::vector<bool>& flags) { return {flags.begin(), flags.end()}; }

/// What each column holds, also where no test can be made of them.
json columns_of(const Form& form) {
  json list = json::array();
  const auto table = data::table_file(form.request.files.front(), {});
  constexpr std::size_t preview = 3;
  const auto guesses = importing::guess_columns(table->csv);
  for (std::size_t k = 0; k < guesses.size(); ++k) {
    const auto& guess = guesses[k];
    json cells = json::array();
    for (std::size_t row = 0; row < std::min(preview, table->csv.rows.size()); ++row)
      cells.push_back(text::excerpt(table->csv.rows[row].cells[k]));
    list.push_back({{"name", guess.name},
                    {"title", guess.title},
                    {"quantity", guess.quantity},
                    {"kind", guess.kind},
                    {"unit", guess.unit},
                    {"numeric", guess.numeric},
                    {"preview", std::move(cells)}});
  }
  return list;
}

json signal_json(const std::string& test, const data::Signal& signal) {
  json one = {{"test", test},
              {"file", signal.file.filename().string()},
              {"clock", {{"title", signal.clock.title}, {"values", numbers(signal.clock.values)}}},
              {"columns", json::array()},
              {"used", numbers(as_numbers(signal.used))}};
  for (const auto& column : signal.columns)
    one["columns"].push_back({{"title", column.title}, {"values", numbers(column.values)}});
  return one;
}

/// What stands in the files, and the curves that the test takes from them.
void draw(const fs::path& file, const plugins::Catalogue& catalogue, json& answer) {
  const auto experiment = experiment::read_experiment(file, catalogue);
  for (const auto& test : experiment.tests) {
    const auto& observables = catalogue.tests().find(test.type)->second.factory.observables;
    if (test.data.cycle && test.data.cycle->last) answer["last_cycle_only"] = true;
    for (const auto& signal : data::read_signals(test.data, observables))
      answer["signals"].push_back(signal_json(test.name, signal));
    const auto dataset = data::read_dataset(test.data, observables);
    if (dataset.abscissae.empty()) continue;
    for (const auto& channel : dataset.channels)
      answer["curves"].push_back({{"test", test.name},
                                  {"type", test.type},
                                  {"observable", channel.observable},
                                  {"unit", channel.unit},
                                  {"measure", channel.observable == "stress" ? test.data.stress_measure : ""},
                                  {"over", dataset.abscissae.front().first},
                                  {"x", numbers(dataset.abscissae.front().second)},
                                  {"y", numbers(channel.values)}});
  }
}

json said(const imports::Imported& imported, const Form& form) {
  return {{"notes", imported.notes},
          {"understood", imported.understood},
          {"warnings", imported.warnings},
          {"in_order", imported.in_order},
          {"command", text::quoted(form.words)}};
}

/// A file that goes when this object does.
struct Passing {
  fs::path file;
  ~Passing() {
    std::error_code none;
    fs::remove(file, none);
  }
};

}  // namespace

json look_at_rig_files(const nlohmann::json& asked, const plugins::Catalogue& catalogue) {
  Form form = form_of(asked);
  const Passing trial{passing_name()};
  form.request.output = trial.file.string();
  json answer = {{"columns", columns_of(form)}, {"questions", json::array()}, {"signals", json::array()},
                 {"curves", json::array()},     {"provisional", false},       {"command", text::quoted(form.words)}};
  try {
    const imports::Imported imported =
        imports::import_files(form.request, catalogue, [&](const importing::Question& question) {
          const auto given = form.asked.find(question.option);
          answer["questions"].push_back({{"text", question.text},
                                         {"option", question.option},
                                         {"example", question.example},
                                         {"length", question.length},
                                         {"likely", question.likely},
                                         {"answer", given == form.asked.end() ? "" : given->second}});
          if (given != form.asked.end()) return given->second;
          answer["provisional"] = true;
          return question.example;
        });
    answer.update(said(imported, form));
    draw(trial.file, catalogue, answer);
  } catch (const InputError& problem) {
    answer["problem"] = problem.what();
  }
  return answer;
}

json import_rig_files(const nlohmann::json& asked, const plugins::Catalogue& catalogue) {
  Form form = form_of(asked);
  const fs::path wished = asked.value("output", std::string()).empty()
                              ? fs::path(form.request.files.front()).replace_extension(".json")
                              : fs::path(file_name(asked["output"].get<std::string>()));
  fs::path output = inside(wished.generic_string());
  output.replace_extension(".json");
  const FreeName name(output);
  form.request.output = name.file.generic_string();
  std::vector<std::string> missing;
  const imports::Imported imported =
      imports::import_files(form.request, catalogue, [&](const importing::Question& question) {
        const auto given = form.asked.find(question.option);
        if (given != form.asked.end()) return given->second;
        missing.push_back(question.text);
        return question.example;
      });
  if (!missing.empty()) {
    std::error_code none;
    fs::remove(imported.file, none);
    throw InputError(fmt::format("not everything is answered: {}. Fill in the form", missing.front()));
  }
  form.words.insert(form.words.end(), {"-o", form.request.output});
  json answer = said(imported, form);
  answer["file"] = imported.file.generic_string();
  return answer;
}

}  // namespace tunica::app::studio
