// SPDX-License-Identifier: Apache-2.0
#include "exporting/fitted_material.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/nearest.hpp"
#include "execution/files.hpp"
#include "experiment/json_document.hpp"
#include "experiment/reader.hpp"
#include "exporting/remarks.hpp"
#include "plugins/guarded.hpp"
#include "results/keys.hpp"
#include "results/reading.hpp"
#include "text/escaped.hpp"
#include "text/lists.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::exporting {

namespace {

namespace key = results::key;
using results::Json;
using results::list;
using results::member;
using results::word;

Json document(const std::filesystem::path& file) {
  try {
    return detail::parse_json<Json>(execution::read_text(file));
  } catch (const Json::exception& problem) {
    throw InputError(
        fmt::format("{}: is not JSON ({}); run it again", file.string(), text::json_problem(problem.what())));
  }
}

/// Groups of runs have objectives that are not comparable, so no run is the best overall.
void refuse_incomparable(const Json& result, const std::string& file) {
  std::vector<std::string> groups, first;
  for (const Json& entry : list(result, key::ranking)) {
    if (!member(entry, key::rank).is_number() ||
        std::find(groups.begin(), groups.end(), word(entry, key::group)) != groups.end())
      continue;
    groups.push_back(word(entry, key::group));
    first.push_back(word(entry, key::run));
  }
  if (groups.size() > 1)
    throw InputError(fmt::format(
        "{}: its runs differ in objective or tests, so that none is the best of all; choose with --run, for example {}",
        file, text::joined(first)));
}

/// The run that is asked for, or the best-ranked one with a result.
const Json& chosen_run(const Json& result, const std::string& wanted, const std::string& file) {
  if (wanted.empty()) refuse_incomparable(result, file);
  std::vector<std::string> known;
  for (const Json& entry : list(result, key::ranking))
    for (const Json& run : list(result, key::runs)) {
      if (word(run, key::run) != word(entry, key::run) || !member(run, key::best).is_object()) continue;
      if (wanted.empty() || word(run, key::run) == wanted) return run;
      known.insert(known.end(), word(run, key::run));
    }
  if (known.empty())
    throw InputError(
        fmt::format("{}: no run has a result to export; name the folder of a finished `tunica run`", file));
  throw InputError(
      fmt::format("{}: no run '{}' has a result in it. {}", file, wanted, data::suggestion(wanted, known)));
}

/// The models of a run: a run of layers joins their names with '+'.
std::vector<std::string> models_of(const Json& run, const Json& models) {
  const std::string joined = word(run, key::model);
  if (models.contains(joined)) return {joined};
  std::vector<std::string> parts;
  std::istringstream stream(joined);
  for (std::string part; std::getline(stream, part, '+');)
    if (models.contains(part)) parts.insert(parts.end(), part);
  return parts;
}

std::string chosen_model(const std::vector<std::string>& models, const std::string& wanted, const std::string& run,
                         const std::string& file) {
  if (models.empty())
    throw InputError(fmt::format(
        "{}: run '{}': input.json beside it has not its model; name the folder as `tunica run` wrote it", file, run));
  if (wanted.empty() && models.size() == 1) return models.front();
  if (wanted.empty())
    throw InputError(fmt::format("{}: run '{}' has several models, and a card has one; choose with --model: {}", file,
                                 run, text::joined(models)));
  if (std::find(models.begin(), models.end(), wanted) == models.end())
    throw InputError(
        fmt::format("{}: run '{}' has no model '{}'. {}", file, run, wanted, data::suggestion(wanted, models)));
  return wanted;
}

experiment::ModelEntry model_entry(const std::filesystem::path& input, const std::string& name,
                                   const plugins::Catalogue& catalogue) {
  const experiment::JsonDocument document(input, execution::read_text(input));
  std::vector<experiment::SharedParameter> shared;
  return experiment::read_model(name, experiment::Node(document).require("models", "an experiment").require(name, ""),
                                catalogue, shared);
}

/// The model's parameters by their own names, then those of its mechanisms, as cards::material_of() takes them. A
/// shared one is in the result under the name of the share.
Parameters own_parameters(const experiment::ModelEntry& model, const plugins::Catalogue& catalogue, const Json& run,
                          bool several) {
  const std::string prefix = several ? model.name + '.' : "";
  Parameters parameters;
  const auto add = [&](const std::string& name, const experiment::ParameterSettings& settings, const std::string& own) {
    const auto setting = settings.find(own);
    const bool shared = setting != settings.end() && setting->second.share;
    const std::string wanted = shared ? *setting->second.share : prefix + name;
    for (const Json& group : {member(member(run, key::best), key::parameters), member(run, key::fixed)})
      if (group.contains(wanted) && std::isfinite(results::number(group.at(wanted), key::value))) {
        parameters.emplace_back(name, group.at(wanted));
        return;
      }
    throw InputError(fmt::format(
        "model '{}': the result has no finite value for '{}', as it is where every state of the specimen has "
        "its own; give a result without states",
        model.name, wanted));
  };
  const auto made = plugins::create(catalogue.models().find(model.type)->second, model.options);
  for (const Parameter& parameter : made->describe().parameters) add(parameter.name, model.parameters, parameter.name);
  for (const auto& mechanism : model.mechanisms)
    for (const Parameter& parameter :
         catalogue.mechanisms().find(mechanism.type)->second.factory.parameters_with(mechanism.options))
      add(mechanism.name() + '.' + parameter.name, mechanism.parameters, parameter.name);
  return parameters;
}

}  // namespace

FittedMaterial fitted_material(const ExportRequest& request, const plugins::Catalogue& catalogue) {
  std::filesystem::path folder = request.result;
  if (!std::filesystem::is_directory(folder)) {
    if (folder.filename() != "result.json" || !std::filesystem::exists(folder))
      throw InputError(fmt::format("{}: no such folder and no result.json; name a folder that `tunica run` has written",
                                   request.result.string()));
    folder = folder.has_parent_path() ? folder.parent_path() : ".";
  }
  for (const char* const needed : {"result.json", "input.json"})
    if (!std::filesystem::exists(folder / needed))
      throw InputError(
          fmt::format("{}: there is no {}; name the folder of a finished `tunica run`", folder.string(), needed));
  const Json result = document(folder / "result.json"), input = document(folder / "input.json");
  const std::string file = (folder / "result.json").string();

  const Json& run = chosen_run(result, request.run, file);
  FittedMaterial fitted;
  fitted.run = word(run, key::run);
  const Json& models = member(input, key::models);
  const auto names = models_of(run, models);
  fitted.name = chosen_model(names, request.model, fitted.run, file);
  const experiment::ModelEntry model = model_entry(folder / "input.json", fitted.name, catalogue);
  std::vector<cards::Ingredient> mechanisms;
  for (const auto& mechanism : model.mechanisms) mechanisms.push_back({mechanism.type, mechanism.options});
  Parameters parameters;
  try {
    parameters = own_parameters(model, catalogue, run, names.size() > 1);
    std::vector<double> values;
    for (const auto& [name, entry] : parameters) values.push_back(results::number(entry, key::value));
    fitted.material = cards::material_of(catalogue, {model.type, model.options}, mechanisms, values);
  } catch (const InputError& problem) {
    throw InputError(fmt::format("{}: {}", file, problem.what()));
  }
  fitted.remarks = remarks({folder, result, run, fitted.name, fitted.material.type, parameters});
  return fitted;
}

}  // namespace tunica::exporting
