// SPDX-License-Identifier: Apache-2.0
#include "assembly/assembly.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibration/fakes.hpp"

namespace tunica {
namespace {

using assembly::Assembly;
using fakes::Bench;
using testing::HasSubstr;

std::vector<std::string> names(const Assembly& assembly) {
  std::vector<std::string> found;
  for (const auto& parameter : assembly.layout().parameters) found.push_back(parameter.name);
  return found;
}

std::vector<double> predict(const Assembly& assembly, const std::vector<double>& free) {
  std::vector<double> predictions(assembly.layout().prediction_count);
  const auto workspace = assembly.evaluator().make_workspace();
  const Status status = assembly.evaluator().predict(free, predictions, {}, *workspace);
  EXPECT_TRUE(status.ok()) << status.reason();
  return predictions;
}

TEST(Assembly, TakesDeclarationsWhereTheFileIsSilent) {
  Bench bench;
  bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  const Assembly assembly = bench.assemble();
  EXPECT_THAT(names(assembly), testing::ElementsAre("a", "b", "c"));
  EXPECT_EQ(assembly.layout().parameters[1].scale, Scale::log);
  EXPECT_EQ(assembly.layout().parameters[1].min, 0.1);
  EXPECT_EQ(assembly.layout().parameters[1].max, 10);
  EXPECT_EQ(assembly.layout().parameters[1].unit, "kPa");
  // The native imperfection is held at its null, the gain where the file says.
  ASSERT_EQ(assembly.layout().fixed_parameters.size(), 2u);
  EXPECT_EQ(assembly.layout().fixed_parameters[0].name, "t.gain");
  EXPECT_EQ(assembly.layout().fixed_parameters[1].name, "t.tilt");
  EXPECT_EQ(assembly.layout().fixed_parameters[1].value, 0);
  EXPECT_THAT(predict(assembly, {1, 2, 3}), testing::ElementsAre(1, 6, 17));
}

TEST(Assembly, NamesParametersOfMechanismsAndTestsByTheirOwners) {
  Bench bench;
  bench.model().mechanisms = {{"memory", {}, {}}, {"cubic", {}, {}}};
  auto& entry = bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  entry.parameters.erase("gain");
  entry.parameters["tilt"].initial = 0.5;
  entry.mechanisms = {{"scale_error", {}, {}}, {"offset", {}, {}}};
  const Assembly assembly = bench.assemble();
  EXPECT_THAT(names(assembly), testing::ElementsAre("a", "b", "c", "cubic.beta", "memory.g", "t.gain", "t.tilt",
                                                    "t.offset.value", "t.scale_error.value"));
  EXPECT_EQ(assembly.layout().parameters[6].initial, 0.5);
  EXPECT_FALSE(assembly.layout().jacobian_is_exact);
}

TEST(Assembly, WrapsInCanonicalOrderWhateverTheFileSays) {
  Bench bench;
  bench.model().mechanisms = {{"doubling", {}, {}}, {"cubic", {}, {}}};
  auto& entry = bench.add_test("t", {1, 2}, {1, 2});
  entry.mechanisms = {{"scale_error", {}, {}}, {"offset", {}, {}}};
  const Assembly assembly = bench.assemble();
  // a b c, cubic.beta, doubling.factor, offset, scale_error: ((a + b x + c x² + β x³)·f + offset)(1 + s)
  EXPECT_THAT(predict(assembly, {1, 1, 0, 0.5, 2, 0.25, 1}),
              testing::ElementsAre(2 * (2 * 2.5 + 0.25), 2 * (2 * 7 + 0.25)));
}

TEST(Assembly, LetsTheFileNarrowBoundsAndClampsTheDefaultStart) {
  Bench bench;
  bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  bench.parameter("a").min = 2;
  bench.parameter("b").fixed = 3;
  bench.parameter("c").scale = Scale::linear;
  const Assembly assembly = bench.assemble();
  EXPECT_THAT(names(assembly), testing::ElementsAre("a", "c"));
  EXPECT_EQ(assembly.layout().parameters[0].initial, 2);
  EXPECT_THAT(predict(assembly, {1, 0}), testing::ElementsAre(1, 4, 7));
}

TEST(Assembly, TiesSharedParametersWithinOneModelAndAcrossTests) {
  Bench bench;
  for (const char* name : {"s", "t"}) {
    auto& entry = bench.add_test(name, {1, 2}, {1, 2});
    entry.mechanisms = {{"offset", {}, {}}};
    entry.mechanisms[0].parameters["value"].share = "zero";
  }
  bench.experiment.tests[1].mechanisms[0].parameters["value"].max = 0.5;
  bench.parameter("a").share = "level";
  bench.parameter("c").share = "level";
  const Assembly assembly = bench.assemble();
  EXPECT_THAT(names(assembly), testing::ElementsAre("level", "b", "zero"));
  EXPECT_EQ(assembly.layout().parameters[0].min, 0);  // of a
  EXPECT_EQ(assembly.layout().parameters[0].max, 5);  // of c
  EXPECT_EQ(assembly.layout().parameters[2].max, 0.5);
  EXPECT_THAT(predict(assembly, {1, 2, 0.25}), testing::ElementsAre(4.25, 9.25, 4.25, 9.25));
}

TEST(Assembly, HasALogarithmicUnitBoxWithExactEnds) {
  Bench bench;
  bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  const Assembly assembly = bench.assemble();
  std::vector<double> free(3), x(3);
  assembly.box().from_unit(std::vector<double>{0, 0, 0}, free);
  EXPECT_THAT(free, testing::ElementsAre(0, 0.1, -5));
  assembly.box().from_unit(std::vector<double>{1, 1, 1}, free);
  EXPECT_THAT(free, testing::ElementsAre(10, 10, 5));
  assembly.box().from_unit(std::vector<double>{0.25, 0.5, 0.75}, free);
  EXPECT_NEAR(free[1], 1, 1e-15);
  assembly.box().to_unit(free, x);
  EXPECT_NEAR(x[0], 0.25, 1e-15);
  EXPECT_NEAR(x[1], 0.5, 1e-15);
  EXPECT_NEAR(assembly.box().initial()[1], 0.5, 1e-15);
}

TEST(Assembly, ReportsDiagnosticsAndHashes) {
  Bench bench;
  bench.add_test("t", {1, 2, 4}, {1, 2, 3});
  const Assembly assembly = bench.assemble();
  std::vector<std::pair<std::string, std::vector<double>>> rows;
  ASSERT_TRUE(assembly.evaluator().diagnostics(0, std::vector<double>{1, 1, 1}, rows).ok());
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].first, "twice_x");
  EXPECT_THAT(rows[0].second, testing::ElementsAre(2, 4, 8));
  ASSERT_EQ(assembly.layout().data_hashes.size(), 1u);
  EXPECT_THAT(assembly.layout().data_hashes[0], testing::StartsWith("t.csv sha256:"));
}

TEST(Assembly, TranslatesCombinationsToFreeParameters) {
  Bench bench("valley");
  bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  EXPECT_EQ(bench.assemble().layout().combinations[0].value(std::vector<double>{3, 4, 5}), 10);
  bench.parameter("p").fixed = 7;
  const Assembly assembly = bench.assemble();
  ASSERT_EQ(assembly.layout().combinations.size(), 1u);
  EXPECT_THAT(assembly.layout().combinations[0].arguments, testing::ElementsAre(0u));
  EXPECT_EQ(assembly.layout().combinations[0].value(std::vector<double>{4, 5}), 18);
  bench.parameter("q").fixed = 1;
  EXPECT_TRUE(bench.assemble().layout().combinations.empty());
}

struct Refusal {
  const char* name;
  std::function<void(Bench&)> spoil;
  std::vector<std::string> says;
};

class AssemblyRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(AssemblyRefuses, AndSaysWhereAndWhatToDo) {
  Bench bench;
  bench.add_test("t", {0, 1, 2}, {1, 2, 3});
  GetParam().spoil(bench);
  const std::string message = fakes::message_of([&] { static_cast<void>(bench.assemble()); });
  for (const std::string& part : GetParam().says) EXPECT_THAT(message, HasSubstr(part));
}

const std::vector<Refusal> refusals = {
    {"UnknownModelParameter",
     [](Bench& b) { b.parameter("bb").min = 1; },
     {"/models/m/parameters/bb", "unknown parameter 'bb' of model 'm'", "'b'"}},
    {"UnknownTestParameter",
     [](Bench& b) { b.experiment.tests[0].parameters["tillt"].pointer = "/tests/t/parameters/tillt"; },
     {"/tests/t/parameters/tillt", "test 't'", "'tilt'"}},
    {"UnknownMechanismParameter",
     [](Bench& b) {
       b.model().mechanisms = {{"cubic", {}, {}}};
       b.model().mechanisms[0].parameters["betta"].pointer = "/models/m/mechanisms/0/parameters/betta";
     },
     {"/models/m/mechanisms/0/parameters/betta", "mechanism 'cubic' of model 'm'", "'beta'"}},
    {"ReversedBounds",
     [](Bench& b) { b.parameter("a").min = 20; },
     {"/models/m/parameters/a", "min 20 is not below max 10 kPa"}},
    {"LogarithmOfZero",
     [](Bench& b) { b.parameter("a").scale = Scale::log; },
     {"/models/m/parameters/a", "needs min > 0", "min 0 kPa"}},
    {"InitialOutside",
     [](Bench& b) { b.parameter("a").initial = 11; },
     {"/models/m/parameters/a", "initial 11 lies outside its bounds 0 … 10 kPa"}},
    {"SharedUnitsDiffer",
     [](Bench& b) {
       b.parameter("a").share = "s";
       b.model().mechanisms = {{"doubling", {}, {}}};
       b.model().mechanisms[0].parameters["factor"].share = "s";
     },
     {"'doubling.factor'", "shares 's' with 'a'", "is in 1 where that is in kPa"}},
    {"SharedBoundsDisjoint",
     [](Bench& b) {
       b.parameter("a").share = "s";
       b.parameter("a").min = 6;
       b.parameter("c").share = "s";
     },
     {"/models/m/parameters/c", "nothing in common with 6 … 10 of 'a'"}},
    {"SharedStartsDiffer",
     [](Bench& b) {
       b.parameter("a").share = "s";
       b.parameter("a").initial = 1;
       b.parameter("c").share = "s";
       b.parameter("c").initial = 2;
     },
     {"another initial value than 'a'"}},
    {"SharedScalesDiffer",
     [](Bench& b) {
       b.parameter("a").share = "s";
       b.parameter("a").scale = Scale::linear;
       b.parameter("b").share = "s";
       b.parameter("b").scale = Scale::log;
     },
     {"another scale than 'a'"}},
    {"SharedPriorsDiffer",
     [](Bench& b) {
       b.parameter("a").share = "s";
       b.parameter("a").prior = {1, 1};
       b.parameter("b").share = "s";
       b.parameter("b").prior = {1, 2};
     },
     {"a second, different prior", "'s'"}},
    {"ShareTakesAName",
     [](Bench& b) { b.parameter("a").share = "b"; },
     {"the share 'b' has the name of another parameter"}},
    {"MechanismTwice",
     [](Bench& b) {
       b.model().mechanisms = {{"cubic", {}, {}}, {"cubic", {}, {}}};
     },
     {"model 'm'", "'cubic' is listed twice"}},
    {"TestMechanismOnModel",
     [](Bench& b) {
       b.model().mechanisms = {{"offset", {}, {}}};
     },
     {"model 'm'", "'offset' acts on a test"}},
    {"ModelMechanismOnTest",
     [](Bench& b) {
       b.experiment.tests[0].mechanisms = {{"cubic", {}, {}}};
     },
     {"test 't'", "'cubic' acts on a model"}},
    {"MechanismOfAnotherTest",
     [](Bench& b) {
       b.experiment.tests[0].mechanisms = {{"strip_only", {}, {}}};
     },
     {"test 't'", "does not apply to a test of type 'curve'", "applies to: strip"}},
    {"UnknownMechanism",
     [](Bench& b) {
       b.model().mechanisms = {{"cubik", {}, {}}};
     },
     {"mechanism 'cubik'", "'cubic'"}},
    {"UnknownModel", [](Bench& b) { b.model().type = "parabel"; }, {"model type 'parabel'", "parabola"}},
    {"ThrowingFactory", [](Bench& b) { b.model().type = "broken"; }, {"fakes 1", "no such luck"}},
    {"StabilityWithoutAStrip",
     [](Bench& b) {
       auto& constraint = b.run.constraints.emplace_back();
       constraint.type = "transverse_stability";
       constraint.pointer = "/constraints/0";
     },
     {"/constraints/0", "no free strip", "\"range\": [1, 1.5]"}},
    {"NothingToBeAdmissible",
     [](Bench& b) {
       auto& constraint = b.run.constraints.emplace_back();
       constraint.type = "admissible_parameters";
       constraint.pointer = "/constraints/0";
     },
     {"/constraints/0", "'parabola' declares no inequality"}},
    {"HoldOutBeyondTheRows",
     [](Bench& b) {
       b.experiment.tests[0].hold_out.rows = {3, {}, 1};
     },
     {"test 't'", "hold_out starts at row 3", "0 … 2"}},
    {"WrongNumberOfWeights",
     [](Bench& b) {
       b.experiment.tests[0].weights = {1, 2};
     },
     {"test 't'", "2 weights for 1 fitted channels"}},
    {"MissingColumn", [](Bench& b) { b.experiment.tests[0].data.columns[1].second = "why"; }, {"test 't'", "why"}},
};

INSTANTIATE_TEST_SUITE_P(Inputs, AssemblyRefuses, testing::ValuesIn(refusals),
                         [](const auto& refusal) { return refusal.param.name; });

}  // namespace
}  // namespace tunica
