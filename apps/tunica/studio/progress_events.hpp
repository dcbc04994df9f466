// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "studio/job_record.hpp"

namespace tunica::app::studio {

/// The last output of a job: stderr while it runs, and all of stdout after its end.
std::string last_words_of(const JobRecord& job);

/// A stream of server-sent events from the files of a job. "progress": {"count", "rows": [[evaluation, run,
/// objective]], "best": {"run", "evaluation", "objective", "parameters": {name: value}}, "words"}, where "rows" has
/// improvements of each run and a share of the others; "end": what `ended` returns once the job is over. It ends after
/// a minute too, and the browser asks again, which begins with event "begin".
std::function<std::optional<std::string>()> progress_events(
    const JobRecord& job, const std::function<std::optional<nlohmann::ordered_json>()>& ended);

}  // namespace tunica::app::studio
