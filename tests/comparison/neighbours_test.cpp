// SPDX-License-Identifier: Apache-2.0
#include "comparison/neighbours.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using tunica::comparison::FieldFrame;
using tunica::comparison::Neighbours;
using tunica::comparison::neighbours;
using tunica::comparison::neighbours_warning;

namespace {

/// A grid of points whose errors are sums of width² white ones: they correlate by (1 − |Δx|/width)(1 − |Δy|/width).
FieldFrame camera_grid(std::size_t columns, std::size_t rows, std::size_t width, std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  const std::size_t high = rows + width;
  std::vector<double> white((columns + width) * high);
  for (double& one : white) one = normal(engine);
  FieldFrame frame;
  for (std::size_t i = 0; i < columns; ++i)
    for (std::size_t j = 0; j < rows; ++j) {
      double e = 0;
      for (std::size_t k = 0; k < width * width; ++k) e += white[(i + k / width) * high + j + k % width];
      frame.push_back({0.3 * static_cast<double>(i), 0.3 * static_cast<double>(j), e});
    }
  return frame;
}

std::vector<FieldFrame> camera_frames(std::size_t width) {
  std::mt19937_64 engine(3);
  std::vector<FieldFrame> frames;
  for (int k = 0; k < 6; ++k) frames.push_back(camera_grid(20, 20, width, engine));
  return frames;
}

}  // namespace

// 2400 points: `nearest` has a standard deviation of 0.03.
TEST(Neighbours, ThatErrEachByItselfAreNotWarnedOf) {
  const Neighbours found = neighbours(camera_frames(1));
  EXPECT_EQ(found.points, 2400u);
  EXPECT_NEAR(found.nearest, 0, 4 * found.deviation);
  EXPECT_NEAR(found.inflation, 1, 0.1);
  EXPECT_FALSE(found.err_together());
}

// ρ is 1/2 of the four nearest and 1/4 of the four diagonal ones: V = 1 + 4/2 + 4/4 but for the rim, 3.8 here.
TEST(Neighbours, ThatShareASubsetHaveItsCorrelation) {
  const Neighbours found = neighbours(camera_frames(2));
  EXPECT_NEAR(found.nearest, 0.5, 0.06);
  EXPECT_NEAR(found.inflation, 3.8, 0.4);
  EXPECT_NEAR(found.deviation, std::sqrt(2 / 2400.0), 1e-12);
  EXPECT_TRUE(found.err_together());
}

// 21 000² pairs are more than are looked at: every third point is paired.
TEST(Neighbours, OfALargeFieldAreSampled) {
  std::mt19937_64 engine(4);
  const Neighbours found = neighbours({camera_grid(150, 140, 2, engine)});
  EXPECT_EQ(found.points, 21000u);
  EXPECT_NEAR(found.deviation, std::sqrt(2 / 7000.0), 1e-12);
  EXPECT_NEAR(found.nearest, 0.5, 0.04);
  EXPECT_NEAR(found.inflation, 3.98, 0.3);
}

TEST(Neighbours, MayCoincide) {
  std::mt19937_64 engine(5);
  FieldFrame twice = camera_grid(20, 20, 1, engine), heap = twice;
  for (auto& point : heap) point.x = point.y = 0;
  EXPECT_FALSE(neighbours({heap}).err_together());
  twice.insert(twice.end(), heap.begin(), heap.end());
  for (std::size_t i = 0; i < heap.size(); ++i) twice[heap.size() + i] = twice[i];
  const Neighbours found = neighbours({twice});
  EXPECT_NEAR(found.nearest, 1, 1e-12);
  EXPECT_NEAR(found.inflation, 2, 1e-12);
}

TEST(Neighbours, OfNothingSayNothing) {
  for (const std::vector<FieldFrame>& frames : {std::vector<FieldFrame>{}, std::vector<FieldFrame>{{}, {{0, 0, 1}}},
                                                std::vector<FieldFrame>{{{0, 0, 0}, {1, 0, 0}}}}) {
    EXPECT_EQ(neighbours(frames).inflation, 1);
    EXPECT_FALSE(neighbours(frames).err_together());
  }
}

TEST(Neighbours, ThatHardlyWidenAnIntervalAreNotWarnedOf) {
  Neighbours found{.nearest = 0.5, .deviation = 0.01, .inflation = 1.05, .points = 1000};
  EXPECT_FALSE(found.err_together());
  found.inflation = 1.2;
  EXPECT_TRUE(found.err_together());
}

TEST(Neighbours, OfUnstatedNoiseHaveAnotherCure) {
  const Neighbours found{.nearest = 0.5, .deviation = 0.01, .inflation = 4, .points = 1000};
  EXPECT_THAT(
      neighbours_warning("plate", found, true).sentence,
      AllOf(HasSubstr("correlate by 0.50"), HasSubstr("1000 of them count as 250"), HasSubstr("by about 2 times"),
            HasSubstr("or state 2 times the noise."), Not(HasSubstr("unloaded"))));
  EXPECT_THAT(neighbours_warning("plate", found, false).sentence,
              AllOf(HasSubstr("or state a noise: 2 times the scatter of two images of the unloaded specimen."),
                    Not(HasSubstr("times the noise"))));
}
