// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "serving/served_run.hpp"

namespace tunica::serving {

/// The answer to one request: the status of HTTP and a JSON document.
struct Answer {
  int status = 200;
  std::string body;
};

/// UM-Bridge, protocol version 1.0 (https://um-bridge-benchmarks.readthedocs.io): what the server of a run answers.
/// `path` is "/Info", "/InputSizes", "/OutputSizes", "/ModelInfo", "/Evaluate", "/Gradient" or "/ApplyJacobian"; the
/// models are "objective", "residuals" and "predictions". An error is status 400 with
/// {"error": {"type": "InvalidInput", "message": …}}, also where a number is not finite, which JSON cannot carry.
/// Never throws; thread-safe.
Answer answer(const ServedRun& run, std::string_view path, const std::string& body);

/// The paths that are asked with POST.
const std::vector<std::string>& posted_paths();

}  // namespace tunica::serving
