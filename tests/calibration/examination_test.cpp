// SPDX-License-Identifier: Apache-2.0
#include "calibration/examination.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>

#include <gmock/gmock.h>

#include "calibration/answering_curve.hpp"
#include "execution/laboratory.hpp"
#include "tunica/error.hpp"

namespace tunica {
namespace {

using calibration::Examination;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using Microseconds = std::chrono::microseconds;

/// A laboratory whose data state their noise, σ = 1.
struct Examining : trial::Laboratory {
  Examining() { bench.experiment.tests.front().data.noise = {{"y", {.absolute = 1}}}; }
  Examination examine() const { return calibration::examine(bench.experiment, bench.shelf); }
  std::string refusal() const {
    return fakes::message_of([this] { static_cast<void>(examine()); });
  }
  experiment::TestEntry& add(const std::string& name, const std::vector<double>& x) {
    auto& entry = bench.add_test(name, x, fakes::map(x, [](double at) { return 2 + at; }));
    entry.data.noise = {{"y", {.absolute = 1}}};
    return entry;
  }

  std::atomic<int> calls = 0;  ///< some are concurrent
};

/// Keeps the processor busy, which is more exact than sleeping.
void busy(Microseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end) continue;
}

/// y = a in every row, and nothing is prescribed.
class Level final : public Test {
 public:
  explicit Level(const TestSetup& setup) {
    rows_.count = setup.rows.count;
    rows_.channels = setup.rows.channels;
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    for (double& value : output.values) value = input.model_parameters[0];
    for (std::size_t i = 0; i < output.jacobian.size(); ++i) output.jacobian[i] = i < rows_.count ? 1 : 0;
    return {};
  }

 private:
  TestDescription description_;
  TestRows rows_;
};

/// A parabola that says what it is.
class WrittenModel final : public Model {
 public:
  explicit WrittenModel(std::unique_ptr<Model> base) : base_(std::move(base)), description_(base_->describe()) {
    description_.formula = "S = a + b x + c x²";
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    return base_->evaluate(points, response);
  }

 private:
  std::unique_ptr<Model> base_;
  ModelDescription description_;
};

TEST(Examination, EvaluatesTheInitialPoint) {
  Examining trial;
  trial.add("line", {0, 1, 2});
  trial.add_run("compass").tests = {"curve", "line"};
  const auto found = trial.examine();
  ASSERT_THAT(found.problems, SizeIs(1));
  const auto& point = found.problems[0].initial;
  EXPECT_TRUE(point.status.ok());
  // a = b = 1, c = 0: the curve misses its data by 1 + 3 x² at x = 0, ¼ … 1, the line by 1 in three rows.
  double curve = 0;
  for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0}) curve += std::pow(1 + 3 * x * x, 2);
  ASSERT_THAT(point.per_test, SizeIs(2));
  EXPECT_NEAR(point.per_test[1] / point.per_test[0], 3 / curve, 1e-12);
  EXPECT_NEAR(point.objective, point.per_test[0] + point.per_test[1], 1e-12 * curve);
  EXPECT_GT(point.objective, 1);
  EXPECT_TRUE(point.analysed);
  EXPECT_TRUE(found.good());
  EXPECT_EQ(found.problems[0].run, &found.plan.runs[0]);
}

TEST(Examination, SaysWhatTheDataDoNotFix) {
  Examining trial;
  trial.bench.model().type = "valley";
  trial.add_run("compass");
  EXPECT_THAT(trial.examine().problems.at(0).initial.sentences, ::testing::Not(IsEmpty()));
}

TEST(Examination, IsBadWhereTheInitialPointFails) {
  Examining trial;
  trial.add_run("compass");
  fakes::set_behaviour([&](double, std::span<double>, Status& status) {
    ++trial.calls;
    status = Status::failed("row 2: no root");
  });
  const auto found = trial.examine();
  const auto& point = found.problems.at(0).initial;
  EXPECT_EQ(trial.calls, 1) << "it is not tried again";
  EXPECT_EQ(point.status.kind(), Status::Kind::failed);
  EXPECT_THAT(point.status.reason(), HasSubstr("row 2: no root"));
  EXPECT_FALSE(point.analysed);
  EXPECT_FALSE(point.good());
  EXPECT_FALSE(found.good());
}

TEST(Examination, DoesNotAnalyseWhatCannotBeLinearised) {
  Examining trial;
  trial.add_run("compass");
  fakes::set_behaviour([&](double, std::span<double>, Status& status) {
    if (++trial.calls > 1) status = Status::failed("only once");
  });
  const auto found = trial.examine();
  const auto& point = found.problems.at(0).initial;
  EXPECT_TRUE(point.status.ok());
  EXPECT_FALSE(point.analysed);
  EXPECT_THAT(point.sentences, IsEmpty());
  EXPECT_TRUE(point.good()) << "it could be evaluated";
}

TEST(Examination, TellsTheTimeOfAnEvaluation) {
  Examining trial;
  trial.add_run("compass");
  fakes::set_behaviour([&](double, std::span<double>, Status&) {
    ++trial.calls;
    busy(Microseconds(50));
  });
  EXPECT_GE(trial.examine().problems.at(0).initial.seconds, 50e-6);
  EXPECT_LT(trial.calls, 3000) << "a thousand are enough, however fast the machine";
}

TEST(Examination, EvaluatesACostlyTestOnceForItsTime) {
  Examining trial;
  trial.bench.experiment.tests.front().type = "costly_curve";
  trial.add_run("compass");
  fakes::set_behaviour([&](double, std::span<double>, Status&) {
    if (++trial.calls == 1) busy(Microseconds(20000));
  });
  EXPECT_GE(trial.examine().problems.at(0).initial.seconds, 20e-3);
  EXPECT_LT(trial.calls, 60);
}

TEST(Examination, AsksTestsForOtherMeans) {
  struct Case {
    std::vector<Agreement> answer;
    Status status;
    std::size_t listed;
    bool good;
  };
  for (const Case& one : {Case{{}, {}, 0, true}, Case{{{"a series", 1, "kPa", 1}}, {}, 1, true},
                          Case{{{"a series", 1, "kPa", 1}, {"a table", 1.5, "kPa", 1}}, {}, 1, false},
                          Case{{}, Status::failed("no series"), 1, true}}) {
    Examining trial;
    fakes::add_answering_curve(trial.bench.shelf, [&one](std::vector<Agreement>& found) {
      found = one.answer;
      return one.status;
    });
    trial.bench.experiment.tests.front().type = "answering_curve";
    trial.add("other", {0, 1, 2});
    trial.add_run("compass").tests = {"curve", "other"};
    const auto found = trial.examine();
    const auto& point = found.problems.at(0).initial;
    EXPECT_EQ(point.good(), one.good);
    EXPECT_EQ(found.good(), one.good);
    ASSERT_THAT(point.other_means, SizeIs(one.listed));
    if (one.listed == 0) continue;
    EXPECT_EQ(point.other_means[0].test, "curve");
    EXPECT_THAT(point.other_means[0].found, SizeIs(one.answer.size()));
    EXPECT_EQ(point.other_means[0].status.reason(), one.status.reason());
  }
}

TEST(Examination, ShowsThePathsThatSomebodyHasToAgreeWith) {
  Examining trial;
  trial.add("loop", {0, 1, 0.2});
  trial.add("ordered", {0, 1, 2}).data.order = data::Order::loading;
  trial.add_run("compass").tests = {"curve"};
  const auto found = trial.examine();
  ASSERT_THAT(found.paths, SizeIs(2)) << "a path that only rises, in an order that nobody gave, is none";
  EXPECT_EQ(found.paths[0].test, "loop");
  EXPECT_FALSE(found.paths[0].ordered);
  EXPECT_EQ(found.paths[0].past, data::Past::order_unknown);
  EXPECT_THAT(found.paths[0].words, HasSubstr("0 → 1 → 0.2"));
  EXPECT_FALSE(found.paths[0].drawing.empty());
  EXPECT_EQ(found.paths[1].test, "ordered");
  EXPECT_TRUE(found.paths[1].ordered);
  EXPECT_EQ(found.paths[1].past, data::Past::known);
  EXPECT_THAT(found.understood, SizeIs(3)) << "every test says what its columns were taken for";
}

TEST(Examination, ShowsNoPathWhereNothingIsPrescribed) {
  Examining trial;
  TestFactory factory;
  factory.type = "level";
  factory.observables = {{"y", "kPa", Observable::Role::channel, true, "height"}};
  factory.create = [](const TestSetup& setup) { return std::make_unique<Level>(setup); };
  plugins::Catalogue::Registration stage;
  stage.add(std::move(factory));
  trial.bench.shelf.commit(std::move(stage), "levels 1");
  auto& entry = trial.bench.experiment.tests.front();
  entry.type = "level";
  entry.data.columns = {{"y", "y"}};
  entry.data.order = data::Order::loading;
  entry.parameters.clear();
  trial.add_run("compass");
  const auto found = trial.examine();
  EXPECT_THAT(found.paths, IsEmpty());
  EXPECT_TRUE(found.good());
}

TEST(Examination, SaysWhatItMadeOfAFile) {
  Examining trial;
  auto& loop = trial.add("loop", {0, 1, 0.2});
  loop.data.order = data::Order::loading;
  loop.data.branch = data::BranchChoice::loading;
  trial.add_run("compass").tests = {"curve"};
  const auto found = trial.examine();
  ASSERT_THAT(found.understood, SizeIs(2));
  EXPECT_EQ(found.understood[1].test, "loop");
  EXPECT_EQ(found.understood[1].lines.back(), "rows: 2 of the 3 in the file: loading only");
}

TEST(Examination, TellsEveryWarningAndNoteOnce) {
  Examining trial;
  trial.bench.experiment.tests.front().data.noise.clear();
  trial.bench.parameter("a").max = 100;
  for (int k = 0; k < 2; ++k) trial.add_run("compass", 100, 2);
  const auto found = trial.examine();
  std::vector<execution::WarningKind> kinds;
  for (const auto& warning : found.warnings) kinds.push_back(warning.kind);
  using Kind = execution::WarningKind;
  EXPECT_THAT(kinds, ElementsAre(Kind::equal_realisations, Kind::equal_realisations, Kind::set_up))
      << "what the plan says of each run, then what the runs have in common";
  EXPECT_THAT(found.warnings.back().sentence, HasSubstr("parameter 'a': its bounds 0 … 100"));
  EXPECT_THAT(found.notes, ElementsAre(HasSubstr("no noise is stated")));
}

TEST(Examination, NotesTheFormulaOfAModelThatHasOne) {
  Examining trial;
  ModelFactory factory = trial.bench.shelf.models().at("parabola").factory;
  factory.type = "written";
  factory.create = [create = factory.create](const Options& options) {
    return std::make_unique<WrittenModel>(create(options));
  };
  plugins::Catalogue::Registration stage;
  stage.add(std::move(factory));
  trial.bench.shelf.commit(std::move(stage), "written 1");
  trial.bench.experiment.models.push_back({"w", "written", {}, {}, {}});
  trial.add_run("compass");
  EXPECT_THAT(trial.examine().notes, ElementsAre("model w: S = a + b x + c x²")) << "and none of the other one";
}

TEST(Examination, PosesAProblemOnceForAllOptimisers) {
  Examining trial;
  trial.bench.model().type = "bordered";
  trial.add_run("compass");
  trial.add_run("residual");
  trial.add_run("descent").constraints.push_back(
      {.type = "admissible_parameters", .json = R"({"type": "admissible_parameters"})"});
  const auto found = trial.examine();
  ASSERT_THAT(found.problems, SizeIs(2));
  EXPECT_EQ(found.problems[0].title, "model m, least_squares on curve");
  EXPECT_EQ(found.problems[1].title, R"(model m, least_squares on curve, {"type": "admissible_parameters"})");
  EXPECT_EQ(found.problems[1].run, &found.plan.runs[2]);
}

TEST(Examination, RefusesWhatARunRefusesBeforeItEvaluates) {
  Examining trial;
  trial.add_run("compass");
  fakes::set_behaviour([&](double, std::span<double>, Status&) { ++trial.calls; });
  trial.bench.experiment.analysis.profiles = {"stiffness"};
  EXPECT_THAT(trial.refusal(), HasSubstr("no run searches for the parameter 'stiffness'"));
  trial.bench.experiment.analysis.bootstrap_draws = std::uint64_t{1} << 60;
  EXPECT_THAT(trial.refusal(), HasSubstr("of memory"));
  EXPECT_EQ(trial.calls, 0);
}

}  // namespace
}  // namespace tunica
