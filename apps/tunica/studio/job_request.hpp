// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "session.hpp"
#include "studio/job_record.hpp"

namespace tunica::app::studio {

/// The command line of what the page asks for, see Jobs::start(); every name in it lies in the project. A folder for
/// the results is made, so that nobody else takes it. Throws InputError, and Refused also for an experiment that names
/// files outside.
JobRecord job_of(const Session& session, const nlohmann::json& request);

}  // namespace tunica::app::studio
