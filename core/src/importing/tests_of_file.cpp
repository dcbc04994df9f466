// SPDX-License-Identifier: Apache-2.0
#include "importing/tests_of_file.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "data/nearest.hpp"
#include "data/quantities.hpp"
#include "data/row_choice.hpp"
#include "importing/columns.hpp"
#include "importing/first_choices.hpp"
#include "importing/mapping.hpp"
#include "importing/options.hpp"
#include "importing/sign.hpp"
#include "importing/sizes.hpp"
#include "importing/tension.hpp"
#include "importing/words.hpp"
#include "tunica/error.hpp"

namespace tunica::importing {
namespace {
using From = data::Quantity::Kind;

/// One file on its way to tests.
class File {
 public:
  File(const std::filesystem::path& file, const Answers& answers, const plugins::Catalogue& catalogue, const Ask& ask,
       std::vector<std::string>& notes)
      : file_(file),
        answers_(answers),
        ask_(ask),
        notes_(notes),
        bytes_(data::read_bytes(file)),
        csv_(data::parse_csv(file, bytes_, layout_of(answers))),
        columns_(guess_columns(csv_)),
        factory_(chosen_test(answers.test, likely_specimen(columns_), catalogue)) {
    note("{} columns, {} rows; names in line {}, cells parted by {}", csv_.columns.size(), csv_.rows.size(),
         csv_.header_line,
         csv_.delimiter == '\t'  ? "tabs"
         : csv_.delimiter == ' ' ? "blanks"
                                 : fmt::format("'{}'", csv_.delimiter));
  }

  TestsOfFile tests(const std::filesystem::path& folder) {
    std::error_code error;
    const auto relative = std::filesystem::relative(file_, folder, error);
    Json common = Json::object();
    common["file"] = error || relative.empty() ? std::filesystem::absolute(file_).string() : relative.generic_string();
    common["columns"] = map_columns();
    if (!units_.empty()) common["units"] = units_;
    add_layout(common, answers_);
    add_compression(common);
    const bool sign_known = factory_.specimen != Specimen::strip || common.contains("compression") || said_.tension;
    const Json where = conditions();
    TestsOfFile found{factory_.specimen, {}};
    for (const std::string& value : values_of_each()) {
      Json own = where, data = common;
      if (!answers_.each.empty()) own[answers_.each] = value;
      if (!own.empty()) data["where"] = own;
      add_sizes(data, own);
      add_cycles(data, own);
      add_measure(data);
      if (const auto question =
              sign_known ? std::nullopt : question_of_sign(data, csv_, rows(own), factory_.observables))
        data["compression"] = ask_(*question);
      Json entry = {{"type", factory_.type}};
      const std::string name = as_name(answers_.each.empty() ? file_.stem().string() : value);
      add_options(entry, name);
      entry["data"] = data;
      found.specimen = specimen_of(factory_, entry);
      found.tests.emplace_back(name, std::move(entry));
    }
    return found;
  }

 private:
  /// No file of forces and ways tells a pull from a press whose values are positive.
  void add_compression(Json& data) {
    for (const auto& [column, sign] : answers_.compressions) data["compression"][column] = sign;
    if (!answers_.compressions.empty()) return;
    std::string sign = answers_.compression;
    if (sign.empty() && said_.compression)
      sign = ask_({"Sign of the values in compression: positive or negative", "--compression SIGN",
                   said_.negative ? "negative" : "positive"});
    if (!sign.empty()) data["compression"] = sign;
    if (sign.empty() && factory_.specimen == Specimen::strip)
      note(
          "tension counts as positive; of a specimen that is pressed, with positive values, say --compression "
          "positive");
  }

  template <class... Arguments>
  void note(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    notes_.push_back(
        fmt::format("{}: {}", file_.filename().string(), fmt::format(text, std::forward<Arguments>(arguments)...)));
  }

  Json map_columns() {
    Mapping mapping = importing::map_columns(csv_, columns_, factory_, answers_, ask_);
    for (const std::string& one : mapping.notes) note("{}", one);
    mapped_ = std::move(mapping.columns);
    units_ = std::move(mapping.units);
    measure_ = std::move(mapping.stress_measure);
    said_ = words_of_sign(file_, bytes_, csv_, columns_);
    said_.compression = said_.compression || mapping.compression;
    if (said_.bending)
      note(
          "its name, or a line above its table, speaks of bending, and no test here bends a beam: use it only if the "
          "specimen was pulled or pressed");
    Json columns = Json::object();
    for (const auto& [name, column] : mapped_)
      if (const auto position = data::column_position(column))
        columns[name] = *position;
      else
        columns[name] = column;
    return columns;
  }

  Json conditions() {
    Json where = Json::object();
    for (const auto& [column, value] : answers_.where) where[column] = value;
    for (const ColumnGuess& column : columns_) {
      if (where.contains(column.name) || column.name == answers_.each) continue;
      if (counts_cycles(column)) {
        if (cycle_column_.empty() && column.different > 1) cycle_column_ = column.name;
        continue;
      }
      if (column.numeric || column.different < 2) continue;
      if (!parts_rows(column, csv_.rows.size())) {
        note("'{}' has {} texts in {} of {} rows and is taken for remarks: all rows are used", column.title,
             column.different < 50 ? std::to_string(column.different) : "50 or more", column.filled, csv_.rows.size());
        continue;
      }
      const auto first = std::find_if_not(column.values.begin(), column.values.end(), preconditions);
      where[column.name] = first == column.values.end() ? column.values.front() : *first;
      note(
          "'{}' has several values ({}); '{}' is taken. Choose with --where '{}=VALUE', or make a test of each with "
          "--each '{}'",
          column.name, listed(column.values), where[column.name].get<std::string>(), column.name, column.name);
    }
    return where;
  }

  static bool preconditions(const std::string& value) {
    return has_any(words_of(value), {"precon", "precyc", "vorkond"});
  }

  std::vector<const data::Csv::Row*> rows(const Json& where) const {
    data::DataRequest request;
    for (const auto& [column, value] : where.items()) request.where.emplace_back(column, value.get<std::string>());
    return data::rows_where(csv_, request);
  }

  std::vector<std::string> values_of_each() {
    if (answers_.each.empty()) return {""};
    const std::size_t index = csv_.column(answers_.each);
    Json where = Json::object();
    for (const auto& [column, value] : answers_.where) where[column] = value;
    std::vector<std::string> values;
    for (const data::Csv::Row* row : rows(where))
      if (std::find(values.begin(), values.end(), row->cells[index]) == values.end())
        values.push_back(row->cells[index]);
    std::vector<std::string> measured, before;
    for (const std::string& value : values) (preconditions(value) ? before : measured).push_back(value);
    if (measured.empty() || before.empty()) return values;
    note("{} = {} is left out as preconditioning; to fit it too, import it with --where '{}={}'", answers_.each,
         listed(before), answers_.each, before.front());
    return measured;
  }

  bool needs(std::initializer_list<From> kinds) const {
    return std::any_of(mapped_.begin(), mapped_.end(), [&](const auto& one) {
      const From kind = data::quantity_named(one.first, factory_.observables)->kind;
      return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
    });
  }

  void add_sizes(Json& data, const Json& where) {
    Json specimen = Json::object();
    KnownSizes table;
    if (!answers_.table.empty()) table = sizes_in_table(answers_.table, file_.stem().string());
    for (const std::string& source : table.sources) note("{}", source);
    const auto size = [&](const char* key, const std::string& given, const std::string& found,
                          const Question& question) {
      specimen[key] = !given.empty() ? given : !found.empty() ? found : ask_(question);
    };
    direction_ = table.direction;
    if (const std::string tension = tension_of(csv_, columns_, mapped_, factory_, answers_); !tension.empty()) {
      note(
          "'{}' is taken as a force per length of the unloaded edge; the thickness makes it a nominal stress. If the "
          "length is that of the loaded edge, compute the stress first",
          tension);
      specimen["width"] = "1 m";
      size("thickness", answers_.thickness, table.thickness,
           {"Its thickness, with its unit", "--thickness", "1.5 mm", true});
    } else if (needs({From::force, From::plate_force}) && !answers_.area.empty()) {
      specimen["area"] = answers_.area;
    } else if (needs({From::force, From::plate_force}) && !answers_.diameter.empty()) {
      specimen["area"] = circle(answers_.diameter);
    } else if (needs({From::force, From::plate_force}) && answers_.width.empty() && !table.area.empty()) {
      specimen["area"] = table.area;
    } else if (needs({From::force, From::plate_force})) {
      size("width", answers_.width, table.width,
           {fmt::format(
                "Width of the specimen of {} across the force, with its unit; of a cylinder --diameter, of another "
                "section --area",
                file_.filename().string()),
            "--width", "10 mm", true});
      size("thickness", answers_.thickness, table.thickness,
           {"Its thickness, with its unit", "--thickness", "1.5 mm", true});
    }
    if (needs({From::shear_displacement}))
      size("height", answers_.height, "",
           {"Height of the block, that is the distance of the plates, with its unit", "--height", "4 mm", true});
    if (needs({From::displacement, From::length})) {
      const std::string& given = answers_.height.empty() ? answers_.gauge_length : answers_.height;
      const bool known = !given.empty() || !table.gauge_length.empty();
      const auto at_rest = known ? Pairs() : gauges_from_lengths(where);
      if (factory_.specimen == Specimen::sheet && !at_rest.empty() && !at_rest.front().first.empty())
        for (const auto& [direction, gauge] : at_rest) specimen[direction]["gauge_length"] = gauge;
      else
        size("gauge_length", given,
             !table.gauge_length.empty() ? table.gauge_length
             : at_rest.empty()           ? ""
                                         : at_rest.front().second,
             {"Gauge length, that is the length at stretch 1, with its unit, or \"preload\"; of a specimen that is "
              "pressed, --height",
              "--gauge-length", "20 mm", true});
    }
    if (!specimen.empty()) data["specimen"] = specimen;
  }

  /// Of files that have a length beside the displacement: direction, or nothing, and the gauge length; or none.
  Pairs gauges_from_lengths(const Json& where) {
    Pairs found;
    for (const auto& [name, column] : mapped_) {
      const auto quantity = data::quantity_named(name, factory_.observables);
      if (quantity->kind != From::displacement) continue;
      const std::string direction = name.ends_with("circumferential") ? "circumferential"
                                    : name.ends_with("axial")         ? "axial"
                                                                      : "";
      const auto length = std::find_if(columns_.begin(), columns_.end(), [&](const ColumnGuess& one) {
        return one.numeric && one.quantity == "length" && (direction.empty() || one.direction == direction);
      });
      if (length == columns_.end()) return {};
      const std::string unit = length->unit;
      const std::string of_way =
          units_.contains(column) ? units_[column].get<std::string>() : columns_[csv_.column(column)].unit;
      if (unit.empty() || unit != of_way) return {};
      const auto rest = length_at_rest(csv_, length->name, column, rows(where));
      if (!rest) return {};
      note("gauge length {} {}: '{}' less '{}' in most rows", *rest, unit, length->title, column);
      found.emplace_back(direction, fmt::format("{} {}", *rest, unit));
    }
    return found;
  }

  void add_cycles(Json& data, const Json& where) {
    if (!cycle_column_.empty() && answers_.cycle != "none") data["cycles_from"] = cycle_column_;
    const bool several = !cycle_column_.empty() || !answers_.cycle.empty() || goes_to_and_fro(where);
    if (several && answers_.cycle != "none") {
      const std::string cycle = answers_.cycle.empty() ? "last" : answers_.cycle;
      const Json number = Json::parse(cycle, nullptr, false);
      data["cycle"] = number.is_discarded() ? Json(cycle) : number;
      if (answers_.branch.empty() && cycle != "all") data["branch"] = "loading";
      if (answers_.cycle.empty() && answers_.branch.empty()) note_loading(turning_cycles(where));
    }
    if (!answers_.branch.empty() && answers_.branch != "none") data["branch"] = answers_.branch;
    if (!answers_.preload.empty() && answers_.preload != "none") data["preload"] = answers_.preload;
  }

  /// What is lost where nobody chose a cycle.
  void note_loading(std::size_t cycles) {
    if (cycles < 2 && cycle_column_.empty())
      return note("the loading is taken, and the unloading left out: --branch unloading takes that, --cycle all both");
    note(
        "several cycles{}: the last loading is taken. Softening and hysteresis need --cycle all; --cycle and --branch "
        "choose another part",
        cycles < 2 ? "" : fmt::format(" ({})", cycles));
  }

  /// Calls `visit` with the column of each prescribed quantity and its value at rest.
  template <class Visit>
  void each_abscissa(const Visit& visit) const {
    for (const auto& [name, column] : mapped_) {
      const auto quantity = data::quantity_named(name, factory_.observables);
      if (quantity->observable->role != Observable::Role::abscissa) continue;
      const bool stretch = quantity->kind == From::own && quantity->observable->kind == Observable::Kind::stretch;
      visit(column, stretch ? 1.0 : 0.0);
    }
  }

  /// Cycles by the turning points of what is prescribed and not held.
  std::size_t turning_cycles(const Json& where) const {
    std::size_t most = 0;
    each_abscissa([&](const std::string& column, double rest) {
      if (importing::goes_to_and_fro(csv_, column, rows(where), rest))
        most = std::max(most, importing::cycles(csv_, column, rows(where), rest));
    });
    return most;
  }

  /// Whether every prescribed quantity that changes comes back; the others are held, and show noise.
  bool goes_to_and_fro(const Json& where) const {
    bool any = false, all = true;
    each_abscissa([&](const std::string& column, double rest) {
      const auto returns = importing::goes_to_and_fro(csv_, column, rows(where), rest);
      any = any || returns;
      all = all && returns.value_or(true);
    });
    return any && all;
  }

  void add_measure(Json& data) {
    const bool stress = std::any_of(mapped_.begin(), mapped_.end(), [&](const auto& one) {
      return data::quantity_named(one.first, factory_.observables)->observable->kind == Observable::Kind::stress;
    });
    if (!stress) return;
    if (!measure_.empty())
      data["stress_measure"] = measure_;
    else if (!answers_.stress_measure.empty())
      data["stress_measure"] = answers_.stress_measure;
    else if (needs({From::force}))
      data["stress_measure"] = "first_piola_kirchhoff";
    else
      data["stress_measure"] =
          ask_({"Stress of the file: cauchy, first_piola_kirchhoff (nominal) or second_piola_kirchhoff",
                "--stress-measure", "first_piola_kirchhoff"});
  }

  std::string direction_of(const std::string& test) const {
    for (const auto& [name, direction] : answers_.directions)
      if (name == test) return direction;
    return !answers_.direction.empty() ? answers_.direction : direction_;
  }

  void add_options(Json& entry, const std::string& test) {
    for (const auto& [key, value] : answers_.options) entry[key] = option_value(factory_, key, value);
    const std::string direction = direction_of(test);
    for (const Option& option : factory_.options) {
      if (option.name == "direction" && !direction.empty()) entry["direction"] = direction;
      if (option.fallback || entry.contains(option.name)) continue;
      if (option.name == "direction") {
        const std::string named = direction_named(test);
        entry["direction"] = named.empty() ? "circumferential" : named;
        if (!named.empty())
          note("'{}' is taken as cut along the {} direction, by its name", test, named);
        else
          note(
              "'{}' is taken as cut along the circumferential direction; a model without fibres does not ask. Say "
              "--direction axial, or --direction '{}=axial', where it matters",
              test, test);
      }
    }
    const bool stretched = std::any_of(mapped_.begin(), mapped_.end(), [&](const auto& one) {
      return data::quantity_named(one.first, factory_.observables)->observable->name == "axial_stretch";
    });
    const auto& options = factory_.options;
    const bool states_its_loading =
        std::any_of(options.begin(), options.end(), [](const Option& option) { return option.name == "segments"; });
    if (states_its_loading)
      for (const ColumnGuess& column : columns_)
        if (column.quantity == "time") {
          if (const std::string assumed = add_hold(entry, column, ask_); !assumed.empty()) note("{}", assumed);
          break;
        }
    if (factory_.specimen == Specimen::tube) add_tube_options(entry, factory_, answers_, stretched, ask_);
  }

  std::filesystem::path file_;
  const Answers& answers_;
  const Ask& ask_;
  std::vector<std::string>& notes_;
  std::string bytes_;
  data::Csv csv_;
  std::vector<ColumnGuess> columns_;
  const TestFactory& factory_;
  Pairs mapped_;
  Json units_ = Json::object();
  std::string cycle_column_, measure_;
  std::string direction_;  ///< from the table of specimens
  SignWords said_;
};

}  // namespace

TestsOfFile tests_of_file(const std::filesystem::path& file, const Answers& answers,
                          const std::filesystem::path& folder, const plugins::Catalogue& catalogue, const Ask& ask,
                          std::vector<std::string>& notes) {
  return File(file, answers, catalogue, ask, notes).tests(folder);
}

}  // namespace tunica::importing
