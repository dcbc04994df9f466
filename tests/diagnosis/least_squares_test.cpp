// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/least_squares.hpp"

#include <numeric>

#include <gmock/gmock.h>

#include "calibration/fakes.hpp"
#include "diagnosis/measured.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

std::vector<Variable> each_alone(const assembly::Assembly& assembly) {
  std::vector<Variable> variables;
  for (std::size_t j = 0; j < assembly.layout().parameters.size(); ++j) variables.push_back({j});
  return variables;
}

Fit fit(const assembly::Assembly& assembly, const std::vector<Variable>& variables, const std::vector<double>& start,
        const DataVariant& data = {}) {
  Fit found = least_squares(assembly, variables, start, *assembly.evaluator().make_workspace(), 200, data);
  EXPECT_TRUE(found.status.ok()) << found.status.reason();
  return found;
}

/// y = 2 + 3x + 0.5x² on 12 rows from 0 to 3, and `error`; σ = 0.1.
struct Parabola : fakes::Bench {
  explicit Parabola(const std::function<double(double)>& error = {}) {
    run.objective = experiment::ObjectiveType::least_squares;
    add("t", error);
  }
  experiment::TestEntry& add(const std::string& name, const std::function<double(double)>& error) {
    auto& entry = add_test(
        name, x, fakes::map(x, [&](double at) { return 2 + 3 * at + 0.5 * at * at + (error ? error(at) : 0); }));
    entry.data.noise = {{"y", {0.1, 0, 0}}};
    return entry;
  }
  std::vector<double> x = fakes::grid(0, 3, 12);
};

/// The optimum of exact curves of two strips (mu = 18.668 kPa, k1 = 24.905 kPa, k2 = 0.2912), from here.
Fit of_exact_strips(const std::vector<double>& start) {
  trial::Measured exact({{.sd = 1e-9}, {.name = "axial", .sd = 1e-9}});
  exact.measure(1);
  auto experiment = exact.read();
  for (auto& test : experiment.tests) test.data.noise = {{"stress", {0.3, 0, 0}}};
  const assembly::Assembly assembly(experiment, experiment.runs.front(), testing::catalogue());
  return fit(assembly, each_alone(assembly), start);
}

TEST(LeastSquares, RecoversTheParametersThatMadeExactCurves) {
  const Fit found = of_exact_strips({15, 30, 0.4});
  EXPECT_NEAR(found.free[0], 18.668, 0.005);
  EXPECT_NEAR(found.free[1], 24.905, 0.005);
  EXPECT_NEAR(found.free[2], 0.2912, 0.0005);
  EXPECT_LT(found.chi2, 1e-4);
  EXPECT_THAT(found.at_bound, Each(false));
}

/// The best a would be −2, its bound is 0: the fit from here, and that of the others with a held there.
std::pair<Fit, Fit> beyond_a_bound(const std::vector<double>& start) {
  Parabola bench([](double) { return -4.0; });
  const auto assembly = bench.assemble();
  Fit found = fit(assembly, each_alone(assembly), start);
  bench.parameter("a").fixed = 0;
  const auto held = bench.assemble();
  return {std::move(found), fit(held, each_alone(held), {1, 0})};
}

TEST(LeastSquares, StaysWithinBoundsAndSaysWhichItEndsAt) {
  const auto [found, others] = beyond_a_bound({0, 1, 0});
  EXPECT_EQ(found.free[0], 0);
  EXPECT_THAT(found.at_bound, ElementsAre(true, false, false));
  EXPECT_NEAR(found.chi2, others.chi2, 1e-5);
  EXPECT_NEAR(found.free[1], others.free[0], 1e-4);
}

// A step that is cut off at a bound may promise nothing, and the fit ends there: 1539 instead of 732.
TEST(LeastSquares, GoesOnWhereAStepIsCutOffAtABound) {
  const auto [found, others] = beyond_a_bound({5, 1, 0});
  EXPECT_NEAR(found.chi2, others.chi2, 1e-5);
  EXPECT_LT(of_exact_strips({10, 40, 0.5}).chi2, 1e-4);  // 13.9, with k2 at its lower bound
}

TEST(LeastSquares, LeavesWhatIsNoVariableWhereItWas) {
  Parabola bench;
  const auto assembly = bench.assemble();
  const Fit found = fit(assembly, {{0}, {2}}, {1, 2.5, 0});
  EXPECT_EQ(found.free[1], 2.5);
  EXPECT_EQ(found.jacobian.cols(), 2);
  EXPECT_GT(found.chi2, 1);
}

TEST(LeastSquares, ReachesTheSameOptimumWithSecantsAsWithExactJacobians) {
  const auto ripple = [](double x) { return 0.3 * std::sin(3 * x); };
  Parabola plain(ripple), differenced(ripple);
  differenced.model().mechanisms = {{"memory", {}, {}}};
  differenced.model().mechanisms[0].parameters["g"].fixed = 0;
  const auto exact = plain.assemble(), secant = differenced.assemble();
  ASSERT_TRUE(exact.layout().jacobian_is_exact);
  ASSERT_FALSE(secant.layout().jacobian_is_exact);
  const Fit one = fit(exact, each_alone(exact), {9, 0.2, -3}), other = fit(secant, each_alone(secant), {9, 0.2, -3});
  EXPECT_NEAR(other.chi2, one.chi2, 1e-4);
  for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(other.free[j], one.free[j], 1e-3);
}

TEST(LeastSquares, FindsWhatAModelWithHistoryRemembers) {
  Parabola bench;
  bench.model().mechanisms = {{"memory", {}, {}}};
  auto assembly = bench.assemble();
  std::vector<double> seen(assembly.layout().prediction_count);
  ASSERT_TRUE(assembly.evaluator()
                  .predict(std::vector<double>{1, 2, 0.7, 0.4}, seen, {}, *assembly.evaluator().make_workspace())
                  .ok());
  const auto workspace = assembly.evaluator().make_workspace();
  assembly.evaluator().measure(seen, *workspace);
  const Fit found = least_squares(assembly, each_alone(assembly), std::vector<double>{2, 1, 0, 0.1}, *workspace, 200);
  EXPECT_LT(found.chi2, 1e-3);
  EXPECT_NEAR(found.free[3], 0.4, 0.02);
}

TEST(LeastSquares, TiesVariablesAsASharedParameterDoes) {
  const auto offset = [](double shift) { return [shift](double x) { return shift + 0.1 * std::cos(5 * x); }; };
  Parabola bench(offset(0.2));
  bench.add("u", offset(0.6));
  bench.parameter("a").fixed = 2;
  for (auto& test : bench.experiment.tests) test.mechanisms = {{"offset", {}, {}}};
  const auto assembly = bench.assemble();  // b, c, t.offset.value, u.offset.value
  const Fit tied = fit(assembly, {{0}, {1}, {2, 3}}, {1, 0, 0, 0});
  EXPECT_EQ(tied.free[2], tied.free[3]);
  for (auto& test : bench.experiment.tests) test.mechanisms[0].parameters["value"].share = "zero";
  const auto sharing = bench.assemble();
  const Fit shared = fit(sharing, each_alone(sharing), {1, 0, 0});
  EXPECT_NEAR(tied.free[2], shared.free[2], 1e-5);
  EXPECT_NEAR(tied.chi2, shared.chi2, 1e-5);
  EXPECT_LT((tied.jacobian - shared.jacobian).norm(), 1e-6 * shared.jacobian.norm());
}

TEST(LeastSquares, FitsAddedNoiseAsDataThatHaveIt) {
  Parabola bench;
  const auto assembly = bench.assemble();
  Eigen::VectorXd added(12);
  for (Eigen::Index i = 0; i < 12; ++i) added[i] = std::sin(static_cast<double>(7 * i));
  const Fit found = fit(assembly, each_alone(assembly), {1, 1, 0}, {&added, nullptr});
  // r = (prediction − y)/σ + n: as if y − σ n had been measured.
  Parabola other([&](double x) { return -0.1 * added[std::lround(11 * x / 3)]; });
  const auto noisy = other.assemble();
  const Fit expected = fit(noisy, each_alone(noisy), {1, 1, 0});
  EXPECT_NEAR(found.chi2, expected.chi2, 1e-5);
  EXPECT_GT(found.chi2, 1);
  for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(found.free[j], expected.free[j], 1e-4);
}

TEST(LeastSquares, LeavesOutRowsThatDoNotCount) {
  Parabola bench([](double x) { return x > 2 ? 7.0 : 0; });  // rows 8 … 11
  const auto assembly = bench.assemble();
  std::vector<bool> counted(12, true);
  for (std::size_t i = 8; i < 12; ++i) counted[i] = false;
  const Fit found = fit(assembly, each_alone(assembly), {1, 1, 0}, {nullptr, &counted});
  EXPECT_LT(found.chi2, 1e-4);
  EXPECT_NEAR(found.free[0], 2, 0.01);
  EXPECT_EQ(found.residuals.tail(4).norm(), 0);
  EXPECT_GT(fit(assembly, each_alone(assembly), {1, 1, 0}).chi2, 100);
}

TEST(LeastSquares, LeavesOutTheFirstRowToo) {
  Parabola bench([](double x) { return x == 0 ? 7.0 : 0; });
  const auto assembly = bench.assemble();
  std::vector<bool> counted(12, true);
  counted[0] = false;
  const Fit found = fit(assembly, each_alone(assembly), {1, 1, 0}, {nullptr, &counted});
  EXPECT_LT(found.chi2, 1e-4);
  EXPECT_EQ(found.residuals[0], 0);
  EXPECT_EQ(found.jacobian.row(0).norm(), 0);
  EXPECT_GT(found.jacobian.row(1).norm(), 1);
}

TEST(LeastSquares, TellsWhyNothingCouldBeEvaluated) {
  Parabola bench;
  const auto assembly = bench.assemble();
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("a torn strip"); });
  const Fit found = least_squares(assembly, each_alone(assembly), std::vector<double>{1, 1, 0},
                                  *assembly.evaluator().make_workspace());
  EXPECT_FALSE(found.status.ok());
  EXPECT_THAT(found.status.reason(), ::testing::HasSubstr("a torn strip"));
}

}  // namespace
}  // namespace tunica::diagnosis
