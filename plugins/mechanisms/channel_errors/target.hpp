// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "misread.hpp"
#include "tunica/options.hpp"

/// The target of the options `channel` and `rows`. Messages begin with the mechanism's id.
namespace tunica::channel_errors {

/// Those of `wanted` that the test's data have; throws InputError where they have none of them.
std::vector<std::size_t> channels_named(const std::string& id, const std::vector<std::string>& wanted,
                                        const TestRows& rows);

/// The channel of the option, or the only one where it is empty; throws InputError where it is neither.
std::size_t channel_chosen(const std::string& id, const Options& options, const TestRows& rows);

/// 1 on the rows of the option, 0 elsewhere; throws InputError if it is not a row range or contains no row.
std::vector<double> rows_chosen(const std::string& id, const Options& options, std::size_t count);

/// Part of the recording that is over at each row: of its time where the data have it, else of the number of rows;
/// throws InputError where it lasts no time.
std::vector<double> elapsed(const std::string& id, const TestRows& rows);

/// An amplitude in the unit of a channel, with bounds that suit it; a channel that no test of the tree has keeps those
/// of `general`.
Parameter in_unit_of(const std::string& channel, Parameter general);

Option channel_option();
Option rows_option();

}  // namespace tunica::channel_errors
