// SPDX-License-Identifier: Apache-2.0
#include "experiment/reading.hpp"

namespace tunica::experiment {
namespace {

using testing::expect_within;
struct Parameters : testing::Reading {};

constexpr std::string_view kappa = R"("kappa": {"min": 0, "max": 0.3333})";

TEST_F(Parameters, AnswerAnUnknownNameWithTheNearest) {
  EXPECT_EQ(refusal(kappa, R"("kapa": {"min": 0, "max": 0.3333})"),
            "experiment.json: unknown parameter 'kapa' of model 'gho' (/models/gho/parameters/kapa, line 9, column 9). "
            "Did you mean 'kappa'? "
            "Known: mu, kappa, k1, k2, theta.");
  expect_within(refusal(kappa, R"("viscoelasticity.g": {"max": 1})"),
                "Parameters of a mechanism stand in the mechanism's own entry.");
  expect_within(
      refusal(R"({"type": "viscoelasticity"})", R"({"type": "viscoelasticity", "parameters": {"gg": {"max": 1}}})"),
      "unknown parameter 'gg' of mechanism 'viscoelasticity' (/models/gho/mechanisms/0/parameters/gg, line 11");
}

TEST_F(Parameters, AreThoseOfTheModelWithItsOptions) {
  const auto series = [](std::string_view body) {
    return with(R"("models": {)", R"("models": {"s": {"type": "series", )" + std::string(body) + "},");
  };
  EXPECT_EQ(read(series(R"("terms": 3, "parameters": {"c_3": {"max": 20}})")).model("s").parameters.size(), 3u);
  EXPECT_EQ(read(series(R"("parameters": {})")).model("s").parameters.size(), 2u);
  expect_within(refusal(series(R"("terms": 2, "parameters": {"c_3": {"max": 20}})")),
                "unknown parameter 'c_3' of model 's'");
  expect_within(refusal(series(R"("terms": 5)")), "the option 'terms' is 5, more than its largest value 4");
}

TEST_F(Parameters, RefuseReversedBounds) {
  EXPECT_EQ(refusal(R"("min": "0.5 kPa", "max": "200 kPa")", R"("min": "200 kPa", "max": "0.5 kPa")"),
            "experiment.json: the bounds of 'mu' of model 'gho' are reversed: min is 200 kPa, max is 0.5 kPa "
            "(/models/gho/parameters/mu, line 8, "
            "column 9). Swap them: min must be less than max.");
  expect_within(refusal(R"("min": "0.5 kPa", "max": "200 kPa")", R"("min": "0.9 MPa")"),
                "min is 900 kPa, max is 500 kPa (the default)");
  expect_within(refusal(kappa, R"("kappa": {"min": 0.2, "max": 0.2})"), "are equal: min is 0.2, max is 0.2");
}

TEST_F(Parameters, RefuseUnknownAndUnfitUnits) {
  EXPECT_EQ(refusal("0.5 kPa", "0.5 kPaa")
                .find("experiment.json: found '0.5 kPaa' where 'min' of parameter 'mu' in kPa is expected "
                      "(/models/gho/parameters/mu/min, line 8, column 16). unknown unit 'kPaa'. Did you mean 'kPa'?"),
            0u)
      << refusal("0.5 kPa", "0.5 kPaa");
  expect_within(refusal("0.5 kPa", "0.5 mm"), "the unit 'mm' cannot be converted to 'kPa'");
  expect_within(refusal("\"0.5 kPa\"", "true"),
                "found true where 'min' of parameter 'mu' (a number in kPa, or text with a unit such as \"1.5 kPa\") "
                "is expected");
}

TEST_F(Parameters, RefuseAnInitialValueOutsideTheBounds) {
  EXPECT_EQ(refusal(kappa, R"("kappa": {"max": 0.3, "initial": 0.4})"),
            "experiment.json: the initial value of 'kappa' of model 'gho', 0.4, is outside its bounds: 0 (the default) "
            "to 0.3 "
            "(/models/gho/parameters/kappa/initial, line 9, column 31). Move it inside, or widen the bounds.");
  expect_within(refusal(kappa, R"("theta": {"initial": "-1 deg"})"),
                "-1 deg, is outside its bounds: 0 deg (the default) to 90 deg (the default)");
}

TEST_F(Parameters, RefuseALogarithmicScaleFromZero) {
  EXPECT_EQ(
      refusal("0.5 kPa", "0 kPa"),
      "experiment.json: 'mu' of model 'gho' has \"scale\": \"log\" and the lower bound 0 kPa, which has no logarithm "
      "(/models/gho/parameters/mu, line 8, column 9). Give a \"min\" greater than zero, or \"scale\": \"linear\".");
  expect_within(refusal(kappa, R"("kappa": {"scale": "log"})"), "the lower bound 0 (the default)");
  expect_within(refusal(kappa, R"("k1": {"min": -3})"),
                "'k1' of model 'gho' has \"scale\": \"log\" and the lower bound -3 kPa");
  expect_within(refusal(R"("scale": "log")", R"("scale": "logarithmic")"), "unknown scale 'logarithmic'");
}

TEST_F(Parameters, RefuseFixedTogetherWithOtherKeys) {
  EXPECT_EQ(refusal(kappa, R"("kappa": {"fixed": 0.1, "min": 0, "share": "k"})"),
            "experiment.json: parameter 'kappa' is fixed but has 'min', 'share' as well (/models/gho/parameters/kappa, "
            "line 9, column 9). A fixed "
            "parameter is held at its value, so the other keys mean nothing: remove them, or \"fixed\".");
}

TEST_F(Parameters, HoldFixedValues) {
  const ParameterSetting setting =
      read(with(kappa, R"("theta": {"fixed": "1 rad"})")).model("gho").parameters.at("theta");
  EXPECT_NEAR(setting.fixed.value(), 57.29577951308232, 1e-12);
  EXPECT_FALSE(setting.min || setting.max || setting.initial || setting.scale);
}

TEST_F(Parameters, MoveADefaultStartIntoNarrowedBounds) {
  const Experiment e = read(with(kappa, R"("kappa": {"min": 0.2, "max": 0.3}, "theta": {"max": 30})"));
  EXPECT_EQ(e.model("gho").parameters.at("kappa").initial, 0.2);
  EXPECT_EQ(e.model("gho").parameters.at("theta").initial, 30);
}

TEST_F(Parameters, CarryPriorsAndRefuseBadOnes) {
  const ParameterSetting mu =
      read(with(R"("scale": "log")", R"("prior": {"mean": "10 kPa", "sd": "2 kPa"})")).model("gho").parameters.at("mu");
  EXPECT_EQ(mu.prior->mean, 10);
  EXPECT_EQ(mu.prior->sd, 2);
  EXPECT_EQ(refusal(R"("scale": "log")", R"("prior": {"mean": 10, "sd": 0})"),
            "experiment.json: the prior standard deviation of parameter 'mu' is 0 (/models/gho/parameters/mu/prior/sd, "
            "line 8, column 74). It must be "
            "greater than zero; to hold a parameter, use \"fixed\".");
  expect_within(refusal(R"("scale": "log")", R"("prior": {"mean": 10})"),
                "the key 'sd' is missing in the prior of parameter 'mu'");
  expect_within(refusal(R"("scale": "log")", R"("prior": {"mean": 10, "sdev": 1})"),
                "unknown key 'sdev' in the prior of parameter 'mu'");
}

TEST_F(Parameters, RefuseUnknownKeysAndWrongTypes) {
  expect_within(refusal(kappa, R"("kappa": {"maxx": 0.3})"),
                "unknown key 'maxx' in parameter 'kappa' (/models/gho/parameters/kappa/maxx, line 9, column 19). Did "
                "you mean 'max'?");
  expect_within(refusal(kappa, R"("kappa": 0.3)"), "found the number 0.3 where an object is expected");
}

TEST_F(Parameters, AreTiedByShareGroups) {
  const auto two_models = [](std::string_view first, std::string_view second) {
    std::string text = with(kappa, std::string(R"("k1": {)") + std::string(first) + "}");
    return with(R"("models": {)",
                R"("models": { "plain": {"type": "plain", "parameters": {"mu": {)" + std::string(second) + "}}},",
                text);
  };
  const Experiment e = read(two_models(R"("share": "stiff")", R"("share": "stiff", "initial": 20)"));
  EXPECT_EQ(e.model("gho").parameters.at("k1").share, "stiff");
  expect_within(refusal(two_models(R"("share": "stiff")", R"("share": "stiff", "initial": 20, "max": 9e3)")),
                "parameters of the share group 'stiff' have different upper bounds: 500 here, 9000 at "
                "/models/plain/parameters/mu (/models/gho/parameters/k1, line 9");
  expect_within(refusal(two_models(R"("share": "stiff")", R"("share": "stiff")")),
                "have different initial values: 20 here, 10 at");
  expect_within(refusal(two_models(R"("share": "stif")", R"("share": "stiff")")),
                "the share group 'stif' has only this one member (/models/gho/parameters/k1/share, line 9, column 16). "
                "Did you mean 'stiff'?");
  expect_within(refusal(with(kappa, R"("kappa": {"share": "a.b"})")), "the share group name 'a.b' contains a dot");
  expect_within(refusal(with(R"("min": "0.5 kPa", "max": "200 kPa", "scale": "log")", R"("share": "s")",
                             with(kappa, R"("theta": {"share": "s"})"))),
                "have different units: deg here, kPa at /models/gho/parameters/mu");
}

TEST_F(Parameters, OfATestAreCheckedAgainstWhatItsTypeDeclares) {
  const auto of_test = [](std::string_view block) {
    return with(R"("weight": 1,)", R"("parameters": )" + std::string(block) + ",");
  };
  const ParameterSettings settings =
      read(
          of_test(
              R"({"misalignment": {"min": "0 rad", "max": "5 deg"}, "gain": {"fixed": "2 %"}, "p": {"initial": "80 mmHg"}})"))
          .test("circumferential_strip")
          .parameters;
  EXPECT_EQ(settings.at("misalignment").max, 5);
  EXPECT_EQ(settings.at("gain").fixed, 0.02);
  EXPECT_EQ(settings.at("p").initial, 80 * 0.133322387415);
  expect_within(refusal(of_test(R"({"misalignment": {"min": 5, "max": 1}})")),
                "the bounds of 'misalignment' of test 'circumferential_strip' are reversed");
  EXPECT_EQ(settings.size(), 3u);
  EXPECT_TRUE(read(of_test("{}")).test("circumferential_strip").parameters.empty());  // at their nulls
  expect_within(refusal(of_test(R"({"misalignment": {"max": "1 kPaa"}})")), "unknown unit 'kPaa'");
  expect_within(refusal(of_test(R"({"misalignment": {"fixed": "3 kPa"}})")), "kPa");
  expect_within(refusal(of_test(R"({"misalinment": {"fixed": 3}})")), "Did you mean 'misalignment'?");
  expect_within(refusal(of_test(R"({"force_offset.value": {"max": 1}})")), "the mechanism's own entry");
}

}  // namespace
}  // namespace tunica::experiment
