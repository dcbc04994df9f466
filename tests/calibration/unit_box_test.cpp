// SPDX-License-Identifier: Apache-2.0
#include "assembly/unit_box.hpp"

#include <gtest/gtest.h>

namespace tunica {
namespace {

/// Linear and logarithmic by turns.
std::vector<assembly::FreeParameter> mixed_scales(std::size_t count) {
  std::vector<assembly::FreeParameter> all;
  for (std::size_t j = 0; j < count; ++j) {
    const double max = 2.0 + static_cast<double>(j);
    all.push_back({"p" + std::to_string(j), "1", 0.5, max, 1, j % 2 == 0 ? Scale::linear : Scale::log, {}, {}});
  }
  return all;
}

TEST(UnitBox, ScalesEveryColumnOfAJacobianByItsSlope) {
  for (const std::size_t n : {1u, 5u, 16u, 17u, 40u}) {
    const assembly::UnitBox box(mixed_scales(n));
    std::vector<double> free(n), jacobian(3 * n, 1.0);
    box.from_unit(std::vector<double>(n, 0.3), free);
    box.jacobian_to_unit(free, jacobian);
    for (std::size_t k = 0; k < jacobian.size(); ++k) EXPECT_EQ(jacobian[k], box.slope(k % n, free[k % n])) << n;
  }
}

TEST(UnitBox, HasTheSlopeOfItsMap) {
  const assembly::UnitBox box(mixed_scales(4));
  const std::vector<double> x(4, 0.3), ahead(4, 0.3 + 1e-6), behind(4, 0.3 - 1e-6);
  std::vector<double> at(4), above(4), below(4);
  box.from_unit(x, at);
  box.from_unit(ahead, above);
  box.from_unit(behind, below);
  for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(box.slope(j, at[j]), (above[j] - below[j]) / 2e-6, 1e-7);
}

}  // namespace
}  // namespace tunica
