// SPDX-License-Identifier: Apache-2.0
#include "importing/mapping.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "data/nearest.hpp"
#include "data/quantities.hpp"
#include "tunica/error.hpp"

namespace tunica::importing {
namespace {

using From = data::Quantity::Kind;
using Role = Observable::Role;

bool is_strain(From kind) { return kind == From::strain || kind == From::true_strain || kind == From::green_strain; }

/// "stretch_axial" has an axis, "stretch" has none.
bool has_axis(std::string_view name) {
  return name.find("circumferential") != std::string_view::npos || name.ends_with("_axial");
}

std::string without_digits(std::string text) {
  std::erase_if(text, [](char letter) { return letter >= '0' && letter <= '9'; });
  return text;
}

class Mapper {
 public:
  Mapper(const data::Csv& csv, const std::vector<ColumnGuess>& columns, const TestFactory& factory,
         const Answers& answers, const Ask& ask)
      : csv_(csv), columns_(columns), factory_(factory), answers_(answers), ask_(ask) {}

  Mapping map() {
    for (const auto& [column, unit] : answers_.units) mapping_.units[column] = unit;
    for (const auto& [name, column] : answers_.columns) {
      if (!quantity(name)) refuse_name(name);
      const std::size_t index = csv_.column(column);
      take(as_stated(name, columns_[index]), index, column);
    }
    refuse_other_tests();
    choose();
    refuse_gaps();
    check_measures();
    for (const auto& [name, column] : mapping_.columns) said_.push_back(fmt::format("{} = '{}'", name, column));
    mapping_.notes.push_back(fmt::format("{}", fmt::join(said_, ", ")));
    list_unused();
    return std::move(mapping_);
  }

 private:
  std::optional<data::Quantity> quantity(const std::string& name) const {
    return data::quantity_named(name, factory_.observables);
  }

  [[noreturn]] void refuse_name(const std::string& name) const {
    std::vector<std::string> known;
    for (const Observable& observable : factory_.observables) known.push_back(observable.name);
    for (const data::RawName& raw : data::raw_names(factory_.observables)) known.push_back(raw.name);
    throw InputError(fmt::format("--column {}: a test of type '{}' has no such quantity. {}", name, factory_.type,
                                 data::suggestion(name, known)));
  }

  /// A strain that the user calls "strain" alone has the definition that the file, or else the user, states.
  std::string as_stated(std::string name, const ColumnGuess& column) const {
    const From kind = quantity(name)->kind;
    const std::string& stated = column.measure.empty() ? answers_.strain_measure : column.measure;
    if (!is_strain(kind) || stated.empty()) return name;
    const bool known = stated == "true" || stated == "green";
    if (kind == From::strain && known) name.replace(name.find("strain"), 6, stated + "_strain");
    const std::string named = kind == From::true_strain ? "true" : kind == From::green_strain ? "green" : "";
    if (stated == "almansi" || (!named.empty() && named != stated))
      throw InputError(fmt::format(
          "{}, line {}: --column {} names the column '{}', and {} says that its strain is {}. Name it so, or leave the "
          "other out.",
          csv_.file.string(), csv_.header_line, name, column.title,
          column.measure.empty() ? "--strain-measure" : "its name", stated));
    return name;
  }

  void take(const std::string& name, std::size_t index, const std::string& column) {
    if (!given_.insert(quantity(name)->observable->name).second) return;
    used_.insert(index);
    mapping_.columns.emplace_back(name, column);
    axes_ = axes_ || has_axis(name);
    ask_unit(name, columns_[index], column);
    if (data::is_signed(*quantity(name))) mapping_.compression = mapping_.compression || columns_[index].compression;
  }

  void ask_unit(const std::string& name, const ColumnGuess& guess, const std::string& column) {
    const auto answer = std::ranges::find_if(
        answers_.units, [&](const auto& one) { return one.first == column || one.first == guess.title; });
    if (answer != answers_.units.end()) {
      if (guess.per_metre) mapping_.units[answer->first] = guess.unit;
      return;
    }
    const auto of = quantity(name);
    if (guess.unit_from_name && !guess.unit.empty())
      mapping_.units[column] = guess.unit;
    else if (guess.unit.empty() && of->unit != "1")
      mapping_.units[column] = ask_({fmt::format("Unit of the column '{}' ({})", guess.title, name),
                                     fmt::format("--unit '{}=UNIT'", column), of->unit});
    else if (guess.unit.empty() && is_strain(of->kind))
      mapping_.units[column] =
          ask_({fmt::format("Unit of the column '{}', whose values come to {:.4g}: 1 or %", guess.title, guess.largest),
                fmt::format("--unit '{}=UNIT'", column), guess.largest > 1 ? "%" : "1", false, true});
  }

  /// "strain" under the definition that its name, or the user, states.
  std::string word_of(const ColumnGuess& column) const {
    if (column.quantity != "strain") return column.quantity;
    const std::string& measure = column.measure.empty() ? answers_.strain_measure : column.measure;
    return measure == "true" ? "true_strain" : measure == "green" ? "green_strain" : "strain";
  }

  /// The observable of this test, or the quantity that yields it, for a guessed column.
  std::string name_for(const ColumnGuess& column) const {
    const std::string word = word_of(column);
    if (word.empty()) return observable_titled(column.title, factory_.observables);
    if (column.set_point && !prescribed(column)) return {};
    for (const std::string& name :
         {column.direction.empty() ? word : word + "_" + column.direction, word, "axial_" + word})
      if (quantity(name)) return name;
    return {};
  }

  bool prescribed(const ColumnGuess& column) const {
    const auto of = quantity(word_of(column));
    return of && of->observable->role != Role::channel;
  }

  /// Of each observable the likeliest column, in the order of the file; lengths behind displacements.
  void choose() {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < columns_.size(); ++k)
      if (!used_.contains(k) && columns_[k].numeric) order.push_back(k);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      const auto key = [&](std::size_t k) {
        return std::pair(columns_[k].rank, columns_[k].quantity == "length" ? 1 : 0);
      };
      return key(a) < key(b);
    });
    prefer_stated(order);
    const bool axes = axes_ || factory_.specimen == Specimen::sheet;
    std::vector<std::pair<std::string, std::size_t>> chosen;
    std::set<std::string> taken = given_;
    for (const bool undirected : {false, true})
      for (const std::size_t k : order) {
        const ColumnGuess& column = columns_[k];
        if (column.quantity == "diameter") continue;
        const std::string name = name_for(column);
        if (name.empty()) continue;
        const Role role = quantity(name)->observable->role;
        const bool sheet = factory_.specimen == Specimen::sheet && role != Role::time;
        if (sheet && undirected == has_axis(name)) continue;
        if (!sheet && undirected) continue;
        if (sheet && undirected && axes &&
            (axes_ || std::any_of(chosen.begin(), chosen.end(), [](const auto& one) { return has_axis(one.first); })))
          continue;
        if (!taken.insert(quantity(name)->observable->name).second) continue;
        chosen.emplace_back(name, k);
      }
    along_the_force(chosen);
    among_several(chosen);
    std::stable_sort(chosen.begin(), chosen.end(), [&](const auto& a, const auto& b) {
      const auto key = [&](const auto& one) {
        return std::pair(columns_[one.second].quantity == "length" ? 1 : 0, one.second);
      };
      return key(a) < key(b);
    });
    for (auto& [name, k] : chosen) {
      ask_strain(name, columns_[k]);
      take(name, k, columns_[k].name);
      if (columns_[k].set_point)
        mapping_.notes.push_back(
            fmt::format("'{}' is what the machine was told; no column has what it did", columns_[k].title));
    }
    if (!given_.contains("outer_diameter") && !given_.contains("inner_diameter")) ask_diameter();
  }

  /// Columns that state the measure that the user names go first.
  void prefer_stated(std::vector<std::size_t>& order) const {
    const auto misses = [&](std::size_t k) {
      const std::string& wanted = columns_[k].quantity == "stress"   ? answers_.stress_measure
                                  : columns_[k].quantity == "strain" ? answers_.strain_measure
                                                                     : columns_[k].measure;
      return !wanted.empty() && !columns_[k].measure.empty() && columns_[k].measure != wanted;
    };
    std::stable_partition(order.begin(), order.end(), [&](std::size_t k) { return !misses(k); });
  }

  /// A strip with the ways of two axes: that of the force, or it is asked.
  void along_the_force(std::vector<std::pair<std::string, std::size_t>>& chosen) {
    if (factory_.specimen != Specimen::strip) return;
    std::string load;
    for (const auto& [name, k] : chosen)
      if (quantity(name)->observable->kind == Observable::Kind::stress) load = columns_[k].direction;
    for (auto& [name, k] : chosen) {
      if (quantity(name)->observable->role != Role::abscissa || columns_[k].direction.empty()) continue;
      std::vector<std::size_t> same;
      for (std::size_t other = 0; other < columns_.size(); ++other)
        if (columns_[other].numeric && columns_[other].quantity == columns_[k].quantity && !columns_[other].set_point &&
            !columns_[other].direction.empty())
          same.push_back(other);
      const bool several = std::any_of(same.begin(), same.end(), [&](std::size_t other) {
        return columns_[other].direction != columns_[k].direction;
      });
      if (!several || columns_[k].direction == load) continue;
      const auto along =
          std::find_if(same.begin(), same.end(), [&](std::size_t other) { return columns_[other].direction == load; });
      if (along != same.end()) {
        k = *along;
        continue;
      }
      std::vector<std::string> names;
      for (const std::size_t other : same) names.push_back("'" + columns_[other].title + "'");
      k = csv_.column(ask_({fmt::format("Column along the force: {}", fmt::join(names, " or ")),
                            fmt::format("--column '{}=COLUMN'", name), columns_[k].name}));
      name = name_for(columns_[k]);
    }
  }

  /// Two actuators, or several specimens side by side: columns of one name, or of names that differ in a number. Which
  /// of them it is, or whether they have to be added, no file says.
  void among_several(std::vector<std::pair<std::string, std::size_t>>& chosen) {
    if (factory_.specimen == Specimen::sheet) return;
    for (auto& [name, k] : chosen) {
      if (quantity(name)->observable->role == Role::time) continue;
      std::vector<std::string> names;
      for (std::size_t other = 0; other < columns_.size(); ++other) {
        const ColumnGuess &one = columns_[other], &taken = columns_[k];
        if (one.numeric && one.quantity == taken.quantity && one.rank == taken.rank && one.unit == taken.unit &&
            without_digits(one.title) == without_digits(taken.title))
          names.push_back("'" + (one.name.starts_with('#') ? one.name : one.title) + "'");
      }
      if (names.size() < 2) continue;
      k = csv_.column(
          ask_({fmt::format("Column of the {}: {}; where two actuators move or bear together, make a column "
                            "of what both do",
                            name, fmt::join(names, " or ")),
                fmt::format("--column '{}=COLUMN'", name), columns_[k].name}));
    }
  }

  /// "E11" is the strain of Green in some files, and in others it is not.
  void ask_strain(std::string& name, const ColumnGuess& column) {
    if (column.quantity != "strain" || !column.measure.empty() || !answers_.strain_measure.empty()) return;
    if (!column.indexed) return;
    if (strain_.empty())
      strain_ = ask_({fmt::format("Strain of the column '{}': engineering, true (logarithmic) or green", column.title),
                      "--strain-measure", "green"});
    const std::string by = strain_ == "true" ? "true_strain" : strain_ == "green" ? "green_strain" : "strain";
    name.replace(name.find("strain"), 6, by);
  }

  void ask_diameter() {
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (columns_[k].quantity != "diameter" || !columns_[k].numeric || !quantity("outer_diameter")) continue;
      const std::string which =
          ask_({fmt::format("Is '{}' the outer_diameter or the inner_diameter", columns_[k].title),
                fmt::format("--column 'outer_diameter={}' or --column 'inner_diameter={}'", columns_[k].name,
                            columns_[k].name),
                "outer_diameter"});
      if (!quantity(which)) refuse_name(which);
      take(which, k, columns_[k].name);
      return;
    }
  }

  /// What looks like a strip and is none: a beam that is bent, and the shear of a rheometer.
  void refuse_other_tests() const {
    const auto of = [&](const char* kind) {
      return std::find_if(columns_.begin(), columns_.end(),
                          [&](const ColumnGuess& column) { return column.kind == kind; });
    };
    if (const auto bent = of(bending); bent != columns_.end())
      throw InputError(fmt::format(
          "{}, line {}: the column '{}' speaks of bending, and no test here bends a beam: a force over its section "
          "would be taken for a tension. Rename the column where the specimen was pulled.",
          csv_.file.string(), csv_.header_line, bent->title));
    if (const auto sheared = of(shearing); sheared != columns_.end() && factory_.specimen != Specimen::block)
      throw InputError(fmt::format(
          "{}, line {}: the column '{}' is one of a rheometer, whose stresses and strains are of shear, and not of a "
          "test of type '{}'. Give --test simple_shear where the shear is the same everywhere, and name its columns "
          "with --column.",
          csv_.file.string(), csv_.header_line, sheared->title, factory_.type));
  }

  void refuse_gaps() const {
    std::vector<std::string> names;
    for (const ColumnGuess& column : columns_)
      names.push_back(fmt::format("'{}'{}", column.title,
                                  !column.kind.empty() ? " (" + column.kind + ")"
                                  : column.values.empty()
                                      ? std::string()
                                      : fmt::format(" (text such as '{}')", data::excerpt(column.values.back()))));
    const auto some = [this](const std::string ColumnGuess::*member, std::string_view text) {
      return std::any_of(columns_.begin(), columns_.end(),
                         [&](const ColumnGuess& column) { return column.*member == text; });
    };
    const bool held = some(&ColumnGuess::quantity, "time") &&
                      (some(&ColumnGuess::quantity, "force") || some(&ColumnGuess::quantity, "stress"));
    const std::string hint =
        some(&ColumnGuess::kind, indentation)
            ? " A tip that is pressed into a surface is a test of its own, --test indentation."
        : some(&ColumnGuess::kind, "a frequency")
            ? " Moduli over the frequency are of an oscillation, --test dynamic_mechanical."
        : held && factory_.specimen == Specimen::strip
            ? " Where the strip was held at one stretch all the time, give --test loading_segments --set "
              "segments=STRETCH."
            : "";
    bool channel = false;
    for (const Observable& observable : factory_.observables) {
      channel = channel || (observable.role == Role::channel && given_.contains(observable.name));
      if (observable.required && !given_.contains(observable.name))
        throw InputError(
            fmt::format("{}, line {}: no column is known to give '{}' of a test of type '{}'. Columns: {}. "
                        "Name one with --column, for example --column '{}=COLUMN', or another --test.{}",
                        csv_.file.string(), csv_.header_line, observable.name, factory_.type, fmt::join(names, ", "),
                        observable.kind == Observable::Kind::stretch ? "displacement" : observable.name, hint));
    }
    if (!channel)
      throw InputError(
          fmt::format("{}, line {}: no column is known to be measured in a test of type '{}'. Columns: {}. Name "
                      "one with --column, for example --column 'force=COLUMN'.",
                      csv_.file.string(), csv_.header_line, factory_.type, fmt::join(names, ", ")));
  }

  /// What the names say of measures is one thing, and what the user says.
  void check_measures() {
    for (const auto& [name, column] : mapping_.columns) {
      const ColumnGuess& guess = columns_[csv_.column(column)];
      const auto of = quantity(name);
      const bool stress = of->kind == From::own && of->observable->kind == Observable::Kind::stress;
      if (guess.measure.empty() || !(stress || is_strain(of->kind))) continue;
      const std::string& answer = stress ? answers_.stress_measure : answers_.strain_measure;
      if (!answer.empty() && answer != guess.measure)
        throw InputError(
            fmt::format("{}, line {}: the column '{}' says {}, and --{}-measure says {}. Leave the option out, or name "
                        "another column with --column '{}=COLUMN'.",
                        csv_.file.string(), csv_.header_line, guess.title, guess.measure, stress ? "stress" : "strain",
                        answer, name));
      if (stress) mapping_.stress_measure = guess.measure;
      said_.push_back(fmt::format("'{}' is a {} {}", guess.title, guess.measure, stress ? "stress" : "strain"));
    }
  }

  void list_unused() {
    constexpr std::size_t most = 12;
    std::vector<std::string> unused;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const ColumnGuess& column = columns_[k];
      if (used_.contains(k) || !column.numeric || column.quantity == "cycle") continue;
      const std::string kind = column.set_point ? "set point" : column.kind;
      unused.push_back(fmt::format("'{}'{}", column.title, kind.empty() ? "" : " (" + kind + ")"));
      if (column.kind == total_force)
        mapping_.notes.push_back(
            fmt::format("'{}' is a total force, and the test takes the reduced one: total less pressure × π × inner "
                        "radius². Compute it, and name its column with --column axial_force=COLUMN",
                        column.title));
    }
    if (unused.empty()) return;
    const std::size_t more = unused.size() > most ? unused.size() - most : 0;
    unused.resize(unused.size() - more);
    mapping_.notes.push_back(
        fmt::format("not used: {}{}", fmt::join(unused, ", "), more > 0 ? fmt::format(", and {} more", more) : ""));
  }

  const data::Csv& csv_;
  const std::vector<ColumnGuess>& columns_;
  const TestFactory& factory_;
  const Answers& answers_;
  const Ask& ask_;
  Mapping mapping_;
  std::set<std::string> given_;  ///< observables
  std::set<std::size_t> used_;   ///< columns
  std::vector<std::string> said_;
  std::string strain_;  ///< as answered
  bool axes_ = false;   ///< the answers name columns of an axis
};

}  // namespace

Mapping map_columns(const data::Csv& csv, const std::vector<ColumnGuess>& columns, const TestFactory& factory,
                    const Answers& answers, const Ask& ask) {
  return Mapper(csv, columns, factory, answers, ask).map();
}

}  // namespace tunica::importing
