// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "diagnosis/evidence/evidence.hpp"
#include "discovery/judgement.hpp"
#include "text/styled.hpp"

/// The common parts of the outputs of one specimen and of several.
namespace tunica::discovery {

/// {"invariant": …, "family": …, "law": …}
nlohmann::ordered_json kind_json(const Kind& kind);

/// What was asked and the answer: verdict, reasons, base, model, alpha, ambiguity set, name of the catalogue.
nlohmann::ordered_json answer_json(const Request& request, const Judgement& judgement);

nlohmann::ordered_json paths_json(const PathDependence& paths);

/// The whole of result.json around `discovery`. `data_hashes` as Layout has them.
std::string document(const std::string& name, const std::vector<diagnosis::Warning>& warnings,
                     nlohmann::ordered_json discovery, const experiment::Experiment& experiment,
                     const diagnosis::Evidence& evidence, const std::vector<std::string>& data_hashes,
                     const plugins::Catalogue& catalogue);

/// "Verdict: DISCOVERED: …" and an empty line.
text::StyledText verdict_words(const Judgement& judgement);

/// "p < 0.0001"
std::string p_words(double p);

}  // namespace tunica::discovery
