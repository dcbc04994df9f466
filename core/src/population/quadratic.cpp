// SPDX-License-Identifier: Apache-2.0
#include "population/quadratic.hpp"

#include <cmath>

#include <Eigen/LU>

namespace tunica::population {

namespace {

/// V = Ω(I + AΩ)⁻¹ and ln|I + AΩ|.
struct Shrinking {
  Eigen::MatrixXd V;
  double log_determinant;

  Shrinking(const Eigen::MatrixXd& A, const Eigen::MatrixXd& omega) {
    const Eigen::Index n = A.rows();
    // I + ΩA, the transpose of what is wanted: its solution with Ω on the right is V.
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(Eigen::MatrixXd::Identity(n, n) + omega * A);
    V = lu.solve(omega);
    V = (0.5 * (V + V.transpose())).eval();
    log_determinant = lu.matrixLU().diagonal().array().abs().log().sum();
  }
};

}  // namespace

Quadratic Quadratic::zero(Eigen::Index size) {
  return {Eigen::MatrixXd::Zero(size, size), Eigen::VectorXd::Zero(size), 0};
}

Quadratic& Quadratic::operator+=(const Quadratic& other) {
  information += other.information;
  score += other.score;
  constant += other.constant;
  return *this;
}

double Quadratic::at(const Eigen::VectorXd& z) const { return constant - 2 * score.dot(z) + z.dot(information * z); }

Quadratic integrated(const Quadratic& joint, const Eigen::MatrixXd& omega) {
  const Eigen::Index b = omega.rows(), x = joint.size() - b;
  const Shrinking shrinking(joint.information.bottomRightCorner(b, b), omega);
  const Eigen::MatrixXd across = joint.information.topRightCorner(x, b) * shrinking.V;
  const Eigen::VectorXd of_b = joint.score.tail(b);
  return {joint.information.topLeftCorner(x, x) - across * joint.information.bottomLeftCorner(b, x),
          joint.score.head(x) - across * of_b,
          joint.constant + shrinking.log_determinant - of_b.dot(shrinking.V * of_b)};
}

Quadratic about_mean(const Peak& specimen, const Eigen::MatrixXd& omega) {
  const Eigen::MatrixXd& A = specimen.information;
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(Eigen::MatrixXd::Identity(A.rows(), A.rows()) + A * omega);
  Eigen::MatrixXd W = lu.solve(A);
  W = (0.5 * (W + W.transpose())).eval();
  const Eigen::VectorXd score = W * specimen.mode;
  return {W, score, specimen.constant + score.dot(specimen.mode) + lu.matrixLU().diagonal().array().abs().log().sum()};
}

Quadratic mapped(const Quadratic& q, const Eigen::MatrixXd& map) {
  return {map.transpose() * q.information * map, map.transpose() * q.score, q.constant};
}

Gaussian posterior(const Peak& specimen, const Eigen::VectorXd& mean, const Eigen::MatrixXd& omega) {
  const Shrinking shrinking(specimen.information, omega);
  return {mean + shrinking.V * (specimen.information * (specimen.mode - mean)), shrinking.V};
}

}  // namespace tunica::population
