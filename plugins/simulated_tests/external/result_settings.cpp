// SPDX-License-Identifier: Apache-2.0
// What "results" of the experiment file says: where the numbers of each observable stand.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <re2/re2.h>

#include "settings.hpp"

namespace tunica::external {
namespace {

using Json = nlohmann::json;

constexpr const char* result_forms =
    "one of {\"file\": \"out.csv\", \"column\": \"force\"}, {\"file\": \"out.json\", \"pointer\": \"/force\"} and "
    "{\"file\": \"out.txt\", \"pattern\": \"F = (\\\\S+)\"}, with \"unit\", \"factor\" and \"start\" if needed";

double factor_of(const Json& entry, const Observable& observable, const TestSetup& setup, const std::string& where) {
  const Json unit = entry.value("unit", Json(observable.unit)), factor = entry.value("factor", Json(1));
  if (!unit.is_string() || !factor.is_number())
    throw InputError(fmt::format("{}: \"unit\" is a text and \"factor\" a number", where));
  if (!setup.unit_factor && unit != observable.unit)
    throw InputError(fmt::format("{}: this host converts no units; use \"factor\"", where));
  return factor.get<double>() *
         (unit == observable.unit ? 1 : setup.unit_factor(unit.get<std::string>(), observable.unit));
}

ResultPlace result_of(const Json& entry, const Observable& observable, const TestSetup& setup) {
  const std::string where = fmt::format("\"results\": '{}'", observable.name);
  ResultPlace place;
  place.observable = observable.name;
  int forms = 0;
  if (!entry.is_object()) throw InputError(fmt::format("{} is {}", where, result_forms));
  for (const auto& [key, value] : entry.items()) {
    const bool form = key == "column" || key == "pointer" || key == "pattern";
    if (!form && key != "file" && key != "unit" && key != "factor" && key != "start")
      throw InputError(fmt::format("{}: the key '{}' is unknown; write {}", where, key, result_forms));
    if (!form) continue;
    ++forms;
    place.kind = key == "column"    ? ResultPlace::Kind::column
                 : key == "pointer" ? ResultPlace::Kind::pointer
                                    : ResultPlace::Kind::pattern;
    if (!value.is_string() && !(key == "column" && value.is_number_unsigned()))
      throw InputError(fmt::format("{}: \"{}\" is a text", where, key));
    place.text = value.is_string() ? value.get<std::string>() : value.dump();
  }
  if (forms != 1 || !entry.contains("file") || !entry["file"].is_string())
    throw InputError(fmt::format("{} does not say where; write {}", where, result_forms));
  place.file = entry["file"] == "-" ? "-" : checked_name(entry["file"].get<std::string>(), "results");
  place.factor = factor_of(entry, observable, setup, where);
  if (const auto start = entry.find("start"); start != entry.end()) {
    if (!start->is_number()) throw InputError(fmt::format("{}: \"start\" is a number", where));
    place.start = {start->get<double>()};
  }
  try {
    if (place.kind == ResultPlace::Kind::pointer) (void)Json::json_pointer(place.text);
  } catch (const Json::exception&) {
    throw InputError(fmt::format("{}: '{}' is no JSON pointer; write \"/results/force\"", where, place.text));
  }
  if (place.kind != ResultPlace::Kind::pattern) return place;
  const RE2 pattern(place.text, RE2::Quiet);
  if (!pattern.ok())
    throw InputError(fmt::format("{}: the pattern is no regular expression of RE2: {}", where, pattern.error()));
  if (pattern.NumberOfCapturingGroups() < 1)
    throw InputError(fmt::format("{}: the pattern has no group; put the number into round brackets", where));
  return place;
}

}  // namespace

void read_results(const TestSetup& setup, const std::vector<Observable>& observables, Settings& settings) {
  const Json results = Json::parse(setup.options.text("results"));
  if (!results.is_object()) throw InputError("\"results\" is an object: {\"force\": {…}}");
  const auto declared = [&](const std::string& name) {
    return std::ranges::find(observables, name, &Observable::name);
  };
  std::vector<std::string> mapped;
  for (const auto& column : setup.rows.abscissae) mapped.push_back(column.observable);
  for (const auto& [name, entry] : results.items()) {
    if (declared(name) == observables.end()) {
      std::vector<std::string> names;
      for (const Observable& observable : observables) names.push_back(observable.name);
      throw InputError(
          fmt::format("\"results\": there is no observable '{}'; there are {}", name, fmt::join(names, ", ")));
    }
    if (declared(name)->role != Observable::Role::abscissa) continue;
    if (std::ranges::find(mapped, name) == mapped.end())
      throw InputError(fmt::format("\"results\": '{}' is an abscissa, and \"columns\" maps no column to it", name));
    if (settings.curve)
      throw InputError("\"results\" name two abscissae; a curve is read between its points over one of them");
    settings.curve = true;
    settings.results.push_back(result_of(entry, *declared(name), setup));
  }
  for (const std::string& channel : setup.rows.channels) {
    if (!results.contains(channel))
      throw InputError(
          fmt::format("\"results\" do not say where the solver writes '{}', which \"columns\" maps; add {}", channel,
                      result_forms));
    settings.results.push_back(result_of(results[channel], *declared(channel), setup));
  }
}

}  // namespace tunica::external
