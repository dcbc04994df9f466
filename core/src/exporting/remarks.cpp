// SPDX-License-Identifier: Apache-2.0
#include "exporting/remarks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "report/folder.hpp"
#include "report/pieces.hpp"
#include "results/keys.hpp"
#include "results/reading.hpp"
#include "text/misfit_words.hpp"
#include "text/units.hpp"

namespace tunica::exporting {

namespace {

namespace key = results::key;
using results::Json;
using results::list;
using results::member;
using results::word;

void add(std::vector<std::string>& paragraphs, std::string paragraph) {
  paragraphs.insert(paragraphs.end(), std::move(paragraph));
}

std::string parameter_words(const std::string& name, const Json& entry) {
  const std::string unit = word(entry, key::unit);
  std::string words =
      fmt::format("  {} = {:.10g}{}", name, results::number(entry, key::value), text::unit_suffix(unit));
  if (!entry.contains(key::ci95.text)) return words + ", held fixed";
  const Json& interval = member(entry, key::ci95);
  if (interval.is_array() && interval.size() == 2 && interval[0].is_number() && interval[1].is_number()) {
    words += fmt::format(", 95 % interval {} to {}", report::figure(interval[0]), report::figure(interval[1]));
    if (member(entry, key::ci95_reliable) == false) words += " (rough)";
  } else {
    words += ", without an interval";
  }
  if (const std::string bound = word(entry, key::at_bound); !bound.empty())
    words += fmt::format(", at its {} bound", bound);
  return words;
}

/// A misfit counts above the tolerance of the run, or where noise does not explain it.
void add_misfit(const Json& best, std::vector<std::string>& paragraphs) {
  constexpr double usual_tolerance = 0.02;  // of the range
  const Json& size = member(best, key::misfit_size);
  const double rms = results::number(size, key::rms), stated = results::number(size, key::tolerance);
  const bool contradicted = member(member(best, key::misfit), key::contradicts_noise) == true ||
                            member(member(best, key::misfit_estimated), key::contradicts_noise) == true;
  if (!std::isfinite(rms) || !(contradicted || rms > (std::isfinite(stated) ? stated : usual_tolerance))) return;
  add(paragraphs, fmt::format("Misfit: the model {} beyond noise; the intervals hold only if the model is right.",
                              text::misses_by(rms)));
}

/// "stretch 1.02 to 7.6": the measured and prescribed columns of a test's fit over the rows that the run was fitted to.
std::string range_of(const report::Table& table, const std::string& run) {
  std::string words;
  const auto held_out = table.find("held_out"), label = table.find("run");
  for (std::size_t column = 0; column < table.columns().size() && column < held_out.value_or(0); ++column) {
    const std::string& name = table.columns()[column].name;
    if (name == "run" || name.ends_with(".predicted")) continue;
    double least = std::numeric_limits<double>::infinity(), largest = -least;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      if (!label || table.text(row, *label) != run || table.number(row, *held_out) != 0) continue;
      const double value = table.number(row, column);
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      largest = std::max(largest, value);
    }
    if (least <= largest)
      words += fmt::format("{}{} {} to {}", words.empty() ? "" : ", ", table.title(column), report::figure(least),
                           report::figure(largest));
  }
  return words;
}

void add_ranges(const Origin& origin, std::vector<std::string>& paragraphs) {
  const report::Folder folder(origin.folder);
  for (const std::string& test : results::words(list(origin.run, key::tests)))
    if (const auto table = folder.table(fmt::format("fit_{}.csv", test)))
      if (const std::string range = range_of(*table, word(origin.run, key::run)); !range.empty())
        add(paragraphs, fmt::format("Fitted range of test '{}': {}.", test, range));
}

void add_stability(const Origin& origin, std::vector<std::string>& paragraphs) {
  const Json* found = &member(member(origin.run, key::best), key::stability);
  if (const Json& of_models = member(*found, key::models); of_models.contains(origin.model))
    found = &results::entry(of_models, origin.model);
  for (const std::string& sentence : results::words(list(*found, key::sentences)))
    add(paragraphs, "Stability: " + sentence + ".");
}

void add_warnings(const Origin& origin, std::vector<std::string>& paragraphs) {
  for (const Json& warning : list(origin.result, key::warning_details))
    if (const std::string run = word(warning, key::run); run.empty() || run == word(origin.run, key::run))
      add(paragraphs, "Warning: " + word(warning, key::sentence));
  for (const std::string& sentence : results::words(list(member(origin.run, key::best), key::identifiability)))
    add(paragraphs, "Identifiability: " + sentence);
}

}  // namespace

std::vector<std::string> remarks(const Origin& origin) {
  std::vector<std::string> paragraphs;
  const Json& provenance = member(origin.result, key::provenance);
  add(paragraphs,
      fmt::format("Written by tunica; fitted by tunica {}: experiment '{}', run '{}', model '{}' (type {}), "
                  "folder {}.",
                  word(provenance, key::tunica), word(origin.result, key::name), word(origin.run, key::run),
                  origin.model, origin.type, origin.folder.string()));
  add_misfit(member(origin.run, key::best), paragraphs);
  add(paragraphs, "Experiment sha256:" + word(provenance, key::input_sha256));
  for (const std::string& data : results::words(list(provenance, key::data))) add(paragraphs, "Data: " + data);
  add(paragraphs, "Parameters as fitted, in the units and conventions of tunica:");
  for (const auto& [name, entry] : origin.parameters) add(paragraphs, parameter_words(name, entry));
  add_ranges(origin, paragraphs);
  add_stability(origin, paragraphs);
  add_warnings(origin, paragraphs);
  return paragraphs;
}

}  // namespace tunica::exporting
