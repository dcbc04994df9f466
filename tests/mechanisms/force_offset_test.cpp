// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "shelf.hpp"
#include "support/strip.hpp"

namespace tunica {
namespace {

const std::vector<double> stretches{1.0, 1.1, 1.3, 1.5};
const std::vector<double> parameters{18.668, 0.1367, 24.905, 0.2912, 46.44};  // gho, set S

std::unique_ptr<Test> strip(const std::vector<std::string>& channels) {
  return testing::make_strip(stretches, {.channels = channels, .measure = "first_piola_kirchhoff"});
}

std::unique_ptr<Test> offset_strip(const std::vector<std::string>& channels) {
  const auto& entry = testing::catalogue().mechanisms().at("force_offset");
  return plugins::wrap(entry, strip(channels), testing::defaults(entry.factory.options));
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

}  // namespace
}  // namespace tunica
