// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "importing/proposal.hpp"

/// One sheet whose axes stand in two files.
namespace tunica::importing {

/// A table with the known columns of both files, their axis behind their names: that of the file's name, or of
/// Answers::directions. Rows go together one by one. Throws InputError where the files are not two, an axis is not
/// known, or numbers of rows or times differ.
std::string joined_table(const Answers& answers);

}  // namespace tunica::importing
