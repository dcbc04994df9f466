// SPDX-License-Identifier: Apache-2.0
#include "studio/job_record.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "execution/files.hpp"
#include "studio/project_folder.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::app::studio {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

namespace {

fs::path folder_of_jobs() {
  const fs::path place = execution::own_folder(own_place() / "jobs");
  if (!fs::is_directory(place)) execution::make_folder(place);
  return place;
}

JobRecord record_of(const json& saved, std::string id) {
  JobRecord job{std::move(id),      saved.at("verb"),       saved.at("words"),
                saved.at("folder"), saved.at("experiment"), saved.at("started")};
  if (saved.at("ended").is_number()) job.ended = saved["ended"].get<double>();
  if (saved.at("code").is_number()) job.code = saved["code"].get<int>();
  job.asked_to_stop = saved.value("asked_to_stop", false);
  job.output = saved.value("output", std::string());
  return job;
}

}  // namespace

bool JobRecord::is_resumable() const {
  std::error_code none;
  return verb == "run" && !folder.empty() && fs::exists(fs::path(folder) / "checkpoint.json", none) &&
         !fs::exists(fs::path(folder) / "result.json", none);
}

fs::path JobRecord::file(const char* ending) const { return own_place() / "jobs" / (id + ending); }

std::string next_job_id() {
  unsigned long newest = 0;
  for (const auto& entry : fs::directory_iterator(folder_of_jobs()))
    newest = std::max(newest, std::strtoul(entry.path().stem().c_str(), nullptr, 10));
  return fmt::format("{:06}", newest + 1);
}

std::vector<JobRecord> job_records() {
  constexpr std::size_t most = 300;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder_of_jobs()))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.rbegin(), files.rend());
  files.resize(std::min(files.size(), most));
  std::vector<JobRecord> jobs;
  for (const fs::path& file : files) {
    try {
      jobs.push_back(record_of(detail::parse_json<json>(execution::read_text(file)), file.stem().string()));
    } catch (const json::exception&) {  // from another program, or from a full disk
    } catch (const InputError&) {
    }
  }
  return jobs;
}

void write_record(const JobRecord& job) {
  const json saved = {{"verb", job.verb},
                      {"words", job.words},
                      {"folder", job.folder},
                      {"experiment", job.experiment},
                      {"started", job.started},
                      {"ended", job.ended ? json(*job.ended) : json(nullptr)},
                      {"code", job.code ? json(*job.code) : json(nullptr)},
                      {"asked_to_stop", job.asked_to_stop},
                      {"output", job.output}};
  folder_of_jobs();
  execution::write_atomically(job.file(".json"), saved.dump(1) + '\n');
}

}  // namespace tunica::app::studio
