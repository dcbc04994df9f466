// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "report/lines.hpp"
#include "report/sections.hpp"

/// The common parts of the charts of a diagnosis.
namespace tunica::report {

/// The waterfall of the budget, and what each test has of it.
void add_budget(Page& page, const Folder& folder);
/// Every cause as the only one, the largest share first.
void add_causes_alone(Page& page, const Folder& folder);

/// " in tube, pressure, row 4"; "" for what acts on the model.
std::string place_words(const Json& target);

/// The rows of one observable of one test in residuals.csv.
struct ResidualCurve {
  std::string test, channel, abscissa, unit;  ///< the abscissa with its unit
  std::vector<std::size_t> rows;
  std::vector<data::Line> lines;  ///< of positions in `rows`
};
std::vector<ResidualCurve> residual_curves(const Table& table);

/// Marks the regions of misfit of this curve.
void mark_misfit(Chart& chart, const Json& diagnosis, const ResidualCurve& curve);

}  // namespace tunica::report
