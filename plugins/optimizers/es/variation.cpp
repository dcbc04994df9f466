// SPDX-License-Identifier: Apache-2.0
#include "variation.hpp"

#include <cmath>

namespace tunica::es {
namespace {

/// The triangle wave that folds the line onto [0, 1]: a mutation bounces off the wall.
double reflected(double x) {
  if (x >= 0 && x <= 1) return x;
  const double wave = std::abs(x - 2 * std::round(0.5 * x));  // period 2
  return std::min(wave, 1.0);
}

bool inside(std::span<const double> x) {
  return std::ranges::all_of(x, [](double value) { return value >= 0 && value <= 1; });
}

/// Lower Cholesky factor. A direction that has died out keeps a little width, or the factor would not exist.
void factorise(const Eigen::MatrixXd& matrix, Eigen::MatrixXd& factor) {
  const double least = 1e-14 * matrix.trace();
  for (Eigen::Index j = 0; j < matrix.rows(); ++j) {
    for (Eigen::Index i = j; i < matrix.rows(); ++i) {
      double rest = matrix(i, j);
      for (Eigen::Index k = 0; k < j; ++k) rest -= factor(i, k) * factor(j, k);
      factor(i, j) = i == j ? std::sqrt(std::max(rest, least)) : rest / factor(j, j);
    }
  }
}

}  // namespace

// Learning rates of log-normal self-adaptation. One step: σ ← σ exp(τ N), τ = 1/√(2n) (Beyer & Sendhoff 2008). A
// step an axis: σ_i ← σ_i exp(τ' N + τ N_i), τ' = 1/√(2n) for the factor in common, τ = 1/√(2√n) for each alone
// (Beyer & Schwefel 2002, section 4.2, after Schwefel).
Variation::Variation(const Settings& settings, std::size_t dimension)
    : settings_(settings),
      n_(dimension),
      learning_(1 / std::sqrt(2 * static_cast<double>(n_))),
      learning_axis_(1 / std::sqrt(2 * std::sqrt(static_cast<double>(n_)))),
      step_(settings.initial_step),
      weights_(settings.parents),
      mean_(n_),
      mean_steps_(steps_each(settings.adaptation, n_)),
      normals_(n_) {
  const auto size = static_cast<Eigen::Index>(n_);
  covariance_ = factor_ = update_ = Eigen::MatrixXd::Identity(size, size);
  step_path_ = covariance_path_ = shift_ = whitened_ = Eigen::VectorXd::Zero(size);
}

// Weights of the ranks: w_i ∝ ln(μ + ½) − ln i (Hansen & Ostermeier 2001; the best parent counts most), worth
// μ_w = 1/Σw² parents of equal weight. On the lamb aorta they save two fifths of the evaluations.
// Time constant of the covariance: τ_c = 1 + n(n+1)/(2 μ_w) generations, the free entries of C over the mutations
// that a generation selects (Beyer & Sendhoff 2008, with μ_w for their μ).
void Variation::weigh(std::size_t count) {
  if (count == std::exchange(weighed_, count)) return;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    weights_[i] = std::log(static_cast<double>(count) + 0.5) - std::log(static_cast<double>(i + 1));
    sum += weights_[i];
  }
  for (std::size_t i = 0; i < count; ++i) {
    weights_[i] /= sum;
    squares += weights_[i] * weights_[i];
  }
  effective_ = 1 / squares;
  covariance_rate_ = 1 / (1 + 0.5 * static_cast<double>(n_ * (n_ + 1)) * squares);
}

void Variation::prepare(const Population& parents, std::size_t count) {
  weigh(count);
  std::ranges::fill(mean_, 0.0);
  std::ranges::fill(mean_steps_, 0.0);
  for (std::size_t p = 0; p < count; ++p) {
    const auto x = parents.position(p), steps = parents.steps(p);
    for (std::size_t j = 0; j < n_; ++j) mean_[j] += weights_[p] * x[j];
    for (std::size_t j = 0; j < steps.size(); ++j) mean_steps_[j] += weights_[p] * steps[j];
  }
}

void Variation::recombine(const Population& parents, std::size_t count, Population& offspring, std::size_t i,
                          Random& random) {
  const auto x = offspring.position(i), steps = offspring.steps(i);
  if (settings_.recombination == Recombination::global) {
    std::ranges::copy(mean_, x.begin());
    std::ranges::copy(mean_steps_, steps.begin());
    return;
  }
  const std::size_t a = random.below(count);
  std::ranges::copy(parents.position(a), x.begin());
  std::ranges::copy(parents.steps(a), steps.begin());
  if (settings_.recombination == Recombination::none) return;
  // Steps of two parents are averaged in either case, as Beyer & Schwefel advise; positions averaged or mixed.
  const std::size_t b = random.below(count);
  const auto other = parents.position(b), other_steps = parents.steps(b);
  for (std::size_t j = 0; j < steps.size(); ++j) steps[j] = 0.5 * (steps[j] + other_steps[j]);
  for (std::size_t j = 0; j < n_; ++j) {
    if (settings_.recombination == Recombination::intermediate) {
      x[j] = 0.5 * (x[j] + other[j]);
    } else if (random.uniform() < 0.5) {
      x[j] = other[j];
    }
  }
}

// x = origin + σ s, s = M z, z ~ N(0, I), M Mᵀ = C.
void Variation::mutate(std::span<double> x, std::span<const double> origin, std::span<const double> steps,
                       Random& random) {
  for (double& value : normals_) value = random.normal();
  const bool oblique = settings_.adaptation == Adaptation::covariance;
  for (std::size_t j = 0; j < n_; ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    double s = oblique ? 0 : normals_[j];
    if (oblique) {
      for (Eigen::Index k = 0; k <= row; ++k) s += factor_(row, k) * normals_[static_cast<std::size_t>(k)];
    }
    x[j] = origin[j] + steps[steps.size() == 1 ? 0 : j] * s;
  }
}

void Variation::make(const Population& parents, std::size_t count, Population& offspring, std::size_t i,
                     Random& random) {
  recombine(parents, count, offspring, i, random);
  const auto x = offspring.position(i), mutation = offspring.mutation(i), steps = offspring.steps(i);
  const double common = cumulative() ? 1 : std::exp(learning_ * random.normal());
  const double longest = longest_step();
  for (double& step : steps) {
    step = cumulative() ? step_ : step * common;
    if (settings_.adaptation == Adaptation::axes) step *= std::exp(learning_axis_ * random.normal());
    if (!cumulative()) step = std::min(step, longest);
  }
  // The recombinant is kept in `mutation` until the step that was realised inside the box is known.
  std::ranges::copy(x, mutation.begin());
  const int attempts = settings_.bounds == Bounds::resample ? 20 : 1;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    mutate(x, mutation, steps, random);
    if (inside(x)) break;
  }
  for (std::size_t j = 0; j < n_; ++j) {
    x[j] = settings_.bounds == Bounds::clamp ? std::clamp(x[j], 0.0, 1.0) : reflected(x[j]);
    mutation[j] = (x[j] - mutation[j]) / steps[steps.size() == 1 ? 0 : j];
  }
}

// Rank-μ update C ← (1 − 1/τ_c) C + (1/τ_c) Σ w s sᵀ over the selected individuals (Beyer & Sendhoff 2008, eq. 7). With
// plus selection a parent that lives on counts again: its mutation is still among the successful ones.
void Variation::learn(const Population& parents, std::size_t count, std::uint64_t first_mutant) {
  if (settings_.adaptation != Adaptation::covariance) return;
  weigh(count);
  update_.setZero();
  double weight = 0;
  for (std::size_t p = 0; p < count; ++p) {
    if (parents.fitness(p).index < first_mutant) continue;
    const Eigen::Map<const Eigen::VectorXd> s(parents.mutation(p).data(), static_cast<Eigen::Index>(n_));
    update_.noalias() += weights_[p] * s * s.transpose();
    weight += weights_[p];
  }
  covariance_ += covariance_rate_ * (update_ - weight * covariance_);
  factorise(covariance_, factor_);
}

// The step and the covariance of CMA-ES (N. Hansen, The CMA evolution strategy: a tutorial, arXiv:1604.00772 (2016),
// equations 31, 24, 35, 30, with positive weights), for the shift y = Σ w s of the mean in units of the step:
//   p_σ ← (1 − c_σ) p_σ + √(c_σ(2 − c_σ)μ_w) M⁻¹y,    σ ← σ exp(c_σ/d_σ (‖p_σ‖/E‖N(0, I)‖ − 1)),
//   p_c ← (1 − c_c) p_c + h √(c_c(2 − c_c)μ_w) y,     C ← (1 − c_1 − c_μ) C + c_1 p_c p_cᵀ + c_μ Σ w s sᵀ.
// M is the Cholesky factor where Hansen has C^½: both make M⁻¹y a standard normal vector under random selection.
// With plus selection, too, the offspring alone are learnt from: parents that live on would say that steps are too
// long.
void Variation::follow(const Population& offspring, std::span<const std::size_t> best) {
  weigh(best.size());
  const double n = static_cast<double>(n_), mu = effective_;
  const double step_rate = (mu + 2) / (n + mu + 5);
  const double damping = 1 + 2 * std::max(0.0, std::sqrt((mu - 1) / (n + 1)) - 1) + step_rate;
  const double path_rate = (4 + mu / n) / (n + 4 + 2 * mu / n);
  const double one = 2 / ((n + 1.3) * (n + 1.3) + mu);
  const double many = std::min(1 - one, 2 * (mu - 2 + 1 / mu) / ((n + 2) * (n + 2) + mu));
  const double expected = std::sqrt(n) * (1 - 1 / (4 * n) + 1 / (21 * n * n));

  update_.setZero();
  shift_.setZero();
  for (std::size_t k = 0; k < best.size(); ++k) {
    const Eigen::Map<const Eigen::VectorXd> s(offspring.mutation(best[k]).data(), static_cast<Eigen::Index>(n_));
    shift_ += weights_[k] * s;
    update_.noalias() += weights_[k] * s * s.transpose();
  }
  whitened_ = shift_;
  factor_.triangularView<Eigen::Lower>().solveInPlace(whitened_);
  step_path_ = (1 - step_rate) * step_path_ + std::sqrt(step_rate * (2 - step_rate) * mu) * whitened_;
  const double length = step_path_.norm();
  const double warm = std::sqrt(1 - std::pow(1 - step_rate, 2 * static_cast<double>(++generation_)));
  const bool steady = length / warm < (1.4 + 2 / (n + 1)) * expected;
  covariance_path_ *= 1 - path_rate;
  if (steady) covariance_path_ += std::sqrt(path_rate * (2 - path_rate) * mu) * shift_;
  const double lost = steady ? 0 : one * path_rate * (2 - path_rate);
  covariance_ *= 1 - one - many + lost;
  covariance_.noalias() += one * covariance_path_ * covariance_path_.transpose();
  covariance_ += many * update_;
  factorise(covariance_, factor_);
  step_ = std::min(longest_step(), step_ * std::exp(step_rate / damping * (length / expected - 1)));
}

// The widest mutation is bounded, not σ itself: in a narrow valley C shrinks as a whole, and σ makes up for it. With
// σ ≤ 1 half of the searches of the known solution crept.
double Variation::longest_step() const {
  return settings_.adaptation == Adaptation::covariance ? 1 / std::sqrt(covariance_.diagonal().maxCoeff()) : 1;
}

double Variation::spread() const {
  double largest = 0;
  for (std::size_t j = 0; j < n_; ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    const double scale = settings_.adaptation == Adaptation::covariance ? std::sqrt(covariance_(row, row)) : 1;
    largest = std::max(largest, scale * (cumulative() ? step_ : mean_steps_[mean_steps_.size() == 1 ? 0 : j]));
  }
  return largest;
}

}  // namespace tunica::es
