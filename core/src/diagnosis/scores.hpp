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
  double sign = 1;  ///< of the amplitude where the score is positive
};

/// Signatures that a refit absorbs but for this share are invisible: 0/0 would decide about them.
constexpr double invisible = 1e-4;

/// Projected signatures of all hypotheses; those that are absorbed are left out.
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

/// The two tests for anything at all, calibrated by draws, and what each says.
class Detection {
 public:
  /// `draws` from noise_draws.
  Detection(const Projection& projection, const std::vector<Direction>& directions, std::size_t candidate_count,
            const Shapes& shapes, const Eigen::MatrixXf& draws);

  struct Verdict {
    double p = 1;                    ///< of the smaller of the two, calibrated
    double smooth = 1, largest = 1;  ///< of the smooth omnibus and of the largest score, each by itself
    double Q = 0;
    std::vector<double> by_candidate;    ///< p-value of the largest score of each; 1 where it has none
    std::vector<std::size_t> direction;  ///< that has it
    std::vector<double> by_curve;        ///< p-value of the smooth shapes of each curve
  };
  [[nodiscard]] Verdict judge(const Eigen::VectorXd& residuals) const;
  /// The score at which a candidate alone raises an alarm of this level.
  [[nodiscard]] double threshold(std::size_t candidate, double alpha) const;
  /// What the best mechanism gains on average where there is nothing to find.
  [[nodiscard]] double gain_of_nothing() const { return gain_of_nothing_; }

 private:
  [[nodiscard]] double candidate_p(std::size_t candidate, double T) const;
  [[nodiscard]] double smooth_p(double Q) const;
  [[nodiscard]] double combined_p(double smaller) const;

  const std::vector<Direction>& directions_;
  std::size_t candidates_;
  Eigen::MatrixXd smooth_;  ///< orthonormal
  std::vector<Eigen::MatrixXd> smooth_by_curve_;
  double smooth_scale_ = 1, gain_of_nothing_ = 0;
  std::vector<double> multiplicity_;   ///< K of p = K · P(χ²₁ > T) by candidate
  std::vector<float> smallest_;        ///< of the draws, ascending
  std::vector<float> smallest_score_;  ///< smallest p of a score, ascending
};

}  // namespace tunica::diagnosis
