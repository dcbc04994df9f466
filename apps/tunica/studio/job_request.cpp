// SPDX-License-Identifier: Apache-2.0
#include "studio/job_request.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "execution/files.hpp"
#include "studio/confined.hpp"
#include "studio/project_folder.hpp"
#include "text/escaped.hpp"
#include "tunica/error.hpp"

namespace tunica::app::studio {

namespace fs = std::filesystem;

namespace {

/// An experiment called experiment.json goes by its folder; what a diagnosis wrote goes by the folder of its results.
std::string stem_of(const fs::path& experiment) {
  const std::string stem = experiment.stem().string(), above = experiment.parent_path().filename().string();
  if (above.empty()) return file_name(stem);
  return file_name(stem == "experiment" ? above : above + "-" + stem);
}

std::string new_folder(const std::string& stem, const char* kind) {
  fs::path folder;
  for (int n = 1; n == 1 || fs::exists(fs::symlink_status(folder)); ++n)
    folder = inside(fmt::format("results/{}-{}-{}", stem, kind, n));
  if (execution::make_folders(folder))
    throw InputError(fmt::format("{}: cannot be made; check the permissions of the project", folder.string()));
  return folder.generic_string();
}

fs::path result_inside(const std::string& name) {
  const fs::path folder = inside(name);
  std::error_code none;
  if (!fs::is_regular_file(folder / "result.json", none) && !fs::is_regular_file(folder / "simulation.json", none))
    throw InputError(fmt::format("{}: there are no results in this folder; choose another one", name));
  return folder;
}

JobRecord resumed(const Session& session, const std::string& id) {
  for (JobRecord& job : job_records()) {
    if (job.id != id) continue;
    if (!job.is_resumable())
      throw InputError(fmt::format("nothing in {} can be resumed; start the run anew", job.folder));
    static_cast<void>(read_confined(session, file_inside(job.experiment)));
    job.words = {"run", file_inside(job.experiment).generic_string(), "-o", inside(job.folder).generic_string(),
                 "--resume"};
    job.ended.reset();
    job.code.reset();
    job.asked_to_stop = false;
    return job;
  }
  throw InputError(fmt::format("there is no job '{}' to resume; load the page again", text::excerpt(id)));
}

JobRecord of_experiment(const Session& session, const std::string& verb, const nlohmann::json& request) {
  JobRecord job{.verb = verb};
  job.experiment = file_inside(request.at("experiment").get<std::string>()).generic_string();
  static_cast<void>(read_confined(session, job.experiment));
  const bool readings = verb == "diagnose" && request.value("readings", false);  // of the file, before any other cause
  job.folder = new_folder(stem_of(job.experiment), readings             ? "readings"
                                                   : verb == "run"      ? "fit"
                                                   : verb == "diagnose" ? "diagnosis"
                                                                        : "discovery");
  job.words = {verb, job.experiment, "-o", job.folder};
  if (readings) job.words.insert(job.words.end(), {"--groups", "file", "--quick", "--no-discovery"});
  if (verb == "diagnose" && request.value("quick", false)) job.words.emplace_back("--quick");
  return job;
}

JobRecord of_report(const nlohmann::json& request) {
  JobRecord job{.verb = "report", .words = {"report"}};
  for (const auto& folder : request.at("folders")) job.words.push_back(result_inside(folder).generic_string());
  if (job.words.size() > 2) {
    job.output = free_name(inside("comparison.html")).generic_string();
    job.words.insert(job.words.end(), {"-o", job.output});
  }
  return job;
}

struct Card {
  const char* target;
  const char* ending;
};
constexpr std::array cards = {Card{"febio", ".feb"}, Card{"abaqus", ".inp"}, Card{"ansys", ".mac"},
                              Card{"calculix", ".inp"}, Card{"lsdyna", ".k"}};

JobRecord of_export(const nlohmann::json& request) {
  const auto target = request.at("to").get<std::string>(), units = request.value("units", std::string("mm-N-MPa"));
  const auto card = std::find_if(cards.begin(), cards.end(), [&](const Card& one) { return one.target == target; });
  if (card == cards.end())
    throw InputError(fmt::format("no card is written for '{}'; choose febio, abaqus, ansys, calculix or lsdyna",
                                 text::excerpt(target)));
  const fs::path folder = result_inside(request.at("folder").get<std::string>());
  const auto run = request.value("run", std::string());
  for (const std::string& word : {units, run})
    if (word.starts_with('-'))
      throw InputError(fmt::format("'{}' is no name of a run or of units; choose another one", text::excerpt(word)));
  if (execution::make_folders(inside("cards"))) throw InputError("cards: cannot be made; check the permissions");
  JobRecord job{.verb = "export"};
  job.output = free_name(inside(fmt::format("cards/{}-{}{}", folder.filename().string(), target, card->ending)))
                   .generic_string();
  job.words = {"export", folder.generic_string(), "--to", target, "--units", units, "-o", job.output};
  if (!run.empty()) job.words.insert(job.words.end(), {"--run", run});
  return job;
}

}  // namespace

JobRecord job_of(const Session& session, const nlohmann::json& request) {
  const auto verb = request.at("verb").get<std::string>();
  if (verb == "run" && request.contains("resume")) return resumed(session, request["resume"]);
  if (verb == "run" || verb == "diagnose" || verb == "discover") return of_experiment(session, verb, request);
  if (verb == "report") return of_report(request);
  if (verb == "export") return of_export(request);
  throw InputError(fmt::format("the studio starts no job '{}'; it starts run, diagnose, discover, report and export",
                               text::excerpt(verb)));
}

}  // namespace tunica::app::studio
