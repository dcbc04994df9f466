// SPDX-License-Identifier: Apache-2.0
#include "assembly/quality.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "calibration/fakes.hpp"

namespace tunica {
namespace {

TEST(Agreement, IsMeasuredAsTheLiteratureDoes) {
  const std::vector<double> e{1, 2, 3, 6}, p{1, 3, 3, 5};
  const auto found = assembly::agreement(e, p);
  EXPECT_EQ(found.rows, 4u);
  EXPECT_NEAR(found.rmse, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(*found.r2, 1 - 2.0 / 14, 1e-15);
  EXPECT_NEAR(*found.nmad, 100 * 2.0 / 12, 1e-12);
}

TEST(Agreement, LeavesOutWhatConstantOrZeroDataCannotSay) {
  const std::vector<double> constant{2, 2}, zero{0, 0}, p{1, 3};
  EXPECT_FALSE(assembly::agreement(constant, p).r2);
  EXPECT_TRUE(assembly::agreement(constant, p).nmad);
  EXPECT_FALSE(assembly::agreement(zero, zero).nmad);
}

TEST(Quality, KeepsHeldOutRowsApart) {
  fakes::Bench bench;
  auto& entry = bench.add_test("t", {0, 1, 2, 3}, {1, 2, 3, 9}, true);
  entry.hold_out.rows = {3, {}, 1};
  bench.add_test("u", {0, 1}, {1, 2}).hold_out.all = true;
  const auto assembly = bench.assemble();
  std::vector<double> predictions(assembly.layout().prediction_count);
  const auto workspace = assembly.evaluator().make_workspace();
  ASSERT_TRUE(assembly.evaluator().predict(std::vector<double>{1, 1, 0}, predictions, {}, *workspace).ok());
  const auto found = assembly::quality(assembly, predictions);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].fitted->rmse, 0);
  EXPECT_EQ(found[0].held_out->rows, 1u);
  EXPECT_EQ(found[0].held_out->rmse, 5);
  EXPECT_EQ(found[1].observable, "z");
  EXPECT_EQ(found[1].held_out->rmse, 50);
  EXPECT_FALSE(found[2].fitted);
  EXPECT_EQ(found[2].held_out->rows, 2u);
}

}  // namespace
}  // namespace tunica
