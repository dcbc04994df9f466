// SPDX-License-Identifier: Apache-2.0
// Where fits with mechanisms begin. Every prediction fails here, so that each begins, and ends at once.
#include <cmath>
#include <map>

#include <Eigen/QR>
#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"
#include "diagnosis/naming/refits.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Side = MechanismFactory::Side;

/// What predictions were asked for: the parameters a, b, c of the model, and those of each mechanism.
struct NeverPredicted : MadeUpCauses {
  using MadeUpCauses::MadeUpCauses;
  void add_watched(MadeUp one, bool fails = true) {
    one.watch = [this, fails, id = one.id](std::span<const double> model, std::span<const double> own) {
      if (fails) models.emplace_back(model.begin(), model.end());
      owns[id].emplace_back(own.begin(), own.end());
      return fails ? Status::failed("never") : Status();
    };
    add(std::move(one));
  }
  /// The base fit said to have ended there.
  void close_at(const std::vector<double>& free) {
    close();
    analysis.evidence.fit.free = free;
  }
  [[nodiscard]] Addition addition(const std::string& id) const { return {id, {{"a"}}, {}}; }
  /// Another hypothesis of a mechanism, behind the others.
  Hypothesis& suppose(const std::string& id, const Place& place, const Eigen::VectorXd& signature) {
    for (Candidate& candidate : analysis.hypotheses.candidates) {
      if (candidate.id != id) continue;
      candidate.hypotheses.push_back({candidate.mechanism, {id, place, {}}, signature, Side::both, 1});
      return candidate.hypotheses.back();
    }
    throw std::runtime_error("no candidate " + id);
  }
  bool fit(const std::vector<Addition>& additions, const std::vector<double>& amplitudes, const Refit* from = nullptr) {
    models.clear();
    owns.clear();
    return fit_with(inquiry(), analysis, additions, amplitudes, from).has_value();
  }
  /// The j-th parameter of the model at every start.
  std::vector<double> of_model(std::size_t j) const {
    std::vector<double> all;
    for (const auto& model : models) all.push_back(model[j]);
    return all;
  }
  std::vector<double> amplitudes_of(const std::string& id) const {
    std::vector<double> all;
    for (const auto& own : owns.at(id)) all.push_back(own.front());
    return all;
  }
  std::vector<std::vector<double>> models;
  std::map<std::string, std::vector<std::vector<double>>> owns;
};

auto start_at(double value) { return DoubleNear(value, 1e-9 * (1 + std::abs(value))); }

Eigen::VectorXd level(double value) { return Eigen::VectorXd::Constant(4, value); }
Eigen::VectorXd ramp(double slope) { return Eigen::Vector4d(0, slope, 2 * slope, 3 * slope); }

// The parameters a and b make room for the effect: J Δ = −s δ, b by its logarithm.
TEST(StartsOfRefits, AreWhereTheStraightLineLeadsAndAtThreeTenthsOfTheWay) {
  const Eigen::Vector4d shape(1, 0, 3, 1);
  for (const double sign : {1.0, -1.0}) {
    NeverPredicted causes({4}, Eigen::Vector4d(0.1, -0.2, 0.1, 0));
    causes.add_watched({"m", shape, {{"a"}}, Side::positive, sign, 2});
    causes.free("a", 0, 10);
    causes.free("b", 0.01, 5);
    causes.close();
    Eigen::Matrix<double, 4, 2> J;
    J << 1, 0, 1, 1, 1, 2, 1, 3;
    const double amplitude = 0.25 * sign;
    const Eigen::Vector2d shift = J.colPivHouseholderQr().solve(-shape * amplitude);
    const double a = causes.analysis.evidence.fit.free[0], b = causes.analysis.evidence.fit.free[1];
    ASSERT_LT(std::abs(shift[1] / b), 1);
    EXPECT_FALSE(causes.fit({causes.addition("m")}, {amplitude}));
    EXPECT_THAT(causes.amplitudes_of("m"), ElementsAre(start_at(2 + amplitude), start_at(2 + 0.3 * amplitude)));
    EXPECT_THAT(causes.of_model(0), ElementsAre(start_at(a + shift[0]), start_at(a + 0.3 * shift[0])));
    EXPECT_THAT(causes.of_model(1),
                ElementsAre(start_at(b * std::exp(shift[1] / b)), start_at(b * std::exp(0.3 * shift[1] / b))));
  }
}

TEST(StartsOfRefits, MoveALinearParameterByThreeTenthsOfItsRangeAtMost) {
  NeverPredicted causes({4}, level(4));
  causes.add_watched({"m", level(1)});
  causes.free("a", 1, 9);
  causes.close_at({5});
  for (const double sign : {1.0, -1.0}) {
    causes.fit({causes.addition("m")}, {7 * sign});
    EXPECT_THAT(causes.of_model(0), ElementsAre(start_at(5 - 0.3 * 8 * sign), start_at(5 - 0.3 * 7 * sign)));
  }
}

TEST(StartsOfRefits, MoveALogarithmicParameterByAFactorOfEAtMost) {
  NeverPredicted causes({4}, ramp(0.4));
  causes.add_watched({"m", ramp(1)});
  causes.free("b", 0.01, 10);
  causes.close_at({0.5});
  for (const double sign : {1.0, -1.0}) {
    causes.fit({causes.addition("m")}, {sign});
    EXPECT_THAT(causes.of_model(1),
                ElementsAre(DoubleNear(0.5 * std::exp(-sign), 1e-5), DoubleNear(0.5 * std::exp(-0.6 * sign), 1e-5)));
  }
}

TEST(StartsOfRefits, StayWithinTheBounds) {
  NeverPredicted causes({4}, level(7));
  causes.add_watched({"m", level(1)});
  causes.free("a", 1, 9);
  causes.close_at({8});
  causes.fit({causes.addition("m")}, {-3});
  EXPECT_THAT(causes.of_model(0), ElementsAre(start_at(9), start_at(8.9)));
  causes.fit({causes.addition("m")}, {-4000});
  EXPECT_THAT(causes.amplitudes_of("m"), ElementsAre(start_at(-1000), start_at(-1000)));
}

TEST(StartsOfRefits, OfAnEvenMechanismAreAtTheRootOfItsSquare) {
  NeverPredicted causes({4}, level(0));
  causes.add_watched({"m", level(1), {{"a"}}, Side::even, 1, 1});
  causes.close();
  causes.fit({causes.addition("m")}, {0.25});
  EXPECT_THAT(causes.amplitudes_of("m"), ElementsAre(start_at(1.5), start_at(1.15)));
  causes.fit({causes.addition("m")}, {-4});
  EXPECT_THAT(causes.amplitudes_of("m"), ElementsAre(start_at(1), start_at(1))) << "no square is negative";
}

// The same mechanism elsewhere, in another setting, and another mechanism there would move a by other amounts.
TEST(StartsOfRefits, TakeTheSignatureOfThatMechanismPlaceAndSetting) {
  NeverPredicted causes({4}, level(4));
  causes.add_watched({"other", level(0.5)});
  causes.add_watched({"m", level(1), {{"a"}}, Side::both, 1, 0, {{"w", level(0)}}});
  causes.free("a", 1, 9);
  causes.close_at({5});
  const Place here{{"a"}}, channel{{"a"}, "y"};
  const MechanismFactory::Setting setting = {{"w", 3}};
  for (Candidate& candidate : causes.analysis.hypotheses.candidates) candidate.hypotheses.clear();
  causes.suppose("other", here, level(0.5)).addition.setting = setting;
  causes.suppose("m", channel, level(0.25)).addition.setting = setting;
  causes.suppose("m", here, level(0.125));
  causes.suppose("m", here, level(1)).addition.setting = setting;
  causes.suppose("m", here, level(2)).addition.setting = setting;
  causes.fit({{"m", here, setting}}, {-1});
  EXPECT_THAT(causes.of_model(0), ElementsAre(start_at(6), start_at(5.3)));
  EXPECT_THAT(causes.owns["m"],
              ElementsAre(ElementsAre(start_at(-1), start_at(3)), ElementsAre(start_at(-0.3), start_at(3))));
  causes.fit({{"m", here, {{"w", 4}}}}, {-1});
  EXPECT_THAT(causes.of_model(0), ElementsAre(start_at(5), start_at(5)))
      << "without a signature the base stays where it is";
}

TEST(StartsOfRefits, TakeTheSignatureOnTheSideOfTheAmplitude) {
  NeverPredicted causes({4}, level(4));
  causes.add_watched({"m", level(1)});
  causes.free("a", 1, 9);
  causes.close_at({5});
  causes.analysis.hypotheses.candidates.front().hypotheses.clear();
  Hypothesis& up = causes.suppose("m", {{"a"}}, level(1));
  up.side = Side::positive;
  Hypothesis& down = causes.suppose("m", {{"a"}}, level(-2));
  down.side = Side::positive;
  down.sign = -1;
  const std::vector<Addition> additions = {{"m", {{"a"}}, {}}};
  causes.fit(additions, {0.5});
  EXPECT_THAT(causes.of_model(0), ElementsAre(start_at(4.5), start_at(4.85)));
  causes.fit(additions, {-0.5});
  EXPECT_THAT(causes.of_model(0), ElementsAre(start_at(6), start_at(5.3)));
  causes.analysis.hypotheses.candidates.front().hypotheses.front().side = Side::both;
  causes.fit(additions, {-0.5});
  EXPECT_THAT(causes.of_model(0), ElementsAre(start_at(5.5), start_at(5.15))) << "on both sides";
}

TEST(StartsOfRefits, AddUpWhatSeveralMechanismsDo) {
  NeverPredicted causes({4}, level(4));
  causes.add_watched({"m", level(1)});
  causes.add_watched({"n", level(2)}, false);
  causes.free("a", 1, 9);
  causes.close_at({5});
  causes.fit({causes.addition("m"), causes.addition("n")}, {1, -0.75});
  EXPECT_THAT(causes.of_model(0), ElementsAre(start_at(5.5), start_at(5.15)));
  EXPECT_THAT(causes.amplitudes_of("m"), ElementsAre(start_at(1), start_at(0.3)));
  EXPECT_THAT(causes.amplitudes_of("n"), ElementsAre(start_at(-0.75), start_at(-0.225)));
}

// Beside the base, which may be free.
TEST(StartsOfRefits, BeginFirstWhereASmallerRefitEnded) {
  NeverPredicted causes({4}, level(4));
  causes.add_watched({"m", level(1)});
  causes.add_watched({"n", ramp(1)}, false);
  causes.free("a", 1, 9);
  causes.free("b", 0.01, 5);
  causes.close_at({5, 0.1});
  Refit smaller{{causes.addition("m")}, {}, {}};
  smaller.extension = std::make_shared<const Extension>(causes.experiment, causes.run, smaller.additions, causes.shelf);
  const auto& names = smaller.extension->assembly().layout().parameters;
  for (const auto& parameter : names)
    smaller.fit.free.push_back(parameter.name == "a" ? 2.5 : parameter.name == "b" ? 0.75 : 1.75);
  EXPECT_FALSE(causes.fit({causes.addition("m"), causes.addition("n")}, {1, 0.5}, &smaller));
  ASSERT_EQ(causes.models.size(), 3u);
  EXPECT_THAT(causes.models.front(), ElementsAre(start_at(2.5), start_at(0.75), start_at(0)));
  EXPECT_THAT(causes.amplitudes_of("m"), ElementsAre(start_at(1.75), start_at(1), start_at(0.3)));
  EXPECT_THAT(causes.amplitudes_of("n"), ElementsAre(start_at(0.5), start_at(0.5), start_at(0.15)));
}

TEST(StartsOfRefits, AreNoneWhereAMechanismCannotAct) {
  NeverPredicted causes({4}, level(4));
  MadeUp one{"m", level(1)};
  one.declare = [](MechanismFactory& factory) { factory.applies_to = {"strip"}; };
  causes.add_watched(one);
  causes.close();
  EXPECT_FALSE(causes.fit({causes.addition("m")}, {1}));
  EXPECT_THAT(causes.models, IsEmpty());
}

}  // namespace
}  // namespace tunica::diagnosis
