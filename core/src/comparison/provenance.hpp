// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "execution/plan.hpp"

namespace tunica::comparison {

/// Where a result comes from: enough to get it again.
struct Provenance {
  std::string version;               ///< of tunica
  std::vector<std::string> plugins;  ///< "gho 0.1.0", those in use, sorted
  std::string compiler;
  std::string system;                                          ///< "Linux 6.1.0, x86_64"
  std::string vector_level;                                    ///< "baseline", "avx2" or "avx512"
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version
  std::uint64_t seed = 0;
  std::string input_sha256;       ///< of input.json as it was written
  std::vector<std::string> data;  ///< "circ.csv sha256:…"
  std::string date;               ///< UTC, ISO 8601
};

std::string version();
Provenance provenance_of(const execution::Plan& plan);
/// Of what was made from an experiment without a plan; `data` as Layout::data_hashes has them.
Provenance provenance_of(const experiment::Experiment& experiment, std::vector<std::string> plugins,
                         std::vector<std::string> data);

/// `provenance` of result.json.
nlohmann::ordered_json provenance_json(const Provenance& provenance);

}  // namespace tunica::comparison
