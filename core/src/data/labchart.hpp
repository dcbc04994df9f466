// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tunica::data {

/// A recording that LabChart exported as text has its names behind "ChannelTitle=" and its units behind "UnitName=",
/// with other lines between. It becomes a table with the header "Time [s]", "Pressure [mmHg]", … in the last of these
/// lines, so that every row keeps its line; comments behind rows are taken off. False where the text is no such file.
/// Throws InputError where it holds several blocks, each of which begins its time anew.
bool labchart_as_table(const std::filesystem::path& file, std::string_view text, std::string& table);

}  // namespace tunica::data
