// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include <nlohmann/json.hpp>

#include "experiment/enum_names.hpp"
#include "experiment/experiment.hpp"
#include "experiment/limits.hpp"
#include "experiment/reader.hpp"
#include "experiment/schema_parts.hpp"

namespace tunica::experiment {
namespace {

Json text_schema(std::string_view description) { return {{"description", description}, {"type", "string"}}; }
Json choice_schema(std::string_view description, const std::vector<std::string>& names) {
  return {{"description", description}, {"enum", names}};
}
Json count_schema(std::string_view description, std::uint64_t at_least, std::optional<std::uint64_t> at_most = {}) {
  Json schema = {{"description", description}, {"type", "integer"}, {"minimum", at_least}};
  if (at_most) schema["maximum"] = *at_most;
  return schema;
}
Json list_schema(std::string_view description, Json items) {
  return {{"description", description}, {"type", "array"}, {"items", std::move(items)}, {"maxItems", limits::entries}};
}

// What users name; dots join the parts of parameter names.
const char* const name_pattern = "^[^-. /\\\\][^. /\\\\]*$";

// Stands in its place rather than in the definitions: valijson refuses every object whose propertyNames lie behind a
// $ref.
Json named_entries(std::string_view description, Json entry) {
  Json schema = {{"description", description},
                 {"type", "object"},
                 {"minProperties", 1},
                 {"maxProperties", limits::entries},
                 {"additionalProperties", std::move(entry)}};
  schema["propertyNames"]["pattern"] = name_pattern;
  return schema;
}

void define_parameter(Json& definitions) {
  Json free = Json::object();
  free["min"] = quantity_schema("Lower bound.");
  free["max"] = quantity_schema("Upper bound.");
  free["initial"] = quantity_schema("Start of the search.");
  free["scale"] =
      choice_schema("How the search divides the range; log needs a lower bound above zero.", names_in(scale_names));
  free["share"] = {{"description", "Parameters with the same group are one unknown."},
                   {"type", "string"},
                   {"pattern", name_pattern}};
  free["prior"] = object_schema("A normal prior.",
                                {{"mean", quantity_schema("Mean.")}, {"sd", quantity_schema("Standard deviation.")}},
                                {"mean", "sd"});
  definitions["parameter"] = {
      {"description", "A parameter: searched between bounds, or held at `fixed`, which excludes the other keys."}};
  definitions["parameter"]["anyOf"] =
      Json::array({object_schema("Searched.", std::move(free)),
                   object_schema("Held.", {{"fixed", quantity_schema("The value held.")}}, {"fixed"})});
}

void define_data(Json& definitions) {
  definitions["stress_measure"] =
      choice_schema("Which stress the data give (default cauchy).", data::stress_measures());
  definitions["row_range"] = {
      {"description", "first:last:step, counted from 0, negative numbers from the end, last not included."},
      {"type", "string"},
      {"pattern", "^-?[0-9]*:-?[0-9]*(:[0-9]*)?$"}};
  definitions["rows"] = reference("row_range", "The rows to use, of those that match `where`.");
  Json value = {{"type", {"string", "number"}}};
  Json condition = Json::object();
  condition["anyOf"] = Json::array({value, list_schema("Any of several.", value)});
  definitions["where"] = {{"description", "Column → value, or a list of values: only rows that match every column."},
                          {"type", "object"},
                          {"additionalProperties", std::move(condition)}};
  definitions["order"] =
      choice_schema("Whether rows stand in the order in which they were measured (default unknown; time says it too).",
                    names_in(data::order_names));
  definitions["time_from"] = object_schema(
      "Time from the path of the abscissa, where none was recorded.",
      {{"rate", quantity_schema("Change of the first abscissa per second, for example \"0.01/s\".")}}, {"rate"});
  definitions["noise"] = object_schema(
      "σ² = absolute² + (relative·y)².",
      {{"absolute", quantity_schema("Standard deviation in the channel's unit.")},
       {"relative", quantity_schema("Standard deviation as a share of the value.")},
       {"correlation",
        {{"description", "Between neighbouring rows."}, {"type", "number"}, {"minimum", -1}, {"maximum", 1}}}});
  definitions["weight"] = {
      {"description", "Weight in the objective: one, or one per channel in the order of `columns` (default 1)."}};
  definitions["weight"]["anyOf"] = Json::array(
      {{{"type", "number"}, {"minimum", 0}}, {{"type", "array"}, {"items", {{"type", "number"}, {"minimum", 0}}}}});
  definitions["hold_out"] = {
      {"description",
       "Kept out of the fit, predicted and scored: all rows, or a range of the rows used (default false)."}};
  definitions["hold_out"]["anyOf"] = Json::array({{{"type", "boolean"}}, reference("row_range")});
}

void define_search(Json& definitions, const plugins::Catalogue& catalogue) {
  definitions["stop"] = object_schema(
      "When a search ends; means the same for every optimizer.",
      {{"max_evaluations", count_schema("Evaluations of the objective (default 60000).", 1, limits::evaluations)},
       {"max_time", quantity_schema("Time [s], for example \"10 min\"; gives up determinism.")},
       {"target", {{"description", "An objective that is good enough."}, {"type", "number"}}},
       {"stall", count_schema("Evaluations without improvement.", 1, limits::evaluations)}});
  Json stage = object_schema("A stage with its own stop.",
                             {{"optimizer", text_schema("Name of another optimizer.")}, {"stop", reference("stop")}},
                             {"optimizer"});
  Json stages = list_schema("Optimizers one after the other, each from the best point so far.", Json::object());
  stages["items"]["anyOf"] = Json::array({{{"type", "string"}}, std::move(stage)});
  stages["minItems"] = 1;
  definitions["staged"] = object_schema("Several optimizers in turn.",
                                        {{"type", {{"const", "stages"}}}, {"stages", std::move(stages)}}, {"stages"});
  Json optimizer = {{"description", "An optimizer of a type, or stages."}, {"type", "object"}};
  optimizer["if"]["required"] = {"stages"};
  optimizer["then"] = reference("staged");
  optimizer["else"] = by_type("optimizer", names_of(catalogue.optimizers()), "An optimizer.");
  definitions["optimizer"] = std::move(optimizer);

  definitions["objective"] = {{"description", "What is minimised (default standardised_quadratic)."}};
  definitions["objective"]["anyOf"] = Json::array(
      {choice_schema("Its type.", names_in(objective_names)),
       object_schema("As an object.", {{"type", choice_schema("Its type.", names_in(objective_names))}}, {"type"})});
  Json factor = {{"type", "number"}, {"minimum", 0}, {"maximum", 1}};
  Json pair = {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}};
  pair["items"] = Json::array({{{"type", "number"}, {"exclusiveMinimum", 0}}, factor});
  Json h = {{"description", "1 is the criterion itself; a number, or a table [[stretch, h], …]."}};
  Json table = list_schema("h over stretch.", std::move(pair));
  table["minItems"] = 1;
  h["anyOf"] = Json::array({std::move(factor), std::move(table)});
  Json range = list_schema("Stretches from, to: besides those that were measured.", {{"type", "number"}});
  range["minItems"] = 2;
  range["maxItems"] = 2;
  Json directions = {{"description", "Strips along which axes (default both)."}};
  directions["anyOf"] = Json::array(
      {{{"enum", {"circumferential", "axial"}}}, list_schema("Several.", {{"enum", {"circumferential", "axial"}}})});
  Json either = {{"description", "A condition on the parameters."}};
  either["anyOf"] = Json::array(
      {object_schema("The transverse stretch λ3 falls as the strip is pulled: d ln λ3/d ln λ1 ≤ −(1 − h)/2.",
                     {{"type", {{"const", "transverse_stability"}}},
                      {"h", std::move(h)},
                      {"range", std::move(range)},
                      {"points", count_schema("Evenly spaced stretches in place of every measured one.", 2,
                                              limits::stability_points)},
                      {"directions", std::move(directions)}},
                     {"type"}),
       object_schema("The inequalities that the model declares between its parameters.",
                     {{"type", {{"const", "admissible_parameters"}}}}, {"type"})});
  definitions["constraints"] = list_schema("Conditions on the parameters.", std::move(either));
}

Json initial_schema() {
  return choice_schema(
      "Where a search begins: at the initial values (given, the default), or every realisation at a random point.",
      {"given", "random"});
}

Json fewer_simulations_schema() {
  return object_schema(
      "What spares simulations of costly tests.",
      {{"early_end",
        {{"description",
          "Whether an evaluation ends where cheap tests show that a search will drop the point (default true); results "
          "stay the same."},
         {"type", "boolean"}}},
       {"guide",
        {{"description",
          "Whether cheaper tests stand in while a search looks around, corrected by simulations (default false)."},
         {"type", "boolean"}}}});
}

Json run_schema() {
  Json tests = {{"description", "The tests of this run: names, or tests of its own (default: all)."}};
  tests["anyOf"] =
      Json::array({list_schema("Names.", {{"type", "string"}}), named_entries("Tests of its own.", reference("test"))});
  return object_schema(
      "One calibration: a model, fitted by an optimizer.",
      {{"model", text_schema("Name of a model; left out where every test names its own in layers.")},
       {"optimizer", text_schema("Name of an optimizer.")},
       {"realisations", count_schema("Repetitions with other seeds (default 1).", 1, limits::realisations)},
       {"initial", initial_schema()},
       {"tests", std::move(tests)},
       {"objective", reference("objective")},
       {"constraints", reference("constraints")},
       {"stop", reference("stop")},
       {"fewer_simulations", fewer_simulations_schema()}},
      {"optimizer"});
}

Json analysis_schema() {
  Json profiles = {{"description", "Profile likelihood of these parameters, named as in results, or of all."}};
  profiles["anyOf"] = Json::array({choice_schema("Every one.", {"all"}), list_schema("Names.", {{"type", "string"}})});
  Json map =
      list_schema("Two free parameters: where between their bounds is the material stable?", {{"type", "string"}});
  map["minItems"] = 2;
  map["maxItems"] = 2;
  return object_schema(
      "Uncertainty of every run's best point, beyond the intervals that are always given.",
      {{"profiles", std::move(profiles)},
       {"bootstrap",
        object_schema("Residual bootstrap.",
                      {{"draws", count_schema("Data sets to draw.", limits::least_draws, limits::draws)}}, {"draws"})},
       {"posterior",
        object_schema("Draws from the posterior, by four chains together.",
                      {{"draws", count_schema("Draws.", limits::least_posterior_draws, limits::draws)},
                       {"discrepancy",
                        {{"description", "Allow for a smooth misfit of unknown size that the model does not explain."},
                         {"type", "boolean"}}}},
                      {"draws"})},
       {"optimizer", text_schema("Name of an optimizer for the refits (default: ceres_lm from the best point).")},
       {"stability", object_schema("Stability of the best points beyond what is always judged.",
                                   {{"to",
                                     {{"description", "Judge to this stretch instead of the largest measured one."},
                                      {"type", "number"},
                                      {"exclusiveMinimum", 1},
                                      {"maximum", 100}}},
                                    {"map", std::move(map)},
                                    {"points", count_schema("Points of the map along each parameter (default 41).", 2,
                                                            limits::map_points)}})}});
}

Json diagnosis_schema() {
  Json mechanisms = {{"description", "Which causes to consider (default all)."}};
  mechanisms["anyOf"] =
      Json::array({choice_schema("Every one.", {"all"}), list_schema("Names.", {{"type", "string"}})});
  return object_schema(
      "What the simulation gets wrong, and why.",
      {{"model", text_schema("Name of a model.")},
       {"optimizer", text_schema("Name of an optimizer.")},
       {"alpha",
        {{"description", "Significance level: the share of false alarms that is accepted."},
         {"type", "number"},
         {"minimum", 0.0001},
         {"maximum", 0.5}}},
       {"mechanisms", std::move(mechanisms)},
       {"admissibility", {{"description", "Lost stability changes the verdict."}, {"type", "boolean"}}},
       {"groups", list_schema("Where causes may lie (default: material, rig and file).",
                              choice_schema("A group of causes.", cause_groups))},
       {"wrong_files",
        {{"description", "Share of files that are expected to say what is not so (default 0.1)."},
         {"type", "number"},
         {"minimum", 0.0001},
         {"maximum", 0.9}}},
       {"tolerance",
        {{"description",
          "The misfit that is not worth caring about (default: the scatter between repeats, else 2 % of the range)."},
         {"anyOf", Json::array({text_schema("A share of the range, as \"2 %\"."),
                                {{"description", "By observable: a share, or a quantity in its unit."},
                                 {"type", "object"},
                                 {"additionalProperties", {{"type", "string"}}}}})}}}});
}

Json discovery_schema() {
  return object_schema(
      "Which terms the energy lacks, or is made of.",
      {{"model", text_schema("Name of a model: the base.")},
       {"from_nothing", {{"description", "The terms make up the whole energy; no base is kept."}, {"type", "boolean"}}},
       {"invariants", list_schema("What a term may be a function of (default: what suits the model).",
                                  choice_schema("An invariant.", discovery_invariants))},
       {"laws", list_schema("How it may grow (default all).", choice_schema("A law.", discovery_laws))},
       {"most_terms",
        {{"description", "The most terms that are added (default 3; from nothing 4)."},
         {"type", "integer"},
         {"minimum", 1},
         {"maximum", 6}}},
       {"most_parameters",
        {{"description", "The most parameters that the terms have together (default: as many as it takes)."},
         {"type", "integer"},
         {"minimum", 1},
         {"maximum", 20}}},
       {"alpha",
        {{"description", "Significance level: the share of false alarms that is accepted."},
         {"type", "number"},
         {"minimum", 0.0001},
         {"maximum", 0.5}}}});
}

Json on_failure_schema() {
  Json schema = {{"description", "What to do when an evaluation fails (default penalise)."}};
  schema["anyOf"] = Json::array(
      {choice_schema("The policy.", names_in(on_failure_names)),
       object_schema("With a limit.",
                     {{"policy", choice_schema("The policy.", names_in(on_failure_names))},
                      {"max_rate", quantity_schema("Share of failed evaluations above which a run stops.")}})});
  return schema;
}

}  // namespace

std::string compose_schema(const plugins::Catalogue& catalogue) {
  Json definitions = Json::object();
  define_parameter(definitions);
  define_data(definitions);
  define_rig_keys(definitions);
  define_search(definitions, catalogue);
  definitions["state_name"] = text_schema("Name of the state that the specimen was in (default: that of the models).");
  definitions["test"] = by_type("test", names_of(catalogue.tests()), "A test and its data.");
  define_plugins(definitions, catalogue);

  Json properties = Json::object();
  properties["$schema"] = text_schema("This schema, for editors.");
  properties["format"] = {{"description", "Version of the file format."}, {"const", 1}};
  properties["name"] = text_schema("Name of the experiment (default: the file's).");
  properties["seed"] = count_schema("Root of all random numbers (default 1).", 0);
  properties["models"] =
      named_entries("The models to calibrate, by name.", by_type("model", names_of(catalogue.models()), "A model."));
  Json differing = {{"description",
                     "Parameters that have a value of their own in this state, named as in results; "
                     "what is silent is as in the model."},
                    {"type", "object"},
                    {"minProperties", 1},
                    {"maxProperties", limits::entries},
                    {"additionalProperties", reference("parameter")}};
  properties["states"] = named_entries(
      "States of the specimen, by name: tone, calcium, temperature, treatment.",
      object_schema("What differs in this state.",
                    {{"doc", text_schema("What was done to the specimen.")}, {"parameters", std::move(differing)}},
                    {"parameters"}));
  properties["tests"] = named_entries("The tests to fit, by name.", reference("test"));
  properties["objective"] = reference("objective");
  properties["constraints"] = reference("constraints");
  properties["optimizers"] = named_entries("The optimizers to use, by name.", reference("optimizer"));
  properties["stop"] = reference("stop");
  properties["initial"] = initial_schema();
  properties["paired_starts"] = {
      {"description",
       "Whether runs of the same parameters and bounds begin their searches at the same points (default false)."},
      {"type", "boolean"}};
  properties["runs"] = list_schema("What to calibrate; the runs are compared.", run_schema());
  properties["runs"]["minItems"] = 1;
  properties["on_failure"] = on_failure_schema();
  properties["fewer_simulations"] = fewer_simulations_schema();
  properties["keep_evaluations"] = choice_schema(
      "Which rows evaluations.csv keeps once the results are written: all, or improvements of the best point only "
      "(default all).",
      names_in(kept_evaluations_names));
  properties["analysis"] = analysis_schema();
  properties["diagnosis"] = diagnosis_schema();
  properties["discovery"] = discovery_schema();

  Json schema = Json::object();
  schema["$schema"] = "http://json-schema.org/draft-07/schema#";
  schema["title"] = "tunica experiment file";
  schema.update(
      object_schema("Written by `tunica schema` from what the loaded plugins declare. Quantities are numbers in base "
                    "units (kPa, mm, mN, "
                    "s, deg) or text with a unit, as in \"3.71 mm\".",
                    std::move(properties), {"format", "models", "tests", "optimizers", "runs"}));
  schema["definitions"] = std::move(definitions);
  return schema.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tunica::experiment
