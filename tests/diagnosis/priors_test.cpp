// SPDX-License-Identifier: Apache-2.0
// What a specialist would not try, and how large he would expect it to be: no fibres in rubber, amplitudes by the size
// of the data, what could hide.
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/hypotheses/amplitude_range.hpp"
#include "diagnosis/hypotheses/isotropy.hpp"
#include "diagnosis/hypotheses/places.hpp"
#include "diagnosis/measured.hpp"
#include "diagnosis/output/outputs.hpp"
#include "experiment/reader.hpp"
#include "plugins/guarded.hpp"

namespace tunica::trial {
namespace {

using diagnosis::Absence;
using diagnosis::Candidate;
using diagnosis::Diagnosis;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Isotropy, IsMeasuredOfEveryModelOfTheShelf) {
  const std::map<std::string, bool> isotropic{
      {"neo_hooke", true},    {"mooney_rivlin", true}, {"yeoh", true},
      {"gent", true},         {"ogden", true},         {"hgo", false},
      {"arruda_boyce", true}, {"fung", false},         {"holzapfel_ogden", false},
      {"gho", false},         {"four_fibre", false},   {"holzapfel_2015", false},
      {"hyperfoam", true},    {"blatz_ko", true},      {"composed", false}};  // with its default terms
  for (const auto& [type, entry] : testing::catalogue().models()) {
    ASSERT_TRUE(isotropic.contains(type)) << type;
    EXPECT_EQ(diagnosis::is_isotropic(*testing::make_model(type)), isotropic.at(type)) << type;
  }
}

TEST(Isotropy, IsLostWithFibresAndKeptWithoutThem) {
  for (const auto& [id, expected] :
       {std::pair{"axial_fibres", false}, std::pair{"circumferential_fibres", false}, std::pair{"active_tone", false},
        std::pair{"second_invariant", true}, std::pair{"stress_softening", true}, std::pair{"viscoelasticity", true}}) {
    const auto& entry = testing::catalogue().mechanisms().at(id);
    const auto model = plugins::wrap(entry, testing::make_model("yeoh"), testing::defaults(entry.factory.options));
    EXPECT_EQ(diagnosis::is_isotropic(*model), expected) << id;
    EXPECT_EQ(entry.factory.directional, !expected) << id;
  }
}

std::vector<Strip> two_strips(double size) {
  const auto stretch = testing::evenly(1.02, 2, 25);
  return {{.stretch = stretch, .sd = 2 * size}, {.name = "axial", .stretch = stretch, .sd = 2 * size}};
}

/// Two strips of rubber; stresses and noise in multiples of `size`.
struct Rubber : Measured {
  explicit Rubber(double size = 1) : Measured(two_strips(size)) {
    experiment["models"] = {{"rubber",
                             {{"type", "yeoh"},
                              {"parameters",
                               {{"c10", {{"min", 10 * size}, {"max", 1000 * size}, {"initial", 150 * size}}},
                                {"c20", {{"min", -20 * size}, {"max", 20 * size}, {"initial", -1 * size}}},
                                {"c30", {{"min", -2 * size}, {"max", 5 * size}, {"initial", 0.1 * size}}}}}}}};
    experiment["runs"] = {{{"model", "rubber"}, {"optimizer", "lm"}}};
  }
};

// Seed 5.
TEST(Priors, NoFibresAreProposedForRubberUnlessTheyAreAskedFor) {
  Rubber measured;
  measured.measure(5);
  const Diagnosis found = measured.diagnose();
  for (const char* id : {"axial_fibres", "circumferential_fibres", "active_tone", "fibre_dispersion",
                         "fibre_recruitment", "specimen_misalignment"}) {
    EXPECT_TRUE(candidate(found, id).hypotheses.empty()) << id;
    EXPECT_STREQ(code_of(candidate(found, id).absence), "isotropic") << id;
  }
  EXPECT_FALSE(candidate(found, "second_invariant").hypotheses.empty());
  measured.experiment["diagnosis"]["mechanisms"] = {"axial_fibres"};
  const Diagnosis asked = measured.diagnose();
  ASSERT_EQ(asked.analysis.hypotheses.candidates.size(), 1u);
  EXPECT_FALSE(candidate(asked, "axial_fibres").hypotheses.empty());
}

// Seed 5.
TEST(Priors, ClampsAreLookedForWhereTheFileSaysHowLongAndWideAStripIs) {
  Rubber measured;
  measured.measure(5);
  const Diagnosis found = measured.diagnose();
  EXPECT_TRUE(candidate(found, "clamped_ends").hypotheses.empty());
  EXPECT_STREQ(code_of(candidate(found, "clamped_ends").absence), "no_size");
  for (auto& test : measured.experiment["tests"]) test["length"] = "40 mm";
  measured.save();
  EXPECT_STREQ(code_of(candidate(measured.diagnose(), "clamped_ends").absence), "no_size");
  for (auto& test : measured.experiment["tests"]) test["width"] = "10 mm";
  measured.save();
  EXPECT_FALSE(candidate(measured.diagnose(), "clamped_ends").hypotheses.empty());
}

// Seed 5: nothing is wrong, a false alarm has 5 %.
TEST(Priors, OnlyWhatCouldApplyCanHide) {
  const Rubber measured;
  measured.measure(5);
  const Diagnosis found = measured.diagnose();
  const std::string words = in_one_line(diagnosis::summary(found).plain());
  ASSERT_THAT(words, HasSubstr("May hide: "));
  for (const char* id : {"axial_fibres", "fibre_dispersion", "pressure_offset", "residual_stress", "layered_wall"})
    EXPECT_THAT(words, Not(HasSubstr(id)));
  EXPECT_THAT(words, HasSubstr("viscoelasticity"));  // the data have no time, but the rubber has
}

// Seed 5.
TEST(Priors, ASetIsLookedForWhereTheLoadIsTakenOff) {
  const Rubber measured;
  measured.measure(5);
  const Diagnosis up = measured.diagnose();
  EXPECT_TRUE(candidate(up, "permanent_set").hypotheses.empty());
  EXPECT_EQ(candidate(up, "permanent_set").absent, "no test takes the load off again");
  std::vector<double> loop = testing::evenly(1.02, 2, 15);
  for (std::size_t i = 14; i-- > 0;) loop.push_back(loop[i]);
  const Measured cyclic({{.stretch = loop}});
  cyclic.measure(5);
  const Diagnosis back = cyclic.diagnose();
  EXPECT_FALSE(candidate(back, "permanent_set").hypotheses.empty());
}

// The same data in another unit of stress: what is counted in it has other ranges, what is not has the same. Seed 5.
TEST(Priors, AmplitudesInUnitsOfStressFollowTheDataAndOthersDoNot) {
  std::map<std::string, diagnosis::AmplitudeRange> small;
  constexpr double size = 40;
  for (const double times : {1.0, size}) {
    const Rubber measured(times);
    measured.measure(5);
    const Diagnosis found = measured.diagnose();
    for (const Candidate& one : found.analysis.hypotheses.candidates) {
      if (one.hypotheses.empty()) continue;
      const auto range = diagnosis::range_of(*one.mechanism, one.hypotheses.front().addition);
      if (times == 1) {
        small.emplace(one.id, range);
        continue;
      }
      ASSERT_TRUE(small.contains(one.id)) << one.id;
      const auto& of_channel = one.hypotheses.front().addition.place.channel;
      const double expected = one.mechanism->parameters.front().unit == "kPa" || !of_channel.empty() ? size : 1;
      EXPECT_NEAR(range.max, expected * small.at(one.id).max, 2e-3 * std::abs(range.max)) << one.id;
      EXPECT_NEAR(range.plausible_max, expected * small.at(one.id).plausible_max, 2e-3 * range.plausible_max) << one.id;
    }
  }
  EXPECT_TRUE(small.contains("second_invariant"));
  EXPECT_TRUE(small.contains("force_offset"));
  EXPECT_TRUE(small.contains("outliers"));
}

// W = c2 (I2 − 3) adds σ = 2 c2 (λ − 1/λ²) in uniaxial tension: at the largest stretch twice the range of what is
// measured is the largest plausible c2. Seed 5.
TEST(Priors, ThePlausibleSecondInvariantIsThatOfTheClosedForm) {
  Rubber measured;
  measured.measure(5);
  const Diagnosis found = measured.diagnose();
  double least = INFINITY;
  for (const auto& view : found.analysis.evidence.base->layout().channels) {
    const auto [low, high] = std::minmax_element(view.measured.begin(), view.measured.end());
    least = std::min(least, *high - *low);
  }
  const double stretch = 2, by_c2 = 2 * (stretch - 1 / (stretch * stretch));
  const auto& addition = candidate(found, "second_invariant").hypotheses.front().addition;
  ASSERT_TRUE(addition.range);
  EXPECT_NEAR(addition.range->plausible_max, 2 * least / by_c2, 1e-6 * least);
  EXPECT_NEAR(addition.range->max, 5 * addition.range->plausible_max, 1e-9 * addition.range->max);
  EXPECT_EQ(addition.range->min, 0);
}

// A second invariant of 300 kPa, three times what the mechanism declares as its bound. Seed 6; sigma 2 kPa of 1600 kPa.
TEST(Priors, AnExtensionHasTheBoundsThatTheDataAllow) {
  Rubber measured;
  measured.measure(6, [](json& truth) {
    truth["models"]["rubber"]["mechanisms"] = {
        {{"type", "second_invariant"}, {"parameters", {{"c2", {{"max", 1000}, {"initial", 300}}}}}}};
  });
  measured.experiment["diagnosis"]["mechanisms"] = {"second_invariant"};
  const Diagnosis found = measured.diagnose();
  ASSERT_FALSE(found.explanation.claim.causes.empty());
  const diagnosis::Amplitude& amplitude = found.explanation.claim.causes.front().amplitude;
  EXPECT_FALSE(amplitude.at_bound);
  EXPECT_TRUE(amplitude.plausible);
  EXPECT_LT(amplitude.low, 300);
  EXPECT_GT(amplitude.high, 300);
  const json extended = json::parse(diagnosis::extended_experiment(found, testing::catalogue()));
  const json& c2 = extended["models"]["rubber"]["mechanisms"][0]["parameters"]["c2"];
  EXPECT_GT(c2["max"].get<double>(), 300);
  EXPECT_NEAR(c2["initial"].get<double>(), amplitude.value, 1e-9 * amplitude.value);
}

TEST(Priors, TwoOfAKindHaveParametersOfTheirOwn) {
  Rubber measured;
  measured.experiment["models"]["rubber"]["mechanisms"] = {{{"type", "viscoelasticity"}}};
  const experiment::Experiment file = measured.read();
  diagnosis::Addition second{"viscoelasticity", {}, {{"tau", 50.0}}};
  second.as = "viscoelasticity_2";
  const diagnosis::Extension extended(file, file.runs.front(), {second}, testing::catalogue());
  std::vector<std::string> names;
  for (const auto& parameter : extended.assembly().layout().parameters) names.push_back(parameter.name);
  EXPECT_THAT(names, ::testing::ElementsAre("c10", "c20", "c30", "viscoelasticity.g", "viscoelasticity.tau",
                                            "viscoelasticity_2.g", "viscoelasticity_2.tau"));
  EXPECT_EQ(extended.parts().front().amplitude, diagnosis::Variable{5});
  EXPECT_EQ(extended.parts().front().nuisance_start.front(), 50);
  const std::string text = experiment::write_input(extended.experiment(), testing::catalogue());
  EXPECT_EQ(json::parse(text)["models"]["rubber"]["mechanisms"][1]["as"], "viscoelasticity_2");
}

TEST(Priors, EveryMechanismBelongsToTheMaterialOrToTheRig) {
  std::map<std::string, std::string> groups;
  for (const auto& [id, entry] : testing::catalogue().mechanisms())
    groups[id] = code_of(diagnosis::group_of(entry.factory));
  for (const char* id : {"stress_softening", "viscoelasticity", "permanent_set", "residual_stress", "layered_wall",
                         "tethering", "axial_fibres", "active_tone", "stiffer_half"})
    EXPECT_EQ(groups.at(id), "material") << id;
  for (const char* id :
       {"force_offset", "signal_drift", "outliers", "geometry_error", "axial_stretch_error", "specimen_misalignment",
        "reference_length_error", "pressure_offset", "clamp_slip", "grip_tilt", "oblique_pull", "thickness_gradient"})
    EXPECT_EQ(groups.at(id), "rig") << id;
}

}  // namespace
}  // namespace tunica::trial
