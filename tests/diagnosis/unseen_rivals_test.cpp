// SPDX-License-Identifier: Apache-2.0
// Which look-alikes a drift of a sensor has that some tests could not show.
#include "diagnosis/naming/unseen_rivals.hpp"

#include <gmock/gmock.h>

#include "support/loaded.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A strip of the media with a clock, and tubes whose past is unknown: of both layers, and of the adventitia alone.
struct UnseenRivals : ::testing::Test {
  UnseenRivals() {
    Evidence& evidence = analysis.evidence;
    evidence.run.tests = {"strip", "wall", "outside"};
    evidence.run.model = "media";
    for (const std::string& name : evidence.run.tests) {
      evidence.experiment.tests.emplace_back();
      evidence.experiment.tests.back().name = name;
    }
    evidence.experiment.tests[1].layers = {{"media", 0.5}, {"adventitia", 0.3}};
    evidence.experiment.tests[2].layers = {{"adventitia", 0.3}};
    Candidate memory;
    memory.id = "viscoelasticity";
    memory.mechanism = &testing::catalogue().mechanisms().at("viscoelasticity").factory;
    memory.absence = Absence::none;
    analysis.hypotheses.candidates = {memory};
  }
  [[nodiscard]] std::vector<std::string> of_a_drift(const std::string& without_past) {
    analysis.hypotheses.candidates.front().without_past = {without_past};
    return unseen_rivals({experiment, request, testing::catalogue(), progress}, analysis, "signal_drift", {{"strip"}});
  }
  experiment::Experiment experiment;
  Request request;
  Progress progress;
  Analysis analysis;
};

TEST_F(UnseenRivals, AreCountedOverTestsOfTheMaterialThatTheSensorMeasures) {
  EXPECT_THAT(of_a_drift("wall"), ElementsAre("viscoelasticity"));
  EXPECT_THAT(of_a_drift("outside"), IsEmpty()) << "its memory is another material's";
}

}  // namespace
}  // namespace tunica::diagnosis
