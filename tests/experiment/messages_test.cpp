// SPDX-License-Identifier: Apache-2.0
#include "experiment/reading.hpp"

namespace tunica::experiment {
namespace {

using testing::expect_within;
struct Messages : testing::Reading {};

TEST_F(Messages, NameTheNearestKeyOfAnUnknownOne) {
  EXPECT_EQ(refusal(R"("seed": 7)", R"("sead": 7)"),
            "experiment.json: unknown key 'sead' in the experiment file (/sead, line 3, column 38). Did you mean "
            "'seed'? Known: $schema, format, "
            "name, seed, models, states, tests, optimizers, objective, constraints, stop, initial, "
            "fewer_simulations, paired_starts, runs, on_failure, "
            "keep_evaluations, analysis, diagnosis, discovery.");
  expect_within(refusal(R"("rows": )", R"("row": )"),
                "unknown key 'row' in the data of test 'circumferential_strip' (/tests/circumferential_strip/data/row, "
                "line 22, column 9). Did you mean 'rows'?");
  expect_within(
      refusal(R"("parents": 30)", R"("parent": 30)"),
      "unknown key 'parent' in optimizer 'es' (/optimizers/es/parent, line 40, column 26). Did you mean 'parents'?");
  expect_within(refusal(R"("stall": 500)", R"("stalled": 500)"),
                "unknown key 'stalled' in \"stop\" (/stop/stalled, line 44");
  expect_within(refusal(R"("realisations": 100)", R"("realizations": 100)"), "Did you mean 'realisations'?");
  expect_within(refusal(R"("axial_stretch": 1.2)", R"("axial_strech": 1.2)"), "Did you mean 'axial_stretch'?");
  expect_within(refusal(R"({"type": "standardised_quadratic"})", R"({"type": "least_squares", "p": 1})"),
                "unknown key 'p' in the objective (/objective/p");
  expect_within(refusal(R"("h": 0.7)", R"("hh": 0.7)"),
                "unknown key 'hh' in the constraint 'transverse_stability' (/constraints/0/hh");
  expect_within(refusal(R"("alpha": 0.05)", R"("alfa": 0.05)"), "Did you mean 'alpha'?");
}

TEST_F(Messages, CheckTheFormatFirst) {
  EXPECT_EQ(refusal(R"("format": 1)", R"("format": 2)"),
            "experiment.json: found format 2 where 1 is expected (/format, line 3, column 3). This version of tunica "
            "reads format 1 only.");
  expect_within(refusal(R"("format": 1, )", ""),
                "the key 'format' is missing in the experiment file (line 1, column 1)");
  expect_within(refusal("[]"), "found a list where an experiment, { \"format\": 1, … }, is expected");
}

TEST_F(Messages, NameMissingKeys) {
  expect_within(refusal("{\"format\": 1}"), "the key 'models' is missing in the experiment file");
  expect_within(
      refusal(R"("type": "uniaxial",)", ""),
      "the key 'type' is missing in test 'circumferential_strip' (/tests/circumferential_strip, line 15, column 5)");
  expect_within(refusal(R"("direction": "circumferential",)", ""),
                "the option 'direction' is missing in test 'circumferential_strip' (/tests/circumferential_strip, line "
                "15, column 5). Add it. The loading axis");
  expect_within(refusal(R"("file": "circ.csv",)", ""),
                "the key 'file' is missing in the data of test 'circumferential_strip'");
  expect_within(refusal(R"("columns": {"stretch": "stretch", "stress": "stress"},)", ""),
                "the key 'columns' is missing");
  expect_within(refusal(R"("optimizer": "es", )", ""),
                "the key 'optimizer' is missing in a run (/runs/0, line 46, column 5)");
}

TEST_F(Messages, NameWrongTypes) {
  expect_within(refusal(R"("seed": 7)", R"("seed": -7)"),
                "found the number -7 where a whole number from 0 is expected (/seed, line 3");
  expect_within(refusal(R"("seed": 7)", R"("seed": 18446744073709551616)"),
                "where a whole number from 0 to 18446744073709551615 is expected (/seed, line 3");
  expect_within(refusal(R"("seed": 7)", R"("seed": "7")"),
                "found the text '7' where a whole number from 0 is expected");
  expect_within(refusal(R"("name": "lamb-aorta")", R"("name": null)"), "found null where a name is expected (/name");
  expect_within(
      refusal(R"("stall": 500)", R"("stall": 0)"),
      "found the number 0 where a whole number of evaluations from 1 to 1000000000000 is expected (/stop/stall");
  expect_within(refusal(R"("parents": 30)", R"("parents": 1.5)"),
                "found the number 1.5 where the option 'parents', a whole number, is expected");
  expect_within(refusal(R"("parents": 30)", R"("parents": 0)"),
                "the option 'parents' is 0, less than its least value 1 (/optimizers/es/parents");
  expect_within(refusal(R"("parents": 30)", R"("parents": -5)"),
                "the option 'parents' is -5, less than its least value 1");
  expect_within(refusal(R"("axial_stretch": 1.2)", R"("axial_stretch": 20)"),
                "the option 'axial_stretch' is 20, more than its largest value 10");
  expect_within(refusal(R"("3.71 mm")", R"("3.71 mN")"), "the unit 'mN' cannot be converted to 'mm'");
  expect_within(refusal(R"("starts": 20)", R"("polish": 1)"),
                "found the number 1 where the option 'polish', true or false, is expected");
  expect_within(refusal(R"("selection": "plus")", R"("selection": "pluss")"),
                "'pluss' (/optimizers/es/selection, line 40, column 59). Did you mean 'plus'? Known: plus, comma.");
  expect_within(refusal(R"("10 min")", R"("10 kPa")"), "the unit 'kPa' cannot be converted to 's'");
  expect_within(refusal(R"("10 min")", R"("-1 s")"), "the time limit is -1 s");
  expect_within(refusal(R"("runs": [)", R"("runs": {"a": [)"), "The '{' of line 1 is not closed: a '}' is missing.");
  EXPECT_EQ(read(with(R"("max_evaluations": 60000)", R"("max_evaluations": 6e4)")).runs[0].stop.max_evaluations,
            60000u);
}

TEST_F(Messages, AnswerUnknownTypesWithTheNearest) {
  expect_within(
      refusal(R"("type": "gho")", R"("type": "goh")"),
      "unknown model type 'goh' (/models/gho/type, line 6, column 7). Did you mean 'gho'? Known: gho, plain, series.");
  expect_within(
      refusal(R"("type": "uniaxial")", R"("type": "uniaxal")"),
      "unknown test type 'uniaxal' (/tests/circumferential_strip/type, line 16, column 7). Did you mean 'uniaxial'?");
  expect_within(refusal(R"("type": "ceres_lm")", R"("type": "ceres")"),
                "unknown optimizer type 'ceres' (/optimizers/lm/type, line 41, column 12). Did you mean 'ceres_lm'?");
  expect_within(refusal(R"("type": "viscoelasticity")", R"("type": "viscoelastic")"),
                "unknown mechanism 'viscoelastic' (/models/gho/mechanisms/0/type, line 11, column 24). Did you mean "
                "'viscoelasticity'?");
  expect_within(refusal(R"({"type": "standardised_quadratic"})", R"("sum_of_norm")"),
                "unknown objective 'sum_of_norm' (/objective, line 37, column 3). Did you mean 'sum_of_norms'?");
  expect_within(refusal(R"("on_failure": "penalise")", R"("on_failure": "penalize")"),
                "unknown failure policy 'penalize' (/on_failure, line 49, column 3). Did you mean 'penalise'?");
  expect_within(refusal(R"("on_failure": "penalise")", R"("keep_evaluations": "improvement")"),
                "unknown set of evaluations 'improvement' (/keep_evaluations, line 49, column 3). Did you mean "
                "'improvements'?");
  expect_within(refusal(R"("on_failure": "penalise")", R"("fewer_simulations": {"early_ends": true})"),
                "unknown key 'early_ends' in \"fewer_simulations\" (/fewer_simulations/early_ends, line 49");
  expect_within(refusal(R"("on_failure": "penalise")", R"("fewer_simulations": {"guide": "long"})"), "true or false");
  expect_within(refusal("transverse_stability", "transverse_stabilty"),
                "unknown constraint 'transverse_stabilty' (/constraints/0/type, line 38, column 21). Did you mean "
                "'transverse_stability'?");
  expect_within(refusal(R"("stress_measure": "cauchy")", R"("stress_measure": "first_piola")"),
                "unknown stress measure 'first_piola' (/tests/circumferential_strip/data/stress_measure, line 21, "
                "column 9). Did you mean 'first_piola_kirchhoff'?");
}

TEST_F(Messages, AnswerUnknownNamesInRunsWithTheNearest) {
  expect_within(refusal(R"("model": "gho", "optimizer": "es")", R"("model": "ghoo", "optimizer": "es")"),
                "unknown model 'ghoo' (/runs/0/model, line 46, column 6). Did you mean 'gho'? Known: gho.");
  expect_within(
      refusal(R"("model": "gho", "optimizer": "es")", R"("model": "gho", "optimizer": "ess")"),
      "unknown optimizer 'ess' (/runs/0/optimizer, line 46, column 22). Did you mean 'es'? Known: es, lm, hybrid.");
  expect_within(refusal(R"("realisations": 100)", R"("tests": ["inflaton"])"),
                "unknown test 'inflaton' (/runs/0/tests/0, line 46, column 51). Did you mean 'inflation'?");
  expect_within(
      refusal(R"({"model": "gho", "optimizer": "lm", "alpha")", R"({"model": "gho", "optimizer": "lmm", "alpha")"),
      "unknown optimizer 'lmm' (/diagnosis/optimizer, line 50");
}

TEST_F(Messages, RefuseNamesThatCannotBePartOfParameterNames) {
  EXPECT_EQ(
      refusal(R"("gho": {)", R"("g.ho": {)"),
      "experiment.json: the model name 'g.ho' contains a dot (/models/g.ho, line 5, column 5). Dots join the parts of "
      "parameter names, as in "
      "viscoelasticity.tau; use '_' or '-' instead.");
  expect_within(refusal(R"("inflation": {)", R"("in/flation": {)"),
                "the test name 'in/flation' cannot be part of file and parameter names (/tests/in~1flation, line 28");
  expect_within(refusal(R"("hybrid": {)", R"("": {)"),
                "the optimizer name '' cannot be part of file and parameter names");
  expect_within(refusal(R"("inflation": {)", R"("circumferential_strip": {)"),
                "the key 'circumferential_strip' appears twice in the same object (/tests/circumferential_strip, line "
                "28, column 5). It was given before in line 15");
}

TEST_F(Messages, NameMissingDataFiles) {
  const std::string message = refusal(R"("file": "circ.csv")", R"("file": "cric.csv")");
  expect_within(message,
                "experiment.json: the data file 'cric.csv' does not exist (/tests/circumferential_strip/data/file, "
                "line 19, column 9). Did you mean 'circ.csv'? Looked for ");
  expect_within(refusal(R"("file": "circ.csv")", R"("file": "")"), "the data file '' does not exist");
  expect_within(refusal(R"("file": "circ.csv")", R"("files": [])"), "the list of files is empty");
  expect_within(refusal(R"("file": "circ.csv")", R"("file": "circ.csv", "files": ["circ.csv"])"),
                "have \"file\" and \"files\"");
  expect_within(refusal(R"("file": "circ.csv")", R"("files": ["circ.csv", "circ.csv"])"),
                "this file appears twice in the list");
}

TEST_F(Messages, CheckTheMappingOfColumns) {
  constexpr std::string_view columns = R"({"stretch": "stretch", "stress": "stress"})";
  expect_within(refusal(columns, R"({"strech": "stretch", "stress": "stress"})"),
                "unknown observable 'strech' of test 'circumferential_strip' "
                "(/tests/circumferential_strip/data/columns/strech, line 20, column 21). Did you mean 'stretch'?");
  expect_within(refusal(columns, R"({"stress": "stress"})"),
                "no column is mapped to 'stretch', which test 'circumferential_strip' needs");
  const std::string quiet =
      with(R"("rows": "0:240:6",)", "", with(R"("noise": {"relative": 0.02})", R"("rows": "0:6")"));
  EXPECT_FALSE(read(with(columns, R"({"stretch": "stretch"})", quiet)).test("circumferential_strip").measured);
  expect_within(refusal(columns, R"({"stretch": true, "stress": "stress"})"),
                "found true where the name of a column, or its number is expected");
}

TEST_F(Messages, CheckWeights) {
  expect_within(
      refusal(R"("weight": 1)", R"("weight": [1, 2])"),
      "found 2 weights for the one mapped channel of test 'circumferential_strip' "
      "(/tests/circumferential_strip/weight, line 25, column 7). Give one number for all, or one per channel");
  expect_within(refusal(R"("weight": 1)", R"("weight": -1)"), "the weight is -1");
  expect_within(refusal(R"("weight": 1)", R"("weight": "1")"), "found the text '1' where a weight is expected");
}

TEST_F(Messages, CheckRowRanges) {
  EXPECT_EQ(refusal(R"("hold_out": false)", R"("hold_out": "200-240")"),
            "experiment.json: '200-240' is not a row range: '200-240' is not a row number "
            "(/tests/circumferential_strip/hold_out, line 26, column 7). "
            "Expected \"first:last\" or \"first:last:step\" as in \"0:240:6\": rows count from 0, negative "
            "numbers from the end, last is not included, and each number may be left out.");
  expect_within(refusal(R"("hold_out": false)", R"("hold_out": 3)"),
                "found the number 3 where true, false or a row range such as \"200:240\" is expected");
  expect_within(refusal("0:240:6", "5"), "'5' is not a row range: it has 1 part");
  expect_within(refusal("0:240:6", "0:240:6:1"), "it has 4 parts");
  expect_within(refusal("0:240:6", "0:240:0"), "the step is 0");
  expect_within(refusal("0:240:6", "240:0"), "it ends before it begins");
  expect_within(refusal("0:240:6", "0:240:-6"), "the step is negative");
  expect_within(refusal("0:240:6", "-5:-8"), "it ends before it begins");
  expect_within(refusal("0:240:6", "1.5:"), "'1.5' is not a row number");
  EXPECT_TRUE(read(with(R"("hold_out": false)", R"("hold_out": true)")).test("circumferential_strip").hold_out.all);
  EXPECT_EQ(
      read(with(R"("hold_out": false)", R"("hold_out": ":20")")).test("circumferential_strip").hold_out.rows->last, 20);
  expect_within(
      refusal(
          R"({"model": "gho", "optimizer": "lm"}
  ])",
          R"({"model": "gho", "optimizer": "lm", "tests": {"t": {"type": "uniaxial", "direction": "axial", "hold_out": true,
    "data": {"file": "circ.csv", "columns": {"stretch": "stretch", "stress": "stress"}}}}}
  ])"),
      "every test of the run is held out");
}

TEST_F(Messages, CheckNoise) {
  const auto noise = [&](std::string_view text) { return refusal(R"({"relative": 0.02})", text); };
  expect_within(noise(R"({"relativ": 0.02})"),
                "unknown key 'relativ' in the noise of 'stress' (/tests/circumferential_strip/data/noise/relativ, line "
                "23, column 19). Did you mean 'relative'?");
  expect_within(noise(R"({"strain": {"relative": 0.02}})"),
                "noise is given for 'strain', which is not a mapped channel");
  expect_within(noise(R"({"relative": -0.02})"), "the relative noise is -0.02");
  expect_within(noise(R"({"absolute": "-1 Pa"})"), "the absolute noise is -0.001");
  expect_within(noise(R"({"correlation": 0.5})"), "the noise of 'stress' is zero");
  expect_within(noise(R"({"relative": 0.02, "correlation": 1})"), "the correlation 1 is not between -1 and 1");
  expect_within(noise(R"({"absolute": "1 mm"})"), "the unit 'mm' cannot be converted to 'kPa'");
}

TEST_F(Messages, CheckTheOrderOfRows) {
  expect_within(refusal(R"("rows": "0:240:6")", R"("order": "unloading")"), "unknown order of rows 'unloading'");
}

TEST_F(Messages, CheckTimeFromARate) {
  const auto rate = [&](std::string_view text) {
    return refusal(R"("rows": "0:240:6")", R"("time_from": )" + std::string(text));
  };
  expect_within(rate(R"({"rate": 0})"), "the rate is 0");
  expect_within(rate(R"({"rate": "0.01 mm/s"})"), "the unit 'mm/s' cannot be converted to '1/s'");
  expect_within(rate(R"({"speed": 1})"), "unknown key 'speed' in \"time_from\"");
  expect_within(refusal(with(R"("rows": "0:240:6")", R"("time_from": {"rate": 1})",
                             with(R"("stress": "stress"})", R"("stress": "stress", "time": "stress"})"))),
                "the column 'stress' is mapped to 'time' too");
}

TEST_F(Messages, CheckStages) {
  constexpr std::string_view stages = R"(["es", "lm"])";
  EXPECT_EQ(refusal(stages, R"(["es", "hybrid"])"),
            "experiment.json: the optimizer 'hybrid' names itself as a stage (/optimizers/hybrid/stages/1, line 42, "
            "column 33). A stage is another "
            "entry of \"optimizers\".");
  expect_within(refusal(stages, R"(["es", "ml"])"), "unknown optimizer 'ml' (/optimizers/hybrid/stages/1");
  expect_within(refusal(stages, "[]"), "the optimizer 'hybrid' has no stages");
  expect_within(refusal(stages, R"(["other"]}, "other": {"stages": ["es"])"),
                "the stage 'other' of 'hybrid' has stages itself");
  expect_within(refusal(R"("hybrid": {)", R"("hybrid": {"type": "es", )"), "unknown type of a staged optimizer 'es'");
}

TEST_F(Messages, CheckMechanisms) {
  expect_within(refusal(R"({"type": "viscoelasticity"})", R"({"type": "force_offset"})"),
                "the mechanism 'force_offset' acts on tests, not on models (/models/gho/mechanisms/0, line 11, column "
                "23). Write it in the \"mechanisms\" of a test.");
  expect_within(
      refusal(R"({"type": "viscoelasticity"})", R"({"type": "viscoelasticity"}, {"type": "viscoelasticity"})"),
      "the mechanism 'viscoelasticity' appears twice in model 'gho'");
  expect_within(refusal(R"({"type": "viscoelasticity"})",
                        R"({"type": "viscoelasticity", "as": "slow"}, {"type": "viscoelasticity", "as": "slow"})"),
                "the mechanism 'slow' appears twice in model 'gho'");
  expect_within(refusal(R"("weight": 1,)", R"("mechanisms": [{"type": "viscoelasticity"}],)"),
                "the mechanism 'viscoelasticity' acts on models, not on tests");
  expect_within(refusal(R"("axial_stretch": 1.2,)", R"("mechanisms": [{"type": "force_offset"}],)"),
                "the mechanism 'force_offset' does not apply to tests of type 'thick_wall_pressurisation' "
                "(/tests/inflation/mechanisms/0, line 30");
  expect_within(
      refusal(
          R"("models": {)",
          R"("models": {"p": {"type": "plain", "mechanisms": [{"type": "viscoelasticity"}, {"type": "fibre_recruitment"}]},)"),
      "the mechanism 'fibre_recruitment' cannot act on this model (/models/p/mechanisms/1, line "
      "4, column 81). plugin 'fake 0.1.0': it needs fibres, and this energy has none");
}

TEST_F(Messages, PassOnWhatAPluginRefuses) {
  expect_within(refusal(R"("parents": 30, "offspring": 120, "selection": "plus")",
                        R"("parents": 30, "offspring": 10, "selection": "comma")"),
                "optimizer 'es' is refused (/optimizers/es, line 40, column 5). plugin 'fake 0.1.0': comma selection "
                "needs more offspring than parents");
}

TEST_F(Messages, CheckConstraintsAndDiagnosis) {
  expect_within(refusal(R"("h": 0.7)", R"("h": 1.7)"),
                "found the number 1.7 where a number from 0 to 1, or a table [[stretch, h], …] with rising stretches, "
                "is expected (/constraints/0/h, line 38");
  expect_within(refusal(R"("h": 0.7)", R"("h": [[1.2, 1], [1.1, 0.7]])"), "the stretch 1.1 does not lie above 1.2");
  expect_within(refusal(R"("h": 0.7)", R"("h": [[1.2]])"), "where a pair [stretch, h] is expected");
  expect_within(refusal(R"("alpha": 0.05)", R"("alpha": 5)"), "the significance level is 5");
  expect_within(refusal(R"("alpha": 0.05)", R"("alpha": 0.00009)"), "the significance level is 9e-05");
  expect_within(refusal(R"("mechanisms": "all")", R"("mechanisms": "none")"), "unknown set of mechanisms 'none'");
  expect_within(read(with(R"("h": 0.7)", R"("h": [[1, 1], [1.5, 0.7]])")).runs[0].constraints[0].pointer,
                "experiment.json (/constraints/0, line 38, column ");
}

TEST_F(Messages, RefuseEmptyBlocks) {
  expect_within(refusal(R"({"format": 1, "models": {}, "tests": {}, "optimizers": {}, "runs": []})"),
                "no model is given");
  expect_within(
      refusal(R"({"format": 1, "models": {"p": {"type": "plain"}}, "tests": {}, "optimizers": {}, "runs": []})"),
      "no test is given");
  expect_within(refusal(with(R"("runs": [
    {"model": "gho", "optimizer": "es", "realisations": 100},
    {"model": "gho", "optimizer": "lm"}
  ])",
                             R"("runs": [])")),
                "no run is given");
  expect_within(refusal(R"("on_failure": "penalise")", R"("on_failure": {"policy": "stop", "max_rate": 1.5})"),
                "the share of failed evaluations is 1.5");
}

}  // namespace
}  // namespace tunica::experiment
