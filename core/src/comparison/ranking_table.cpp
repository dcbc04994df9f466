// SPDX-License-Identifier: Apache-2.0
#include "comparison/ranking_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "comparison/text.hpp"

namespace tunica::comparison {

namespace {

std::string unit_text(const std::string& unit) { return unit.empty() || unit == "1" ? "" : ' ' + unit; }

std::string lines(const std::string& title, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return {};
  std::string text = title + '\n';
  for (const auto& sentence : sentences) text += hanging("  ! ", sentence) + '\n';
  return text + '\n';
}

std::string ranking_lines(const Summary& summary) {
  std::size_t width = 5;
  for (const auto& run : summary.runs) width = std::max(width, columns(run.label));
  width = std::min<std::size_t>(width, 26);
  std::string text, group;
  for (const auto& entry : summary.ranking) {
    const auto& run = summary.runs[entry.run];
    if (run.group != group) {
      group = run.group;
      text += hanging("Ranking by ", group) + '\n';
      text += fmt::format("  #  {}  {:>12} {:>9} {:>7} {:>9}  {}\n", pad("run", width), "objective", "evals", "failed",
                          "seconds", "success");
    }
    const std::string rank = entry.rank ? fmt::format("{}", *entry.rank) : "-";
    const std::string objective = run.has_result ? fmt::format("{:#.7g}", run.objective) : "NO RESULT";
    const auto successes = std::lround(run.success_rate * static_cast<double>(run.realisations));
    text += fmt::format("{:>3}  {}  {:>12} {:>9} {:>7} {:>9.4g}  {}/{}{}\n", rank, pad(run.label, width), objective,
                        run.evaluations, run.failures, run.seconds, successes, run.realisations,
                        run.has_result && !run.status.ok() ? " BREAKS A CONSTRAINT" : "");
  }
  return text;
}

std::string quality_text(const Quality& quality) {
  const auto& measure = quality.agreement;
  std::string text = fmt::format("RMSE {:.4g}{}", measure.rmse, unit_text(quality.unit));
  text += measure.r2 ? fmt::format(", R² {:.5f}", *measure.r2) : std::string(", R² undefined (constant data)");
  if (measure.nmad) text += fmt::format(", NMAD {:.3g} %", *measure.nmad);
  return text + (quality.held_out ? ", HELD OUT" : "");
}

std::string run_lines(const RunSummary& run) {
  std::string how = run.stop_reason.empty() ? run.reason : "stopped by " + run.stop_reason;
  if (run.converged) how = "converged: " + run.reason;
  std::string text = run.label;
  if (run.realisations > 1) text += fmt::format(", best of {} realisations", run.realisations);
  text = hanging(text + "  ", how.empty() ? "" : fmt::format("({})", how)) + '\n';
  if (!run.has_result) return text + hanging("  no result: ", run.status.reason()) + '\n';
  std::size_t width = 8;
  for (const auto& parameter : run.parameters) width = std::max(width, columns(parameter.name));
  for (const auto& parameter : run.parameters)
    text += fmt::format("  {}  {}\n", pad(parameter.name, width), value_text(parameter));
  for (const auto& quality : run.quality) {
    const std::string name = fmt::format("  {}, {}: ", quality.test, quality.channel);
    text += hanging(columns(name) < 40 ? name : name + "\n    ", quality_text(quality)) + '\n';
  }
  return text;
}

}  // namespace

std::string value_text(const Estimate& estimate) {
  std::string text = fmt::format("{:.5g}", estimate.value);
  if (estimate.ci95) {
    const double below = estimate.value - estimate.ci95->first, above = estimate.ci95->second - estimate.value;
    if (std::abs(above - below) <= 0.02 * std::abs(above + below))
      text += fmt::format(" ± {:.2g}{}", (above + below) / 2, unit_text(estimate.unit));
    else
      text +=
          fmt::format("{} ({:.4g} … {:.4g})", unit_text(estimate.unit), estimate.ci95->first, estimate.ci95->second);
  } else if (estimate.at_bound != Estimate::Bound::none) {
    text += unit_text(estimate.unit);
  } else {
    text += unit_text(estimate.unit) + (estimate.identified ? "" : "  (not fixed by the data)");
  }
  if (estimate.at_bound != Estimate::Bound::none)
    text += fmt::format("  <- AT ITS {} BOUND", estimate.at_bound == Estimate::Bound::upper ? "UPPER" : "LOWER");
  return text;
}

std::string ranking_table(const Summary& summary) {
  std::string text = lines("WARNINGS", summary.warnings) + ranking_lines(summary);
  for (const auto& entry : summary.ranking) text += '\n' + run_lines(summary.runs[entry.run]);
  if (!summary.identifiability.empty()) text += "\nWhat the data fix, and what they do not\n";
  for (const auto& sentence : summary.identifiability) text += hanging("  ", sentence) + '\n';
  return text;
}

}  // namespace tunica::comparison
