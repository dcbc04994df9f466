// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "data/finding.hpp"
#include "data/series.hpp"

/// Checks the record of a test for consistency with itself and with physics. It refuses nothing: each finding is a
/// question to the experimenter, and a correct record raises none.
namespace tunica::data {

/// All of the functions below.
void look_at_record(const Series& series, const DataRequest& request, std::vector<Finding>& findings);

/// Rows after a sudden fall of the load that does not come back while the path goes on.
void look_for_break(const Series& series, const DataRequest& request, std::vector<Finding>& findings);

/// A stiffness that rises and then falls by far more than its scatter, as when a specimen slips, yields or tears.
void look_for_softening(const Series& series, std::vector<Finding>& findings);

/// A load in the first row although nothing is deformed there: a spike, or a load that was not tared.
void look_at_start(const Series& series, const DataRequest& request, std::vector<Finding>& findings);

/// A block of rows that repeats an earlier one digit by digit, as where a file was appended to itself.
void look_for_blocks(const Series& series, std::vector<Finding>& findings);

/// Channels with few values for many rows: the device resolves too little of the range.
void look_at_resolution(const Series& series, std::vector<Finding>& findings);

/// Compression that the file counts as positive.
void look_at_sign(const Series& series, const DataRequest& request, std::vector<Finding>& findings);

/// How long the test took, and how fast it was.
void look_at_time(const Series& series, std::vector<Finding>& findings);

/// Stretches that stay within 5 % of 1, and strains that look like percent.
void look_at_reach(const Series& series, std::vector<Finding>& findings);

}  // namespace tunica::data
