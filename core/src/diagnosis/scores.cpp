// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/scores.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/random/gamma_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "tunica/random.hpp"

namespace tunica::diagnosis {
namespace {

/// An orthonormal basis of the columns, each brought to length one first; those of relative length below `least` left
/// out.
Eigen::MatrixXd basis(Eigen::MatrixXd columns, double least) {
  Eigen::Index kept = 0;
  double longest = 0;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) longest = std::max(longest, columns.col(k).norm());
  for (Eigen::Index k = 0; k < columns.cols(); ++k)
    if (const double length = columns.col(k).norm(); length > 1e-12 * longest && length > 0)
      columns.col(kept++) = (columns.col(k) / length).eval();
  if (kept == 0) return Eigen::MatrixXd(columns.rows(), 0);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns.leftCols(kept));
  qr.setThreshold(least);
  return qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

double tail(double T) {
  return T > 0 ? std::erfc(std::sqrt(T / 2)) : 1.0;  // P(χ²₁ > T)
}

double tail(double Q, double freedom) {
  return Q > 0 ? boost::math::cdf(boost::math::complement(boost::math::chi_squared(freedom), Q)) : 1.0;
}

/// The share of ascending values up to `value`; below the lowest 2 % of them by a straight line through 0.
double share_up_to(const std::vector<float>& ascending, double value) {
  const auto count =
      std::upper_bound(ascending.begin(), ascending.end(), static_cast<float>(value)) - ascending.begin();
  const std::size_t low = ascending.size() / 50;
  if (low > 0 && static_cast<std::size_t>(count) < low) return value / static_cast<double>(ascending[low]) * 0.02;
  return static_cast<double>(count) / static_cast<double>(ascending.size());
}

}  // namespace

Projection::Projection(const Eigen::MatrixXd& J) : Q_(basis(J, 1e-8)) {}

Eigen::MatrixXd Projection::off(const Eigen::MatrixXd& v) const {
  // Twice, for orthogonality to the last digits.
  Eigen::MatrixXd left = v - Q_ * (Q_.transpose() * v);
  left -= Q_ * (Q_.transpose() * left);
  return left;
}

std::vector<Direction> directions(const std::vector<Candidate>& candidates, const Projection& projection) {
  std::vector<Direction> found;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (std::size_t h = 0; h < candidates[c].hypotheses.size(); ++h) {
      const Eigen::VectorXd& s = candidates[c].hypotheses[h].signature;
      const Eigen::VectorXd left = projection.off(s);
      const double length = left.norm(), retained = length / s.norm();
      if (!(retained > invisible)) continue;
      const Hypothesis& hypothesis = candidates[c].hypotheses[h];
      found.push_back({c, h, left / length, length, retained, hypothesis.side, hypothesis.sign});
    }
  return found;
}

Score score(const Direction& direction, const Eigen::VectorXd& residuals) {
  const double t = direction.unit.dot(residuals);
  if (direction.side != MechanismFactory::Side::both && t < 0) return {0, 0};
  return {t * t, direction.sign * t / direction.length};
}

Eigen::MatrixXf noise_draws(const std::vector<Curve>& curves, Eigen::Index rows, std::size_t draws,
                            std::uint64_t seed) {
  boost::random::mt19937_64 generator(derive_seed(seed, "noise draws"));
  boost::random::normal_distribution<double> normal;
  Eigen::MatrixXf all(rows, static_cast<Eigen::Index>(draws));
  for (Eigen::Index b = 0; b < all.cols(); ++b)
    for (Eigen::Index i = 0; i < rows; ++i) all(i, b) = static_cast<float>(normal(generator));
  for (const Curve& curve : curves) {
    if (!(curve.noise.freedom > 0)) continue;
    // σ̂²/σ² ~ χ²_ν/ν; a correlation that was estimated a little wrong leaves some of it in the whitened rows.
    boost::random::gamma_distribution<double> gamma(curve.noise.freedom / 2, 2 / curve.noise.freedom);
    for (Eigen::Index b = 0; b < all.cols(); ++b) {
      auto rows_of = all.col(b).segment(curve.first, curve.count);
      if (curve.noise.correlation_sd > 0) {
        const double left = curve.noise.correlation_sd * normal(generator);
        float before = 0;
        for (float& value : rows_of) before = value = value + static_cast<float>(left) * before;
      }
      rows_of /= static_cast<float>(std::sqrt(std::max(gamma(generator), 1e-6)));
    }
  }
  return all;
}

Shapes smooth_shapes(const std::vector<Curve>& curves, Eigen::Index rows) {
  Shapes shapes;
  std::vector<Eigen::VectorXd> columns;
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const Curve& curve = curves[c];
    const auto [low, high] = std::minmax_element(curve.abscissa.begin(), curve.abscissa.end());
    const bool spread = *high > *low;
    std::vector<double> direction(curve.abscissa.size(), 0);
    bool up = false, down = false;
    for (std::size_t i = 0; i < curve.abscissa.size(); ++i) {
      const std::size_t from = i > 0 ? i - 1 : 0, to = i > 0 ? i : std::min<std::size_t>(1, curve.abscissa.size() - 1);
      const double step = curve.abscissa[to] - curve.abscissa[from];
      direction[i] = step > 0 ? 1 : step < 0 ? -1 : i > 0 ? direction[i - 1] : 0;
      up |= step > 0, down |= step < 0;
    }
    for (int degree = 0; degree < (up && down ? 5 : 3); ++degree) {
      Eigen::VectorXd column = Eigen::VectorXd::Zero(rows);
      for (Eigen::Index i = 0; i < curve.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double u = spread ? 2 * (curve.abscissa[k] - *low) / (*high - *low) - 1 : 0;
        const double legendre[] = {1, u, 1.5 * u * u - 0.5};
        column[curve.first + i] = degree < 3 ? legendre[degree] : legendre[degree - 3] * direction[k];
      }
      columns.push_back(std::move(column)), shapes.curve.push_back(c);
    }
  }
  shapes.columns.resize(rows, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) shapes.columns.col(static_cast<Eigen::Index>(k)) = columns[k];
  return shapes;
}

Detection::Detection(const Projection& projection, const std::vector<Direction>& directions,
                     std::size_t candidate_count, const Shapes& shapes, const Eigen::MatrixXf& draws)
    : directions_(directions), candidates_(candidate_count), multiplicity_(candidate_count, 1.0) {
  const Eigen::MatrixXd projected = projection.off(shapes.columns);
  // What a refit absorbs to less than a per cent is no shape that residuals can have.
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

  // Only what the columns of Q and the directions see matters, and both are orthogonal to J: draws need no projection.
  const Eigen::Index B = draws.cols();
  Eigen::MatrixXf units(draws.rows(), static_cast<Eigen::Index>(directions.size()));
  for (std::size_t k = 0; k < directions.size(); ++k)
    units.col(static_cast<Eigen::Index>(k)) = directions[k].unit.cast<float>();
  const Eigen::MatrixXf t = units.transpose() * draws;
  Eigen::MatrixXf largest = Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(candidates_), B);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const bool both = directions[k].side == MechanismFactory::Side::both;
    const auto row = static_cast<Eigen::Index>(directions[k].candidate);
    for (Eigen::Index b = 0; b < B; ++b) {
      const float value = t(static_cast<Eigen::Index>(k), b);
      if (both || value > 0) largest(row, b) = std::max(largest(row, b), value * value);
    }
  }
  if (candidates_ > 0) gain_of_nothing_ = static_cast<double>(largest.colwise().maxCoeff().mean());
  // p = K P(χ²₁ > T): K from the points that one draw in ten, twenty and fifty exceeds.
  std::vector<float> sorted(static_cast<std::size_t>(B));
  for (std::size_t c = 0; c < candidates_; ++c) {
    for (Eigen::Index b = 0; b < B; ++b) sorted[static_cast<std::size_t>(b)] = largest(static_cast<Eigen::Index>(c), b);
    std::sort(sorted.begin(), sorted.end());
    double log_sum = 0;
    int points = 0;
    for (const double share : {0.1, 0.05, 0.02}) {
      const float T = sorted[static_cast<std::size_t>((1 - share) * static_cast<double>(B))];
      if (T > 0) log_sum += std::log(share / tail(static_cast<double>(T))), ++points;
    }
    multiplicity_[c] = points > 0 ? std::exp(log_sum / points) : 1;
  }
  const Eigen::MatrixXf seen = smooth_.cast<float>().transpose() * draws;
  const Eigen::VectorXf Q = seen.colwise().squaredNorm().transpose();
  if (smooth_.cols() > 0) smooth_scale_ = static_cast<double>(Q.mean()) / static_cast<double>(smooth_.cols());
  for (Eigen::Index b = 0; b < B; ++b) {
    double p = 1;
    for (std::size_t c = 0; c < candidates_; ++c)
      p = std::min(p, candidate_p(c, static_cast<double>(largest(static_cast<Eigen::Index>(c), b))));
    smallest_score_.push_back(static_cast<float>(p));
  }
  std::vector<float> ascending = smallest_score_;
  std::sort(ascending.begin(), ascending.end());
  std::vector<float> unsorted = std::move(smallest_score_);
  smallest_score_ = std::move(ascending);
  for (Eigen::Index b = 0; b < B; ++b) {
    const double by_score = share_up_to(smallest_score_, static_cast<double>(unsorted[static_cast<std::size_t>(b)]));
    smallest_.push_back(static_cast<float>(std::min(by_score, smooth_p(static_cast<double>(Q[b])))));
  }
  std::sort(smallest_.begin(), smallest_.end());
}

double Detection::candidate_p(std::size_t candidate, double T) const {
  return T > 0 ? std::min(1.0, multiplicity_[candidate] * tail(T)) : 1.0;
}

double Detection::smooth_p(double Q) const {
  return smooth_.cols() == 0 ? 1.0 : tail(Q / smooth_scale_, static_cast<double>(smooth_.cols()));
}

double Detection::combined_p(double smaller) const { return std::min(1.0, share_up_to(smallest_, smaller)); }

Detection::Verdict Detection::judge(const Eigen::VectorXd& residuals) const {
  Verdict verdict;
  verdict.by_candidate.assign(candidates_, 1.0), verdict.direction.assign(candidates_, directions_.size());
  std::vector<double> best(candidates_, -1);
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const double T = score(directions_[k], residuals).T;
    const std::size_t c = directions_[k].candidate;
    if (T > best[c]) best[c] = T, verdict.direction[c] = k;
  }
  double smallest = 1;
  for (std::size_t c = 0; c < candidates_; ++c) {
    verdict.by_candidate[c] = candidate_p(c, best[c]);
    smallest = std::min(smallest, verdict.by_candidate[c]);
  }
  verdict.largest = share_up_to(smallest_score_, smallest);
  verdict.Q = (smooth_.transpose() * residuals).squaredNorm();
  verdict.smooth = smooth_p(verdict.Q);
  verdict.p = combined_p(std::min(verdict.largest, verdict.smooth));
  for (const Eigen::MatrixXd& own : smooth_by_curve_)
    verdict.by_curve.push_back(own.cols() == 0 ? 1.0
                                               : tail((own.transpose() * residuals).squaredNorm() / smooth_scale_,
                                                      static_cast<double>(own.cols())));
  return verdict;
}

double Detection::threshold(std::size_t candidate, double alpha) const {
  // The smaller of two p-values is at `alpha`, calibrated, when it is at about half of that; then back through K.
  const double smaller =
      static_cast<double>(smallest_[static_cast<std::size_t>(alpha * static_cast<double>(smallest_.size()))]);
  const double p = static_cast<double>(
      smallest_score_[static_cast<std::size_t>(smaller * static_cast<double>(smallest_score_.size()))]);
  double low = 0, high = 200;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (candidate_p(candidate, middle) > p ? low : high) = middle;
  }
  return high;
}

}  // namespace tunica::diagnosis
