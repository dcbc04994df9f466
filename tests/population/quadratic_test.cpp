// SPDX-License-Identifier: Apache-2.0
#include "population/quadratic.hpp"

#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace tunica::population {
namespace {

Eigen::MatrixXd random_matrix(std::mt19937& generator, Eigen::Index rows, Eigen::Index columns) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(generator); });
}

double value(const Peak& q, const Eigen::VectorXd& z) {
  return q.constant + (z - q.mode).dot(q.information * (z - q.mode));
}

/// −2 ln ∫ exp(−q(x + b)/2) N(b; 0, Ω) db, summed over a fine grid.
double by_summation(const Peak& q, const Eigen::Vector2d& x, const Eigen::Matrix2d& omega) {
  const Eigen::Matrix2d factor = omega.llt().matrixL();
  constexpr double step = 0.02, reach = 9;
  double sum = 0;
  for (double u = -reach; u <= reach; u += step)
    for (double v = -reach; v <= reach; v += step) {
      const Eigen::Vector2d z(u, v);
      sum += std::exp(-0.5 * value(q, x + factor * z) - 0.5 * z.squaredNorm());
    }
  return -2 * std::log(sum * step * step / (2 * M_PI));
}

TEST(Quadratic, AboutAMeanIsTheIntegralOverTheDeviation) {
  std::mt19937 generator(1);
  const Eigen::MatrixXd J = random_matrix(generator, 3, 2), F = random_matrix(generator, 2, 2);
  const Peak q{J.transpose() * J, random_matrix(generator, 2, 1), 0.7};
  const Eigen::Matrix2d omega = F * F.transpose() + 0.1 * Eigen::Matrix2d::Identity();
  const Quadratic about = about_mean(q, omega);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d x = 0.5 * random_matrix(generator, 2, 1);
    EXPECT_NEAR(about.at(x), by_summation(q, x, omega), 1e-9);
  }
}

TEST(Quadratic, IntegratedIsTheSameWhereTheDeviationIsAddedToTheMean) {
  std::mt19937 generator(2);
  const Eigen::MatrixXd J = random_matrix(generator, 5, 3);
  const Peak q{J.transpose() * J, random_matrix(generator, 3, 1), 0.2};
  const Quadratic plain{q.information, q.information * q.mode, q.constant + q.mode.dot(q.information * q.mode)};
  const Eigen::MatrixXd omega = Eigen::Vector3d(0.3, 0, 2).asDiagonal();
  Eigen::MatrixXd map(3, 6);
  map << Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Identity();
  const Quadratic one = about_mean(q, omega), other = integrated(mapped(plain, map), omega);
  EXPECT_LT((one.information - other.information).norm(), 1e-12);
  EXPECT_LT((one.score - other.score).norm(), 1e-12);
  EXPECT_NEAR(one.constant, other.constant, 1e-12);
}

TEST(Quadratic, WithoutAnyInformationSaysNothingAboutTheMean) {
  const Quadratic about =
      about_mean({Eigen::Matrix2d::Zero(), Eigen::Vector2d::Zero(), 0}, Eigen::Matrix2d::Identity());
  EXPECT_EQ(about.information.norm(), 0);
  EXPECT_EQ(about.constant, 0);
}

TEST(Quadratic, PosteriorWeighsDataAndPopulationByTheirInformation) {
  // One coordinate: the data say 3 ± 0.5, the population 1 ± 2.
  const Peak q{Eigen::MatrixXd::Constant(1, 1, 4), Eigen::VectorXd::Constant(1, 3), 0};
  const Gaussian known = posterior(q, Eigen::VectorXd::Constant(1, 1.0), Eigen::MatrixXd::Constant(1, 1, 4));
  EXPECT_NEAR(known.mean[0], (4 * 3 + 0.25 * 1) / 4.25, 1e-14);
  EXPECT_NEAR(known.covariance(0, 0), 1 / 4.25, 1e-14);
  // What does not vary stays at its mean.
  EXPECT_EQ(posterior(q, Eigen::VectorXd::Constant(1, 1.0), Eigen::MatrixXd::Zero(1, 1)).mean[0], 1);
}

}  // namespace
}  // namespace tunica::population
