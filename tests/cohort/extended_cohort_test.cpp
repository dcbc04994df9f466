// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cohort/diagnosis_study.hpp"
#include "cohort/files.hpp"
#include "experiment/reader.hpp"
#include "support/loaded.hpp"

namespace tunica::cohort {
namespace {

using testing::CohortFiles;

/// Two strips of one tissue: a cause may act in the tissue, in one strip, in one row of it, or alike in both.
constexpr const char* two_strips = R"({
  "format": 1,
  "models": { "tissue": { "type": "hgo" } },
  "tests": {
    "along": { "type": "uniaxial", "direction": "circumferential", "data": { "file": "a.csv",
      "columns": { "stretch": "stretch", "stress": "stress" }, "stress_measure": "cauchy" } },
    "across": { "type": "uniaxial", "direction": "axial", "data": { "file": "a.csv",
      "columns": { "stretch": "stretch", "stress": "stress" }, "stress_measure": "cauchy" } }
  },
  "optimizers": { "lm": { "type": "ceres_lm" } },
  "runs": [ { "model": "tissue", "optimizer": "lm" } ]
})";

constexpr const char* cohort_of_strips = R"({
  "format": 1,
  "experiment": "strip.json",
  "specimens": "specimens.csv",
  "bind": { "/tests/along/data/file": "{id}.csv", "/tests/across/data/file": "{id}.csv" }
})";

/// The experiment that names this cause with this mean amplitude, read as a user would run it.
experiment::Experiment extended_by(const std::string& id, diagnosis::Place place, double mean) {
  CohortFiles files{cohort_of_strips, two_strips};
  (void)files.folder.write("a.csv", "stretch,stress [kPa]\n1,0\n1.1,20\n1.2,60\n");
  const Specification cohort = files.read();
  DiagnosisStudy study;
  study.verdict.verdict = diagnosis::Verdict::named;
  study.verdict.named = 1;
  study.verdict.explanations.push_back({{id}, {std::move(place)}, {{}}});
  study.verdict.amplitudes.push_back({"amplitude", "1", mean, mean / 2, 2 * mean, 0.1 * mean});
  extend(cohort, testing::catalogue(), study);
  return experiment::read_experiment(files.folder.write("extended.json", study.extended), testing::catalogue());
}

const experiment::ParameterSetting& amplitude_of(const experiment::MechanismEntry& entry) {
  const std::string& name = testing::catalogue().mechanisms().at(entry.type).factory.parameters.front().name;
  return entry.parameters.at(name);
}

const experiment::MechanismEntry& only_mechanism(const experiment::Experiment& experiment, const std::string& test) {
  for (const auto& entry : experiment.tests)
    if (entry.name == test && entry.mechanisms.size() == 1) return entry.mechanisms.front();
  throw std::runtime_error("the test '" + test + "' has no mechanism, or several");
}

TEST(ExtendedCohort, HasACauseOfTheMaterialInItsModel) {
  const auto experiment = extended_by("fibre_dispersion", {{}}, 0.1);
  ASSERT_EQ(experiment.models.front().mechanisms.size(), 1U);
  EXPECT_EQ(amplitude_of(experiment.models.front().mechanisms.front()).initial, 0.1);
  for (const auto& test : experiment.tests) EXPECT_TRUE(test.mechanisms.empty());
}

TEST(ExtendedCohort, HasACauseOfOneTestThere) {
  const auto experiment = extended_by("force_offset", {{"across"}, "stress"}, 2.5);
  for (const auto& test : experiment.tests) EXPECT_EQ(test.mechanisms.size(), test.name == "across" ? 1U : 0U);
  EXPECT_TRUE(experiment.models.front().mechanisms.empty());
}

TEST(ExtendedCohort, HasACauseOfOneRowThere) {
  const auto experiment = extended_by("outliers", {{"along"}, "stress", 1, "", 1}, 2.5);
  EXPECT_EQ(only_mechanism(experiment, "along").options.text("rows"), "1:2:1");
}

TEST(ExtendedCohort, SharesOneAmplitudeBetweenTests) {
  const auto experiment = extended_by("force_scale_error", {{"along", "across"}, "stress"}, 0.05);
  for (const auto& test : experiment.tests) {
    ASSERT_EQ(test.mechanisms.size(), 1U);
    EXPECT_TRUE(amplitude_of(test.mechanisms.front()).share.has_value()) << test.name;
  }
}

// A stress may be read wrongly by more than the bounds of the mechanism, which know no specimen.
TEST(ExtendedCohort, GivesAnErrorOfAChannelRoom) {
  const auto experiment = extended_by("force_offset", {{"across"}, "stress"}, 250);
  const auto& amplitude = amplitude_of(only_mechanism(experiment, "across"));
  EXPECT_EQ(amplitude.initial, 250);
  EXPECT_GT(amplitude.max, 1000);
  EXPECT_LT(amplitude.min, -1000);
}

}  // namespace
}  // namespace tunica::cohort
