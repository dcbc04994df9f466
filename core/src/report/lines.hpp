// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "data/curves.hpp"
#include "report/chart.hpp"

/// The lines of a curve as series of a chart.
namespace tunica::report {

inline constexpr std::size_t most_points = 400;  ///< of a curve in a chart

/// One series a line, all with the name, mark and style of `whole`, whose values stand at the positions that the lines
/// hold. The label is the member of the family. Points that are no numbers are left out, long lines are thinned to
/// about `most` points in all, and `left_out` grows by what that leaves out. Points of rows whose order means nothing
/// are not joined by "both"; a line through them runs from low to high abscissa.
std::vector<Series> by_line(const Series& whole, const std::vector<data::Line>& lines, std::size_t most,
                            std::size_t& left_out);

/// Writes at the end of each member of a family what it holds: "1.3" of "stretch_axial = 1.3". Returns the words that
/// say so, "" where there is no family or too large a one.
std::string tag(std::vector<Series>& parts);

}  // namespace tunica::report
