// SPDX-License-Identifier: Apache-2.0
// The rows of the table of the blind benchmark. What a row counts, and what it does not, stands beside it.
#include <algorithm>
#include <array>
#include <iterator>

#include <fmt/format.h>

#include "rows.hpp"

namespace blind::score {
namespace {

void false_alarms(const Cases& cases, std::vector<Figure>& table) {
  std::map<std::string, Share> by_noise;
  Share plain;
  for (const Case& one : cases) {
    if (one.truth.set != "nulls") continue;
    const bool alarm = judged(one).detected();
    by_noise[one.truth.noise].add(alarm);
    if (ordinary(one.truth.noise)) plain.add(alarm);
  }
  table.push_back(share("false alarms at α = 0.05", plain, Bar{0.035, 0.065}, Bar{0.04, 0.06}, "stated noise"));
  table.push_back(
      share("false alarms, ρ = 0.3, covariance from replicates", by_noise["ar1"], at_most(0.08), at_most(0.06)));
  for (const auto& [noise, alarms] : by_noise)
    if (noise != "ar1")
      table.push_back(share("false alarms, noise " + noise, alarms, {}, {},
                            noise == "outliers" ? "naming the gross errors that are there is none" : ""));
}

void detection(const Cases& cases, std::vector<Figure>& table) {
  const auto row = [&](const std::string& name, double from, double to, Bar pass, Bar stretch) {
    Share mine, oracle;
    for (const Case& one : cases) {
      if (!single(one) || one.truth.asked < from || one.truth.asked > to) continue;
      mine.add(judged(one).detected());
      if (one.oracle) oracle.add(one.oracle->detected);
    }
    // A ratio of two shares of the same cases.
    const double scale = oracle.hits > 0 ? oracle.value() : 0;
    Figure figure = share("detected, as a share of the oracle's, " + name, mine, pass, stretch,
                          mine.total == 0 ? "" : fmt::format("detected {:.3f}, oracle {:.3f}", mine.value(), scale));
    if (scale > 0 && oracle.total == mine.total) {
      figure.value /= scale;
      figure.low /= scale;
      figure.high /= scale;
    } else {
      figure.cases = 0;
    }
    table.push_back(figure);
  };
  row("Λ 10", 10, 10, at_least(0.90), at_least(0.95));
  row("Λ ≥ 25", 25, infinite, at_least(0.95), at_least(0.98));
}

void naming(const Cases& cases, const LookAlikes& look_alikes, std::vector<Figure>& table) {
  constexpr std::array<std::array<double, 3>, 3> rows{{{25, 0.80, 0.87}, {60, 0.93, 0.97}, {150, 0.97, 0.99}}};
  for (const auto& [lambda, pass, stretch] : rows) {
    Share strict, counted, oracle, whatever;
    for (const Case& one : cases) {
      if (!single(one) || one.truth.asked != lambda) continue;
      if (one.oracle && one.oracle->detected) oracle.add(oracle_named(*one.oracle, hidden(one), look_alikes));
      const Verdict verdict = judged(one);
      if (!verdict.detected()) continue;
      strict.add(named_first(verdict, hidden(one)));
      whatever.add(!verdict.causes.empty() && verdict.causes.front().id == hidden(one));
      counted.add(named_with_look_alike(verdict, hidden(one), look_alikes));
    }
    std::string remark = strict.total == 0 ? ""
                                           : fmt::format("without look-alikes {:.3f}, \"unknown\" disregarded {:.3f}",
                                                         strict.value(), whatever.value());
    if (oracle.total > 0) remark += fmt::format(", oracle {:.3f}", oracle.value());
    table.push_back(share(fmt::format("right name first given detection, Λ {:g}", lambda), counted, at_least(pass),
                          at_least(stretch), remark));
  }
}

void sets(const Cases& cases, std::vector<Figure>& table) {
  Share holds, invented;
  std::map<double, Share> wrong;
  Share wrong_from_60;
  std::size_t silent = 0;
  double size = 0;
  std::size_t sized = 0;
  for (const Case& one : cases) {
    if (!single(one) || one.truth.asked < 10) continue;
    const Verdict verdict = judged(one);
    if (!verdict.detected()) continue;
    const auto set = claimed(verdict);
    const bool claims = verdict.verdict != "unknown" && !set.empty();
    const bool inside = std::find(set.begin(), set.end(), hidden(one)) != set.end();
    if (claims)
      holds.add(inside);
    else
      ++silent;
    invented.add(together(verdict) > 1);
    wrong[one.truth.asked].add(claims && !inside);
    if (one.truth.asked >= 60) wrong_from_60.add(claims && !inside);
    if (claims && one.truth.asked == 25) {
      size += static_cast<double>(set.size());
      ++sized;
    }
  }
  table.push_back(share("ambiguity set holds the truth (Λ ≥ 10)", holds, at_least(0.95), at_least(0.97),
                        fmt::format("{} more end as \"unknown\", without a set", silent)));
  table.push_back(number("mean size of the set at Λ 25", sized, sized == 0 ? 0 : size / static_cast<double>(sized), {},
                         at_most(1.6)));
  table.push_back(share("more than one cause named where one is hidden", invented, {}, {}, "of those detected"));
  table.push_back(share("wrong (truth excluded), Λ 10", wrong[10], at_most(0.05), at_most(0.03), "of those detected"));
  table.push_back(
      share("wrong (truth excluded), Λ ≥ 60", wrong_from_60, at_most(0.01), at_most(0.005), "of those detected"));
}

Cases plain_ones(const Cases& all) {
  Cases kept;
  std::copy_if(all.begin(), all.end(), std::back_inserter(kept), [](const Case& one) { return one.truth.plain(); });
  return kept;
}

}  // namespace

std::vector<Figure> figures(const Cases& all, const LookAlikes& look_alikes) {
  const Cases cases = plain_ones(all);
  std::vector<Figure> table;
  false_alarms(cases, table);
  detection(cases, table);
  naming(cases, look_alikes, table);
  sets(cases, table);
  pair_rows(cases, look_alikes, table);
  outside_rows(cases, table);
  amplitude_rows(cases, table);
  probability_rows(cases, table);
  return table;
}

std::vector<std::string> unnamed(const std::vector<EffectRow>& rows) {
  std::vector<std::string> words;
  for (const EffectRow& row : rows) {
    const std::size_t named = row.named_or_look_alike.hits, cases = row.detected.total;
    if (row.lambda == 60 && 2 * named < cases)
      words.push_back(fmt::format("{} is named in {} of {} cases at Λ 60", row.id, named, cases));
  }
  return words;
}

std::vector<EffectRow> effects(const Cases& every, const LookAlikes& look_alikes) {
  const Cases cases = plain_ones(every);
  std::map<std::pair<std::string, double>, EffectRow> rows;
  std::map<std::pair<std::string, double>, std::map<std::string, std::size_t>> instead;
  for (const Case& one : cases) {
    if (one.truth.set != "singles") continue;
    const std::pair key{hidden(one), one.truth.asked};
    EffectRow& row = rows[key];
    row.id = key.first;
    row.lambda = key.second;
    if (!one.truth.effects.front().reached) {
      ++row.unreached;
      continue;
    }
    const Verdict verdict = judged(one);
    row.detected.add(verdict.detected());
    if (!verdict.detected()) continue;
    row.named.add(named_first(verdict, row.id));
    row.named_or_look_alike.add(named_with_look_alike(verdict, row.id, look_alikes));
    row.mean_set += static_cast<double>(claimed(verdict).size());
    if (verdict.verdict == "unknown" || verdict.causes.empty())
      ++instead[key]["unknown"];
    else if (verdict.causes.front().id != row.id)
      ++instead[key][verdict.causes.front().id];
  }
  std::vector<EffectRow> all;
  for (auto& [key, row] : rows) {
    if (row.detected.hits > 0) row.mean_set /= static_cast<double>(row.detected.hits);
    row.confused_with.assign(instead[key].begin(), instead[key].end());
    std::stable_sort(row.confused_with.begin(), row.confused_with.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    all.push_back(std::move(row));
  }
  return all;
}

}  // namespace blind::score
