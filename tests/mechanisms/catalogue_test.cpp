// SPDX-License-Identifier: Apache-2.0
// The shelf as a whole: every mechanism of the catalogue is there, and says all that diagnosis and a person need.
#include <algorithm>
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelf.hpp"

namespace tunica::catalogue_test {
namespace {

using Side = MechanismFactory::Side;

const std::map<std::string, Side> catalogued{{"fibre_dispersion", Side::positive},
                                             {"axial_fibres", Side::positive},
                                             {"compressibility", Side::positive},
                                             {"clamped_ends", Side::positive},
                                             {"circumferential_fibres", Side::positive},
                                             {"matrix_stiffening", Side::positive},
                                             {"chain_extensibility", Side::positive},
                                             {"second_invariant", Side::positive},
                                             {"fibre_recruitment", Side::positive},
                                             {"active_tone", Side::positive},
                                             {"stress_softening", Side::positive},
                                             {"damage", Side::positive},
                                             {"viscoelasticity", Side::positive},
                                             {"permanent_set", Side::positive},
                                             {"residual_stress", Side::both},
                                             {"axial_stretch_error", Side::both},
                                             {"tethering", Side::positive},
                                             {"layered_wall", Side::both},
                                             {"geometry_error", Side::both},
                                             {"pressure_offset", Side::both},
                                             {"pressure_scale_error", Side::both},
                                             {"diameter_scale_error", Side::both},
                                             {"axial_force_offset", Side::both},
                                             {"axial_force_scale_error", Side::both},
                                             {"reference_length_error", Side::both},
                                             {"force_scale_error", Side::both},
                                             {"force_offset", Side::both},
                                             {"signal_drift", Side::both},
                                             {"specimen_misalignment", Side::even},
                                             {"outliers", Side::both},
                                             {"added_term", Side::positive},
                                             {"displacement_offset", Side::both},
                                             {"zeroed_at_preload", Side::positive},
                                             {"machine_compliance", Side::positive},
                                             {"sheet_prestretch", Side::both},
                                             {"sheet_force_offset", Side::both},
                                             {"sheet_force_scale_error", Side::both},
                                             {"channel_lag", Side::positive},
                                             {"clamp_slip", Side::positive},
                                             {"grip_tilt", Side::both},
                                             {"oblique_pull", Side::both},
                                             {"thickness_gradient", Side::both},
                                             {"stiffer_half", Side::both}};

TEST(Catalogue, HoldsEveryMechanismWithItsSide) {
  std::map<std::string, Side> shelf;
  for (const auto& [id, entry] : testing::catalogue().mechanisms()) shelf[id] = entry.factory.side;
  EXPECT_EQ(shelf, catalogued);
  EXPECT_EQ(shelf.size(), 43u);
}

class EveryMechanism : public ::testing::TestWithParam<std::string> {
 protected:
  const MechanismFactory& mechanism = testing::catalogue().mechanisms().at(GetParam()).factory;
};

TEST_P(EveryMechanism, SaysInOneSentenceWhatHappens) {
  EXPECT_THAT(mechanism.cause, ::testing::EndsWith("."));
  EXPECT_EQ(std::count(mechanism.cause.begin(), mechanism.cause.end(), '.'), 1) << mechanism.cause;
  EXPECT_FALSE(mechanism.isolated_by.empty());
  EXPECT_FALSE(mechanism.reference.empty());
}

TEST_P(EveryMechanism, HasAPlausibleRangeAroundItsNullWithinTheBounds) {
  const Parameter& amplitude = mechanism.parameters.front();
  EXPECT_LE(amplitude.min, mechanism.plausible_min);
  EXPECT_LE(mechanism.plausible_min, mechanism.null);
  EXPECT_LT(mechanism.null, mechanism.plausible_max);
  EXPECT_LE(mechanism.plausible_max, amplitude.max);
  if (mechanism.side == Side::positive) {
    EXPECT_EQ(amplitude.min, mechanism.null);
    EXPECT_EQ(mechanism.plausible_min, mechanism.null);
  } else {
    EXPECT_LT(mechanism.plausible_min, mechanism.null);
  }
}

TEST_P(EveryMechanism, LooksLikeAtMostThreeOthersOfTheShelf) {
  EXPECT_LE(mechanism.look_alikes.size(), 3u);
  EXPECT_FALSE(mechanism.look_alikes.empty());
  for (const std::string& other : mechanism.look_alikes) {
    EXPECT_TRUE(testing::catalogue().mechanisms().contains(other)) << other;
    EXPECT_NE(other, mechanism.id);
    EXPECT_EQ(std::count(mechanism.look_alikes.begin(), mechanism.look_alikes.end(), other), 1);
  }
}

/// A nuisance of which the shape of the effect depends is looked for at several values, one in s at those of the data.
TEST_P(EveryMechanism, IsLookedForAtSettingsThatItHas) {
  const auto& own = mechanism.parameters;
  for (const auto& setting : mechanism.scan) {
    ASSERT_FALSE(setting.empty());
    for (const auto& [name, value] : setting) {
      const auto parameter =
          std::find_if(own.begin() + 1, own.end(), [&, n = name](const Parameter& p) { return p.name == n; });
      const auto option = std::find_if(mechanism.options.begin(), mechanism.options.end(),
                                       [&, n = name](const Option& o) { return o.name == n; });
      ASSERT_TRUE(parameter != own.end() || option != mechanism.options.end()) << name;
      EXPECT_GE(value, parameter != own.end() ? parameter->min : *option->min);
      EXPECT_LE(value, parameter != own.end() ? parameter->max : *option->max);
    }
  }
  const bool shape = own.size() > 1 && own[1].unit != "s";
  EXPECT_EQ(mechanism.scan.size() > 1, shape || mechanism.id == "layered_wall");
}

TEST_P(EveryMechanism, IsSharedByTestsWhereItIsOfTubesAlone) {
  const auto& tests = mechanism.applies_to;
  const bool tubes = !tests.empty() && std::all_of(tests.begin(), tests.end(), [](const std::string& type) {
    return type.ends_with("pressurisation") || type == "torsion";
  });
  EXPECT_EQ(mechanism.shared, tubes || mechanism.id == "clamped_ends");  // strips go into the same clamps
  for (const std::string& type : tests) EXPECT_TRUE(testing::catalogue().tests().contains(type)) << type;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryMechanism, ::testing::ValuesIn([] {
                           std::vector<std::string> ids;
                           for (const auto& [id, side] : catalogued) ids.push_back(id);
                           return ids;
                         }()),
                         [](const auto& at) { return at.param; });

}  // namespace
}  // namespace tunica::catalogue_test
