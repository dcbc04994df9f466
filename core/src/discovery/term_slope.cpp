// SPDX-License-Identifier: Apache-2.0
#include "discovery/term_slope.hpp"

#include <nlohmann/json.hpp>

#include "plugins/guarded.hpp"

namespace tunica::discovery {

std::unique_ptr<Model> alone(const Subject& subject, const Kind& kind) {
  nlohmann::ordered_json term = {{"name", "t"}, {"invariant", kind.invariant}, {"law", kind.law}};
  if (!kind.family.empty()) term["family"] = kind.family;
  if (!kind.knots.empty()) term["knots"] = kind.knots;
  Options options;
  options.set("terms", nlohmann::ordered_json::array({term}).dump());
  return plugins::create(subject.catalogue.models().at("composed"), options);
}

std::vector<std::size_t> parameters_of(const BoundTerm& term) {
  std::vector<std::size_t> all{term.amplitude};
  all.insert(all.end(), term.heights.begin(), term.heights.end());
  all.insert(all.end(), term.shapes.begin(), term.shapes.end());
  return all;
}

std::vector<double> term_slopes(const Subject& subject, const Kind& kind, std::span<const double> own,
                                std::span<const double> x) {
  std::vector<double> slopes(x.size());
  const std::unique_ptr<Model> model = alone(subject, kind);
  model->parts().front()->respond(own, {x, {}, slopes, {}, {}, {}});
  return slopes;
}

}  // namespace tunica::discovery
