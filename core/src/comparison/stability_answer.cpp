// SPDX-License-Identifier: Apache-2.0
#include "comparison/stability_answer.hpp"

#include <algorithm>

#include "comparison/stability_map.hpp"
#include "comparison/stability_report.hpp"
#include "execution/run_directory.hpp"
#include "results/keys.hpp"
#include "tunica/error.hpp"

namespace tunica::comparison {

namespace key = results::key;

bool StabilityAnswer::any_assessed() const {
  const auto reached = [](const auto& followed) {
    return std::any_of(followed.begin(), followed.end(), [](const auto& path) { return path.to != 1; });
  };
  return std::any_of(found.models.begin(), found.models.end(), [&](const auto& model) {
    const auto& strips = model.verdict.transverse;
    const bool pulled = std::any_of(strips.begin(), strips.end(),
                                    [](const auto& strip) { return strip.checked_from < 1 || strip.checked_to > 1; });
    return pulled || reached(model.verdict.ellipticity.followed);
  });
}

StabilityAnswer judge_stability(const std::string& name, const Subject& subject, const StabilityRequest& request) {
  if (request.map && !request.directory)
    throw InputError("a map of stability writes a file: name a new folder for it (-o DIR)");
  // A map that cannot be drawn, or a folder that is there already, is said before anything else.
  std::string map;
  if (request.map)
    map = stability_map(*subject.assembly, subject.free, *request.map, request.points,
                        domain_of(*subject.assembly, 0, request.to).largest);
  std::optional<execution::RunDirectory> directory;
  if (request.directory) directory.emplace(execution::RunDirectory::create(*request.directory, name));
  StabilityAnswer answer{stability_of(*subject.assembly, subject.free, request.to), {}};
  if (directory) {
    execution::NewResults results(*directory);
    for (const auto& file : write_stability(directory->path(), subject, request.to, map))
      answer.files.push_back(file.string());
    results.complete();
  }
  return answer;
}

nlohmann::ordered_json stability_answer_json(const Subject& subject, const StabilityAnswer& answer) {
  nlohmann::ordered_json document = {{key::model, subject.model}, {key::origin, subject.origin}};
  auto& parameters = document[key::parameters] = nlohmann::ordered_json::object();
  const auto& free = subject.assembly->layout().parameters;
  for (std::size_t i = 0; i < free.size(); ++i)
    parameters[free[i].name] = {{key::value, subject.free[i]}, {key::unit, free[i].unit}};
  for (const auto& fixed : subject.assembly->layout().fixed_parameters)
    parameters[fixed.name] = {{key::value, fixed.value}, {key::unit, fixed.unit}};
  document[key::warnings] = subject.warnings;
  const auto stable = answer.found.transversely_stable();
  document[key::stable] = stable ? nlohmann::ordered_json(*stable) : nullptr;
  RunSummary run;
  run.stability = answer.found;
  document[key::stability] = stability_json(run);
  for (const auto of_runs : {key::imposed, key::ratio_to_free}) document[key::stability].erase(of_runs);
  document[key::files] = answer.files;
  return document;
}

}  // namespace tunica::comparison
