// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tunica::data {

/// A data file of DMC (Aurora Scientific) has its rows in volts, and the scales and offsets of the channels above them.
/// It becomes a table in units, (volts + offset) × scale, with the time by the number of the sample; every row keeps
/// its line. Columns without a scale stay as they are. False where the text is no such file. Throws InputError where
/// the scales are not to be had.
bool dmc_as_table(const std::filesystem::path& file, std::string_view text, std::string& table);

}  // namespace tunica::data
