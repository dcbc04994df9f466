// SPDX-License-Identifier: Apache-2.0
// Constraints on the way to an optimiser, on the real strips of examples/lamb_aorta_stable.
#include <cmath>
#include <utility>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/recording.hpp"
#include "mechanisms/shelf.hpp"
#include "search/constrained_step.hpp"
#include "uncertainty/identifiability.hpp"

namespace tunica {
namespace {

using assembly::Assembly;
using search::CalibrationProblem;
using ::testing::HasSubstr;

const experiment::Experiment& lamb() {
  static const experiment::Experiment read = experiment::read_experiment(
      TUNICA_SOURCE_DIR "/examples/lamb_aorta_stable/experiment.json", testing::catalogue());
  return read;
}

/// The run of a model with a constraint h; the strips and its bounds are those of the example.
Assembly assemble(const std::string& model, double h) {
  experiment::RunEntry run = lamb().runs.front();
  run.model = model;
  auto& constraint = run.constraints.emplace_back();
  constraint.type = "transverse_stability", constraint.h = {{1, h}};
  return {lamb(), run, testing::catalogue()};
}

std::vector<double> random_point(boost::random::mt19937_64& engine, std::size_t n) {
  boost::random::uniform_real_distribution<double> unit(0.05, 0.95);
  std::vector<double> x(n);
  for (double& value : x) value = unit(engine);
  return x;
}

TEST(ConstrainedProblem, HasOneConstraintAStretchOfEveryStrip) {
  const Assembly assembly = assemble("gho", 0.7);
  EXPECT_EQ(assembly.models().strips().size(), 2u);
  EXPECT_EQ(assembly.constraints().count(),
            assembly.models().strips()[0].stretches.size() + assembly.models().strips()[1].stretches.size());
}

// Seed 4; differences of a function accurate to 1e-9 with a step of 1e-5 leave 1e-5 of its scale, away from kinks.
TEST(ConstrainedProblem, JacobianInTheUnitBoxAgreesWithDifferences) {
  const Assembly assembly = assemble("gho", 1);
  CalibrationProblem problem(assembly, {});
  const std::size_t n = problem.dimension(), m = problem.constraint_count();
  boost::random::mt19937_64 engine(4);
  std::vector<double> c(m), jacobian(m * n), above(m), below(m);
  std::size_t compared = 0, disagree = 0;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> x = random_point(engine, n);
    if (!problem.constraints(x, c, jacobian).ok()) continue;
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<double> moved = x;
      moved[j] = x[j] + 1e-5;
      ASSERT_TRUE(problem.constraints(moved, above, {}).ok());
      moved[j] = x[j] - 1e-5;
      ASSERT_TRUE(problem.constraints(moved, below, {}).ok());
      for (std::size_t i = 0; i < m; ++i, ++compared)
        disagree +=
            std::abs(jacobian[i * n + j] - (above[i] - below[i]) / 2e-5) > 1e-4 * (1 + std::abs(jacobian[i * n + j]));
    }
  }
  EXPECT_GT(compared, 6000u);
  // A family switches within the five points of the formula at a stretch here and there.
  EXPECT_LT(static_cast<double>(disagree), 0.01 * static_cast<double>(compared));
}

TEST(ConstrainedProblem, SaysOfAnInfeasiblePointHowFarItIs) {
  const Assembly assembly = assemble("hgo", 1);
  fakes::Recording recording;
  CalibrationProblem::Settings settings;
  settings.record = recording.recorder();
  CalibrationProblem problem(assembly, std::move(settings));
  boost::random::mt19937_64 engine(1);
  std::vector<double> c(problem.constraint_count());
  int infeasible = 0, feasible = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<double> x = random_point(engine, problem.dimension());
    double objective = std::nan("");
    const Status status = problem.evaluate(x, objective);
    ASSERT_NE(status.kind(), Status::Kind::failed) << status.reason();
    EXPECT_TRUE(std::isfinite(objective));
    ASSERT_TRUE(problem.constraints(x, c, {}).ok());
    double violation = 0;
    for (const double value : c)
      if (value > Problem::constraint_tolerance) violation += value;
    EXPECT_EQ(status.violation(), violation);
    EXPECT_EQ(status.ok(), violation == 0);
    (status.ok() ? feasible : infeasible)++;
    if (!status.ok()) {
      EXPECT_THAT(status.reason(), HasSubstr("strip at stretch"));
    }
    EXPECT_EQ(problem.best().feasible(), feasible > 0);
  }
  EXPECT_GT(infeasible, 20);
  EXPECT_GT(feasible, 20);
  EXPECT_EQ(problem.tally().infeasible, static_cast<std::uint64_t>(infeasible));
  EXPECT_EQ(problem.tally().failures, 0u);
  // The best is the best of the feasible ones.
  double best = 1e300;
  for (const auto& line : recording.lines)
    if (line.kind == Status::Kind::ok) best = std::min(best, line.objective);
  EXPECT_EQ(problem.best().objective, best);
}

TEST(ConstrainedProblem, KeepsTheLeastViolationWhileNothingIsFeasible) {
  // h = 0 asks for Ψ = 1: no anisotropic material has it.
  const Assembly assembly = assemble("hgo", 0);
  CalibrationProblem problem(assembly, {});
  boost::random::mt19937_64 engine(2);
  double least = 1e300;
  for (int trial = 0; trial < 50; ++trial) {
    double objective;
    const Status status = problem.evaluate(random_point(engine, problem.dimension()), objective);
    ASSERT_EQ(status.kind(), Status::Kind::infeasible);
    least = std::min(least, status.violation());
  }
  EXPECT_TRUE(problem.best().found());
  EXPECT_FALSE(problem.best().feasible());
  EXPECT_EQ(problem.best().violation, least);
}

TEST(ConstrainedProblem, IsTheSameForItsStarts) {
  const Assembly assembly = assemble("gho", 0.7);
  CalibrationProblem problem(assembly, {});
  std::vector<double> expected(problem.constraint_count());
  const std::vector<double> x(problem.dimension(), 0.4);
  ASSERT_TRUE(problem.constraints(x, expected, {}).ok());
  problem.for_each_start(3, [&](std::size_t, Problem& child) {
    std::vector<double> found(child.constraint_count());
    EXPECT_TRUE(child.constraints(x, found, {}).ok());
    EXPECT_EQ(found, expected);
  });
}

// At the optimum that a constraint holds, its normal carries no uncertainty: intervals shrink, and the report says why.
TEST(ConstrainedProblem, IntervalsAreThoseAlongTheActiveConstraint) {
  experiment::Experiment experiment = lamb();
  for (auto& model : experiment.models)
    if (model.name == "hgo") model.parameters["k2"].fixed = 0.001;
  experiment::RunEntry run = experiment.runs.front();
  run.model = "hgo";
  const Assembly unconstrained(experiment, run, testing::catalogue());
  run.constraints.emplace_back().type = "transverse_stability";
  const Assembly imposed(experiment, run, testing::catalogue());
  // The constrained optimum of the example: the constraint is active to 1e-6.
  const std::vector<double> at{15.2854, 14.0034, 47.3033};
  std::vector<double> c(imposed.constraints().count());
  ASSERT_TRUE(imposed.constraints().evaluate(at, c, {}).ok());
  ASSERT_GT(*std::max_element(c.begin(), c.end()), -1e-4);
  uncertainty::Identifiability along, all;
  ASSERT_TRUE(uncertainty::identify(imposed, at, along).ok());
  ASSERT_TRUE(uncertainty::identify(unconstrained, at, all).ok());
  EXPECT_EQ(along.singular_values.size() + 1, all.singular_values.size());
  EXPECT_THAT(along.constrained, HasSubstr("intervals are those along its border"));
  EXPECT_EQ(all.constrained, "");
  EXPECT_LT(along.parameters[0].ci95, 0.5 * all.parameters[0].ci95);
}

/// hgo with everything fixed at the constrained optimum of the example but mu.
Assembly only_mu(bool constrained) {
  experiment::Experiment experiment = lamb();
  for (auto& model : experiment.models)
    if (model.name == "hgo")
      for (const auto& [name, value] : {std::pair{"k1", 14.0034}, {"k2", 0.001}, {"theta", 47.3033}})
        model.parameters[name].fixed = value;
  experiment::RunEntry run = experiment.runs.front();
  run.model = "hgo";
  if (constrained) run.constraints.emplace_back().type = "transverse_stability";
  return {experiment, run, testing::catalogue()};
}

TEST(ConstrainedStep, IsTheShortestToTheOptimumWithinTheInequalities) {
  // min (s₁ − 2)² + (s₂ − 1)² with s₁ + s₂ ≤ 1: (1, 0), where the gradient is −2 (1, 1).
  const Eigen::MatrixXd J = Eigen::MatrixXd::Identity(2, 2);
  const Eigen::VectorXd r = Eigen::Vector2d(-2, -1);
  Eigen::MatrixXd A(2, 2);
  A << 1, 1, 1, 0;
  Eigen::VectorXd c = Eigen::Vector2d(-1, -3);  // the second is not reached
  const auto found = search::constrained_step(J, r, A, c);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->step[0], 1, 1e-5);
  EXPECT_NEAR(found->step[1], 0, 1e-5);
  EXPECT_NEAR(found->largest_multiplier, 2, 1e-4);
  c[0] = -10;
  EXPECT_NEAR(search::constrained_step(J, r, A, c)->step[0], 2, 1e-5);
  A.row(1) = -A.row(0), c << -1, 2;  // s₁ + s₂ ≤ 1 and ≥ 2
  EXPECT_FALSE(search::constrained_step(J, r, A, c));
}

// A profile of every sixth row of these strips ends at 24.45 … 25.27 for mu, where the linearised interval is
// 24.47 … 25.13, and at 7.41 … 7.83 for k1 against 7.54 … 7.76; that of k2 stays open downwards, and along the border
// k2 does not move at all: ± 1.5e-7, were it to be given.
TEST(ConstrainedProblem, DoubtsIntervalsThatEndWhereTheBorderHasBent) {
  experiment::Experiment experiment = lamb();
  for (auto& test : experiment.tests) test.data.rows = {0, 240, 6};
  for (auto& model : experiment.models) model.parameters.clear();
  experiment::RunEntry run = experiment.runs.front();
  run.model = "hgo";
  run.objective = experiment::ObjectiveType::least_squares;
  run.constraints.emplace_back().type = "transverse_stability", run.constraints.back().h = {{1, 0.7}};
  const Assembly assembly(experiment, run, testing::catalogue());
  std::vector<double> at;
  for (const auto& parameter : assembly.layout().parameters)
    at.push_back(parameter.name == "mu"   ? 24.798790262987136
                 : parameter.name == "k1" ? 7.649384602315196
                 : parameter.name == "k2" ? 0.004008767464520589
                                          : 52.32876500441398);
  uncertainty::Identifiability found;
  ASSERT_TRUE(uncertainty::identify(assembly, at, found).ok());
  for (const auto& parameter : found.parameters) {
    EXPECT_EQ(parameter.held, parameter.name == "k2") << parameter.name;
    EXPECT_EQ(parameter.straight, parameter.name != "k1") << parameter.name << ' ' << parameter.ci95;
  }
}

TEST(ConstrainedProblem, GivesNoIntervalsWhereConstraintsLeaveNoDirection) {
  const Assembly assembly = only_mu(true);
  uncertainty::Identifiability found;
  ASSERT_TRUE(uncertainty::identify(assembly, std::vector{15.2854}, found).ok());
  EXPECT_TRUE(found.singular_values.empty());
  EXPECT_TRUE(found.parameters[0].held);
  EXPECT_FALSE(found.parameters[0].identified);
  EXPECT_TRUE(std::isnan(found.parameters[0].ci95));
  EXPECT_THAT(found.sentences(), ::testing::ElementsAre(HasSubstr("Constraints and bounds hold every parameter")));
}

TEST(ConstrainedProblem, LinearisesAnInfeasiblePointAsIfThereWereNoConstraint) {
  const Assembly imposed = only_mu(true), unconstrained = only_mu(false);
  const std::vector<double> at{2};
  std::vector<double> c(imposed.constraints().count());
  ASSERT_TRUE(imposed.constraints().evaluate(at, c, {}).ok());
  ASSERT_GT(*std::max_element(c.begin(), c.end()), 0.1);
  uncertainty::Identifiability broken, all;
  ASSERT_TRUE(uncertainty::identify(imposed, at, broken).ok());
  ASSERT_TRUE(uncertainty::identify(unconstrained, at, all).ok());
  EXPECT_EQ(broken.constrained, "");
  EXPECT_EQ(broken.parameters[0].ci95, all.parameters[0].ci95);
}

TEST(AdmissibleParameters, AreImposedByTheModelsOwnInequalities) {
  experiment::Experiment experiment = lamb();
  auto& model = experiment.models.emplace_back();
  model.name = model.type = "holzapfel_2015";
  model.options.set("fibre_switch", std::string("strain"));
  experiment::RunEntry run = experiment.runs.front();
  run.model = "holzapfel_2015";
  run.constraints.emplace_back().type = "admissible_parameters";
  const Assembly assembly(experiment, run, testing::catalogue());
  ASSERT_EQ(assembly.constraints().count(), 2u);
  CalibrationProblem problem(assembly, {});
  std::vector<double> free{10, 0.3, 0.8, 10, 1, 40}, x(6), c(2), jacobian(12);
  assembly.box().to_unit(free, x);
  double objective;
  const Status status = problem.evaluate(x, objective);
  EXPECT_EQ(status.kind(), Status::Kind::infeasible);
  EXPECT_THAT(status.reason(), HasSubstr("1 - 2A - B = -0.4"));
  ASSERT_TRUE(problem.constraints(x, c, jacobian).ok());
  EXPECT_NEAR(c[0], -1.1, 1e-12);
  EXPECT_NEAR(c[1], 0.4, 1e-12);
  EXPECT_NEAR(jacobian[6 + 1], 2. / 3, 1e-8);  // ∂(2A + B − 1)/∂x_A, A from 0 to 1/3
  EXPECT_NEAR(jacobian[6 + 2], 1, 1e-8);
}

}  // namespace
}  // namespace tunica
