// SPDX-License-Identifier: Apache-2.0
// The range of every invariant that the data reach.
#include "discovery/reach.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include "assembly/assembly.hpp"
#include "calibration/fakes.hpp"
#include "discover/rubber.hpp"

namespace tunica::discovery::reach_test {

using ::testing::ElementsAre;

using Tensor = std::array<double, 6>;  ///< tt, zz, rr, tz, zr, tr

constexpr Tensor sheared{2, 3, 5, 0.7, 0.11, 0.13}, pressed{0.5, 0.7, 0.9, -0.17, 0.19, -0.23};

Eigen::Matrix3d full(const Tensor& C) {
  Eigen::Matrix3d all;
  all << C[0], C[3], C[5], C[3], C[1], C[4], C[5], C[4], C[2];
  return all;
}

Tensor tensor_of(const Eigen::Matrix3d& C) { return {C(0, 0), C(1, 1), C(2, 2), C(0, 1), C(1, 2), C(0, 2)}; }

/// What a test asks a model about, in turn.
struct Question {
  std::vector<Tensor> points;
  bool derivatives = false, axes = false;
};

/// A test that asks what it is told to ask, and shows y = 1 + a.
class Asking final : public Test {
 public:
  Asking(const TestSetup& setup, std::vector<Question> questions) : questions_(std::move(questions)) {
    rows_.count = setup.rows.count;
    rows_.channels = setup.rows.channels;
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    for (const Question& question : questions_) {
      const std::size_t n = question.points.size(), width = question.axes ? 3 : 6;
      std::vector<double> C(width * n), stress(width * n), by(width * n * input.model_parameters.size());
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t c = 0; c < width; ++c) C[c * n + i] = question.points[i][c];
      if (!question.derivatives) by.clear();
      if (question.axes)
        static_cast<void>(input.model.evaluate_axes({n, C, input.model_parameters}, {{}, stress, {}, by}));
      else
        static_cast<void>(input.model.evaluate({n, C, input.model_parameters, {}, {}}, {{}, stress, {}, by, {}}));
    }
    for (double& value : output.values) value = 1 + input.model_parameters[0];
    for (double& value : output.jacobian) value = 1;
    return {};
  }

 private:
  std::vector<Question> questions_;
  TestDescription description_;
  TestRows rows_;
};

/// The states of a model in a test that asks these questions.
States states_of(const std::vector<Question>& questions) {
  fakes::Bench bench;
  TestFactory factory = bench.shelf.tests().at("curve").factory;
  factory.type = "asking";
  factory.create = [&](const TestSetup& setup) { return std::make_unique<Asking>(setup, questions); };
  plugins::Catalogue::Registration stage;
  stage.add(std::move(factory));
  bench.shelf.commit(std::move(stage), "asking 1");
  auto& entry = bench.add_test("t", {0, 1, 2, 3}, {1, 2, 3, 4});
  entry.type = "asking";
  entry.parameters.clear();
  bench.experiment.models.push_back({"other", "valley", {}, {}, {}});
  return reached_states({bench.experiment, bench.run, "m", false, bench.shelf}, std::vector<double>{1, 1, 0});
}

TEST(ReachedStates, AreThoseAtWhichDerivativesAreAskedFor) {
  EXPECT_THAT(states_of({{{sheared, pressed, sheared}, false}, {{pressed, sheared}, true}}),
              ElementsAre(pressed, sheared))
      << "the others are steps of a solver";
  EXPECT_THAT(states_of({{{sheared, pressed}, false}}), ElementsAre(sheared, pressed)) << "where none are asked for";
}

TEST(ReachedStates, InPrincipalAxesHaveNoShear) {
  const Tensor first{2, 3, 5, 0, 0, 0}, second{0.7, 1.1, 1.3, 0, 0, 0};
  EXPECT_THAT(states_of({{{sheared}, false, true}, {{first, second}, true, true}}), ElementsAre(first, second));
}

TEST(ReachedStates, LeaveOutWhatIsNotFinite) {
  Tensor broken = sheared;
  broken[3] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(states_of({{{broken, pressed}, true}}), ElementsAre(pressed));
}

TEST(ReachOfAnInvariant, BeginsAtRest) {
  EXPECT_EQ(reach_of_first({}).low, 0);
  EXPECT_EQ(reach_of_first({}).high, 0);
  const Reach large = reach_of_first({sheared}), small = reach_of_first({pressed}),
              both = reach_of_first({sheared, pressed});
  EXPECT_EQ(large.low, 0);
  EXPECT_NEAR(large.high, 2 + 3 + 5 - 3, 1e-12);
  EXPECT_NEAR(small.low, 0.5 + 0.7 + 0.9 - 3, 1e-12);
  EXPECT_EQ(small.high, 0);
  EXPECT_EQ(both.low, small.low);
  EXPECT_EQ(both.high, large.high);
}

TEST(ReachOfAnInvariant, OfTheSecondTakesShearIn) {
  const auto second = [](const Tensor& C) {
    const double trace = full(C).trace();
    return (trace * trace - (full(C) * full(C)).trace()) / 2 - 3;
  };
  EXPECT_NEAR(reach_of_second({sheared}).high, second(sheared), 1e-12);
  EXPECT_NEAR(reach_of_second({pressed}).low, second(pressed), 1e-12);
}

TEST(ReachOfAnInvariant, OfAFibreIsItsSquaredStretch) {
  for (const double degrees : {0.0, 30.0, 77.0, 90.0, 150.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Eigen::Vector3d fibre(std::sin(angle), std::cos(angle), 0);  // the angle is that with the axis
    for (const Tensor& C : {sheared, pressed}) {
      const double expected = fibre.dot(full(C) * fibre) - 1;
      const Reach found = reach_of_fibre({C}, degrees);
      EXPECT_NEAR(expected > 0 ? found.high : found.low, expected, 1e-12) << degrees;
      EXPECT_EQ(expected > 0 ? found.low : found.high, 0) << degrees;
    }
  }
}

TEST(ReachOfStretches, IsThatOfPrincipalOnesInAnyDirection) {
  const Eigen::Vector3d stretches(0.8, 1.1, 1.7);
  for (const auto& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(1, 2, -3)}) {
    const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.6, axis.normalized()).toRotationMatrix();
    const Eigen::Matrix3d C = turned * stretches.cwiseAbs2().asDiagonal() * turned.transpose();
    const Reach found = reach_of_stretches({tensor_of(C)});
    EXPECT_NEAR(found.low, std::log(0.8), 1e-12);
    EXPECT_NEAR(found.high, std::log(1.7), 1e-12);
  }
}

TEST(ReachOfStretches, LeavesOutWhatNoMaterialReaches) {
  const Reach found = reach_of_stretches({{-1, 4, 0.25, 0, 0, 0}, {0, 1, 1, 0, 0, 0}});
  EXPECT_NEAR(found.low, -std::log(2), 1e-12);
  EXPECT_NEAR(found.high, std::log(2), 1e-12);
}

TEST(DiscoveryReach, IsThatOfTheStretchesThatWereMeasured) {
  const trial::Rubber rubber;
  rubber.measure(1);
  const auto read = rubber.read();
  const assembly::Assembly assembly(read, read.runs.front(), testing::catalogue());
  std::vector<double> free(assembly.layout().parameters.size());
  assembly.box().from_unit(assembly.box().initial(), free);
  const Subject subject{read, read.runs.front(), "rubber", false, testing::catalogue()};
  const auto states = reached_states(subject, free);
  ASSERT_FALSE(states.empty());
  // Equibiaxial to λ = 2.2: I1 = 2λ² + λ⁻⁴, I2 = λ⁴ + 2λ⁻². Uniaxial to 3: I1 = λ² + 2/λ.
  const double l = 2.2, biaxial = 2 * l * l + std::pow(l, -4), uniaxial = 9 + 2. / 3;
  EXPECT_NEAR(reach_of_first(states).high, std::max(biaxial, uniaxial) - 3, 1e-9);
  EXPECT_NEAR(reach_of_second(states).high, std::pow(l, 4) + 2 / (l * l) - 3, 1e-9);
  EXPECT_NEAR(reach_of_fibre(states, 90).high, 9 - 1, 1e-9);
  EXPECT_NEAR(reach_of_fibre(states, 0).high, l * l - 1, 1e-9);
  EXPECT_NEAR(reach_of_stretches(states).high, std::log(3), 1e-9);
  EXPECT_NEAR(reach_of_stretches(states).low, -2 * std::log(l), 1e-9);
}

}  // namespace tunica::discovery::reach_test
