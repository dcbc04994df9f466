// SPDX-License-Identifier: Apache-2.0
#include "cohort/population_fit.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <tbb/parallel_for.h>

#include "cohort/index.hpp"

namespace tunica::cohort {

namespace {

using population::Individual;

constexpr std::size_t most_rounds = 40;
constexpr double settled = 1e-3;  ///< of a posterior standard deviation

/// The channels of a mode together, each with its noise.
population::Peak peak_of(const Mode& mode, const std::vector<double>& noise, double log_noise) {
  const Eigen::Index p = mode.at.size();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(p, p);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(p);
  double constant = log_noise;
  for (std::size_t c = 0; c < mode.channels.size(); ++c) {
    const double s = c < noise.size() ? noise[c] : 1;  // the last one is of priors
    information += mode.channels[c].information / (s * s);
    gradient += mode.channels[c].gradient / (s * s);
    constant += mode.channels[c].squares / (s * s) + 2 * static_cast<double>(mode.channels[c].rows) * std::log(s);
  }
  // The step to where the quadratic peaks; none along what the specimen does not say.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(information);
  const double least = 1e-12 * std::max(solver.eigenvalues().maxCoeff(), 1e-300);
  const Eigen::VectorXd along = solver.eigenvectors().transpose() * gradient;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(p);
  for (Eigen::Index k = 0; k < p; ++k)
    if (solver.eigenvalues()[k] > least) step -= along[k] / solver.eigenvalues()[k] * solver.eigenvectors().col(k);
  return {information, mode.at + step, constant + gradient.dot(step)};
}

/// F with F Fᵀ = Ω, also where Ω is singular.
Eigen::MatrixXd factor_of(const Eigen::MatrixXd& omega) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(omega);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

class Alternation {
 public:
  Alternation(Likelihoods& likelihoods, const Design& design, const PopulationSettings& settings)
      : likelihoods_(likelihoods), design_(design), settings_(settings), modes_(design.specimens.size()) {}

  PopulationFit run() {
    const std::size_t n = design_.specimens.size();
    log_noise_.assign(n, 0);
    widths_.resize(n);
    likelihoods_.for_each([&](std::size_t i, SpecimenLikelihood& one) {
      for (std::size_t c = 0; c + 1 < one.first().size(); ++c)
        widths_[i].push_back(one.noise_is_stated(c) ? -1 : one.noise(c));
    });
    share_noise();
    likelihoods_.for_each([&](std::size_t i, SpecimenLikelihood& one) {
      begin(i, one);
      const Eigen::MatrixXd nowhere = Eigen::MatrixXd::Zero(one.best().size(), one.best().size());
      modes_[i] = most_likely(one, one.best(), nowhere, fit_.noise, one.best());
      log_noise_[i] = one.log_noise();
    });
    const Eigen::Index p = modes_.front().at.size();
    fit_.structure.nested = design_.nested();
    fit_.structure.full = settings_.spread == SpreadStructure::full ||
                          (settings_.spread == SpreadStructure::automatic && carries_covariances(p, n));
    for (fit_.rounds = 1; fit_.rounds <= most_rounds; ++fit_.rounds) {
      expand();
      fit_.estimates = population::estimate(fit_.individuals, fit_.structure);
      deviations_of_animals();
      const double moved = move();
      if (settings_.noise == NoisePool::cohort) estimate_noise();
      if (moved < settled) {
        fit_.converged = true;
        break;
      }
    }
    expand();
    fit_.estimates = population::estimate(fit_.individuals, fit_.structure);
    deviations_of_animals();
    for (std::size_t i = 0; i < n; ++i)
      if (!modes_[i].status.ok()) fit_.failures.emplace_back(i, modes_[i].status.reason());
    return std::move(fit_);
  }

 private:
  /// With noise of the cohort, σ of a channel is the quadratic mean over the specimens.
  void share_noise() {
    const std::size_t channels = widths_.front().size();
    fit_.noise.assign(channels, 1);
    common_.assign(channels, 0);
    if (settings_.noise == NoisePool::specimen) return;
    for (std::size_t c = 0; c < channels; ++c) {
      double squares = 0;
      for (const auto& one : widths_) squares += one.at(c) * one.at(c);
      common_[c] = std::sqrt(squares / static_cast<double>(widths_.size()));
    }
  }
  /// The likelihoods may have been made anew: their noise is that of the specimen.
  void begin(std::size_t specimen, SpecimenLikelihood& one) {
    for (std::size_t c = 0; c < common_.size(); ++c)
      if (common_[c] > 0 && widths_[specimen][c] > 0) one.scale_noise(c, common_[c] / one.noise(c));
  }

  void expand() {
    fit_.individuals.clear();
    for (std::size_t i = 0; i < modes_.size(); ++i)
      fit_.individuals.push_back(
          {peak_of(modes_[i], fit_.noise, log_noise_[i]), design_.rows.row(index(i)).transpose(), design_.animals[i]});
  }

  void deviations_of_animals() {
    const std::size_t n = fit_.individuals.size();
    fit_.animal.assign(n, Eigen::VectorXd::Zero(modes_.front().at.size()));
    if (!fit_.structure.nested) return;
    for (std::size_t first = 0; first < n;) {
      std::size_t last = first;
      while (last < n && fit_.individuals[last].animal == fit_.individuals[first].animal) ++last;
      const auto of_animal = std::span(fit_.individuals).subspan(first, last - first);
      const Eigen::VectorXd a = population::animal_deviation(of_animal, fit_.estimates);
      for (; first < last; ++first) fit_.animal[first] = a;
    }
  }

  /// Moves every specimen to its most likely ξ; returns the longest way in posterior standard deviations.
  double move() {
    const Eigen::MatrixXd factor = factor_of(fit_.estimates.omega);
    std::vector<double> moved(modes_.size(), 0);
    likelihoods_.for_each([&](std::size_t i, SpecimenLikelihood& one) {
      begin(i, one);
      const Eigen::VectorXd mean = fit_.estimates.mean(fit_.individuals[i].design) + fit_.animal[i];
      Mode next = most_likely(one, mean, factor, fit_.noise, modes_[i].at);
      if (!next.status.ok()) return;  // it stays where it was
      const Eigen::VectorXd sd = fit_.shrunken(i).covariance.diagonal().cwiseSqrt().cwiseMax(1e-8);
      moved[i] = (next.at - modes_[i].at).cwiseQuotient(sd).cwiseAbs().maxCoeff();
      modes_[i] = std::move(next);
    });
    return *std::max_element(moved.begin(), moved.end());
  }

  /// s_c² = Σ_i (|r_ic|² + tr(A_ic V_i))/Σ_i n_ic, V_i the covariance of ξ_i with the uncertainty of its mean: the EM
  /// step of restricted likelihood (N. M. Laird, J. H. Ware, Biometrics 38:963, 1982).
  void estimate_noise() {
    for (std::size_t c = 0; c < fit_.noise.size(); ++c) {
      double squares = 0, rows = 0;
      for (std::size_t i = 0; i < modes_.size(); ++i) {
        if (widths_[i][c] < 0) continue;
        const population::Peak& data = fit_.individuals[i].data;
        const Eigen::MatrixXd V = fit_.shrunken(i).covariance;
        const Eigen::MatrixXd T = Eigen::MatrixXd::Identity(V.rows(), V.cols()) - V * data.information;
        const Eigen::MatrixXd of_mean = T * fit_.estimates.mean_covariance(fit_.individuals[i].design) * T.transpose();
        squares += modes_[i].channels[c].squares + (modes_[i].channels[c].information * (V + of_mean)).trace();
        rows += static_cast<double>(modes_[i].channels[c].rows);
      }
      if (rows > 0) fit_.noise[c] = std::sqrt(squares / rows);
    }
  }

  Likelihoods& likelihoods_;
  const Design& design_;
  const PopulationSettings& settings_;
  std::vector<Mode> modes_;
  std::vector<double> log_noise_, common_;
  std::vector<std::vector<double>> widths_;  ///< σ by specimen and channel; −1 = stated
  PopulationFit fit_;
};

}  // namespace

Likelihoods::Likelihoods(std::size_t count, Make make) : count_(count), make_(std::move(make)) {
  if (count <= most_kept) kept_.resize(count);
}

void Likelihoods::for_each(const std::function<void(std::size_t, SpecimenLikelihood&)>& call) {
  tbb::parallel_for(std::size_t{0}, count_, [&](std::size_t k) {
    if (kept_.empty()) {
      const auto once = make_(k);
      return call(k, *once);
    }
    if (!kept_[k]) kept_[k] = make_(k);
    call(k, *kept_[k]);
  });
}

population::Gaussian PopulationFit::shrunken(std::size_t specimen) const {
  const Individual& one = individuals[specimen];
  return population::posterior(one.data, estimates.mean(one.design) + animal[specimen], estimates.omega);
}

bool carries_covariances(Eigen::Index parameters, std::size_t specimens) {
  return parameters > 1 && parameters * (parameters + 1) + 10 <= static_cast<Eigen::Index>(specimens);
}

PopulationFit fit_population(Likelihoods& likelihoods, const Design& design, const PopulationSettings& settings) {
  return Alternation(likelihoods, design, settings).run();
}

}  // namespace tunica::cohort
