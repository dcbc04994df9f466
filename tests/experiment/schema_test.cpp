// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "experiment/reading.hpp"

namespace tunica::experiment {
namespace {

using nlohmann::json;

struct Schema : testing::Reading {
  Schema() {
    valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(text), compiled);
  }
  bool valid(const json& instance) {
    valijson::Validator validator;
    return validator.validate(compiled, valijson::adapters::NlohmannJsonAdapter(instance), nullptr);
  }
  bool accepts(const std::string& experiment) { return valid(json::parse(experiment, nullptr, true, true)); }
  bool accepts(std::string_view piece, std::string_view replacement) { return accepts(with(piece, replacement)); }

  json text = json::parse(compose_schema(testing::fake_catalogue()));
  valijson::Schema compiled;
};

TEST_F(Schema, RequiresTheKeysWithoutWhichTheReaderRefuses) {
  EXPECT_EQ(text.at("required"), (json{"format", "models", "tests", "optimizers", "runs"}));
  for (const std::string key : text.at("required")) {
    json lacking = json::parse(testing::design_example, nullptr, true, true);
    lacking.erase(key);
    EXPECT_FALSE(valid(lacking)) << key;
    EXPECT_NE(refusal(lacking.dump()).find("the key '" + key + "' is missing in the experiment file"),
              std::string::npos)
        << refusal(lacking.dump());
  }
}

TEST_F(Schema, AcceptsWhatTheReaderAccepts) {
  EXPECT_TRUE(accepts(testing::design_example));
  EXPECT_TRUE(accepts(read(testing::design_example).input_json)) << "the input file with every default";
  const std::vector<std::pair<std::string_view, std::string_view>> variants = {
      {R"("hold_out": false)", R"("hold_out": "0:20")"},
      {R"("weight": 1)", R"("weight": [2.5])"},
      {R"("h": 0.7)", R"("h": [[1, 1], [1.5, 0.7]])"},
      {R"("on_failure": "penalise")", R"("on_failure": {"policy": "retry", "max_rate": "50 %"})"},
      {R"("on_failure": "penalise")", R"("fewer_simulations": {"guide": true}, "keep_evaluations": "improvements")"},
      {R"("realisations": 100)", R"("fewer_simulations": {"early_end": false})"},
      {R"("file": "circ.csv")", R"("files": ["circ.csv", "circ2.csv"])"},
      {R"(["es", "lm"])", R"(["es", {"optimizer": "lm", "stop": {"max_evaluations": 100}}])"},
      {R"({"relative": 0.02})", R"({"stress": {"absolute": "1 Pa", "correlation": 0.3}})"},
      {R"("rows": "0:240:6")", R"("where": {"stretch": 1}, "time_from": {"rate": "1 %/s"})"},
      {R"("rows": "0:240:6")", R"("order": "unknown")"},
      {R"("kappa": {"min": 0, "max": 0.3333})",
       R"("kappa": {"fixed": 0.1}, "theta": {"prior": {"mean": "45 deg", "sd": 5}})"},
      {R"({"type": "standardised_quadratic"})", R"("sum_of_norms")"},
      {R"("realisations": 100)", R"("tests": ["inflation"], "constraints": [], "stop": {"stall": 3})"},
      {R"("axial_stretch": 1.2,)",
       R"("layers": [{"model": "gho", "thickness": "0.97 mm"}, {"model": "gho", "thickness": 1}],)"},
      {R"("weight": 1,)", R"("mechanisms": [{"type": "force_offset"}, {"type": "outliers", "rows": "3"}],)"}};
  for (const auto& [piece, replacement] : variants) {
    EXPECT_EQ(refusal(piece, replacement), "");
    EXPECT_TRUE(accepts(piece, replacement)) << replacement;
  }
}

TEST_F(Schema, RefusesWhatTheReaderRefuses) {
  const std::vector<std::pair<std::string_view, std::string_view>> variants = {
      {R"("seed": 7)", R"("sead": 7)"},
      {R"("format": 1)", R"("format": 2)"},
      {R"("kappa": {)", R"("kapa": {)"},
      {R"("kappa": {"min": 0, "max": 0.3333})", R"("kappa": {"fixed": 0.1, "min": 0})"},
      {R"("type": "gho")", R"("type": "goh")"},
      {R"("type": "uniaxial")", R"("type": "uniaxal")"},
      {R"("direction": "circumferential",)", ""},
      {R"("direction": "circumferential")", R"("direction": "radial")"},
      {R"("parents": 30)", R"("parents": 0)"},
      {R"("parents": 30)", R"("parent": 30)"},
      {R"({"type": "viscoelasticity"})", R"({"type": "force_offset"})"},
      {R"("weight": 1,)", R"("mechanisms": [{"type": "viscoelasticity"}],)"},
      {R"("file": "circ.csv")", R"("file": "circ.csv", "files": ["circ.csv"])"},
      {R"("file": "circ.csv",)", ""},
      {R"({"stretch": "stretch", "stress": "stress"})", R"({"stress": "stress"})"},
      {R"({"stretch": "stretch", "stress": "stress"})", R"({"stretch": "stretch", "strss": "stress"})"},
      {R"("rows": "0:240:6")", R"("rows": "0-240")"},
      {R"("gho": {)", R"("g.ho": {)"},
      {R"("h": 0.7)", R"("h": 1.7)"},
      {R"("on_failure": "penalise")", R"("on_failure": "ignore")"},
      {R"("on_failure": "penalise")", R"("fewer_simulations": {"guide": 1})"},
      {R"("on_failure": "penalise")", R"("keep_evaluations": "none")"},
      {R"("3.71 mm")", R"("wide")"},
      {R"("stall": 500)", R"("stall": 0)"},
      {R"("stages": ["es", "lm"])", R"("stages": ["es", "lm"], "parents": 3)"},
      {R"("model": "gho", "optimizer": "es", )", R"("model": "gho", )"},
      {R"("axial_stretch": 1.2,)", R"("layers": [],)"},
      {R"("axial_stretch": 1.2,)", R"("layers": [{"model": "gho"}],)"},
      {R"("axial_stretch": 1.2,)", R"("layers": [{"model": "gho", "thickness": "0.97 mm", "angle": 3}],)"},
      {R"("weight": 1,)", R"("layers": [{"model": "gho", "thickness": "0.97 mm"}],)"},
      {R"("alpha": 0.05)", R"("alpha": 1)"}};
  for (const auto& [piece, replacement] : variants) {
    EXPECT_NE(refusal(piece, replacement), "") << replacement;
    EXPECT_FALSE(accepts(piece, replacement)) << replacement;
  }
}

TEST_F(Schema, CarriesTheDeclarationsOfThePlugins) {
  const json& mu = text["definitions"]["model_gho"]["properties"]["parameters"]["properties"]["mu"];
  EXPECT_EQ(mu["description"],
            "Shear modulus of the matrix [kPa]. Default: 10 within 0.1 to 500, scale log. Gasser et al. 2006");
  const json& radius = text["definitions"]["test_thick_wall_pressurisation"]["properties"]["inner_radius"];
  EXPECT_EQ(radius["type"], json({"number", "string"}));
  EXPECT_EQ(radius["minimum"], 1e-3);
  EXPECT_EQ(text["definitions"]["optimizer_es"]["properties"]["parents"]["default"], 15);
  // Parameters that only some value of an option brings are there too.
  const json& series = text["definitions"]["model_series"]["properties"]["parameters"]["properties"];
  EXPECT_TRUE(series.contains("c_1") && series.contains("c_4"));
  EXPECT_EQ(series.size(), 4u);
}

struct ResultSchema : ::testing::Test {
  static json load(const char* file) {
    std::ifstream stream(std::filesystem::path(TUNICA_SOURCE_DIR) / file);
    return json::parse(stream);
  }
  ResultSchema() {
    valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(text), compiled);
  }
  bool accepts(const json& result) {
    valijson::Validator validator;
    return validator.validate(compiled, valijson::adapters::NlohmannJsonAdapter(result), nullptr);
  }
  json text = load("schemas/tunica-result.schema.json"), sample = load("tests/experiment/result_sample.json");
  valijson::Schema compiled;
};

TEST_F(ResultSchema, AcceptsTheSample) { EXPECT_TRUE(accepts(sample)); }

TEST_F(ResultSchema, HoldsTheStabilityOfOneModelOrOfSeveralByName) {
  const json condition = {
      {"holds", true}, {"first_lost", nullptr}, {"path", "a strip"}, {"checked_to", 1.5}, {"paths", json::object()}};
  const json of_model = {{"transverse", json::array()}, {"ellipticity", condition},      {"drucker", nullptr},
                         {"free_faces", nullptr},       {"inadmissible", json::array()}, {"sentences", json::array()}};
  json& stability = sample["/runs/0/best/stability"_json_pointer];
  const json common = {{"imposed", nullptr}, {"ratio_to_free", nullptr}};
  stability = common;
  EXPECT_FALSE(accepts(sample)) << "of no model";
  stability.update(of_model);
  EXPECT_TRUE(accepts(sample));
  stability = common;
  stability["models"] = {{"media", of_model}, {"adventitia", of_model}};
  EXPECT_TRUE(accepts(sample));
  stability["models"]["media"].erase("ellipticity");
  EXPECT_FALSE(accepts(sample));
}

TEST_F(ResultSchema, RefusesWhatReadersCouldNotUse) {
  const std::vector<std::pair<const char*, json>> damages = {{"/format", 2},
                                                             {"/warnings", "none"},
                                                             {"/runs/0/best/parameters/mu", json{{"value", 1}}},
                                                             {"/runs/0/best/parameters/mu/ci95", json{1, 2, 3}},
                                                             {"/runs/0/best/parameters/mu/at_bound", "both"},
                                                             {"/runs/0/best/status", "fine"},
                                                             {"/runs/0/evaluations", -1},
                                                             {"/runs/0/statistics/success_rate", 2},
                                                             {"/diagnosis/verdict", "guilty"},
                                                             {"/diagnosis/causes/0/p_value", 1.5},
                                                             {"/provenance/input_sha256", "abc"}};
  for (const auto& [pointer, value] : damages) {
    json damaged = sample;
    damaged[json::json_pointer(pointer)] = value;
    EXPECT_FALSE(accepts(damaged)) << pointer;
  }
  for (const char* key : {"runs", "ranking", "identifiability", "warnings", "provenance"}) {
    json damaged = sample;
    damaged.erase(key);
    EXPECT_FALSE(accepts(damaged)) << key;
  }
}

}  // namespace
}  // namespace tunica::experiment
