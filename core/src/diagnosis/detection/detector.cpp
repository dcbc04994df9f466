// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/detection/detector.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assembly/restricted_variance.hpp"
#include "numerics/distributions.hpp"

namespace tunica::diagnosis {
namespace {

using Side = MechanismFactory::Side;

double tail(double T) {
  return T > 0 ? std::erfc(std::sqrt(T / 2)) : 1.0;  // P(χ²₁ > T)
}

double tail(double Q, double freedom) { return Q > 0 ? numerics::chi_squared_above(Q, freedom) : 1.0; }

/// The share of ascending values up to `value`; below the lowest 2 % of them by a straight line through 0.
double share_up_to(const std::vector<float>& ascending, double value) {
  const auto count =
      std::upper_bound(ascending.begin(), ascending.end(), static_cast<float>(value)) - ascending.begin();
  const std::size_t low = ascending.size() / 50;
  if (low > 0 && static_cast<std::size_t>(count) < low) return value / static_cast<double>(ascending[low]) * 0.02;
  return static_cast<double>(count) / static_cast<double>(ascending.size());
}

/// {1 two-sided, 2Φ(t) one-sided} · exp(T/2), T = t² on the admissible side, else 0.
template <class Number>
Number likelihood(Side side, Number t) {
  if (side == Side::both) return std::exp(std::min(t * t / 2, Number(80)));
  if (t <= 0) return 1;
  return std::erfc(-t / std::sqrt(Number(2))) * std::exp(std::min(t * t / 2, Number(80)));
}

}  // namespace

Detector::Detector(const Projection& projection, std::vector<Direction> directions, std::size_t candidate_count,
                   const Shapes& shapes, const Draws& draws)
    : directions_(std::move(directions)), candidates_(candidate_count), multiplicity_(candidate_count, 1.0) {
  const Eigen::MatrixXd projected = projection.off(shapes.columns);
  // A refit absorbs more than 99 % of these shapes, so residuals cannot have them.
  std::vector<Eigen::Index> kept;
  for (Eigen::Index k = 0; k < projected.cols(); ++k)
    if (projected.col(k).norm() > 0.01 * shapes.columns.col(k).norm()) kept.push_back(k);
  smooth_ = basis(projected(Eigen::all, kept), 1e-3);
  const std::size_t curves = shapes.curve.empty() ? 0 : shapes.curve.back() + 1;
  for (std::size_t c = 0; c < curves; ++c) {
    std::vector<Eigen::Index> own;
    for (const Eigen::Index k : kept)
      if (shapes.curve[static_cast<std::size_t>(k)] == c) own.push_back(k);
    smooth_by_curve_.push_back(basis(projected(Eigen::all, own), 1e-3));
  }

  const Eigen::Index B = draws.residuals.cols();
  std::vector<char> has_direction(candidates_, 0);
  for (const Direction& direction : directions_) has_direction[direction.candidate] = 1;
  visible_ = static_cast<std::size_t>(std::count(has_direction.begin(), has_direction.end(), 1));
  const auto [Q, t] = seen_of(projection, draws);
  Eigen::MatrixXf largest = Eigen::MatrixXf::Zero(B, static_cast<Eigen::Index>(candidates_));
  Eigen::VectorXf sum = Eigen::VectorXf::Zero(B);
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k), candidate = static_cast<Eigen::Index>(directions_[k].candidate);
    const Side side = directions_[k].side;
    const float share = static_cast<float>(directions_[k].share);
    for (Eigen::Index b = 0; b < B; ++b) {
      const float value = t(b, column);
      sum[b] += share * likelihood(side, value);
      if (side == Side::both || value > 0) largest(b, candidate) = std::max(largest(b, candidate), value * value);
    }
  }
  if (candidates_ > 0) gain_of_nothing_ = static_cast<double>(largest.rowwise().maxCoeff().mean());
  // p = K P(χ²₁ > T) of one candidate: K from the points that one draw in ten, twenty and fifty exceeds.
  std::vector<float> sorted(static_cast<std::size_t>(B));
  for (std::size_t c = 0; c < candidates_; ++c) {
    const auto column = largest.col(static_cast<Eigen::Index>(c));
    std::copy(column.begin(), column.end(), sorted.begin());
    std::sort(sorted.begin(), sorted.end());
    double log_sum = 0;
    int points = 0;
    for (const double share : {0.1, 0.05, 0.02}) {
      const float T = sorted[static_cast<std::size_t>((1 - share) * static_cast<double>(B))];
      if (T > 0) {
        log_sum += std::log(share / tail(static_cast<double>(T)));
        ++points;
      }
    }
    multiplicity_[c] = points > 0 ? std::exp(log_sum / points) : 1;
  }
  if (smooth_.cols() > 0) smooth_scale_ = static_cast<double>(Q.mean()) / static_cast<double>(smooth_.cols());
  for (Eigen::Index b = 0; b < B; ++b)
    likelihoods_.push_back(visible_ == 0 ? 0.0F : std::log(sum[b] / static_cast<float>(visible_)));
  std::vector<float> of_draws = likelihoods_;
  std::sort(likelihoods_.begin(), likelihoods_.end());
  for (std::size_t b = 0; b < of_draws.size(); ++b)
    smallest_.push_back(
        static_cast<float>(std::min(mechanisms_p(static_cast<double>(of_draws[b])),
                                    smooth_price * smooth_p(static_cast<double>(Q[static_cast<Eigen::Index>(b)])))));
  std::sort(smallest_.begin(), smallest_.end());
}

Detector::Seen Detector::seen_of(const Projection& projection, const Draws& draws) const {
  const Eigen::MatrixXf smooth = smooth_.cast<float>();
  const Eigen::MatrixXf& residuals = draws.residuals;
  Eigen::MatrixXf units(residuals.rows(), static_cast<Eigen::Index>(directions_.size()));
  for (std::size_t k = 0; k < directions_.size(); ++k)
    units.col(static_cast<Eigen::Index>(k)) = directions_[k].unit.cast<float>();
  // Only components along the columns of Q and the directions matter. Both are orthogonal to J, so draws need no
  // projection.
  if (draws.precision.rows() == 0)
    return {(smooth.transpose() * residuals).colwise().squaredNorm().transpose(), residuals.transpose() * units};

  // A draw weighted by its own σ̂ is no longer orthogonal to J, so it is projected first.
  const Eigen::Index groups = draws.precision.rows();
  Eigen::MatrixXf squares = Eigen::MatrixXf::Zero(groups + 1, units.cols());  // Σ u² by group, the rest last
  for (Eigen::Index i = 0; i < units.rows(); ++i) {
    const std::size_t g = draws.group[static_cast<std::size_t>(i)];
    squares.row(g == assembly::known_variance ? groups : static_cast<Eigen::Index>(g)) += units.row(i).cwiseAbs2();
  }
  Seen seen{Eigen::VectorXf(residuals.cols()), Eigen::MatrixXf(residuals.cols(), units.cols())};
  constexpr Eigen::Index at_once = 500;  // draws
  for (Eigen::Index first = 0; first < residuals.cols(); first += at_once) {
    const Eigen::Index count = std::min(at_once, residuals.cols() - first);
    Eigen::MatrixXf scale = Eigen::MatrixXf::Ones(residuals.rows(), count);  // σ/σ̂
    for (Eigen::Index i = 0; i < scale.rows(); ++i)
      if (const std::size_t g = draws.group[static_cast<std::size_t>(i)]; g != assembly::known_variance)
        scale.row(i) = draws.precision.row(static_cast<Eigen::Index>(g)).segment(first, count).cwiseSqrt();
    const Eigen::MatrixXd unit_noise = residuals.middleCols(first, count).cwiseQuotient(scale).cast<double>();
    const Eigen::MatrixXf whitened = projection.off(unit_noise).cast<float>().cwiseProduct(scale);
    seen.Q.segment(first, count) = (smooth.transpose() * whitened).colwise().squaredNorm().transpose();
    Eigen::MatrixXf precision = Eigen::MatrixXf::Ones(groups + 1, count);
    precision.topRows(groups) = draws.precision.middleCols(first, count);
    seen.t.middleRows(first, count) =
        (whitened.cwiseProduct(scale).transpose() * units).cwiseQuotient((precision.transpose() * squares).cwiseSqrt());
  }
  return seen;
}

double Detector::candidate_p(std::size_t candidate, double T) const {
  return T > 0 ? std::min(1.0, multiplicity_[candidate] * tail(T)) : 1.0;
}

double Detector::smooth_p(double Q) const {
  return smooth_.cols() == 0 ? 1.0 : tail(Q / smooth_scale_, static_cast<double>(smooth_.cols()));
}

double Detector::mechanisms_p(double B) const {
  if (visible_ == 0) return 1;
  // Beyond the highest 2 % of the draws, the p-value falls as e^−B, because the mean of e^B over draws is one.
  const std::size_t n = likelihoods_.size(), high = n - std::max<std::size_t>(n / 50, 1);
  const double edge = static_cast<double>(likelihoods_[high]);
  if (B > edge) return static_cast<double>(n - high) / static_cast<double>(n) * std::exp(edge - B);
  const auto above =
      likelihoods_.end() - std::lower_bound(likelihoods_.begin(), likelihoods_.end(), static_cast<float>(B));
  return static_cast<double>(above) / static_cast<double>(n);
}

Detection Detector::test(const Eigen::VectorXd& given, const Eigen::VectorXd& precision) const {
  const bool weighed = precision.size() > 0;
  const Eigen::VectorXd residuals = weighed ? Eigen::VectorXd(given.cwiseProduct(precision.cwiseSqrt())) : given;
  const auto score_of = [&](const Direction& direction) {
    if (!weighed) return score(direction, residuals).T;
    const double t =
        direction.unit.cwiseProduct(precision).dot(given) / std::sqrt(direction.unit.cwiseAbs2().dot(precision));
    return direction.side != Side::both && t < 0 ? 0.0 : t * t;
  };
  Detection detection;
  detection.by_candidate.assign(candidates_, 1.0);
  detection.direction.assign(candidates_, directions_.size());
  std::vector<double> best(candidates_, -1), logs;
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const Direction& direction = directions_[k];
    const double T = score_of(direction);
    const std::size_t c = direction.candidate;
    if (T > best[c] * (1 + 1e-9)) {  // of places that are equal but for rounding the first
      best[c] = T;
      detection.direction[c] = k;
    }
    const double sides = direction.side == Side::both ? 1 : std::erfc(-std::sqrt(T / 2));
    logs.push_back(T / 2 + std::log(direction.share * sides));
  }
  for (std::size_t c = 0; c < candidates_; ++c) detection.by_candidate[c] = candidate_p(c, best[c]);
  if (!logs.empty()) {
    const double top = *std::max_element(logs.begin(), logs.end());
    double sum = 0;
    for (const double value : logs) sum += std::exp(value - top);
    detection.mechanisms = mechanisms_p(top + std::log(sum / static_cast<double>(visible_)));
  }
  detection.Q = (smooth_.transpose() * residuals).squaredNorm();
  detection.smooth = smooth_p(detection.Q);
  detection.p = std::min(1.0, share_up_to(smallest_, std::min(detection.mechanisms, smooth_price * detection.smooth)));
  for (const Eigen::MatrixXd& own : smooth_by_curve_)
    detection.by_curve.push_back(own.cols() == 0 ? 1.0
                                                 : tail((own.transpose() * residuals).squaredNorm() / smooth_scale_,
                                                        static_cast<double>(own.cols())));
  return detection;
}

double Detector::threshold(std::size_t candidate, double alpha) const {
  // The p_B that raises the alarm, its B, and the T of a single direction that gives this B while all others are 0.
  const auto at = static_cast<std::size_t>(alpha * static_cast<double>(smallest_.size()));
  const double p = std::max(static_cast<double>(smallest_[at]), 1e-6);
  double low = 0, high = 60;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (mechanisms_p(middle) > p ? low : high) = middle;
  }
  double share = 1;
  for (const Direction& direction : directions_)
    if (direction.candidate == candidate && !direction.row) share = std::min(share, direction.share);
  // e^B is the mean over visible candidates; a candidate without evidence contributes 1: V e^B = V − s + s e^{T/2}.
  return 2 * std::log1p(static_cast<double>(visible_) * std::expm1(high) / share);
}

}  // namespace tunica::diagnosis
