// SPDX-License-Identifier: Apache-2.0
#include "stress_measure.hpp"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "tunica/models/hyperelastic.hpp"
#include "tunica/models/isotropic.hpp"
#include "tunica/models/rubber_laws.hpp"

namespace tunica::abscissa_errors {

std::optional<int> force_power(const Test& strip, std::size_t abscissa, std::size_t channel) {
  constexpr double c10 = 0.5, stretch = 2, nominal = 2 * c10 * (stretch - 1 / (stretch * stretch));
  ModelDescription description;
  description.type = "neo_hooke";
  description.parameters = {{"c10", "kPa", c10, 0, 1, Scale::linear, "", ""}};
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(isotropic::part<laws::Proportional, isotropic::FirstInvariant, 1>("matrix", {0}, true));
  const Hyperelastic rubber(std::move(description), std::move(parts));

  const TestRows& rows = strip.rows();
  const std::vector<double> pulled(rows.count, stretch);
  std::vector<std::span<const double>> abscissae;
  for (const TestRows::Column& column : rows.abscissae) abscissae.push_back(column.values);
  abscissae[abscissa] = pulled;
  std::vector<double> own = strip.describe().nulls;
  for (std::size_t k = 0; k < own.size(); ++k)
    if (std::isnan(own[k])) own[k] = strip.describe().parameters[k].initial;
  std::vector<double> values(rows.channels.size() * rows.count);
  const std::vector<double> parameters{c10};
  if (values.empty() || !strip.predict({rubber, parameters, own, abscissae}, {values, {}, {}, {}}).ok()) return {};
  constexpr double rounding = 1e-6;
  for (const int q : {-1, 0, 1})
    if (std::abs(values[channel * rows.count] * std::pow(stretch, q) - nominal) < rounding) return q;
  return {};
}

}  // namespace tunica::abscissa_errors
