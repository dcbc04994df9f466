// SPDX-License-Identifier: Apache-2.0
#include "cohort/specification.hpp"

#include <fmt/format.h>

#include "data/csv.hpp"
#include "experiment/json_document.hpp"
#include "experiment/json_node.hpp"
#include "experiment/limits.hpp"

namespace tunica::cohort {

namespace {

using experiment::JsonDocument;
using experiment::Node;

template <class Enumeration, std::size_t count>
Enumeration coded(const Node& node, const text::Codes<Enumeration, count>& codes, std::string_view noun) {
  std::vector<std::string> names;
  for (const auto& entry : codes) names.emplace_back(entry.code);
  return *text::value_of(codes, node.one_of(names, noun));
}

/// A cell of the table is text; a number here only lacks its quotes.
std::string cell_text(const Node& node) {
  return node.is_number() || node.is_flag() ? node.dumped() : node.text("a text or a number");
}

void read_table(const Node& node, Specification& cohort) {
  cohort.table_place = node.place();
  const auto folder = cohort.file.parent_path();
  if (node.is_text()) {
    cohort.table = folder / node.text("");
    return;
  }
  node.expect_object("the file of the table of specimens, or an object { \"file\": …, \"id\": … },");
  node.allow_only({"file", "id", "where"}, "the table of specimens");
  cohort.table = folder / node.require("file", "the table of specimens").text("a file name");
  if (const auto id = node.find("id")) cohort.id_column = id->text("the name of a column");
  if (const auto where = node.find("where"))
    for (const auto& [column, value] : where->members("an object with one entry per column")) {
      if (!value.is_array()) {
        cohort.where.emplace_back(column, cell_text(value));
        continue;
      }
      for (const Node& one : value.elements("a list of values")) cohort.where.emplace_back(column, cell_text(one));
    }
}

void read_factors(const Node& node, Specification& cohort) {
  if (node.is_array()) {
    for (const Node& one : node.elements("a list of columns"))
      cohort.factors.push_back({one.text("the name of a column"), {}, one.place()});
    return;
  }
  for (const auto& [column, entry] : node.members("a list of columns, or an object with one entry per column")) {
    entry.expect_object("an object, such as { \"reference\": \"control\" },");
    entry.allow_only({"reference"}, "factor '" + column + "'");
    FactorEntry factor{column, {}, entry.place()};
    if (const auto reference = entry.find("reference")) factor.reference = cell_text(*reference);
    cohort.factors.push_back(std::move(factor));
  }
}

ReadingEntry read_reading(const std::string& name, const Node& node) {
  node.expect_object("an object with test, channel and one of at, slope, integral,");
  node.allow_only({"test", "channel", "at", "slope", "integral"}, "reading '" + name + "'");
  ReadingEntry reading{name,
                       node.require("test", "a reading").text("the name of a test"),
                       node.require("channel", "a reading").text("the name of a channel"),
                       ReadingKind::value,
                       {},
                       node.place()};
  std::size_t kinds = 0;
  for (const auto& [kind, code] : reading_codes) {
    const auto at = node.find(std::string(code));
    if (!at) continue;
    ++kinds;
    reading.kind = kind;
    reading.at.clear();
    if (kind == ReadingKind::value)
      reading.at = {cell_text(*at)};
    else
      for (const Node& one : at->elements("a list of two values, from and to,")) reading.at.push_back(cell_text(one));
    if (reading.at.size() != (kind == ReadingKind::value ? 1U : 2U))
      at->fail(fmt::format("found a list of {} where two values, from and to, are expected", reading.at.size()));
  }
  if (kinds != 1)
    node.fail(fmt::format("the reading '{}' has {} of the keys at, slope, integral", name, kinds),
              "Give exactly one of them.");
  return reading;
}

void read_population(const Node& node, Specification& cohort) {
  node.expect_object("an object,");
  node.allow_only({"spread", "noise", "permutations"}, "population");
  if (const auto spread = node.find("spread")) cohort.spread = coded(*spread, spread_codes, "structure of spreads");
  if (const auto noise = node.find("noise")) cohort.noise = coded(*noise, noise_pool_codes, "source of noise");
  if (const auto count = node.find("permutations"))
    cohort.permutations = count->count("a whole number", 99, experiment::limits::permutations);
}

/// true, false, or an object.
void read_diagnosis(const Node& node, Specification& cohort) {
  if (node.is_flag()) {
    if (node.flag("")) cohort.diagnosis.emplace();
    return;
  }
  node.expect_object("true, false or an object with quick and alpha,");
  node.allow_only({"quick", "alpha"}, "\"diagnosis\" of a cohort");
  DiagnosisEntry& entry = cohort.diagnosis.emplace();
  if (const auto quick = node.find("quick")) entry.quick = quick->flag("true or false");
  if (const auto alpha = node.find("alpha")) {
    entry.alpha = alpha->number("a number between 0 and 1");
    if (!(entry.alpha > 0 && entry.alpha < 1)) alpha->fail_expected("a number between 0 and 1");
  }
}

}  // namespace

Specification read_specification(const std::filesystem::path& file) {
  Specification cohort;
  cohort.file = file;
  cohort.text = data::read_bytes(file, experiment::limits::file_bytes);
  const JsonDocument document(file, cohort.text);
  const Node root(document);
  root.expect_object("a cohort, { \"format\": 1, … },");
  const Node format = root.require("format", "the cohort file");
  if (!format.is_number() || format.number("") != 1)
    format.fail(fmt::format("found format {} where 1 is expected", format.dumped()),
                "This version of tunica reads format 1 only.");
  if (!root.find("specimens") && root.find("models"))
    root.fail("this is an experiment, not a cohort",
              "Write a cohort file that names it in \"experiment\", and a table in \"specimens\"; see docs/cohort.md.");
  root.allow_only({"$schema", "format", "name", "seed", "experiment", "specimens", "bind", "factors", "nested_in",
                   "readings", "population", "diagnosis"},
                  "the cohort file");
  cohort.name = file.stem().string();
  if (const auto node = root.find("$schema")) node->text("the name of a schema");
  if (const auto node = root.find("name")) cohort.name = node->text("a name");
  if (const auto node = root.find("seed")) cohort.seed = node->count("a whole number", 0);
  const Node experiment = root.require("experiment", "the cohort file");
  cohort.experiment = file.parent_path() / experiment.text("the file name of an experiment");
  read_table(root.require("specimens", "the cohort file"), cohort);
  const Node bind = root.require("bind", "the cohort file");
  for (const auto& [pointer, pattern] : bind.members("an object: JSON pointer → text with {columns}"))
    cohort.bindings.push_back({pointer, pattern.text("a text with {columns} of the table"), pattern.place()});
  if (cohort.bindings.empty())
    bind.fail("nothing is bound, so that all specimens would be the same",
              "Bind at least the data, for example \"/tests/strip/data/file\": \"{id}.csv\".");
  if (const auto node = root.find("factors")) read_factors(*node, cohort);
  if (const auto node = root.find("nested_in")) {
    cohort.nested_in = node->text("the name of a column");
    cohort.nested_place = node->place();
  }
  if (const auto node = root.find("readings"))
    for (const auto& [name, entry] : node->members("an object with one entry per reading"))
      cohort.readings.push_back(read_reading(name, entry));
  if (const auto node = root.find("population")) read_population(*node, cohort);
  if (const auto node = root.find("diagnosis")) read_diagnosis(*node, cohort);
  return cohort;
}

}  // namespace tunica::cohort
