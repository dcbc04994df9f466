// SPDX-License-Identifier: Apache-2.0
#include "discovery/term_slope.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "plugins/guarded.hpp"

namespace tunica::discovery {
namespace {

/// Of an energy U(J) alone at C = c 1, c = J^(2/3):  S = J U' C⁻¹, so that U' = S_tt c/J.
std::vector<double> volume_slopes(const Model& model, std::span<const double> own, std::span<const double> x,
                                  std::vector<double>* by_law) {
  const std::size_t n = x.size();
  std::vector<double> C(6 * n, 0.0), S(6 * n), S_dp(by_law ? 6 * own.size() * n : 0), slopes(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t a = 0; a < 3; ++a) C[a * n + i] = std::pow(1 + x[i], 2.0 / 3);
  if (!model.evaluate({n, C, own, {}, {}}, {{}, S, {}, S_dp, {}}).ok()) return slopes;
  if (by_law) by_law->resize(own.size() * n);
  for (std::size_t i = 0; i < n; ++i) {
    const double to_slope = C[i] / (1 + x[i]);
    slopes[i] = S[i] * to_slope;
    for (std::size_t j = 0; by_law && j < own.size(); ++j) (*by_law)[j * n + i] = S_dp[6 * j * n + i] * to_slope;
  }
  return slopes;
}

}  // namespace

std::unique_ptr<Model> alone(const Subject& subject, const Kind& kind) {
  std::string invariant = kind.is_product() ? "I1" : kind.invariant;
  if (invariant.ends_with("bar")) invariant.resize(invariant.size() - 3);
  nlohmann::ordered_json term = {{"name", "t"}, {"invariant", invariant}, {"law", kind.law}};
  if (!kind.family.empty()) term["family"] = kind.family;
  if (!kind.knots.empty()) term["knots"] = kind.knots;
  Options options;
  options.set("terms", nlohmann::ordered_json::array({term}).dump());
  return plugins::create(*subject.catalogue.term_model(), options);
}

std::vector<std::size_t> parameters_of(const BoundTerm& term) {
  std::vector<std::size_t> all{term.amplitude};
  all.insert(all.end(), term.heights.begin(), term.heights.end());
  all.insert(all.end(), term.shapes.begin(), term.shapes.end());
  return all;
}

std::vector<double> term_slopes(const Subject& subject, const Kind& kind, std::span<const double> own,
                                std::span<const double> x, std::vector<double>* by_law) {
  const std::unique_ptr<Model> model = alone(subject, kind);
  if (kind.of_volume()) return volume_slopes(*model, own, x, by_law);
  std::vector<double> slopes(x.size());
  const EnergyPart& part = *model->parts().front();
  if (by_law) by_law->resize(part.describe().response_parameters.size() * x.size());
  part.respond(own, {x, {}, slopes, {}, {}, by_law ? std::span<double>(*by_law) : std::span<double>()});
  return slopes;
}

}  // namespace tunica::discovery
