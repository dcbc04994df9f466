// SPDX-License-Identifier: Apache-2.0
// The test that tells rivals apart. What the data say of each is a Jacobian made by hand; the distances are worked out
// here again, by the normal equations in the parameters themselves and central differences.
#include "diagnosis/prospects/separation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include <Eigen/LU>
#include <gmock/gmock.h>

#include "diagnosis/measured.hpp"
#include "diagnosis/prospects/designs.hpp"

namespace tunica::diagnosis::separation_test {
namespace {

using Values = std::map<std::string, double>;

/// Fits of one wall (mu, k1, k2) to a strip, as rivals.
struct Rivals {
  Rivals() : measured(std::vector<trial::Strip>{{}}) {
    measured.measure(41);
    read = measured.read();
    request = request_of(read);
    request.quick = true;
    evidence = evidence_of(inquiry(), {});
  }
  [[nodiscard]] Inquiry inquiry() const { return {read, request, testing::catalogue(), progress}; }
  [[nodiscard]] std::size_t place(const std::string& name) const {
    const auto& parameters = evidence.base->layout().parameters;
    for (std::size_t j = 0; j < parameters.size(); ++j)
      if (parameters[j].name.ends_with(name)) return j;
    throw std::out_of_range(name);
  }
  /// Parameters that differ from those of the base, and what the data leave of them: standard deviations, 0 where they
  /// are not moved, as at a bound or without any influence.
  void add(const Values& values, const Values& sd, bool at_bound = false) {
    Fit fit = evidence.fit;
    const auto n = static_cast<Eigen::Index>(fit.free.size());
    fit.jacobian.setZero(30, n);
    fit.at_bound.assign(fit.free.size(), false);
    for (const auto& [name, value] : values) fit.free[place(name)] = value;
    for (const auto& [name, value] : sd) {
      const auto k = static_cast<Eigen::Index>(place(name));
      fit.jacobian(2 * k, k) = value > 0 ? 0.6 / value : 0;
      fit.jacobian(2 * k + 1, k) = value > 0 ? 0.8 / value : 0;
      fit.at_bound[place(name)] = value == 0 && at_bound;
    }
    // The data see what lies at a bound as they see mu.
    for (Eigen::Index k = 0; k < n; ++k)
      if (fit.at_bound[static_cast<std::size_t>(k)])
        fit.jacobian.col(k) = fit.jacobian.col(static_cast<Eigen::Index>(place("mu")));
    fits.push_back(std::move(fit));
  }
  [[nodiscard]] std::optional<Separation> separation() const {
    std::vector<FittedRival> rivals;
    for (const Fit& fit : fits) rivals.push_back({*evidence.base, all_variables(*evidence.base), fit});
    return separating_design(inquiry(), evidence, rivals);
  }

  /// min over the parameters of b of |(f_a − f_b − D x)/σ|² + |J x|².
  [[nodiscard]] double distance(const Design& design, const Fit& a, const Fit& b) const {
    std::vector<double> of_a, of_b;
    EXPECT_TRUE(predict(design, *evidence.base, a.free, of_a) && predict(design, *evidence.base, b.free, of_b));
    const Eigen::Map<const Eigen::VectorXd> sd(design.sd.data(), static_cast<Eigen::Index>(design.sd.size()));
    const auto in_noise = [&](const std::vector<double>& values) -> Eigen::VectorXd {
      return Eigen::Map<const Eigen::VectorXd>(values.data(), sd.size()).cwiseQuotient(sd);
    };
    const Eigen::VectorXd apart = in_noise(of_a) - in_noise(of_b);
    std::vector<Eigen::VectorXd> D, J;
    for (std::size_t j = 0; j < b.free.size(); ++j) {
      const Eigen::VectorXd column = b.jacobian.col(static_cast<Eigen::Index>(j));
      if (b.at_bound[j] || column.norm() == 0) continue;
      std::vector<double> up = b.free, down = up, ahead, behind;
      const double h = 1e-4 * b.free[j];
      up[j] += h;
      down[j] -= h;
      EXPECT_TRUE(predict(design, *evidence.base, up, ahead) && predict(design, *evidence.base, down, behind));
      // In units of what the data leave.
      D.push_back((in_noise(ahead) - in_noise(behind)) / (2 * h * column.norm()));
      J.push_back(column.normalized());
    }
    const auto n = static_cast<Eigen::Index>(D.size());
    if (n == 0) return apart.squaredNorm();
    Eigen::MatrixXd A(sd.size(), n), B(30, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      A.col(k) = D[static_cast<std::size_t>(k)];
      B.col(k) = J[static_cast<std::size_t>(k)];
    }
    const Eigen::VectorXd x = (A.transpose() * A + B.transpose() * B).inverse() * A.transpose() * apart;
    return (apart - A * x).squaredNorm() + (B * x).squaredNorm();
  }
  /// The design whose smallest distance is largest, and that.
  [[nodiscard]] std::pair<std::string, double> best() const {
    std::pair<std::string, double> found{"", 0};
    for (const Design& design : designs(inquiry(), evidence, *evidence.base, fits.front().free)) {
      double least = std::numeric_limits<double>::infinity();
      for (const Fit& a : fits)
        for (const Fit& b : fits)
          if (&a != &b) least = std::min(least, distance(design, a, b));
      if (least > found.second * (1 + 1e-6)) found = {design.description, least};
    }
    return found;
  }
  void expect_the_best() const {
    const auto [design, squared] = best();
    const auto found = separation();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->design, design);
    EXPECT_NEAR(found->sigmas, std::sqrt(squared), 0.005 * std::sqrt(squared));
    // Twice 1.645 standard deviations have to lie between two.
    EXPECT_EQ(found->repeats, static_cast<std::size_t>(std::ceil(std::pow(3.29, 2) / squared)));
  }

  trial::Measured measured;
  experiment::Experiment read;
  Request request;
  Progress progress;
  Evidence evidence;
  std::vector<Fit> fits;
};

const Values known{{"mu", 1e-6}, {"k1", 1e-6}, {"k2", 1e-6}};

TEST(Separation, IsTheDistanceInNoiseWhereTheDataKnowTheParameters) {
  Rivals rivals;
  rivals.add({{"mu", 18}, {"k1", 25}, {"k2", 0.3}}, known);
  rivals.add({{"mu", 18}, {"k1", 25}, {"k2", 0.33}}, known);
  rivals.expect_the_best();
}

TEST(Separation, IsWhatTheParametersOfTheOtherRivalDoNotFollow) {
  Rivals rivals;
  rivals.add({{"mu", 18}, {"k1", 25}, {"k2", 0.3}}, {{"mu", 0.3}, {"k1", 0.5}, {"k2", 0.02}});
  rivals.add({{"mu", 15}, {"k1", 30}, {"k2", 0.4}}, {{"mu", 0.4}, {"k1", 1}, {"k2", 0.01}});
  rivals.expect_the_best();
}

TEST(Separation, TakesSeveralRepeatsOfANearOne) {
  Rivals rivals;
  rivals.add({{"mu", 18}, {"k1", 25}, {"k2", 0.3}}, known);
  rivals.add({{"mu", 18.1}, {"k1", 25}, {"k2", 0.3}}, known);
  const double squared = rivals.best().second;
  // By linear shares of that difference: in one repeat, in five, in twenty, and in one too many.
  for (const double repeats : {0.8, 4.5, 19.8, 20.3}) {
    rivals.fits.pop_back();
    rivals.add({{"mu", 18 + 0.1 * std::sqrt(std::pow(3.29, 2) / repeats / squared)}, {"k1", 25}, {"k2", 0.3}}, known);
    if (repeats < 20)
      rivals.expect_the_best();
    else
      EXPECT_FALSE(rivals.separation());
  }
}

TEST(Separation, IsOfTheTwoThatAreMostAlike) {
  Rivals rivals;
  rivals.add({{"mu", 18}, {"k1", 25}, {"k2", 0.3}}, known);
  rivals.add({{"mu", 25}, {"k1", 25}, {"k2", 0.3}}, known);
  rivals.add({{"mu", 18}, {"k1", 20}, {"k2", 0.31}}, {{"mu", 1e-6}, {"k1", 2}, {"k2", 0.1}});
  rivals.expect_the_best();
  std::swap(rivals.fits[0], rivals.fits[2]);
  rivals.expect_the_best();
}

TEST(Separation, DoesNotMoveWhatLiesAtABoundOrHasNoInfluence) {
  for (const bool at_bound : {true, false}) {
    Rivals rivals;
    rivals.add({{"mu", 18}, {"k1", 25}, {"k2", 0.3}}, {{"mu", 0.3}, {"k1", 0.5}, {"k2", 0}}, at_bound);
    rivals.add({{"mu", 18}, {"k1", 25}, {"k2", 0.36}}, {{"mu", 0.3}, {"k1", 0}, {"k2", 0}}, at_bound);
    rivals.expect_the_best();
  }
}

TEST(Separation, IsNoneOfRivalsThatAreTheSame) {
  Rivals rivals;
  rivals.add({}, known);
  rivals.add({}, known);
  EXPECT_FALSE(rivals.separation());
}

TEST(Separation, IsNoneOfOneThatCannotBeSimulatedNorOfOneAlone) {
  for (const std::size_t which : {0, 1}) {
    Rivals rivals;
    rivals.add({{"mu", 18}}, known);
    rivals.add({{"mu", 25}}, known);
    ASSERT_TRUE(rivals.separation());
    rivals.fits[which].free[rivals.place("mu")] = std::numeric_limits<double>::quiet_NaN();
    // The reach and the noise of the designs are those of the first.
    EXPECT_TRUE(which == 0 || !rivals.separation());
    rivals.fits.erase(rivals.fits.begin() + static_cast<std::ptrdiff_t>(which));
    EXPECT_FALSE(rivals.separation());
  }
}

TEST(Separation, ReportsHowFarItIs) {
  Rivals rivals;
  rivals.add({{"mu", 18}}, known);
  rivals.add({{"mu", 25}}, known);
  const auto count = designs(rivals.inquiry(), rivals.evidence, *rivals.evidence.base, rivals.fits[0].free).size();
  std::mutex mutex;
  std::vector<double> shares;
  rivals.progress = [&](const std::string& stage, double share) {
    const std::scoped_lock lock(mutex);
    EXPECT_EQ(stage, "the next experiment");
    shares.push_back(share);
  };
  ASSERT_TRUE(rivals.separation());
  std::sort(shares.begin(), shares.end());
  ASSERT_EQ(shares.size(), count + 1);
  EXPECT_EQ(shares.front(), 0.9);
  for (std::size_t k = 0; k <= count; ++k)
    EXPECT_NEAR(shares[k], 0.9 + 0.1 * static_cast<double>(k) / static_cast<double>(count + 1), 1e-12);
}

}  // namespace
}  // namespace tunica::diagnosis::separation_test
