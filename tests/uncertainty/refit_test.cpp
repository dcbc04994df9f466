// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/refit.hpp"

#include <gmock/gmock.h>

#include "uncertainty/local.hpp"

using namespace tunica;
using ::testing::HasSubstr;
using uncertainty::RefitObjective;

namespace {

RefitObjective objective_of(const assembly::Assembly& assembly) {
  RefitObjective target;
  target.blocks = assembly.layout().blocks;
  target.residual_count = assembly.layout().residual_count;
  target.evaluate = [&assembly](std::span<const double> free, double& objective, std::span<double> residuals,
                                std::span<double> jacobian, assembly::Workspace& workspace) {
    return assembly.evaluator().evaluate(free, objective, {}, residuals, jacobian, workspace);
  };
  return target;
}

}  // namespace

TEST(Refit, FindsTheOptimumOfDataThatStandInForTheMeasuredOnes) {
  const trial::Line line;
  const auto assembly = line.assemble();
  const auto workspace = assembly.evaluator().make_workspace();
  assembly.evaluator().measure(fakes::map(line.x, [](double at) { return 3 + 0.5 * at; }), *workspace);
  const auto found =
      uncertainty::refit(assembly, objective_of(assembly), trial::local(), std::vector{1.0, 2.0}, {}, 1, *workspace);
  ASSERT_TRUE(found.status.ok()) << found.status.reason();
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.free[0], 3, 1e-8);
  EXPECT_NEAR(found.free[1], 0.5, 1e-8);
  assembly.evaluator().measure({}, *workspace);
  const auto back = uncertainty::refit(assembly, objective_of(assembly), trial::local(), found.free, {}, 1, *workspace);
  EXPECT_NEAR(back.free[0], 1, 1e-8);
}

TEST(Refit, KeepsAHeldParameterToTheLastBitAndFitsTheOthers) {
  const trial::Line line;
  const auto assembly = line.assemble();
  const auto workspace = assembly.evaluator().make_workspace();
  const double held = 1.0 / 3;
  const auto found =
      uncertainty::refit(assembly, objective_of(assembly), trial::local(), std::vector{held, 2.0}, 0, 1, *workspace);
  EXPECT_EQ(found.free[0], held);
  double xy = 0, xx = 0;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    xy += line.x[i] * (line.y[i] - held);
    xx += line.x[i] * line.x[i];
  }
  EXPECT_NEAR(found.free[1], xy / xx, 1e-8);
}

TEST(Refit, WithNothingLeftToMoveIsOneEvaluation) {
  trial::Line line;
  line.parameter("b").fixed = 2;
  const auto assembly = line.assemble();
  const auto workspace = assembly.evaluator().make_workspace();
  const auto found =
      uncertainty::refit(assembly, objective_of(assembly), trial::local(), std::vector{1.0}, 0, 1, *workspace);
  EXPECT_EQ(found.evaluations, 1u);
  EXPECT_TRUE(found.status.ok());
}

TEST(Refit, FailsWhereNothingCanBeEvaluated) {
  const trial::Line line;
  const auto assembly = line.assemble();
  const auto workspace = assembly.evaluator().make_workspace();
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("no"); });
  const auto found =
      uncertainty::refit(assembly, objective_of(assembly), trial::local(), std::vector{1.0, 2.0}, {}, 1, *workspace);
  fakes::set_behaviour({});
  EXPECT_EQ(found.status.reason(), "no point near the optimum could be evaluated");
}
