// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/fakes.hpp"

namespace tunica {
namespace {

using assembly::Assembly;
using fakes::Bench;
using testing::HasSubstr;

std::vector<double> jacobian(const Assembly& assembly, const std::vector<double>& free) {
  std::vector<double> predictions(assembly.layout().prediction_count), found(predictions.size() * free.size());
  const auto workspace = assembly.evaluator().make_workspace();
  const Status status = assembly.evaluator().predict(free, predictions, found, *workspace);
  EXPECT_TRUE(status.ok()) << status.reason();
  return found;
}

TEST(Jacobian, GoesThroughSharedAndHeldParameters) {
  Bench bench;
  bench.add_test("t", {1, 2}, {1, 2}).parameters["tilt"].share = "level";
  bench.parameter("a").share = "level";
  bench.parameter("c").fixed = 1;
  const Assembly assembly = bench.assemble();
  // y = level (1 + x) + b x + x²
  EXPECT_THAT(jacobian(assembly, {0.5, 1}), testing::ElementsAre(2, 1, 3, 2));
  EXPECT_TRUE(assembly.layout().jacobian_is_exact);
}

TEST(Jacobian, IsZeroByParametersOfAnotherTest) {
  Bench bench;
  bench.add_test("s", {1, 2}, {1, 2});
  bench.add_test("t", {1, 2}, {1, 2}).mechanisms = {{"offset", {}, {}}};
  bench.parameter("b").fixed = 1;
  bench.parameter("c").fixed = 1;
  EXPECT_THAT(jacobian(bench.assemble(), {1, 0}), testing::ElementsAre(1, 0, 1, 0, 1, 1, 1, 1));
}

class Differences : public testing::TestWithParam<std::vector<double>> {};

TEST_P(Differences, AgreeWithTheFormulaInsideAndAtBounds) {
  Bench bench;
  bench.model().mechanisms = {{"memory", {}, {}}};
  const std::vector<double> x{0, 1, 2, 3};
  bench.add_test("s", x, {1, 2, 3, 4});
  bench.add_test("t", {5, 6}, {1, 2}).mechanisms = {{"offset", {}, {}}};
  const Assembly assembly = bench.assemble();
  ASSERT_FALSE(assembly.layout().jacobian_is_exact);
  const std::vector<double>& at = GetParam();  // a b c g offset
  const std::vector<double> found = jacobian(assembly, at);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double now[] = {1, x[i], x[i] * x[i]};
    double before = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const double earlier = i == 0 ? 0 : std::pow(x[i - 1], static_cast<double>(j));
      before += at[j] * earlier;
      EXPECT_NEAR(found[i * 5 + j], now[j] + at[3] * earlier, 1e-8 * (1 + now[j])) << i << " by " << j;
    }
    EXPECT_NEAR(found[i * 5 + 3], before, 1e-7 * (1 + std::abs(before))) << i;
    EXPECT_EQ(found[i * 5 + 4], 0) << "the offset of another test";
  }
  EXPECT_NEAR(found[4 * 5 + 4], 1, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Points, Differences,
                         testing::Values(std::vector<double>{1, 1, 1, 0.5, 0}, std::vector<double>{0, 0.1, -5, 0, -1},
                                         std::vector<double>{10, 10, 5, 1, 1}));

TEST(Differences, TakeTheOtherSideWhereOneFails) {
  Bench bench;
  bench.model().mechanisms = {{"memory", {}, {}}};
  bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  fakes::set_behaviour([](double a, std::span<double>, Status& status) {
    if (a > 1) status = Status::failed("a is too large");
  });
  const Assembly assembly = bench.assemble();
  EXPECT_NEAR(jacobian(assembly, {1, 1, 0, 0})[0], 1, 1e-8);
}

TEST(Differences, SayWhichParameterCannotBeMoved) {
  Bench bench;
  bench.model().mechanisms = {{"memory", {}, {}}};
  bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  fakes::set_behaviour([](double a, std::span<double>, Status& status) {
    if (a != 1) status = Status::failed("a must be 1");
  });
  const Assembly assembly = bench.assemble();
  std::vector<double> predictions(3), found(12);
  const auto workspace = assembly.evaluator().make_workspace();
  const Status status = assembly.evaluator().predict(std::vector<double>{1, 1, 0, 0}, predictions, found, *workspace);
  EXPECT_EQ(status.kind(), Status::Kind::failed);
  EXPECT_THAT(status.reason(), HasSubstr("no differences by 'a' at 1: test 't': a must be 1"));
}

struct Misbehaviour {
  const char* name;
  fakes::Behaviour behaviour;
  std::vector<std::string> says;
};

class Host : public testing::TestWithParam<Misbehaviour> {};

TEST_P(Host, TurnsWhatAPluginDoesIntoAFailureThatSaysWhere) {
  Bench bench;
  bench.add_test("t", {0, 1.5, 2}, {1, 2, 3}, true);
  const Assembly assembly = bench.assemble();
  fakes::set_behaviour(GetParam().behaviour);
  double objective = 17;
  std::vector<double> per_test(1);
  const auto workspace = assembly.evaluator().make_workspace();
  const Status status =
      assembly.evaluator().evaluate(std::vector<double>{1, 1, 0}, objective, per_test, {}, {}, *workspace);
  EXPECT_EQ(status.kind(), Status::Kind::failed);
  EXPECT_EQ(objective, 17);
  for (const std::string& part : GetParam().says) EXPECT_THAT(status.reason(), HasSubstr(part));
  fakes::set_behaviour({});
  EXPECT_TRUE(
      assembly.evaluator().evaluate(std::vector<double>{1, 1, 0}, objective, per_test, {}, {}, *workspace).ok());
}

const std::vector<Misbehaviour> misbehaviours = {
    {"Failure",
     [](double, std::span<double>, Status& status) { status = Status::failed("exp overflows"); },
     {"test 't': exp overflows"}},
    {"NotANumber",
     [](double, std::span<double> v, Status&) { v[1] = std::nan(""); },
     {"test 't'", "nan", "channel 'y', row 1 (x 1.5)"}},
    {"Infinity",
     [](double, std::span<double> v, Status&) { v[5] = -std::numeric_limits<double>::infinity(); },
     {"-inf", "channel 'z', row 2 (x 2)"}},
    {"Exception",
     [](double, std::span<double>, Status&) { throw std::runtime_error("a bug"); },
     {"test 't'", "plugin 'fakes 1'", "threw: a bug"}},
    {"StrangeException",
     [](double, std::span<double>, Status&) { throw 1; },
     {"plugin 'fakes 1'", "no std::exception"}},
    {"OverflowOfSquares", [](double, std::span<double> v, Status&) { v[0] = 1e200; }, {"the objective overflows"}},
};

INSTANTIATE_TEST_SUITE_P(Plugins, Host, testing::ValuesIn(misbehaviours),
                         [](const auto& misbehaviour) { return misbehaviour.param.name; });

}  // namespace
}  // namespace tunica
