// SPDX-License-Identifier: Apache-2.0
#include "population/mixed_model.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <nlopt.hpp>

#include "numerics/distributions.hpp"

namespace tunica::population {

namespace {

using Vector = std::vector<double>;

/// B x as a linear map of vec B, column after column: xᵀ ⊗ I.
Eigen::MatrixXd design_map(const Eigen::VectorXd& design, Eigen::Index parameters) {
  Eigen::MatrixXd map = Eigen::MatrixXd::Zero(parameters, parameters * design.size());
  for (Eigen::Index k = 0; k < design.size(); ++k)
    map.middleCols(k * parameters, parameters).diagonal().setConstant(design[k]);
  return map;
}

/// Search variables ↔ covariances: ln of every standard deviation, then (full) the rows of a lower triangle, each made
/// a unit vector with 1 on the diagonal, then (nested) ln of every standard deviation of animals.
class Spreads {
 public:
  Spreads(Eigen::Index parameters, const Structure& structure) : p_(parameters), structure_(structure) {}

  [[nodiscard]] std::size_t count() const {
    const Eigen::Index below = structure_.full ? p_ * (p_ - 1) / 2 : 0;
    return static_cast<std::size_t>(p_ + below + (structure_.nested ? p_ : 0));
  }
  [[nodiscard]] Vector lower() const { return bounds(std::log(least_spread), -largest_tie); }
  [[nodiscard]] Vector upper() const { return bounds(std::log(largest_spread), largest_tie); }

  /// No correlation, and animals that differ as specimens do.
  void begin_ties_and_animals(Vector& x) const {
    const auto p = static_cast<std::size_t>(p_);
    for (std::size_t k = p; k < count(); ++k) x[k] = 0;
    for (std::size_t j = 0; structure_.nested && j < p; ++j) x[count() - p + j] = x[j];
  }

  [[nodiscard]] Eigen::MatrixXd omega(const Vector& x) const {
    Eigen::VectorXd sd(p_);
    for (Eigen::Index j = 0; j < p_; ++j) sd[j] = deviation(x[static_cast<std::size_t>(j)]);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Identity(p_, p_);
    auto next = static_cast<std::size_t>(p_);
    if (structure_.full)
      for (Eigen::Index i = 1; i < p_; ++i) {
        for (Eigen::Index j = 0; j < i; ++j) rows(i, j) = x[next++];
        rows.row(i).normalize();
      }
    const Eigen::MatrixXd factor = sd.asDiagonal() * rows;
    return factor * factor.transpose();
  }
  [[nodiscard]] Eigen::MatrixXd animals(const Vector& x) const {
    Eigen::MatrixXd omega = Eigen::MatrixXd::Zero(p_, p_);
    if (!structure_.nested) return omega;
    const std::size_t first = count() - static_cast<std::size_t>(p_);
    for (Eigen::Index j = 0; j < p_; ++j) omega(j, j) = std::pow(deviation(x[first + static_cast<std::size_t>(j)]), 2);
    return omega;
  }

 private:
  static constexpr double largest_tie = 5;  ///< a correlation of 0.98

  /// At its least a spread is none.
  static double deviation(double log_sd) { return log_sd <= std::log(least_spread) ? 0 : std::exp(log_sd); }

  [[nodiscard]] Vector bounds(double spread, double tie) const {
    Vector all(count(), spread);
    if (structure_.full) std::fill_n(all.begin() + p_, p_ * (p_ - 1) / 2, tie);
    return all;
  }

  Eigen::Index p_;
  Structure structure_;
};

/// −2 ln L at the best B, and unless `restricted` is false the term ln|information| of the restricted likelihood.
double neg2(const Quadratic& of_B, bool restricted) {
  const Eigen::LDLT<Eigen::MatrixXd> factor(of_B.information);
  if (factor.info() != Eigen::Success || !factor.isPositive()) return 1e100;
  const double squares = of_B.constant - of_B.score.dot(factor.solve(of_B.score));
  const double determinant = factor.vectorD().array().max(1e-300).log().sum();
  return squares + (restricted ? determinant : 0);
}

/// Standard deviations of what the specimens say each by itself; a start for the search.
Vector start_of(std::span<const Individual> individuals, const Spreads& spreads, Eigen::Index p) {
  Vector x = spreads.lower();
  std::fill(x.begin(), x.end(), std::log(0.1));
  std::vector<Vector> own(static_cast<std::size_t>(p));
  for (const Individual& one : individuals) {
    // A wide prior fills in what the specimen does not say.
    const Gaussian said = posterior(one.data, Eigen::VectorXd::Zero(p), 1e2 * Eigen::MatrixXd::Identity(p, p));
    for (Eigen::Index j = 0; j < p; ++j)
      if (said.covariance(j, j) < 1) own[static_cast<std::size_t>(j)].push_back(said.mean[j]);
  }
  for (std::size_t j = 0; j < own.size(); ++j) {
    const double n = static_cast<double>(own[j].size());
    if (n < 2) continue;
    double mean = 0, squares = 0;
    for (const double value : own[j]) mean += value / n;
    for (const double value : own[j]) squares += (value - mean) * (value - mean) / (n - 1);
    x[j] = std::clamp(0.5 * std::log(squares), std::log(1e-2), std::log(largest_spread) - 0.1);
  }
  spreads.begin_ties_and_animals(x);
  return x;
}

struct Search {
  std::span<const Individual> individuals;
  const Spreads& spreads;
  std::optional<std::pair<std::size_t, double>> held;
  bool restricted;

  [[nodiscard]] Vector full(const Vector& x) const {
    if (!held) return x;
    Vector all = x;
    all.insert(all.begin() + static_cast<std::ptrdiff_t>(held->first), held->second);
    return all;
  }
  [[nodiscard]] double value(const Vector& x) const {
    const Vector all = full(x);
    return neg2(fixed_effects(individuals, spreads.omega(all), spreads.animals(all)), restricted);
  }
};

Vector without(Vector x, const std::optional<std::pair<std::size_t, double>>& held) {
  if (held) x.erase(x.begin() + static_cast<std::ptrdiff_t>(held->first));
  return x;
}

struct Minimum {
  Vector at;
  double value;
  bool converged;
};

/// BOBYQA needs two variables.
Minimum minimise(const Search& search, Vector x, const Vector& lower, const Vector& upper) {
  if (x.empty()) return {x, search.value(x), true};
  nlopt::opt optimiser(x.size() > 1 ? nlopt::LN_BOBYQA : nlopt::LN_NELDERMEAD, static_cast<unsigned>(x.size()));
  optimiser.set_lower_bounds(lower);
  optimiser.set_upper_bounds(upper);
  optimiser.set_min_objective(
      [](const Vector& at, Vector&, void* data) { return static_cast<const Search*>(data)->value(at); },
      const_cast<Search*>(&search));
  optimiser.set_initial_step(0.5);
  optimiser.set_xtol_abs(1e-6);
  optimiser.set_ftol_abs(1e-9);
  optimiser.set_maxeval(4000);
  Minimum minimum{x, 0, false};
  try {
    const nlopt::result result = optimiser.optimize(minimum.at, minimum.value);
    minimum.converged = result > 0 && result != nlopt::MAXEVAL_REACHED;
  } catch (const nlopt::roundoff_limited&) {
    minimum.value = search.value(minimum.at);
    minimum.converged = true;  // it cannot do better in this arithmetic
  }
  return minimum;
}

}  // namespace

Eigen::MatrixXd Estimates::mean_covariance(const Eigen::VectorXd& design) const {
  const Eigen::MatrixXd map = design_map(design, B.rows());
  return map * covariance * map.transpose();
}

Quadratic fixed_effects(std::span<const Individual> individuals, const Eigen::MatrixXd& omega,
                        const Eigen::MatrixXd& omega_animals) {
  const Eigen::Index p = omega.rows(), columns = individuals.front().design.size(), n = p * columns;
  const bool nested = omega_animals.diagonal().maxCoeff() > 0;
  Quadratic total = Quadratic::zero(n), joint = Quadratic::zero(n + p);
  Eigen::MatrixXd map(p, n + p);
  map.rightCols(p).setIdentity();
  for (std::size_t i = 0; i < individuals.size(); ++i) {
    const Quadratic about = about_mean(individuals[i].data, omega);
    map.leftCols(n) = design_map(individuals[i].design, p);
    if (!nested) {
      total += mapped(about, map.leftCols(n));
      continue;
    }
    joint += mapped(about, map);
    if (i + 1 < individuals.size() && individuals[i + 1].animal == individuals[i].animal) continue;
    total += integrated(joint, omega_animals);
    joint = Quadratic::zero(n + p);
  }
  return total;
}

Estimates estimate(std::span<const Individual> individuals, const Structure& structure,
                   const std::optional<std::pair<std::size_t, double>>& held, bool restricted) {
  const Eigen::Index p = individuals.front().data.mode.size(), columns = individuals.front().design.size();
  const Spreads spreads(p, structure);
  const Search search{individuals, spreads, held, restricted};
  const Vector lower = without(spreads.lower(), held), upper = without(spreads.upper(), held);
  const Vector start = start_of(individuals, spreads, p);
  Minimum best = minimise(search, without(start, held), lower, upper);
  // From small spreads too: where one of them is zero, the likelihood is flat on the way there.
  Vector small = start;
  for (std::size_t j = 0; j < static_cast<std::size_t>(p); ++j) small[j] = std::max(small[j] - 2, spreads.lower()[j]);
  if (Minimum other = minimise(search, without(small, held), lower, upper); other.value < best.value - 1e-8)
    best = std::move(other);
  const Vector all = search.full(best.at);
  Estimates found;
  found.omega = spreads.omega(all);
  found.omega_animals = spreads.animals(all);
  const Quadratic of_B = fixed_effects(individuals, found.omega, found.omega_animals);
  const Eigen::LDLT<Eigen::MatrixXd> factor(of_B.information);
  const Eigen::VectorXd b = factor.solve(of_B.score);
  found.B = Eigen::Map<const Eigen::MatrixXd>(b.data(), p, columns);
  found.covariance = factor.solve(Eigen::MatrixXd::Identity(b.size(), b.size()));
  found.neg2_likelihood = neg2(of_B, false);
  found.neg2_restricted = neg2(of_B, true);
  found.spread_parameters = spreads.count();
  found.converged = best.converged;
  return found;
}

std::vector<SpreadInterval> spread_intervals(std::span<const Individual> individuals, const Structure& structure,
                                             const Estimates& estimates) {
  const double rise = numerics::chi_squared_quantile(0.95, 1);
  const double least = std::log(least_spread), most = std::log(largest_spread);
  std::vector<SpreadInterval> intervals;
  for (Eigen::Index j = 0; j < estimates.omega.rows(); ++j) {
    const auto above = [&](double log_sd) {
      return estimate(individuals, structure, {{static_cast<std::size_t>(j), log_sd}}).neg2_restricted -
             estimates.neg2_restricted - rise;
    };
    const double centre = std::max(0.5 * std::log(std::max(estimates.omega(j, j), 1e-300)), least);
    // The profile rises on both sides: halving the interval between the centre and the end.
    const auto crossing = [&](double inside, double outside) {
      for (int step = 0; step < 24; ++step) {
        const double middle = 0.5 * (inside + outside);
        (above(middle) > 0 ? outside : inside) = middle;
      }
      return std::exp(0.5 * (inside + outside));
    };
    SpreadInterval interval;
    if (above(least) > 0) interval.lower = crossing(centre, least);
    if (above(most) > 0) interval.upper = crossing(centre, most);
    intervals.push_back(interval);
  }
  return intervals;
}

Eigen::VectorXd animal_deviation(std::span<const Individual> of_animal, const Estimates& estimates) {
  Quadratic of_a = Quadratic::zero(estimates.omega.rows());
  for (const Individual& one : of_animal) {
    Quadratic about = about_mean(one.data, estimates.omega);
    about.score -= about.information * estimates.mean(one.design);
    of_a += about;
  }
  // Little is left of each specimen's information by now, so that the scores do not cancel.
  const Eigen::Index p = of_a.size();
  const Eigen::MatrixXd& omega = estimates.omega_animals;
  return (Eigen::MatrixXd::Identity(p, p) + omega * of_a.information).partialPivLu().solve(omega * of_a.score);
}

}  // namespace tunica::population
