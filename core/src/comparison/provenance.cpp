// SPDX-License-Identifier: Apache-2.0
#include "comparison/provenance.hpp"

#include <chrono>
#include <set>
#include <utility>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/version.h>
#include <sys/utsname.h>
#include <tbb/version.h>

#include "data/sha256.hpp"
#include "results/keys.hpp"
#include "tunica/detail/vector_level.hpp"
#include "tunica/plugin.hpp"

namespace tunica::comparison {

namespace key = results::key;

namespace {

/// "Linux 6.1.0, x86_64"; "unknown" where the system does not say.
std::string system_of_this_machine() {
  utsname found{};
  return uname(&found) == 0 ? fmt::format("{} {}, {}", found.sysname, found.release, found.machine) : "unknown";
}

}  // namespace

std::string version() { return TUNICA_VERSION; }

Provenance provenance_of(const execution::Plan& plan) {
  std::set<std::string> data;
  for (const auto& run : plan.runs)
    data.insert(run.assembly->layout().data_hashes.begin(), run.assembly->layout().data_hashes.end());
  return provenance_of(*plan.experiment, plan.plugins, {data.begin(), data.end()});
}

Provenance provenance_of(const experiment::Experiment& experiment, std::vector<std::string> plugins,
                         std::vector<std::string> data) {
  Provenance result;
  result.version = version();
  result.plugins = std::move(plugins);
  result.data = std::move(data);
  result.compiler = "g++ " __VERSION__;
  result.system = system_of_this_machine();
  result.vector_level = detail::name(detail::vector_level());
  result.libraries = {
      {"boost", fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
      {"eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"nlohmann_json",
       fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"onetbb", TBB_runtime_version()},
      {"spdlog", fmt::format("{}.{}.{}", SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH)}};
  result.seed = experiment.seed;
  result.input_sha256 = data::sha256(experiment.input_json);
  result.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                            fmt::gmtime(std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())));
  return result;
}

nlohmann::ordered_json provenance_json(const Provenance& provenance) {
  auto libraries = nlohmann::ordered_json::object();
  for (const auto& [library, version] : provenance.libraries) libraries[library] = version;
  return {{key::tunica, provenance.version},      {key::plugins, provenance.plugins},
          {key::compiler, provenance.compiler},   {key::system, provenance.system},
          {key::libraries, std::move(libraries)}, {key::vector_level, provenance.vector_level},
          {key::seed, provenance.seed},           {key::input_sha256, provenance.input_sha256},
          {key::data, provenance.data},           {key::date, provenance.date}};
}

}  // namespace tunica::comparison
