// SPDX-License-Identifier: Apache-2.0
// Intervals of amplitudes from refits of simulated data, where everything is linear: what each draw of noise does to an
// amplitude is a projection.
#include "diagnosis/naming/intervals.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/detection/noise_draws.hpp"
#include "diagnosis/made_up_causes.hpp"
#include "diagnosis/naming/causes.hpp"
#include "tunica/random.hpp"

namespace tunica::diagnosis::intervals_test {
namespace {

constexpr Eigen::Index rows = 12;

/// Rows in turn up and down, and the first half against the second: across each other and across a constant.
Eigen::VectorXd turning() {
  Eigen::VectorXd shape(rows);
  for (Eigen::Index i = 0; i < rows; ++i) shape[i] = i % 2 == 0 ? 1 : -1;
  return shape;
}
Eigen::VectorXd halves() {
  Eigen::VectorXd shape(rows);
  for (Eigen::Index i = 0; i < rows; ++i) shape[i] = i < rows / 2 ? 2 : -2;
  return shape;
}

/// Two mechanisms that made the data, both of the best explanation; the first `named` are named.
struct Explained : MadeUpCauses {
  explicit Explained(std::size_t named) : MadeUpCauses({static_cast<int>(rows)}, 3 * turning() + 4 * halves()) {
    add({"turning", turning()});
    add({"halves", halves()});
    free("a", -100, 100);
    close();
    request.quick = false;
    request.seed = 5;
    const Group group = group_of({direction("turning"), direction("halves")});
    Claim& claim = explanation.claim;
    claim.best = group.refit;
    claim.named = named;
    for (const char* id : {"turning", "halves"}) {
      Cause& cause = claim.causes.emplace_back();
      cause.id = id;
      cause.amplitude.value = id[0] == 't' ? 3 : 4;
      cause.amplitude.unit = "kPa";
      cause.amplitude.low = -7;
      cause.amplitude.high = 70;
      cause.explanation = "as before";
    }
  }
  [[nodiscard]] std::vector<Cause> causes() const {
    return with_refitted_intervals(inquiry(), analysis, explanation).claim.causes;
  }
  /// Ends of 95 % of the amplitudes that these draws give, the true one being `value`: the 6th and the 194th of 199.
  [[nodiscard]] std::pair<double, double> ends(double value, const Eigen::VectorXd& shape) const {
    const Eigen::MatrixXf noise =
        noise_draws(analysis.evidence, 199, derive_seed(request.seed, "refits of the extension")).residuals;
    std::vector<double> values;
    for (Eigen::Index b = 0; b < noise.cols(); ++b)
      values.push_back(value - shape.dot(noise.col(b).cast<double>()) / shape.squaredNorm());
    std::sort(values.begin(), values.end());
    return {values[5], values[193]};
  }

  Explanation explanation;
};

void expect_ends(const Cause& cause, const std::pair<double, double>& ends) {
  EXPECT_NEAR(cause.amplitude.low, ends.first, 1e-4) << cause.id;
  EXPECT_NEAR(cause.amplitude.high, ends.second, 1e-4) << cause.id;
}

TEST(RefittedIntervals, AreQuantilesOfWhatDrawsOfNoiseMakeOfAnAmplitude) {
  const Explained both(2);
  const std::vector<Cause> found = both.causes();
  expect_ends(found[0], both.ends(3, turning()));
  expect_ends(found[1], both.ends(4, halves()));
  for (const Cause& cause : found)
    EXPECT_EQ(cause.explanation, explanation_of(cause, both.inquiry().mechanism(cause.id)));
  // σ = 1 in every row: twice 1.96/√12 apart, as far as 199 draws tell.
  EXPECT_NEAR(found[0].amplitude.high - found[0].amplitude.low, 2 * 1.96 / std::sqrt(12.), 0.25);
}

TEST(RefittedIntervals, AreOfTheCausesThatAreNamed) {
  const Explained one(1);
  const std::vector<Cause> found = one.causes();
  expect_ends(found[0], one.ends(3, turning()));
  expect_ends(found[1], {-7, 70});
  EXPECT_EQ(found[1].explanation, "as before") << "a rival keeps its own";
}

TEST(RefittedIntervals, AreNotMadeWhereItIsQuickOrNothingIsNamed) {
  Explained quick(2);
  quick.request.quick = true;
  expect_ends(quick.causes()[0], {-7, 70});
  Explained nothing(2);
  nothing.explanation.claim.best.reset();
  expect_ends(nothing.causes()[0], {-7, 70});
}

/// Fits that fail make no interval.
TEST(RefittedIntervals, StayAsTheyWereWhereNoRefitCanBeMade) {
  const Explained one(1);
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("it tears"); });
  const std::vector<Cause> found = one.causes();
  fakes::set_behaviour({});
  expect_ends(found[0], {-7, 70});
}

}  // namespace
}  // namespace tunica::diagnosis::intervals_test
