// SPDX-License-Identifier: Apache-2.0
// Where the base fit begins, which of its fits is kept, and how long each may take.
#include "diagnosis/evidence/base_fit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include <gmock/gmock.h>

#include "calibration/fakes.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// The stress at a parameter, and its derivative; none where it cannot be evaluated.
struct StressAt {
  double value, slope;
};
using StressOf = std::function<std::optional<StressAt>(double a)>;

/// A constant stress, whatever the deformation.
class EvenStress final : public Model {
 public:
  EvenStress(StressOf stress, double max) : stress_(std::move(stress)) {
    description_.type = "even_stress";
    description_.parameters = {{"a", "kPa", 0, 0, max, Scale::linear, "", ""}};
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    const auto found = stress_(points.parameters[0]);
    if (!found) return Status::failed("nothing here");
    std::ranges::fill(response.stress, found->value);
    std::ranges::fill(response.stress_dp, found->slope);
    return {};
  }

 private:
  StressOf stress_;
  ModelDescription description_;
};

/// Looks at one point of the unit box.
class LooksAt final : public Optimizer {
 public:
  explicit LooksAt(double place) : place_(place) {}
  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override {
    double objective = 0;
    static_cast<void>(problem.evaluate(std::vector{place_}, objective));
    return {true, "looked"};
  }

 private:
  double place_;
  Needs needs_;
};

/// Two rows of measured 0 with σ as given, and a model with that stress for 0 ≤ a ≤ max.
struct BaseFitBed : fakes::Bench {
  BaseFitBed(const StressOf& stress, double max, double sd = 1) {
    plugins::Catalogue::Registration stage;
    stage.add(ModelFactory{"even_stress", "", "", {}, [this, stress, max](const Options&) {
                             return std::make_unique<EvenStress>(
                                 [this, stress](double a) {
                                   const std::scoped_lock lock(mutex);
                                   asked.push_back(a);
                                   return stress(a);
                                 },
                                 max);
                           }});
    for (const auto& [type, place] : {std::pair{"looks_up", 0.75}, {"looks_down", 0.25}})
      stage.add(
          OptimizerFactory{type, "", "", {}, [place](const Options&) { return std::make_unique<LooksAt>(place); }});
    shelf.commit(std::move(stage), "base fit 1");
    model().type = "even_stress";
    run.objective = experiment::ObjectiveType::least_squares;
    add_test("t", {0, 1}, {0, 0}).data.noise = {{"y", {.absolute = sd}}};
    for (const char* type : {"looks_up", "looks_down"}) {
      auto& entry = experiment.optimizers.emplace_back();
      entry.name = entry.type = type;
    }
  }
  BaseFit fit() {
    Preparation prepared;
    prepared.experiment = experiment;
    prepared.run = run;
    prepared.base = std::make_shared<const assembly::Assembly>(experiment, run, shelf);
    asked.clear();
    reports.clear();
    return fit_base({experiment, request, shelf, progress}, prepared);
  }
  /// Where fits begin: nothing can be evaluated, so that each looks at its start alone.
  std::vector<double> starts() {
    EXPECT_THROW(static_cast<void>(fit()), BaseFitFailure);
    std::ranges::sort(asked);
    return asked;
  }

  std::mutex mutex;
  std::vector<double> asked, reports;
  Request request;
  Progress progress = [this](const std::string&, double share) {
    const std::scoped_lock lock(mutex);
    reports.push_back(share);
  };
};

std::optional<StressAt> not_evaluable(double) { return std::nullopt; }

TEST(BaseFitStarts, AreTheInitialValuesAndRandomOnesWithinTheBounds) {
  BaseFitBed bed(not_evaluable, 100);
  bed.parameter("a").initial = 99.5;
  double least = 100, most = 0;
  for (bed.request.seed = 1; bed.request.seed <= 50; ++bed.request.seed) {
    auto starts = bed.starts();
    ASSERT_THAT(starts, SizeIs(9));
    EXPECT_EQ(starts.back(), 99.5);
    starts.pop_back();
    EXPECT_EQ(std::ranges::unique(starts).begin(), starts.end()) << "no two of them are the same";
    least = std::min(least, starts.front());
    most = std::max(most, starts.back());
  }
  // Of 400 even numbers from 2 to 98; those at a bound would begin where the fit cannot leave.
  EXPECT_GE(least, 2);
  EXPECT_LT(least, 3);
  EXPECT_LE(most, 98);
  EXPECT_GT(most, 97);
}

TEST(BaseFitStarts, AreTheSameForASeedAndOthersForAnother) {
  BaseFitBed bed(not_evaluable, 100);
  const auto first = bed.starts();
  EXPECT_EQ(bed.starts(), first);
  bed.request.seed = 2;
  EXPECT_NE(bed.starts(), first);
  bed.request.quick = true;
  const auto quick = bed.starts();
  EXPECT_THAT(quick, SizeIs(4)) << "fewer where it has to be quick";
  EXPECT_THAT(quick, Contains(0));
}

TEST(BaseFitStarts, AreToldWhereNoneCanBeEvaluated) {
  BaseFitBed bed(not_evaluable, 100);
  const std::string message = fakes::message_of([&] { static_cast<void>(bed.fit()); });
  EXPECT_THAT(message, HasSubstr("cannot be evaluated from any of 9 starts"));
  EXPECT_THAT(message, HasSubstr("nothing here"));
}

TEST(BaseFitStarts, AreReportedOneByOne) {
  BaseFitBed bed([](double a) { return StressAt{a, 1}; }, 100);
  static_cast<void>(bed.fit());
  ASSERT_THAT(bed.reports, SizeIs(1 + 9));
  std::ranges::sort(bed.reports);
  EXPECT_DOUBLE_EQ(bed.reports.front(), 0.05) << "the share of the diagnosis before";
  EXPECT_DOUBLE_EQ(bed.reports.back(), 0.1);
}

/// 5 wherever one looks, but for a pit of no width to speak of.
StressOf pit(double place, double depth) {
  return [=](double a) { return StressAt{std::abs(a - place) < 1e-9 ? 5 - depth : 5, 0}; };
}

TEST(BaseFitStarts, HaveWhatTheOptimizerFoundAmongThem) {
  BaseFitBed bed(pit(75, 3), 100);
  EXPECT_NEAR(bed.fit().fit.chi2, 2 * 25, 1e-12) << "none was asked";
  bed.request.optimizer = "looks_up";
  const auto found = bed.fit();
  EXPECT_NEAR(found.fit.chi2, 2 * 4, 1e-12);
  EXPECT_THAT(found.fit.free, ElementsAre(75));
  EXPECT_THAT(found.warnings, IsEmpty());
  bed.request.optimizer = "looks_down";
  EXPECT_NEAR(bed.fit().fit.chi2, 2 * 25, 1e-12) << "that is elsewhere";
  bed.request.optimizer = "looks_up";
  bed.request.quick = true;
  EXPECT_NEAR(bed.fit().fit.chi2, 2 * 25, 1e-12) << "no time for it";
  EXPECT_THAT(bed.asked, Each(::testing::Ne(75)));
}

TEST(BaseFitStarts, DoWithoutAnOptimizerThatFindsNone) {
  BaseFitBed bed([](double a) { return std::abs(a - 75) < 1e-9 ? std::nullopt : std::optional(StressAt{5, 0}); }, 100);
  bed.request.optimizer = "looks_up";
  const auto found = bed.fit();
  ASSERT_THAT(found.warnings, SizeIs(1));
  EXPECT_EQ(found.warnings[0].kind, WarningKind::optimizer_failed);
  EXPECT_THAT(found.warnings[0].text, HasSubstr("'looks_up'"));
  EXPECT_NEAR(found.fit.chi2, 2 * 25, 1e-12);
  EXPECT_THAT(bed.reports, SizeIs(1 + 9)) << "and it is no start";
}

TEST(BaseFitStarts, DoWithoutAnOptimizerOfStages) {
  BaseFitBed bed(pit(75, 3), 100);
  auto& both = bed.experiment.optimizers.emplace_back();
  both.name = "both";
  both.type = "stages";
  both.stages = {{"looks_down", {}}, {"looks_up", {}}};
  bed.request.optimizer = "both";
  const auto found = bed.fit();
  ASSERT_THAT(found.warnings, SizeIs(1));
  EXPECT_EQ(found.warnings[0].kind, WarningKind::optimizer_has_stages);
  EXPECT_NEAR(found.fit.chi2, 2 * 25, 1e-12);
}

/// Flat valleys of all depths, of a few that cannot be entered, and the deepest in the middle of the others.
TEST(BaseFitKept, IsTheBestThatCouldBeEvaluated) {
  constexpr double sd = 10;  // all of them are noise
  BaseFitBed unevaluable(not_evaluable, 100, sd);
  const auto depth = [](double a) { return 1 + std::abs(std::sin(40 * a)); };
  const auto open = [](double a) { return std::fmod(a, 2) < 1.2; };
  BaseFitBed bed([&](double a) { return open(a) ? std::optional(StressAt{depth(a), 0}) : std::nullopt; }, 100, sd);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    unevaluable.request.seed = bed.request.seed = seed;
    double best = 1e9;
    for (const double start : unevaluable.starts())
      if (open(start)) best = std::min(best, 2 * depth(start) * depth(start) / (sd * sd));
    EXPECT_NEAR(bed.fit().fit.chi2, best, 1e-9) << seed;
  }
}

/// Ten flat valleys, whose |r|² are 1.5 apart: a poorer one is as small as noise, and its misfit would look like a
/// cause.
TEST(BaseFitKept, IsReachedByAThirdOfTheStartsAmongNoiseToo) {
  constexpr std::ptrdiff_t all = 9 + 4 * 12;  // starts of a search that has not ended before
  const auto depth = [](double a) { return std::sqrt(0.01 + 0.75 * ((7 * static_cast<int>(a / 10) + 3) % 10)); };
  BaseFitBed bed([&](double a) { return StressAt{depth(a), 0}; }, 99.9);
  for (bed.request.seed = 1; bed.request.seed <= 20; ++bed.request.seed) {
    const double best = depth(bed.fit().fit.free[0]);
    std::ranges::sort(bed.asked);
    const auto twice = std::ranges::unique(bed.asked);
    bed.asked.erase(twice.begin(), twice.end());
    const auto there = std::ranges::count_if(bed.asked, [&](double a) { return depth(a) == best; });
    EXPECT_GE(there, 2) << bed.request.seed;
    EXPECT_TRUE(3 * there >= std::ssize(bed.asked) || std::ssize(bed.asked) >= all) << bed.request.seed;
  }
}

TEST(BaseFitKept, IsAnOptimumWhereNothingKeepsItFromOne) {
  BaseFitBed bed([](double a) { return StressAt{0.1 * (a - 30), 0.1}; }, 100, 0.01);
  const auto found = bed.fit();
  EXPECT_NEAR(found.fit.free[0], 30, 1e-6);
  EXPECT_THAT(found.warnings, IsEmpty());
}

/// The optimum, 30, lies beyond a bound. At the end of the model's own range, only the model is at fault.
TEST(BaseFitKept, SaysWhichBoundsHoldItBack) {
  for (const double most : {20., 40.}) {
    BaseFitBed bed([](double a) { return StressAt{0.1 * (a - 30), 0.1}; }, 100, 0.01);
    bed.parameter("a").initial = 10;
    bed.parameter("a").max = most;
    const auto found = bed.fit();
    if (most > 30) {
      EXPECT_THAT(found.warnings, IsEmpty());
      continue;
    }
    ASSERT_THAT(found.warnings, SizeIs(1));
    EXPECT_EQ(found.warnings[0].kind, WarningKind::base_fit_at_bound);
    EXPECT_THAT(found.warnings[0].text, HasSubstr("held back by its bounds: a = 20 kPa (upper bound)."));
  }
  BaseFitBed ends([](double a) { return StressAt{0.1 * (a - 130), 0.1}; }, 100, 0.01);
  EXPECT_NEAR(ends.fit().fit.free[0], 100, 1e-9);
  EXPECT_THAT(ends.fit().warnings, IsEmpty());
}

/// exp(300 − a) between two parameters, and nothing else: a step goes down by 1, as often as it may.
StressOf slope_between(double from, double to) {
  return [=](double a) -> std::optional<StressAt> {
    if (a < from || a > to) return std::nullopt;
    return StressAt{std::exp(300 - a), -std::exp(300 - a)};
  };
}

/// Where a step would take half of a misfit that noise does not explain, the fit goes on: 400 steps more, and 12
/// starts.
TEST(BaseFitEvaluations, AreMoreWhereASearchEndsOnItsWay) {
  BaseFitBed bed(slope_between(1, 300), 30000);
  bed.parameter("a").initial = 10;
  const auto found = bed.fit();
  EXPECT_GT(found.fit.free[0], 290) << "the first 200 steps come to 209";
  EXPECT_GT(bed.asked.size(), 200U);
}

TEST(BaseFitKept, IsSaidToBeNoOptimumWhereAStepWouldLowerItByATenth) {
  const auto ended = [](double sd) {
    BaseFitBed bed(slope_between(1, 300), 30000, sd);
    bed.parameter("a").initial = 10;
    return bed.fit();
  };
  // One parameter that moves both rows alike takes all of |r|² away, which is as 1/σ².
  const double unit = std::sqrt(ended(1).fit.chi2 / 0.1);
  const auto below = ended(1.05 * unit), above = ended(0.95 * unit);
  EXPECT_NEAR(below.fit.chi2, 0.1 / (1.05 * 1.05), 1e-4);
  EXPECT_THAT(below.warnings, IsEmpty());
  ASSERT_THAT(above.warnings, SizeIs(1));
  EXPECT_EQ(above.warnings[0].kind, WarningKind::base_fit_not_optimal);
  EXPECT_THAT(above.warnings[0].text, HasSubstr("by 0.11."));
}

}  // namespace
}  // namespace tunica::diagnosis
