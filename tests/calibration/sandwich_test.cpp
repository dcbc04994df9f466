// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "calibration/fakes.hpp"
#include "uncertainty/identifiability.hpp"

namespace tunica {
namespace {

using experiment::ObjectiveType;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// y = a + b x + c x² with b = 1 held, in two tests: linear in a and c, so that the estimate is a matrix times the
/// data.
struct Lines {
  Lines(ObjectiveType objective, double second_weight, double relative, double absolute) {
    const auto curve = [](double x) { return 2 + x + 3 * x * x; };
    for (const auto& [name, last, count] : {std::tuple{"s", 1.0, std::size_t{15}}, {"t", 2.0, std::size_t{25}}}) {
      const auto x = fakes::grid(0, last, count);
      const auto y = fakes::map(x, curve);
      auto& test = bench.add_test(name, x, y);
      test.weights = {name[0] == 't' ? second_weight : 1.0};
      test.data.noise = {{"y", {absolute, relative, 0}}};
      for (std::size_t i = 0; i < count; ++i) {
        abscissae.push_back(x[i]);
        measured.push_back(y[i]);
        sd.push_back(std::hypot(absolute, relative * y[i]));
        const double range = y.back() - y.front(), rows = static_cast<double>(count);
        const double scale =
            objective == ObjectiveType::standardised_quadratic ? 1 / (rows * range) : 1 / (sd.back() * sd.back());
        weight.push_back(test.weights[0] * scale);
      }
    }
    bench.parameter("b").fixed = 1;
    bench.run.objective = objective;
  }
  /// (Gᵀ W G)⁻¹ Gᵀ W: from the data to a and c.
  [[nodiscard]] Matrix estimator() const {
    const auto n = static_cast<Eigen::Index>(measured.size());
    Matrix G(n, 2);
    for (Eigen::Index i = 0; i < n; ++i) G.row(i) << 1, std::pow(abscissae[static_cast<std::size_t>(i)], 2);
    const Matrix GW = G.transpose() * Eigen::Map<const Vector>(weight.data(), n).asDiagonal();
    return (GW * G).inverse() * GW;
  }
  [[nodiscard]] std::vector<uncertainty::ParameterInterval> intervals() const {
    uncertainty::Identifiability found;
    const auto assembly = bench.assemble();
    const Status status = uncertainty::identify(assembly, std::vector<double>{2, 3}, found);
    EXPECT_TRUE(status.ok()) << status.reason();
    return found.parameters;
  }
  fakes::Bench bench;
  std::vector<double> abscissae, measured, sd, weight;
};

struct Case {
  ObjectiveType objective;
  double second_weight, relative, absolute;
};

const Case cases[] = {{ObjectiveType::least_squares, 1, 0.1, 0.1},
                      {ObjectiveType::least_squares, 2, 0.1, 0.1},
                      {ObjectiveType::standardised_quadratic, 1, 0.1, 0},
                      {ObjectiveType::standardised_quadratic, 2, 0, 0.5}};

TEST(Sandwich, IntervalsAreThoseOfTheObjectiveThatWasMinimised) {
  for (const auto& [objective, second_weight, relative, absolute] : cases) {
    const Lines lines(objective, second_weight, relative, absolute);
    const Matrix K =
        lines.estimator() * Eigen::Map<const Vector>(lines.sd.data(), lines.estimator().cols()).asDiagonal();
    const auto found = lines.intervals();
    for (const Eigen::Index j : {0, 1})
      EXPECT_NEAR(found[static_cast<std::size_t>(j)].ci95 / (1.959963984540054 * K.row(j).norm()), 1, 1e-6)
          << static_cast<int>(objective) << ", weight " << second_weight << ", parameter " << j;
  }
}

// 2000 data sets an objective, each interval right with probability 0.95: from 1865 to 1935 with probability 0.9996, so
// that the eight give a false alarm for 0.3 % of the seeds. Seed 20230211.
TEST(Sandwich, IntervalsCoverForEveryObjectiveAndWeight) {
  std::mt19937_64 engine(20230211);
  std::normal_distribution<double> normal;
  for (const auto& [objective, second_weight, relative, absolute] : cases) {
    const Lines lines(objective, second_weight, relative, absolute);
    const auto found = lines.intervals();
    const Matrix estimator = lines.estimator();
    int covered[2] = {};
    for (int k = 0; k < 2000; ++k) {
      Vector errors(estimator.cols());
      for (Eigen::Index i = 0; i < errors.size(); ++i)
        errors[i] = lines.sd[static_cast<std::size_t>(i)] * normal(engine);
      const Vector off = estimator * errors;
      for (const std::size_t j : {0, 1}) covered[j] += std::abs(off[static_cast<Eigen::Index>(j)]) <= found[j].ci95;
    }
    for (const int count : covered) {
      EXPECT_GE(count, 1865) << static_cast<int>(objective) << ", weight " << second_weight;
      EXPECT_LE(count, 1935) << static_cast<int>(objective) << ", weight " << second_weight;
    }
  }
}

}  // namespace
}  // namespace tunica
