// SPDX-License-Identifier: Apache-2.0
#include "exporting/fitted_material.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/nearest.hpp"
#include "execution/files.hpp"
#include "exporting/remarks.hpp"
#include "report/pieces.hpp"
#include "text/escaped.hpp"
#include "text/lists.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::exporting {

namespace {

using report::Json;
using report::list;
using report::member;
using report::word;

Json document(const std::filesystem::path& file) {
  try {
    return detail::parse_json<Json>(execution::read_text(file));
  } catch (const Json::exception& problem) {
    throw InputError(
        fmt::format("{}: is not JSON ({}); run it again", file.string(), text::json_problem(problem.what())));
  }
}

/// Groups of runs have objectives that cannot be compared, so that none of them has the best run.
void refuse_incomparable(const Json& result, const std::string& file) {
  std::vector<std::string> groups, first;
  for (const Json& entry : list(result, "ranking")) {
    if (!member(entry, "rank").is_number() ||
        std::find(groups.begin(), groups.end(), word(entry, "group")) != groups.end())
      continue;
    groups.push_back(word(entry, "group"));
    first.push_back(word(entry, "run"));
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
  for (const Json& entry : list(result, "ranking"))
    for (const Json& run : list(result, "runs")) {
      if (word(run, "run") != word(entry, "run") || !member(run, "best").is_object()) continue;
      if (wanted.empty() || word(run, "run") == wanted) return run;
      known.insert(known.end(), word(run, "run"));
    }
  if (known.empty())
    throw InputError(
        fmt::format("{}: no run has a result to export; name the folder of a finished `tunica run`", file));
  throw InputError(
      fmt::format("{}: no run '{}' has a result in it. {}", file, wanted, data::suggestion(wanted, known)));
}

/// The models of a run: a run of layers joins their names with '+'.
std::vector<std::string> models_of(const Json& run, const Json& models) {
  const std::string joined = word(run, "model");
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

/// "mu" for the model's parameter "media.mu"; "" for one of a test or of another model.
std::string own_name(const std::string& parameter, const std::string& model, bool several) {
  if (!several) return parameter.find('.') == std::string::npos ? parameter : "";
  return parameter.starts_with(model + '.') ? parameter.substr(model.size() + 1) : "";
}

}  // namespace

FittedMaterial fitted_material(const ExportRequest& request) {
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
  fitted.run = word(run, "run");
  const Json& models = member(input, "models");
  const auto names = models_of(run, models);
  fitted.name = chosen_model(names, request.model, fitted.run, file);
  const Json& model = member(models, fitted.name);
  bool compressible = false;
  for (const Json& mechanism : list(model, "mechanisms")) {
    const std::string id = mechanism.is_string() ? mechanism.get<std::string>() : word(mechanism, "type");
    const bool isochoric = !mechanism.is_string() && word(mechanism, "invariants") == "isochoric";
    compressible = id == "compressibility" && isochoric;
    if (id == "compressibility" && !compressible)
      throw InputError(fmt::format(
          "{}: the mechanism 'compressibility' of the model '{}' has full invariants, and the cards' materials "
          "have isochoric ones; fit it with \"invariants\": \"isochoric\" and the \"law\" of the program: "
          "\"logarithmic\" for "
          "FEBio, else \"quadratic\"",
          file, fitted.name));
    if (!compressible)
      throw InputError(fmt::format(
          "{}: the mechanism '{}' changes the model '{}', and no card has it; fit and export a model without "
          "it, or one that contains it",
          file, id, fitted.name));
    const std::string law = word(mechanism, "law");
    fitted.material.volume_law = law.empty() ? "logarithmic" : law;
  }
  fitted.material.type = word(model, "type");
  if (const std::string chosen = word(model, "fibre_switch"); !chosen.empty()) fitted.material.fibre_switch = chosen;
  Parameters parameters;
  for (const Json& group : {member(member(run, "best"), "parameters"), member(run, "fixed")})
    for (const auto& [name, entry] : group.items())
      if (compressible && name.ends_with("compressibility.compliance")) {
        const double compliance = report::number(entry, "value");
        fitted.material.bulk = compliance > 0 ? 1 / compliance : 0;
        parameters.emplace_back("compressibility.compliance", entry);
      } else if (const std::string own = own_name(name, fitted.name, names.size() > 1); !own.empty()) {
        fitted.material.values[own] = report::number(entry, "value");
        parameters.emplace_back(own, entry);
      }
  fitted.remarks = remarks({folder, result, run, fitted.name, fitted.material.type, parameters});
  return fitted;
}

}  // namespace tunica::exporting
