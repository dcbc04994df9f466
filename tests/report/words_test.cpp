// SPDX-License-Identifier: Apache-2.0
// What the first screen says.
#include <gmock/gmock.h>

#include "report/pieces.hpp"
#include "report/report.hpp"
#include "scratch.hpp"

using namespace tunica;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

std::string page_of(const trial::Scratch& scratch, const char* result) {
  // Pages of words need no more of a format than that there is one.
  scratch.write("result.json", R"({"format": 1, )" + std::string(result).substr(1));
  return report::report({scratch.path()}, scratch.path());
}

const char* const held_out = R"({
  "warnings": ["m/a: far off", "m/a: k = 1 lies at a bound", "m/b: k = 1 lies at a bound",
               "m/b: k = 1 lies at a bound and more", "data: are noisy"],
  "warning_details": [{"kind": "predicts_worse", "run": "m/a", "sentence": "far off"},
                      {"kind": "at_bound", "run": "m/a", "subjects": ["k"], "sentence": "k = 1 lies at a bound"},
                      {"kind": "at_bound", "run": "m/b", "subjects": ["k"], "sentence": "k = 1 lies at a bound"},
                      {"kind": "at_bound", "run": "m/b", "subjects": ["k"], "sentence": "k = 1 lies at a bound and more"},
                      {"kind": "set_up", "run": null, "sentence": "data: are noisy"}],
  "runs": [{"run": "m/a", "model": "m", "optimizer": "a", "tests": ["in_vivo", "unseen"], "realisations": 1,
            "objective_type": "least_squares",
            "best": {"objective": 1, "status": "ok", "hold_out": [{"channel": "d", "verdict": "worse_than_fitted"}], "parameters": {"k": {"value": 1, "at_bound": "lower"}},
                     "per_test": {"in_vivo": {"channels": [{"channel": "d", "unit": "mm", "r2": 0.9, "rmse": 0.1},
                                                           {"channel": "f", "unit": "mN", "r2": 0.8, "rmse": 2},
                                                           {"channel": "p", "unit": "kPa", "r2": 0.7, "rmse": 3},
                                                           {"channel": "q", "unit": "kPa", "r2": 0.6, "rmse": 4}]},
                                  "unseen": {"channels": [{"channel": "d", "unit": "mm", "r2": -3, "rmse": 0.5,
                                                           "held_out": true}]}}}},
           {"run": "m/b", "model": "m", "optimizer": "b", "best": {"objective": 2}}],
  "ranking": [{"run": "m/a", "rank": 1, "group": "least_squares on in_vivo, unseen"},
              {"run": "m/b", "rank": 1, "group": "other on in_vivo"}]})";

const char* const named = R"({"provenance": {"seed": 3}, "diagnosis": {"verdict": "named",
  "causes": [{"id": "crimp", "amplitude": {"name": "stretch", "value": 1.2},
              "parameter_shifts": [{"parameter": "mu", "unit": "kPa", "without": 10, "with": 11}]},
             {"id": "second", "amplitude": {"name": "k", "value": 1},
              "parameter_shifts": [{"parameter": "mu", "unit": "kPa", "without": 10, "with": 11},
                                   {"parameter": "k1", "unit": "kPa", "without": 0.05, "with": 0.7}]}],
  "noise": [{"test": "strip", "channel": "stress"}, {"test": "strip", "channel": "force"}],
  "base": {"model": "hgo", "rows": 100, "squares": 400, "parameters": {"mu": {"value": 10, "unit": "kPa"}}},
  "scores": [{"id": "other", "score": 5, "p_value": 0.02, "target": null}, {"id": "crimp", "score": 0, "p_value": 1}],
  "ranking": [{"id": "crimp", "probability": 1, "score": 0, "gain": 70, "target": null},
              {"id": "other", "probability": 0, "score": 5, "gain": -4e-9, "target": {"test": "strip"}}]}})";

}  // namespace

TEST(Words, SayAWarningOfSeveralRunsOnce) {
  const trial::Scratch scratch;
  const std::string page = page_of(scratch, held_out);
  EXPECT_THAT(page, HasSubstr("<li>m/a and m/b: k = 1 lies at a bound</li>"));
  EXPECT_THAT(page, HasSubstr("<li>m/b: k = 1 lies at a bound and more</li>"));
  EXPECT_THAT(page, HasSubstr("4 warnings"));
}

TEST(Words, KeepApartWhatWasFittedAndWhatWasHeldOut) {
  const trial::Scratch scratch;
  const std::string page = page_of(scratch, held_out);
  EXPECT_THAT(page, HasSubstr("Best of least_squares on in_vivo (one test held out)"));
  EXPECT_THAT(page, HasSubstr("Fitted: 4 curves, the worst R² 0.6 in in_vivo (q, RMSE 4 kPa), the best R² 0.9 in "
                              "in_vivo (d, RMSE 0.1 mm)."));
  EXPECT_THAT(page, HasSubstr("Held out: R² -3 in unseen (d, RMSE 0.5 mm)."));
  EXPECT_THAT(
      page,
      HasSubstr("R² is only 0.6 in the worst curve; the run fits better than it predicts what was held out; k lies "
                "at a bound."));
  EXPECT_THAT(page,
              HasSubstr("Fit more of the tests together, or take a model with fewer parameters. Widen the bounds"));
}

TEST(Words, DoubtTheNoiseThatIsTooLargeForARun) {
  const trial::Scratch scratch;
  const auto page_with = [&](const std::string& run) {
    const std::string result = R"({"warning_details": [{"kind": "noise_too_large", "run": ")" + run + R"(",
      "sentence": "small"}], "runs": [{"run": "m/a", "model": "m", "optimizer": "a", "best": {"objective": 2}}],
      "ranking": [{"run": "m/a", "rank": 1, "group": "g"}]})";
    return page_of(scratch, result.c_str());
  };
  const char* const doubt = "The rows scatter far less than the stated noise says.";
  EXPECT_THAT(page_with("m/a"), HasSubstr(doubt));
  EXPECT_THAT(page_with("m/b"), Not(HasSubstr(doubt)));
}

TEST(Words, OfAnOlderResultAreTakenFromItsFiguresNotFromItsSentences) {
  const trial::Scratch scratch;
  const char* const older = R"({"warnings": ["m/a: k lies at a bound", "m/b: k lies at a bound"],
    "runs": [{"run": "m/a", "best": {"objective": 2, "certificate": {"verdict": "in any words",
      "fresh_process": {"objective": 2}, "neighbours": {"better": true, "lowest": {"objective": 1.9}}}}}],
    "ranking": [{"run": "m/a", "rank": 1, "group": "g"}]})";
  const std::string page = page_of(scratch, older);
  EXPECT_THAT(page, HasSubstr("A neighbouring point is better, so this is not an optimum."));
  EXPECT_THAT(page, HasSubstr("<li>m/a: k lies at a bound</li><li>m/b: k lies at a bound</li>"));
}

TEST(Words, TakeTheProfileForTheIntervalWhereThereIsOne) {
  const trial::Scratch scratch;
  const std::string page = page_of(scratch, R"({
    "runs": [{"run": "m/a", "model": "m", "optimizer": "a", "best": {"objective": 1, "parameters": {
      "closed": {"value": 1, "unit": "kPa", "min": 0, "max": 9, "ci95": [0, 4], "ci95_reliable": false, "profile_ci95": [0.5, 2]},
      "half": {"value": 1, "unit": "1", "min": 0, "max": 9, "ci95": null, "profile_ci95": [null, 2]},
      "rough": {"value": 1, "unit": "1", "min": 0, "max": 9, "ci95": [0, 4], "ci95_reliable": false}},
      "uncertainty": ["profiles are of normal noise"]}}],
    "ranking": [{"run": "m/a", "rank": 1, "group": "g"}]})");
  EXPECT_THAT(page, HasSubstr("The data limit half on one side only; the interval of rough is rough."));
  EXPECT_THAT(page, HasSubstr("Run tunica run EXPERIMENT --profiles rough."));
  EXPECT_THAT(page, HasSubstr(">95 %, linearised</th><th scope=\"col\">95 %, profile</th>"));
  EXPECT_THAT(page, HasSubstr(">0 … 4 (rough)</td><td class=\"\">0.5 … 2</td>"));
  EXPECT_THAT(page, HasSubstr(">open … 2</td>"));
  EXPECT_THAT(page, HasSubstr("<li>Profiles are of normal noise.</li>"));
}

namespace {

std::string page_with(const trial::Scratch& scratch, const std::string& best) {
  return page_of(scratch, (R"({"runs": [{"run": "m/a", "model": "m", "optimizer": "a", "best": {"objective": 1,
    "parameters": {"mu": {"value": 1, "unit": "kPa", "ci95": [0, 2]}}, )" +
                           best + R"(}}], "ranking": [{"run": "m/a", "rank": 1, "group": "g"}]})")
                              .c_str());
}

}  // namespace

TEST(Words, DoNotSayUseItWhereTheMisfitContradictsTheNoise) {
  const trial::Scratch scratch;
  const std::string stated = page_with(scratch, R"("misfit": {"chi_square": 4538, "rows": 514, "reduced_chi_square": 9,
    "times_the_noise": 3, "contradicts_noise": true})");
  EXPECT_THAT(stated, HasSubstr("The model misses the data by 3 times the noise (χ²/ν 9)."));
  EXPECT_THAT(stated, HasSubstr("Run tunica diagnose EXPERIMENT."));
  EXPECT_THAT(stated, HasSubstr("χ²/ν 9 against the stated noise (χ² 4538, 514 rows)."));
  EXPECT_THAT(stated, Not(HasSubstr("Use it")));
  EXPECT_THAT(stated, Not(HasSubstr("Nothing was found")));
  const std::string estimated = page_with(scratch, R"("misfit": null, "misfit_estimated": {"chi_square": 4538,
    "rows": 514, "reduced_chi_square": 9, "times_the_noise": 3, "contradicts_noise": true})");
  EXPECT_THAT(estimated, HasSubstr("3 times the noise that is estimated from the rows (χ²/ν 9)"));
  EXPECT_THAT(estimated, Not(HasSubstr("Use it")));
}

TEST(Words, SayUseItWhereTheNoiseExplainsTheMisfitOrTheCurvesAreClose) {
  const trial::Scratch scratch;
  EXPECT_THAT(page_with(scratch, R"("misfit": {"chi_square": 510, "rows": 514, "reduced_chi_square": 1,
    "times_the_noise": 1, "contradicts_noise": false})"),
              HasSubstr("Use it"));
  EXPECT_THAT(page_with(scratch, R"("per_test": {"t": {"channels": [{"channel": "d", "unit": "mm", "r2": 0.99}]}})"),
              HasSubstr("Use it"));
  const std::string poor =
      page_with(scratch, R"("per_test": {"t": {"channels": [{"channel": "d", "unit": "mm", "r2": 0.7}]}})");
  EXPECT_THAT(poor, HasSubstr("R² is only 0.7 in the worst curve"));
  EXPECT_THAT(poor, Not(HasSubstr("Use it")));
}

TEST(Words, OfADiagnosisBeginWithWhatWasFitted) {
  const trial::Scratch scratch;
  const std::string page = page_of(scratch, named);
  EXPECT_THAT(page,
              HasSubstr("hgo to strip, 100 values, seed 3: mu = 10 kPa. Root mean square of residual over noise: 2."));
}

// The reader stands where the folder was named, and not in it.
TEST(Words, OfCommandsNameFilesByTheWayToThem) {
  const trial::Scratch scratch;
  const std::string there = scratch.path().string();
  const std::string diagnosis = page_of(scratch, R"({"diagnosis": {"verdict": "named",
    "extension": {"experiment": "extended.json", "mechanisms": [{"type": "crimp"}]}}})");
  EXPECT_THAT(diagnosis, HasSubstr("tunica run " + there + "/extended.json fits the model with the cause added."));
  const std::string discovered = page_of(scratch, R"({"diagnosis": {"verdict": "discovered"}})");
  EXPECT_THAT(discovered, HasSubstr("tunica run " + there + "/extended.json fits the model with the terms added."));
  const std::string run = page_with(scratch, R"("misfit": null)");
  EXPECT_THAT(run, HasSubstr("tunica simulate EXPERIMENT --model m --parameters " + there + "/result.json -o FOLDER"));
}

TEST(Words, OfASimulationSayWhatWasSimulated) {
  const trial::Scratch scratch;
  scratch.write("tube.csv", "pressure [kPa],diameter [1]\n0,1\n1,2\n");
  scratch.write("simulation.json", R"({"name": "aorta", "model": "gho", "tests": ["tube"], "seed": 3, "noise": 0.02,
      "parameters": {"mu": {"value": 18.7, "unit": "kPa"}, "tube.error": {"value": 0, "unit": "1"}}, "source": "run 'gho/lm' of a/result.json", "origin": "run 'gho/lm' of a/result.json: mu = 18.7 kPa"})");
  const std::string page = report::report({scratch.path()}, scratch.path());
  for (const char* text : {"<h1>aorta: simulation</h1>", "gho in tube", "mu = 18.7 kPa", "2 % of every value, seed 3",
                           "run &#39;gho/lm&#39; of a/result.json<"})
    EXPECT_THAT(page, HasSubstr(text));
  EXPECT_THAT(page, Not(HasSubstr("tube.error")));
}

TEST(Words, OfParametersThatTwoCausesShiftTogetherStandOnce) {
  const trial::Scratch scratch;
  const std::string page = page_of(scratch, named);
  EXPECT_THAT(page, HasSubstr(">crimp and second</td><td class=\"\">mu [kPa]</td>"));
  EXPECT_THAT(page, HasSubstr(">+10 %</td>"));
  EXPECT_THAT(page, HasSubstr(">× 14</td>"));
}

TEST(Words, PutTheCauseThatTakesMostFirst) {
  const trial::Scratch scratch;
  const std::string page = page_of(scratch, named);
  EXPECT_THAT(page, HasSubstr(R"("labels":["crimp","other in strip"])"));
  EXPECT_THAT(page, HasSubstr(R"("note":"gain 70")"));
  EXPECT_THAT(page, Not(HasSubstr("-4e-09")));
}
