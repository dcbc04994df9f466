// SPDX-License-Identifier: Apache-2.0
#include "table.hpp"

#include <cmath>

#include <fmt/format.h>

namespace blind::score {
namespace {

std::string bar(const std::optional<Bar>& of) {
  if (!of) return "–";
  if (std::isinf(of->low)) return fmt::format("≤ {:g}", of->high);
  if (std::isinf(of->high)) return fmt::format("≥ {:g}", of->low);
  return fmt::format("{:g}–{:g}", of->low, of->high);
}

/// Whether the bar is met, beside it.
std::string met(const Figure& figure, const std::optional<Bar>& of) {
  if (!of || figure.cases == 0) return bar(of);
  return bar(of) + (of->holds(figure.value) ? " ✓" : " ✗");
}

std::string measured(const Figure& figure) {
  if (figure.cases == 0) return "not measured";
  if (figure.low == figure.high) return fmt::format("{:.3f}", figure.value);
  return fmt::format("{:.3f} ({:.3f}–{:.3f})", figure.value, figure.low, figure.high);
}

std::string of_total(const Share& share) { return share.total == 0 ? "–" : fmt::format("{:.2f}", share.value()); }

nlohmann::ordered_json as_json(const Share& share) { return {{"hits", share.hits}, {"total", share.total}}; }

std::string figure_table(const std::string& what, const std::vector<Figure>& figures) {
  std::string text =
      fmt::format("| {} | measured (95 % interval) | pass | stretch | of | |\n|---|---|---|---|---|---|\n", what);
  for (const Figure& figure : figures)
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", figure.name, measured(figure), met(figure, figure.pass),
                        met(figure, figure.stretch), figure.cases, figure.remark);
  return text;
}

std::string mistake_table(const std::vector<MistakeRow>& rows) {
  std::string text =
      "\n| class | Λ | cases | right | wrongly named | over-named | unknown | missed | oracle: right | wrong | missed "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const MistakeRow& row : rows) {
    text += fmt::format("| {} | {:g} | {} | {} | {} | {} | {} | {} |", row.name, row.lambda, row.cases, row.right,
                        row.wrong, row.over_named, row.unknown, row.missed);
    text += row.oracle_cases == 0
                ? " – | – | – |\n"
                : fmt::format(" {} | {} | {} |\n", row.oracle_right, row.oracle_wrong, row.oracle_missed);
  }
  return text;
}

nlohmann::ordered_json as_json(const Figure& figure) {
  nlohmann::ordered_json one{{"name", figure.name}, {"cases", figure.cases}};
  if (figure.cases > 0) {
    one["value"] = figure.value;
    one["ci95"] = {figure.low, figure.high};
  }
  if (figure.pass) one["pass"] = figure.cases > 0 && !figure.missed();
  if (figure.stretch) one["stretch"] = figure.cases > 0 && figure.stretch->holds(figure.value);
  if (!figure.remark.empty()) one["remark"] = figure.remark;
  return one;
}

}  // namespace

std::string markdown(const std::string& heading, const Score& score) {
  std::string text = heading.empty() ? "" : heading + "\n\n";
  if (!score.figures.empty()) text += figure_table("figure", score.figures);
  if (!score.classes.empty()) text += "\n" + figure_table("class", score.classes);
  if (!score.times.empty()) text += "\n" + figure_table("time", score.times);
  if (!score.mistakes.empty()) text += mistake_table(score.mistakes);
  const auto& effects = score.effects;
  if (effects.empty()) return text;
  text +=
      "\n| effect | Λ | cases | out of reach | detected | named first | or with a look-alike | mean set | instead |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const EffectRow& row : effects) {
    std::string instead;
    for (const auto& [id, count] : row.confused_with)
      instead += fmt::format("{}{} {}", instead.empty() ? "" : ", ", id, count);
    text += fmt::format("| `{}` | {:g} | {} | {} | {} | {} | {} | {:.2f} | {} |\n", row.id, row.lambda,
                        row.detected.total, row.unreached, of_total(row.detected), of_total(row.named),
                        of_total(row.named_or_look_alike), row.mean_set, instead);
  }
  return text;
}

nlohmann::ordered_json as_json(const Score& score) {
  nlohmann::ordered_json all;
  for (const auto& [key, figures] :
       {std::pair("figures", &score.figures), {"classes", &score.classes}, {"times", &score.times}}) {
    all[key] = nlohmann::ordered_json::array();
    for (const Figure& figure : *figures) all[key].push_back(as_json(figure));
  }
  all["mistakes"] = nlohmann::ordered_json::array();
  for (const MistakeRow& row : score.mistakes)
    all["mistakes"].push_back({{"class", row.name},
                               {"lambda", row.lambda},
                               {"cases", row.cases},
                               {"right", row.right},
                               {"wrong", row.wrong},
                               {"over_named", row.over_named},
                               {"unknown", row.unknown},
                               {"missed", row.missed},
                               {"oracle",
                                {{"cases", row.oracle_cases},
                                 {"right", row.oracle_right},
                                 {"wrong", row.oracle_wrong},
                                 {"missed", row.oracle_missed}}}});
  all["effects"] = nlohmann::ordered_json::array();
  for (const EffectRow& row : score.effects) {
    nlohmann::ordered_json one{{"id", row.id},
                               {"lambda", row.lambda},
                               {"out_of_reach", row.unreached},
                               {"detected", as_json(row.detected)},
                               {"named_first", as_json(row.named)},
                               {"named_or_look_alike", as_json(row.named_or_look_alike)},
                               {"mean_set", row.mean_set},
                               {"instead", nlohmann::ordered_json::object()}};
    for (const auto& [id, count] : row.confused_with) one["instead"][id] = count;
    all["effects"].push_back(one);
  }
  return all;
}

}  // namespace blind::score
