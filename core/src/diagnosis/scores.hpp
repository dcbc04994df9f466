// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/hypotheses.hpp"
#include "diagnosis/noise_statement.hpp"

namespace tunica::diagnosis {

/// The rows of the whitened residuals that belong to one fitted channel.
struct Curve {
  std::string test, channel;
  Eigen::Index first = 0, count = 0;
  std::vector<double> abscissa;   ///< of each row
  std::vector<std::size_t> rows;  ///< of the test
  NoiseSource noise;
};

/// An orthonormal basis of the columns, each brought to length one first; what is then shorter than `least` left out.
Eigen::MatrixXd basis(Eigen::MatrixXd columns, double least);

/// What a refit of the fitted parameters absorbs: an orthonormal basis of the columns of J.
class Projection {
 public:
  explicit Projection(const Eigen::MatrixXd& J);
  /// v − Q Qᵀ v
  [[nodiscard]] Eigen::MatrixXd off(const Eigen::MatrixXd& v) const;
  [[nodiscard]] Eigen::Index rank() const { return Q_.cols(); }

 private:
  Eigen::MatrixXd Q_;
};

/// A projected signature: what of an effect is left when the other parameters are fitted again.
struct Direction {
  std::size_t candidate = 0, hypothesis = 0;
  Eigen::VectorXd unit;  ///< s̃/|s̃|
  double length = 0;     ///< |s̃|
  double retained = 0;   ///< |s̃|/|s|
  MechanismFactory::Side side = MechanismFactory::Side::both;
  double sign = 1;   ///< of the amplitude where the score is positive
  bool row = false;  ///< of a single row
  double share = 1;  ///< prior share among the directions of its candidate
};

/// Signatures that a refit absorbs but for this share are invisible: 0/0 would decide about them.
constexpr double invisible = 1e-4;

/// Projected signatures of all hypotheses; those that are absorbed are left out. Prior shares: whole curves and single
/// rows of a candidate are two kinds of equal weight, however many rows there are, and the directions of a kind are
/// equal.
std::vector<Direction> directions(const std::vector<Candidate>& candidates, const Projection& projection);

/// T = (ŝᵀr)² of a direction and the amplitude ŝᵀr/|s̃|, with r = measured − predicted; one-sided where the mechanism
/// is.
struct Score {
  double T = 0, amplitude = 0;  ///< even: the square of the amplitude
};
Score score(const Direction& direction, const Eigen::VectorXd& residuals);

/// Sets of residuals that would be seen if the base model were right: whitened noise with the uncertainty of its own
/// estimate, one column a draw, not yet projected.
Eigen::MatrixXf noise_draws(const std::vector<Curve>& curves, Eigen::Index rows, std::size_t draws, std::uint64_t seed);

/// Smooth shapes a misfit may have: for each curve Legendre polynomials of degree 0, 1, 2 along its rows; and where it
/// runs to and fro, of degree 0, 1 times the direction it runs in. Columns by curve.
struct Shapes {
  Eigen::MatrixXd columns;
  std::vector<std::size_t> curve;  ///< of each column
};
Shapes smooth_shapes(const std::vector<Curve>& curves, Eigen::Index rows);

}  // namespace tunica::diagnosis
