// SPDX-License-Identifier: Apache-2.0
#include "search/guided_search.hpp"

#include <cmath>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "assembly/guide.hpp"
#include "calibration/recording.hpp"

namespace tunica {
namespace {

using fakes::Bench;
using fakes::Recording;
using search::CalibrationProblem;
using search::Correction;
using search::GuidedSearch;
using testing::HasSubstr;

/// A few damped Gauss–Newton steps within the unit box.
Optimizer::Outcome descend(Problem& problem) {
  const auto n = static_cast<Eigen::Index>(problem.dimension()),
             m = static_cast<Eigen::Index>(problem.residual_count());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<double> x(problem.start().begin(), problem.start().end());
  Rows J(m, n);
  Eigen::VectorXd r(m), trial_r(m);
  double objective = 0, ridge = 1e-3;
  if (!problem.linearise(x, objective, {r.data(), r.data() + m}, {J.data(), J.data() + m * n}).ok())
    return {false, "the start failed"};
  for (int step = 0; step < 60 && !problem.should_stop(); ++step) {
    const Eigen::MatrixXd H = J.transpose() * J + ridge * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd s = H.ldlt().solve(-J.transpose() * r);
    std::vector<double> trial = x;
    for (Eigen::Index j = 0; j < n; ++j)
      trial[static_cast<std::size_t>(j)] = std::clamp(trial[static_cast<std::size_t>(j)] + s[j], 0.0, 1.0);
    Rows trial_J(m, n);
    double lower = 0;
    const Status status =
        problem.linearise(trial, lower, {trial_r.data(), trial_r.data() + m}, {trial_J.data(), trial_J.data() + m * n});
    if (status.ok() && lower < objective) {
      x = trial;
      r = trial_r;
      J = trial_J;
      objective = lower;
      ridge /= 10;
    } else {
      ridge *= 10;
    }
  }
  return {true, "done"};
}

/// Data that a parabola does not fit exactly, so the optimum is not a perfect fit.
class Guided : public testing::Test {
 protected:
  Guided() {
    bench_.add_test("slow", fakes::grid(0, 2, 9), fakes::map(fakes::grid(0, 2, 9), curve)).type = "costly_curve";
    bench_.add_test("quick", fakes::grid(0, 1, 5), fakes::map(fakes::grid(0, 1, 5), curve));
    bench_.run.objective = experiment::ObjectiveType::standardised_quadratic;
  }
  static double curve(double x) { return 3 + 2 * x + 0.8 * x * x + 0.2 * std::sin(4 * x); }
  struct Outcome {
    search::Best best;
    search::Tally tally;
    std::uint64_t guide_evaluations = 0;
    Optimizer::Outcome words;
    std::vector<fakes::Line> lines;
  };
  Outcome search(bool guided, std::uint64_t evaluations = 1000, const search::Replay& replay = {}) {
    const assembly::Assembly full = bench_.assemble();
    const auto guide = assembly::make_guide(bench_.experiment, bench_.run, "m/o", bench_.shelf, full);
    Recording recording;
    CalibrationProblem::Settings settings;
    settings.stop.max_evaluations = evaluations;
    settings.record = recording.recorder();
    settings.replay = replay;
    CalibrationProblem problem(full, settings);
    Outcome outcome;
    if (guided) {
      GuidedSearch guided_search(*guide, settings, descend);
      outcome.words = guided_search.run(problem, false);
      outcome.guide_evaluations = guided_search.evaluations();
    } else {
      outcome.words = descend(problem);
    }
    outcome.best = problem.best();
    outcome.tally = problem.tally();
    outcome.lines = recording.lines;
    return outcome;
  }
  Bench bench_;
};

TEST_F(Guided, TheAnswerIsThatOfTheCostlyTest) {
  const Outcome plain = search(false), guided = search(true);
  ASSERT_TRUE(guided.best.found());
  EXPECT_TRUE(guided.words.converged) << guided.words.reason;
  EXPECT_NEAR(guided.best.objective / plain.best.objective, 1, 1e-8);
  for (std::size_t j = 0; j < plain.best.parameters.size(); ++j)
    EXPECT_NEAR(guided.best.parameters[j], plain.best.parameters[j], 1e-4 * std::abs(plain.best.parameters[j]));
  EXPECT_LE(guided.tally.evaluations, 12u);
  EXPECT_GT(guided.guide_evaluations, guided.tally.evaluations);
}

TEST_F(Guided, TheGuideAloneWouldHaveMissedIt) {
  const assembly::Assembly full = bench_.assemble();
  const auto guide = assembly::make_guide(bench_.experiment, bench_.run, "m/o", bench_.shelf, full);
  CalibrationProblem cheap(*guide, {});
  descend(cheap);
  const Outcome guided = search(true);
  double off = 0;
  for (std::size_t j = 0; j < 3; ++j)
    off = std::max(off, std::abs(cheap.best().parameters[j] / guided.best.parameters[j] - 1));
  EXPECT_GT(off, 0.01);
}

TEST_F(Guided, ItStopsWithTheBudgetOfTheCostlyTest) {
  const Outcome guided = search(true, 2);
  EXPECT_EQ(guided.tally.evaluations, 2u);
  EXPECT_FALSE(guided.words.converged);
}

TEST_F(Guided, ItIsResumedFromAnyRowOfTheJournal) {
  const Outcome whole = search(true);
  const Recording recording{whole.lines};
  for (std::size_t rows = 0; rows <= whole.lines.size(); ++rows) {
    const Outcome resumed = search(true, 1000, recording.replay(rows));
    EXPECT_EQ(resumed.lines, whole.lines) << rows;
    EXPECT_EQ(resumed.words.reason, whole.words.reason);
  }
}

/// Around the centre the corrected problem has the value and the derivatives of the costly one.
TEST_F(Guided, TheCorrectedProblemAgreesToFirstOrder) {
  const assembly::Assembly full = bench_.assemble();
  const auto guide = assembly::make_guide(bench_.experiment, bench_.run, "m/o", bench_.shelf, full);
  const std::size_t n = full.layout().parameters.size(), m = full.layout().residual_count;
  std::vector<double> x(n, 0.4), r(m), J(m * n), free(n), g(m), G(m * n);
  CalibrationProblem costly(full, {});
  double objective = 0, rough = 0;
  ASSERT_TRUE(costly.linearise(x, objective, r, J).ok());
  CalibrationProblem cheap(*guide, {});
  ASSERT_TRUE(cheap.linearise(x, rough, g, G).ok());
  EXPECT_NE(rough, objective);
  Correction correction{std::vector<double>(n, 0.3), std::vector<double>(n, 0.6), x, r, J};
  for (std::size_t i = 0; i < m; ++i) correction.offset[i] -= g[i];
  for (std::size_t k = 0; k < m * n; ++k) correction.slope[k] -= G[k];
  CalibrationProblem::Settings settings;
  settings.correction = &correction;
  CalibrationProblem corrected(*guide, settings);
  const std::vector<double> inside(n, (0.4 - 0.3) / 0.3);
  std::vector<double> c(m), C(m * n);
  double same = 0;
  ASSERT_TRUE(corrected.linearise(inside, same, c, C).ok());
  EXPECT_NEAR(same, objective, 1e-12 * objective);
  for (std::size_t i = 0; i < m; ++i) EXPECT_NEAR(c[i], r[i], 1e-12);
  for (std::size_t k = 0; k < m * n; ++k) EXPECT_NEAR(C[k], 0.3 * J[k], 1e-10);  // by the trust region
  // Batches take the same road.
  Status status;
  ASSERT_TRUE(corrected.evaluate(inside, rough).ok());
  EXPECT_NEAR(rough, objective, 1e-12 * objective);
}

TEST_F(Guided, NothingIsGuidedWithoutACostlyTest) {
  bench_.experiment.tests.front().type = "curve";
  const assembly::Assembly full = bench_.assemble();
  EXPECT_EQ(assembly::make_guide(bench_.experiment, bench_.run, "m/o", bench_.shelf, full), nullptr);
}

TEST_F(Guided, ACostlyTestWithoutAStandInIsRefused) {
  const assembly::Assembly full = bench_.assemble();
  const auto make = [&] { assembly::make_guide(bench_.experiment, bench_.run, "m/o", bench_.shelf, full); };
  fakes::set_stand_in("");
  EXPECT_THAT(
      fakes::message_of(make),
      HasSubstr("run m/o: \"guide\" is true, and not each of its costly tests has a cheaper one that stands in for "
                "it; leave \"guide\" out"));
  fakes::set_stand_in("unheard_of");
  EXPECT_THAT(fakes::message_of(make), HasSubstr("run m/o: the test 'slow' would be guided by a 'unheard_of', which no "
                                                 "loaded plugin provides; leave \"guide\" out, or load that plugin"));
  // A stand-in that knows nothing of a parameter that the test frees.
  fakes::set_stand_in("rough_curve");
  bench_.experiment.tests.front().parameters["tilt"].min = -0.5;
  bench_.experiment.tests.front().parameters["bend"].fixed = 0;
  EXPECT_THAT(fakes::message_of(make), HasSubstr("run m/o: the tests that would guide it cannot be made; leave "
                                                 "\"guide\" out. The reason: "));
}

}  // namespace
}  // namespace tunica
