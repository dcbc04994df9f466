// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "report/chart.hpp"

namespace tunica::exporting {

/// The model's parameters by their own names, each with its object of result.json.
using Parameters = std::vector<std::pair<std::string, report::Json>>;

/// The inputs of the remarks.
struct Origin {
  const std::filesystem::path& folder;
  const report::Json& result;  ///< result.json
  const report::Json& run;     ///< one of its runs
  const std::string& model;    ///< name in the experiment
  const std::string& type;     ///< "gho"
  const Parameters& parameters;
};

/// Provenance, a misfit that counts, parameters with intervals, fitted range, stability, warnings: one paragraph each.
std::vector<std::string> remarks(const Origin& origin);

}  // namespace tunica::exporting
