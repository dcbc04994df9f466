// SPDX-License-Identifier: Apache-2.0
#include "posterior/posterior.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "numerics/distributions.hpp"
#include "posterior_ranks.hpp"
#include "uncertainty/local.hpp"

using namespace tunica;
using posterior::sample;

namespace {

/// y = a + 2x with b held: a alone is free, on a linear scale between 0 and 10.
struct Constant : trial::Line {
  explicit Constant(std::size_t rows) : Line(rows) { parameter("b").fixed = 2; }
};

void state_noise(trial::Line& line, double sd) { line.experiment.tests.front().data.noise = {{"y", {sd}}}; }

double mean_error(const trial::Line& line) {
  double sum = 0;
  for (std::size_t i = 0; i < line.x.size(); ++i) sum += line.y[i] - 2 * line.x[i];
  return sum / static_cast<double>(line.x.size());
}

// Quantiles of 20 000 draws, worth 8000 at least, are within 0.05 standard deviations with probability 0.998 each.
constexpr std::size_t many = 20000;
constexpr double precision = 0.05;

}  // namespace

// With stated noise the posterior of a mean is normal, with σ/√N.
TEST(Posterior, IsNormalWhereTheModelIsLinearAndTheNoiseIsStated) {
  Constant line(8);
  state_noise(line, 0.1);
  const auto made = sample(line.assemble(), std::vector{1.0}, many, 1);
  ASSERT_TRUE(made.complete) << made.status.reason();
  ASSERT_GT(made.effective_size(), 8000);
  EXPECT_LT(made.r_hat(), 1.01);
  const double sd = 0.1 / std::sqrt(8.0), centre = mean_error(line);
  EXPECT_NEAR(made.parameters[0].median, centre, precision * sd);
  EXPECT_NEAR(made.parameters[0].lower, centre - 1.96 * sd, 1.5 * precision * sd);
  EXPECT_NEAR(made.parameters[0].upper, centre + 1.96 * sd, 1.5 * precision * sd);
  EXPECT_NEAR(made.parameters[0].sd, sd, precision * sd);
}

// Without: Student's t with N − 1 degrees of freedom, as in the linearised interval.
TEST(Posterior, IsStudentsWhereTheFactorOfTheNoiseIsUnknown) {
  const Constant line(8);
  const auto made = sample(line.assemble(), std::vector{1.0}, many, 1);
  ASSERT_TRUE(made.complete) << made.status.reason();
  EXPECT_FALSE(made.factor_known);
  const double centre = mean_error(line);
  double squares = 0;
  for (std::size_t i = 0; i < 8; ++i) squares += std::pow(line.y[i] - 2 * line.x[i] - centre, 2);
  const double scale = std::sqrt(squares / 7 / 8), t = numerics::student_quantile(0.975, 7);
  EXPECT_NEAR(made.parameters[0].lower, centre - t * scale, 2 * precision * t * scale);
  EXPECT_NEAR(made.parameters[0].upper, centre + t * scale, 2 * precision * t * scale);
  EXPECT_NEAR(made.parameters[0].median, centre, precision * scale);
}

// The bound a ≥ 0 cuts the normal distribution off at its mode: quantiles of its half.
TEST(Posterior, EndsAtABound) {
  Constant line(8);
  state_noise(line, 0.1);
  std::vector<double> measured = line.y;
  for (std::size_t i = 0; i < 8; ++i) measured[i] = 2 * line.x[i];
  const auto made = sample(line.assemble(), std::vector{0.0}, many, 1, {}, measured);
  ASSERT_TRUE(made.complete) << made.status.reason();
  const double sd = 0.1 / std::sqrt(8.0);
  const auto half = [sd](double share) { return sd * numerics::normal_quantile(0.5 + share / 2); };
  EXPECT_GE(made.parameters[0].lower, 0);
  EXPECT_NEAR(made.parameters[0].lower, half(0.025), precision * sd);
  EXPECT_NEAR(made.parameters[0].median, half(0.5), precision * sd);
  EXPECT_NEAR(made.parameters[0].upper, half(0.975), 1.5 * precision * sd);
}

// A prior of the same weight as the data halves the variance and moves the mean half-way.
TEST(Posterior, HeedsPriors) {
  Constant line(8);
  state_noise(line, 0.1);
  const double sd = 0.1 / std::sqrt(8.0), centre = mean_error(line);
  line.parameter("a").prior = experiment::Prior{centre + 2 * sd, sd};
  const auto made = sample(line.assemble(), std::vector{centre}, many, 1);
  ASSERT_TRUE(made.complete) << made.status.reason();
  EXPECT_NEAR(made.parameters[0].median, centre + sd, precision * sd);
  EXPECT_NEAR(made.parameters[0].sd, sd / std::sqrt(2.0), precision * sd);
}

// With all noise stated a new measurement scatters about a constant by σ √(1 + 1/N).
TEST(Posterior, HasBandsOfCurvesAndOfMeasurements) {
  Constant line(8);
  state_noise(line, 0.1);
  const auto made = sample(line.assemble(), std::vector{1.0}, many, 1);
  ASSERT_TRUE(made.complete);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(made.bands.upper[i] - made.bands.lower[i], 2 * 1.96 * 0.1 / std::sqrt(8.0), 0.006);
    EXPECT_NEAR(made.bands.highest_measured[i] - made.bands.lowest_measured[i], 2 * 1.96 * 0.1 * std::sqrt(1 + 1 / 8.0),
                0.006);
    EXPECT_NEAR(made.bands.median[i], mean_error(line) + 2 * line.x[i], 0.003);
  }
}

// Ten data sets of 200 rows, every second one held out. Of 1000 rows between 93 and 97 % lie within the band with
// probability 0.996. Noise that is not stated has to be found from the residuals. Key 5.
TEST(Posterior, HoldsHeldOutRowsInTheBandOfMeasurements) {
  for (const bool stated : {true, false}) {
    posterior::CounterRandom random(5);
    std::size_t rows = 0, inside = 0;
    for (int set = 0; set < 10; ++set) {
      trial::Line line(fakes::grid(0, 7, 200), [&](std::size_t) { return 0.1 * random.normal(); });
      if (stated) state_noise(line, 0.1);
      line.experiment.tests.front().hold_out.rows = {0, {}, 2};
      const auto made = sample(line.assemble(), std::vector{1.0, 2.0}, 800, 1);
      ASSERT_TRUE(made.complete) << made.status.reason();
      EXPECT_EQ(made.factor_known, stated);
      rows += made.bands.held_out.rows;
      inside += made.bands.held_out.inside;
    }
    EXPECT_EQ(rows, 1000u);
    EXPECT_GE(inside, 930u);
    EXPECT_LE(inside, 970u);
    RecordProperty(stated ? "stated" : "estimated", static_cast<int>(inside));
  }
}

// The same with a discrepancy that is not there, for stated noise.
TEST(Posterior, HoldsHeldOutRowsBesideADiscrepancyThatIsNotThere) {
  posterior::CounterRandom random(5);
  std::size_t rows = 0, inside = 0;
  for (int set = 0; set < 10; ++set) {
    trial::Line line(fakes::grid(0, 7, 200), [&](std::size_t) { return 0.1 * random.normal(); });
    state_noise(line, 0.1);
    line.experiment.tests.front().hold_out.rows = {0, {}, 2};
    const auto made = sample(line.assemble(), std::vector{1.0, 2.0}, 800, 1, {}, {}, true);
    ASSERT_TRUE(made.complete) << made.status.reason();
    ASSERT_TRUE(made.bands.misfit);
    rows += made.bands.held_out.rows;
    inside += made.bands.held_out.inside;
  }
  EXPECT_EQ(rows, 1000u);
  EXPECT_GE(inside, 930u);
  EXPECT_LE(inside, 970u);
  RecordProperty("inside", static_cast<int>(inside));
}

// A line through a bend of three times the noise: without a discrepancy the interval of the slope is too short by far,
// and the band too narrow in the middle or too wide elsewhere.
TEST(Posterior, HoldsHeldOutRowsOfACurveThatTheModelMisses) {
  posterior::CounterRandom random(5);
  trial::Line line(fakes::grid(0, 7, 200),
                   [&](std::size_t i) { return 0.1 * random.normal() + 0.3 * std::cos(static_cast<double>(i) / 25); });
  state_noise(line, 0.1);
  line.experiment.tests.front().hold_out.rows = {0, {}, 2};
  const auto assembly = line.assemble();
  const auto without = sample(assembly, std::vector{1.0, 2.0}, 2000, 1),
             with = sample(assembly, std::vector{1.0, 2.0}, 2000, 1, {}, {}, true);
  ASSERT_TRUE(without.complete && with.complete);
  EXPECT_GE(with.bands.held_out.inside, 90u) << "of 100: 90 or more with probability 0.989";
  EXPECT_GT(with.bands.misfit->lower, 0);
  EXPECT_GT(with.parameters[1].sd, 2 * without.parameters[1].sd);
  double narrow = 0, wide = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    narrow += with.bands.highest_measured[i] - with.bands.lowest_measured[i];
    wide += without.bands.highest_measured[i] - without.bands.lowest_measured[i];
  }
  EXPECT_LT(narrow, 0.8 * wide) << "the misfit is known where rows stand beside it";
}

TEST(Posterior, IsTheSameForAnyNumberOfThreads) {
  const trial::Line line;
  const auto assembly = line.assemble();
  const auto draw = [&] { return sample(assembly, std::vector{1.0, 2.0}, 800, 7); };
  const auto one = trial::by_threads(1, draw), two = trial::by_threads(2, draw);
  ASSERT_EQ(one.draws(), 800u);
  for (std::size_t k = 0; k < one.chains.size(); ++k) EXPECT_EQ(one.chains[k].free, two.chains[k].free);
  EXPECT_EQ(one.bands.highest_measured, two.bands.highest_measured);
  EXPECT_NE(one.chains[0].free, one.chains[1].free);
  EXPECT_NE(one.chains[0].free, sample(assembly, std::vector{1.0, 2.0}, 800, 8).chains[0].free);
}

TEST(Posterior, KeepsToConstraints) {
  fakes::Bench bench("bordered");  // a − b ≥ −1
  const auto x = fakes::grid(0, 7, 8);
  bench.add_test("t", x, fakes::map(x, [](double at) { return 1 + 2 * at; }));
  bench.run.objective = experiment::ObjectiveType::least_squares;
  bench.experiment.tests.front().data.noise = {{"y", {0.5}}};
  bench.parameter("c").fixed = 0;
  bench.run.constraints.push_back({"admissible_parameters"});
  const auto made = sample(bench.assemble(), std::vector{1.01, 2.0}, 4000, 1);
  ASSERT_TRUE(made.complete) << made.status.reason();
  for (const auto& chain : made.chains)
    for (std::size_t k = 0; k < chain.draws(); ++k) ASSERT_GE(chain.value(k, 0) - chain.value(k, 1), -1 - 1e-5);
}

TEST(Posterior, LeavesEverythingOutOnceItIsInterrupted) {
  const trial::Line line;
  const auto made = sample(line.assemble(), std::vector{1.0, 2.0}, 800, 7, [] { return true; });
  EXPECT_FALSE(made.complete);
  EXPECT_TRUE(made.chains.empty());
}

TEST(Posterior, SaysWhyThereIsNone) {
  trial::Line line;
  line.parameter("a").fixed = 1;
  line.parameter("b").fixed = 2;
  EXPECT_EQ(sample(line.assemble(), {}, 800, 7).status.reason(), "no parameter is free");
}

// Simulation-based calibration, see posterior_ranks.hpp; bench_posterior has the whole one: 40 data sets of gho, 20 of
// ogden. Seed 20240817: of nine histograms one is refused by chance for 9e-4 of the seeds. New rows are within their
// band for 95 % of the draws, and rows of a data set are alike by what its draws have in common: ± 2 % is five standard
// deviations of that.
TEST(Posterior, RanksTheTruthOfGhoUniformly) {
  const auto found = bench::ranks(bench::gho_strips(tunica::testing::catalogue()), 40, 400, 20240817);
  for (std::size_t j = 0; j < found.names.size(); ++j) EXPECT_GT(found.chance(j, 5), 1e-4) << found.names[j];
  EXPECT_NEAR(static_cast<double>(found.inside) / static_cast<double>(found.new_rows), 0.95, 0.02);
}
TEST(Posterior, RanksTheTruthOfOgdensRubberUniformly) {
  const auto found = bench::ranks(bench::ogden_rubber(tunica::testing::catalogue()), 20, 400, 20240817);
  for (std::size_t j = 0; j < found.names.size(); ++j) EXPECT_GT(found.chance(j, 5), 1e-4) << found.names[j];
  EXPECT_NEAR(static_cast<double>(found.inside) / static_cast<double>(found.new_rows), 0.95, 0.02);
}
TEST(Posterior, RanksTheTruthOfATubeUniformly) {
  const auto found = bench::ranks(bench::hgo_tube(tunica::testing::catalogue()), 20, 400, 20240817);
  for (std::size_t j = 0; j < found.names.size(); ++j) EXPECT_GT(found.chance(j, 5), 1e-4) << found.names[j];
  EXPECT_NEAR(static_cast<double>(found.inside) / static_cast<double>(found.new_rows), 0.95, 0.02);
}
// Data with a misfit of the prior, and a posterior that allows for one.
TEST(Posterior, RanksTheTruthUniformlyBesideADiscrepancy) {
  const auto found = bench::ranks(bench::ogden_rubber(tunica::testing::catalogue()), 20, 400, 20240817, true);
  for (std::size_t j = 0; j < found.names.size(); ++j) EXPECT_GT(found.chance(j, 5), 1e-4) << found.names[j];
  EXPECT_NEAR(static_cast<double>(found.inside) / static_cast<double>(found.new_rows), 0.95, 0.02);
}
