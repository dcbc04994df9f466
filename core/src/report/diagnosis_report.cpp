// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "report/diagnosis_pieces.hpp"
#include "text/lists.hpp"
#include "text/units.hpp"

namespace tunica::report {

namespace {

/// Causes are a property of the material or of the rig. Results of older programs do not say so: one group, "".
struct Group {
  const char *code, *heading, *candidates;
};
constexpr std::array<Group, 3> all_groups{
    {{"material", "In the material", "What each candidate in the material explains"},
     {"rig", "In the rig", "What each candidate in the rig explains"},
     {"", "Others", "What each candidate explains"}}};

struct Candidate {
  std::string label, id, group;
  double score, p, gain = NAN;
  [[nodiscard]] double most() const { return std::isfinite(gain) ? std::max(score, gain) : score; }
};

/// All candidates, the one that explains most first.
std::vector<Candidate> candidates_of(const Json& diagnosis) {
  std::vector<Candidate> candidates;
  for (const Json& one : list(diagnosis, key::scores))
    candidates.push_back({word(one, key::id) + place_words(member(one, key::target)), word(one, key::id),
                          word(one, key::group), number(one, key::score), number(one, key::p_value)});
  // A cause with a nonlinear trace shows only after a fit, perhaps in another place.
  for (const Json& one : list(diagnosis, key::ranking))
    for (Candidate& candidate : candidates)
      if (candidate.id == word(one, key::id) && std::isfinite(number(one, key::gain))) {
        candidate.gain = std::max(number(one, key::gain), 0.0);
        candidate.label = candidate.id + place_words(member(one, key::target));
      }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.most() > b.most(); });
  return candidates;
}

/// Scores of the candidates of a group, and the gains of those that were fitted. All groups have the same axis.
Chart ranking_chart(const std::vector<Candidate>& candidates, const Group& group) {
  Chart chart;
  chart.kind = "rows";
  chart.bars = true;
  chart.id = *group.code == 0 ? "scores" : std::string("scores_") + group.code;
  chart.title = group.candidates;
  chart.about = "How much each candidate lowers the sum of squares, the largest first";
  chart.note =
      "Gain: by fitting the cause. Score: what it promises to first order; only the promising ones are fitted.";
  chart.x = {"fall of the sum of squares over the noise", false, {0}, {}};
  chart.files = {"result.json"};
  RowSeries gains{"gain", 0, {}}, scores{"score", 1, {}};
  for (const Candidate& one : candidates) {
    if (std::isfinite(one.most())) chart.x.include.push_back(one.most());
    if (one.group != group.code) continue;
    chart.labels.push_back(one.label);
    gains.rows.push_back({one.gain, std::isfinite(one.gain) ? 0 : NAN, one.gain,
                          std::isfinite(one.gain) ? "gain " + figure(one.gain) : "not fitted"});
    scores.rows.push_back({one.score, NAN, NAN, fmt::format("score {}, {}", figure(one.score), chance(one.p))});
  }
  if (!chart.labels.empty()) chart.rows = {std::move(gains), std::move(scores)};
  return chart;
}

/// A fall of the sum of squares, which rounding may leave a hair below nothing.
std::string fall(double value) { return std::abs(value) < 5e-3 ? "0" : figure(value); }

/// The candidates of a group by their probability. A heading stands above where there are several groups.
void add_ranking_table(Page& page, const Json& diagnosis, const Group& group, bool headed) {
  std::vector<std::vector<Cell>> rows;
  std::vector<bool> first;
  const auto named = words(list(diagnosis, key::ambiguity_set));
  const bool ranked = !list(diagnosis, key::ranking).empty();
  for (const Json& one : list(diagnosis, ranked ? key::ranking : key::causes)) {
    if (word(one, key::group) != group.code) continue;
    rows.push_back({{word(one, key::id) + place_words(member(one, key::target))},
                    {share(number(one, key::probability)), true},
                    {fall(number(one, key::score)), true},
                    {fall(number(one, key::gain)), true}});
    first.push_back(std::find(named.begin(), named.end(), word(one, key::id)) != named.end());
  }
  if (rows.empty()) return;
  if (headed) page.heading(group.heading);
  constexpr std::size_t shown = 8;
  const std::vector<std::string> head{"cause", "probability as the only cause", "score", "gain in squares"};
  const auto cut = static_cast<std::ptrdiff_t>(std::min(shown, rows.size()));
  page.html(table_html(head, {rows.begin(), rows.begin() + cut}, first));
  if (rows.size() <= shown) return;
  page.html(fmt::format("<details><summary>{} more candidates</summary>", rows.size() - shown));
  page.html(table_html(head, {rows.begin() + cut, rows.end()}, {first.begin() + cut, first.end()}));
  page.html("</details>\n");
}

/// "+4.5 %", and "× 13.6" where a per cent no longer says much.
std::string change_words(double before, double after) {
  if (!std::isfinite(before) || !std::isfinite(after) || before == 0) return "–";
  const double ratio = after / before;
  return ratio > 3 ? fmt::format("× {:.3g}", ratio)
                   : fmt::format("{:+.3g} %", 100 * (after - before) / std::abs(before));
}

/// Causes that were fitted together shift the parameters together: one row for all of them.
void add_shifts(Page& page, const Json& diagnosis) {
  struct Shift {
    std::vector<std::string> causes;
    std::vector<Cell> cells;
  };
  std::vector<Shift> shifts;
  for (const Json& cause : list(diagnosis, key::causes))
    for (const Json& shift : list(cause, key::parameter_shifts)) {
      const double before = number(shift, key::without), after = number(shift, key::with);
      std::vector<Cell> cells{{text::titled(word(shift, key::parameter), word(shift, key::unit))},
                              {figure(before), true},
                              {figure(after), true},
                              {change_words(before, after), true}};
      const auto same = std::find_if(shifts.begin(), shifts.end(), [&](const Shift& one) {
        return std::equal(one.cells.begin(), one.cells.end(), cells.begin(),
                          [](const Cell& a, const Cell& b) { return a.text == b.text; });
      });
      if (same == shifts.end())
        shifts.push_back({{word(cause, key::id)}, std::move(cells)});
      else
        same->causes.push_back(word(cause, key::id));
    }
  if (shifts.empty()) return;
  std::vector<std::vector<Cell>> rows;
  for (const Shift& one : shifts) {
    auto& row = rows.emplace_back(std::vector<Cell>{{text::joined(one.causes)}});
    row.insert(row.end(), one.cells.begin(), one.cells.end());
  }
  page.heading("How the parameters shift");
  page.html(table_html({"cause", "parameter", "without", "with", "change"}, rows));
}

Chart gain_chart(const Json& gain) {
  Chart chart;
  chart.kind = "rows";
  chart.id = "gain_held_out";
  chart.title = "Gain on blocks that were held out";
  chart.about = "Root mean square of the residuals over the noise on each held-out block, without and with the cause";
  chart.note = "Fits that have not seen a block predict it. 1 is what noise alone leaves.";
  chart.x = {"root mean square of residual / noise", false, {1}, {}};
  chart.rule(1, "noise", 'x');
  chart.files = {"result.json"};
  RowSeries before{"model as given", 1, {}}, after{"with the cause", 0, {}};
  for (const Json& block : list(gain, key::held_out)) {
    chart.labels.push_back(word(block, key::block));
    const double rows = number(block, key::rows);
    const std::string much = std::isfinite(rows) ? fmt::format(" ({:.0f} rows)", rows) : "";
    before.rows.push_back({number(block, key::before), NAN, NAN,
                           fmt::format("as given: {}{}", figure(number(block, key::before)), much)});
    after.rows.push_back({number(block, key::after), NAN, NAN,
                          fmt::format("with the cause: {}, {}", figure(number(block, key::after)),
                                      chance(number(block, key::p_value)))});
  }
  chart.rows = {std::move(before), std::move(after)};
  return chart;
}

void add_noise(Page& page, const Json& diagnosis) {
  std::vector<std::vector<Cell>> rows;
  for (const Json& one : list(diagnosis, key::noise)) {
    const std::string source = word(one, key::source);
    const double relative = number(one, key::relative);
    rows.push_back({{word(one, key::test)},
                    {word(one, key::channel)},
                    {source == "stated"         ? "stated in the experiment"
                     : source == "replicates"   ? "from replicates"
                     : source == "differences"  ? "estimated from differences of neighbouring rows"
                     : source == "encompassing" ? "estimated from what no candidate explains"
                                                : source},
                    {amount(number(one, key::absolute), word(one, key::unit)), true},
                    {std::isfinite(relative) ? fmt::format("{:.3g} %", 100 * relative) : "–", true},
                    {figure(number(one, key::correlation)), true}});
  }
  if (rows.empty()) return;
  page.section("Noise, and how it is known");
  page.html(
      table_html({"test", "channel", "how it is known", "absolute", "relative", "correlation of neighbours"}, rows));
}

}  // namespace

/// Mistakes of the file that are as likely as the causes, or likelier: each with what to write into the file.
static void add_file(Page& page, const Json& diagnosis) {
  const Json& file = member(diagnosis, key::file);
  const std::string standing = word(file, key::standing);
  if (standing != "near" && standing != "ahead") return;
  std::vector<std::vector<Cell>> rows;
  for (const Json& cause : list(file, key::causes))
    if (member(cause, key::near) == true)
      rows.push_back({{word(cause, key::sentence)},
                      {word(cause, key::mend)},
                      {figure(number(cause, key::squares)), true},
                      {chance(number(cause, key::p_after)), true}});
  page.section("What the file may say that is not so");
  page.paragraph(standing == "ahead" ? "Mended, the base model describes the data. No other cause comes close."
                                     : "Mended, the base model describes the data. Ask this before any other cause.");
  page.html(table_html({"it may be that", "to try it, write", "sum of squares then", "p of what is left"}, rows));
}

void add_candidates(Page& page, const Folder& folder) {
  const Json& diagnosis = member(folder.result(), key::diagnosis);
  add_file(page, diagnosis);
  const std::vector<Candidate> candidates = candidates_of(diagnosis);
  if (candidates.empty() && list(diagnosis, key::causes).empty()) return;
  page.section("Candidate causes");
  const bool grouped =
      std::any_of(candidates.begin(), candidates.end(), [](const auto& one) { return !one.group.empty(); });
  if (grouped)
    page.paragraph("Causes in the material and causes in the rig are ranked together, by the same evidence.");
  for (const Group& group : all_groups) add_ranking_table(page, diagnosis, group, grouped);
  if (std::vector<std::string> rivals = words(list(diagnosis, key::explanations)); rivals.size() > 1) {
    const std::string first = rivals.front();
    rivals.erase(rivals.begin());
    page.box("", "What explains the misfit about as well as " + first, rivals);
  }
  for (const Group& group : all_groups) page.chart(ranking_chart(candidates, group), folder.address());
}

void add_extension(Page& page, const Folder& folder) {
  const Json& diagnosis = member(folder.result(), key::diagnosis);
  const Json& gain = member(diagnosis, key::gain);
  if (gain.is_object()) {
    page.section("Gain");
    const Json& wrong = member(gain, key::best_wrong);
    page.words({{"In these data",
                 fmt::format("the sum of squares falls by {} (from {} to {})", figure(number(gain, key::in_sample)),
                             figure(number(gain, key::before)), figure(number(gain, key::after)))},
                {"Where nothing is wrong",
                 std::isfinite(number(gain, key::expected_under_nothing))
                     ? "a fall of " + figure(number(gain, key::expected_under_nothing)) + " would be expected"
                     : ""},
                {"Best of the other causes", wrong.is_object() ? fmt::format("{}: a fall of {}", word(wrong, key::id),
                                                                             figure(number(wrong, key::in_sample)))
                                                               : ""}});
    page.chart(gain_chart(gain), folder.address());
  }
  add_shifts(page, diagnosis);
  const Json& stable = member(member(diagnosis, key::admissibility), key::stable);
  if (stable.is_boolean()) {
    const Json& admissibility = member(diagnosis, key::admissibility);
    const std::string where = word(admissibility, key::where), remedy = word(admissibility, key::remedy);
    page.section("Admissibility");
    page.box(stable == true ? "good" : "bad",
             stable == true ? "The fitted material is stable where it was measured."
                            : "The fitted material loses stability where it was measured.",
             [&] {
               std::vector<std::string> items;
               if (!where.empty()) items.push_back(where);
               if (!remedy.empty()) items.push_back(remedy);
               return items;
             }());
  }
}

void add_diagnosis(Page& page, const Folder& folder) {
  add_verdict(page, folder);
  add_budget(page, folder);
  add_misfit(page, folder);
  add_causes_alone(page, folder);
  add_terms(page, folder);
  add_candidates(page, folder);
  add_extension(page, folder);
  add_reach(page, folder);
  add_noise(page, member(folder.result(), key::diagnosis));
  add_provenance(page, folder);
}

}  // namespace tunica::report
