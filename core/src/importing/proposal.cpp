// SPDX-License-Identifier: Apache-2.0
#include "importing/proposal.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "data/nearest.hpp"
#include "data/quantities.hpp"
#include "data/row_choice.hpp"
#include "importing/columns.hpp"
#include "importing/sizes.hpp"
#include "tunica/error.hpp"

namespace tunica::importing {
namespace {
using From = data::Quantity::Kind;

/// "PA Belly.1" → "PA_Belly_1": names in an experiment file have no dots, slashes or blanks.
std::string as_name(std::string text) {
  for (char& letter : text)
    if (letter == '.' || letter == '/' || letter == '\\' || letter == ' ') letter = '_';
  if (text.empty() || text.front() == '-') text = "test" + text;
  return text;
}

std::string listed(const std::vector<std::string>& values) {
  std::vector<std::string> shown(values.begin(),
                                 values.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(values.size(), 8)));
  return fmt::format("{}{}", fmt::join(shown, ", "), values.size() > shown.size() ? ", …" : "");
}

template <class Known>
const auto& registered(const Known& known, const char* kind, const std::string& name) {
  if (const auto found = known.find(name); found != known.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [one, entry] : known) names.push_back(one);
  throw InputError(fmt::format("--{} {}: there is no such {}. {}", kind, name, kind, data::suggestion(name, names)));
}

/// One file on its way to tests.
class File {
 public:
  File(const std::filesystem::path& file, const Answers& answers, const plugins::Catalogue& catalogue, const Ask& ask,
       std::vector<std::string>& notes)
      : file_(file),
        answers_(answers),
        ask_(ask),
        notes_(notes),
        csv_(data::parse_csv(file, data::read_bytes(file), layout(answers))),
        columns_(guess_columns(csv_)),
        type_(answers.test.empty() ? likely_test(columns_) : answers.test) {
    factory_ = &registered(catalogue.tests(), "test", type_).factory;
    note("{} columns, {} rows; names in line {}, cells parted by {}", csv_.columns.size(), csv_.rows.size(),
         csv_.header_line,
         csv_.delimiter == '\t'  ? "tabs"
         : csv_.delimiter == ' ' ? "blanks"
                                 : fmt::format("'{}'", csv_.delimiter));
  }

  [[nodiscard]] const std::string& type() const { return type_; }

  /// Name and entry of each test.
  std::vector<std::pair<std::string, Json>> tests(const std::filesystem::path& folder) {
    std::error_code error;
    const auto relative = std::filesystem::relative(file_, folder, error);
    Json data = Json::object();
    data["file"] = error || relative.empty() ? std::filesystem::absolute(file_).string() : relative.generic_string();
    data["columns"] = map_columns();
    if (!units_.empty()) data["units"] = units_;
    const Json where = conditions();
    std::vector<std::pair<std::string, Json>> found;
    for (const std::string& value : values_of_each()) {
      Json own = where;
      if (!answers_.each.empty()) own[answers_.each] = value;
      if (!own.empty()) data["where"] = own;
      add_sizes(data, own);
      add_cycles(data, own);
      add_measure(data);
      Json entry = {{"type", type_}};
      add_options(entry);
      entry["data"] = data;
      found.emplace_back(answers_.each.empty() ? as_name(file_.stem().string()) : as_name(value), std::move(entry));
    }
    return found;
  }

 private:
  static data::TableLayout layout(const Answers& answers) {
    data::TableLayout layout;
    layout.units = answers.units;
    layout.by_position = !answers.columns.empty() &&
                         std::all_of(answers.columns.begin(), answers.columns.end(),
                                     [](const auto& one) { return data::column_position(one.second).has_value(); });
    return layout;
  }

  template <class... Arguments>
  void note(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    notes_.push_back(
        fmt::format("{}: {}", file_.filename().string(), fmt::format(text, std::forward<Arguments>(arguments)...)));
  }

  /// The observable, or what it follows from, that a guessed column gives to this test.
  std::string name_for(const ColumnGuess& column) const {
    const auto knows = [&](const std::string& name) {
      return data::quantity_named(name, factory_->observables).has_value();
    };
    for (const std::string& name :
         {column.direction.empty() ? column.quantity : column.quantity + "_" + column.direction, column.quantity,
          "axial_" + column.quantity})
      if (!column.quantity.empty() && knows(name)) return name;
    return {};
  }

  void take_unit(const ColumnGuess& column, const std::string& name) {
    const auto quantity = data::quantity_named(name, factory_->observables);
    if (column.unit_from_name)
      units_[column.name] = column.unit;
    else if (column.unit.empty() && quantity->unit != "1")
      units_[column.name] = ask_({fmt::format("Unit of the column '{}' ({})", column.name, name),
                                  fmt::format("--unit '{}=UNIT'", column.name), quantity->unit});
  }

  Json map_columns() {
    Json mapped = Json::object();
    std::set<std::string> given;
    const auto map = [&](const std::string& name, const std::string& column) {
      const auto quantity = data::quantity_named(name, factory_->observables);
      if (!quantity || !given.insert(quantity->observable->name).second) return false;
      mapped_.emplace_back(name, column);
      if (const auto position = data::column_position(column))
        mapped[name] = *position;
      else
        mapped[name] = column;
      return true;
    };
    for (const auto& [name, column] : answers_.columns) {
      if (!data::quantity_named(name, factory_->observables)) refuse_name(name);
      const ColumnGuess& guess = columns_[csv_.column(column)];
      if (map(name, column)) take_unit(guess, name);
    }
    for (const auto& [column, unit] : answers_.units) units_[column] = unit;
    // A displacement has its zero at rest, so it goes before a length.
    for (const bool lengths : {false, true})
      for (const ColumnGuess& column : columns_) {
        if ((column.quantity == "length") != lengths) continue;
        const std::string name = name_for(column);
        if (name.empty() || !map(name, column.name)) continue;
        if (!std::any_of(answers_.units.begin(), answers_.units.end(),
                         [&](const auto& one) { return one.first == column.name; }))
          take_unit(column, name);
      }
    refuse_gaps(given);
    std::vector<std::string> given_by;
    for (const auto& [name, column] : mapped_) given_by.push_back(fmt::format("{} = '{}'", name, column));
    note("{}", fmt::join(given_by, ", "));
    return mapped;
  }

  [[noreturn]] void refuse_name(const std::string& name) const {
    std::vector<std::string> known;
    for (const Observable& observable : factory_->observables) known.push_back(observable.name);
    for (const data::RawName& raw : data::raw_names(factory_->observables)) known.push_back(raw.name);
    throw InputError(fmt::format("--column {}: a test of type '{}' has no such quantity. {}", name, type_,
                                 data::suggestion(name, known)));
  }

  void refuse_gaps(const std::set<std::string>& given) const {
    std::vector<std::string> names;
    for (const ColumnGuess& column : columns_) names.push_back("'" + column.name + "'");
    bool channel = false;
    for (const Observable& observable : factory_->observables) {
      channel = channel || (observable.role == Observable::Role::channel && given.contains(observable.name));
      if (observable.required && !given.contains(observable.name))
        throw InputError(
            fmt::format("{}, line {}: no column is known to give '{}' of a test of type '{}'. Columns: {}. "
                        "Name one with --column, for example --column '{}=COLUMN', or another --test.",
                        file_.string(), csv_.header_line, observable.name, type_, fmt::join(names, ", "),
                        observable.kind == Observable::Kind::stretch ? "displacement" : observable.name));
    }
    if (!channel)
      throw InputError(
          fmt::format("{}, line {}: no column is known to be measured in a test of type '{}'. Columns: {}. Name "
                      "one with --column, for example --column 'force=COLUMN'.",
                      file_.string(), csv_.header_line, type_, fmt::join(names, ", ")));
  }

  Json conditions() {
    Json where = Json::object();
    for (const auto& [column, value] : answers_.where) where[column] = value;
    for (const ColumnGuess& column : columns_) {
      if (where.contains(column.name) || column.name == answers_.each) continue;
      if (cycle_column_.empty() && counts_cycles(column)) {
        cycle_column_ = column.name;
        continue;
      }
      if (column.numeric) continue;
      if (column.values.size() < 2 || column.values.size() >= 50) continue;
      where[column.name] = column.values.front();
      note(
          "'{}' has several values ({}); the first is taken. Choose with --where '{}=VALUE', or make a test of each "
          "with "
          "--each '{}'",
          column.name, listed(column.values), column.name, column.name);
    }
    return where;
  }

  std::vector<const data::Csv::Row*> rows(const Json& where) const {
    data::DataRequest request;
    for (const auto& [column, value] : where.items()) request.where.emplace_back(column, value.get<std::string>());
    return data::rows_where(csv_, request);
  }

  std::vector<std::string> values_of_each() const {
    if (answers_.each.empty()) return {""};
    const std::size_t index = csv_.column(answers_.each);
    Json where = Json::object();
    for (const auto& [column, value] : answers_.where) where[column] = value;
    std::vector<std::string> values;
    for (const data::Csv::Row* row : rows(where))
      if (std::find(values.begin(), values.end(), row->cells[index]) == values.end())
        values.push_back(row->cells[index]);
    return values;
  }

  bool needs(std::initializer_list<From> kinds) const {
    return std::any_of(mapped_.begin(), mapped_.end(), [&](const auto& one) {
      const From kind = data::quantity_named(one.first, factory_->observables)->kind;
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
    if (needs({From::force})) {
      size("width", answers_.width, table.width,
           {fmt::format("Width of the specimen of {} across the force, with its unit", file_.filename().string()),
            "--width", "10 mm", true});
      size("thickness", answers_.thickness, table.thickness,
           {"Its thickness, with its unit", "--thickness", "1.5 mm", true});
    }
    if (needs({From::displacement, From::length})) {
      const std::string at_rest =
          answers_.gauge_length.empty() && table.gauge_length.empty() ? gauge_from_lengths(where) : "";
      size("gauge_length", answers_.gauge_length, table.gauge_length.empty() ? at_rest : table.gauge_length,
           {"Gauge length, that is the length at stretch 1, with its unit; or \"preload\"", "--gauge-length", "20 mm",
            true});
    }
    if (!specimen.empty()) data["specimen"] = specimen;
  }

  /// Of files that have a length beside the displacement.
  std::string gauge_from_lengths(const Json& where) {
    const auto length = std::find_if(columns_.begin(), columns_.end(),
                                     [](const ColumnGuess& column) { return column.quantity == "length"; });
    const auto way = std::find_if(mapped_.begin(), mapped_.end(), [&](const auto& one) {
      return data::quantity_named(one.first, factory_->observables)->kind == From::displacement;
    });
    if (length == columns_.end() || way == mapped_.end()) return {};
    const auto unit_of = [&](const std::string& name) {
      if (units_.contains(name)) return units_[name].get<std::string>();
      return columns_[csv_.column(name)].unit;
    };
    const std::string unit = length->unit;
    if (unit.empty() || unit != unit_of(way->second)) return {};
    const auto rest = length_at_rest(csv_, length->name, way->second, rows(where));
    if (!rest) return {};
    note("gauge length {} {}: '{}' less '{}' in most rows", *rest, unit, length->name, way->second);
    return fmt::format("{} {}", *rest, unit);
  }

  void add_cycles(Json& data, const Json& where) {
    if (!cycle_column_.empty() && answers_.cycle != "none") data["cycles_from"] = cycle_column_;
    const bool several = !cycle_column_.empty() || !answers_.cycle.empty() || goes_to_and_fro(where);
    if (several && answers_.cycle != "none") {
      const std::string cycle = answers_.cycle.empty() ? "last" : answers_.cycle;
      const Json number = Json::parse(cycle, nullptr, false);
      data["cycle"] = number.is_discarded() ? Json(cycle) : number;
      if (answers_.branch.empty() && cycle != "all") data["branch"] = "loading";
      if (answers_.cycle.empty() && answers_.branch.empty())
        note(
            "several cycles: the last loading is taken. Choose with --cycle and --branch, or take all as history with "
            "--cycle all");
    }
    if (!answers_.branch.empty() && answers_.branch != "none") data["branch"] = answers_.branch;
    if (!answers_.preload.empty() && answers_.preload != "none") data["preload"] = answers_.preload;
  }

  /// Whether every prescribed quantity that changes comes back.
  bool goes_to_and_fro(const Json& where) const {
    bool any = false;
    for (const auto& [name, column] : mapped_) {
      const auto quantity = data::quantity_named(name, factory_->observables);
      if (quantity->observable->role != Observable::Role::abscissa) continue;
      const bool stretch = quantity->kind == From::own && quantity->observable->kind == Observable::Kind::stretch;
      const auto returns = importing::goes_to_and_fro(csv_, column, rows(where), stretch ? 1 : 0);
      if (returns && !*returns) return false;  // the others are held, and show noise
      any = any || returns;
    }
    return any;
  }

  void add_measure(Json& data) {
    const bool stress = std::any_of(mapped_.begin(), mapped_.end(), [&](const auto& one) {
      return data::quantity_named(one.first, factory_->observables)->observable->kind == Observable::Kind::stress;
    });
    if (!stress) return;
    if (!answers_.stress_measure.empty())
      data["stress_measure"] = answers_.stress_measure;
    else if (needs({From::force}))
      data["stress_measure"] = "first_piola_kirchhoff";
    else
      data["stress_measure"] =
          ask_({"Stress of the file: cauchy, first_piola_kirchhoff (nominal) or second_piola_kirchhoff",
                "--stress-measure", "first_piola_kirchhoff"});
  }

  void add_options(Json& entry) {
    for (const auto& [key, value] : answers_.options) entry[key] = value;
    for (const Option& option : factory_->options) {
      if (option.name == "direction" && !answers_.direction.empty()) entry["direction"] = answers_.direction;
      if (option.fallback || entry.contains(option.name)) continue;
      if (option.name == "direction") {
        entry["direction"] = "circumferential";
        note(
            "the strip is taken as cut along the circumferential direction; an isotropic model does not ask. Say "
            "--direction axial where it matters");
      }
    }
    if (type_ != "thick_wall_pressurisation" && type_ != "fe_pressurisation") return;
    if (!answers_.thickness.empty() && !entry.contains("thickness")) entry["thickness"] = answers_.thickness;
    const char* const sizes[] = {"outer_radius", "inner_radius", "thickness"};
    const auto given =
        std::count_if(std::begin(sizes), std::end(sizes), [&](const char* key) { return entry.contains(key); });
    if (given >= 2) return;
    if (!entry.contains("thickness"))
      entry["thickness"] = ask_({"Thickness of the unloaded wall, with its unit", "--thickness", "0.8 mm", true});
    if (!entry.contains("outer_radius"))
      entry["outer_radius"] =
          ask_({"Outer radius of the unloaded tube, with its unit", "--set outer_radius=LENGTH", "2.3 mm", true});
  }

  std::filesystem::path file_;
  const Answers& answers_;
  const Ask& ask_;
  std::vector<std::string>& notes_;
  data::Csv csv_;
  std::vector<ColumnGuess> columns_;
  std::string type_;
  const TestFactory* factory_ = nullptr;
  Pairs mapped_;
  Json units_ = Json::object();
  std::string cycle_column_;
};

}  // namespace

Proposal propose(const Answers& answers, const std::filesystem::path& folder, const plugins::Catalogue& catalogue,
                 const Ask& ask) {
  Proposal proposal;
  Json tests = Json::object(), runs = Json::array();
  std::string model = answers.model;
  for (const std::filesystem::path& file : answers.files) {
    File reading(file, answers, catalogue, ask, proposal.notes);
    if (model.empty()) model = reading.type() == "uniaxial" || reading.type() == "biaxial" ? "ogden" : "hgo";
    std::vector<std::string> names;
    for (auto& [name, entry] : reading.tests(folder)) {
      if (tests.contains(name))
        throw InputError(fmt::format("{}: two tests would be called '{}'. Rename a file, or import it by itself.",
                                     file.string(), name));
      names.push_back(name);
      tests[name] = std::move(entry);
    }
    runs.push_back({{"model", model}, {"optimizer", "lm"}, {"tests", std::move(names)}});
  }
  static_cast<void>(registered(catalogue.models(), "model", model));
  Json entry = {{"type", model}};
  if (model == "ogden") entry["terms"] = 2;  // on strips of porcine dermis one term leaves 4 to 17 times the misfit
  proposal.experiment = {{"format", 1}};
  proposal.experiment["models"][model] = std::move(entry);
  proposal.experiment["tests"] = std::move(tests);
  proposal.experiment["optimizers"]["lm"] = {{"type", "ceres_lm"}, {"starts", 20}};
  proposal.experiment["runs"] = std::move(runs);
  return proposal;
}

}  // namespace tunica::importing
