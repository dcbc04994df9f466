// SPDX-License-Identifier: Apache-2.0
#include "importing/options.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/nearest.hpp"
#include "tunica/error.hpp"

namespace tunica::importing {
namespace {

bool declares(const TestFactory& factory, const std::string& option) {
  return std::ranges::any_of(factory.options, [&](const Option& one) { return one.name == option; });
}

}  // namespace

Json option_value(const TestFactory& factory, const std::string& key, const std::string& text) {
  using Kind = Option::Kind;
  const auto option =
      std::find_if(factory.options.begin(), factory.options.end(), [&](const Option& one) { return one.name == key; });
  if (option == factory.options.end()) {
    std::vector<std::string> names;
    for (const Option& one : factory.options) names.push_back(one.name);
    throw InputError(fmt::format("--set {}: a test of type '{}' has no such option. {}", key, factory.type,
                                 data::suggestion(key, names)));
  }
  if (option->kind == Kind::choice || option->kind == Kind::text) return text;
  const auto value = Json::parse(text, nullptr, false);
  if (option->kind == Kind::quantity) return value.is_number() ? value : Json(text);
  const bool fits = option->kind == Kind::flag      ? value.is_boolean()
                    : option->kind == Kind::integer ? value.is_number_integer()
                    : option->kind == Kind::number  ? value.is_number()
                                                    : !value.is_discarded();
  if (!fits)
    throw InputError(fmt::format("--set {}={}: expected {}. Correct it", key, data::excerpt(text),
                                 option->kind == Kind::flag      ? "true or false"
                                 : option->kind == Kind::integer ? "a whole number"
                                 : option->kind == Kind::number  ? "a number"
                                                                 : "JSON"));
  return value;
}

data::TableLayout layout_of(const Answers& answers) {
  static const std::map<std::string, char> marks = {{",", ','}, {";", ';'}, {"tab", '\t'}, {"space", ' '}};
  data::TableLayout layout;
  layout.units = answers.units;
  layout.by_position = !answers.columns.empty() &&
                       std::all_of(answers.columns.begin(), answers.columns.end(),
                                   [](const auto& one) { return data::column_position(one.second).has_value(); });
  if (const auto mark = marks.find(answers.delimiter); mark != marks.end()) layout.delimiter = mark->second;
  if (!answers.decimal.empty()) layout.decimal = answers.decimal.front();
  if (!answers.skip_lines.empty()) layout.skip_lines = std::stoul(answers.skip_lines);
  return layout;
}

void add_layout(Json& data, const Answers& answers) {
  if (!answers.delimiter.empty()) data["delimiter"] = answers.delimiter;
  if (!answers.decimal.empty()) data["decimal"] = answers.decimal;
  if (!answers.skip_lines.empty()) data["skip_lines"] = std::stoul(answers.skip_lines);
  if (!answers.rows.empty()) data["rows"] = answers.rows;
}

Specimen specimen_of(const TestFactory& factory, const Json& entry) {
  const bool of_tubes =
      declares(factory, "inner_radius") && declares(factory, "outer_radius") && declares(factory, "thickness");
  const bool has_wall = entry.contains("inner_radius") || entry.contains("thickness");
  return factory.specimen == Specimen::other && of_tubes && has_wall ? Specimen::tube : factory.specimen;
}

void add_tube_options(Json& entry, const TestFactory& factory, const Answers& answers, bool stretch_in_column,
                      const Ask& ask) {
  // Tubes of other authors may have other options.
  const auto is_open = [&](const char* option) { return declares(factory, option) && !entry.contains(option); };
  if (!answers.thickness.empty() && is_open("thickness")) entry["thickness"] = answers.thickness;
  if (!stretch_in_column && is_open("axial_stretch"))
    entry["axial_stretch"] =
        option_value(factory, "axial_stretch",
                     ask({"Axial stretch that is held; 1 = the unloaded length", "--set axial_stretch=NUMBER", "1.2"}));
  const char* const sizes[] = {"outer_radius", "inner_radius", "thickness"};
  const auto given =
      std::count_if(std::begin(sizes), std::end(sizes), [&](const char* key) { return entry.contains(key); });
  if (given >= 2) return;
  if (is_open("thickness"))
    entry["thickness"] = ask({"Thickness of the unloaded wall, with its unit", "--thickness", "0.8 mm", true});
  if (is_open("outer_radius"))
    entry["outer_radius"] =
        ask({"Outer radius of the unloaded tube, with its unit", "--set outer_radius=LENGTH", "2.3 mm", true});
}

std::string add_hold(Json& entry, const ColumnGuess& time, const Ask& ask) {
  if (!entry.contains("segments"))
    entry["segments"] =
        Json::parse(ask({"Stretch at which the specimen is held from the beginning; 1 = the unloaded length",
                         "--set segments=STRETCH", "1.5"}),
                    nullptr, false);
  const Json given = entry["segments"];
  if (given.is_array()) return {};
  if (!given.is_number())
    throw InputError(
        "--set segments: expected the stretch of a hold as a number, or a list of segments as JSON. Correct it");
  const auto lasting = [&time](double number) {
    return time.unit.empty() ? Json(number) : Json(fmt::format("{:.12g} {}", number, time.unit));
  };
  // A first row a few steps after the jump is sampling. A clock that ran before is many steps ahead.
  constexpr double few = 10;
  const double first = time.begins.size() == 2 ? time.begins[0] : 0, step = first > 0 ? time.begins[1] - first : 0;
  const bool late = first > few * step, after = !late && first > step;
  const double before = late ? first : 0;
  Json segments =
      Json::array({{{"ramp", {{"stretch", given}}}, {"duration", 0}}, {{"hold", lasting(time.largest - before)}}});
  if (late) segments.insert(segments.begin(), Json{{"ramp", {{"stretch", 1}}}, {"duration", lasting(before)}});
  entry["segments"] = std::move(segments);
  const std::string when = fmt::format("{:.12g}{}", first, time.unit.empty() ? "" : " " + time.unit);
  if (after)
    return fmt::format(
        "the first row is at {}, and the stretch is taken to jump at time 0. Say \"segments\" where it did not", when);
  if (!late) return {};
  return fmt::format(
      "the clock begins before the first row, at {}: the specimen is taken to rest until then, and to be stretched at "
      "once. Say \"segments\" where it was not so",
      when);
}

}  // namespace tunica::importing
