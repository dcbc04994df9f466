// SPDX-License-Identifier: Apache-2.0
// The rows of the table of the blind benchmark. What a row counts, and what it does not, stands beside it.
#include "figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <set>

namespace blind::score {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Bar at_least(double low) { return {low, infinite}; }
Bar at_most(double high) { return {-infinite, high}; }

Figure share(std::string name, const Share& of, std::optional<Bar> pass, std::optional<Bar> stretch,
             std::string remark = {}) {
  return {std::move(name), of.total,         of.total == 0 ? 0 : of.value(), of.low(), of.high(), pass,
          stretch,         std::move(remark)};
}
Figure number(std::string name, std::size_t cases, double value, std::optional<Bar> pass, std::optional<Bar> stretch,
              std::string remark = {}) {
  return {std::move(name), cases, value, value, value, pass, stretch, std::move(remark)};
}

using Cases = std::vector<Case>;

/// Cases with one effect of the catalogue that its amplitude could be dialled for.
bool single(const Case& one) { return one.truth.set == "singles" && one.truth.effects.front().reached; }
const std::string& hidden(const Case& one) { return one.truth.effects.front().id; }
bool ordinary(const std::string& noise) { return noise != "ar1" && noise != "outliers"; }

/// Causes that are said to be at work together: rivals of what is named are no discoveries, and "unknown" names
/// nothing.
std::size_t together(const Verdict& verdict) {
  if (verdict.verdict == "unknown") return 0;
  return std::min(verdict.together.value_or(verdict.causes.size()), verdict.causes.size());
}

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
      figure.value /= scale, figure.low /= scale, figure.high /= scale;
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
    if (claims && one.truth.asked == 25) size += static_cast<double>(set.size()), ++sized;
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

std::multiset<std::string> hidden_together(const std::vector<TrueEffect>& effects) {
  std::multiset<std::string> ids;
  for (const TrueEffect& effect : effects) ids.insert(effect.id);
  return ids;
}

/// Two that are hidden against those that are named.
struct Pairs {
  Share exact, found_false;
  /// `stands(k, id)`: whether the k-th of the names counts for a hidden one that has no name of its own yet.
  template <class Stands>
  void add(const std::vector<TrueEffect>& hidden, const std::vector<std::string>& names, Stands stands) {
    std::multiset<std::string> left = hidden_together(hidden);
    bool all_stand = true;
    for (std::size_t k = 0; k < names.size(); ++k) {
      auto meant = left.find(names[k]);
      if (meant == left.end())
        meant = std::find_if(left.begin(), left.end(), [&](const std::string& id) { return stands(k, id); });
      found_false.add(meant == left.end());
      all_stand = all_stand && meant != left.end();
      if (meant != left.end()) left.erase(meant);
    }
    exact.add(all_stand && left.empty());
  }
};

void pairs(const Cases& cases, const LookAlikes& look_alikes, std::vector<Figure>& table) {
  Pairs counted, strict, oracle, certain;
  Share within;
  for (const Case& one : cases) {
    if (one.truth.set != "pairs" || one.truth.asked != 60) continue;
    const Verdict verdict = judged(one);
    std::vector<std::string> names;
    for (std::size_t k = 0; k < together(verdict); ++k) names.push_back(verdict.causes[k].id);
    counted.add(one.truth.effects, names,
                [&](std::size_t k, const std::string& id) { return stands_for(verdict, names[k], id, look_alikes); });
    strict.add(one.truth.effects, names, [](std::size_t, const std::string&) { return false; });
    if (verdict.verdict == "named")
      certain.add(one.truth.effects, names, [](std::size_t, const std::string&) { return false; });
    if (verdict.verdict != "unknown") {
      std::vector<std::vector<std::string>> offered = verdict.alternatives;
      offered.push_back(names);
      within.add(std::any_of(offered.begin(), offered.end(), [&](const auto& ids) {
        return std::multiset<std::string>(ids.begin(), ids.end()) == hidden_together(one.truth.effects);
      }));
    }
    if (!one.oracle || one.oracle->pair.empty()) continue;
    const auto& members = one.oracle->pair;
    oracle.add(one.truth.effects, {members[0].id, members[1].id},
               [&](std::size_t k, const std::string& id) { return stands_for(members[k], id, look_alikes); });
  }
  const auto remark = [&](Share Pairs::*which) {
    std::string words = fmt::format("without look-alikes {:.3f}", (strict.*which).value());
    if ((oracle.*which).total > 0) words += fmt::format(", oracle {:.3f}", (oracle.*which).value());
    return words;
  };
  table.push_back(share("two effects, exact pair, Λ 60 each", counted.exact, at_least(0.85), at_least(0.90),
                        remark(&Pairs::exact)));
  table.push_back(share("two effects, false discoveries among the causes named", counted.found_false, at_most(0.05), {},
                        remark(&Pairs::found_false)));
  table.push_back(share("two effects, false discoveries where the verdict is \"named\"", certain.found_false, {}, {},
                        fmt::format("without look-alikes; {} pairs", certain.exact.total)));
  table.push_back(share("two effects, the very pair is the first or an alternative", within, {}, {},
                        "of verdicts that are not \"unknown\""));
}

void outside(const Cases& cases, std::vector<Figure>& table) {
  Share honest, hedged, unmarked, detected;
  for (const Case& one : cases) {
    if (one.truth.set != "outside" || !one.truth.effects.front().reached) continue;
    const Verdict verdict = judged(one);
    detected.add(verdict.detected());
    if (!verdict.detected()) continue;
    const auto set = claimed(verdict);
    // What is named together is one answer, not a set of rivals; the rival may be what the catalogue does not list.
    const bool open = verdict.verdict == "unknown" || verdict.verdict == "indistinguishable" ||
                      set.size() > std::max<std::size_t>(1, together(verdict));
    if (one.truth.remainder >= 25) {
      honest.add(open);
      continue;
    }
    const auto has = [&set](const std::string& id) {
      return !id.empty() && std::find(set.begin(), set.end(), id) != set.end();
    };
    const bool with_look_alike = set.size() > 1 && (has(one.truth.look_alike) || has(one.truth.nearest));
    const bool marked =
        std::any_of(verdict.causes.begin(), verdict.causes.end(), [](const Cause& c) { return c.hedged; });
    hedged.add(verdict.verdict == "unknown" || with_look_alike || marked);
    unmarked.add(verdict.verdict == "unknown" || with_look_alike);
  }
  table.push_back(share("outside the catalogue, remainder ≥ 25: unknown or a set", honest, at_least(0.90),
                        at_least(0.95), "of those detected"));
  table.push_back(share("outside, remainder below: in a set with its look-alike, or \"consistent with\"", hedged,
                        at_least(0.90), at_least(0.95),
                        fmt::format("of those detected; every name is marked so, and without the mark {:.3f}",
                                    unmarked.total == 0 ? 0.0 : unmarked.value())));
  table.push_back(share("outside, detected", detected, {}, {}));
}

/// Effects that are found at their target. 1/√Λ is the limit where the amplitude is the only unknown; a nuisance
/// parameter that the data hardly fix takes any amplitude with it, and those are told apart.
void amplitudes(const Cases& cases, std::vector<Figure>& table) {
  Share covered;
  struct Spread {
    double squares = 0;
    std::size_t count = 0;
    void add(double error) { squares += error * error, ++count; }
    /// With the interval of the standard deviation of so many normal errors.
    [[nodiscard]] Figure figure(std::string name, std::optional<Bar> pass, std::optional<Bar> stretch,
                                std::string remark) const {
      if (count == 0) return number(std::move(name), 0, 0, pass, stretch);
      const double n = static_cast<double>(count);
      Figure made = number(std::move(name), count, std::sqrt(squares / n), pass, stretch, std::move(remark));
      const boost::math::chi_squared chi(n);
      made.low = std::sqrt(squares / boost::math::quantile(chi, 0.975));
      made.high = std::sqrt(squares / boost::math::quantile(chi, 0.025));
      return made;
    }
  };
  const auto row = [&](double lambda, double pass, double stretch) {
    Spread alone, with_nuisance;
    for (const Case& one : cases) {
      if (!single(one) || one.truth.asked != lambda) continue;
      const Verdict verdict = judged(one);
      const TrueEffect& truth = one.truth.effects.front();
      if (!named_first(verdict, truth.id)) continue;
      const Cause& cause = verdict.causes.front();
      if (!cause.amplitude || !truth.target.met_by(cause.target)) continue;
      const double sign = truth.even && *cause.amplitude * truth.amplitude < 0 ? -1 : 1;
      (truth.nuisance ? with_nuisance : alone)
          .add((sign * *cause.amplitude - truth.amplitude) / (truth.amplitude - truth.null));
      if (!cause.low || !cause.high) continue;
      const auto [low, high] = std::minmax({sign * *cause.low, sign * *cause.high});
      covered.add(low <= truth.amplitude && truth.amplitude <= high);
    }
    const std::string name = fmt::format("amplitude, relative rms at Λ {:g}", lambda);
    table.push_back(alone.figure(name, at_most(pass), at_most(stretch),
                                 fmt::format("1/√Λ = {:.2f} is the limit", 1 / std::sqrt(lambda))));
    table.push_back(with_nuisance.figure(name + ", effects with a nuisance parameter", {}, {}, {}));
  };
  row(25, 0.28, 0.23);
  row(60, 0.17, 0.145);
  table.push_back(share("amplitude, coverage of the 95 % interval", covered, Bar{0.92, 0.98}, Bar{0.94, 0.96}));
}

/// Σ over ten bins of n_b/n |mean probability − share right| (Naeini, Cooper, Hauskrecht, AAAI 2015).
void calibration(const Cases& cases, std::vector<Figure>& table) {
  struct Bin {
    double stated = 0;
    Share right;
  };
  std::array<Bin, 10> bins;
  std::size_t count = 0;
  for (const Case& one : cases) {
    if (!single(one)) continue;
    const Verdict verdict = judged(one);
    if (!verdict.detected() || verdict.causes.empty() || !verdict.causes.front().probability) continue;
    const double p = *verdict.causes.front().probability;
    Bin& bin = bins[std::min<std::size_t>(9, static_cast<std::size_t>(10 * std::clamp(p, 0.0, 1.0)))];
    bin.stated += p, bin.right.add(verdict.causes.front().id == hidden(one)), ++count;
  }
  double error = 0, chance = 0;
  for (const Bin& bin : bins) {
    if (bin.right.total == 0) continue;
    error += std::abs(bin.stated - static_cast<double>(bin.right.hits));
    const double n = static_cast<double>(bin.right.total), p = std::clamp(bin.stated / n, 0.02, 0.98);
    chance += std::sqrt(n * p * (1 - p));
  }
  const double n = count == 0 ? 1 : static_cast<double>(count);
  Figure figure = number("expected calibration error of the stated probability", count, error / n, at_most(0.05),
                         at_most(0.03), "interval: two binomial deviations of every bin");
  figure.low = std::max(0.0, (error - 2 * chance) / n), figure.high = (error + 2 * chance) / n;
  table.push_back(figure);
}

void held_out(const Cases& cases, std::vector<Figure>& table) {
  Share good;
  for (const Case& one : cases) {
    if (!single(one) || !named_first(judged(one), hidden(one))) continue;
    for (const double p : one.verdict.held_out) good.add(p > 0.05);
  }
  table.push_back(share("held-out predictive p-value above 0.05 with the named mechanism", good, Bar{0.90, 0.98},
                        Bar{0.93, 0.97}, "blocks"));
}

}  // namespace

std::vector<Figure> figures(const Cases& cases, const LookAlikes& look_alikes) {
  std::vector<Figure> table;
  false_alarms(cases, table);
  detection(cases, table);
  naming(cases, look_alikes, table);
  sets(cases, table);
  pairs(cases, look_alikes, table);
  outside(cases, table);
  amplitudes(cases, table);
  calibration(cases, table);
  held_out(cases, table);
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

std::vector<EffectRow> effects(const Cases& cases, const LookAlikes& look_alikes) {
  std::map<std::pair<std::string, double>, EffectRow> rows;
  std::map<std::pair<std::string, double>, std::map<std::string, std::size_t>> instead;
  for (const Case& one : cases) {
    if (one.truth.set != "singles") continue;
    const std::pair key{hidden(one), one.truth.asked};
    EffectRow& row = rows[key];
    row.id = key.first, row.lambda = key.second;
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
