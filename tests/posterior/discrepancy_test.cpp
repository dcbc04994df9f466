// SPDX-License-Identifier: Apache-2.0
// The likelihood beside a smooth misfit, against the same written out with dense matrices.
#include "posterior/discrepancy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "assembly/curve_shapes.hpp"
#include "posterior/target.hpp"
#include "uncertainty/local.hpp"

using namespace tunica;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double noise = 0.1, range = 14;  // of y = 1 + 2x from 0 to 7

/// 30 rows, every third held out.
struct Case {
  Case() : line(30) {
    line.experiment.tests.front().data.noise = {{"y", {noise}}};
    line.experiment.tests.front().hold_out.rows = {0, {}, 3};
  }
  trial::Line line;
};

/// One τ, D and s: 1 and the others as the header has them.
struct Dense {
  Dense(const posterior::Question& question, double size, std::size_t roughness) {
    const auto& view = question.assembly.layout().channels.front();
    const auto [columns, degree] = assembly::curve_shapes(view.abscissa, 14);
    const auto fall = [&](double d) {
      constexpr std::array flat{1.5, 3.0, 6.0};
      if (roughness == 0) return std::pow(1 + d, -2);
      if (roughness == 1) return std::pow(1 + d, -4);
      return roughness == 2 ? std::exp(-1.5 * d) : std::exp(-d * d / 2 / std::pow(flat.at(roughness - 3), 2));
    };
    // τ is the root mean square over the curve, and that of a Legendre polynomial 1/√(2d + 1).
    double mean_square = 0;
    for (int d = 0; d <= *std::max_element(degree.begin(), degree.end()); ++d) mean_square += fall(d) / (2 * d + 1);
    VectorXd D(columns.cols());
    for (Eigen::Index k = 0; k < D.size(); ++k) D[k] = fall(degree[static_cast<std::size_t>(k)]) / mean_square;
    const MatrixXd all = size * size * range * range * columns * D.asDiagonal() * columns.transpose();
    const auto& rows = question.whitening.rows;
    const auto n = static_cast<Eigen::Index>(rows.size());
    const auto place = [&](Eigen::Index i) {
      return static_cast<Eigen::Index>(rows[static_cast<std::size_t>(i)].prediction);
    };
    covariance = MatrixXd::Identity(n, n);
    between.resize(all.rows(), n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) covariance(i, j) += all(place(i), place(j)) / (noise * noise);
      between.col(i) = all.col(place(i)) / noise;
    }
    prior = all.diagonal();
  }
  MatrixXd covariance, between;  ///< of r; of δ with −r
  VectorXd prior;

  [[nodiscard]] double log_density(const VectorXd& r) const {
    return -0.5 * std::log(covariance.determinant()) - 0.5 * r.dot(covariance.inverse() * r);
  }
};

double log_likelihood(const posterior::Question& question, const VectorXd& r) {
  double total = 0.5 * std::exp(Dense(question, 0, 0).log_density(r)), weights = 0, misfit = 0;
  for (const double size : {0.0025, 0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32})
    for (std::size_t roughness = 0; roughness < 6; ++roughness) {
      const double weight = std::exp(-0.5 * std::pow(std::log(size / 0.02) / 0.7, 2));
      misfit += weight * std::exp(Dense(question, size, roughness).log_density(r));
      weights += weight;
    }
  total += 0.5 * misfit / weights;
  return std::log(2 * total);  // the constant of the header: no misfit has weight 1
}

std::optional<posterior::Question> question_of(const assembly::Assembly& assembly) {
  Status status;
  return posterior::question_at(assembly, std::vector{1.0, 2.0}, {}, status, true);
}

VectorXd bent(Eigen::Index n, double height) {
  VectorXd r(n);
  for (Eigen::Index i = 0; i < n; ++i)
    r[i] = height * std::sin(3.0 * static_cast<double>(i) / static_cast<double>(n)) + (i % 2 == 0 ? 0.7 : -0.9);
  return r;
}

}  // namespace

TEST(Discrepancy, HasTheLikelihoodOfTheSumsWrittenOut) {
  const Case bed;
  const auto assembly = bed.line.assemble();
  const auto question = question_of(assembly);
  ASSERT_TRUE(question && question->discrepancy);
  ASSERT_TRUE(question->factor_known);
  for (const double height : {0.0, 2.0, 6.0}) {
    const VectorXd r = bent(20, height);
    VectorXd pull;
    EXPECT_NEAR(question->discrepancy->log_likelihood(r, pull), log_likelihood(*question, r), 1e-8) << height;
  }
}

TEST(Discrepancy, HasExactDerivativesByResiduals) {
  const Case bed;
  const auto assembly = bed.line.assemble();
  const auto question = question_of(assembly);
  const VectorXd r = bent(20, 3);
  VectorXd pull, other;
  question->discrepancy->log_likelihood(r, pull);
  constexpr double step = 1e-5;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const VectorXd ahead = r + step * VectorXd::Unit(r.size(), i), behind = r - step * VectorXd::Unit(r.size(), i);
    const double slope =
        (question->discrepancy->log_likelihood(ahead, other) - question->discrepancy->log_likelihood(behind, other)) /
        (2 * step);
    EXPECT_NEAR(-pull[i], slope, 1e-8 * (1 + std::abs(slope)));
  }
  // ‖G r‖² = rᵀ P r, and P r = Σ_c π_c Σ_c⁻¹ r is the pull.
  MatrixXd mapped = r;
  question->discrepancy->transform(question->discrepancy->metric(r), mapped);
  EXPECT_NEAR(mapped.squaredNorm(), r.dot(pull), 1e-9 * r.dot(pull));
}

// Given τ and D the misfit is normal: E δ = −K (…)⁻¹ r, var δ = prior − K (…)⁻¹ Kᵀ, in held-out rows as well.
TEST(Discrepancy, DrawsTheMisfitThatTheRowsLeaveOpen) {
  const Case bed;
  const auto assembly = bed.line.assemble();
  const auto question = question_of(assembly);
  const VectorXd r = bent(20, 4);
  posterior::CounterRandom random(3);
  int with_misfit = 0;
  for (int k = 0; k < 20; ++k) {
    const auto found = question->discrepancy->draw(r, random);
    ASSERT_EQ(found.mean.size(), 30u);
    EXPECT_EQ(found.factor, 1);
    with_misfit += found.size > 0 ? 1 : 0;
    double nearest = 1e9;
    for (std::size_t roughness = 0; roughness < 6; ++roughness) {
      const Dense dense(*question, found.size, roughness);
      const VectorXd mean = -dense.between * dense.covariance.inverse() * r;
      const VectorXd variance =
          dense.prior - (dense.between * dense.covariance.inverse()).cwiseProduct(dense.between).rowwise().sum();
      double off = 0;
      for (Eigen::Index i = 0; i < mean.size(); ++i) {
        const auto at = static_cast<std::size_t>(i);
        off = std::max({off, std::abs(found.mean[at] - mean[i]),
                        std::abs(found.sd[at] * found.sd[at] - std::max(0.0, variance[i]))});
      }
      nearest = std::min(nearest, off);
    }
    EXPECT_LT(nearest, 1e-8);
  }
  EXPECT_GT(with_misfit, 18) << "r bends by four times the noise";
}

// Residuals that bend by less than the noise are taken for noise, and there may be no misfit at all.
TEST(Discrepancy, NeedNotBeThere) {
  const Case bed;
  const auto assembly = bed.line.assemble();
  const auto question = question_of(assembly);
  posterior::CounterRandom random(3);
  int without = 0;
  for (int k = 0; k < 400; ++k) without += question->discrepancy->draw(bent(20, 0), random).size == 0 ? 1 : 0;
  EXPECT_GT(without, 200) << "more than before the data";
}

// Noise that nobody states is a factor beside the misfit, found from what is rough.
TEST(Discrepancy, FindsTheNoiseBesideIt) {
  posterior::CounterRandom noise_of(7);
  const trial::Line line(fakes::grid(0, 7, 200), [&](std::size_t i) {
    return 0.1 * noise_of.normal() + 0.5 * std::sin(static_cast<double>(i) / 20);
  });
  const auto assembly = line.assemble();
  const auto question = question_of(assembly);
  ASSERT_TRUE(question);
  EXPECT_FALSE(question->factor_known);
  std::vector<double> residuals(question->whitening.count()), predictions(200);
  for (std::size_t i = 0; i < 200; ++i) predictions[i] = 1 + 2 * line.x[i];
  assembly::whitened_residuals(question->whitening, std::vector{1.0, 2.0}, predictions, {}, residuals, {});
  const Eigen::Map<const VectorXd> r(residuals.data(), 200);
  posterior::CounterRandom random(3);
  for (int k = 0; k < 20; ++k) {
    const auto found = question->discrepancy->draw(r, random);
    // s σ is known to 1/√(2·170) = 5 %.
    EXPECT_NEAR(found.factor * question->whitening.rows[0].sd, 0.1, 0.025);
    EXPECT_GT(found.size, 0) << "the bend is five times the noise";
  }
}

// Of a curve of 60 rows the first eight are fitted: shapes to degree 14 and two parameters follow them, and leave none
// to estimate the noise from.
TEST(Discrepancy, SaysWhereItTakesTheNoiseForKnown) {
  const auto assumed = [](std::size_t fitted, bool stated) {
    trial::Line line(60);
    if (stated) line.experiment.tests.front().data.noise = {{"y", {noise}}};
    line.experiment.tests.front().hold_out.rows = {static_cast<std::ptrdiff_t>(fitted), {}, 1};
    const auto assembly = line.assemble();
    const auto question = question_of(assembly);
    EXPECT_EQ(question->factor_known, stated || fitted == 8);
    return question->discrepancy->factor_assumed();
  };
  EXPECT_TRUE(assumed(8, false));
  EXPECT_FALSE(assumed(8, true));
  EXPECT_FALSE(assumed(50, false));
}
