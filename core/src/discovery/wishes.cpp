// SPDX-License-Identifier: Apache-2.0
#include "discovery/wishes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "data/nearest.hpp"
#include "tunica/error.hpp"

namespace tunica::discovery {

namespace {

void check_words(const std::string& option, const std::vector<std::string>& words,
                 const std::vector<std::string>& known) {
  for (const std::string& word : words)
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw InputError(fmt::format("{}: '{}' is not known. {}", option, word, data::suggestion(word, known)));
}

}  // namespace

Request request_of(const experiment::Experiment& experiment, const Wishes& wishes, const std::string& prefix) {
  Request request = request_of(experiment);
  check_words(prefix + "invariants", wishes.invariants, experiment::discovery_invariants);
  check_words(prefix + "laws", wishes.laws, experiment::discovery_laws);
  std::vector<std::string> models;
  for (const auto& model : experiment.models) models.push_back(model.name);
  if (!wishes.model.empty()) {
    check_words(prefix + "model", {wishes.model}, models);
    request.model = wishes.model;
  }
  if (wishes.seed) request.seed = *wishes.seed;
  if (wishes.alpha) request.alpha = *wishes.alpha;
  if (wishes.most_terms) request.most_terms = *wishes.most_terms;
  if (wishes.most_parameters) request.most_parameters = *wishes.most_parameters;
  if (!wishes.invariants.empty()) request.invariants = wishes.invariants;
  if (!wishes.laws.empty()) request.laws = wishes.laws;
  request.from_nothing = request.from_nothing || wishes.from_nothing;
  request.quick = wishes.quick;
  return request;
}

}  // namespace tunica::discovery
