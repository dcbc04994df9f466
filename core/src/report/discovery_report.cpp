// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/sections.hpp"
#include "text/lists.hpp"

namespace tunica::report {

namespace {

/// "I2", "fibre diagonal"
std::string invariant_words(const Json& term) {
  const std::string family = word(term, key::family);
  return word(term, key::invariant) + (family.empty() ? "" : " " + family);
}

/// "I2, linear"
std::string form_words(const Json& term) {
  const std::string law = word(term, key::law);
  return fmt::format("{}, {}", invariant_words(term), law == "spline" ? "a curve" : law);
}

/// "I1, gent + I2, linear", or the mechanism.
std::string explanation_words(const Json& alternative) {
  for (const results::Key place : {key::rig, key::memory})
    if (const Json& ids = list(alternative, place); !ids.empty())
      return fmt::format("{} ({})", fmt::join(words(ids), " + "), place.text);
  std::vector<std::string> forms;
  for (const Json& term : list(alternative, key::terms)) forms.push_back(form_words(term));
  return fmt::format("{}", fmt::join(forms, " + "));
}

/// x as the page writes it: I1 − 3, I4 − 1.
std::string abscissa_of(const Json& term) {
  const std::string invariant = word(term, key::invariant);
  if (invariant == "fibre") return "I4 − 1 of the " + word(term, key::family) + " family";
  if (invariant == "stretches") return "principal stretch";
  if (invariant == "J") return "J − 1";
  if (invariant.find('*') != std::string::npos) return "product of the invariants";
  if (invariant.ends_with("bar")) return invariant.substr(0, invariant.size() - 3) + " − 3 at constant volume";
  return invariant + " − 3";
}

std::vector<double> numbers(const Json& values) {
  std::vector<double> all;
  for (const Json& one : values) all.push_back(one.is_number() ? one.get<double>() : NAN);
  return all;
}

/// One line a specimen.
void add_curves_of_specimens(Chart& chart, const Json& curves) {
  chart.about = "The derivative of the term over its invariant in each specimen, over the range that its data reach";
  chart.note = "A line a specimen. Beyond its end the data say nothing.";
  for (const Json& curve : curves) {
    Series line{"a specimen", "line", 0, numbers(list(curve, key::x)), numbers(list(curve, key::slope))};
    line.faint = true;
    line.label = word(curve, key::specimen);
    if (!line.x.empty()) chart.series.push_back(std::move(line));
  }
}

Chart curve_chart(const Json& term) {
  const Json& curve = member(term, key::curve);
  const std::vector<double> x = numbers(list(curve, key::x));
  Chart chart;
  chart.id = "term_" + word(term, key::name);
  chart.title = form_words(term);
  chart.x.title = abscissa_of(term);
  chart.y.title = "dψ/dx [kPa]";
  if (const Json& curves = list(term, key::curves); !curves.empty()) {
    add_curves_of_specimens(chart, curves);
    return chart;
  }
  chart.about = "The derivative of the term over its invariant, with a 95 % band, over the range that the data reach";
  chart.note = "95 % band. Beyond this range the data say nothing.";
  Series band{"95 % band",
              "band",
              0,
              x,
              numbers(list(curve, key::slope)),
              numbers(list(curve, key::low)),
              numbers(list(curve, key::high))};
  Series line{"dψ/dx", "line", 0, x, numbers(list(curve, key::slope))};
  if (!x.empty()) chart.series = {std::move(band), std::move(line)};
  return chart;
}

std::vector<std::string> parameter_words(const Json& term) {
  std::vector<std::string> all;
  for (const auto& [name, value] : member(term, key::parameters).items())
    all.push_back(fmt::format("{} = {} ({} … {})", name, amount(number(value, key::value), word(value, key::unit)),
                              figure(number(value, key::low)), figure(number(value, key::high))));
  return all;
}

void add_alternatives(Page& page, const Json& discovery) {
  const Json& all = list(discovery, key::ambiguity_set);
  if (all.size() < 2) return;
  std::vector<std::vector<Cell>> rows;
  std::vector<bool> first;
  for (const Json& one : all) {
    rows.push_back({{explanation_words(one)},
                    {share(number(one, key::probability)), true},
                    {figure(number(one, key::chi2)), true}});
    first.push_back(first.empty());
  }
  page.heading("Forms that these data hardly tell apart");
  page.html(table_html({"form", "probability", "sum of squares"}, rows, first));
}

void add_held_out(Page& page, const Json& discovery) {
  std::vector<std::vector<Cell>> rows;
  for (const Json& block : list(discovery, key::held_out))
    rows.push_back({{word(block, key::block)},
                    {figure(number(block, key::before)), true},
                    {figure(number(block, key::after)), true},
                    {word(block, key::verdict) == "not_predicted" ? "not predicted" : word(block, key::verdict), false,
                     word(block, key::verdict) == "not_predicted"}});
  if (rows.empty()) return;
  page.heading("Rows that were left out, and how well they are predicted");
  page.html(table_html({"left out", "error before [σ]", "error with the terms [σ]", ""}, rows));
}

/// Of a cohort: what each specimen says, and which could not take part.
void add_specimens(Page& page, const Json& discovery) {
  const Json& specimens = list(discovery, key::specimens);
  if (specimens.empty()) return;
  std::vector<std::vector<Cell>> rows;
  for (const Json& one : specimens) {
    const bool noise = number(one, key::p_after) > 0.01;
    const Json& needed = member(one, key::needed);
    rows.push_back({{word(one, key::specimen)},
                    {figure(number(one, key::rows)), true},
                    {figure(number(one, key::chi2_before)), true},
                    {figure(number(one, key::chi2_after)), true},
                    {figure(number(one, key::gain)), true},
                    {noise ? "noise" : "not noise", false, !noise},
                    {needed.is_boolean() && needed.get<bool>() ? "other invariants" : "the same invariants"}});
  }
  page.section("Specimens");
  page.html(table_html({"specimen", "values", "sum of squares before", "after", "gain [ln evidence]", "what is left",
                        "without it the others choose"},
                       rows));
  std::vector<std::pair<std::string, std::string>> out;
  for (const Json& one : list(discovery, key::left_out))
    out.emplace_back(word(one, key::specimen), word(one, key::reason));
  if (out.empty()) return;
  page.heading("Specimens that could not take part");
  page.words(out);
}

}  // namespace

void add_terms(Page& page, const Folder& folder) {
  const Json& discovery = member(folder.result(), key::discovery);
  // If one cause leads, the terms of an earlier search are not part of the result.
  if (!discovery.is_object() || word(member(folder.result(), key::diagnosis), key::verdict) == "leading") return;
  const Json& terms = list(discovery, key::terms);
  if (terms.empty()) return;
  page.section("Terms of the energy");
  std::vector<std::pair<std::string, std::vector<std::string>>> lines;
  for (const Json& term : terms) {
    std::vector<std::string> of_term = parameter_words(term);
    const double seen = number(term, key::seen);
    if (std::isfinite(seen))
      of_term.push_back(
          fmt::format("shows in {} of {} specimens", figure(seen), list(discovery, key::specimens).size()));
    of_term.push_back(fmt::format("probability {}, of the invariant {}", share(number(term, key::probability)),
                                  share(number(term, key::invariant_probability))));
    lines.emplace_back(form_words(term), std::move(of_term));
  }
  page.word_lists(lines, 6);
  page.begin_pair();
  for (const Json& term : terms) page.chart(curve_chart(term), folder.address());
  page.end_pair();
  add_alternatives(page, discovery);
  add_held_out(page, discovery);
}

void add_discovery(Page& page, const Folder& folder) {
  const Json& discovery = member(folder.result(), key::discovery);
  std::vector<std::string> reasons;
  for (const Json& reason : list(discovery, key::reasons)) reasons.push_back(word(reason, key::text));
  std::string verdict = word(discovery, key::verdict);
  std::replace(verdict.begin(), verdict.end(), '_', ' ');
  page.section("Verdict");
  page.paragraph(fmt::format("{}: {}", text::capitalised(verdict), fmt::join(reasons, " ")), "verdict");
  add_warnings(page, folder);
  std::vector<std::pair<std::string, std::string>> pairs;
  const double before = number(discovery, key::chi2_before), after = number(discovery, key::chi2_after);
  pairs.emplace_back(
      "Base", word(discovery, key::base).empty() ? "none: the terms are the whole energy" : word(discovery, key::base));
  if (std::isfinite(before))
    pairs.emplace_back("Sum of squares over the noise",
                       fmt::format("{} before, {} with the terms, over {} values", figure(before), figure(after),
                                   figure(number(discovery, key::rows))));
  if (const double p = number(discovery, key::p_before); std::isfinite(p))
    pairs.emplace_back("How sure that something is missing", "noise alone would look like this with " + chance(p));
  pairs.emplace_back("What is left",
                     "noise alone would leave this much with " + chance(number(discovery, key::p_after)));
  if (const Json& name = member(discovery, key::name_of_the_catalogue); name.is_object())
    pairs.emplace_back("Name of the catalogue", fmt::format("{} changes the energy too and leaves {}",
                                                            word(name, key::id), figure(number(name, key::chi2))));
  if (const std::string next = word(member(discovery, key::next_experiment), key::description); !next.empty())
    pairs.emplace_back("What to measure next", next);
  page.words(pairs);
  add_terms(page, folder);
  add_specimens(page, discovery);
  if (folder.has("residuals.csv")) add_misfit(page, folder);
  add_provenance(page, folder);
}

}  // namespace tunica::report
