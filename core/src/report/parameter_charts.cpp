// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "report/sections.hpp"
#include "report/thinning.hpp"
#include "text/lists.hpp"
#include "text/units.hpp"

namespace tunica::report {

namespace {

constexpr std::size_t most_runs = 12;
struct Kind {
  results::Key key;
  const char* name;
};
constexpr std::array<Kind, 4> kinds{{{key::ci95, "linearised"},
                                     {key::profile_ci95, "profile"},
                                     {key::bootstrap_ci95, "bootstrap"},
                                     {key::posterior_ci95, "posterior"}}};

std::pair<double, double> interval(const Json& estimate, results::Key of) {
  const Json& pair = member(estimate, of);
  const auto end = [&](std::size_t k) {
    return pair.is_array() && pair.size() == 2 && pair[k].is_number() ? pair[k].get<double>() : NAN;
  };
  return {end(0), end(1)};
}

/// An end at which the data set no limit is open.
std::string interval_words(const Json& estimate, const Kind& kind) {
  const auto [low, high] = interval(estimate, kind.key);
  if (!std::isfinite(low) && !std::isfinite(high)) return "not fixed by the data";
  return fmt::format(
      "{} … {}{}", std::isfinite(low) ? figure(low) : "open", std::isfinite(high) ? figure(high) : "open",
      kind.key.text == key::ci95.text && member(estimate, key::ci95_reliable) == false ? " (rough)" : "");
}

void add_table(Page& page, const Order::Run& run) {
  std::vector<std::vector<Cell>> rows;
  std::vector<std::string> head{"parameter", "value"};
  const Json& best = member(*run.run, key::best);
  const Json& parameters = member(best, key::parameters);
  std::vector<Kind> made;
  for (const Kind& kind : kinds) {
    bool any = kind.key.text == key::ci95.text;
    for (const auto& [name, estimate] : parameters.items()) any = any || member(estimate, kind.key).is_array();
    if (!any) continue;
    made.push_back(kind);
    head.push_back(fmt::format("95 %, {}", kind.name));
  }
  bool meshed = false;
  for (const auto& [name, estimate] : parameters.items())
    meshed = meshed || member(estimate, key::mesh_bias).is_number();
  if (meshed) head.push_back("of which the mesh");
  head.insert(head.end(), {"bounds", ""});
  for (const auto& [name, estimate] : parameters.items()) {
    const std::string bound = word(estimate, key::at_bound);
    auto& row = rows.emplace_back(std::vector<Cell>{{text::titled(name, word(estimate, key::unit))},
                                                    {figure(number(estimate, key::value)), true}});
    for (const Kind& kind : made) row.push_back({interval_words(estimate, kind)});
    if (meshed)
      row.push_back(
          {member(estimate, key::mesh_bias).is_number() ? figure(number(estimate, key::mesh_bias)) : "", true});
    row.push_back({fmt::format("{} … {}", figure(number(estimate, key::min)), figure(number(estimate, key::max)))});
    row.push_back({bound.empty() ? "" : "at its " + bound + " bound", false, true});
  }
  for (const auto& [name, estimate] : member(*run.run, key::fixed).items()) {
    auto& row = rows.emplace_back(std::vector<Cell>{
        {text::titled(name, word(estimate, key::unit))}, {figure(number(estimate, key::value)), true}, {"fixed"}});
    row.resize(head.size());
  }
  if (rows.empty()) return;
  page.heading(run.label);
  page.html(table_html(head, rows));
  std::vector<std::string> sentences, names;
  for (const auto& entry : parameters.items()) names.push_back(entry.key());
  for (const std::string& sentence : words(list(best, key::uncertainty)))
    sentences.push_back(text::capitalised(sentence, names) + '.');
  if (!sentences.empty()) page.box("", "What to make of the intervals", sentences, 3);
}

/// One parameter of a model: value and intervals of its runs, above each other.
Chart across_runs(const std::string& name, const std::vector<const Order::Run*>& runs) {
  Chart chart;
  chart.kind = "rows";
  chart.id = "parameter_" + name;
  chart.title = name;
  std::array<RowSeries, kinds.size()> series;
  std::array<bool, kinds.size()> used{true};
  for (std::size_t k = 0; k < kinds.size(); ++k) series[k] = {kinds[k].name, static_cast<int>(k), {}};
  for (const Order::Run* run : runs) {
    const Json& estimate = entry(member(member(*run->run, key::best), key::parameters), name);
    chart.x.title = text::titled(name, word(estimate, key::unit));
    // A dot alone would look precise.
    bool open = member(member(*run->run, key::best), key::covariance).is_object() &&
                !member(estimate, key::at_bound).is_string();
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const auto [low, high] = interval(estimate, kinds[k].key);
      const bool known = std::isfinite(low) || std::isfinite(high);
      used[k] = used[k] || known;
      open = open && !known;
      series[k].rows.push_back({k == 0 || std::isfinite(low) ? number(estimate, key::value) : NAN, low, high, ""});
    }
    chart.labels.push_back(run->label + (open ? ", not fixed" : ""));
  }
  for (std::size_t k = 0; k < kinds.size(); ++k)
    if (used[k]) chart.rows.push_back(std::move(series[k]));
  chart.about = fmt::format("Value and 95 % interval of {} in each run", name);
  return chart;
}

void add_profiles(Page& page, const Folder& folder, const Order& order) {
  const auto files = folder.tables("profile_");
  if (files.empty()) return;
  page.heading("Profiles");
  page.paragraph(
      "How much worse the fit gets when one parameter is held away from its best value; below the line lies "
      "the 95 % interval.");
  page.begin_pair();
  for (const std::string& file : files) {
    const auto table = folder.table(file);
    const auto value = table ? table->find("value") : std::nullopt;
    if (!value) continue;
    Chart chart;
    const std::string name = file.substr(8, file.size() - 12);
    chart.id = "profile_" + name;
    chart.title = "Profile of " + name;
    chart.about = "Loss of likelihood over the value of " + name;
    chart.x.title = text::titled(name, table->columns()[*value].unit.value_or(""));
    chart.y = {"2 Δ ln L", false, {0}, {}};
    chart.files = {file};
    double threshold = NAN;
    for (const auto& [run, rows] : table->groups("run")) {
      Series series{run, "both", static_cast<int>(order.place(run)), {}, {}, {}, {}};
      for (const std::size_t row : rows) {
        series.x.push_back(table->number(row, *value));
        series.y.push_back(table->number(row, "delta"));
        threshold = table->number(row, "threshold");
      }
      chart.series.push_back(std::move(series));
    }
    if (std::isfinite(threshold)) {
      chart.rule(threshold, "95 %");
      chart.y.include.push_back(1.15 * threshold);  // room for the word
    }
    page.chart(chart, folder.address());
  }
  page.end_pair();
}

/// The draws of the bootstrap, two parameters at a time.
void add_pairs(Page& page, const Folder& folder, const Order& order) {
  const auto table = folder.table("bootstrap.csv");
  const auto first = table ? table->find("objective") : std::nullopt;
  if (!first) return;
  page.heading("Parameter pairs of the bootstrap");
  page.begin_pair();
  std::size_t made = 0;
  for (std::size_t a = *first + 1; a < table->columns().size(); ++a)
    for (std::size_t b = a + 1; b < table->columns().size() && made < 10; ++b) {
      Chart chart;
      chart.title = table->columns()[a].name + " and " + table->columns()[b].name;
      chart.id = "pair_" + table->columns()[a].name + '_' + table->columns()[b].name;
      chart.about = "Every draw of the bootstrap, one symbol a draw";
      chart.x.title = table->title(a);
      chart.y.title = table->title(b);
      chart.files = {"bootstrap.csv"};
      for (const auto& [run, rows] : table->groups("run")) {
        Series series{run, "points", static_cast<int>(order.place(run)), {}, {}, {}, {}};
        const auto chosen = evenly(rows.size(), 400);
        for (const std::size_t k : chosen)
          if (const double x = table->number(rows[k], a), y = table->number(rows[k], b); std::isfinite(x + y)) {
            series.x.push_back(x);
            series.y.push_back(y);
          }
        if (rows.size() > chosen.size())
          chart.note = fmt::format("{} of {} draws are shown.", chosen.size(), rows.size());
        if (!series.x.empty()) chart.series.push_back(std::move(series));
      }
      if (chart.series.empty()) continue;
      page.chart(chart, folder.address());
      ++made;
    }
  page.end_pair();
  if (made == 10) page.paragraph("The first ten pairs; bootstrap.csv has every parameter.", "muted");
}

}  // namespace

void add_parameters(Page& page, const Folder& folder, const Order& order) {
  page.section("Parameters");
  const auto sentences = words(list(folder.result(), key::identifiability));
  if (!sentences.empty()) page.box("", "What the data fix, and what they do not", sentences, 4);
  std::vector<std::string> models;
  for (const auto& run : order.runs())
    if (std::find(models.begin(), models.end(), run.model) == models.end()) models.push_back(run.model);
  for (const std::string& model : models) {
    std::vector<const Order::Run*> runs;
    for (const auto& run : order.runs())
      if (run.model == model && member(*run.run, key::best).is_object()) runs.push_back(&run);
    if (runs.empty()) continue;
    add_table(page, *runs.front());
    if (runs.size() < 2) continue;
    if (runs.size() > most_runs) {
      page.paragraph(
          fmt::format("The best {} of the {} runs of {}; result.json has all.", most_runs, runs.size(), model),
          "muted");
      runs.resize(most_runs);
    }
    page.begin_pair();
    const Json parameters = member(member(*runs.front()->run, key::best), key::parameters);
    for (const auto& [name, estimate] : parameters.items()) {
      Chart chart = across_runs(name, runs);
      chart.id += '_' + model;
      chart.files = {"ranking.csv", "statistics.csv"};
      page.chart(chart, folder.address());
    }
    page.end_pair();
  }
  add_spectra(page, folder, order);
  add_profiles(page, folder, order);
  add_pairs(page, folder, order);
  add_posterior(page, folder, order);
}

}  // namespace tunica::report
