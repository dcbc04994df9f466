// SPDX-License-Identifier: Apache-2.0
#include "cohort/bands.hpp"

#include <algorithm>
#include <cmath>

#include "cohort/index.hpp"
#include "population/predictive.hpp"
#include "tunica/random.hpp"

namespace tunica::cohort {

namespace {

constexpr std::size_t costly_draws = 100;  ///< where one evaluation takes long

double band_quantile(std::vector<double>& sorted, double probability) {
  const double at = probability * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const double share = at - static_cast<double>(below);
  return below + 1 < sorted.size() ? (1 - share) * sorted[below] + share * sorted[below + 1] : sorted.back();
}

/// Predictions of new specimens, one a draw; draws that cannot be evaluated are left out.
std::vector<Eigen::VectorXd> new_specimens(SpecimenLikelihood& specimen, const Eigen::MatrixXd& draws) {
  std::vector<Eigen::VectorXd> curves;
  Eigen::VectorXd predictions;
  for (Eigen::Index k = 0; k < draws.cols(); ++k)
    if (specimen.predict(draws.col(k), predictions, nullptr).ok()) curves.push_back(predictions);
  return curves;
}

}  // namespace

std::vector<Band> bands_of(const Members& members, const population::Population& population,
                           const Likelihoods& likelihoods, std::uint64_t seed) {
  std::vector<Band> bands;
  for (const Group& group : members.groups) {
    const auto specimen = likelihoods.make(group.specimens.front());
    const population::Predictive next = population::predictive(population, group.levels);
    Eigen::VectorXd of_mean;
    if (!specimen->predict(next.mean, of_mean, nullptr).ok()) continue;
    const std::size_t count = specimen->layout().has_costly_tests ? costly_draws : band_draws;
    const auto curves =
        new_specimens(*specimen, population::draws(next, derive_seed(seed, "band of " + group.name), count));
    if (2 * curves.size() < count) continue;  // most new specimens cannot be evaluated: no band to speak of
    for (const assembly::MeasuredChannel& view : specimen->layout().channels) {
      Band band{view.test,
                view.observable,
                view.unit,
                view.abscissa_name,
                view.abscissa_unit,
                group.name,
                view.abscissa,
                {},
                {},
                {}};
      std::vector<double> sorted(curves.size());
      for (std::size_t row = 0; row < view.count; ++row) {
        const Eigen::Index at = index(view.offset + row);
        for (std::size_t k = 0; k < curves.size(); ++k) sorted[k] = curves[k][at];
        std::sort(sorted.begin(), sorted.end());
        band.mean.push_back(of_mean[at]);
        band.lower.push_back(band_quantile(sorted, 0.025));
        band.upper.push_back(band_quantile(sorted, 0.975));
      }
      bands.push_back(std::move(band));
    }
  }
  return bands;
}

}  // namespace tunica::cohort
