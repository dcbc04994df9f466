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

std::optional<int> force_power(const Test& test, std::size_t abscissa, std::size_t channel) {
  constexpr double c10 = 0.5, stretch = 2;
  // Cauchy stress at this stretch: of a strip, of a sheet whose other direction is held at 1, of one pulled alike.
  constexpr double square = stretch * stretch;
  constexpr double cauchy[] = {2 * c10 * (square - 1 / stretch), 2 * c10 * (square - 1 / square),
                               2 * c10 * (square - 1 / (square * square))};
  ModelDescription description;
  description.type = "neo_hooke";
  description.parameters = {{"c10", "kPa", c10, 0, 1, Scale::linear, "", ""}};
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(isotropic::part<laws::Proportional, isotropic::FirstInvariant, 1>("matrix", {0}, true));
  const Hyperelastic rubber(std::move(description), std::move(parts));

  const TestRows& rows = test.rows();
  const std::vector<double> pulled(rows.count, stretch), held(rows.count, 1.0);
  std::vector<std::span<const double>> abscissae;
  for (const TestRows::Column& column : rows.abscissae)
    abscissae.push_back(column.observable.starts_with("stretch") ? held : column.values);
  abscissae[abscissa] = pulled;
  std::vector<double> own = test.describe().nulls;
  for (std::size_t k = 0; k < own.size(); ++k)
    if (std::isnan(own[k])) own[k] = test.describe().parameters[k].initial;
  std::vector<double> values(rows.channels.size() * rows.count);
  const std::vector<double> parameters{c10};
  if (values.empty() || !test.predict({rubber, parameters, own, abscissae}, {values, {}, {}, {}}).ok()) return {};
  constexpr double rounding = 1e-6;
  for (const double known : cauchy)
    for (const int q : {-1, 0, 1})
      if (std::abs(values[channel * rows.count] * std::pow(stretch, q + 1) - known) < rounding) return q;
  return {};
}

}  // namespace tunica::abscissa_errors
