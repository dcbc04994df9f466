// SPDX-License-Identifier: Apache-2.0
// Numbers of the shelf that experiment files and diagnoses rest on: bounds are those that a file may set an amplitude
// to, start and plausible range are where a search begins and what a report calls plausible.
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelf.hpp"

namespace tunica::testing::declarations_test {
namespace {

using ::testing::ElementsAre;
using Setting = MechanismFactory::Setting;

const MechanismFactory& declared(const std::string& id) { return catalogue().mechanisms().at(id).factory; }

/// Of the amplitude; `effect` is the plausible effect in ranges of the data, 0 where the range itself says it.
struct Amplitude {
  const char* id;
  double null, start, min, max, plausible_min, plausible_max, effect;
};

class DeclaredAmplitude : public ::testing::TestWithParam<Amplitude> {};

TEST_P(DeclaredAmplitude, HasTheRangesOfTheCatalogue) {
  const Amplitude& expected = GetParam();
  const MechanismFactory& mechanism = declared(expected.id);
  const Parameter& amplitude = mechanism.parameters.front();
  EXPECT_DOUBLE_EQ(mechanism.null, expected.null);
  EXPECT_DOUBLE_EQ(amplitude.initial, expected.start);
  EXPECT_DOUBLE_EQ(amplitude.min, expected.min);
  EXPECT_DOUBLE_EQ(amplitude.max, expected.max);
  EXPECT_DOUBLE_EQ(mechanism.plausible_min, expected.plausible_min);
  EXPECT_DOUBLE_EQ(mechanism.plausible_max, expected.plausible_max);
  EXPECT_DOUBLE_EQ(mechanism.plausible_effect, expected.effect);
}

INSTANTIATE_TEST_SUITE_P(
    Catalogue, DeclaredAmplitude,
    ::testing::Values(
        Amplitude{"fibre_dispersion", 0, 0.1, 0, 1. / 3, 0, 1. / 3, 0},
        Amplitude{"axial_fibres", 0, 1, 0, 100, 0, 50, 2}, Amplitude{"circumferential_fibres", 0, 1, 0, 100, 0, 50, 2},
        Amplitude{"second_invariant", 0, 1, 0, 100, 0, 50, 2}, Amplitude{"active_tone", 0, 1, 0, 200, 0, 100, 1},
        Amplitude{"matrix_stiffening", 0, 0.1, 0, 20, 0, 5, 0},
        Amplitude{"chain_extensibility", 0, 0.01, 0, 0.3, 0, 0.2, 0},
        Amplitude{"fibre_recruitment", 1, 1.05, 1, 2, 1, 1.5, 0},
        Amplitude{"stress_softening", 0, 0.2, 0, 1, 0, 0.8, 0}, Amplitude{"damage", 0, 0.3, 0, 1, 0, 0.9, 0},
        Amplitude{"viscoelasticity", 0, 0.3, 0, 10, 0, 3, 0}, Amplitude{"permanent_set", 0, 0.1, 0, 0.9, 0, 0.6, 0},
        Amplitude{"residual_stress", 0, 0, -90, 330, -60, 300, 0},
        Amplitude{"axial_stretch_error", 0, 0, -0.2, 0.2, -0.1, 0.1, 0}, Amplitude{"tethering", 0, 0, 0, 100, 0, 40, 0},
        Amplitude{"layered_wall", 1, 1, 0.1, 10, 0.1, 10, 0},
        Amplitude{"geometry_error", 0, 0, -0.5, 0.5, -0.3, 0.3, 0},
        Amplitude{"specimen_misalignment", 0, 0, -15, 15, -10, 10, 0},
        Amplitude{"pressure_offset", 0, 0, -5, 5, -2, 2, 0},
        Amplitude{"pressure_scale_error", 0, 0, -0.5, 0.5, -0.2, 0.2, 0},
        Amplitude{"reference_length_error", 0, 0, -0.2, 0.2, -0.1, 0.1, 0},
        Amplitude{"force_offset", 0, 0, -50, 50, -10, 10, 0.2},
        Amplitude{"force_scale_error", 0, 0, -0.5, 1, -0.2, 0.2, 0},
        Amplitude{"axial_force_offset", 0, 0, -1000, 1000, -100, 100, 0.2},
        Amplitude{"axial_force_scale_error", 0, 0, -0.5, 1, -0.2, 0.2, 0},
        Amplitude{"diameter_scale_error", 0, 0, -0.2, 0.2, -0.1, 0.1, 0},
        Amplitude{"signal_drift", 0, 0, -1000, 1000, -100, 100, 0}, Amplitude{"clamp_slip", 0, 0, 0, 0.5, 0, 0.2, 0},
        Amplitude{"grip_tilt", 0, 0, -0.5, 0.5, -0.2, 0.2, 0}, Amplitude{"oblique_pull", 0, 0, -20, 20, -10, 10, 0},
        Amplitude{"thickness_gradient", 0, 0, -1, 1, -0.4, 0.4, 0},
        Amplitude{"stiffer_half", 0, 0, -0.8, 0.8, -0.5, 0.5, 0},
        Amplitude{"outliers", 0, 0, -1000, 1000, -100, 100, 0}),
    [](const auto& at) { return std::string(at.param.id); });

/// Where the nuisance parameter begins, and how far it goes.
TEST(DeclaredNuisance, HasTheRangesOfTheCatalogue) {
  const std::map<std::string, std::vector<double>> expected{{"axial_fibres", {1, 0.001, 100}},
                                                            {"circumferential_fibres", {1, 0.001, 100}},
                                                            {"stress_softening", {0.5, 0.01, 10}},
                                                            {"viscoelasticity", {10, 0.001, 100000}}};
  for (const auto& [id, numbers] : expected) {
    const Parameter& nuisance = declared(id).parameters.at(1);
    EXPECT_THAT(numbers, ElementsAre(nuisance.initial, nuisance.min, nuisance.max)) << id;
    EXPECT_EQ(nuisance.scale, Scale::log) << id;
  }
}

/// A shape is looked for at settings over the orders of magnitude that it is seen at.
TEST(DeclaredScan, IsThatOfTheCatalogue) {
  const auto k2 = [](double value) { return Setting{{"k2", value}}; };
  const auto m = [](double value) { return Setting{{"m", value}}; };
  const auto interface = [](double value) { return Setting{{"layer_interface", value}}; };
  for (const char* id : {"axial_fibres", "circumferential_fibres"})
    EXPECT_THAT(declared(id).scan, ElementsAre(k2(0.01), k2(0.3), k2(1), k2(10))) << id;
  EXPECT_THAT(declared("stress_softening").scan, ElementsAre(m(0.1), m(0.5), m(2)));
  EXPECT_THAT(declared("layered_wall").scan, ElementsAre(interface(0.5), interface(2. / 3)));
  const auto along = [](double value) { return Setting{{"direction", value}}; };
  for (const char* id : {"thickness_gradient", "stiffer_half"})
    EXPECT_THAT(declared(id).scan, ElementsAre(along(0), along(45), along(90), along(135))) << id;
}

/// Fibres and muscle have a direction, and so has the cut of a strip; a matrix and a rig have none.
TEST(DeclaredDirection, IsThatOfWhatHasFibres) {
  for (const char* id : {"axial_fibres", "circumferential_fibres", "active_tone", "fibre_dispersion",
                         "fibre_recruitment", "specimen_misalignment"})
    EXPECT_TRUE(declared(id).directional) << id;
  for (const char* id : {"second_invariant", "matrix_stiffening", "chain_extensibility", "stress_softening",
                         "viscoelasticity", "force_offset", "tethering"})
    EXPECT_FALSE(declared(id).directional) << id;
}

TEST(DeclaredStage, IsWhereTheMechanismActs) {
  const std::map<Stage, std::vector<std::string>> stages{
      {Stage::invariants, {"fibre_dispersion", "fibre_recruitment"}},
      {Stage::energy,
       {"axial_fibres", "circumferential_fibres", "second_invariant", "active_tone", "matrix_stiffening",
        "chain_extensibility"}},
      {Stage::history, {"damage", "stress_softening", "viscoelasticity"}},
      {Stage::test,
       {"permanent_set",
        "residual_stress",
        "axial_stretch_error",
        "tethering",
        "layered_wall",
        "geometry_error",
        "specimen_misalignment",
        "pressure_offset",
        "pressure_scale_error",
        "reference_length_error",
        "force_offset",
        "force_scale_error",
        "axial_force_offset",
        "axial_force_scale_error",
        "diameter_scale_error",
        "signal_drift",
        "displacement_offset",
        "zeroed_at_preload",
        "machine_compliance",
        "sheet_prestretch",
        "sheet_force_offset",
        "sheet_force_scale_error",
        "channel_lag",
        "clamped_ends",
        "clamp_slip",
        "grip_tilt",
        "oblique_pull",
        "thickness_gradient",
        "stiffer_half"}},
      {Stage::data, {"outliers"}}};
  for (const auto& [stage, ids] : stages)
    for (const std::string& id : ids) EXPECT_EQ(declared(id).stage, stage) << id;
}

/// Of these a row depends on the rows before it, beside those of the stage that says so by itself.
TEST(DeclaredMemory, IsThatOfWhatGoesByTheOrderOfRows) {
  std::vector<std::string> remembering;
  for (const auto& [id, entry] : catalogue().mechanisms())
    if (entry.factory.memory) remembering.push_back(id);
  EXPECT_THAT(remembering, ElementsAre("channel_lag", "permanent_set", "signal_drift"));
}

}  // namespace
}  // namespace tunica::testing::declarations_test
