// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/recording.hpp"

namespace tunica {
namespace {

using assembly::Assembly;
using fakes::Bench;
using fakes::Recording;
using search::CalibrationProblem;

/// A costly test of three rows, named before a cheap one of five, and a ≥ b − 1; a is linear from 0 to 10, b = 1.
class OrderOfWork : public testing::Test {
 protected:
  OrderOfWork() : bench_("bordered") {
    bench_.add_test("slow", {0, 1, 2}, {3, 4, 5}).type = "costly_curve";
    bench_.add_test("quick", {0, 1, 2, 3, 4}, {3, 4, 5, 6, 7});
    bench_.run.constraints.emplace_back().type = "admissible_parameters";
    bench_.parameter("b").initial = 5;
    fakes::set_behaviour([this](double /*a*/, std::span<double> values, Status& status) {
      const bool slow = values.size() == 3;
      simulated_ += slow ? "s" : "q";
      if (slow && slow_fails_) status = Status::failed("the simulation broke down");
      if (!slow && quick_fails_) status = Status::failed("so did the quick one");
    });
  }
  /// a = 1 and b = 5 break the constraint, a = 8 does not.
  static std::vector<double> free(double a) { return {a, 5, 0}; }
  Status evaluate(const Assembly& assembly, double a, bool skip) {
    simulated_.clear();
    const auto workspace = assembly.evaluator().make_workspace();
    return assembly.evaluator().evaluate(
        free(a), objective_, per_test_, {}, {}, *workspace,
        skip ? assembly::CostlyTests::where_feasible : assembly::CostlyTests::everywhere);
  }
  Bench bench_;
  std::string simulated_;
  bool slow_fails_ = false, quick_fails_ = false;
  double objective_ = 0;
  std::vector<double> per_test_ = std::vector<double>(2);
};

TEST_F(OrderOfWork, CostlyTestsComeLast) {
  const Assembly assembly = bench_.assemble();
  EXPECT_TRUE(assembly.layout().has_costly_tests);
  EXPECT_TRUE(evaluate(assembly, 8, true).ok());
  EXPECT_EQ(simulated_, "qs");
  EXPECT_EQ(objective_, per_test_[1] + per_test_[0]);
  quick_fails_ = true;
  EXPECT_EQ(evaluate(assembly, 8, true).kind(), Status::Kind::failed);
  EXPECT_EQ(simulated_, "q");
}

TEST_F(OrderOfWork, AnInfeasiblePointIsNotSimulatedInCostlyTests) {
  const Assembly assembly = bench_.assemble();
  EXPECT_EQ(evaluate(assembly, 1, true).kind(), Status::Kind::infeasible);
  EXPECT_EQ(simulated_, "q");
  EXPECT_TRUE(std::isnan(per_test_[0]));
  EXPECT_EQ(objective_, per_test_[1]);
  EXPECT_EQ(evaluate(assembly, 1, false).kind(), Status::Kind::infeasible);
  EXPECT_EQ(simulated_, "qs");
  EXPECT_EQ(objective_, per_test_[1] + per_test_[0]);
}

TEST_F(OrderOfWork, AnInfeasiblePointWhoseSimulationWouldFailIsInfeasible) {
  const Assembly assembly = bench_.assemble();
  slow_fails_ = true;
  EXPECT_EQ(evaluate(assembly, 1, true).kind(), Status::Kind::infeasible);
  EXPECT_EQ(evaluate(assembly, 8, true).kind(), Status::Kind::failed);
  EXPECT_EQ(evaluate(assembly, 1, false).kind(), Status::Kind::failed);
}

TEST_F(OrderOfWork, ResidualsAreThoseOfAllTests) {
  const Assembly assembly = bench_.assemble();
  const auto workspace = assembly.evaluator().make_workspace();
  std::vector<double> residuals(assembly.layout().residual_count);
  simulated_.clear();
  EXPECT_EQ(
      assembly.evaluator()
          .evaluate(free(1), objective_, per_test_, residuals, {}, *workspace, assembly::CostlyTests::where_feasible)
          .kind(),
      Status::Kind::infeasible);
  EXPECT_EQ(simulated_, "qs");
}

TEST_F(OrderOfWork, TheProblemSkipsWhereItIsTold) {
  const Assembly assembly = bench_.assemble();
  for (const bool skip : {true, false}) {
    Recording recording;
    CalibrationProblem::Settings settings;
    settings.record = recording.recorder();
    settings.skip_costly = skip;
    CalibrationProblem problem(assembly, std::move(settings));
    std::vector<double> x(3);
    assembly.box().to_unit(free(1), x);
    simulated_.clear();
    EXPECT_EQ(problem.evaluate(x, objective_).kind(), Status::Kind::infeasible);
    EXPECT_EQ(simulated_, skip ? "q" : "qs");
    EXPECT_EQ(problem.tally().infeasible, 1u);
    EXPECT_EQ(problem.tally().failures, 0u);
    EXPECT_EQ(std::isnan(recording.lines.at(0).per_test[0]), skip);
  }
}

}  // namespace
}  // namespace tunica
