// SPDX-License-Identifier: Apache-2.0
// The derivatives of a strip with a set by its own stretch, row by row, and what a base that fails does.
#include <cmath>

#include <gtest/gtest.h>

#include "subject.hpp"

namespace tunica::testing::permanent_set_slopes_test {
namespace {

using Values = std::vector<double>;

constexpr double s = 0.2;
/// Loading, unloading to slack, below the first length, and again beyond the first turn.
const Values loop{1.05, 1.2, 1.5, 1.3, 1.02, 0.97, 1.15, 1.4, 1.6, 1.3};

class PermanentSetSlopes : public ::testing::TestWithParam<const char*> {
 protected:
  [[nodiscard]] std::unique_ptr<tunica::Test> strip(const Values& stretches) const {
    return wrapped_test("permanent_set",
                        make_strip(stretches, {.channels = {"stress", "transverse_stretch"}, .measure = GetParam()}));
  }
  [[nodiscard]] Values values_at(const Values& stretches, double set) const {
    Values values(2 * stretches.size());
    const Status status = strip(stretches)->predict({*material, set_s, Values{0, set}}, {values, {}, {}, {}});
    EXPECT_TRUE(status.ok()) << status.reason();
    return values;
  }

  const std::unique_ptr<Model> material = make_model("gho");
};

/// ∂y_i/∂m_i by central differences: of row i only the stretch of row i moves, and with it what follows from it.
TEST_P(PermanentSetSlopes, ByItsOwnStretchAreThoseOfThePrediction) {
  for (const double set : {0.0, s}) {
    Values slopes(2 * loop.size()), values(2 * loop.size());
    ASSERT_TRUE(strip(loop)->predict({*material, set_s, Values{0, set}}, {values, {}, slopes, {}}).ok());
    for (std::size_t row = 0; row < loop.size(); ++row) {
      constexpr double h = 1e-6;
      Values up = loop, down = loop;
      up[row] += h;
      down[row] -= h;
      const Values above = values_at(up, set), below = values_at(down, set);
      for (const std::size_t entry : {row, loop.size() + row}) {
        const double difference = (above[entry] - below[entry]) / (2 * h);
        EXPECT_NEAR(slopes[entry], difference, 1e-5 * (1 + std::abs(difference))) << "set " << set << ", " << entry;
      }
    }
  }
}

/// Where a strip begins at its first length there is no set yet: its slope there is that of a strip that is pushed.
TEST_P(PermanentSetSlopes, AtTheFirstLengthAreThoseOfAPush) {
  const auto smooth = make_model("neo_hooke");  // fibres would begin there
  const auto answer = [&](const Values& stretches, double set) {
    Values values(2 * stretches.size()), slopes(values.size());
    const Status status = strip(stretches)->predict({*smooth, Values{30}, Values{0, set}}, {values, {}, slopes, {}});
    EXPECT_TRUE(status.ok()) << status.reason();
    return std::pair{values, slopes};
  };
  for (const double set : {0.0, s}) {
    constexpr double h = 1e-6;
    const auto [values, slopes] = answer({1, 1.2, 1.1}, set);
    const auto [below, unused] = answer({1 - h, 1.2, 1.1}, set);
    for (const std::size_t entry : {0, 3}) {
      const double difference = (values[entry] - below[entry]) / h;
      EXPECT_GT(std::abs(difference), 0.1);
      EXPECT_NEAR(slopes[entry], difference, 1e-4 * std::abs(difference)) << "set " << set << ", " << entry;
    }
  }
}

TEST_P(PermanentSetSlopes, DoNotDependOnWhatElseIsWanted) {
  const std::size_t size = 2 * loop.size(), columns = set_s.size() + 2;
  for (const double set : {0.0, s}) {
    Values values(size), jacobian(columns * size), slopes(size), jacobian_alone(columns * size), slopes_alone(size);
    const Values own{0, set};
    ASSERT_TRUE(strip(loop)->predict({*material, set_s, own}, {values, jacobian, slopes, {}}).ok());
    ASSERT_TRUE(strip(loop)->predict({*material, set_s, own}, {{}, jacobian_alone, {}, {}}).ok());
    Values of_slopes(size);
    ASSERT_TRUE(strip(loop)->predict({*material, set_s, own}, {of_slopes, {}, slopes_alone, {}}).ok());
    // Another set of outputs may take another kernel, which rounds differently.
    for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(of_slopes[i], values[i], 1e-12 * (1 + std::abs(values[i]))) << i;
    for (std::size_t i = 0; i < slopes.size(); ++i)
      EXPECT_NEAR(slopes[i], slopes_alone[i], 1e-9 * (1 + std::abs(slopes[i]))) << i;
    for (std::size_t i = 0; i < jacobian.size(); ++i)
      EXPECT_NEAR(jacobian[i], jacobian_alone[i], 1e-9 * (1 + std::abs(jacobian[i]))) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Measures, PermanentSetSlopes,
                         ::testing::Values("cauchy", "first_piola_kirchhoff", "second_piola_kirchhoff"),
                         [](const auto& at) { return std::string(at.param); });

/// Of a model with memory the column of the set is a difference of whole predictions, and made only where it is wanted.
TEST(PermanentSetOfAMaterialWithMemory, IsTheSameWithAndWithoutDerivatives) {
  const auto material = wrapped("stress_softening", model("hgo"));
  const Values parameters{18.7, 24.9, 0.9, 46, 0.5, 0.4};
  const auto test = wrapped_test("permanent_set", make_strip(loop));
  const std::size_t n = loop.size();
  Values alone(n), values(n), jacobian((parameters.size() + 2) * n);
  ASSERT_TRUE(test->predict({*material, parameters, Values{0, s}}, {alone, {}, {}, {}}).ok());
  ASSERT_TRUE(test->predict({*material, parameters, Values{0, s}}, {values, jacobian, {}, {}}).ok());
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(values[i], alone[i], 1e-9 * (1 + std::abs(alone[i]))) << i;
  constexpr double h = 1e-5;
  Values up(n), down(n);
  ASSERT_TRUE(test->predict({*material, parameters, Values{0, s + h}}, {up, {}, {}, {}}).ok());
  ASSERT_TRUE(test->predict({*material, parameters, Values{0, s - h}}, {down, {}, {}, {}}).ok());
  for (std::size_t i = 0; i < n; ++i) {
    const double difference = (up[i] - down[i]) / (2 * h);
    EXPECT_NEAR(jacobian[(parameters.size() + 1) * n + i], difference, 1e-4 * (1 + std::abs(difference))) << i;
  }
}

/// Predicts once, and fails when it is asked for derivatives by its abscissae.
class Blunt final : public Test {
 public:
  [[nodiscard]] const TestDescription& describe() const override { return strip_->describe(); }
  [[nodiscard]] const TestRows& rows() const override { return strip_->rows(); }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    if (!output.abscissa_derivative.empty()) return Status::failed("blunt");
    return strip_->predict(input, output);
  }

 private:
  std::unique_ptr<Test> strip_ = make_strip(loop);
};

TEST(PermanentSetOfAFailingBase, FailsAsTheBaseDoes) {
  const auto test = wrapped_test("permanent_set", std::make_unique<Blunt>());
  const auto material = make_model("gho");
  Values values(loop.size()), jacobian((set_s.size() + 2) * loop.size());
  for (const double set : {0.0, s}) {
    const Values own{0, set};
    EXPECT_TRUE(test->predict({*material, set_s, own}, {values, {}, {}, {}}).ok());
    EXPECT_EQ(test->predict({*material, set_s, own}, {values, jacobian, {}, {}}).reason(), "blunt") << "set " << set;
  }
}

}  // namespace
}  // namespace tunica::testing::permanent_set_slopes_test
