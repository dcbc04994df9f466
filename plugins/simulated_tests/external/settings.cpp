// SPDX-License-Identifier: Apache-2.0
#include "settings.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "cache.hpp"
#include "program.hpp"

namespace tunica::external {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Json json_of(const Options& options, const char* name) { return Json::parse(options.text(name)); }

std::string read_file(const fs::path& file, const std::string& what) {
  std::error_code error;
  const bool regular = fs::is_regular_file(file, error);  // to open a pipe would wait for its other end
  std::ifstream stream;
  if (regular) stream.open(file, std::ios::binary);
  if (!regular || !stream)
    throw InputError(
        fmt::format("{} names '{}', which cannot be read; correct the name, which begins at the folder of "
                    "the experiment file",
                    what, file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The content of the program and of what it is given by its absolute name: a script, an input file.
std::string content_of(const fs::path& file) { return digest(read_file(file, "\"command\"")); }

void read_command(const TestSetup& setup, Settings& settings) {
  const Json words = json_of(setup.options, "command");
  const bool list = words.is_array() && !words.empty() &&
                    std::ranges::all_of(words, [](const Json& word) { return word.is_string(); });
  if (!list) throw InputError(R"("command" is a list of texts, the program and its arguments: ["ccx", "strip"])");
  settings.program = program_file(words.front().get<std::string>(), setup.folder);
  settings.content += fmt::format("program {} {}\n", settings.program.string(), content_of(settings.program));
  for (std::size_t k = 1; k < words.size(); ++k) {
    const auto word = words[k].get<std::string>();
    settings.arguments.emplace_back(word);
    if (fs::path(word).is_absolute() && fs::is_regular_file(word))
      settings.content += fmt::format("file {} {}\n", word, content_of(word));
  }
}

void read_templates(const TestSetup& setup, Settings& settings) {
  const Json named = json_of(setup.options, "templates");
  if (!named.is_object())
    throw InputError(R"("templates" is an object: {"name in the scratch folder": "template file"})");
  for (const auto& [name, file] : named.items()) {
    if (!file.is_string()) throw InputError(fmt::format("\"templates\": '{}' is not given the name of a file", name));
    const std::string text = read_file(fs::path(setup.folder) / file.get<std::string>(), "\"templates\"");
    settings.templates.emplace_back(checked_name(name, "templates"), TextTemplate(text));
    settings.content += fmt::format("template {} {}\n", name, digest(text));
  }
}

void read_files(const TestSetup& setup, Settings& settings) {
  const Json names = json_of(setup.options, "files");
  if (!names.is_array()) throw InputError(R"("files" is a list of names: ["mesh.inp"])");
  for (const Json& name : names) {
    if (!name.is_string()) throw InputError(R"("files" is a list of names: ["mesh.inp"])");
    const fs::path file = fs::path(setup.folder) / name.get<std::string>();
    const std::string text = read_file(file, "\"files\"");
    settings.files.emplace_back(file.filename().string(), file);
    settings.content += fmt::format("file {} {}\n", file.filename().string(), digest(text));
  }
}

/// Everything in the scratch folder has a unique name.
void check_names(const Settings& settings) {
  std::set<std::string> names{printed};
  const auto add = [&](const std::string& name, const char* option) {
    if (!names.insert(fs::path(name).lexically_normal().string()).second)
      throw InputError(
          name == printed
              ? fmt::format("\"{}\" names '{}', which takes what the program prints; give another name", option, name)
              : fmt::format("\"{}\" names '{}', and another template or file has that name in the scratch "
                            "folder; give each its own",
                            option, name));
  };
  for (const auto& [name, file] : settings.files) add(name, "files");
  for (const auto& [name, text] : settings.templates) add(name, "templates");
}

void read_places(Settings& settings) {
  const auto visit = [&](const TextTemplate& text) {
    for (const TextTemplate::Place& place : text.places()) {
      if (place.name == "card") {
        settings.card = true;
      } else if (place.name != "rows" && std::ranges::find(settings.reads, place.name) == settings.reads.end()) {
        settings.reads.push_back(place.name);
      }
    }
  };
  for (const TextTemplate& argument : settings.arguments) visit(argument);
  for (const auto& [name, text] : settings.templates) visit(text);
  if (settings.reads.empty() && !settings.card)
    throw InputError(
        "neither \"command\" nor a template has a place for a parameter, so that the solver would not "
        "depend on any; write {{mu}} or {{card}} where it belongs");
}

void read_card(const TestSetup& setup, Settings& settings) {
  const Json card = json_of(setup.options, "card");
  if (!card.is_object()) throw InputError(R"("card" is an object: {"program": "calculix", "units": "mm-N-MPa"})");
  for (const auto& [key, value] : card.items())
    if ((key != "program" && key != "units" && key != "material") || !value.is_string())
      throw InputError(fmt::format(R"("card": '{}' is none of the texts "program", "units" and "material")", key));
  if (settings.card && !setup.card)
    throw InputError("a template asks for {{card}}, and this tunica writes no cards; write the parameters by name");
  if (settings.card && !card.contains("program"))
    throw InputError(R"(a template asks for {{card}}; say for which program: "card": {"program": "calculix"})");
  settings.card_request = {card.value("program", ""), card.value("units", "mm-N-MPa"),
                           card.value("material", "TISSUE")};
}

}  // namespace

const std::string& checked_name(const std::string& name, const char* option) {
  const fs::path path(name);
  if (name.empty() || path.is_absolute() || std::ranges::find(path, fs::path("..")) != path.end())
    throw InputError(
        fmt::format("\"{}\" names '{}' in the scratch folder; give a relative name without '..'", option, name));
  return name;
}

/// At most a year, which every clock can count.
static Option time_limit() {
  Option option = Option::quantity("time_limit", "s", 0.001,
                                   "Longest time of a run; then it is ended, and the evaluation fails.", 600.0);
  option.max = 3e7;
  return option;
}

std::vector<Option> options() {
  return {
      Option::json("command", {}, "List of the program and its arguments; {{name}} is a parameter there too."),
      Option::json("templates", "{}",
                   "Object: name in the scratch folder to a template, in which {{mu}}, {{mu MPa}}, {{card}} "
                   "and {{rows}} are filled in."),
      Option::json("files", "[]", "List of other files that the solver reads; each is linked into the scratch folder."),
      Option::json("results", {},
                   "Object: observable to the file and the column, JSON pointer or pattern of its numbers."),
      Option::json("card", "{}", "Object: \"program\", \"units\" and \"material\" of {{card}}."),
      time_limit(),
      Option::integer("memory_limit", 0, {0, 1e7}, "Largest memory of a run in MiB; 0 sets no limit."),
      Option::integer("output_limit", 1024, {0, 1e7}, "Largest file that a run may write in MiB; 0 sets no limit."),
      Option::integer("threads", 1, {1, 1024}, "Threads of a run, given to it as OMP_NUM_THREADS."),
      Option::choice("derivatives", {"broyden", "forward", "central"}, "broyden",
                     "Differences of one or two runs a parameter; Broyden's update goes on with forward ones."),
      Option::number("difference_step", 1e-3, {1e-8, 0.1}, "Relative step of the differences."),
      Option::choice("keep", {"never", "on_failure", "always"}, "on_failure",
                     "Which scratch folders stay; of failed runs the first three."),
      Option::text("folder", "", "Where names of files begin; relative to the folder of the experiment file."),
      Option::text("scratch", "", "Folder for scratch folders; empty = that of the system."),
      Option::text("cache", "",
                   "Folder that keeps results by the content of what the solver read; empty = memory only."),
  };
}

Settings read_settings(const TestSetup& setup, const std::vector<Observable>& observables) {
  Settings settings;
  read_command(setup, settings);
  read_templates(setup, settings);
  read_files(setup, settings);
  check_names(settings);
  read_places(settings);
  read_card(setup, settings);
  read_results(setup, observables, settings);
  const Options& options = setup.options;
  settings.time_limit = options.number("time_limit");
  settings.memory_limit = options.count("memory_limit");
  settings.output_limit = options.count("output_limit");
  settings.threads = options.count("threads");
  settings.keep = options.text("keep") == "never"    ? Keep::never
                  : options.text("keep") == "always" ? Keep::always
                                                     : Keep::on_failure;
  const auto folder = [&](const char* name) {
    const std::string& text = options.text(name);
    return text.empty() ? fs::path() : (fs::path(setup.folder) / text).lexically_normal();
  };
  settings.scratch = folder("scratch");
  if (settings.scratch.empty()) settings.scratch = fs::temp_directory_path();
  settings.cache = folder("cache");
  settings.content += fmt::format("results {}\n", options.text("results"));
  for (const ResultPlace& place : settings.results) settings.content += fmt::format("column {}\n", place.observable);
  settings.interrupted = setup.interrupted;
  return settings;
}

}  // namespace tunica::external
