// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "support/strip.hpp"
#include "support/tube.hpp"

namespace tunica::testing {
namespace {

struct Reference {
  double pressure, outer_diameter_stretch, axial_force;
};
// Long tube, set S, inner radius 3.71 mm, thickness 2.06 mm, axial stretch 1.2: an independent implementation with 60
// Gauss points, checked at 30 digits.
constexpr Reference references[] = {
    {0.000000, 0.897799321840, 714.72252617},  {0.666610, 0.907863574171, 729.25926798},
    {1.333220, 0.918674627812, 744.06354753},  {1.999830, 0.930264529958, 758.98910293},
    {2.666440, 0.942655782721, 773.84466440},  {3.333050, 0.955858226909, 788.38983292},
    {3.999660, 0.969866065183, 802.33359034},  {4.666270, 0.984655423631, 815.33649558},
    {5.332880, 1.000182882260, 827.01732607},  {5.999490, 1.016385344250, 836.96434114},
    {6.666100, 1.033181450920, 844.75055898},  {7.332710, 1.050474510360, 849.95164203},
    {7.999320, 1.068156652340, 852.16441519},  {8.665930, 1.086113723020, 851.02388214},
    {9.332540, 1.104230343140, 846.21690676},  {9.999150, 1.122394588760, 837.49137931},
    {10.665760, 1.140501885340, 824.66048381}, {11.332370, 1.158457885930, 807.60240876},
    {11.998980, 1.176180279760, 786.25635221}, {12.665590, 1.193599614730, 760.61591703},
    {13.332200, 1.210659302260, 730.72100379}, {13.998810, 1.227315007780, 696.64916207},
    {14.665420, 1.243533628180, 658.50713507}, {15.332030, 1.259292031950, 616.42309283},
    {15.998640, 1.274575702220, 570.53983591}, {16.665250, 1.289377385250, 521.00908312},
    {17.331860, 1.303695813300, 467.98683874}, {17.998470, 1.317534543150, 411.62975935},
    {18.665080, 1.330900930500, 352.09240053}, {19.331690, 1.343805245690, 289.52520838},
    {19.998300, 1.356259926180, 224.07312161}, {20.664910, 1.368278955460, 155.87466101},
    {21.331520, 1.379877355000, 85.06139800},  {21.998130, 1.391070774670, 11.75771118},
    {22.664740, 1.401875167310, -63.91924401},
};

TEST(Tube, ReproducesTheReferenceCurve) {
  std::vector<double> pressure;
  for (const Reference& row : references) pressure.push_back(row.pressure);
  const Inflation out = inflate(*make_tube(pressure), *make_model("gho"), set_s);
  ASSERT_TRUE(out.status.ok()) << out.status.reason();
  const std::size_t n = pressure.size();
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(out.values[i], references[i].outer_diameter_stretch, 1e-9) << i;
    // The force passes through zero near the end; a part of it in the wall alone is 3436 mN there.
    const double scale = std::max(std::abs(references[i].axial_force), 100.);
    EXPECT_NEAR(out.values[n + i], references[i].axial_force, 1e-8 * scale) << i;
  }
}

TEST(Tube, FindsTheSameStatesOneByOneAndInAnyOrder) {
  const auto model = make_model("gho");
  std::vector<double> backwards;
  for (const Reference& row : references) backwards.insert(backwards.begin(), row.pressure);
  const Inflation all = inflate(*make_tube(backwards), *model, set_s);
  ASSERT_TRUE(all.status.ok()) << all.status.reason();
  for (std::size_t i = 0; i < backwards.size(); ++i) {
    const Inflation one = inflate(*make_tube({backwards[i]}), *model, set_s);
    ASSERT_TRUE(one.status.ok()) << one.status.reason();
    EXPECT_NEAR(one.values[0], all.values[i], 1e-12) << i;
    EXPECT_NEAR(one.values[1], all.values[backwards.size() + i], 1e-9) << i;
  }
}

}  // namespace
}  // namespace tunica::testing
