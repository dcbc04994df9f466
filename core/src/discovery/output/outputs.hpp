// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "discovery/discovery.hpp"
#include "text/styled.hpp"

namespace tunica::discovery {

/// `discovery` of result.json.
nlohmann::ordered_json discovery_json(const Discovery& discovery);

/// The whole of result.json: no runs, the discovery, its warnings and provenance.
std::string result_document(const Discovery& discovery, const experiment::Experiment& experiment,
                            const plugins::Catalogue& catalogue);

/// The text on the terminal.
text::StyledText summary(const Discovery& discovery);
/// The part of it that a diagnosis adds to its own words: terms, how well they predict, what to measure next.
text::StyledText term_summary(const Discovery& discovery);

/// The experiment with the terms, its parameters at their fitted values: the text of extended.json. Empty without
/// terms.
std::string extended_experiment(const Discovery& discovery, const plugins::Catalogue& catalogue);
/// The same of a set that was fitted.
std::string extended_experiment(const SetFit& fit, const diagnosis::Analysis& analysis,
                                const plugins::Catalogue& catalogue);

/// residuals.csv as a diagnosis writes it: measured, predicted by the base and with the terms, σ, and what is left in
/// σ.
std::string residual_table(const Discovery& discovery);

}  // namespace tunica::discovery
