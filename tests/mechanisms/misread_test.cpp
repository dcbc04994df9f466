// SPDX-License-Identifier: Apache-2.0
// Misread channels where a Jacobian alone is wanted, at an amplitude of 1, and options that are nearly right.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subject.hpp"

namespace tunica::testing::misread_test {
namespace {

using Values = std::vector<double>;
using ::testing::HasSubstr;

const Values stretches{1.05, 1.1, 1.2, 1.3, 1.5};
constexpr std::size_t n = 5;

struct Error {
  const char* mechanism;
  double amplitude;
  Values gain, shift;              ///< of the stress in each row: measured = gain · true + shift
  Values gain_slope, shift_slope;  ///< by the amplitude
};

Values all(double value) { return Values(n, value); }

class Misread : public ::testing::TestWithParam<Error> {};

/// ∂measured/∂p = gain ∂true/∂p, ∂measured/∂a = true ∂gain/∂a + ∂shift/∂a; the stretch across is read rightly.
TEST_P(Misread, HasItsJacobianAloneAndBesideItsValues) {
  const Error& is = GetParam();
  Options options;
  if (std::string(is.mechanism) == "signal_drift" || std::string(is.mechanism) == "outliers")
    options.set("channel", std::string("stress"));
  if (std::string(is.mechanism) == "outliers") options.set("rows", std::string("1:3"));
  const std::vector<std::string> channels{"transverse_stretch", "stress"};
  const auto bare = make_strip(stretches, {.channels = channels});
  const auto test = wrapped_test(is.mechanism, make_strip(stretches, {.channels = channels}), options);
  EXPECT_EQ(test->describe().nulls, (Values{0, 0}));
  const auto material = make_model("gho");
  const std::size_t size = 2 * n, columns = set_s.size() + 1;
  Values truth(size), by_truth(columns * size), values(size), jacobian((columns + 1) * size), alone(jacobian.size());
  ASSERT_TRUE(bare->predict({*material, set_s, Values{0}}, {truth, by_truth, {}, {}}).ok());
  const Values own{0, is.amplitude};
  ASSERT_TRUE(test->predict({*material, set_s, own}, {values, jacobian, {}, {}}).ok());
  ASSERT_TRUE(test->predict({*material, set_s, own}, {{}, alone, {}, {}}).ok());
  for (std::size_t row = 0; row < n; ++row) {
    const std::size_t i = n + row;
    EXPECT_NEAR(values[row], truth[row], 1e-12);
    EXPECT_NEAR(values[i], is.gain[row] * truth[i] + is.shift[row], 1e-12 * (1 + std::abs(truth[i])));
    for (const Values& found : {jacobian, alone}) {
      for (std::size_t j = 0; j < columns; ++j)
        EXPECT_NEAR(found[j * size + i], is.gain[row] * by_truth[j * size + i], 1e-9 * (1 + std::abs(values[i]))) << j;
      EXPECT_NEAR(found[columns * size + i], is.gain_slope[row] * truth[i] + is.shift_slope[row],
                  1e-9 * (1 + std::abs(truth[i])))
          << row;
      EXPECT_EQ(found[columns * size + row], 0);
    }
  }
}

const Values rising{0, 0.25, 0.5, 0.75, 1}, middle{0, 1, 1, 0, 0};
INSTANTIATE_TEST_SUITE_P(Errors, Misread,
                         ::testing::Values(Error{"force_offset", 1, all(1), all(1), all(0), all(1)},
                                           Error{"force_scale_error", 1, all(2), all(0), all(1), all(0)},
                                           Error{"force_scale_error", 0, all(1), all(0), all(1), all(0)},
                                           Error{"force_scale_error", 0.25, all(1.25), all(0), all(1), all(0)},
                                           Error{"signal_drift", 1, all(1), rising, all(0), rising},
                                           Error{"signal_drift", 8, all(1), {0, 2, 4, 6, 8}, all(0), rising},
                                           Error{"outliers", 3, all(1), {0, 3, 3, 0, 0}, all(0), middle}),
                         [](const auto& at) {
                           const std::string name = at.param.mechanism;
                           return name + "_at_" + std::to_string(static_cast<int>(at.param.amplitude * 100));
                         });

std::string refusal(const std::string& mechanism, const char* option, const char* value) {
  Options options;
  options.set(option, std::string(value));
  try {
    static_cast<void>(wrapped_test(mechanism, make_strip(stretches), options));
  } catch (const InputError& problem) {
    return problem.what();
  }
  return "accepted";
}

/// A channel that the test does not have is no slip to be passed over, though the test has one channel only.
TEST(MisreadOptions, NameAChannelThatThereIs) {
  EXPECT_THAT(refusal("signal_drift", "channel", "force"), HasSubstr("expected one of: stress"));
  EXPECT_EQ(refusal("signal_drift", "channel", "stress"), "accepted");
}

/// Numbers are whole, stand alone, and can be counted.
TEST(MisreadOptions, RefuseRowsThatAreNearlyNumbers) {
  for (const char* rows : {"1x:3", "0:3x", "0:4:2x", "0:99999999999999999999999", "99999999999999999999999:4", "0 :3"})
    EXPECT_THAT(refusal("outliers", "rows", rows), HasSubstr("expected \"all\", \"first:last\"")) << rows;
  for (const char* rows : {"0:", ":", "::", "1:4:", "0:4:2"}) EXPECT_EQ(refusal("outliers", "rows", rows), "accepted");
}

/// A step that is left out is 1.
TEST(MisreadOptions, AStepMayBeLeftOut) {
  Options options;
  options.set("rows", std::string("1:4:"));
  const auto test = wrapped_test("outliers", make_strip(stretches), options);
  const auto material = make_model("gho");
  Values truth(n), found(n);
  ASSERT_TRUE(make_strip(stretches)->predict({*material, set_s, Values{0}}, {truth, {}, {}, {}}).ok());
  ASSERT_TRUE(test->predict({*material, set_s, Values{0, 2}}, {found, {}, {}, {}}).ok());
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(found[i] - truth[i], i >= 1 && i < 4 ? 2 : 0, 1e-12) << i;
}

/// A recording of less than a second lasts long enough to drift.
TEST(MisreadOptions, ADriftMayLastAPartOfASecond) {
  const Values time{0.1, 0.2, 0.3, 0.4, 0.5};
  const auto test = wrapped_test("signal_drift", make_strip(stretches, {.time = time}));
  const auto material = make_model("gho");
  Values truth(n), found(n);
  ASSERT_TRUE(make_strip(stretches)->predict({*material, set_s, Values{0}}, {truth, {}, {}, {}}).ok());
  ASSERT_TRUE(test->predict({*material, set_s, Values{0, 2}}, {found, {}, {}, {}}).ok());
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(found[i] - truth[i], 2 * rising[i], 1e-12) << i;
}

}  // namespace
}  // namespace tunica::testing::misread_test
