// SPDX-License-Identifier: Apache-2.0
// A strip with a set where it is slack, at its first length and below it, of a muscle that pulls at rest too: what is
// zero there is zero because the strip is slack. And what it asks of the test inside.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "made_up_tests.hpp"
#include "subject.hpp"

namespace tunica::testing::permanent_set_slack_test {
namespace {

using Values = std::vector<double>;
using ::testing::HasSubstr;

constexpr double s = 0.2;
/// At the first length, up, slack twice, back at the first length, pushed below it, and up again.
const Values loop{1, 1.2, 1.5, 1.05, 1.02, 1, 0.97, 1.3, 1.6, 1.1};
const Values largest{1, 1.2, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.6, 1.6};
const std::vector<bool> slack{false, false, false, true, true, true, false, false, false, true};
const std::size_t n = loop.size();

struct Prediction {
  Values values, jacobian, slopes;
};

class SlackStrip : public ::testing::TestWithParam<std::pair<const char*, double>> {
 protected:
  [[nodiscard]] std::unique_ptr<tunica::Test> strip(const Values& stretches) const {
    return make_strip(stretches, {.channels = {"transverse_stretch", "stress"}, .measure = GetParam().first});
  }
  [[nodiscard]] std::unique_ptr<tunica::Test> with_set() const { return wrapped_test("permanent_set", strip(loop)); }
  [[nodiscard]] Prediction predict(const tunica::Test& test, const Values& own) const {
    Prediction p{Values(2 * n), Values(2 * n * (parameters.size() + own.size())), Values(2 * n)};
    const Status status = test.predict({*material, parameters, own}, {p.values, p.jacobian, p.slopes, {}});
    EXPECT_TRUE(status.ok()) << status.reason();
    return p;
  }

  const std::unique_ptr<Model> material = wrapped("active_tone", make_model("gho"));
  const Values parameters{18.668, 0.1367, 24.905, 0.2912, 46.44, 15};
};

TEST_P(SlackStrip, BearsNothingWhereItIsSlackAndIsAsItWasBelowItsFirstLength) {
  Values felt;
  for (std::size_t i = 0; i < n; ++i)
    felt.push_back(loop[i] < 1 ? loop[i] : std::max(1.0, loop[i] / (1 + s * (largest[i] - 1))));
  const Prediction bare = predict(*strip(felt), {0}), found = predict(*with_set(), {0, s});
  const std::size_t size = 2 * n, columns = parameters.size() + 2;
  for (std::size_t i = 0; i < n; ++i) {
    const double p = 1 + s * (largest[i] - 1);
    EXPECT_NEAR(found.values[i], bare.values[i] / std::sqrt(p), 1e-9) << i;
    EXPECT_GT(std::abs(bare.values[n + i]), 5) << "the muscle pulls in row " << i;
    if (!slack[i]) {
      EXPECT_NEAR(found.values[n + i], bare.values[n + i] * std::pow(p, GetParam().second), 1e-9 * bare.values[n + i]);
      continue;
    }
    EXPECT_EQ(found.values[n + i], 0) << i;
    EXPECT_EQ(found.slopes[n + i], 0) << i;
    for (std::size_t j = 0; j < columns; ++j) EXPECT_EQ(found.jacobian[j * size + n + i], 0) << j << ' ' << i;
  }
}

TEST_P(SlackStrip, IsTheBareStripAtTheNullBitForBitAlsoBackAtItsFirstLength) {
  const auto test = with_set();
  EXPECT_EQ(test->describe().nulls, (Values{0, 0}));
  const Prediction bare = predict(*strip(loop), {0}), found = predict(*test, {0, 0});
  EXPECT_EQ(found.values, bare.values);
  EXPECT_EQ(found.slopes, bare.slopes);
  EXPECT_EQ(Values(found.jacobian.begin(), found.jacobian.begin() + static_cast<std::ptrdiff_t>(bare.jacobian.size())),
            bare.jacobian);
}

/// Derivatives by the stretch alone, without values or a Jacobian beside them.
TEST_P(SlackStrip, HasItsSlopesAlone) {
  for (const double set : {0.0, s}) {
    const Values own{0, set};
    const Values expected = predict(*with_set(), own).slopes;
    Values alone(2 * n);
    ASSERT_TRUE(with_set()->predict({*material, parameters, own}, {{}, {}, alone, {}}).ok());
    for (std::size_t i = 0; i < 2 * n; ++i) EXPECT_NEAR(alone[i], expected[i], 1e-9 * (1 + std::abs(expected[i]))) << i;
  }
}

/// The stretch may be any of several abscissae; by the others nothing changes with it.
TEST_P(SlackStrip, MayStandBesideAnotherAbscissa) {
  const auto beside = wrapped_test("permanent_set", std::make_unique<BesideATemperature>(strip(loop)));
  for (const double set : {0.0, s}) {
    const Values own{0, set};
    const Prediction expected = predict(*with_set(), own);
    Values values(2 * n), jacobian(expected.jacobian.size()), slopes(4 * n);
    ASSERT_TRUE(beside->predict({*material, parameters, own}, {values, jacobian, slopes, {}}).ok());
    EXPECT_EQ(values, expected.values);
    EXPECT_EQ(jacobian, expected.jacobian);
    Values both(2 * n, 0.0);
    both.insert(both.end(), expected.slopes.begin(), expected.slopes.end());
    EXPECT_EQ(slopes, both);
  }
}

INSTANTIATE_TEST_SUITE_P(Measures, SlackStrip,
                         ::testing::Values(std::pair("cauchy", 0.0), std::pair("first_piola_kirchhoff", -1.0),
                                           std::pair("second_piola_kirchhoff", -2.0)),
                         [](const auto& at) { return std::string(at.param.first); });

TEST(SlackStripOfAnother, FailsWhereTheJacobianInsideFails) {
  const auto refuse = [](const TestInput&, const TestOutput& output) {
    return output.jacobian.empty() ? Status() : Status::failed("no Jacobian");
  };
  const auto test = wrapped_test("permanent_set", std::make_unique<OverheardTest>(make_strip(loop), refuse));
  const auto material = make_model("gho");
  Values values(n), jacobian((set_s.size() + 2) * n);
  for (const double set : {0.0, s})
    EXPECT_EQ(test->predict({*material, set_s, Values{0, set}}, {values, jacobian, {}, {}}).reason(), "no Jacobian");
}

/// What it corrects has to be the stress of a strip, whatever else the test has to be fitted.
TEST(SlackStripOfAnother, HasTheStressOfAStripWhateverElseIsFitted) {
  const auto wrap = [](double factor) {
    return wrapped_test("permanent_set", std::make_unique<TimesAFactor>(make_strip(loop), factor));
  };
  EXPECT_EQ(wrap(1)->describe().nulls.size(), 3u);
  try {
    wrap(3);
    FAIL() << "three times a stress is none of a strip";
  } catch (const InputError& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("permanent_set: the test's stress is no Cauchy, first or second"));
  }
}

}  // namespace
}  // namespace tunica::testing::permanent_set_slack_test
