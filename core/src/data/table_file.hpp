// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "data/csv.hpp"

namespace tunica::data {

/// A data file as it was read, cut into cells.
struct TableFile {
  Csv csv;
  std::string sha256;  ///< of its bytes
};

/// The file, read once however often it is asked for: a diagnosis builds the same tests hundreds of times. It is read
/// again where its place, size or times have changed, and where it is younger than two seconds, for then its times do
/// not tell. Large files are forgotten first come, first gone. Throws as read_bytes() and parse_csv() do.
std::shared_ptr<const TableFile> table_file(const std::filesystem::path& file, const TableLayout& layout);

}  // namespace tunica::data
