// SPDX-License-Identifier: Apache-2.0
// The calls that an error of an abscissa makes to the inner test, and where its amplitude acts alone.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "made_up_tests.hpp"
#include "subject.hpp"

namespace tunica::testing::corrected_test {
namespace {

using Values = std::vector<double>;

const Values stretches{1.02, 1.1, 1.3, 1.5};
constexpr std::size_t n = 4;

/// A strip, its reference length wrong; what is asked of the strip is counted.
struct Overheard {
  std::size_t calls = 0, with_slopes = 0;
  std::unique_ptr<tunica::Test> test;
  std::unique_ptr<Model> material = make_model("gho");

  explicit Overheard(bool costly) {
    const auto count = [this](const TestInput&, const TestOutput& output) {
      ++calls;
      with_slopes += !output.abscissa_derivative.empty();
      return Status();
    };
    test =
        wrapped_test("reference_length_error", std::make_unique<OverheardTest>(make_strip(stretches), count, costly));
    calls = with_slopes = 0;  // it was looked at when it was wrapped
  }
  void predict(double error, bool jacobian) {
    Values values(n), columns(jacobian ? n * (set_s.size() + 2) : 0);
    const Status status = test->predict({*material, set_s, Values{0, error}}, {values, columns, {}, {}});
    EXPECT_TRUE(status.ok()) << status.reason();
  }
};

/// A simulation may take minutes, and is run once a prediction.
TEST(Corrected, RunsACostlyTestOnce) {
  for (const double error : {0.0, 0.03})
    for (const bool jacobian : {false, true}) {
      Overheard costly(true);
      costly.predict(error, jacobian);
      EXPECT_EQ(costly.calls, 1u) << error << (jacobian ? " with derivatives" : "");
    }
}

/// A cheap one is asked at the null for its own numbers as the caller asks, then for slopes; elsewhere once.
TEST(Corrected, AsksACheapTestForItsOwnNumbersAtTheNull) {
  Overheard values(false), at_null(false), beside(false);
  values.predict(0, false);
  EXPECT_EQ(values.calls, 1u);
  at_null.predict(0, true);
  EXPECT_EQ(at_null.calls, 2u);
  EXPECT_EQ(at_null.with_slopes, 1u);
  beside.predict(0.03, true);
  EXPECT_EQ(beside.calls, 1u);
}

/// Every way through fails as the test inside does.
TEST(Corrected, FailsWhereTheTestInsideFails) {
  const auto material = make_model("gho");
  const auto refuse = [](const TestInput& input, const TestOutput& output) {
    const bool looked_at = input.model_parameters.size() == 1;
    return output.abscissa_derivative.empty() || looked_at ? Status() : Status::failed("no slopes");
  };
  const auto test =
      wrapped_test("reference_length_error", std::make_unique<OverheardTest>(make_strip(stretches), refuse));
  Values values(n), jacobian(n * (set_s.size() + 2));
  for (const double error : {0.0, 0.03}) {
    EXPECT_TRUE(test->predict({*material, set_s, Values{0, error}}, {values, {}, {}, {}}).ok());
    EXPECT_EQ(test->predict({*material, set_s, Values{0, error}}, {values, jacobian, {}, {}}).reason(), "no slopes");
  }
}

/// The test inside gets a Jacobian of its own parameters, along a path with memory too.
TEST(Corrected, AsksForTheColumnsOfTheTestInside) {
  const auto sized = [](const TestInput& input, const TestOutput& output) {
    const std::size_t columns = input.model_parameters.size() + input.test_parameters.size();
    const bool right = output.jacobian.empty() || output.jacobian.size() == columns * n;
    return right ? Status() : Status::failed("a Jacobian of somebody else");
  };
  const auto test =
      wrapped_test("reference_length_error", std::make_unique<OverheardTest>(make_strip(stretches), sized));
  const auto soft = wrapped("stress_softening", make_model("gho")), plain = make_model("gho");
  Values with_memory = set_s, values(n);
  with_memory.insert(with_memory.end(), {0.4, 0.5});
  for (const double error : {0.0, 0.03}) {
    Values of_plain(n * (set_s.size() + 2)), of_soft(n * (with_memory.size() + 2));
    EXPECT_EQ(test->predict({*plain, set_s, Values{0, error}}, {values, of_plain, {}, {}}).reason(), "");
    EXPECT_EQ(test->predict({*soft, with_memory, Values{0, error}}, {values, of_soft, {}, {}}).reason(), "");
  }
}

/// The stretch may be any of several abscissae.
TEST(Corrected, MayStandBesideAnotherAbscissa) {
  const auto material = make_model("gho");
  const auto alone = wrapped_test("reference_length_error", make_strip(stretches));
  const auto beside =
      wrapped_test("reference_length_error", std::make_unique<BesideATemperature>(make_strip(stretches)));
  const std::size_t columns = set_s.size() + 2;
  for (const double error : {0.0, -0.03}) {
    const Values own{0, error};
    Values values(n), jacobian(n * columns), slopes(n), values_2(n), jacobian_2(n * columns), slopes_2(2 * n);
    ASSERT_TRUE(alone->predict({*material, set_s, own}, {values, jacobian, slopes, {}}).ok());
    ASSERT_TRUE(beside->predict({*material, set_s, own}, {values_2, jacobian_2, slopes_2, {}}).ok());
    slopes.insert(slopes.begin(), n, 0.0);
    EXPECT_EQ(values_2, values);
    EXPECT_EQ(jacobian_2, jacobian);
    EXPECT_EQ(slopes_2, slopes);
    ASSERT_TRUE(beside->predict({*material, set_s, own}, {values_2, jacobian_2, {}, {}}).ok());
    for (std::size_t i = 0; i < jacobian.size(); ++i)
      EXPECT_NEAR(jacobian_2[i], jacobian[i], 1e-9 * (1 + std::abs(jacobian[i]))) << i;
  }
}

/// An offset of 1 kPa is an offset as any other.
TEST(Corrected, AnOffsetOfOneIsNoNull) {
  const auto material = make_model("gho");
  const auto test = wrapped_test("pressure_offset", make_tube({1, 8, 15}));
  Values found(6), expected(6);
  EXPECT_EQ(test->describe().nulls.back(), 0);
  ASSERT_TRUE(test->predict({*material, set_s, Values{0, 0, 0, 0, 1, 1}}, {found, {}, {}, {}}).ok());
  ASSERT_TRUE(make_tube({2, 9, 16})->predict({*material, set_s, bare_tube}, {expected, {}, {}, {}}).ok());
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(found[i], expected[i], 1e-9 * std::abs(expected[i])) << i;
}

/// The measure of a stress is found at the values that other parameters of the test begin with.
TEST(Corrected, KnowsTheMeasureWhateverElseIsFitted) {
  for (const char* measure : {"cauchy", "first_piola_kirchhoff", "second_piola_kirchhoff"}) {
    const auto made = [&](bool fitted) {
      auto strip = make_strip(stretches, {.measure = measure});
      if (fitted) strip = std::make_unique<TimesAFactor>(std::move(strip));
      return wrapped_test("reference_length_error", std::move(strip));
    };
    const auto material = make_model("gho");
    Values found(n), expected(n);
    ASSERT_TRUE(made(true)->predict({*material, set_s, Values{1, 0, 0.04}}, {found, {}, {}, {}}).ok());
    ASSERT_TRUE(made(false)->predict({*material, set_s, Values{0, 0.04}}, {expected, {}, {}, {}}).ok());
    EXPECT_EQ(found, expected) << measure;
  }
}

}  // namespace
}  // namespace tunica::testing::corrected_test
