// SPDX-License-Identifier: Apache-2.0
// Diagnoses cohorts that lie in folders: COHORT/specimens.csv (id, group) and COHORT/<id>/experiment.json. Writes
// <id>/evidence.json, which is kept, and COHORT/verdict.json, which is made anew. bench/discovery_cohorts.py calls it.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "cohort_diagnosis/combination.hpp"
#include "cohort_diagnosis/evidence_json.hpp"
#include "cohort_diagnosis/verdict_json.hpp"
#include "plugins.hpp"

namespace {

namespace fs = std::filesystem;
using namespace tunica;
using Json = nlohmann::ordered_json;

struct Row {
  std::string id, group;
};

std::vector<Row> table_of(const fs::path& cohort) {
  std::ifstream in(cohort / "specimens.csv");
  std::string line;
  std::getline(in, line);
  std::vector<Row> rows;
  while (std::getline(in, line)) rows.push_back({line.substr(0, line.find(',')), line.substr(line.find(',') + 1)});
  return rows;
}

void put(const fs::path& file, const std::string& text) {
  const fs::path unfinished = file.string() + ".part";
  std::ofstream(unfinished) << text;
  fs::rename(unfinished, file);
}

void gather(const fs::path& specimen) {
  if (fs::exists(specimen / "evidence.json")) return;
  const auto begun = std::chrono::steady_clock::now();
  const auto experiment = experiment::read_experiment(specimen / "experiment.json", bench::catalogue());
  diagnosis::Request request = diagnosis::request_of(experiment);
  request.quick = true;
  const auto found =
      cohort_diagnosis::evidence_of(specimen.filename().string(), experiment, request, bench::catalogue());
  put(specimen / "evidence.json", cohort_diagnosis::to_json(found).dump() + "\n");
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun;
  put(specimen / "seconds", fmt::format("{}\n", seconds.count()));
}

void judge(const fs::path& cohort) {
  std::vector<cohort_diagnosis::SpecimenEvidence> specimens;
  cohort_diagnosis::Factor group{"group", {}};
  Json sums = Json::object();
  for (const Row& row : table_of(cohort)) {
    std::ifstream in(cohort / row.id / "evidence.json");
    specimens.push_back(cohort_diagnosis::evidence_from_json(Json::parse(in), row.id));
    group.level[row.id] = row.group;
    // What no more than adding up would say, for comparison: the sum of the weights that each specimen has of itself.
    for (const auto& [id, entry] : bench::catalogue().mechanisms()) {
      const double own = cohort_diagnosis::own_log_weight(specimens.back(), id);
      if (std::isfinite(own)) sums[id] = sums.value(id, 0.0) + own;
    }
  }
  const auto begun = std::chrono::steady_clock::now();
  const auto verdict = cohort_diagnosis::combine(specimens, std::array{group});
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begun;
  Json json = cohort_diagnosis::to_json(verdict);
  json["sums_of_own_weights"] = sums;
  json["own"] = Json::array();
  for (const auto& one : specimens)
    json["own"].push_back({{"id", one.id}, {"causes", one.causes}, {"verdict", diagnosis::code_of(one.verdict)}});
  json["seconds"] = seconds.count();
  put(cohort / "verdict.json", json.dump(1) + "\n");
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) {
    fmt::print(stderr, "usage: bench_cohort_diagnosis THREADS COHORT...\n");
    return 2;
  }
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism,
                                   static_cast<std::size_t>(std::max(1, std::atoi(arguments[1]))));
  std::vector<fs::path> cohorts(arguments + 2, arguments + count), specimens;
  for (const fs::path& cohort : cohorts)
    for (const Row& row : table_of(cohort)) specimens.push_back(cohort / row.id);
  std::atomic<int> failures = 0;
  const auto guarded = [&](const fs::path& of, const auto& work) {
    tbb::this_task_arena::isolate([&] {
      try {
        work(of);
      } catch (const std::exception& problem) {
        ++failures;
        fmt::print(stderr, "{}: {}\n", of.string(), problem.what());
      }
    });
  };
  tbb::parallel_for(std::size_t{0}, specimens.size(), [&](std::size_t k) { guarded(specimens[k], gather); });
  tbb::parallel_for(std::size_t{0}, cohorts.size(), [&](std::size_t k) { guarded(cohorts[k], judge); });
  return failures == 0 ? 0 : 1;
}
