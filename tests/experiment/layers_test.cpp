// SPDX-License-Identifier: Apache-2.0
#include "experiment/reading.hpp"

namespace tunica::experiment {
namespace {

using testing::expect_within;

/// The example with a second model, and its tube in two layers.
struct Layers : testing::Reading {
  static std::string layered(
      const std::string& layers =
          R"({"model": "gho", "thickness": "0.97 mm"}, {"model": "adventitia", "thickness": 1.09})") {
    return with(R"("axial_stretch": 1.2,)", R"("axial_stretch": 1.2, "layers": [)" + layers + "],",
                with(R"("models": {)", R"("models": { "adventitia": {"type": "plain"},)"));
  }
  /// Its first run on the tube alone, with or without a model.
  static std::string on_the_tube(const std::string& model) {
    return with(R"("model": "gho", "optimizer": "es",)", model + R"("tests": ["inflation"], "optimizer": "es",)",
                layered());
  }
};

TEST_F(Layers, AreReadFromInsideInBaseUnits) {
  const Experiment e = read(layered());
  const auto& layers = e.test("inflation").layers;
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers[0].model, "gho");
  EXPECT_DOUBLE_EQ(layers[0].thickness, 0.97);
  EXPECT_EQ(layers[1].model, "adventitia");
  EXPECT_DOUBLE_EQ(layers[1].thickness, 1.09);
  EXPECT_TRUE(e.test("circumferential_strip").layers.empty());
  EXPECT_EQ(e.models_of(e.runs[0]), (std::vector<std::string>{"gho", "adventitia"}));
  EXPECT_EQ(e.model_name(e.runs[0]), "gho");
  EXPECT_EQ(read(e.input_json).input_json, e.input_json);
}

TEST_F(Layers, MakeTheModelOfARunNeedlessOrNeeded) {
  const Experiment e = read(on_the_tube(""));
  EXPECT_EQ(e.runs[0].model, "");
  EXPECT_EQ(e.models_of(e.runs[0]), (std::vector<std::string>{"gho", "adventitia"}));
  EXPECT_EQ(e.model_name(e.runs[0]), "gho+adventitia");
  EXPECT_EQ(read(e.input_json).input_json, e.input_json);
  expect_within(refusal(on_the_tube(R"("model": "gho", )")),
                "the model 'gho' serves no test: every test of the run names its models in \"layers\" (/runs/0/model, "
                "line 46, column 6). Leave \"model\" out.");
  expect_within(refusal(with(R"("model": "gho", "optimizer": "es")", R"("optimizer": "es")", layered())),
                "the key 'model' is missing in a run (/runs/0, line 46, column 5). The test 'circumferential_strip' "
                "names no layers, so that it needs the model of the run.");
}

TEST_F(Layers, NameTheNearestModelOfAnUnknownOne) {
  expect_within(
      refusal(layered(R"({"model": "adventita", "thickness": "2.06 mm"})")),
      "unknown model 'adventita' (/tests/inflation/layers/0/model, line 30, column 92). Did you mean 'adventitia'? "
      "Known: adventitia, gho.");
}

TEST_F(Layers, RefuseWhatIsNoLayer) {
  expect_within(refusal(layered(R"({"model": "gho"})")),
                "the key 'thickness' is missing in a layer (/tests/inflation/layers/0");
  expect_within(refusal(layered(R"({"thickness": 1})")), "the key 'model' is missing in a layer");
  expect_within(refusal(layered(R"({"model": "gho", "thickness": 1, "angle": 2})")), "unknown key 'angle' in a layer");
  expect_within(refusal(layered(R"({"model": "gho", "thickness": 0})")),
                "the thickness of the layer is 0 mm (/tests/inflation/layers/0/thickness");
  expect_within(refusal(layered(R"({"model": "gho", "thickness": "1 kPa"})")),
                "the unit 'kPa' cannot be converted to 'mm'");
  expect_within(refusal(layered(R"("gho")")),
                "found the text 'gho' where a layer, {\"model\": …, \"thickness\": …}, is expected");
  expect_within(refusal(layered("")), "the list of layers is empty (/tests/inflation/layers");
  expect_within(refusal(R"("axial_stretch": 1.2)", R"("layers": {})"),
                "found an object where a list of layers from inside");
}

TEST_F(Layers, BelongToTestsThatTakeThem) {
  expect_within(refusal(R"("weight": 1,)", R"("layers": [{"model": "gho", "thickness": 1}],)"),
                "a test of type 'uniaxial' has one model throughout and takes no layers "
                "(/tests/circumferential_strip/layers, line 25, column 7). Tests that take layers: "
                "thick_wall_pressurisation.");
}

}  // namespace
}  // namespace tunica::experiment
