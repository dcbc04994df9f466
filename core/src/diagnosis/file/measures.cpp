// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "data/quantities.hpp"
#include "diagnosis/file/changes.hpp"
#include "diagnosis/file/correction.hpp"

namespace tunica::diagnosis {
namespace {

using Kind = data::Quantity::Kind;

struct Measure {
  std::string_view name, words;
};
constexpr std::array measures{Measure{"cauchy", "Cauchy"}, Measure{"first_piola_kirchhoff", "first Piola–Kirchhoff"},
                              Measure{"second_piola_kirchhoff", "second Piola–Kirchhoff"}};

std::string_view words_of_measure(std::string_view name) {
  for (const Measure& measure : measures)
    if (measure.name == name) return measure.words;
  return name;
}

/// Columns of the file that hold what this predicate accepts.
template <class Accept>
std::vector<data::Quantity> columns_with(const Record& record, const std::string& test, const Accept& accept) {
  std::vector<data::Quantity> found;
  for (const auto& [name, column] : record.test(test).data.columns)
    if (const auto quantity = data::quantity_named(name, record.observables(test)); quantity && accept(*quantity))
      found.push_back(*quantity);
  return found;
}

/// A column of stress whose stretch the data have: one from a force has the measure that the program gave it.
bool is_measured_stress(const Record& record, const std::string& test, const data::Quantity& quantity) {
  if (quantity.kind != Kind::own || quantity.observable->kind != Observable::Kind::stress) return false;
  const Observable* const beside = data::stretch_beside(*quantity.observable, record.observables(test));
  return beside != nullptr && abscissa_of(record.data(test), beside->name) != nullptr;
}

/// Values of this measure where the file says another. Where no stress is one of a force, which has the measure that
/// the program gave it, the declaration changes; else the values, v λ^(q′ − q) with σ = v λ^q.
bool read_as(Record& record, const std::string& test, std::string_view measure) {
  if (columns_with(record, test, [](const data::Quantity& one) { return one.kind == Kind::force; }).empty()) {
    record.test(test).data.stress_measure = measure;
    return true;
  }
  const int change = cauchy_power(measure) - cauchy_power(record.test(test).data.stress_measure);
  for (const data::Quantity& stress :
       columns_with(record, test, [&](const data::Quantity& one) { return is_measured_stress(record, test, one); })) {
    const Observable* const beside = data::stretch_beside(*stress.observable, record.observables(test));
    std::vector<double> factors;
    for (const double stretch : *abscissa_of(record.data(test), beside->name))
      factors.push_back(std::pow(stretch, change));
    if (!record.scale_channel(test, stress.observable->name, factors)) return false;
  }
  return true;
}

/// Another declaration in each test; nothing where one of them cannot have it.
std::vector<Change> measure_changes(const Record& record, const std::vector<std::string>& tests,
                                    std::string_view measure) {
  std::vector<Change> changes;
  for (const std::string& test : tests)
    if (!change_stress_measure(record.test(test), record.observables(test), measure, changes)) return {};
  return changes;
}

bool is_strain(const data::Quantity& quantity) {
  return quantity.observable->kind == Observable::Kind::stretch &&
         quantity.observable->role == Observable::Role::abscissa &&
         (quantity.kind == Kind::own || quantity.kind == Kind::strain || quantity.kind == Kind::true_strain ||
          quantity.kind == Kind::green_strain);
}

/// What a strain means, and the stretch that follows from it.
struct Definition {
  Kind kind;
  std::string_view words, key;
  double (*stretch)(double);
};
constexpr std::array definitions{
    Definition{Kind::strain, "engineering strains", "strain", [](double e) { return 1 + e; }},
    Definition{Kind::true_strain, "logarithmic strains", "true_strain", [](double e) { return std::exp(e); }},
    Definition{Kind::green_strain, "Green–Lagrange strains", "green_strain",
               [](double e) { return std::sqrt(1 + 2 * e); }}};

/// The number that the file has, of a stretch that follows from it; a stretch itself is 1 + engineering strain.
double strain_in_file(Kind kind, double stretch) {
  return kind == Kind::true_strain    ? std::log(stretch)
         : kind == Kind::green_strain ? (stretch * stretch - 1) / 2
                                      : stretch - 1;
}

bool map_strains(Record& record, const std::string& test, const std::function<double(double)>& stretch_of) {
  for (const data::Quantity& column : columns_with(record, test, is_strain))
    if (!record.map_abscissa(test, column.observable->name,
                             [&](double stretch) { return stretch_of(strain_in_file(column.kind, stretch)); }))
      return false;
  return true;
}

Kind declared(const Record& record, const std::string& test) {
  return columns_with(record, test, is_strain).front().kind;
}

std::string_view words_of_declared(Kind kind) {
  for (const Definition& definition : definitions)
    if (definition.kind == kind) return definition.words;
  return "stretches";
}

}  // namespace

void add_stress_measures(const Record& record, const std::vector<std::string>& tests, Corrections& all) {
  for (const Measure& measure : measures) {
    std::vector<std::string> others;
    for (const std::string& test : tests) {
      const auto stresses =
          columns_with(record, test, [&](const data::Quantity& one) { return is_measured_stress(record, test, one); });
      if (!stresses.empty() && record.test(test).data.stress_measure != measure.name) others.push_back(test);
    }
    add_for_each_and_all(
        FileKind::stress_measure, others,
        [&](const std::vector<std::string>& in) -> Wording {
          return {fmt::format("the stresses of {} are {} stresses, not {} ones", quoted(in), measure.words,
                              words_of_measure(record.test(in.front()).data.stress_measure)),
                  fmt::format("\"stress_measure\": \"{}\" in the data of {}", measure.name, quoted(in)),
                  measure_changes(record, in, measure.name)};
        },
        [&measure](Record& read, const std::string& test) { return read_as(read, test, measure.name); }, all);
  }
}

void add_strain_definitions(const Record& record, const std::vector<std::string>& tests, Corrections& all) {
  std::vector<std::string> strained;
  for (const std::string& test : tests)
    if (!columns_with(record, test, is_strain).empty()) strained.push_back(test);
  for (const Definition& definition : definitions) {
    std::vector<std::string> others;
    for (const std::string& test : strained) {
      const Kind kind = declared(record, test);
      if (kind != definition.kind && (kind != Kind::own || definition.kind != Kind::strain)) others.push_back(test);
    }
    add_for_each_and_all(
        FileKind::strain_definition, others,
        [&](const std::vector<std::string>& in) -> Wording {
          const Kind kind = declared(record, in.front());
          if (kind == Kind::own)
            return {
                fmt::format("the stretches of {} are 1 + {}, not lengths over lengths", quoted(in), definition.words),
                fmt::format("the strain itself, with \"{}\" in place of \"stretch\" in the columns of {}",
                            definition.key, quoted(in))};
          return {
              fmt::format("the strains of {} are {}, not {}", quoted(in), definition.words, words_of_declared(kind)),
              fmt::format("\"{}\" in place of \"{}\" in the columns of {}", definition.key,
                          kind == Kind::strain        ? "strain"
                          : kind == Kind::true_strain ? "true_strain"
                                                      : "green_strain",
                          quoted(in))};
        },
        [stretch = definition.stretch](Record& read, const std::string& test) {
          return map_strains(read, test, stretch);
        },
        all);
  }
  const auto add_scaled = [&](double factor, const char* is, const char* mend) {
    add_for_each_and_all(
        FileKind::strain_definition, strained,
        [&](const std::vector<std::string>& in) -> Wording {
          return {fmt::format("the strains of {} are {}", quoted(in), is), fmt::format("{} of {}", mend, quoted(in))};
        },
        [factor](Record& read, const std::string& test) {
          for (const data::Quantity& column : columns_with(read, test, is_strain))
            if (!read.map_abscissa(test, column.observable->name, [&](double stretch) {
                  const Kind kind = column.kind;
                  const double e = factor * strain_in_file(kind, stretch);
                  return kind == Kind::true_strain    ? std::exp(e)
                         : kind == Kind::green_strain ? std::sqrt(1 + 2 * e)
                                                      : 1 + e;
                }))
              return false;
          return true;
        },
        all);
  };
  add_scaled(0.01, "percents, not fractions", "the unit % in the header of the strains");
  add_scaled(100, "fractions, not percents", "the unit 1 in the header of the strains");
  add_scaled(10, "ten times what the file says", "the unit of the displacement, or the gauge length,");
  add_scaled(0.1, "a tenth of what the file says", "the unit of the displacement, or the gauge length,");
  std::vector<std::string> stretched;
  for (const std::string& test : strained)
    if (declared(record, test) == Kind::own) stretched.push_back(test);
  add_for_each_and_all(
      FileKind::strain_definition, stretched,
      [&](const std::vector<std::string>& in) -> Wording {
        return {fmt::format("the stretches of {} are squares of stretches", quoted(in)),
                fmt::format("their square roots into the column of {}", quoted(in))};
      },
      [](Record& read, const std::string& test) {
        return map_strains(read, test, [](double e) { return std::sqrt(1 + e); });
      },
      all);
}

}  // namespace tunica::diagnosis
