// SPDX-License-Identifier: Apache-2.0
// Runs of several models: names, chain rule, constraints, where layers of a test name models of their own.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "assembly/assembly.hpp"
#include "calibration/fakes.hpp"

namespace tunica::layers_test {
namespace {

using assembly::Assembly;
using fakes::Bench;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> names(const Assembly& assembly) {
  std::vector<std::string> found;
  for (const auto& parameter : assembly.layout().parameters) found.push_back(parameter.name);
  return found;
}

/// Models m (parabola) and v (valley: S = (2p + q) x + r x²); a curve of m, and a stack of v, m, v.
class Layered : public testing::Test {
 protected:
  Layered() {
    bench.experiment.models.push_back({"v", "valley", {}, {}, {}});
    bench.add_test("plain", {0.5, 1, 2}, {1, 2, 3});
    auto& stack = bench.add_test("stack", {1, 2}, {1, 2});
    stack.type = "stack", stack.layers = {{"v", 1}, {"m", 3}, {"v", 0.5}};
    bench.run.tests = {"plain", "stack"};
  }
  experiment::TestEntry& stack() { return bench.experiment.tests[1]; }

  Bench bench;
};

TEST_F(Layered, ParametersBeginWithTheNamesOfTheirModels) {
  bench.model().mechanisms = {{"cubic", {}, {}}};
  EXPECT_THAT(names(bench.assemble()), ElementsAre("m.a", "m.b", "m.c", "m.cubic.beta", "v.p", "v.q", "v.r"));
  bench.run.tests = {"plain"};
  EXPECT_THAT(names(bench.assemble()), ElementsAre("a", "b", "c", "cubic.beta"));
}

TEST_F(Layered, ARunNeedsNoModelOfItsOwnWhereEveryTestNamesSome) {
  bench.run.tests = {"stack"};
  bench.run.model = "";
  EXPECT_THAT(names(bench.assemble()), ElementsAre("v.p", "v.q", "v.r", "m.a", "m.b", "m.c"));
  EXPECT_EQ(bench.experiment.model_name(bench.run), "v+m");
  stack().layers = {{"v", 1}, {"v", 2}};
  EXPECT_THAT(names(bench.assemble()), ElementsAre("p", "q", "r"));
  EXPECT_EQ(bench.experiment.model_name(bench.run), "v");
}

TEST_F(Layered, EveryTestSeesItsModelsInItsOrder) {
  const Assembly assembly = bench.assemble();
  std::vector<double> values(assembly.layout().prediction_count);
  const auto workspace = assembly.evaluator().make_workspace();
  ASSERT_TRUE(assembly.evaluator().predict(std::vector<double>{1, 2, 3, 0.5, 0.25, 0.1}, values, {}, *workspace).ok());
  // m: 1 + 2x + 3x²; v: 1.25 x + 0.1 x², of thickness 1.5 together; m of thickness 3 between.
  EXPECT_THAT(values, testing::Pointwise(testing::DoubleNear(1e-12),
                                         {2.75, 6.0, 17.0, 1.5 * 1.35 + 3 * 6.0, 1.5 * 2.9 + 3 * 17.0}));
}

TEST_F(Layered, AFailureNamesTheLayerAndItsModel) {
  bench.run.tests = {"stack"};
  const double nothing = std::nan("");
  const Assembly stacked = bench.assemble();  // m.a, m.b, m.c, v.p, v.q, v.r
  std::vector<double> values(stacked.layout().prediction_count);
  const auto room = stacked.evaluator().make_workspace();
  const Status of_m = stacked.evaluator().predict(std::vector<double>{nothing, 1, 1, 1, 1, 1}, values, {}, *room);
  EXPECT_THAT(of_m.reason(), HasSubstr("(layer 2, model 'm')"));
  const Status of_v = stacked.evaluator().predict(std::vector<double>{1, 1, 1, 1, nothing, 1}, values, {}, *room);
  EXPECT_THAT(of_v.reason(), HasSubstr("(layer 1, model 'v')"));
}

TEST_F(Layered, TheJacobianAddsUpWhatLayersOfOneModelGive) {
  stack().parameters.clear();  // the gain is searched for too
  const Assembly assembly = bench.assemble();
  ASSERT_TRUE(assembly.layout().jacobian_is_exact);
  EXPECT_EQ(names(assembly).back(), "stack.gain");
  const std::vector<double> at{1, 2, 3, 0.5, 0.25, 0.1, 1.5};
  std::vector<double> values(5), jacobian(5 * 7);
  const auto workspace = assembly.evaluator().make_workspace();
  ASSERT_TRUE(assembly.evaluator().predict(at, values, jacobian, *workspace).ok());
  for (std::size_t j = 0; j < 7; ++j) {
    std::vector<double> up = at, down = at, above(5), below(5);
    up[j] += 1e-5;
    down[j] -= 1e-5;
    ASSERT_TRUE(assembly.evaluator().predict(up, above, {}, *workspace).ok() &&
                assembly.evaluator().predict(down, below, {}, *workspace).ok());
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_NEAR(jacobian[i * 7 + j], (above[i] - below[i]) / 2e-5, 1e-6 * (1 + std::abs(jacobian[i * 7 + j])));
  }
}

TEST_F(Layered, AModelWithoutDerivativesHasTestsWithoutThem) {
  bench.experiment.models[1].mechanisms = {{"memory", {}, {}}};
  const Assembly assembly = bench.assemble();
  EXPECT_FALSE(assembly.layout().jacobian_is_exact);
  const std::vector<double> at{1, 2, 3, 0.5, 0.25, 0.1, 0.1};
  std::vector<double> values(5), jacobian(5 * 7), up = at, above(5);
  const auto workspace = assembly.evaluator().make_workspace();
  ASSERT_TRUE(assembly.evaluator().predict(at, values, jacobian, *workspace).ok());
  up[6] += 1e-4;
  ASSERT_TRUE(assembly.evaluator().predict(up, above, {}, *workspace).ok());
  EXPECT_EQ(jacobian[0 * 7 + 6], 0) << "the curve has no layer of it";
  EXPECT_NEAR(jacobian[4 * 7 + 6], (above[4] - values[4]) / 1e-4, 1e-5);
}

TEST_F(Layered, ModelsMayShareParameters) {
  bench.parameter("a").share = "stiffness";
  bench.experiment.models[1].parameters["r"].share = "stiffness";
  const Assembly assembly = bench.assemble();
  EXPECT_THAT(names(assembly), ElementsAre("stiffness", "m.b", "m.c", "v.p", "v.q"));
  std::vector<double> values(5), jacobian(5 * 5);
  const auto workspace = assembly.evaluator().make_workspace();
  ASSERT_TRUE(assembly.evaluator().predict(std::vector<double>{2, 1, 1, 1, 1}, values, jacobian, *workspace).ok());
  EXPECT_DOUBLE_EQ(jacobian[3 * 5 + 0], 3 + 1.5) << "of a in m, and of r x² in v";
}

TEST_F(Layered, CombinationsSayWhoseTheyAre) {
  const Assembly assembly = bench.assemble();
  ASSERT_EQ(assembly.layout().combinations.size(), 1u);
  EXPECT_EQ(assembly.layout().combinations[0].name, "v (2p + q)");
  EXPECT_THAT(assembly.layout().combinations[0].arguments, ElementsAre(3, 4));
  EXPECT_DOUBLE_EQ(assembly.layout().combinations[0].value(std::vector<double>{9, 9, 9, 1, 5, 9}), 7);
}

TEST_F(Layered, ConstraintsAreAskedOfTheModelsThatDeclareThem) {
  bench.model().type = "bordered";  // a − b ≥ −1
  experiment::ConstraintEntry constraint;
  constraint.type = "admissible_parameters";
  constraint.pointer = "/constraints/0";
  bench.run.constraints = {constraint};
  const Assembly assembly = bench.assemble();
  ASSERT_EQ(assembly.constraints().count(), 1u);
  const std::vector<double> broken{1, 4, 0, 1, 1, 1};
  std::vector<double> value(1), jacobian(6);
  ASSERT_TRUE(assembly.constraints().evaluate(broken, value, jacobian).ok());
  EXPECT_NEAR(value[0], 2, 1e-12);
  EXPECT_THAT(jacobian, testing::Pointwise(testing::DoubleNear(1e-6), {-1., 1., 0., 0., 0., 0.}));
  const auto workspace = assembly.evaluator().make_workspace();
  const Status status = assembly.constraints().feasibility(broken, *workspace);
  EXPECT_EQ(status.kind(), Status::Kind::infeasible);
  EXPECT_THAT(status.reason(), HasSubstr("model 'm': admissible parameters:"));
  EXPECT_THAT(assembly.constraints().words(0, 2), HasSubstr("model 'm': admissible parameters:"));
  bench.model().type = "parabola";
  EXPECT_THAT(fakes::message_of([&] { static_cast<void>(bench.assemble()); }),
              HasSubstr("/constraints/0: the models of the run declare no inequality between their parameters"));
}

TEST_F(Layered, AModelAndATestWithOneNameAreRefused) {
  bench.experiment.models[1].name = "stack";
  stack().layers = {{"stack", 1}, {"m", 1}};
  EXPECT_THAT(
      fakes::message_of([&] { static_cast<void>(bench.assemble()); }),
      HasSubstr("a model and a test are both called 'stack'; in a run with several models 'stack.…' would name"));
}

TEST_F(Layered, AParameterThatLayersExcludeIsRefused) {
  stack().parameters["bend"].fixed = 0.5;
  stack().parameters["bend"].pointer = "/tests/stack/parameters/bend";
  EXPECT_THAT(
      fakes::message_of([&] { static_cast<void>(bench.assemble()); }),
      HasSubstr("/tests/stack/parameters/bend: the parameter 'bend' means nothing in test 'stack' with \"layers\"; "
                "leave one of them out"));
  stack().layers.clear();
  EXPECT_NO_THROW(static_cast<void>(bench.assemble()));
}

}  // namespace
}  // namespace tunica::layers_test
