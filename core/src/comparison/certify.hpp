// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "comparison/summary.hpp"

namespace tunica::comparison {

/// The best points of all runs, for a fresh process to certify before there is a result.json: {"runs": [{"run", "best":
/// {"objective", "parameters": {name: {"value"}}}}]}, a part of what result.json says.
std::string best_points_json(const Summary& summary);

/// What `tunica certify` prints: for every run of a result.json, or of best_points_json(), that has a best point, that
/// point evaluated again by this process, and its neighbours, as JSON. `contradictions`: a sentence for each point that
/// does not confirm what is recorded. `plan` is made from the input.json beside it. Throws InputError when the two do
/// not belong together. With a `catalogue` a local search goes on from the lowest point, where tests are cheap: what is
/// to be had is then known, and not only that something is.
std::string certify(const execution::Plan& plan, const std::string& result_json,
                    std::vector<std::string>* contradictions = nullptr, const plugins::Catalogue* catalogue = nullptr);

/// Reads what certify() printed elsewhere into the certificates of the summary and words every verdict. A run that is
/// not in it, or an empty text, is left without; `missing` then says why. Intervals around a point that is not the
/// optimum are withheld. True where the tables are other ones for that: an objective was not found again, so that the
/// ranking differs, or intervals are gone.
bool add_certificates(const std::string& certified, const std::string& missing, Summary& summary);

}  // namespace tunica::comparison
