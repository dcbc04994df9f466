// SPDX-License-Identifier: Apache-2.0
#include "settings.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "cache.hpp"
#include "process.hpp"

namespace tunica::external {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* result_forms =
    "one of {\"file\": \"out.csv\", \"column\": \"force\"}, {\"file\": \"out.json\", \"pointer\": \"/force\"} and "
    "{\"file\": \"out.txt\", \"pattern\": \"F = (\\\\S+)\"}, with \"unit\", \"factor\" and \"start\" if needed";

Json json_of(const Options& options, const char* name) { return Json::parse(options.text(name)); }

std::string read_file(const fs::path& file, const std::string& what) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || fs::is_directory(file))
    throw InputError(
        fmt::format("{} names '{}', which cannot be read; correct the name, which begins at the folder of "
                    "the experiment file",
                    what, file.string()));
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A name that stays below the scratch folder.
const std::string& checked_name(const std::string& name, const char* option) {
  const fs::path path(name);
  if (name.empty() || path.is_absolute() || std::ranges::find(path, fs::path("..")) != path.end())
    throw InputError(
        fmt::format("\"{}\" names '{}' in the scratch folder; give a relative name without '..'", option, name));
  return name;
}

void read_command(const TestSetup& setup, Settings& settings) {
  const Json words = json_of(setup.options, "command");
  const bool list = words.is_array() && !words.empty() &&
                    std::ranges::all_of(words, [](const Json& word) { return word.is_string(); });
  if (!list) throw InputError(R"("command" is a list of texts, the program and its arguments: ["ccx", "strip"])");
  settings.program = program_file(words.front().get<std::string>(), setup.folder);
  for (std::size_t k = 1; k < words.size(); ++k) settings.arguments.emplace_back(words[k].get<std::string>());
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

double factor_of(const Json& entry, const Observable& observable, const TestSetup& setup, const std::string& where) {
  const Json unit = entry.value("unit", Json(observable.unit)), factor = entry.value("factor", Json(1));
  if (!unit.is_string() || !factor.is_number())
    throw InputError(fmt::format("{}: \"unit\" is a text and \"factor\" a number", where));
  if (!setup.unit_factor && unit != observable.unit)
    throw InputError(fmt::format("{}: this host converts no units; use \"factor\"", where));
  return factor.get<double>() *
         (unit == observable.unit ? 1 : setup.unit_factor(unit.get<std::string>(), observable.unit));
}

ResultPlace result_of(const Json& entry, const Observable& observable, const TestSetup& setup) {
  const std::string where = fmt::format("\"results\": '{}'", observable.name);
  ResultPlace place;
  place.observable = observable.name;
  int forms = 0;
  if (!entry.is_object()) throw InputError(fmt::format("{} is {}", where, result_forms));
  for (const auto& [key, value] : entry.items()) {
    const bool form = key == "column" || key == "pointer" || key == "pattern";
    if (!form && key != "file" && key != "unit" && key != "factor" && key != "start")
      throw InputError(fmt::format("{}: the key '{}' is unknown; write {}", where, key, result_forms));
    if (!form) continue;
    ++forms;
    place.kind = key == "column"    ? ResultPlace::Kind::column
                 : key == "pointer" ? ResultPlace::Kind::pointer
                                    : ResultPlace::Kind::pattern;
    if (!value.is_string() && !(key == "column" && value.is_number_unsigned()))
      throw InputError(fmt::format("{}: \"{}\" is a text", where, key));
    place.text = value.is_string() ? value.get<std::string>() : value.dump();
  }
  if (forms != 1 || !entry.contains("file") || !entry["file"].is_string())
    throw InputError(fmt::format("{} does not say where; write {}", where, result_forms));
  place.file = entry["file"] == "-" ? "-" : checked_name(entry["file"].get<std::string>(), "results");
  place.factor = factor_of(entry, observable, setup, where);
  if (const auto start = entry.find("start"); start != entry.end()) {
    if (!start->is_number()) throw InputError(fmt::format("{}: \"start\" is a number", where));
    place.start = {start->get<double>()};
  }
  try {
    if (place.kind == ResultPlace::Kind::pointer) (void)Json::json_pointer(place.text);
    if (place.kind == ResultPlace::Kind::pattern && std::regex(place.text).mark_count() < 1)
      throw InputError(fmt::format("{}: the pattern has no group; put the number into round brackets", where));
  } catch (const Json::exception&) {
    throw InputError(fmt::format("{}: '{}' is no JSON pointer; write \"/results/force\"", where, place.text));
  } catch (const std::regex_error& problem) {
    throw InputError(fmt::format("{}: the pattern is no regular expression (ECMAScript): {}", where, problem.what()));
  }
  return place;
}

void read_results(const TestSetup& setup, const std::vector<Observable>& observables, Settings& settings) {
  const Json results = json_of(setup.options, "results");
  if (!results.is_object()) throw InputError("\"results\" is an object: {\"force\": {…}}");
  const auto declared = [&](const std::string& name) {
    return std::ranges::find(observables, name, &Observable::name);
  };
  std::vector<std::string> mapped;
  for (const auto& column : setup.rows.abscissae) mapped.push_back(column.observable);
  for (const auto& [name, entry] : results.items()) {
    if (declared(name) == observables.end()) {
      std::vector<std::string> names;
      for (const Observable& observable : observables) names.push_back(observable.name);
      throw InputError(
          fmt::format("\"results\": there is no observable '{}'; there are {}", name, fmt::join(names, ", ")));
    }
    if (declared(name)->role != Observable::Role::abscissa) continue;
    if (std::ranges::find(mapped, name) == mapped.end())
      throw InputError(fmt::format("\"results\": '{}' is an abscissa, and \"columns\" maps no column to it", name));
    if (settings.curve)
      throw InputError("\"results\" name two abscissae; a curve is read between its points over one of them");
    settings.curve = true;
    settings.results.push_back(result_of(entry, *declared(name), setup));
  }
  for (const std::string& channel : setup.rows.channels) {
    if (!results.contains(channel))
      throw InputError(
          fmt::format("\"results\" do not say where the solver writes '{}', which \"columns\" maps; add {}", channel,
                      result_forms));
    settings.results.push_back(result_of(results[channel], *declared(channel), setup));
  }
}

}  // namespace

std::vector<Option> options() {
  const auto json = [](std::string name, std::optional<std::string> fallback, std::string doc) {
    Option option{std::move(name), Option::Kind::json, {}, std::move(doc)};
    if (fallback) option.fallback = std::move(*fallback);
    return option;
  };
  return {
      json("command", {}, "List of the program and its arguments; {{name}} is a parameter there too."),
      json("templates", "{}",
           "Object: name in the scratch folder to a template, in which {{mu}}, {{mu MPa}}, {{card}} "
           "and {{rows}} are filled in."),
      json("files", "[]", "List of other files that the solver reads; each is linked into the scratch folder."),
      json("results", {}, "Object: observable to the file and the column, JSON pointer or pattern of its numbers."),
      json("card", "{}", "Object: \"program\", \"units\" and \"material\" of {{card}}."),
      Option::quantity("time_limit", "s", 0.001, "Longest time of a run; then it is ended, and the evaluation fails.",
                       600.0),
      Option::integer("memory_limit", 0, {0, 1e7}, "Largest memory of a run in MiB; 0 sets no limit."),
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
  read_places(settings);
  read_card(setup, settings);
  read_results(setup, observables, settings);
  const Options& options = setup.options;
  settings.time_limit = options.number("time_limit");
  settings.memory_limit = options.count("memory_limit");
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
  settings.content += fmt::format("program {}\nresults {}\n", settings.program.string(), options.text("results"));
  return settings;
}

}  // namespace tunica::external
