// SPDX-License-Identifier: Apache-2.0
// Mechanisms as the only explanation: their evidence by hand, in rows of noise 1 that a base of fixed parameters, or of
// free ones, predicts.
#include "discovery/rivals.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/LU>
#include <Eigen/QR>
#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"

namespace tunica::discovery::rivals_test {
namespace {

using diagnosis::at_rows;
using diagnosis::MadeUp;
using diagnosis::MadeUpCauses;
using ::testing::ElementsAre;
using ::testing::SizeIs;

constexpr Eigen::Index rows = 12;

/// 1 in three rows, from this one on.
Eigen::VectorXd three_from(Eigen::Index first) { return at_rows(rows, {{first, 1}, {first + 1, 1}, {first + 2, 1}}); }

void of_the_material(MechanismFactory& factory) { factory.origin = MechanismFactory::Origin::material; }

std::vector<std::string> ids_of(const std::vector<Rival>& rivals) {
  std::vector<std::string> ids;
  for (const Rival& rival : rivals) ids.push_back(rival.id);
  return ids;
}

/// ½ ln(1 + |s|² w²/2π): what an amplitude costs that may lie in a range of width w.
double price_of(double squares, double width) {
  return 0.5 * std::log(1 + squares * width * width / (2 * std::numbers::pi));
}

/// Each takes its own rows of what the data show, and leaves the others'.
TEST(Rivals, AreWeighedByWhatTheyLeaveAndByTheirRange) {
  MadeUpCauses bed({rows}, 5 * three_from(0) - 3 * three_from(3) + 2 * three_from(6));
  bed.add({"small", three_from(6)});
  bed.add({.id = "stiffer", .shape = three_from(3), .declare = of_the_material});
  bed.add({.id = "large", .shape = three_from(0), .declare = [](MechanismFactory& factory) {
             factory.plausible_min = -1;
             factory.plausible_max = 6;
           }});
  bed.close();
  const std::vector<Rival> rivals = rivals_of(bed.inquiry(), bed.analysis);
  EXPECT_THAT(ids_of(rivals), ElementsAre("large", "stiffer", "small"));
  const std::vector<double> left{3 * (9 + 4), 3 * (25 + 4), 3 * (25 + 9)}, width{7, 1000, 1000};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(rivals[k].chi2, left[k], 1e-6);
    EXPECT_NEAR(rivals[k].log_prior, -std::log(2), 1e-12) << "two of the rig share the weight of the terms";
    EXPECT_NEAR(rivals[k].log_evidence, -left[k] / 2 - price_of(3, width[k]) - std::log(2), 1e-6);
    EXPECT_EQ(rivals[k].in_the_energy, k == 1);
    EXPECT_FALSE(rivals[k].remembers);
    EXPECT_THAT(rivals[k].place.tests, ElementsAre("a"));
  }
}

/// One that leaves less may be the less likely, if it could have been anything.
TEST(Rivals, StandInTheOrderOfTheirEvidence) {
  MadeUpCauses bed({rows}, 5 * three_from(0) + 4.9 * three_from(3));
  bed.add({"anything", three_from(0)});
  bed.add({.id = "narrow", .shape = three_from(3), .declare = [](MechanismFactory& factory) {
             factory.plausible_min = 0;
             factory.plausible_max = 5;
           }});
  bed.close();
  const std::vector<Rival> rivals = rivals_of(bed.inquiry(), bed.analysis);
  EXPECT_THAT(ids_of(rivals), ElementsAre("narrow", "anything"));
  EXPECT_GT(rivals[0].chi2, rivals[1].chi2);
}

TEST(Rivals, OfTheMaterialShareNothing) {
  MadeUpCauses bed({rows}, 5 * three_from(0));
  bed.add({.id = "stiffer", .shape = three_from(0), .declare = of_the_material});
  bed.close();
  const std::vector<Rival> rivals = rivals_of(bed.inquiry(), bed.analysis);
  ASSERT_THAT(rivals, SizeIs(1));
  EXPECT_EQ(rivals[0].log_prior, 0);
  EXPECT_NEAR(rivals[0].log_evidence, -price_of(3, 1000), 1e-6);
}

/// Memory is no energy, though the material has it.
TEST(Rivals, ThatRememberAreNoEnergy) {
  MadeUpCauses bed({rows}, 5 * three_from(0));
  bed.add({.id = "fading", .shape = three_from(0), .declare = [](MechanismFactory& factory) {
             of_the_material(factory);
             factory.memory = true;
           }});
  bed.add({.id = "lagging", .shape = three_from(0) + 0.1 * three_from(3), .declare = [](MechanismFactory& factory) {
             factory.memory = true;
           }});
  bed.close();
  const std::vector<Rival> rivals = rivals_of(bed.inquiry(), bed.analysis);
  ASSERT_THAT(rivals, SizeIs(2));
  for (const Rival& rival : rivals) {
    EXPECT_TRUE(rival.remembers);
    EXPECT_FALSE(rival.in_the_energy);
    EXPECT_EQ(rival.log_prior, 0) << "one of the rig";
  }
}

/// Those too far behind are not fitted, but have their share of the weight of the rig.
TEST(Rivals, AreThoseThatWereFitted) {
  Eigen::VectorXd beyond = Eigen::VectorXd::Zero(rows);
  for (Eigen::Index k = 0; k < 6; ++k) beyond[k] = k < 4 ? 10 + 0.1 * static_cast<double>(k) : 0.1;
  MadeUpCauses bed({rows}, beyond);
  for (Eigen::Index k = 0; k < 6; ++k) bed.add({"m" + std::to_string(k), at_rows(rows, {{k, 1}})});
  bed.close();
  bed.request.quick = true;
  const std::vector<Rival> rivals = rivals_of(bed.inquiry(), bed.analysis);
  EXPECT_THAT(ids_of(rivals), ElementsAre("m3", "m2", "m1", "m0"));
  for (const Rival& rival : rivals) EXPECT_NEAR(rival.log_prior, -std::log(6), 1e-12);
}

/// Of a linear parameter, of one in its logarithm, of one at its bound and of a nuisance parameter.
TEST(Rivals, PayForAllThatIsFitted) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(rows, 0, rows - 1), ones = Eigen::VectorXd::Ones(rows);
  const Eigen::VectorXd beside = at_rows(rows, {{2, 1}, {7, -1}, {9, 2}});
  const Eigen::VectorXd beyond = 4 * three_from(4) + 2 * beside - 0.02 * x.cwiseProduct(x) + 0.4 * x;
  MadeUpCauses bed({rows}, beyond);
  bed.free("a", 0, 8);
  bed.free("b", 0.1, 10);
  bed.free("c", 0, 5);
  bed.add({.id = "m", .shape = three_from(4), .nuisance = {{"n", beside}}});
  bed.close();
  const std::vector<Rival> rivals = rivals_of(bed.inquiry(), bed.analysis);
  ASSERT_THAT(rivals, SizeIs(1));
  Eigen::MatrixXd J(rows, 4);
  J << ones, x, three_from(4), beside;
  const Eigen::VectorXd data = ones + 0.1 * x + beyond, found = J.colPivHouseholderQr().solve(data);
  const double left = (data - J * found).squaredNorm();
  ASSERT_GT(found[0], 0);
  ASSERT_GT(found[1], 0.1);
  EXPECT_NEAR(rivals[0].chi2, left, 1e-5);
  const Eigen::Vector4d width{8, found[1] * std::log(10 / 0.1), 1000, 2000};
  const Eigen::MatrixXd scaled = J * width.asDiagonal() / std::sqrt(2 * std::numbers::pi);
  const Eigen::MatrixXd H = scaled.transpose() * scaled + Eigen::MatrixXd::Identity(4, 4);
  EXPECT_NEAR(rivals[0].log_evidence, -left / 2 - 0.5 * std::log(H.determinant()), 1e-3);
}

TEST(Rivals, ArePlausibleWithinTheirRange) {
  const auto plausible = [](double amplitude, double least, double most) {
    MadeUpCauses bed({rows}, amplitude * three_from(0));
    bed.add({.id = "m", .shape = three_from(0), .declare = [=](MechanismFactory& factory) {
               factory.plausible_min = least;
               factory.plausible_max = most;
             }});
    bed.close();
    return rivals_of(bed.inquiry(), bed.analysis).at(0).plausible;
  };
  EXPECT_TRUE(plausible(5, -1, 5.1));
  EXPECT_FALSE(plausible(5, -1, 4.9));
  EXPECT_TRUE(plausible(-5, -5.1, 1));
  EXPECT_FALSE(plausible(-5, -4.9, 1));
}

/// What another mechanism would explain is no noise.
TEST(Rivals, AreCleanWhereTheyLeaveNoise) {
  MadeUpCauses bed({rows}, 8 * three_from(0) + 7 * three_from(3));
  bed.add({"one", three_from(0)});
  bed.add({"other", three_from(3)});
  bed.add({"both", 8 * three_from(0) + 7 * three_from(3)});
  bed.close();
  bed.calibrate_by_noise();
  bed.analysis.alarm.shapes.columns.resize(rows, 0);
  std::mt19937 generator(7);
  std::normal_distribution<float> normal;
  bed.analysis.alarm.draws.residuals = Eigen::MatrixXf::NullaryExpr(rows, 500, [&] { return normal(generator); });
  const std::vector<Rival> rivals = rivals_of(bed.inquiry(), bed.analysis);
  ASSERT_THAT(ids_of(rivals), ElementsAre("both", "one", "other"));
  EXPECT_TRUE(rivals[0].clean);
  EXPECT_FALSE(rivals[1].clean);
  EXPECT_FALSE(rivals[2].clean);
}

}  // namespace
}  // namespace tunica::discovery::rivals_test
