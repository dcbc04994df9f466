// SPDX-License-Identifier: Apache-2.0
// The single steps of the search: where it goes next after what an evaluation says, and when it ends.
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <gmock/gmock.h>

#include "calibration/fakes.hpp"
#include "diagnosis/evidence/least_squares.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;

/// y = a of four rows, 0 measured: residuals (t + m)/σ twice and (t − m)/σ twice, whatever the parameter is. A step
/// goes down by t/(1 + μ) in a, and promises 4 t²/σ² · (1 − (μ/(1 + μ))²), where μ is the damping.
struct Said {
  double t = 0, m = 0;
};
constexpr double torn = std::numeric_limits<double>::quiet_NaN();  ///< no evaluation

struct Scripted : fakes::Bench {
  Scripted(std::vector<Said> wanted, double sd) : script(std::move(wanted)) {
    run.objective = experiment::ObjectiveType::least_squares;
    add_test("t", {0, 1, 2, 3}, {0, 0, 0, 0}).data.noise = {{"y", {sd, 0, 0}}};
    for (const char* name : {"b", "c"}) parameter(name).fixed = 1;
  }
  Fit fit(double start = 7, std::size_t most = 200, const DataVariant& data = {}) {
    const auto assembly = assemble();
    const auto workspace = assembly.evaluator().make_workspace();
    seen.clear();
    fakes::set_behaviour([&](double a, std::span<double> values, Status& status) {
      const Said& now = script[std::min(seen.size(), script.size() - 1)];
      seen.push_back(a);
      if (std::isnan(now.t)) status = Status::failed("torn");
      for (std::size_t i = 0; i < 4; ++i) values[i] = now.t + (i < 2 ? now.m : -now.m);
    });
    Fit found = least_squares(assembly, {{0}}, std::vector<double>{start}, *workspace, most, data);
    fakes::set_behaviour({});
    EXPECT_EQ(found.evaluations, seen.size());
    return found;
  }
  std::vector<Said> script;
  std::vector<double> seen;  ///< the parameter at every evaluation
};

/// Nielsen's factor of the damping where a step from a miss t ends at the miss u.
double nielsen(double t, double u, double damping) {
  const double promised = t * t * (1 - std::pow(damping / (1 + damping), 2));
  return std::max(1.0 / 3, 1 - std::pow(2 * (t * t - u * u) / promised - 1, 3));
}

TEST(DampedSteps, AreShortenedWhileTheyFailAndAsNielsenSaysWhenTheySucceed) {
  // Doubled, then four times, eight times … as much.
  const std::vector<double> damping{1e-4, 2e-4, 8e-4, 64e-4, 1024e-4, 32768e-4};
  for (const double u : {1.0, 1.7, 1.95}) {
    Scripted bench({{2}, {torn}, {3}, {torn}, {torn}, {torn}, {u}, {torn}, {torn}, {0.1}}, 1e-3);
    const Fit found = bench.fit(7, 10);
    ASSERT_EQ(bench.seen.size(), 10u);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(bench.seen[k + 1], 7 - 2 / (1 + damping[k]), 1e-9) << k;
    const double from = bench.seen[6], after = damping[5] * nielsen(2, u, damping[5]);
    EXPECT_NEAR(bench.seen[7], from - u / (1 + after), 1e-9);
    EXPECT_NEAR(bench.seen[8], from - u / (1 + 2 * after), 1e-9);
    EXPECT_NEAR(bench.seen[9], from - u / (1 + 8 * after), 1e-9);
    EXPECT_EQ(found.free[0], bench.seen[9]);
    EXPECT_NEAR(found.chi2, 4 * 0.1 * 0.1 * 1e6, 1e-3);
    EXPECT_NEAR(found.residuals[3], 100, 1e-6);
  }
}

// 1e-4/3 · 2^(k(k + 1)/2) is above 1e12 when ten steps have failed: 1.2e12.
TEST(DampedSteps, EndWhenNothingHelps) {
  Scripted bench({{2}, {0.1}, {torn}}, 1e-4);
  EXPECT_EQ(bench.fit().evaluations, 2u + 10u);
  EXPECT_EQ(bench.fit().free[0], bench.seen[1]);
}

// Every step gains what it promised, so that the damping is a third each time, and not below 1e-12: 2^(k(k + 1)/2) is
// above 1e24 after 13 failures. It would be 14 from 1e-4/3^25. After ten steps it is 1.7e-9, and fails twelve times.
TEST(DampedSteps, AreAlwaysDampedALittle) {
  for (const std::size_t steps : {10, 25}) {
    std::vector<Said> script;
    for (std::size_t k = 0; k <= steps; ++k) script.push_back({0.3, 0.3 * std::sqrt(static_cast<double>(30 - k))});
    script.push_back({torn});
    EXPECT_EQ(Scripted(script, 1e-10).fit(9.9).evaluations, 1 + steps + (steps == 10 ? 12 : 13));
  }
}

// With a damping of 1.09 a step promises 0.87e-6 and is no use; with a tenth of that it promises 1.19e-6.
TEST(DampedSteps, EndOnlyWhereLessDampingPromisesNothingEither) {
  const double damping = 3.2768 / 3;
  for (const double left : {1.2e-6, 1.0000006e-6, 0.99e-6}) {
    const double u = std::sqrt(left / 4);
    Scripted bench({{2}, {torn}, {torn}, {torn}, {torn}, {torn}, {u}, {u / 100}}, 1);
    const Fit found = bench.fit();
    ASSERT_GE(bench.seen.size(), 7u);
    const double from = bench.seen[6];
    if (left < 1e-6) {
      EXPECT_EQ(found.evaluations, 7u);
      continue;
    }
    ASSERT_EQ(found.evaluations, 8u);
    // 1 − (μ/(1 + μ))² of the second one is enough with μ = 1.09e-4, and not with 1.09e-3.
    EXPECT_NEAR(bench.seen[7], from - u / (1 + damping * (left > 1.1e-6 ? 0.1 : 1e-4)), u * 1e-6);
  }
}

TEST(DampedSteps, StartWithinTheBoundsAndTakeNoMoreThanTheyMay) {
  for (const auto& [start, bound] : {std::pair{-1.0, 0.0}, {12.0, 10.0}, {7.0, 7.0}}) {
    Scripted bench({{2}, {1}}, 1e-3);
    const Fit found = bench.fit(start, 1);
    EXPECT_THAT(bench.seen, ElementsAre(bound));
    EXPECT_EQ(found.free[0], bound);
    EXPECT_THAT(found.at_bound, ElementsAre(bound != 7));
    EXPECT_NEAR(found.jacobian(0, 0), 1e3, 1e-9);
  }
  Scripted beyond({{2}, {1}}, 1e-3), across({{-5}, {1}, {0.5}}, 1e-3);
  beyond.fit(12, 2);
  EXPECT_NEAR(beyond.seen[1], 10 - 2 / (1 + 1e-4), 1e-9);
  across.fit(7, 3);
  EXPECT_EQ(across.seen[1], 10);
  EXPECT_NEAR(across.seen[2], 9, 1e-3);
  Scripted bench({{2}, {1.9}, {1.8}, {1.7}, {1.6}}, 1e-3);
  EXPECT_EQ(bench.fit(9, 4).evaluations, 4u);
}

// JᵀJ = 1e-10: a damping of 209 allows the whole way to 0, unless it is one of something larger.
TEST(DampedSteps, AreDampedByTheirOwnSizeHoweverSmall) {
  Scripted bench({{2e5}, {torn}}, 2e6);
  bench.fit(7, 8);
  ASSERT_GE(bench.seen.size(), 8u);
  for (std::size_t k = 1; k < 8; ++k) EXPECT_EQ(bench.seen[k], 0) << k;
}

TEST(DampedSteps, AreAtABoundWithinAMillionthOfTheRange) {
  for (const auto& [at, bound] : {std::pair{0.9e-5, true}, {1.5e-5, false}, {10 - 0.9e-5, true}, {10 - 1.5e-5, false}})
    EXPECT_THAT(Scripted({{0}}, 1).fit(at).at_bound, ElementsAre(bound)) << at;
}

// 400 of the squares are no step's to take.
TEST(HopelessFits, EndWhenThreeStepsInARowPromiseLessThanAHundredthOfWhatIsMissing) {
  const std::vector<Said> slow{{0.9, 10}, {0.8, 10}, {0.7, 10}, {0.6, 10}, {0.5, 10}, {0, 10}};
  const auto evaluations = [](const std::vector<Said>& script, double wanted) {
    DataVariant data;
    data.wanted = wanted;
    return Scripted(script, 1).fit(7, 200, data).evaluations;
  };
  EXPECT_EQ(evaluations(slow, 0), 3u);
  EXPECT_EQ(evaluations(slow, std::numeric_limits<double>::infinity()), 6u);
  EXPECT_EQ(evaluations(slow, 300), 6u) << "4 · 0.5² is the only promise below a hundredth of 101";
  EXPECT_EQ(evaluations(slow, 1000), 6u) << "below what is wanted";
  EXPECT_EQ(evaluations({{0.9, 10}, {2.5, 9.5}, {0.9, 9.5}, {0.8, 9.5}, {0.7, 9.5}, {0.6, 9.5}}, 0), 5u)
      << "the second step promises 25";
}

TEST(CreepingFits, EndWhenSixStepsGainNextToNothingTogether) {
  const auto evaluations = [](const std::vector<double>& gains, double negligible) {
    std::vector<Said> script{{0.1, 10}};
    for (const double gain : gains) script.push_back({0.1, std::sqrt(std::pow(script.back().m, 2) - gain / 4)});
    script.push_back({torn});
    DataVariant data;
    data.negligible = negligible / 100;  // |r|² is 400 in four rows
    return Scripted(script, 1).fit(9, 20, data).evaluations;
  };
  const std::vector<double> steady(15, 0.075), late{5, 5, 5, 0.05, 0.05, 0.05, 0.05, 0.05, 0.05, 0.05, 0.05, 0.05};
  EXPECT_EQ(evaluations(steady, 0.5), 1u + 7u) << "0.45 in the last six of seven";
  EXPECT_EQ(evaluations(steady, 0.4), 20u);
  EXPECT_EQ(evaluations(late, 0.5), 1u + 9u);
  EXPECT_EQ(evaluations(std::vector<double>(15, 0.1), 1), 20u) << "0.6: no more than 0.5 says nothing";
}

/// Rows of 0 and σ whose predictions are two functions of a, two rows each; Jacobians are differences.
struct Differenced : fakes::Bench {
  using Function = std::function<double(double)>;
  Differenced(Function one, Function two, double sd) : p(std::move(one)), q(std::move(two)) {
    run.objective = experiment::ObjectiveType::least_squares;
    add_test("t", {0, 1, 2, 3}, {0, 0, 0, 0}).data.noise = {{"y", {sd, 0, 0}}};
    for (const char* name : {"b", "c"}) parameter(name).fixed = 1;
    model().mechanisms = {{"memory", {}, {}}};
    model().mechanisms[0].parameters["g"].fixed = 0;
  }
  Fit fit(double start, std::size_t most = 200) {
    const auto assembly = assemble();
    EXPECT_FALSE(assembly.layout().jacobian_is_exact);
    const auto workspace = assembly.evaluator().make_workspace();
    fakes::set_behaviour([this](double a, std::span<double> values, Status& status) {
      if (tears && tears(a)) status = Status::failed("torn");
      for (std::size_t i = 0; i < 4; ++i) values[i] = i < 2 ? p(a) : q(a);
    });
    Fit found = least_squares(assembly, {{0}}, std::vector<double>{start}, *workspace, most);
    fakes::set_behaviour({});
    return found;
  }
  Function p, q;
  std::function<bool(double)> tears;
};

double bent(double a) { return (a - 3) * (1 + 0.2 * (a - 3)); }

// Newton with the slope at the start, then the secant method.
TEST(SecantSteps, FollowTheSlopeBetweenTheLastTwoPoints) {
  Differenced bench(bent, bent, 1e-3);
  const Fit start = bench.fit(5, 2);
  EXPECT_EQ(start.evaluations, 2u);
  EXPECT_EQ(start.free[0], 5);
  EXPECT_NEAR(start.jacobian(0, 0), 1800, 1e-3);
  const double a1 = 5 - bent(5) / 1.8 / (1 + 1e-4);
  const Fit first = bench.fit(5, 3);
  EXPECT_EQ(first.evaluations, 3u);
  EXPECT_NEAR(first.free[0], a1, 1e-8);
  double before = 5, now = a1, damping = 1e-4;
  for (const std::size_t most : {4, 5}) {
    const double slope = (bent(now) - bent(before)) / (now - before);
    EXPECT_NEAR(bench.fit(5, most - 1).jacobian(2, 0), 1e3 * slope, 1e-3);
    damping *= 1.0 / 3;
    before = std::exchange(now, now - bent(now) / slope / (1 + damping));
    EXPECT_NEAR(bench.fit(5, most).free[0], now, 1e-7);
  }
}

TEST(SecantSteps, TakeTheSlopeAgainWhereTheyFail) {
  Differenced bench(bent, bent, 1e-3);
  bench.tears = [](double a) { return a > 3.1 && a < 3.2; };  // where the second step would end, 3.12
  const double a1 = 5 - bent(5) / 1.8 / (1 + 1e-4), slope = 1 + 0.4 * (a1 - 3);
  const Fit failed = bench.fit(5, 4);
  EXPECT_EQ(failed.evaluations, 2u + 1 + 1 + 2);
  EXPECT_NEAR(failed.free[0], a1, 1e-8);
  EXPECT_NEAR(failed.jacobian(0, 0), 1e3 * slope, 1e-3);
  EXPECT_NEAR(failed.residuals[0], 1e3 * bent(a1), 1e-5);
  const Fit next = bench.fit(5, 7);
  EXPECT_EQ(next.evaluations, 7u);
  EXPECT_NEAR(next.free[0], a1 - bent(a1) / slope / (1 + 2e-4 / 3), 1e-7);
}

// 2 at 5 and 1 about 4, where the first step ends: the slope between them leads on to 3, where nothing can be
// evaluated, and the one at 4 nowhere.
TEST(SecantSteps, EndWhereTheSlopeTakenAgainSeesNoWay) {
  const auto step = [](double a) { return a > 4.5 ? 2 + 2 * (a - 5) : 1.0; };
  Differenced bench(step, step, 1e-3);
  bench.tears = [](double a) { return a < 3.5; };
  const Fit found = bench.fit(5);
  EXPECT_EQ(found.evaluations, 2u + 1 + 1 + 2);
  EXPECT_NEAR(found.free[0], 4, 1e-3);
}

TEST(SecantSteps, EndWhereTheSlopeCannotBeTakenAgain) {
  int calls = 0;
  Differenced bench(bent, bent, 1e-3);
  bench.tears = [&](double) { return ++calls > 4; };  // the start, one to each side of it, and one step
  const Fit found = bench.fit(5);
  const double a1 = 5 - bent(5) / 1.8 / (1 + 1e-4);
  EXPECT_EQ(found.evaluations, 2u + 1 + 1 + 2);
  EXPECT_NEAR(found.free[0], a1, 1e-8);
  EXPECT_NEAR(found.chi2, 4e6 * std::pow(bent(a1), 2), 1);
}

// A straight line: the first step ends at the optimum, and the slope is taken again if more than 1 was gained.
TEST(SecantSteps, AskOnceMoreForTheSlopeBeforeTheyEnd) {
  const auto line = [](double a) { return a - 3; };
  const auto evaluations = [&](double gain, std::size_t most) {
    return Differenced(line, line, std::sqrt(16 / gain)).fit(5, most).evaluations;
  };
  EXPECT_EQ(evaluations(0.8, 200), 3u);
  EXPECT_EQ(evaluations(1.2, 200), 5u);
  EXPECT_EQ(evaluations(1.2, 6), 5u);
  EXPECT_EQ(evaluations(1.2, 5), 3u);
}

// Down to the bound of 0, where the gradient presses against it.
TEST(SecantSteps, EndAtABoundWithoutAskingAgain) {
  const auto above = [](double a) { return a + 5; };
  const Fit found = Differenced(above, above, 1).fit(5);
  EXPECT_EQ(found.evaluations, 3u);
  EXPECT_EQ(found.free[0], 0);
}

/// 3 and 2(a − 3) until the first step, to 3, has been made; then 2(a − 3) is a part of either, which only the slope
/// taken again sees.
Differenced hidden_way(double sd) {
  static constexpr double edge = 3 + 4e-4;
  return Differenced([](double a) { return 3 - 2 * std::max(0.0, edge - a); }, [](double a) { return 2 * (a - 3); },
                     sd);
}

TEST(SecantSteps, GoOnWhereTheSlopeTakenAgainSeesAWay) {
  const double a1 = 3 + 2e-4 / (1 + 1e-4);
  // p = 3 − 2 (edge − a) and q = 2 (a − 3) from here.
  const double step = (3 - 2 * (3 + 4e-4 - a1) + 2 * (a1 - 3)) / 4;
  Differenced bench = hidden_way(1);
  const Fit found = bench.fit(5);
  EXPECT_EQ(found.evaluations, 2u + 1 + 2 + 1 + 2);
  EXPECT_NEAR(found.free[0], a1 - step, 1e-3);
  EXPECT_NEAR(found.chi2, 9, 0.01);
}

// The first step gains 32/18, the next one 9/18, which is too little to ask again.
TEST(SecantSteps, CountWhatTheyGainedSinceTheSlopeWasTakenAgain) {
  EXPECT_EQ(hidden_way(std::sqrt(18)).fit(5).evaluations, 2u + 1 + 2 + 1);
}

// A step from a slope that was just taken needs none when it fails: 1e-4/3 is doubled, then 4, 8, 16, 32 times as much.
TEST(SecantSteps, ThatFailFromANewSlopeAreShortenedAtOnce) {
  Differenced bench = hidden_way(1);
  bench.tears = [](double a) { return a < 2.3; };
  const Fit found = bench.fit(5, 11);
  EXPECT_EQ(found.evaluations, 2u + 1 + 2 + 5 + 1);
  const double a1 = 3 + 2e-4 / (1 + 1e-4), step = (3 - 2 * (3 + 4e-4 - a1) + 2 * (a1 - 3)) / 4;
  EXPECT_NEAR(found.free[0], a1 - step / (1 + 32768e-4 / 3), 1e-4);
}

}  // namespace
}  // namespace tunica::diagnosis
