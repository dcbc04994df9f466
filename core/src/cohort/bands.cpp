// SPDX-License-Identifier: Apache-2.0
#include "cohort/bands.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <fmt/format.h>

#include "cohort/index.hpp"
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
std::vector<Eigen::VectorXd> new_specimens(SpecimenLikelihood& specimen, const Eigen::VectorXd& mean,
                                           const Eigen::MatrixXd& covariance, std::size_t draws, std::uint64_t seed) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  const Eigen::MatrixXd factor = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
  boost::random::mt19937_64 generator(seed);
  boost::random::normal_distribution<double> normal;
  std::vector<Eigen::VectorXd> curves;
  Eigen::VectorXd z(mean.size()), predictions;
  for (std::size_t draw = 0; draw < draws; ++draw) {
    for (double& one : z) one = normal(generator);
    if (specimen.predict(mean + factor * z, predictions, nullptr).ok()) curves.push_back(predictions);
  }
  return curves;
}

}  // namespace

std::vector<Band> bands_of(const Design& design, const PopulationFit& fit, const Likelihoods& likelihoods,
                           std::uint64_t seed) {
  std::vector<Band> bands;
  for (const Design::Group& group : design.groups()) {
    const auto specimen = likelihoods.make(group.specimens.front());
    const Eigen::VectorXd mean = fit.estimates.mean(group.row);
    const Eigen::MatrixXd covariance =
        fit.estimates.omega + fit.estimates.omega_animals + fit.estimates.mean_covariance(group.row);
    Eigen::VectorXd of_mean;
    if (!specimen->predict(mean, of_mean, nullptr).ok()) continue;
    const std::size_t draws = specimen->layout().has_costly_tests ? costly_draws : band_draws;
    const auto curves = new_specimens(*specimen, mean, covariance, draws, derive_seed(seed, "band of " + group.name));
    if (2 * curves.size() < draws) continue;  // most new specimens cannot be evaluated: no band to speak of
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
