// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// One HTML file that needs nothing but itself, made from what result folders hold.
namespace tunica::report {

/// The document. Links to tables are relative to `beside`, the folder that the file will lie in. Throws InputError for
/// a folder without results; tables that are missing or broken are left out, and broken ones are named in the report.
std::string report(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& beside);

/// Writes report.html into the folder and returns where.
std::filesystem::path write_report(const std::filesystem::path& folder);

}  // namespace tunica::report
