// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/sections.hpp"

namespace tunica::report {

namespace {

constexpr std::size_t most_mechanisms = 25;  ///< rows of the picture
constexpr std::size_t most_specimens = 200;  ///< columns of it

double at(const Json& values, std::size_t k) {
  return k < values.size() && values[k].is_number() ? values[k].get<double>() : NAN;
}

/// Up to `most` of `count` positions, evenly.
std::vector<std::size_t> some_of(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen(std::min(count, most));
  for (std::size_t k = 0; k < chosen.size(); ++k) chosen[k] = k * count / chosen.size();
  return chosen;
}

/// Mechanisms, those that the cohort speaks for most on top, over specimens: how much each speaks for each.
void add_picture(Page& page, const Folder& folder, const Json& diagnosis) {
  const Json& matrix = list(diagnosis, key::matrix);
  const Json& specimens = list(diagnosis, key::specimens);
  if (matrix.empty() || specimens.empty()) return;
  Chart chart;
  chart.kind = "heat";
  chart.id = "mechanisms_by_specimen";
  chart.title = "How much each specimen speaks for each mechanism";
  chart.about = "Natural logarithm of the evidence of every mechanism over none, specimen by specimen";
  chart.note = "ln of the evidence over no mechanism: 0 says nothing, 3 is strong, below 0 speaks against it.";
  chart.legend_title = "ln evidence";
  chart.files = {"mechanisms.csv"};
  const std::vector<std::size_t> shown = some_of(specimens.size(), most_specimens);
  if (shown.size() < specimens.size())
    chart.note += fmt::format(" {} of {} specimens; the table has all.", shown.size(), specimens.size());
  for (const std::size_t s : shown) chart.columns.push_back(specimens[s].get<std::string>());
  for (std::size_t k = 0; k < std::min(matrix.size(), most_mechanisms); ++k) {
    chart.labels.push_back(word(matrix[k], key::mechanism));
    std::vector<double> row;
    for (const std::size_t s : shown) row.push_back(at(list(matrix[k], key::log_evidence), s));
    chart.values.push_back(std::move(row));
  }
  if (chart.labels.size() < matrix.size())
    chart.note += fmt::format(" The {} likeliest of {} mechanisms.", chart.labels.size(), matrix.size());
  chart.domain = {-10, 10};
  page.chart(chart, folder.address());
}

/// Gain of each specimen, with its own amplitude and with that of the others.
void add_gain(Page& page, const Folder& folder, const Json& diagnosis) {
  const Json& all = list(diagnosis, key::left_out);
  if (all.empty()) return;
  Chart chart;
  chart.id = "left_out";
  chart.title = "What the cause leaves of each specimen";
  chart.about = "Squared residuals per value without the cause, with an amplitude of its own, and with that of others";
  chart.note = "1 is noise. \"Foretold\": the amplitude is the mean of the other specimens, which never saw this one.";
  chart.x.title = "specimens, in the order of the table of results";
  chart.y = {"|r|² / values", true, {}, {}};
  chart.legend = true;
  chart.files = {"result.json"};
  Series without{"without the cause", "points", -1}, own{"amplitude of its own", "points", 0},
      foretold{"foretold", "points", 1};
  double place = 0;
  for (const Json& one : all) {
    place += 1;
    const double rows = number(one, key::rows);
    for (auto& [series, of] :
         {std::pair<Series&, results::Key>{without, key::without}, {own, key::own}, {foretold, key::foretold}}) {
      series.x.push_back(place);
      series.y.push_back(number(one, of) / rows);
    }
  }
  chart.rule(1, "noise");
  for (Series* one : {&without, &foretold, &own}) chart.series.push_back(std::move(*one));
  page.chart(chart, folder.address());
}

void add_rivals(Page& page, const Json& diagnosis) {
  std::vector<std::vector<Cell>> rows;
  std::vector<bool> in_set;
  for (const Json& one : list(diagnosis, key::explanations)) {
    if (rows.size() == 12) break;
    std::vector<std::string> places;
    for (const Json& place : list(one, key::places)) places.push_back(word(place, key::words));
    rows.push_back({{fmt::format("{}", fmt::join(words(list(one, key::mechanisms)), " with "))},
                    {fmt::format("{}", fmt::join(places, "; "))},
                    {share(number(one, key::probability)), true},
                    {figure(number(one, key::log_weight)), true}});
    in_set.push_back(member(one, key::in_set) == true);
  }
  if (rows.empty()) return;
  page.heading("Explanations; those that the data cannot tell apart stand out");
  page.html(table_html({"mechanisms", "likeliest place", "probability", "ln weight"}, rows, in_set));
}

void add_cause_by_group(Page& page, const Json& diagnosis) {
  std::vector<std::vector<Cell>> rows;
  for (const Json& factor : list(diagnosis, key::factors))
    for (const Json& level : list(factor, key::levels)) {
      const Json& amplitude = member(level, key::amplitude);
      rows.push_back({{fmt::format("{} = {}", word(factor, key::factor), word(level, key::level))},
                      {figure(number(level, key::specimens)), true},
                      {figure(number(level, key::with)), true},
                      {amplitude.is_object()
                           ? fmt::format("{} ({} … {})", figure(number(amplitude, key::mean)),
                                         figure(number(amplitude, key::low)), figure(number(amplitude, key::high)))
                           : "–",
                       true},
                      {word(factor, key::only_in) == word(level, key::level) ? "only these" : ""}});
    }
  if (rows.empty()) return;
  page.heading("The cause by group");
  page.html(table_html({"group", "specimens", "ln evidence that it is there", "mean amplitude (95 %)", ""}, rows));
}

}  // namespace

void add_cohort_diagnosis(Page& page, const Folder& folder) {
  const Json& diagnosis = member(folder.result(), key::diagnosis);
  if (!diagnosis.is_object()) return;
  page.section("What the model gets wrong");
  std::vector<std::string> sentences = words(list(diagnosis, key::sentences));
  if (sentences.empty()) return;
  const std::string verdict = sentences.front();
  sentences.erase(sentences.begin());
  page.box(word(diagnosis, key::verdict) == "nothing_detected" ? "good" : "bad", verdict, sentences, 10);
  std::vector<std::string> apart, without;
  for (const Json& one : list(diagnosis, key::contradictions))
    apart.push_back(fmt::format("{}: {}", word(one, key::specimen), word(one, key::text)));
  if (!apart.empty()) page.box("", "Specimens that do not go with it", apart, 5);
  for (const Json& one : list(diagnosis, key::not_diagnosed))
    without.push_back(fmt::format("{}: {}", word(one, key::specimen), word(one, key::reason)));
  if (!without.empty()) page.box("bad", "Not diagnosed", without, 5);
  add_picture(page, folder, diagnosis);
  add_rivals(page, diagnosis);
  add_cause_by_group(page, diagnosis);
  add_gain(page, folder, diagnosis);
  if (const Json& extended = member(diagnosis, key::extended); extended.is_object()) {
    page.paragraph("The cohort with the cause in its experiment:");
    page.command("tunica cohort " + folder.in_command(word(extended, key::cohort)));
  }
}

}  // namespace tunica::report
