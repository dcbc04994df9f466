// SPDX-License-Identifier: Apache-2.0
// Classes of cases beside the plain one: other bases and protocols, noise that no file states, order nobody recorded.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "rows.hpp"

namespace blind::score {
namespace {

/// Fewer cases than this say little of their own class: they are judged together.
constexpr std::size_t enough_to_judge = 50;

std::optional<Bar> judged_if(const Share& of, Bar bar) {
  return of.total >= enough_to_judge ? std::optional(bar) : std::nullopt;
}

struct OneClass {
  Share alarms, detected, oracle_detected, right, oracle_right, remembering;
};

bool needs_order(const std::string& id) {
  return id == "stress_softening" || id == "viscoelasticity" || id == "permanent_set";
}

/// What one class shows, whichever it is.
OneClass count(const Cases& cases, const LookAlikes& look_alikes, const std::string& name) {
  OneClass made;
  for (const Case& one : cases) {
    if (class_of(one.truth) != name || !ordinary(one.truth.noise)) continue;
    const Verdict verdict = judged(one);
    for (std::size_t k = 0; k < together(verdict); ++k) made.remembering.add(needs_order(verdict.causes[k].id));
    if (one.truth.set == "nulls") made.alarms.add(verdict.detected());
    if (!single(one)) continue;
    if (one.truth.asked >= 25) {
      made.detected.add(verdict.detected());
      if (one.oracle) made.oracle_detected.add(one.oracle->detected);
    }
    if (one.truth.asked != 60) continue;
    if (one.oracle && one.oracle->detected) made.oracle_right.add(oracle_named(*one.oracle, hidden(one), look_alikes));
    if (verdict.detected()) made.right.add(named_with_look_alike(verdict, hidden(one), look_alikes));
  }
  return made;
}

std::string beside(const Share& oracle) {
  return oracle.total == 0 ? "" : fmt::format("oracle {:.3f}", oracle.value());
}

/// Names of the same data without and with their noise stated, where both are detected: b right only without, c only
/// with. Interval of (b − c)/n after Bonett and Price, Stat. Med. 31:870 (2012).
struct Paired {
  std::size_t without = 0, with = 0, total = 0;
  [[nodiscard]] Figure figure(std::string name, double least) const {
    Figure made{std::move(name), total, 0, 0, 0, at_least(least), {}, {}};
    if (total == 0) return made;
    const double n = static_cast<double>(total), b = static_cast<double>(without), c = static_cast<double>(with);
    const double p = (b + 1) / (n + 2), q = (c + 1) / (n + 2),
                 half = 1.959963984540054 * std::sqrt((p + q - (p - q) * (p - q)) / (n + 2));
    made.value = (b - c) / n;
    made.low = p - q - half;
    made.high = p - q + half;
    made.remark = fmt::format("right only without {}, only with {}", without, with);
    return made;
  }
};

void noise_not_stated(const Cases& cases, const LookAlikes& look_alikes, std::vector<Figure>& table) {
  std::map<std::string, const Case*> by_name;
  for (const Case& one : cases) by_name[one.name] = &one;
  Share alarms, detected, oracle;
  std::map<std::string, Share> alarms_by_noise;
  std::map<double, Paired> pairs{{25, {}}, {60, {}}, {150, {}}};
  for (const Case& one : cases) {
    if (one.truth.noise_stated) continue;
    const Verdict verdict = judged(one);
    if (one.truth.set == "nulls") {
      alarms_by_noise[one.truth.noise].add(verdict.detected());
      if (ordinary(one.truth.noise)) alarms.add(verdict.detected());
    }
    if (!single(one) || !ordinary(one.truth.noise)) continue;
    const auto twin = by_name.find(one.truth.twin);
    if (one.truth.asked >= 25) detected.add(verdict.detected());
    if (twin == by_name.end()) continue;
    if (one.truth.asked >= 25 && twin->second->oracle) oracle.add(twin->second->oracle->detected);
    const Verdict stated = judged(*twin->second);
    const auto of_lambda = pairs.find(one.truth.asked);
    if (of_lambda == pairs.end() || !verdict.detected() || !stated.detected()) continue;
    const bool without = named_with_look_alike(verdict, hidden(one), look_alikes),
               with = named_with_look_alike(stated, hidden(one), look_alikes);
    Paired& both = of_lambda->second;
    ++both.total;
    both.without += without && !with;
    both.with += with && !without;
  }
  if (alarms.total + detected.total == 0) return;
  table.push_back(share("noise not stated: false alarms", alarms, judged_if(alarms, {0.035, 0.065}), {}));
  for (const auto& [noise, of] : alarms_by_noise)
    table.push_back(share("noise not stated: false alarms, noise " + noise, of, {}, {}));
  Figure figure = share("noise not stated: detected, as a share of the stated-noise oracle's, Λ ≥ 25", detected,
                        at_least(0.95), {});
  if (oracle.total > 0 && oracle.total == detected.total && oracle.hits > 0) {
    figure.remark = fmt::format("detected {:.3f}, oracle {:.3f}", detected.value(), oracle.value());
    for (double* number : {&figure.value, &figure.low, &figure.high}) *number /= oracle.value();
  } else {
    figure.cases = 0;
  }
  table.push_back(figure);
  for (const auto& [lambda, both] : pairs)
    table.push_back(
        both.figure(fmt::format("noise not stated: right name less that of the same data with it, Λ {:g}", lambda),
                    lambda < 60 ? -0.04 : -0.02));
}

}  // namespace

std::string class_of(const Truth& truth) {
  return fmt::format("{} × {}{}{}", truth.base, truth.protocol, truth.noise_stated ? "" : ", noise not stated",
                     truth.order_recorded ? "" : ", order not recorded");
}

std::vector<Figure> class_figures(const Cases& cases, const LookAlikes& look_alikes) {
  std::vector<Figure> table;
  noise_not_stated(cases, look_alikes, table);
  std::map<std::string, const Truth*> classes;
  for (const Case& one : cases)
    if (!one.truth.plain() && one.truth.noise_stated) classes[class_of(one.truth)] = &one.truth;
  OneClass every;
  for (const auto& [name, truth] : classes) {
    const OneClass found = count(cases, look_alikes, name);
    for (Share OneClass::*part : {&OneClass::alarms, &OneClass::right, &OneClass::oracle_right}) {
      (every.*part).hits += (found.*part).hits;
      (every.*part).total += (found.*part).total;
    }
    table.push_back(share(name + ": false alarms", found.alarms, judged_if(found.alarms, {0.035, 0.065}), {}));
    table.push_back(share(name + ": detected, Λ ≥ 25", found.detected, {}, {}, beside(found.oracle_detected)));
    table.push_back(share(name + ": right name first given detection, Λ 60", found.right,
                          judged_if(found.right, at_least(0.90)), {}, beside(found.oracle_right)));
    if (!truth->order_recorded)
      table.push_back(share(name + ": a mechanism with memory among the causes named", found.remembering, at_most(0),
                            {}, "none is hidden, and none can be known"));
  }
  if (classes.empty()) return table;
  table.push_back(share("these classes together: false alarms", every.alarms, Bar{0.035, 0.065}, {}));
  table.push_back(share("these classes together: right name first given detection, Λ 60", every.right, at_least(0.90),
                        {}, beside(every.oracle_right)));
  return table;
}

std::vector<MistakeRow> mistakes(const Cases& cases, const LookAlikes& look_alikes) {
  std::map<std::pair<std::string, double>, MistakeRow> rows;
  for (const Case& one : cases) {
    if (!single(one)) continue;
    const std::pair key{class_of(one.truth), one.truth.asked};
    MistakeRow& row = rows[key];
    row.name = key.first;
    row.lambda = key.second;
    ++row.cases;
    if (one.oracle) {
      ++row.oracle_cases;
      const bool right = oracle_named(*one.oracle, hidden(one), look_alikes);
      ++(!one.oracle->detected ? row.oracle_missed : right ? row.oracle_right : row.oracle_wrong);
    }
    const Verdict verdict = judged(one);
    const std::size_t named = together(verdict);
    bool among = false;
    for (std::size_t k = 0; k < named; ++k)
      among = among || stands_for(verdict, verdict.causes[k].id, hidden(one), look_alikes);
    ++(!verdict.detected() ? row.missed
       : named == 0        ? row.unknown
       : !among            ? row.wrong
       : named > 1         ? row.over_named
                           : row.right);
  }
  std::vector<MistakeRow> all;
  for (auto& [key, row] : rows) all.push_back(std::move(row));
  return all;
}

std::vector<Figure> time_figures(const Cases& cases) {
  std::map<std::string, std::vector<const Case*>> groups;
  for (const Case& one : cases) {
    if (!one.seconds) continue;
    groups[""].push_back(&one);
    groups[class_of(one.truth) + ": "].push_back(&one);
  }
  std::vector<Figure> table;
  for (auto& [name, group] : groups) {
    std::sort(group.begin(), group.end(), [](const Case* a, const Case* b) { return *a->seconds < *b->seconds; });
    const bool all = name.empty();
    const auto bar = [all](double most) { return all ? std::optional(at_most(most)) : std::nullopt; };
    const Truth& worst = group.back()->truth;
    std::string what = worst.set;
    for (const TrueEffect& effect : worst.effects) what += " " + effect.id;
    table.push_back(number(name + "seconds of a quick diagnosis on one core, median", group.size(),
                           *group[group.size() / 2]->seconds, bar(0.5), {}));
    table.push_back(
        number(name + "seconds of a quick diagnosis on one core, worst", group.size(), *group.back()->seconds, bar(3),
               {}, fmt::format("{}: {}, Λ {:g}, noise {}", group.back()->name, what, worst.asked, worst.noise)));
  }
  return table;
}

}  // namespace blind::score
