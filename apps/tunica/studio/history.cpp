// SPDX-License-Identifier: Apache-2.0
#include "studio/history.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>

#include <nlohmann/json.hpp>

#include "execution/files.hpp"
#include "studio/project_folder.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::app::studio {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

namespace {

/// Null where it is missing, or no JSON.
json document_in(const fs::path& file) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return nullptr;
  try {
    auto document = detail::parse_json<json>(execution::read_text(file), false);
    return document.is_discarded() ? json(nullptr) : document;
  } catch (const InputError&) {
    return nullptr;
  }
}

json part(const json& document, std::initializer_list<const char*> keys) {
  const json* at = &document;
  for (const char* key : keys) {
    if (!at->is_object() || !at->contains(key)) return nullptr;
    at = &(*at)[key];
  }
  return *at;
}

/// The best point of each run, with how far it misses as a share of the range.
json of_runs(const json& result) {
  json runs = json::array();
  for (const json& run : part(result, {"runs"}))
    runs.push_back({{"run", part(run, {"run"})},
                    {"converged", part(run, {"converged"})},
                    {"evaluations", part(run, {"evaluations"})},
                    {"seconds", part(run, {"seconds"})},
                    {"objective", part(run, {"best", "objective"})},
                    {"stable", part(run, {"best", "stable"})},
                    {"rms", part(run, {"best", "misfit_size", "rms"})},
                    {"rms_upper", part(run, {"best", "misfit_size", "rms_upper"})},
                    {"parameters", part(run, {"best", "parameters"})}});
  return {{"runs", std::move(runs)}};
}

json of_diagnosis(const json& diagnosis) {
  return {{"verdict", part(diagnosis, {"verdict"})},
          {"model", part(diagnosis, {"base", "model"})},
          {"causes", part(diagnosis, {"causes"})},
          {"rms", part(diagnosis, {"budget", "rms"})},
          {"rms_upper", part(diagnosis, {"budget", "rms_upper"})},
          {"tolerance", part(diagnosis, {"budget", "tolerance"})}};
}

json of_cohort(const json& result) {
  std::size_t fitted = 0;
  const json specimens = part(result, {"cohort", "specimens"});
  for (const json& one : specimens) fitted += part(one, {"outcome"}) == "fitted" ? 1 : 0;
  return {{"specimens", specimens.size()},
          {"fitted", fitted},
          {"verdict", part(result, {"diagnosis", "verdict"})},
          {"rms", part(result, {"diagnosis", "size", "rms"})}};
}

double written(const fs::path& folder) {
  std::error_code none;
  const auto time = fs::last_write_time(folder, none);
  if (none) return 0;
  return std::chrono::duration<double>(std::chrono::file_clock::to_sys(time).time_since_epoch()).count();
}

}  // namespace

json result_entry(const fs::path& folder, const std::vector<JobRecord>& jobs) {
  const auto job = std::find_if(jobs.begin(), jobs.end(), [&](const JobRecord& one) {
    return !one.experiment.empty() && fs::path(one.folder) == folder;
  });
  const json result = document_in(folder / "result.json");
  json entry = {{"folder", folder.generic_string()},
                {"kind", "unfinished"},
                {"written", written(folder)},
                {"experiment", job == jobs.end() ? json(nullptr) : json(job->experiment)},
                {"report", fs::exists(folder / "report.html")},
                {"leads_to", json::array()},
                {"summary", nullptr}};
  for (const char* what : {"extended", "mended", "discovered"}) {
    const fs::path file = folder / (std::string(what) + ".json");
    if (fs::exists(file)) entry["leads_to"].push_back({{"file", file.generic_string()}, {"what", what}});
  }
  if (fs::exists(folder / "simulation.json")) entry["kind"] = "simulation";
  if (!result.is_object()) return entry;
  entry["name"] = part(result, {"name"});
  if (result.contains("cohort")) {
    entry["kind"] = "cohort";
    entry["summary"] = of_cohort(result);
  } else if (result.contains("diagnosis") && result["diagnosis"].is_object()) {
    entry["kind"] = "diagnosis";
    entry["summary"] = of_diagnosis(result["diagnosis"]);
  } else if (result.contains("discovery")) {
    entry["kind"] = "discovery";
  } else {
    entry["kind"] = "run";
    entry["summary"] = of_runs(result);
  }
  return entry;
}

json copies() {
  const json saved = document_in(own_place() / "copies.json");
  return saved.is_object() ? saved : json::object();
}

void note_copy(const std::string& copy, const std::string& original) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  json all = copies();
  all[copy] = original;
  execution::write_atomically(own_place() / "copies.json", all.dump(1) + '\n');
}

}  // namespace tunica::app::studio
