// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "session.hpp"

namespace tunica::app::studio {

/// What a test names: its data, and files of its options, alone or within JSON. Words of a command are no files of it.
std::vector<std::filesystem::path> files_of(const experiment::TestEntry& test);

/// Reads an experiment; throws Refused where a file that it names lies outside of the project, and InputError as
/// Session::read() does.
experiment::Experiment read_confined(const Session& session, const std::filesystem::path& file);

}  // namespace tunica::app::studio
