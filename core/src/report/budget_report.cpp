// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "report/diagnosis_pieces.hpp"
#include "text/misfit_words.hpp"
#include "text/units.hpp"

namespace tunica::report {

namespace {

/// "+ viscoelasticity", "+ a second viscoelasticity".
std::string step_label(const Json& steps, std::size_t which) {
  const std::string id = word(steps[which], key::id);
  std::size_t before = 0;
  for (std::size_t k = 0; k < which; ++k) before += word(steps[k], key::id) == id ? 1 : 0;
  return fmt::format("+ {}{}{}",
                     before == 0   ? ""
                     : before == 1 ? "a second "
                                   : "one more ",
                     id, place_words(member(steps[which], key::target)));
}

/// The remaining misfit after each step, from the misfit of the base down to the tolerance.
Chart waterfall(const Json& budget) {
  Chart chart;
  chart.kind = "rows";
  chart.bars = true;
  chart.id = "budget";
  chart.title = "What takes how much of the misfit";
  chart.about = "Root mean square of the misfit beyond noise after each cause, as a share of the measured range";
  chart.note = "Each row has all causes above it. All parameters are fitted again at each step.";
  chart.x = {"misfit [% of the range]", false, {0}, {}};
  const double tolerance = 100 * number(budget, key::tolerance);
  chart.x.include.push_back(tolerance);
  chart.rule(tolerance, "tolerance", 'x');
  chart.files = {"result.json"};
  RowSeries left{"misfit", 0, {}};
  const auto add = [&](const std::string& label, const Json& of, const std::string& more) {
    const double rms = 100 * number(of, key::rms);
    chart.labels.push_back(label);
    chart.x.include.push_back(rms);
    left.rows.push_back({rms, 0, rms,
                         fmt::format("{} of the range, at most {}{}", text::percent(number(of, key::rms)),
                                     text::percent(number(of, key::rms_upper)), more)});
  };
  add("model as given", budget, "");
  const Json& steps = list(budget, key::steps);
  for (std::size_t k = 0; k < steps.size(); ++k)
    add(step_label(steps, k), steps[k],
        fmt::format("; {:.0f} % of the misfit taken, its own part {:.0f} %", 100 * number(steps[k], key::share),
                    100 * number(steps[k], key::shapley)));
  chart.rows = {std::move(left)};
  return chart;
}

void add_channels(Page& page, const Json& budget) {
  const Json &before = list(budget, key::channels), &after = list(budget, key::rest);
  if (before.size() != after.size() || before.empty()) return;
  std::vector<std::vector<Cell>> rows;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const double range = number(before[k], key::range);
    const std::string unit = word(before[k], key::unit);
    rows.push_back({{word(before[k], key::test)},
                    {word(before[k], key::channel)},
                    {amount(number(before[k], key::rms), unit), true},
                    {text::percent(number(before[k], key::rms) / range), true},
                    {amount(number(after[k], key::rms), unit), true},
                    {text::percent(number(after[k], key::rms) / range), true},
                    {text::percent(number(after[k], key::rms_upper) / range), true}});
  }
  page.html("<details><summary>By test and observable</summary>");
  page.html(
      table_html({"test", "observable", "misfit as given", "of the range", "left", "of the range", "at most"}, rows));
  page.html("</details>\n");
}

}  // namespace

void add_budget(Page& page, const Folder& folder) {
  const Json& budget = member(member(folder.result(), key::diagnosis), key::budget);
  if (!budget.is_object()) return;
  if (const Json& same = member(budget, key::same_model); same.is_object())
    page.box("", fmt::format("With its causes, the base is the model {} on these data.", word(same, key::type)),
             {fmt::format("Take \"type\": \"{}\" in the experiment file.", word(same, key::type))});
  if (list(budget, key::steps).empty()) return;
  page.section("Budget of the misfit");
  page.chart(waterfall(budget), folder.address());
  add_channels(page, budget);
}

void add_causes_alone(Page& page, const Folder& folder) {
  constexpr std::size_t shown = 8;
  const Json& budget = member(member(folder.result(), key::diagnosis), key::budget);
  std::vector<std::vector<Cell>> rows;
  for (const Json& one : list(budget, key::alone)) {
    if (rows.size() >= shown) break;
    const std::string belief = word(one, key::belief);
    rows.push_back({{word(one, key::id) + place_words(member(one, key::target))},
                    {word(one, key::group)},
                    {fmt::format("{:.0f} %", 100 * number(one, key::share)), true},
                    {text::percent(number(one, key::rms)), true},
                    {belief == "plausible" ? "yes"
                     : belief == "flagged" ? "somewhat beyond"
                                           : "no"}});
  }
  if (rows.empty()) return;
  page.section("Each cause alone");
  page.html(table_html({"cause", "in", "takes of the misfit", "leaves, of the range", "amplitude plausible"}, rows));
}

}  // namespace tunica::report
