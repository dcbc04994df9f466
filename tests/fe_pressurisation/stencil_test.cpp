// SPDX-License-Identifier: Apache-2.0
#include "stencil.hpp"

#include <cmath>
#include <random>
#include <tuple>

#include <gtest/gtest.h>

namespace tunica::testing::stencil_test {
namespace {

/// Order, elements across and along.
class StencilMatrix : public ::testing::TestWithParam<std::tuple<std::size_t, std::size_t, std::size_t>> {
 protected:
  fe::Mesh mesh{std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam()), 1, 2, 3, 1,
                fe::Ends::clamped};
  fe::Stencil stencil;
  fe::Banded band;  ///< the same entries

  /// A seeded entry for every two positions of every element.
  void SetUp() override {
    std::mt19937_64 engine(8);
    std::uniform_real_distribution<double> unit(-1, 1);
    stencil.resize(mesh);
    band.resize(2 * mesh.nodes(), stencil.width());
    const std::size_t order = mesh.order, side = order + 1;
    for (std::size_t row = 0; row < mesh.axial; ++row)
      for (std::size_t e = 0; e < mesh.radial; ++e)
        for (std::size_t a = 0; a < 2 * side * side; ++a)
          for (std::size_t b = 0; b <= a; ++b) {
            const auto place = [&](std::size_t k) {
              return 2 * mesh.node(e * order + k / 2 % side, row * order + k / 2 / side) + k % 2;
            };
            const double value = unit(engine);
            stencil.add(place(a), place(b), value);
            band.add(place(a), place(b), value);
          }
  }
};

TEST_P(StencilMatrix, HoldsEveryEntryOfTheBand) {
  fe::Banded spread;
  stencil.spread(spread);
  ASSERT_EQ(spread.size(), band.size());
  for (std::size_t j = 0; j < band.size(); ++j)
    for (std::size_t i = j; i < std::min(band.size(), j + band.width() + 1); ++i) {
      EXPECT_EQ(spread.column(j)[i - j], band.column(j)[i - j]) << i << ", " << j;
      EXPECT_EQ(stencil.entry(i, j), band.column(j)[i - j]) << i << ", " << j;
    }
}

TEST_P(StencilMatrix, MultipliesLikeTheBand) {
  std::vector<double> x(band.size()), expected(band.size()), found(band.size(), 7);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(static_cast<double>(i));
  band.multiply(x, expected);
  stencil.multiply(x, found);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 1e-12) << i;
    EXPECT_NEAR(stencil.row_times(i, x), expected[i], 1e-12) << i;
  }
}

/// Also where what was factorised before stands in it.
TEST_P(StencilMatrix, SpreadsIntoABandThatWasUsed) {
  fe::Banded used, fresh;
  stencil.spread(fresh);
  stencil.spread(used);
  used.factorise();
  stencil.spread(used);
  for (std::size_t j = 0; j < fresh.size(); ++j)
    for (std::size_t i = 0; i <= fresh.width(); ++i) EXPECT_EQ(used.column(j)[i], fresh.column(j)[i]) << i << ", " << j;
}

INSTANTIATE_TEST_SUITE_P(Meshes, StencilMatrix,
                         ::testing::Combine(::testing::Values(1, 2), ::testing::Values(1, 2, 3, 5),
                                            ::testing::Values(2, 3)));

}  // namespace
}  // namespace tunica::testing::stencil_test
