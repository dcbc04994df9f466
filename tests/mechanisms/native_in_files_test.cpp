// SPDX-License-Identifier: Apache-2.0
// Mechanisms that stand for native imperfections, in experiment files: read, checked and run.
#include <algorithm>
#include <cstring>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "assembly/assembly.hpp"
#include "cli/process.hpp"
#include "execution/folder.hpp"
#include "experiment/experiment.hpp"
#include "shelf.hpp"

namespace tunica::testing::native_in_files_test {
namespace {

using ::testing::HasSubstr;

const char* const long_tube = R"("type": "thick_wall_pressurisation", "axial_stretch": 1.2,
      "inner_radius": "3.71 mm", "thickness": "2.06 mm")";
const char* const clamped_tube = R"("type": "fe_pressurisation", "axial_stretch": 1.2, "inner_radius": "3.71 mm",
      "thickness": "2.06 mm", "length": "14 mm", "elements": [2, 3])";
const char* const strip = R"("type": "uniaxial", "direction": "axial")";

class NativeInFiles : public ::testing::Test {
 protected:
  NativeInFiles() {
    folder.write("tube.csv", "pressure [kPa],diameter [1]\n2,0.98\n8,1.10\n14,1.22\n20,1.33\n");
    folder.write("strip.csv", "stretch [1],stress [kPa]\n1.1,6\n1.2,13\n1.3,23\n1.4,36\n");
  }

  /// One test of a gho wall with this beside its type and data; "" = nothing. `more` = other tests.
  [[nodiscard]] std::string file(const std::string& test, const std::string& own, const std::string& more = "") const {
    const bool tube = test != strip;
    return fmt::format(
        R"({{"format": 1, "name": "native", "seed": 1, "models": {{"wall": {{"type": "gho"}}, "media": {{"type": "hgo"}}}},
  "tests": {{"a": {{{0}{1}, "data": {{"file": "{2}", "columns": {3}}}}}{4}}},
  "objective": "standardised_quadratic", "optimizers": {{"lm": {{"type": "ceres_lm"}}}}, "stop": {{"max_evaluations": 60}},
  "runs": [{{"model": "wall", "optimizer": "lm"}}]}})",
        test, own.empty() ? "" : ", " + own, tube ? "tube.csv" : "strip.csv",
        tube ? R"({"pressure": "pressure", "outer_diameter_stretch": "diameter"})"
             : R"({"stretch": "stretch", "stress": "stress"})",
        more.empty() ? "" : ", " + more);
  }
  [[nodiscard]] assembly::Assembly assemble(const std::string& text) const {
    folder.write("experiment.json", text);
    const auto experiment = experiment::read_experiment(folder.path() / "experiment.json", catalogue());
    return {experiment, experiment.runs.front(), catalogue()};
  }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    try {
      static_cast<void>(assemble(text));
    } catch (const InputError& problem) {
      return problem.what();
    }
    return "";
  }

  trial::Folder folder;
};

struct Prediction {
  std::vector<double> values, jacobian;
};

/// At set S, and whatever comes behind it.
Prediction predict(const assembly::Assembly& assembly, const std::vector<double>& more) {
  std::vector<double> at{18.668, 0.1367, 24.905, 0.2912, 46.44};
  at.insert(at.end(), more.begin(), more.end());
  EXPECT_EQ(assembly.layout().parameters.size(), at.size());
  Prediction p{std::vector<double>(assembly.layout().prediction_count), {}};
  p.jacobian.resize(p.values.size() * at.size());
  const auto workspace = assembly.evaluator().make_workspace();
  const Status status = assembly.evaluator().predict(at, p.values, p.jacobian, *workspace);
  EXPECT_TRUE(status.ok()) << status.reason();
  return p;
}

void expect_same_bits(const Prediction& a, const Prediction& b) {
  ASSERT_EQ(a.values.size(), b.values.size());
  EXPECT_EQ(std::memcmp(a.values.data(), b.values.data(), sizeof(double) * a.values.size()), 0);
  ASSERT_EQ(a.jacobian.size(), b.jacobian.size());
  EXPECT_EQ(std::memcmp(a.jacobian.data(), b.jacobian.data(), sizeof(double) * a.jacobian.size()), 0);
}

struct Case {
  const char *mechanism, *parameter, *native, *test;
  double value;
};
const Case cases[] = {{"residual_stress", "opening_angle", "opening_angle", long_tube, 60},
                      {"axial_stretch_error", "value", "axial_stretch_error", long_tube, 0.02},
                      {"axial_stretch_error", "value", "axial_stretch_error", clamped_tube, 0.02},
                      {"tethering", "stiffness", "tethering", long_tube, 3},
                      {"layered_wall", "ratio", "layer_ratio", long_tube, 2.5},
                      {"geometry_error", "gain", "thickness_error", long_tube, -0.1},
                      {"geometry_error", "gain", "thickness_error", clamped_tube, -0.1},
                      {"specimen_misalignment", "angle", "misalignment", strip, 4}};

TEST_F(NativeInFiles, EachIsTheParameterOfTheTestAndFree) {
  for (const Case& is : cases) {
    SCOPED_TRACE(is.mechanism);
    const std::string named = fmt::format(R"("mechanisms": [{{"type": "{}"}}])", is.mechanism);
    const auto with = assemble(file(is.test, named));
    EXPECT_EQ(with.layout().parameters.back().name, fmt::format("a.{}.{}", is.mechanism, is.parameter));
    // The parameter itself, set free by its bounds.
    const auto& bounds = with.layout().parameters.back();
    const auto own = assemble(file(is.test, fmt::format(R"("parameters": {{"{}": {{"min": {}, "max": {}}}}})",
                                                        is.native, bounds.min, bounds.max)));
    EXPECT_EQ(own.layout().parameters.back().name, fmt::format("a.{}", is.native));
    expect_same_bits(predict(with, {is.value}), predict(own, {is.value}));

    const auto fixed = assemble(
        file(is.test, fmt::format(R"("mechanisms": [{{"type": "{}", "parameters": {{"{}": {{"fixed": {}}}}}}}])",
                                  is.mechanism, is.parameter, is.value)));
    EXPECT_EQ(predict(fixed, {}).values, predict(with, {is.value}).values);
  }
}

TEST_F(NativeInFiles, AtItsNullEachIsTheTestWithoutIt) {
  for (const Case& is : cases) {
    SCOPED_TRACE(is.mechanism);
    const double null = catalogue().mechanisms().at(is.mechanism).factory.null;
    const auto with = assemble(file(is.test, fmt::format(R"("mechanisms": [{{"type": "{}"}}])", is.mechanism)));
    const auto bare = assemble(file(is.test, ""));
    const Prediction a = predict(with, {null}), b = predict(bare, {});
    EXPECT_EQ(std::memcmp(a.values.data(), b.values.data(), sizeof(double) * b.values.size()), 0);
    for (std::size_t i = 0; i < b.values.size(); ++i)
      for (std::size_t j = 0; j < 5; ++j) EXPECT_EQ(a.jacobian[i * 6 + j], b.jacobian[i * 5 + j]);
  }
}

TEST_F(NativeInFiles, BothNamesTogetherAreRefused) {
  for (const Case& is : cases) {
    const std::string both = fmt::format(R"("mechanisms": [{{"type": "{}"}}], "parameters": {{"{}": {{"fixed": {}}}}})",
                                         is.mechanism, is.native, is.value);
    EXPECT_THAT(refusal(file(is.test, both)),
                HasSubstr(fmt::format("the mechanism '{}' is the parameter '{}' of test 'a'; name one of the two",
                                      is.mechanism, is.native)));
  }
}

TEST_F(NativeInFiles, WhereTheTestHasNoSuchParameterItIsRefused) {
  const auto layered = [this](const std::string& mechanism) {
    std::string text = file(long_tube, fmt::format(R"("layers": [{{"model": "media", "thickness": "1.2 mm"}},
        {{"model": "wall", "thickness": "0.86 mm"}}], "mechanisms": [{{"type": "{}"}}])",
                                                   mechanism));
    const std::string model_of_the_run = R"("model": "wall", "optimizer")";
    return text.replace(text.find(model_of_the_run), model_of_the_run.size(), R"("optimizer")");
  };
  EXPECT_THAT(
      refusal(layered("layered_wall")),
      HasSubstr("the mechanism 'layered_wall' is the test's own parameter 'layer_ratio', which it does not have "
                "with \"layers\""));
  EXPECT_EQ(refusal(layered("geometry_error")), "");
  EXPECT_THAT(refusal(file(clamped_tube, R"("mechanisms": [{"type": "specimen_misalignment"}])")),
              HasSubstr("the mechanism 'specimen_misalignment' does not apply to tests of type 'fe_pressurisation'"));
}

TEST_F(NativeInFiles, TheInterfaceOfTheMechanismIsThatOfTheTest) {
  const auto with = assemble(file(long_tube, R"("mechanisms": [{"type": "layered_wall", "layer_interface": 0.7}])"));
  const auto own =
      assemble(file(long_tube, R"("layer_interface": 0.7, "parameters": {"layer_ratio": {"min": 0.1, "max": 10}})"));
  expect_same_bits(predict(with, {3}), predict(own, {3}));
  const auto elsewhere = assemble(file(long_tube, R"("mechanisms": [{"type": "layered_wall"}])"));
  EXPECT_NE(predict(elsewhere, {3}).values, predict(with, {3}).values);
}

TEST_F(NativeInFiles, TestsMayShareOne) {
  const std::string shared = R"("mechanisms": [{"type": "geometry_error", "parameters": {"gain": {"share": "gain"}}}])";
  const auto assembly =
      assemble(file(long_tube, shared,
                    fmt::format(R"("b": {{{}, {}, "data": {{"file": "tube.csv", "columns": {{"pressure": "pressure",
        "outer_diameter_stretch": "diameter"}}}}}})",
                                clamped_tube, shared)));
  ASSERT_EQ(assembly.layout().parameters.size(), 6u);
  EXPECT_EQ(assembly.layout().parameters.back().name, "gain");
  const Prediction p = predict(assembly, {0.1}), bare = predict(assembly, {0});
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NE(p.values[i], bare.values[i]) << i;
}

/// Every mechanism that acts on tests, in a file: read, checked, and run through the built program.
TEST_F(NativeInFiles, ExtendedExperimentsAreCheckedAndRun) {
  const std::string on_tube =
      R"("mechanisms": [{"type": "axial_stretch_error"}, {"type": "pressure_offset"}, {"type": "diameter_scale_error",
         "parameters": {"gain": {"min": -0.05, "max": 0.05}}}, {"type": "layered_wall", "layer_interface": 0.6}])";
  const std::string on_strip =
      R"("mechanisms": [{"type": "specimen_misalignment", "parameters": {"angle": {"fixed": "2 deg"}}},
         {"type": "reference_length_error"}, {"type": "signal_drift"}, {"type": "outliers", "rows": "0:1"}])";
  folder.write("experiment.json",
               file(long_tube, on_tube,
                    fmt::format(R"("b": {{{}, {}, "data": {{"file": "strip.csv", "columns": {{"stretch": "stretch",
        "stress": "stress"}}}}}})",
                                strip, on_strip)));
  const auto checked = trial::tunica({"check", "experiment.json"}, folder.path());
  EXPECT_EQ(checked.code, 0) << checked.out << checked.err;
  const auto ran = trial::tunica({"run", "experiment.json", "-o", "out"}, folder.path());
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  const std::string result = trial::text_of(folder.path() / "out" / "result.json");
  for (const char* name :
       {"a.axial_stretch_error.value", "a.pressure_offset.value", "a.diameter_scale_error.gain", "a.layered_wall.ratio",
        "b.specimen_misalignment.angle", "b.reference_length_error.strain", "b.signal_drift.value", "b.outliers.value"})
    EXPECT_THAT(result, HasSubstr(name));
}

}  // namespace
}  // namespace tunica::testing::native_in_files_test
