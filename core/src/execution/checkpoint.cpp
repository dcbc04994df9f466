// SPDX-License-Identifier: Apache-2.0
#include "execution/checkpoint.hpp"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/sha256.hpp"
#include "execution/checksum.hpp"
#include "execution/files.hpp"
#include "text/escaped.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/detail/vector_level.hpp"
#include "tunica/error.hpp"
#include "tunica/plugin.hpp"

namespace tunica::execution {

namespace {

using nlohmann::json;

constexpr int checkpoint_format = 6;

std::filesystem::path checkpoint_file(const std::filesystem::path& directory) { return directory / "checkpoint.json"; }

json to_json(std::size_t task, const RealisationResult& result) {
  json evaluations = json::array(), objectives = json::array();
  for (const auto& improvement : result.trace) {
    evaluations.push_back(improvement.evaluations);
    objectives.push_back(improvement.objective);
  }
  json stops = json::array();
  for (const auto& one : result.tally.bound_stops)
    stops.push_back(
        {{"parameter", one.parameter}, {"upper", one.upper}, {"count", one.count}, {"objective", one.objective}});
  json reasons = json::array();
  for (const auto& kind : result.tally.reasons) reasons.push_back({{"example", kind.example}, {"count", kind.count}});
  return {{"task", task},
          {"realisation", result.realisation},
          {"best",
           {{"parameters", result.best.parameters},
            {"objective", result.best.objective},
            {"index", result.best.index},
            {"violation", result.best.violation}}},
          {"trace", {{"evaluations", std::move(evaluations)}, {"objectives", std::move(objectives)}}},
          {"evaluations", result.tally.evaluations},
          {"jacobians", result.tally.jacobians},
          {"failures", result.tally.failures},
          {"infeasible", result.tally.infeasible},
          {"ended_early", result.tally.ended_early},
          {"simulated", result.tally.simulated},
          {"guide_evaluations", result.tally.guide_evaluations},
          {"starts", result.tally.starts},
          {"bound_stops", std::move(stops)},
          {"first_failure", result.tally.first_failure},
          {"failure_reasons", std::move(reasons)},
          {"converged", result.converged},
          {"reason", result.reason},
          {"stop_reason", search::code(result.stopped_by)},
          {"stop_sentence", result.stop_sentence},
          {"seconds", result.seconds}};
}

RealisationResult from_json(const json& entry) {
  RealisationResult result;
  result.realisation = entry.at("realisation");
  result.finished = true;
  result.best.parameters = entry.at("best").at("parameters").get<std::vector<double>>();
  result.best.objective = entry.at("best").at("objective");
  result.best.index = entry.at("best").at("index");
  result.best.violation = entry.at("best").at("violation");
  const auto& trace = entry.at("trace");
  for (std::size_t k = 0; k < trace.at("evaluations").size(); ++k)
    result.trace.push_back({trace.at("evaluations").at(k), trace.at("objectives").at(k)});
  result.tally.evaluations = entry.at("evaluations");
  result.tally.jacobians = entry.at("jacobians");
  result.tally.failures = entry.at("failures");
  result.tally.infeasible = entry.at("infeasible");
  result.tally.ended_early = entry.at("ended_early");
  result.tally.simulated = entry.at("simulated");
  result.tally.guide_evaluations = entry.at("guide_evaluations");
  result.tally.first_failure = entry.at("first_failure");
  for (const auto& kind : entry.value("failure_reasons", json::array()))
    result.tally.reasons.push_back({kind.at("example"), kind.at("count")});
  result.tally.starts = entry.value("starts", std::uint64_t{0});
  for (const auto& one : entry.value("bound_stops", json::array()))
    result.tally.bound_stops.push_back({one.at("parameter"), one.at("upper"), one.at("count"), one.at("objective")});
  result.converged = entry.at("converged");
  result.reason = entry.at("reason");
  const std::string code = entry.at("stop_reason");
  const auto stopped_by = search::stop_reason_from_code(code);
  if (!stopped_by)
    throw InputError(
        fmt::format("checkpoint.json: the stop reason '{}' is not known; start anew with another -o", code));
  result.stopped_by = *stopped_by;
  result.stop_sentence = entry.at("stop_sentence");
  result.seconds = entry.at("seconds");
  return result;
}

json to_json(const Facts& facts) {
  return {{"experiment", facts.experiment},
          {"seed", facts.seed},
          {"data", facts.data},
          {"plugins", facts.plugins},
          {"plugin_interface", facts.plugin_interface},
          {"thinned", facts.thinned},
          {"vector_level", facts.vector_level}};
}

Facts facts_from(const json& entry) {
  return {entry.at("experiment"),
          entry.at("seed"),
          entry.at("data").get<std::map<std::string, std::string>>(),
          entry.at("plugins"),
          entry.at("plugin_interface"),
          entry.at("thinned"),
          entry.at("vector_level")};
}

/// The keys that differ between input.json and the experiment as it is now: "/stop/max_evaluations (was 60000, is
/// 90000)".
std::vector<std::string> changed_keys(const std::filesystem::path& directory, const std::string& input_json) {
  std::vector<std::string> keys;
  const json then = detail::parse_json<json>(read_text(directory / "input.json"), false);
  const json now = detail::parse_json<json>(input_json, false);
  if (then.is_discarded() || now.is_discarded()) return keys;
  for (const auto& change : json::diff(then, now)) {
    const std::string path = change.at("path");
    const json::json_pointer pointer(path);
    const std::string was = then.contains(pointer) ? then.at(pointer).dump() : "absent";
    const std::string is = now.contains(pointer) ? now.at(pointer).dump() : "absent";
    if (was.size() + is.size() < 60)
      keys.push_back(fmt::format("{} (was {}, is {})", path, was, is));
    else
      keys.push_back(path);
  }
  return keys;
}

/// The experiment without its analysis. The analysis changes no evaluation, so a resumed run may request another one.
std::string without_analysis(const std::string& input_json) {
  json input = detail::parse_json<json>(input_json, false);
  if (input.is_discarded()) return input_json;
  input.erase("analysis");
  input.erase("keep_evaluations");  // after the search
  return input.dump();
}

}  // namespace

Facts facts_of(const Plan& plan) {
  Facts facts;
  const auto& experiment = *plan.experiment;
  facts.experiment = data::sha256(without_analysis(experiment.input_json));
  facts.seed = fmt::format("{}", experiment.seed);
  for (const auto& run : plan.runs) {
    for (const auto& hash : run.assembly->layout().data_hashes) {
      const auto space = hash.rfind(' ');
      auto& known = facts.data[hash.substr(0, space)];
      const std::string digest = space == std::string::npos ? hash : hash.substr(space + 1);
      // Files with one name in several folders share an entry.
      if (known.find(digest) == std::string::npos) known += known.empty() ? digest : ' ' + digest;
    }
  }
  facts.plugins = fmt::format("{}", fmt::join(plan.plugins, ", "));
  facts.plugin_interface = fmt::format("{}", TUNICA_PLUGIN_API);
  facts.vector_level = detail::name(detail::vector_level());
  return facts;
}

std::string checkpoint_entry(std::size_t task, const RealisationResult& result) {
  return sealed(to_json(task, result)).dump(-1, ' ', false, json::error_handler_t::replace);
}

void write_checkpoint(const std::filesystem::path& directory, const Facts& facts,
                      const std::map<std::size_t, std::string>& entries) {
  std::string text = fmt::format("{{\n\"format\": {},\n\"facts\": {},\n\"finished\": [", checkpoint_format,
                                 sealed(to_json(facts)).dump(1, ' ', false, json::error_handler_t::replace));
  for (const auto& [task, entry] : entries) text.append(text.back() == '[' ? "\n" : ",\n").append(entry);
  write_atomically(checkpoint_file(directory), text + "\n]\n}\n");
}

void write_checkpoint(const std::filesystem::path& directory, const Checkpoint& checkpoint) {
  std::map<std::size_t, std::string> entries;
  for (const auto& [task, result] : checkpoint.finished) entries[task] = checkpoint_entry(task, result);
  write_checkpoint(directory, checkpoint.facts, entries);
}

Checkpoint read_checkpoint(const std::filesystem::path& directory) {
  const auto file = checkpoint_file(directory);
  if (!std::filesystem::exists(file))
    throw InputError(
        fmt::format("{}: there is no checkpoint.json, so no run to resume; leave out --resume, or name the "
                    "folder of an interrupted run with -o",
                    directory.string()));
  try {
    const json document = detail::parse_json<json>(read_text(file));
    if (document.at("format") != checkpoint_format)
      throw InputError(
          fmt::format("{}: format {}, this version of tunica reads {}; resume with the version that wrote it",
                      file.string(), document.at("format").dump(), checkpoint_format));
    if (!intact(document.at("facts")))
      throw InputError(
          fmt::format("{}: \"facts\" is not what was written; its checksum does not fit. Use a copy of the file, "
                      "or start anew with another -o",
                      file.string()));
    Checkpoint checkpoint;
    checkpoint.facts = facts_from(document.at("facts"));
    for (const auto& entry : document.at("finished"))
      if (intact(entry))
        checkpoint.finished.emplace_back(entry.at("task").get<std::size_t>(), from_json(entry));
      else
        checkpoint.damages.push_back(
            fmt::format("{}: entry {} of \"finished\" is not what was written; its checksum does not fit. That search "
                        "is made again from evaluations.csv",
                        file.string(), checkpoint.finished.size() + checkpoint.damages.size() + 1));
    return checkpoint;
  } catch (const json::exception& problem) {
    throw InputError(fmt::format("{}: cannot be understood ({}); start anew with another -o", file.string(),
                                 text::json_problem(problem.what())));
  }
}

void refuse_changes(const std::filesystem::path& directory, const Facts& then, const Facts& now,
                    const std::string& input_json) {
  std::vector<std::string> changes;
  const auto compare = [&](const std::string& what, const std::string& was, const std::string& is) {
    if (was != is) changes.push_back(fmt::format("{} changed (was {}, is {})", what, was, is));
  };
  if (then.experiment != now.experiment)
    changes.push_back(
        fmt::format("the experiment file changed: {}", fmt::join(changed_keys(directory, input_json), ", ")));
  compare("the seed", then.seed, now.seed);
  for (const auto& [file, hash] : now.data) {
    const auto before = then.data.find(file);
    if (before == then.data.end())
      changes.push_back(fmt::format("the data {} are new", file));
    else
      compare("the data " + file, before->second, hash);
  }
  for (const auto& [file, hash] : then.data)
    if (!now.data.contains(file)) changes.push_back(fmt::format("the data {} are gone", file));
  compare("the plugins", then.plugins, now.plugins);
  compare("the plugin interface of tunica", then.plugin_interface, now.plugin_interface);
  if (changes.empty()) return;
  throw InputError(
      fmt::format("{}: cannot be resumed, because something changed since the run began:\n  {}\n"
                  "Put it back as it was, or start anew: leave out --resume and name another folder with -o",
                  directory.string(), fmt::join(changes, "\n  ")));
}

std::string vector_level_of(const std::filesystem::path& directory) {
  try {
    return read_checkpoint(directory).facts.vector_level;
  } catch (const InputError&) {  // said where the run is resumed
    return {};
  }
}

void refuse_other_level(const std::filesystem::path& directory, const std::string& then, const std::string& now) {
  if (then == now) return;
  const auto level = detail::vector_level_called(then.c_str());
  const bool here = level && *level <= detail::best_vector_level();
  throw InputError(fmt::format(
      "{}: cannot be resumed with the vector instructions '{}', because its searches were begun with '{}': the last "
      "digits of every evaluation depend on them. {}",
      directory.string(), now, then,
      here ? fmt::format("Set {}={}", detail::vector_level_variable, then)
           : fmt::format("This processor does not have them: go on where they are, or start anew. {}={} from the "
                         "beginning lets all of these machines work on one run",
                         detail::vector_level_variable, now)));
}

}  // namespace tunica::execution
