// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "studio/job_record.hpp"

/// Earlier attempts, read from the result folders themselves.
namespace tunica::app::studio {

/// One folder of results: {"folder", "kind": run|diagnosis|discovery|cohort|simulation|unfinished, "written" (s since
/// 1970), "experiment" of the job that wrote it (or null), "report", "leads_to": [{"file", "what":
/// extended|mended|discovered}], "summary"}. A run has the best of each run in "summary": {"runs": [{run, rms,
/// rms_upper, objective, converged, parameters}]}, a diagnosis its verdict and causes, a cohort how many specimens were
/// fitted, and the verdict.
nlohmann::ordered_json result_entry(const std::filesystem::path& folder, const std::vector<JobRecord>& jobs);

/// Which experiment was changed into which: {copy: original}, from .tunica-studio/copies.json.
nlohmann::ordered_json copies();
void note_copy(const std::string& copy, const std::string& original);

}  // namespace tunica::app::studio
