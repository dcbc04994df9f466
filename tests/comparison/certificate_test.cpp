// SPDX-License-Identifier: Apache-2.0
#include "comparison/certificate.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "comparison/certify.hpp"
#include "comparison/estimate.hpp"
#include "comparison/result_json.hpp"
#include "execution/folder.hpp"
#include "execution/laboratory.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using comparison::Certificate;
using comparison::CertificateVerdict;
using ::testing::HasSubstr;

namespace {

Certificate spotless() {
  Certificate certificate;
  search::Neighbourhood around;
  around.objective = 66.1;
  around.lowest = {66.2, 1e-5, "mu", {}};
  certificate.fresh = {around, 0, true};
  certificate.realisations = 100;
  certificate.agreeing = 97;
  return certificate;
}

Certificate judged(Certificate certificate) {
  comparison::judge(certificate);
  return certificate;
}

std::string sentence(const Certificate& certificate) { return judged(certificate).sentence; }

CertificateVerdict verdict(const Certificate& certificate) { return judged(certificate).verdict; }

bool warns(const Certificate& certificate) {
  return comparison::certificate_warning("m/walk", judged(certificate)).has_value();
}

/// A run that ended where it is told to.
struct Ended {
  explicit Ended(std::vector<double> at) {
    laboratory.add_run("walk");
    plan.emplace(laboratory.plan());
    execution::RealisationResult result;
    result.best.parameters = std::move(at);
    std::vector<double> per_test(1);
    const auto workspace = plan->runs[0].assembly->evaluator().make_workspace();
    static_cast<void>(plan->runs[0].assembly->evaluator().evaluate(result.best.parameters, result.best.objective,
                                                                   per_test, {}, {}, *workspace));
    result.trace = {{1, result.best.objective}};
    summary = comparison::summarise(*plan, {{{result}}}, {});
    written = comparison::result_json(summary, {});
  }
  trial::Laboratory laboratory;
  std::optional<execution::Plan> plan;
  comparison::Summary summary;
  std::string written;
};

}  // namespace

TEST(Certificate, SaysInOneSentenceWhatSpeaksForTheOptimum) {
  EXPECT_EQ(sentence(spotless()),
            "evaluated identically in a fresh process; no better neighbour; 97 of 100 realisations agree; no bound "
            "active");
}

TEST(Certificate, SaysWhatSpeaksAgainstIt) {
  auto certificate = spotless();
  certificate.fresh->identical = false;
  certificate.fresh->difference = 1e-14;
  EXPECT_THAT(sentence(certificate), HasSubstr("its objective differs by rounding only (1e-14);"));
  certificate.fresh->difference = 0.5;
  EXPECT_THAT(sentence(certificate), HasSubstr("its objective differs by 0.5;"));
  auto& around = certificate.fresh->around;
  around.better = true;
  around.lowest->objective = 66.1 * (1 - 1e-5);
  EXPECT_THAT(sentence(certificate), HasSubstr("; a step of 1e-05 along mu lowers the objective by 0.001 %;"));
  around.lowest->objective = 66.1 * 0.99;
  EXPECT_THAT(sentence(certificate), HasSubstr("; not an optimum: a step of"));
  around.lowest.reset();
  EXPECT_THAT(sentence(certificate), HasSubstr("; no neighbour could be compared;"));
  around.constraints = 80;
  around.active_constraints = 3;
  certificate.at_bounds = {"k2", "theta"};
  EXPECT_THAT(sentence(certificate), HasSubstr("; k2 and theta at their bounds; 3 of 80 constraints active"));
  around.status = Status::infeasible("unstable", 0.1);
  EXPECT_THAT(sentence(certificate), HasSubstr("; it breaks a constraint;"));
  around.status = Status::failed("no root");
  EXPECT_THAT(sentence(certificate), HasSubstr("it failed in a fresh process: no root;"));
  certificate.fresh.reset();
  certificate.missing = "it ended with code 4";
  EXPECT_THAT(sentence(certificate), HasSubstr("not evaluated again in a fresh process (it ended with code 4)"));
}

TEST(Certificate, SaysWhatMaxTimeLeftOut) {
  auto certificate = spotless();
  certificate.fresh->around.evaluated = 5;
  certificate.fresh->around.left_out = 7;
  EXPECT_THAT(sentence(certificate), HasSubstr("; no better neighbour (max_time left out 7 of 12);"));
  EXPECT_EQ(verdict(certificate), CertificateVerdict::no_neighbours);
  certificate.fresh->around.lowest.reset();
  EXPECT_THAT(sentence(certificate), HasSubstr("; no neighbour could be compared (max_time left out 7 of 12);"));
}

// What the point itself says is there at any time; intervals and spread are left out, and that is said.
TEST(Estimate, SaysWhatMaxTimeLeftOut) {
  const Ended ended({2.2, 1, 3});
  const auto& run = ended.plan->runs[0];
  execution::RealisationResult best;
  best.best.parameters = {2.2, 1, 3};
  best.best.objective = ended.summary.runs[0].objective;
  const execution::RunResult both{{best, best}};
  const auto estimate = [&](plugins::Clock::time_point deadline, std::vector<execution::Warning>& warnings) {
    comparison::RunSummary summary;
    summary.tests = run.entry->tests;
    comparison::estimate(*ended.plan->experiment, *run.assembly, best, both, summary, warnings, deadline);
    return summary;
  };
  std::vector<execution::Warning> none, said;
  const auto whole = estimate(plugins::Clock::time_point::max(), none), late = estimate(plugins::Clock::now(), said);
  EXPECT_TRUE(none.empty());
  EXPECT_TRUE(whole.parameters[0].assessed);
  EXPECT_FALSE(whole.curve_lowest.empty());
  ASSERT_EQ(said.size(), 1U);
  EXPECT_THAT(said[0].text(), HasSubstr("there are no confidence intervals: max_time was over"));
  EXPECT_FALSE(late.parameters[0].assessed);
  EXPECT_TRUE(late.curve_lowest.empty() && late.curve_highest.empty());
  EXPECT_THAT(late.notes, ::testing::Contains(HasSubstr("the curves of all realisations are left out")));
  EXPECT_TRUE(late.status.ok());
  EXPECT_EQ(late.quality.size(), whole.quality.size());
}

TEST(Certificate, HasACodeForEveryFinding) {
  auto certificate = spotless();
  EXPECT_EQ(verdict(certificate), CertificateVerdict::confirmed);
  auto& around = certificate.fresh->around;
  around.better = true;
  around.lowest->objective = 66.1 * (1 - 1e-5);
  EXPECT_EQ(verdict(certificate), CertificateVerdict::better_neighbour);
  around.lowest->objective = 66.1 * 0.99;
  EXPECT_EQ(verdict(certificate), CertificateVerdict::not_an_optimum);
  certificate.ended_at_target = true;
  EXPECT_EQ(verdict(certificate), CertificateVerdict::ended_at_target);
  around.better = false;
  around.lowest.reset();
  EXPECT_EQ(verdict(certificate), CertificateVerdict::no_neighbours);
  around.status = Status::infeasible("unstable", 0.1);
  EXPECT_EQ(verdict(certificate), CertificateVerdict::constraint_broken);
  certificate.fresh->difference = 0.5;
  EXPECT_EQ(verdict(certificate), CertificateVerdict::objective_differs);
  around.status = Status::failed("no root");
  EXPECT_EQ(verdict(certificate), CertificateVerdict::failed);
  certificate.fresh.reset();
  EXPECT_EQ(verdict(certificate), CertificateVerdict::not_checked);
}

TEST(Certificate, DoesNotBlameASearchForEndingAtItsTarget) {
  auto certificate = spotless();
  certificate.ended_at_target = true;
  certificate.fresh->around.better = true;
  certificate.fresh->around.lowest->objective = 66.1 * 0.9;
  EXPECT_THAT(sentence(certificate), HasSubstr("; stopped at its target, not at the optimum: a step of"));
  EXPECT_FALSE(warns(certificate));
  certificate.ended_at_target = false;
  EXPECT_TRUE(warns(certificate));
}

TEST(Certificate, AlarmsOfWhatIsNotTheOptimumThatItIsSaidToBe) {
  auto certificate = spotless();
  EXPECT_FALSE(warns(certificate));
  certificate.fresh->difference = 0.5;
  EXPECT_TRUE(warns(certificate));
  certificate.fresh->difference = 1e-12;
  auto& around = certificate.fresh->around;
  around.better = true;
  around.lowest->objective = 66.1 * (1 - 1e-5);
  EXPECT_FALSE(warns(certificate));
  around.lowest->objective = 66.1 * (1 - 1e-2);
  EXPECT_TRUE(warns(certificate));
  certificate = spotless();
  certificate.fresh->around.status = Status::failed("no root");
  EXPECT_TRUE(warns(certificate));
  certificate.fresh.reset();
  EXPECT_FALSE(warns(certificate));
}

TEST(Certificate, CountsRealisationsThatAgreeAndHowFarTheyAreApart) {
  Ended ended({2, 1, 3});
  execution::RunResult result;
  for (const auto& [a, objective] : {std::pair{2.0, 5.0}, std::pair{2.5, 5.004}, std::pair{9.0, 5.02}}) {
    auto& realisation = result.realisations.emplace_back();
    realisation.best.parameters = {a, 1, 3};
    realisation.best.objective = objective;
  }
  result.realisations.emplace_back();  // without a result
  Certificate certificate;
  comparison::add_agreement(*ended.plan->runs[0].assembly, result, 5.0, std::nullopt, certificate);
  EXPECT_EQ(certificate.realisations, 4u);
  EXPECT_EQ(certificate.agreeing, 2u);
  EXPECT_EQ(certificate.spread[0].max, 2.5);
  EXPECT_NEAR(certificate.spread[0].share, 0.05, 1e-12);
  EXPECT_EQ(certificate.spread[1].share, 0);
  EXPECT_THAT(sentence(certificate), HasSubstr("2 of 4 realisations agree, a within 5 % of its range"));
  // Searches that stopped at a target have no reason to agree any closer.
  Certificate stopped;
  comparison::add_agreement(*ended.plan->runs[0].assembly, result, 5.0, 5.5, stopped);
  EXPECT_EQ(stopped.agreeing, 3u);
  Certificate short_of_it;
  comparison::add_agreement(*ended.plan->runs[0].assembly, result, 5.0, 4.0, short_of_it);
  EXPECT_EQ(short_of_it.agreeing, 2u);
}

TEST(Certify, FindsTheRecordedObjectiveAgainAndNoBetterNeighbourOfTheOptimum) {
  Ended ended({2, 1, 3});
  const auto certified = comparison::certify(*ended.plan, ended.written);
  comparison::add_certificates(certified, "", ended.summary);
  const auto& certificate = ended.summary.runs[0].certificate;
  ASSERT_TRUE(certificate.fresh);
  EXPECT_TRUE(certificate.fresh->identical);
  EXPECT_FALSE(certificate.fresh->around.better);
  EXPECT_EQ(certificate.fresh->around.evaluated, 24u) << "three parameters and three directions, two steps, two signs";
  EXPECT_THAT(certificate.sentence, HasSubstr("evaluated identically in a fresh process; no better neighbour"));
}

TEST(Certify, FindsTheWayDownFromAPointThatIsNoOptimum) {
  Ended ended({2.2, 1, 3});
  comparison::add_certificates(comparison::certify(*ended.plan, ended.written), "", ended.summary);
  const auto& around = ended.summary.runs[0].certificate.fresh->around;
  EXPECT_TRUE(around.better);
  EXPECT_LT(around.lowest->objective, around.objective);
  EXPECT_EQ(ended.summary.runs[0].certificate.verdict, CertificateVerdict::not_an_optimum);
  ASSERT_FALSE(ended.summary.warnings.empty());
  EXPECT_EQ(ended.summary.warnings.back().kind, execution::WarningKind::not_an_optimum);
  EXPECT_THAT(ended.summary.warnings.back().text(), HasSubstr("m/walk: evaluated"));
}

TEST(Certify, StatesADifferenceFromWhatWasRecorded) {
  Ended ended({2.2, 1, 3});
  auto changed = nlohmann::json::parse(ended.written);
  const double recorded = changed["runs"][0]["best"]["objective"];
  changed["runs"][0]["best"]["objective"] = recorded + 1;
  EXPECT_TRUE(comparison::add_certificates(comparison::certify(*ended.plan, changed.dump()), "", ended.summary));
  EXPECT_TRUE(ended.summary.runs[0].certificate.refuted());
  EXPECT_FALSE(ended.summary.runs[0].certificate.fresh->identical);
  EXPECT_DOUBLE_EQ(ended.summary.runs[0].certificate.fresh->difference, -1);
}

TEST(Certify, RefusesAResultOfSomethingElse) {
  Ended ended({2, 1, 3});
  const auto message = [&](const std::string& text) {
    return trial::message_of<InputError>([&] { static_cast<void>(comparison::certify(*ended.plan, text)); });
  };
  EXPECT_THAT(message("{\"runs\": []}"), HasSubstr("there is no run 'm/walk' in the result"));
  EXPECT_THAT(message("{\"runs\": 3"), HasSubstr("result.json cannot be understood"));
  auto other = nlohmann::json::parse(ended.written);
  other["runs"][0]["best"]["parameters"].erase("b");
  EXPECT_THAT(message(other.dump()), HasSubstr("run 'm/walk' has no parameter 'b'"));
}

TEST(Certify, LeavesARunUncertifiedWhenTheAnswerIsMissing) {
  Ended ended({2, 1, 3});
  EXPECT_FALSE(comparison::add_certificates("", "it was ended by signal 9", ended.summary));
  EXPECT_FALSE(ended.summary.runs[0].certificate.fresh);
  EXPECT_THAT(ended.summary.runs[0].certificate.sentence, HasSubstr("(it was ended by signal 9)"));
  EXPECT_FALSE(comparison::add_certificates("{\"runs\": []}", "", ended.summary));
  EXPECT_THAT(ended.summary.runs[0].certificate.sentence, HasSubstr("there is no run 'm/walk'"));
}
