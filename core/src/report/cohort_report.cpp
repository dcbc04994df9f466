// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "report/sections.hpp"
#include "text/lists.hpp"
#include "text/units.hpp"

namespace tunica::report {

namespace {

const Json& populations(const Folder& folder) { return list(member(folder.result(), key::cohort), key::populations); }

std::pair<double, double> ends(const Json& one) {
  const Json& ci = list(one, key::ci95);
  const auto end = [&](std::size_t k) { return ci.size() > k && ci[k].is_number() ? ci[k].get<double>() : NAN; };
  return {end(0), end(1)};
}

std::string with_interval(const Json& one) {
  const auto [low, high] = ends(one);
  return fmt::format("{} ({} … {})", figure(number(one, key::value)), figure(low), figure(high));
}

/// A relative spread reads best as per cent.
std::string spread_text(const Json& spread) {
  const bool log = word(spread, key::scale) == "log";
  const auto [low, high] = ends(spread);
  const auto one = [log](double value) {
    if (!std::isfinite(value)) return std::string("any");
    return log ? fmt::format("{:.3g} %", 100 * value) : fmt::format("{:.3g}", value);
  };
  return fmt::format("{} ({} … {})", one(number(spread, key::sd)), one(low), one(high));
}

void add_of(const Json& analysis, std::vector<std::vector<Cell>>& rows) {
  for (const auto& [name, one] : member(analysis, key::of).items()) {
    if (!member(one, key::means).is_object()) continue;  // a reading of fewer than two specimens
    std::vector<Cell> row{{text::titled(name, word(one, key::unit))}};
    for (const auto& [group, mean] : member(one, key::means).items()) row.push_back({with_interval(mean), true});
    row.push_back({spread_text(member(one, key::spread)), true});
    rows.push_back(std::move(row));
  }
}

void add_typical(Page& page, const Json& population) {
  std::vector<std::string> head{""};
  const Json& of = member(member(population, key::parameters), key::of);
  if (of.empty()) return;
  for (const auto& [group, mean] : member(of.begin().value(), key::means).items()) head.push_back(group);
  head.emplace_back("spread of specimens");
  std::vector<std::vector<Cell>> rows;
  add_of(member(population, key::parameters), rows);
  add_of(member(population, key::readings), rows);
  page.heading("Typical specimen, with 95 % intervals");
  page.html(table_html(head, rows));
}

void add_effect_rows(const Json& analysis, std::vector<std::vector<Cell>>& rows) {
  for (const Json& one : list(analysis, key::effects)) {
    const auto [low, high] = ends(one);
    const bool ratio = word(one, key::kind) == "ratio";
    const double p = number(one, key::p_permutation);
    rows.push_back(
        {{fmt::format("{}: {} against {}", word(one, key::factor), word(one, key::level), word(one, key::reference))},
         {word(one, key::of)},
         {fmt::format("{}{}", ratio ? "× " : "", figure(number(one, key::value))), true},
         {fmt::format("{} … {}", figure(low), figure(high)), true},
         {share(p), true, p <= 0.05},
         {share(number(one, key::p_adjusted)), true},
         {share(number(one, key::p_holm)), true}});
  }
}

/// A forest: ratios to the reference with their intervals.
void add_forest(Page& page, const Folder& folder, const Json& population) {
  Chart chart;
  chart.kind = "rows";
  chart.id = "effects_" + word(population, key::run);
  chart.title = "Ratios to the reference, with 95 % intervals";
  chart.about = "Effect of every factor on every parameter and reading, as a ratio with its interval";
  chart.x = {"ratio to the reference", true, {1}, {}};
  chart.rule(1, "no effect", 'x');
  chart.files = {"population.csv"};
  RowSeries ratios{"ratio", 0, {}};
  for (const results::Key of : {key::parameters, key::readings})
    for (const Json& one : list(member(population, of), key::effects)) {
      if (word(one, key::kind) != "ratio") continue;
      const auto [low, high] = ends(one);
      chart.labels.push_back(fmt::format("{}: {}", word(one, key::level), word(one, key::of)));
      ratios.rows.push_back({number(one, key::value), low, high,
                             fmt::format("× {} ({} … {}), {} for all parameters", figure(number(one, key::value)),
                                         figure(low), figure(high), chance(number(one, key::p_adjusted)))});
    }
  if (chart.labels.empty()) return;
  chart.rows = {std::move(ratios)};
  page.chart(chart, folder.address());
}

void add_groups(Page& page, const Folder& folder, const Json& population) {
  std::vector<std::vector<Cell>> rows;
  add_effect_rows(member(population, key::parameters), rows);
  add_effect_rows(member(population, key::readings), rows);
  if (rows.empty()) return;
  page.heading("Effects of groups");
  add_forest(page, folder, population);
  page.html(table_html(
      {"groups", "of", "effect", "95 % interval", "p (permutation)", "for all parameters", "p (t, Holm)"}, rows));
  std::vector<std::string> notes;
  for (const Json& test : list(member(population, key::parameters), key::factors))
    notes.push_back(fmt::format("{}: {} arrangements of the labels{}; the smallest p they can give is {}",
                                word(test, key::factor), figure(number(test, key::permutations)),
                                member(test, key::all_arrangements) == true ? ", all there are" : "",
                                share(number(test, key::smallest_p))));
  page.box("", "How the labels were exchanged", notes);
}

std::string specimen_count(const Folder& folder) {
  std::size_t fitted = 0;
  const Json& specimens = list(member(folder.result(), key::cohort), key::specimens);
  for (const Json& one : specimens) fitted += word(one, key::outcome) == "fitted" ? 1 : 0;
  return fmt::format("{} of {} specimens were fitted.", fitted, specimens.size());
}

void add_population(Page& page, const Folder& folder, const Json& population) {
  page.section("Population: " + word(population, key::run));
  if (const std::string problem = word(population, key::problem); !problem.empty()) {
    page.box("bad", "No population", {problem});
    return;
  }
  if (member(population, key::converged) != true)
    page.box("bad", "The population did not settle", {"Specimens and population still moved after the last round."});
  page.words(
      {{"Specimens", fmt::format("{}{}", figure(number(population, key::specimens)),
                                 member(population, key::nested) == true
                                     ? fmt::format(" from {} animals", figure(number(population, key::animals)))
                                     : "")},
       {"Spreads", word(population, key::spread_structure) == "full" ? "with correlations" : "without correlations"},
       {"−2 ln L, AIC, BIC", fmt::format("{}, {}, {}", figure(number(population, key::neg2_log_likelihood)),
                                         figure(number(population, key::aic)), figure(number(population, key::bic)))}});
  add_typical(page, population);
  add_groups(page, folder, population);
  std::vector<std::string> outlying;
  for (const Json& one : list(population, key::outlying))
    outlying.push_back(fmt::format("{}, most in {} ({} for all specimens together)", word(one, key::specimen),
                                   word(one, key::farthest_in), chance(number(one, key::p))));
  if (!outlying.empty()) page.box("bad", "Unlike the others", outlying);
}

/// A comparison of the runs, if there are several.
void add_models(Page& page, const Folder& folder) {
  double least = std::numeric_limits<double>::infinity();
  for (const Json& one : populations(folder))
    if (const double aic = number(one, key::aic); aic < least) least = aic;
  if (populations(folder).size() < 2 || !std::isfinite(least)) return;
  std::vector<std::vector<Cell>> rows;
  for (const Json& one : populations(folder)) {
    const double aic = number(one, key::aic);
    rows.push_back({{word(one, key::run)},
                    {word(one, key::model)},
                    {figure(aic - least), true},
                    {figure(number(one, key::bic)), true},
                    {figure(number(one, key::neg2_log_likelihood)), true},
                    {word(one, key::problem)}});
  }
  page.section("Models over the whole cohort");
  page.paragraph("The smaller, the better: what the whole cohort says against a model, with its parameters counted.");
  page.html(sortable_html({"run", "model", "AIC above the least", "BIC", "−2 ln L", "why not"}, rows));
}

void add_specimen_table(Page& page, const Folder& folder) {
  const auto table = folder.table("specimens.csv");
  if (!table) return;
  page.section("Specimens");
  std::vector<std::string> head;
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < table->columns().size(); ++k)
    if (table->columns()[k].name != "folder") {
      columns.push_back(k);
      head.push_back(table->title(k));
    }
  std::vector<std::vector<Cell>> rows;
  for (std::size_t row = 0; row < table->rows(); ++row) {
    std::vector<Cell> cells;
    for (const std::size_t k : columns) {
      const double value = table->number(row, k);
      Cell cell{std::isfinite(value) ? figure(value) : table->text(row, k), std::isfinite(value)};
      if (k == 0) {
        const std::string page_of = "specimens/" + table->text(row, "folder") + "/report.html";
        if (folder.has(page_of)) cell.link = (folder.address().empty() ? "" : folder.address() + "/") + page_of;
      }
      cell.bad = table->columns()[k].name == "outcome" && table->text(row, k) != "fitted";
      cells.push_back(std::move(cell));
    }
    rows.push_back(std::move(cells));
  }
  page.html(sortable_html(head, rows));
}

}  // namespace

void add_cohort(Page& page, const Folder& folder) {
  page.section("Summary");
  add_warnings(page, folder);
  page.paragraph(specimen_count(folder));
  for (const Json& population : populations(folder)) add_population(page, folder, population);
  add_models(page, folder);
  add_cohort_diagnosis(page, folder);
  add_bands(page, folder);
  add_specimen_estimates(page, folder);
  add_specimen_table(page, folder);
  add_specimen_fits(page, folder);
  add_provenance(page, folder);
}

}  // namespace tunica::report
