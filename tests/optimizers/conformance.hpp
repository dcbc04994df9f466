// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "conformance/constrained_functions.hpp"
#include "conformance/optimizer_properties.hpp"
#include "optimizers/plugin_under_test.hpp"

// The shared property checks of every Optimizer. Include in one file of a test executable and instantiate:
//   TUNICA_OPTIMIZER_CONFORMANCE(Es, Subject{.label = "plus", .type = "es"});
// A property that a subject cannot have, as it says itself, is not instantiated for it.

namespace tunica::testing {

using namespace conformance;

/// What an optimiser can do beyond what every optimiser does. The last two are what Optimizer::Needs declares.
struct Abilities {
  bool oblique = true;      ///< adapts to directions, and so solves the ill-conditioned functions too
  bool random = true;       ///< results depend on the seed
  bool infeasible = false;  ///< needs the full objective of infeasible points
};

struct Subject {
  std::string label;  ///< letters, digits, underscores
  std::string type;   ///< plugin and optimiser
  Given options = {};
  std::uint64_t budget = 60000;  ///< evaluations that suffice for each of the standard functions
  Abilities abilities = {};
  double boundary = 1e-3;  ///< expected relative closeness to an optimum on the boundary of the feasible set
};

inline std::string label(const ::testing::TestParamInfo<Subject>& info) { return info.param.label; }
inline void PrintTo(const Subject& subject, std::ostream* out) { *out << subject.type << " " << subject.label; }

/// The subjects that have an ability.
template <class Ability>
std::vector<Subject> those_that(std::vector<Subject> subjects, Ability able) {
  std::erase_if(subjects, [&](const Subject& subject) { return !able(subject.abilities); });
  return subjects;
}

class OptimizerConformance : public ::testing::TestWithParam<Subject> {
 protected:
  static std::unique_ptr<Optimizer> make() { return make_optimizer(GetParam().type, GetParam().options); }
  static Candidate candidate() {
    return {[] { return make(); }, GetParam().budget, 1e-8, GetParam().boundary, GetParam().abilities.oblique};
  }
  static void expect_held(const Verdict& verdict) {
    EXPECT_EQ(verdict.skipped, "") << verdict.compared;
    EXPECT_EQ(verdict.counter_example, "") << verdict.compared;
  }
  /// How the search of a problem of its own ends, for what the host relies on in the words of built-in optimisers.
  static std::string reason(FunctionProblem& problem) { return make()->minimise(problem).reason; }
};

/// Those that adapt to directions.
class ObliqueConformance : public OptimizerConformance {};
/// Those whose results depend on the seed.
class RandomConformance : public OptimizerConformance {};
/// Those that do without the full objective of infeasible points.
class FeasibleConformance : public OptimizerConformance {};

/// Instantiates for each subject the properties that it can have.
#define TUNICA_OPTIMIZER_CONFORMANCE(name, ...)                                                                     \
  static const std::vector<Subject> name##_subjects{__VA_ARGS__};                                                   \
  INSTANTIATE_TEST_SUITE_P(name, OptimizerConformance, ::testing::ValuesIn(name##_subjects), label);                \
  INSTANTIATE_TEST_SUITE_P(                                                                                         \
      name, ObliqueConformance,                                                                                     \
      ::testing::ValuesIn(those_that(name##_subjects, [](const Abilities& able) { return able.oblique; })), label); \
  INSTANTIATE_TEST_SUITE_P(                                                                                         \
      name, RandomConformance,                                                                                      \
      ::testing::ValuesIn(those_that(name##_subjects, [](const Abilities& able) { return able.random; })), label);  \
  INSTANTIATE_TEST_SUITE_P(                                                                                         \
      name, FeasibleConformance,                                                                                    \
      ::testing::ValuesIn(those_that(name##_subjects, [](const Abilities& able) { return !able.infeasible; })), label)

TEST_P(OptimizerConformance, DeclaresItselfInFull) {
  const OptimizerFactory factory = factory_of(GetParam().type);
  EXPECT_FALSE(factory.doc.empty());
  EXPECT_FALSE(factory.reference.empty());
  for (const Option& option : factory.options) {
    EXPECT_TRUE(option.doc.ends_with('.')) << option.name << ": one sentence is expected, found: " << option.doc;
    EXPECT_TRUE(option.fallback.has_value()) << option.name;
    EXPECT_EQ(option.kind == Option::Kind::choice, !option.choices.empty()) << option.name;
  }
}

TEST_P(OptimizerConformance, DeclaresTheAbilitiesOfTheSubject) {
  const Optimizer::Needs needs = make()->needs();
  EXPECT_EQ(needs.random, GetParam().abilities.random);
  EXPECT_EQ(needs.infeasible, GetParam().abilities.infeasible);
}

TEST_P(OptimizerConformance, FindsTheOptimumOfTheSphere) { expect_held(solves(candidate(), sphere(4))); }

TEST_P(ObliqueConformance, FindsTheOptimumOfAnObliqueEllipsoidOfConditionOneMillion) {
  expect_held(solves(candidate(), ellipsoid(4)));
}

TEST_P(ObliqueConformance, FindsTheOptimumAtTheEndOfACurvedValley) {
  expect_held(follows_a_curved_valley(candidate()));
}

TEST_P(OptimizerConformance, SolvesOneDimension) { expect_held(solves(candidate(), sphere(1))); }

TEST_P(OptimizerConformance, EvaluatesOnceWhenNothingIsFree) {
  expect_held(evaluates_once_when_nothing_is_free(candidate()));
}

TEST_P(OptimizerConformance, KeepsTheBoundsWhereTheOptimumLiesOnThem) { expect_held(keeps_the_bounds(candidate())); }

TEST_P(OptimizerConformance, AsksForWhatItDeclares) { expect_held(asks_for_what_it_declares(candidate())); }

TEST_P(OptimizerConformance, RepeatsItselfBitForBitWithTheSameSeed) {
  expect_held(repeats_itself_with_the_same_seed(candidate()));
}

TEST_P(RandomConformance, TakesAnotherCourseWithAnotherSeed) {
  expect_held(takes_another_course_with_another_seed(candidate()));
}

TEST_P(OptimizerConformance, DoesNotDependOnTheOrderOfParallelWork) {
  expect_held(does_not_depend_on_the_order_of_parallel_work(candidate()));
}

TEST_P(OptimizerConformance, SurvivesThatThreeInTenEvaluationsFail) {
  // Which points fail is a hash of their bits and seed 11. A start of a local method gets ten or more trials to
  // halve its step, so that all of 20 starts failing to come within 1e-2 has a chance below 1e-9.
  expect_held(survives_failed_evaluations(candidate(), 11));
}

TEST_P(OptimizerConformance, EndsAndSaysWhyWhenNothingCanBeEvaluated) {
  expect_held(gives_up_when_nothing_can_be_evaluated(candidate()));
  FunctionProblem problem(sphere(3), {.budget = 1000000, .failure_rate = 2});
  const std::string words = reason(problem);
  EXPECT_NE(words.find("could be evaluated"), std::string::npos) << words;
  EXPECT_NE(words.find("the function fails here"), std::string::npos) << words;
}

TEST_P(OptimizerConformance, PrintsNothing) { expect_held(prints_nothing(candidate())); }

TEST_P(OptimizerConformance, PrefersFeasiblePoints) { expect_held(prefers_feasible_points(candidate())); }

TEST_P(OptimizerConformance, ReachesAnOptimumOnTheBoundaryOfWhatIsFeasible) {
  expect_held(reaches_the_boundary_of_what_is_feasible(candidate()));
}

TEST_P(FeasibleConformance, IsNotMisledByObjectivesOfInfeasiblePointsThatLackCostlyTests) {
  expect_held(is_not_misled_where_costly_tests_are_left_out(candidate()));
}

TEST_P(OptimizerConformance, SaysSoWhereNothingIsFeasible) {
  expect_held(says_so_where_nothing_is_feasible(candidate()));
  FunctionProblem problem(nothing_feasible(), {.budget = 20000});
  const std::string words = reason(problem);
  EXPECT_NE(words.find("no feasible point"), std::string::npos) << words;
}

TEST_P(OptimizerConformance, StopsAtTheBudgetToTheEvaluation) { expect_held(keeps_the_budget(candidate())); }

TEST_P(OptimizerConformance, StopsWhenTheTargetIsReached) {
  expect_held(stops_at_the_target(candidate()));
  FunctionProblem problem(sphere(4), {.budget = GetParam().budget, .target = 1e-3});
  const std::string words = reason(problem);
  EXPECT_LT(problem.evaluations(), GetParam().budget);
  EXPECT_NE(words.find("stopped"), std::string::npos) << words;
}

/// The reference optima are those of the functions, so no optimiser can do better.
TEST_P(OptimizerConformance, FindsNothingBetterThanTheOptima) {
  for (const Function& function : {half_sphere(), hock_schittkowski_65(), rosenbrock_in_disc(), limited_curve()}) {
    FunctionProblem problem(function, {.budget = 5000});
    reason(problem);
    EXPECT_GE(problem.best, function.optimum * (1 - 1e-4)) << function.name;
  }
}

}  // namespace tunica::testing
