// SPDX-License-Identifier: Apache-2.0
// What sets of terms weigh before the data, how sure their parameters are, and what states say of every invariant.
#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <gmock/gmock.h>

#include "discover/rubber.hpp"
#include "discovery/curves.hpp"
#include "discovery/reach.hpp"
#include "discovery/set_fit.hpp"

namespace tunica::discovery::weighing_test {
namespace {

using ::testing::ElementsAre;

KindPointer kind(double log_prior, std::vector<Shape> shapes = {}) {
  Kind one{"I1", "", "power", {}};
  one.log_prior = log_prior;
  one.shapes = std::move(shapes);
  return std::make_shared<const Kind>(one);
}

/// Each term by its share among the kinds; k terms can be listed in k! orders; a further one is in every tenth data set
/// beside a base, in every other from nothing.
TEST(PriorOfSets, CountsKindsOrdersAndFurtherTerms) {
  const double a = std::log(0.2), b = std::log(0.1), c = std::log(0.05);
  EXPECT_EQ(log_prior({}, false), 0);
  EXPECT_NEAR(log_prior({kind(a)}, false), a, 1e-14);
  EXPECT_NEAR(log_prior({kind(a), kind(b)}, false), a + b + std::log(2 * 0.1), 1e-14);
  EXPECT_NEAR(log_prior({kind(a), kind(b), kind(c)}, false), a + b + c + std::log(6 * 0.01), 1e-14);
  EXPECT_NEAR(log_prior({kind(a), kind(b), kind(c)}, true), a + b + c + std::log(6 * 0.25), 1e-14);
}

TEST(StartsOfShapes, AreAllCombinations) {
  EXPECT_THAT(combinations(*kind(0)), ElementsAre(std::vector<double>()));
  const Shape m{"m", 2, 12, Scale::linear, {2.5, 5}}, theta{"theta", 15, 75, Scale::linear, {30, 45, 60}};
  using Row = std::vector<double>;
  EXPECT_THAT(combinations(*kind(0, {m, theta})),
              ElementsAre(Row{2.5, 30}, Row{2.5, 45}, Row{2.5, 60}, Row{5, 30}, Row{5, 45}, Row{5, 60}));
}

/// (JᵀJ)⁻¹ of the parameters that are free, whatever their units; nothing is known of the spread of one at its bound.
TEST(CovarianceOfASet, IsThatOfTheFreeParameters) {
  diagnosis::Fit fit;
  fit.jacobian.resize(4, 3);
  fit.jacobian << 1, 2, 1e-6, 0, 1, 3e-6, 2, 0, 1e-6, 1, 1, -2e-6;
  fit.at_bound = {false, false, false};
  const Eigen::MatrixXd expected = (fit.jacobian.transpose() * fit.jacobian).inverse();
  const Eigen::MatrixXd found = covariance(fit);
  for (Eigen::Index a = 0; a < 3; ++a)
    for (Eigen::Index b = 0; b < 3; ++b)
      EXPECT_NEAR(found(a, b), expected(a, b), 1e-12 * std::sqrt(expected(a, a) * expected(b, b))) << a << b;
  fit.at_bound = {false, true, false};
  Eigen::MatrixXd J(4, 2);
  J << fit.jacobian.col(0), fit.jacobian.col(2);
  const Eigen::MatrixXd of_two = (J.transpose() * J).inverse(), held = covariance(fit);
  EXPECT_EQ(held.row(1).norm() + held.col(1).norm(), 0);
  EXPECT_NEAR(held(0, 0), of_two(0, 0), 1e-12 * of_two(0, 0));
  EXPECT_NEAR(held(2, 2), of_two(1, 1), 1e-12 * of_two(1, 1));
  EXPECT_NEAR(held(0, 2), of_two(0, 1), 1e-12 * std::sqrt(of_two(0, 0) * of_two(1, 1)));
}

/// Rubber with a term in I2 that a neo-Hookean base lacks, and a fitter for it.
class Fitting : public ::testing::Test {
 protected:
  Fitting() {
    rubber.measure(
        11, trial::hidden_term({{"invariant", "I2"}, {"law", "linear"}, {"parameters", {{"mu", {{"initial", 40}}}}}}));
    const experiment::Experiment read = rubber.read();
    const diagnosis::Request request = diagnosis::request_of(read);
    const diagnosis::Progress silent;
    evidence = diagnosis::evidence_of({read, request, testing::catalogue(), silent}, {});
    subject.emplace(Subject{evidence.experiment, evidence.run, "rubber", false, testing::catalogue()});
    fitter.emplace(*subject, evidence);
    Request wanted;
    wanted.invariants = {"I2"};
    wanted.laws = {"linear"};
    Kind one = kinds_of(wanted, reached_states(*subject, evidence.fit.free), false).front();
    one.largest = fitter->largest_amplitude(one);
    second = std::make_shared<const Kind>(one);
  }

  /// W of a parameter of the base: a Gaussian as high as the uniform prior of its box.
  [[nodiscard]] static double of_box(const assembly::FreeParameter& parameter, double value) {
    const double wide =
        parameter.scale == Scale::log ? value * std::log(parameter.max / parameter.min) : parameter.max - parameter.min;
    return wide / std::sqrt(2 * std::numbers::pi);
  }
  /// √Σ(y/σ)², σ = 3 kPa.
  [[nodiscard]] double measured() const {
    double sum = 0;
    for (const assembly::MeasuredChannel& view : evidence.base->layout().channels)
      for (const double y : view.measured) sum += y * y / 9;
    return std::sqrt(sum);
  }

  const trial::Rubber rubber;
  diagnosis::Evidence evidence;
  std::optional<Subject> subject;
  std::optional<Fitter> fitter;
  KindPointer second;
};

/// ln E = −|r|²/2 − ½ ln det(I + W JᵀJ W) + ln prior; an amplitude is uniform in its logarithm from an effect of σ to
/// all that is measured.
TEST_F(Fitting, WeighsAFitByLaplace) {
  const SetFit& root = fitter->root();
  ASSERT_EQ(root.fit.jacobian.cols(), 1);
  const double w = of_box(root.set->assembly().layout().parameters[0], root.fit.free[0]);
  const double of_root = 1 + w * w * root.fit.jacobian.squaredNorm();
  EXPECT_NEAR(root.log_evidence, -root.chi2() / 2 - 0.5 * std::log(of_root), 1e-9 * root.chi2());

  const auto grown = fitter->grown(root, second, -INFINITY);
  ASSERT_TRUE(grown);
  EXPECT_LT(grown->chi2(), 0.8 * root.chi2());
  const std::size_t amplitude = grown->set->terms().front().amplitude;
  Eigen::MatrixXd J = grown->fit.jacobian;
  ASSERT_EQ(J.cols(), 2);
  for (std::size_t j = 0; j < 2; ++j) {
    const double value = grown->fit.free[j];
    J.col(static_cast<Eigen::Index>(j)) *= j == amplitude
                                               ? value * std::log(measured()) / std::sqrt(2 * std::numbers::pi)
                                               : of_box(grown->set->assembly().layout().parameters[j], value);
  }
  const double det = (Eigen::Matrix2d::Identity() + J.transpose() * J).determinant();
  EXPECT_NEAR(grown->log_evidence, -grown->chi2() / 2 - 0.5 * std::log(det) + second->log_prior,
              1e-6 * std::abs(grown->log_evidence));
  // Truth: 40 kPa beside 300 kPa.
  EXPECT_NEAR(grown->fit.free[amplitude], 40, 5 * std::sqrt(covariance(grown->fit)(1, 1)));
}

/// Stresses are linear in the modulus of a linear law: twenty times all that is measured, over the length of its
/// column.
TEST_F(Fitting, LooksForAmplitudesOfSeveralTimesAllThatIsMeasured) {
  const auto grown = fitter->grown(fitter->root(), second, -INFINITY);
  ASSERT_TRUE(grown);
  const auto column = static_cast<Eigen::Index>(grown->set->terms().front().amplitude);
  const double expected = 20 * measured() / grown->fit.jacobian.col(column).norm();
  EXPECT_NEAR(second->largest, expected, 1e-6 * expected);
  const auto& parameter = grown->set->assembly().layout().parameters[static_cast<std::size_t>(column)];
  EXPECT_EQ(parameter.max, second->largest);
  EXPECT_EQ(parameter.min, 0);
}

/// What cannot become worth it is not tried, nor what has nothing to do.
TEST_F(Fitting, GrowsOnlyByWhatHelps) {
  const auto grown = fitter->grown(fitter->root(), second, -INFINITY);
  ASSERT_TRUE(grown);
  EXPECT_FALSE(fitter->grown(fitter->root(), second, fitter->root().log_evidence + 2 * fitter->root().chi2()))
      << "nothing takes more than all of |r|²";
  EXPECT_FALSE(fitter->grown(*grown, second, -INFINITY)) << "it is there already";
}

/// C = FᵀF of shear by γ in the plane of axes `a`, `b`, in the order tt, zz, rr, tz, zr, tr.
std::array<double, 6> sheared(int a, int b, double gamma) {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(a, b) = gamma;
  const Eigen::Matrix3d C = F.transpose() * F;
  return {C(0, 0), C(1, 1), C(2, 2), C(0, 1), C(1, 2), C(0, 2)};
}

/// Simple shear: I1 = I2 = 3 + γ², whatever the plane; principal stretches are √(1 + γ²/4) ± γ/2 and 1.
TEST(DiscoveryReach, OfShearIsTheSameInEveryPlane) {
  constexpr double gamma = 0.8;
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2)}) {
    const States states{{1, 1, 1, 0, 0, 0}, sheared(a, b, gamma)};
    EXPECT_NEAR(reach_of_first(states).high, gamma * gamma, 1e-14);
    EXPECT_NEAR(reach_of_second(states).high, gamma * gamma, 1e-14);
    const double largest = std::log(std::sqrt(1 + gamma * gamma / 4) + gamma / 2);
    EXPECT_NEAR(reach_of_stretches(states).high, largest, 1e-14);
    EXPECT_NEAR(reach_of_stretches(states).low, -largest, 1e-14);
  }
}

/// M·CM − 1 of a fibre at an angle from the axis (1) towards the circumference (0): with F e_z = e_z + γ e_θ a fibre
/// along (sin, cos) becomes (sin + γ cos, cos).
TEST(DiscoveryReach, OfAFibreIsItsOwnStretch) {
  constexpr double gamma = 0.8;
  const States states{sheared(0, 1, gamma)};
  for (const double angle : {0., 30., 60., 90.}) {
    const double s = std::sin(angle * std::numbers::pi / 180), c = std::cos(angle * std::numbers::pi / 180);
    EXPECT_NEAR(reach_of_fibre(states, angle).high, std::pow(s + gamma * c, 2) + c * c - 1, 1e-14) << angle;
    EXPECT_NEAR(reach_of_fibre(states, angle).low, 0, 1e-14) << "at rest at least";
  }
  EXPECT_NEAR(reach_of_fibre(states, -60).low, std::pow(-std::sqrt(3.) / 2 + gamma / 2, 2) + 0.25 - 1, 1e-14);
}

}  // namespace
}  // namespace tunica::discovery::weighing_test
