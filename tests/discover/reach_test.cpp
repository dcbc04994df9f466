// SPDX-License-Identifier: Apache-2.0
// The range of every invariant that the data reach.
#include "discovery/reach.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "assembly/assembly.hpp"
#include "discover/rubber.hpp"

namespace tunica::discovery::reach_test {

TEST(DiscoveryReach, IsThatOfTheStretchesThatWereMeasured) {
  const trial::Rubber rubber;
  rubber.measure(1);
  const auto read = rubber.read();
  const assembly::Assembly assembly(read, read.runs.front(), testing::catalogue());
  std::vector<double> free(assembly.layout().parameters.size());
  assembly.box().from_unit(assembly.box().initial(), free);
  const Subject subject{read, read.runs.front(), "rubber", false, testing::catalogue()};
  const auto states = reached_states(subject, free);
  ASSERT_FALSE(states.empty());
  // Equibiaxial to λ = 2.2: I1 = 2λ² + λ⁻⁴, I2 = λ⁴ + 2λ⁻². Uniaxial to 3: I1 = λ² + 2/λ.
  const double l = 2.2, biaxial = 2 * l * l + std::pow(l, -4), uniaxial = 9 + 2. / 3;
  EXPECT_NEAR(reach_of_first(states).high, std::max(biaxial, uniaxial) - 3, 1e-9);
  EXPECT_NEAR(reach_of_second(states).high, std::pow(l, 4) + 2 / (l * l) - 3, 1e-9);
  EXPECT_NEAR(reach_of_fibre(states, 90).high, 9 - 1, 1e-9);
  EXPECT_NEAR(reach_of_fibre(states, 0).high, l * l - 1, 1e-9);
  EXPECT_NEAR(reach_of_stretches(states).high, std::log(3), 1e-9);
  EXPECT_NEAR(reach_of_stretches(states).low, -2 * std::log(l), 1e-9);
}

}  // namespace tunica::discovery::reach_test
