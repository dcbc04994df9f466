// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/scores.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/QR>
#include <boost/random/gamma_distribution.hpp>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>

#include "tunica/random.hpp"

namespace tunica::diagnosis {

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
      found.push_back({c, h, left / length, length, retained, hypothesis.side, hypothesis.sign,
                       hypothesis.addition.target.row.has_value()});
    }
  std::map<std::pair<std::size_t, bool>, std::size_t> alike;  // of a candidate and kind
  for (const Direction& direction : found) ++alike[{direction.candidate, direction.row}];
  for (Direction& direction : found) {
    const bool both_kinds = alike.contains({direction.candidate, !direction.row});
    direction.share = (both_kinds ? 0.5 : 1.0) / static_cast<double>(alike[{direction.candidate, direction.row}]);
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
  // A correlation that was estimated a little wrong leaves some of it in the whitened rows of all curves alike.
  std::vector<double> left(draws);
  for (double& value : left) value = normal(generator);
  for (const Curve& curve : curves) {
    if (!(curve.noise.freedom > 0)) continue;
    // σ̂²/σ² ~ χ²_ν/ν
    boost::random::gamma_distribution<double> gamma(curve.noise.freedom / 2, 2 / curve.noise.freedom);
    for (Eigen::Index b = 0; b < all.cols(); ++b) {
      auto rows_of = all.col(b).segment(curve.first, curve.count);
      if (curve.noise.correlation_sd > 0) {
        const double rest = curve.noise.correlation_sd * left[static_cast<std::size_t>(b)];
        float before = 0;
        for (float& value : rows_of) before = value = value + static_cast<float>(rest) * before;
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

}  // namespace tunica::diagnosis
