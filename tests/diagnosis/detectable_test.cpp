// SPDX-License-Identifier: Apache-2.0
// The least amplitude that would be found, of signatures that are written down here.
#include "diagnosis/prospects/detectable.hpp"

#include <cmath>

#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"

namespace tunica::diagnosis::detectable_test {
namespace {

using ::testing::SizeIs;
using Side = MechanismFactory::Side;

/// Where the draws are so small that any score raises the alarm, 80 % power takes this score by itself.
constexpr double power = 0.8416;

const Detectable& of(const std::vector<Detectable>& all, const std::string& id) {
  for (const Detectable& one : all)
    if (one.id == id) return one;
  throw std::runtime_error("nothing of " + id);
}

std::vector<Detectable> detectable_in(const MadeUpCauses& causes) {
  return detectable(causes.inquiry(), causes.analysis);
}

TEST(Detectable, IsAScoreThatRaisesTheAlarmWithEightyPercentPower) {
  MadeUpCauses causes({4}, Eigen::Vector4d(1, 1, 1, 1));
  causes.add({"p", Eigen::Vector4d(2, 0, 0, 0)});
  causes.add({"q", Eigen::Vector4d(0, 0, 3, 4)});
  causes.close();
  EXPECT_NEAR(of(detectable_in(causes), "p").detectable, power / 2, 1e-9);
  EXPECT_NEAR(of(detectable_in(causes), "q").detectable, power / 5, 1e-9);
  // With draws that say something the score of an alarm is larger, and depends on the level.
  Draws draws;
  draws.residuals.resize(4, 100);
  for (Eigen::Index b = 0; b < 100; ++b) draws.residuals.col(b).setConstant(0.04F * static_cast<float>(b));
  const Hypotheses& hypotheses = causes.analysis.hypotheses;
  causes.analysis.alarm.detector = std::make_shared<const Detector>(hypotheses.projection, hypotheses.directions, 2,
                                                                    Shapes{Eigen::MatrixXd(4, 0), {}}, draws);
  for (const double alpha : {0.05, 0.2}) {
    causes.request.alpha = alpha;
    const double T = causes.analysis.alarm.detector->threshold(1, alpha);
    ASSERT_GT(T, 0.1);
    EXPECT_NEAR(of(detectable_in(causes), "q").detectable, (std::sqrt(T) + power) / 5, 1e-9);
  }
}

// Beside one whose signature has a correlation c with it, a score of 5.41/(1 − c).
TEST(Detectable, IsNamedWhereItIsToldFromWhatIsMostAlike) {
  MadeUpCauses causes({4}, Eigen::Vector4d(1, 1, 1, 1));
  causes.add({"p", Eigen::Vector4d(2, 0, 0, 0)});
  causes.add({"far", Eigen::Vector4d(0.1, 1, 0, 0)});
  causes.add({"near", Eigen::Vector4d(-0.8, 0, 0.6, 0)});
  causes.add({"alone", Eigen::Vector4d(0, 0, 0, 1)});
  causes.add({"twin", Eigen::Vector4d(0, 0, 0.001, -2)});
  causes.close();
  const auto all = detectable_in(causes);
  ASSERT_THAT(all, SizeIs(5));
  const Detectable& p = of(all, "p");
  EXPECT_EQ(p.closest, "near") << "whatever the sign";
  EXPECT_NEAR(p.correlation, 0.8, 1e-12);
  EXPECT_NEAR(p.identifiable, std::sqrt(5.41 / 0.2) / 2, 1e-9);
  EXPECT_NEAR(p.detectable, power / 2, 1e-9);
  EXPECT_EQ(of(all, "alone").closest, "twin");
  EXPECT_TRUE(std::isinf(of(all, "alone").identifiable)) << "more than 0.999 alike";
  EXPECT_FALSE(std::isinf(of(all, "alone").detectable));
}

TEST(Detectable, OfAnEvenEffectIsTheRootOfTheSquare) {
  MadeUpCauses causes({2}, Eigen::Vector2d(1, 1));
  causes.add({"even", Eigen::Vector2d(4, 0), {{"a"}}, Side::even});
  causes.close();
  EXPECT_NEAR(of(detectable_in(causes), "even").detectable, std::sqrt(power / 4), 1e-9);
}

TEST(Detectable, SaysWhatTheAmplitudeIs) {
  MadeUpCauses causes({2, 2}, Eigen::Vector4d(1, 1, 1, 1));
  const auto declare = [](MechanismFactory& factory) {
    factory.plausible_min = -3;
    factory.plausible_max = 9;
  };
  causes.add({"p", Eigen::Vector4d(1, 0, 1, 2), {{"a"}, {"b"}}, Side::both, 1, 2, {}, declare});
  causes.add({"up", Eigen::Vector4d(0, 1, 0, 0), {{"a"}}, Side::positive});
  causes.add({"constant", Eigen::Vector4d(1, 1, 1, 1), {{"a", "b"}}});
  causes.add({"none", Eigen::Vector4d(0, 0, 0, 0), {{"a"}}});
  causes.free("a", -10, 10);
  causes.close();
  for (Candidate& candidate : causes.analysis.hypotheses.candidates)
    if (candidate.id == "none") {
      candidate.absent = "there is no clock";
      candidate.absence = Absence::no_clock;
    }
  const auto all = detectable_in(causes);
  const Detectable& p = of(all, "p");
  EXPECT_EQ(p.unit, "kPa");
  EXPECT_EQ(p.null, 2);
  EXPECT_EQ(p.reach, 7);
  EXPECT_FALSE(p.one_sided);
  EXPECT_EQ(p.place.tests, std::vector<std::string>{"b"}) << "where it shows best";
  EXPECT_EQ(p.absence, Absence::none);
  // (1, 2) less its mean over the four rows.
  EXPECT_NEAR(p.retained, std::sqrt(5 - 9.0 / 4) / std::sqrt(5), 1e-9);
  EXPECT_NEAR(p.detectable, power / std::sqrt(5 - 9.0 / 4), 1e-9);
  EXPECT_TRUE(of(all, "up").one_sided);
  const Detectable& absorbed = of(all, "constant");
  EXPECT_EQ(absorbed.absence, Absence::absorbed);
  EXPECT_THAT(absorbed.absent, ::testing::HasSubstr("absorbs"));
  EXPECT_TRUE(std::isinf(absorbed.detectable));
  EXPECT_TRUE(std::isinf(absorbed.identifiable));
  EXPECT_EQ(absorbed.reach, 500);
  EXPECT_EQ(absorbed.unit, "kPa");
  EXPECT_EQ(of(all, "none").absence, Absence::no_clock);
  EXPECT_EQ(of(all, "none").absent, "there is no clock");
}

TEST(Detectable, ReachesToTheFartherSideInTheUnitOfItsChannel) {
  MadeUpCauses causes({2}, Eigen::Vector2d(1, 1));
  causes.add({"down", Eigen::Vector2d(1, 0), {{"a"}}, Side::both, 1, 0, {}, [](MechanismFactory& factory) {
                factory.plausible_min = -8;
                factory.plausible_max = 3;
                factory.parameters.front().unit = "1";
              }});
  causes.close();
  EXPECT_EQ(of(detectable_in(causes), "down").reach, 8);
  EXPECT_EQ(of(detectable_in(causes), "down").unit, "1");
  Hypothesis& only = causes.analysis.hypotheses.candidates[0].hypotheses[0];
  only.addition.place.channel = "y";
  only.addition.range = AmplitudeRange{-2, 5, -10, 10};
  EXPECT_EQ(of(detectable_in(causes), "down").reach, 5) << "from the data";
  EXPECT_EQ(of(detectable_in(causes), "down").unit, "kPa");
}

/// One mechanism in five places, of which tests change the settings.
struct Places : OneRowEach {
  Places() : OneRowEach({1, 1, 1, 1, 1}) {
    add_everywhere("m", {1, 3, 5, 4, 2});
    close();
  }
  std::vector<Hypothesis>& all() { return analysis.hypotheses.candidates[0].hypotheses; }
  [[nodiscard]] std::string place() const { return of(detectable_in(*this), "m").place.tests.front(); }
};

TEST(Detectable, IsLookedForWhereItShowsBest) {
  Places places;
  EXPECT_EQ(places.place(), "c");
  places.all()[2].at_large = true;
  EXPECT_EQ(places.place(), "d") << "at the null";
  places.all()[3].addition.place.row = 0;
  EXPECT_EQ(places.place(), "b") << "of whole curves";
  places.all()[0].addition.range = AmplitudeRange{0, 5000, 0, 1};
  EXPECT_EQ(places.place(), "a") << "1 · 5000 and not 3 · 500";
  for (const std::size_t k : {2u, 3u, 4u}) places.all()[k].addition.range = AmplitudeRange{0, 0.1, 0, 1};
  places.all()[1].addition.range = AmplitudeRange{0, 0.5, 0, 1};
  places.all()[0].addition.range = AmplitudeRange{0, INFINITY, 0, INFINITY};
  EXPECT_EQ(places.place(), "b") << "without an end it is a unit: 1 · 1 and not 3 · 0.5";
}

// In each setting it is the place where it shows best; of four settings by their effects the third.
TEST(Detectable, IsThatOfTheSettingInTheMiddle) {
  Places places;
  for (std::size_t k = 0; k < 5; ++k) places.all()[k].addition.setting = {{"w", k == 2 ? 3.0 : static_cast<double>(k)}};
  EXPECT_EQ(places.place(), "b") << "1, 2, 3, 5, for the place with 4 has the setting of that with 5";
  places.all()[2].addition.setting = {{"w", 2}};
  EXPECT_EQ(places.place(), "b") << "1, 2, 3, 4, 5";
}

}  // namespace
}  // namespace tunica::diagnosis::detectable_test
