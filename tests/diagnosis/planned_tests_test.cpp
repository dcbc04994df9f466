// SPDX-License-Identifier: Apache-2.0
// The library of tests for tubes, other measures of stress and odd data, and with plugins that do not do as they
// should.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <new>

#include <gmock/gmock.h>

#include "diagnosis/made_up_causes.hpp"
#include "diagnosis/measured.hpp"
#include "diagnosis/prospects/designs.hpp"
#include "plugins/guarded.hpp"
#include "tunica/error.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// The designs for an experiment as its file has it, at these parameters; nothing is fitted.
class Planned {
 public:
  explicit Planned(const trial::Measured& measured, std::vector<double> free = {18.668, 24.905, 0.2912},
                   const std::function<void(Evidence&)>& change = {})
      : free_(std::move(free)) {
    const experiment::Experiment read = measured.read();
    const Request request = request_of(read);
    const Progress silent;
    evidence_.experiment = read;
    evidence_.run = read.runs.front();
    evidence_.base = std::make_shared<const assembly::Assembly>(read, evidence_.run, testing::catalogue());
    for (const experiment::TestEntry& test : read.tests)
      for (const auto& [channel, noise] : test.data.noise)
        evidence_.noise.push_back({test.name, channel, "", NoiseSource::Kind::stated, noise});
    evidence_.curves = curves_of(*evidence_.base, evidence_.noise);
    if (change) change(evidence_);
    all = designs({read, request, testing::catalogue(), silent}, evidence_, *evidence_.base, free_);
  }
  [[nodiscard]] std::vector<std::string> descriptions() const {
    std::vector<std::string> found;
    for (const Design& design : all) found.push_back(design.description);
    return found;
  }
  [[nodiscard]] const Design& design(const std::string& part) const {
    for (const Design& one : all)
      if (one.description.find(part) != std::string::npos) return one;
    throw std::out_of_range(part);
  }
  [[nodiscard]] std::vector<double> predicted(const Design& design) const {
    std::vector<double> values;
    EXPECT_TRUE(predict(design, *evidence_.base, free_, values));
    return values;
  }
  std::vector<Design> all;

 private:
  std::vector<double> free_;
  Evidence evidence_;
};

/// A strip, and tubes at these axial stretches that were inflated to 14 kPa.
struct WithTubes : trial::Measured {
  explicit WithTubes(const std::vector<std::pair<std::string, double>>& tubes) : Measured({trial::Strip()}) {
    folder.write("tube.csv",
                 "pressure [kPa],outer_diameter_stretch [1],axial_force [mN]\n2,1.1,20\n14,1.3,30\n8,1.2,25\n");
    for (const auto& [name, stretch] : tubes)
      experiment["tests"][name] = {
          {"type", "thick_wall_pressurisation"},
          {"inner_radius", 1.79},
          {"thickness", 0.48},
          {"axial_stretch", stretch},
          {"data",
           {{"file", "tube.csv"},
            {"columns",
             {{"pressure", "pressure"},
              {"outer_diameter_stretch", "outer_diameter_stretch"},
              {"axial_force", "axial_force"}}},
            {"noise", {{"outer_diameter_stretch", {{"absolute", 0.003}}}, {"axial_force", {{"absolute", 0.4}}}}}}}};
  }
};

TEST(PlannedTests, InflateAMeasuredTubeAtAnotherAxialStretch) {
  const Planned planned(WithTubes({{"tube", 1.4}, {"short", 1.05}}));
  EXPECT_THAT(planned.descriptions(), SizeIs(6 + 3));
  EXPECT_EQ(planned.all[4].description, "the tube of 'tube' inflated at an axial stretch of 1.3");
  EXPECT_EQ(planned.all[5].description, "the tube of 'tube' inflated at an axial stretch of 1.5");
  EXPECT_EQ(planned.all[3].description, "the tube of 'short' inflated at an axial stretch of 1.15") << "none below 1";
  const Design& design = planned.all[4];
  const TestRows& rows = design.test->rows();
  EXPECT_THAT(rows.channels, ElementsAre("outer_diameter_stretch", "axial_force"));
  ASSERT_EQ(rows.count, 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_NEAR(rows.abscissae.front().values[i], 14 * static_cast<double>(i + 1) / 20, 1e-12);
    EXPECT_EQ(design.sd.at(i), 0.003);
    EXPECT_EQ(design.sd.at(20 + i), 0.4);
  }
  // At a larger axial stretch the tube is thinner from the beginning.
  EXPECT_LT(planned.predicted(planned.all[5])[0], planned.predicted(design)[0]);
}

TEST(PlannedTests, InflateNoTubeWithoutPressureOrOfSeveralLayers) {
  const auto tubes = [](const std::function<void(Evidence&)>& change) {
    return Planned(WithTubes({{"tube", 1.4}}), {18.668, 24.905, 0.2912}, change).all.size() - 6;
  };
  const auto pressures = [](double value) {
    return [value](Evidence& evidence) {
      for (Curve& curve : evidence.curves)
        if (curve.test == "tube") curve.abscissa.assign(3, value);
    };
  };
  EXPECT_EQ(tubes({}), 2u);
  EXPECT_EQ(tubes(pressures(0.5)), 2u);
  EXPECT_EQ(tubes(pressures(0)), 0u);
  EXPECT_EQ(tubes(pressures(-2)), 0u);
  EXPECT_EQ(tubes([](Evidence& evidence) {
              evidence.experiment.tests.back().layers = {{"gho", 0.2}, {"gho", 0.28}};
            }),
            0u);
}

TEST(PlannedTests, InflateOnlyTheTubeOfTheModelWhoseWallIsIntegrated) {
  EXPECT_THAT(Planned(trial::Measured()).descriptions(), Not(Contains(HasSubstr("inflated"))));
}

// Noise of 0.3 and 2 % of a first Piola–Kirchhoff stress P = σ/λ is one of 0.3 λ and 2 % of σ; of a second one,
// S = σ/λ², of 0.3 λ² and 2 %. The width is no stress.
TEST(PlannedTests, HaveTheNoiseOfCauchyStresses) {
  for (const auto& [measure, power] :
       {std::pair{"cauchy", 0}, std::pair{"first_piola_kirchhoff", 1}, std::pair{"second_piola_kirchhoff", 2}}) {
    trial::Measured measured({{.name = "axial"}});
    std::string rows = "stretch [1],stress [kPa],width [1]\n";
    for (const double stretch : measured.strips.front().stretch)
      rows += std::to_string(stretch) + "," + std::to_string(10 * stretch) + ",0.9\n";
    measured.folder.write("axial.csv", rows);
    auto& data = measured.experiment["tests"]["axial"]["data"];
    data["columns"]["transverse_stretch"] = "width";
    data["stress_measure"] = measure;
    data["noise"] = {{"stress", {{"absolute", 0.3}, {"relative", 0.02}}},
                     {"transverse_stretch", {{"absolute", 0.002}, {"relative", 0.01}}}};
    const Planned planned(measured);
    const Design& strip = planned.design("along the axial direction");
    const std::vector<double> values = planned.predicted(strip);
    for (std::size_t i = 0; i < 20; ++i) {
      const double stretch = 1 + 0.6 * static_cast<double>(i + 1) / 20;
      EXPECT_NEAR(strip.sd.at(i),
                  std::hypot(0.3 * std::pow(stretch, power), 0.02 * std::max(values[i], 0.1 * values[19])), 1e-9)
          << measure;
      EXPECT_NEAR(strip.sd.at(20 + i), std::hypot(0.002, 0.01 * values[20 + i]), 1e-12) << measure;
    }
  }
}

// However soft the material: stresses of 1e-9 kPa have a noise of 1.5 % of that.
TEST(PlannedTests, GuessTheNoiseOfTheSoftestMaterial) {
  for (const double size : {1e-3, 1e-9}) {
    const Planned planned(trial::Measured({trial::Strip()}), {18 * size, 25 * size, 0.3});
    const Design& sheet = planned.design("equally");
    const std::vector<double> values = planned.predicted(sheet);
    ASSERT_LT(values[19], 300 * size);
    EXPECT_NEAR(sheet.sd.at(0), 0.015 * values[19], 1e-9 * values[19]);
    EXPECT_NEAR(sheet.sd.at(39), 0.015 * values[39], 1e-9 * values[39]);
  }
}

TEST(PlannedTests, ReachNoFurtherThanEightTimesTheLength) {
  trial::Measured measured({{.stretch = {2, 9}}});
  measured.experiment["models"]["gho"] = {{"type", "neo_hooke"},
                                          {"parameters", {{"mu", {{"min", 1}, {"max", 100}, {"initial", 20}}}}}};
  const Planned planned(measured, {20});
  EXPECT_THAT(planned.descriptions(), Contains(HasSubstr("to a stretch of 8,")));
}

TEST(PlannedTests, PullTheStripAt45DegreesFromItsFirstLength) {
  const Planned planned(trial::Measured({trial::Strip()}));
  const auto& stretches = planned.design("45°").test->rows().abscissae.front().values;
  for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(stretches[i], 1 + 0.6 * static_cast<double>(i + 1) / 20, 1e-12);
}

// Half a second, from 0.2 s on; the single reading of another test has no duration.
TEST(PlannedTests, TakeTheirTimesFromTwoRowsOrMore) {
  const Planned planned(
      trial::Measured({{.name = "axial", .stretch = {1.2, 1.6}, .time = {0.2, 0.7}}, {.stretch = {1.5}, .time = {7}}}));
  EXPECT_THAT(planned.descriptions(), Contains("one slow cycle of a strip, to 1.6 and back in 5 s"));
  EXPECT_THAT(planned.descriptions(), Contains("a strip pulled to 1.6 within 0.025 s and held for 0.5 s"));
}

/// A test without parameters, that shows 1 everywhere.
class Bare final : public tunica::Test {
 public:
  explicit Bare(const TestSetup& setup) : rows_{setup.rows.count, {}, setup.rows.channels, {}} {}
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  Status predict(const TestInput&, const TestOutput& output) const override {
    std::fill(output.values.begin(), output.values.end(), 1.0);
    return {};
  }

 private:
  TestDescription description_;
  TestRows rows_;
};

/// A curve of three rows.
PlannedTest a_curve() { return {"a curve", {}, {{"x", even_steps(0, 1, 3)}}, {}, {"y"}}; }

/// The fakes, and one more type of test that plans as it is told.
struct OtherShelf : MadeUpCauses {
  OtherShelf() : MadeUpCauses({3}, at_rows(3, {})) { close(); }
  void add_plan(std::function<std::vector<PlannedTest>(const PlanningScope&)> plan,
                std::function<std::unique_ptr<tunica::Test>(const TestSetup&)> create = {}) {
    TestFactory factory = shelf.tests().at("curve").factory;
    factory.type = "other";
    factory.plan = std::move(plan);
    if (create) factory.create = std::move(create);
    plugins::Catalogue::Registration stage;
    stage.add(std::move(factory));
    shelf.commit(std::move(stage), "other 1");
  }
  void add_plan(PlannedTest one, std::function<std::unique_ptr<tunica::Test>(const TestSetup&)> create = {}) {
    add_plan([one](const PlanningScope&) { return std::vector{one}; }, std::move(create));
  }
  [[nodiscard]] std::vector<Design> planned() const {
    return designs(inquiry(), analysis.evidence, *analysis.evidence.base, analysis.evidence.fit.free);
  }
};

TEST(PlannedTests, LeaveOutWhatNoPluginProvidesOrRefuses) {
  OtherShelf none;
  EXPECT_THAT(none.planned(), IsEmpty());
  OtherShelf refusing;
  refusing.add_plan(a_curve(), [](const TestSetup&) -> std::unique_ptr<tunica::Test> { throw InputError("not so"); });
  EXPECT_THAT(refusing.planned(), IsEmpty());
  OtherShelf exhausted;
  exhausted.add_plan(a_curve(), [](const TestSetup&) -> std::unique_ptr<tunica::Test> { throw std::bad_alloc(); });
  EXPECT_THROW((void)exhausted.planned(), std::bad_alloc);
}

// "gain" of a curve has no null and begins at 1, "tilt" has the null 0.
TEST(PlannedTests, HaveTheirParametersAtTheirNulls) {
  OtherShelf causes;
  PlannedTest tilted = a_curve();
  tilted.parameters = {{"tilt", 0.5}};
  causes.add_plan([tilted](const PlanningScope&) { return std::vector{a_curve(), tilted}; });
  const std::vector<Design> planned = causes.planned();
  ASSERT_THAT(planned, SizeIs(2));
  EXPECT_THAT(planned[0].parameters, ElementsAre(1, 0));
  EXPECT_THAT(planned[1].parameters, ElementsAre(1, 0.5));
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("not today"); });
  EXPECT_THAT(causes.planned(), IsEmpty()) << "what cannot be simulated";
  fakes::set_behaviour({});
}

TEST(PlannedTests, NeedNoParameters) {
  OtherShelf causes;
  causes.add_plan(
      a_curve(), [](const TestSetup& setup) -> std::unique_ptr<tunica::Test> { return std::make_unique<Bare>(setup); });
  const std::vector<Design> planned = causes.planned();
  ASSERT_THAT(planned, SizeIs(1));
  EXPECT_THAT(planned[0].parameters, IsEmpty());
}

// A plan that is wrong is a fault of its plugin, which the message names with the plan, what was found and expected.
TEST(PlannedTests, RefuseAPlanThatCannotBeMeant) {
  const auto refused = [](const std::function<void(PlannedTest&)>& spoil) -> std::string {
    PlannedTest plan = a_curve();
    spoil(plan);
    OtherShelf causes;
    causes.add_plan(plan);
    try {
      (void)causes.planned();
    } catch (const plugins::PluginFailure& failure) {
      return failure.what();
    }
    return "nothing was refused";
  };
  EXPECT_THAT(
      refused([](PlannedTest& plan) { plan.abscissae.emplace_back("x2", even_steps(0, 1, 2)); }),
      HasSubstr("plugin 'other 1': its plan 'a curve' for tests 'other' has 2 values in 'x2', expected 3, as in "
                "'x'; correct what its plan returns"));
  EXPECT_THAT(refused([](PlannedTest& plan) { plan.time = {1}; }), HasSubstr("has 1 value in 'time', expected 3"));
  EXPECT_THAT(refused([](PlannedTest& plan) { plan.abscissae.front().second.clear(); }),
              HasSubstr("has 0 values in 'x', expected one or more"));
  EXPECT_THAT(refused([](PlannedTest& plan) { plan.abscissae.clear(); }), HasSubstr("has no abscissa"));
  EXPECT_THAT(refused([](PlannedTest& plan) {
                plan.options = {{"speed", 1.0}};
              }),
              HasSubstr("sets the option 'speed', and the test has no such option"));
  EXPECT_THAT(refused([](PlannedTest& plan) {
                plan.parameters = {{"tilr", 1.0}};
              }),
              HasSubstr("sets the parameter 'tilr', and the test has no such parameter. Did you mean 'tilt'?"));
}

// Tests of the type that were made, on one model throughout; those with layers are not told.
TEST(PlannedTests, AreToldOfTheTestsOfTheirType) {
  OtherShelf causes;
  std::vector<std::string> made;
  causes.add_plan([&made](const PlanningScope& scope) {
    for (const PlanningScope::Made& one : scope.made) made.push_back(one.name);
    return std::vector<PlannedTest>{};
  });
  (void)causes.planned();
  EXPECT_THAT(made, IsEmpty());
  experiment::TestEntry& entry = causes.analysis.evidence.experiment.tests.front();
  entry.type = "other";
  (void)causes.planned();
  EXPECT_THAT(made, ElementsAre(entry.name));
  made.clear();
  entry.layers = {{"gho", 0.2}, {"gho", 0.28}};
  (void)causes.planned();
  EXPECT_THAT(made, IsEmpty());
}

}  // namespace
}  // namespace tunica::diagnosis
