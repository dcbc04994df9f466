// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subject.hpp"

namespace tunica::channel_errors_test {
namespace {

const std::vector<double> stretches{1.0, 1.1, 1.3, 1.5};
const std::vector<double> parameters{18.668, 0.1367, 24.905, 0.2912, 46.44};  // gho, set S

std::unique_ptr<Test> strip(const std::vector<std::string>& channels) {
  return testing::make_strip(stretches, {.channels = channels, .measure = "first_piola_kirchhoff"});
}

std::unique_ptr<Test> offset_strip(const std::vector<std::string>& channels) {
  return testing::wrapped_test("force_offset", strip(channels));
}

struct Prediction {
  std::vector<double> values, jacobian, by_abscissa;
};

Prediction predict(const Test& test, const std::vector<double>& test_parameters) {
  const auto model = testing::model("gho");
  const std::size_t size = test.rows().channels.size() * test.rows().count;
  Prediction p{std::vector<double>(size), std::vector<double>(size * (parameters.size() + test_parameters.size())),
               std::vector<double>(size)};
  const Status status =
      test.predict({*model, parameters, test_parameters, {}}, {p.values, p.jacobian, p.by_abscissa, {}});
  EXPECT_TRUE(status.ok()) << status.reason();
  return p;
}

TEST(ForceOffset, ShiftsTheStressAndNothingElse) {
  const Prediction bare = predict(*strip({"transverse_stretch", "stress"}), {0});
  const Prediction shifted = predict(*offset_strip({"transverse_stretch", "stress"}), {0, -2.5});
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(shifted.values[i], bare.values[i]);
    EXPECT_EQ(shifted.values[4 + i], bare.values[4 + i] - 2.5);
  }
  EXPECT_EQ(shifted.by_abscissa, bare.by_abscissa);
}

TEST(ForceOffset, HasAnExactJacobianColumn) {
  const Prediction bare = predict(*strip({"transverse_stretch", "stress"}), {0});
  const Prediction shifted = predict(*offset_strip({"transverse_stretch", "stress"}), {0, 1.5});
  std::vector<double> expected = bare.jacobian;
  expected.insert(expected.end(), {0, 0, 0, 0, 1, 1, 1, 1});
  EXPECT_EQ(shifted.jacobian, expected);
}

TEST(ForceOffset, IsTheBareTestAtTheNullBitForBit) {
  const Prediction bare = predict(*strip({"stress"}), {0});
  const Prediction at_null = predict(*offset_strip({"stress"}), {0, 0});
  EXPECT_EQ(std::memcmp(at_null.values.data(), bare.values.data(), sizeof(double) * bare.values.size()), 0);
}

TEST(ForceOffset, DeclaresItsParameterAndNullBehindTheTests) {
  const auto test = offset_strip({"stress"});
  ASSERT_EQ(test->describe().parameters.size(), 2u);
  EXPECT_EQ(test->describe().parameters.back().name, "value");
  EXPECT_EQ(test->describe().parameters.back().unit, "kPa");
  EXPECT_EQ(test->describe().nulls.back(), 0);
  EXPECT_EQ(test->rows().count, 4u);
  EXPECT_THAT(testing::catalogue().mechanisms().at("force_offset").factory.applies_to,
              ::testing::ElementsAre("uniaxial"));
}

TEST(ForceOffset, PassesOnWhyTheTestFailed) {
  const auto test = offset_strip({"stress"});
  const auto model = testing::model("gho");
  std::vector<double> values(4);
  const std::vector<double> overflowing{18.668, 0.1367, 24.905, 1e6, 46.44};
  const Status status = test->predict({*model, overflowing, std::vector<double>{0, 1}, {}}, {values, {}, {}, {}});
  EXPECT_EQ(status.kind(), Status::Kind::failed);
  EXPECT_THAT(status.reason(), ::testing::HasSubstr("uniaxial"));
}

TEST(ForceOffset, RefusesATestWithoutStress) {
  try {
    offset_strip({"transverse_stretch"});
    FAIL() << "accepted";
  } catch (const InputError& problem) {
    EXPECT_THAT(problem.what(),
                ::testing::EndsWith("force_offset: the test's data have no channel 'stress', which is what the "
                                    "mechanism shifts; map a column to 'stress', or take the mechanism out"));
  }
}

struct Case {
  const char* mechanism;
  bool tube;
  double amplitude, gain, shift;  ///< measured = gain · true + shift
};

class EveryForceError : public ::testing::TestWithParam<Case> {
 protected:
  [[nodiscard]] static std::unique_ptr<tunica::Test> bare() {
    if (!GetParam().tube) return strip({"transverse_stretch", "stress"});
    return testing::make_tube({1, 8, 15, 20}, {.channels = {"outer_diameter_stretch", "axial_force"}});
  }
  [[nodiscard]] static std::unique_ptr<tunica::Test> misread() {
    const auto& entry = testing::catalogue().mechanisms().at(GetParam().mechanism);
    return plugins::wrap(entry, bare(), testing::defaults(entry.factory.options));
  }
  /// The test's own parameters at their nulls, and the amplitude.
  [[nodiscard]] static std::vector<double> own(std::vector<double> more) {
    std::vector<double> values = bare()->describe().nulls;
    values.insert(values.end(), more.begin(), more.end());
    return values;
  }
};

TEST_P(EveryForceError, ReadsTheTrueForceAsItsFormulaSays) {
  const Case is = GetParam();
  const Prediction truth = predict(*bare(), own({}));
  const Prediction read = predict(*misread(), own({is.amplitude}));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(read.values[i], truth.values[i]);
    EXPECT_NEAR(read.values[4 + i], is.gain * truth.values[4 + i] + is.shift, 1e-13 * std::abs(truth.values[4 + i]));
    EXPECT_NEAR(read.by_abscissa[4 + i], is.gain * truth.by_abscissa[4 + i],
                1e-13 * std::abs(truth.by_abscissa[4 + i]));
  }
  for (std::size_t j = 0; j < truth.jacobian.size(); ++j)
    EXPECT_NEAR(read.jacobian[j], (j % 8 < 4 ? 1 : is.gain) * truth.jacobian[j], 1e-13 * std::abs(truth.jacobian[j]));
  constexpr double h = 1e-4;
  const Prediction above = predict(*misread(), own({is.amplitude + h}));
  const Prediction below = predict(*misread(), own({is.amplitude - h}));
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_NEAR(read.jacobian[truth.jacobian.size() + i], (above.values[i] - below.values[i]) / (2 * h),
                1e-6 * std::max(1., std::abs(truth.values[i])));
}

TEST_P(EveryForceError, IsTheBareTestAtTheNullBitForBit) {
  const Prediction truth = predict(*bare(), own({}));
  const Prediction read = predict(*misread(), own({0}));
  EXPECT_EQ(std::memcmp(read.values.data(), truth.values.data(), sizeof(double) * truth.values.size()), 0);
  EXPECT_EQ(std::memcmp(read.jacobian.data(), truth.jacobian.data(), sizeof(double) * truth.jacobian.size()), 0);
}

INSTANTIATE_TEST_SUITE_P(ForceErrors, EveryForceError,
                         ::testing::Values(Case{"force_offset", false, -2.5, 1, -2.5},
                                           Case{"force_scale_error", false, 0.25, 1.25, 0},
                                           Case{"axial_force_offset", true, 12, 1, -12},
                                           Case{"axial_force_scale_error", true, 0.25, 0.8, 0}),
                         [](const auto& at) { return std::string(at.param.mechanism); });

}  // namespace
}  // namespace tunica::channel_errors_test
