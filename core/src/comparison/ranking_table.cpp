// SPDX-License-Identifier: Apache-2.0
#include "comparison/ranking_table.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "comparison/hold_out.hpp"
#include "comparison/ranking.hpp"
#include "comparison/stability_report.hpp"
#include "text/misfit_words.hpp"
#include "text/units.hpp"
#include "text/wrapping.hpp"

namespace tunica::comparison {

namespace {

text::StyledText warning_lines(const std::vector<execution::Warning>& warnings) {
  text::StyledText lines;
  if (warnings.empty()) return lines;
  lines.add("Warnings", text::Emphasis::heading);
  lines += "\n";
  for (const auto& warning : warnings) lines += text::caution_line(warning.text());
  return lines += "\n";
}

/// A count in at most so many columns.
std::string count_text(std::optional<double> count, std::size_t columns = 7) {
  if (!count) return "-";
  std::string text = fmt::format("{:.0f}", *count);
  for (int digits = 3; text.size() > columns && digits > 0; --digits) text = fmt::format("{:.{}g}", *count, digits);
  return text;
}

/// In at most six columns, up to eleven days.
std::string seconds_text(double seconds) {
  return fmt::format("{:.{}f}", seconds, seconds < 10 ? 3 : seconds < 1000 ? 1 : 0);
}

/// As many of seven digits as fit into ten columns, zeros at the end among them: they tell equal from nearly equal.
std::string objective_text(double objective) {
  int digits = 7;
  std::string text;
  do text = fmt::format("{:#.{}g}", objective, digits--);
  while (text.size() > 10 && digits > 2);
  return text;
}

/// What a reader must know of a run that has no rank, or one that does not count.
std::string flaw(const RunSummary& run) {
  if (!run.has_result) return "no result: " + run.status.reason();
  if (run.status.kind() == Status::Kind::infeasible)
    return fmt::format("no feasible point; least violation {:.3g}: {}", run.status.violation(), run.status.reason());
  return reason_of_rank(run);
}

/// Columns that some run has something to say in. Full simulations take the place of all evaluations.
struct Columns {
  bool simulations = false, failures = false, chi_square = false, delta_aicc = false;

  /// Of the label: a longer one stands on a line of its own, so that all lines fit into 80 columns.
  [[nodiscard]] std::size_t label_width() const {
    return std::size_t{27} - (failures ? 7U : 0) - (chi_square ? 7U : 0) - (delta_aicc ? 7U : 0);
  }
};

Columns columns_of(const Summary& summary) {
  Columns columns;
  for (const Ranked& entry : summary.ranking) {
    const RunSummary& run = summary.runs[entry.run];
    columns.simulations = columns.simulations || run.has_costly_tests;
    columns.failures = columns.failures || run.failures > 0;
    columns.chi_square = columns.chi_square || run.misfit.has_value();
    columns.delta_aicc = columns.delta_aicc || entry.delta_aicc.has_value();
  }
  return columns;
}

bool differ_in_constraints(const Summary& summary) {
  std::set<std::string> imposed;
  for (const auto& run : summary.runs)
    if (run.stability) imposed.insert(run.stability->imposed);
  return imposed.size() > 1;
}

/// With what tells it from other runs: "hgo/lm#2 (h = 0.7)".
std::string shown_label(const RunSummary& run, bool names_constraints) {
  std::vector<std::string> parts = run.differs;
  if (names_constraints && run.stability) {
    const std::string imposed = run.stability->imposed.empty() ? "free" : run.stability->imposed;
    if (std::find(parts.begin(), parts.end(), imposed) == parts.end()) parts.insert(parts.begin(), imposed);
  }
  return parts.empty() ? run.label : fmt::format("{} ({})", run.label, fmt::join(parts, ", "));
}

std::string row(const Ranked& entry, const RunSummary& run, const Columns& columns, bool names_constraints) {
  const std::string label = shown_label(run, names_constraints);
  const std::string objective = run.has_result ? objective_text(run.objective) : "-";
  const std::size_t width = columns.label_width();
  std::string text = fmt::format("{:>2} ", entry.rank ? fmt::format("{}", *entry.rank) : "-");
  if (text::columns(label) > width) text += text::shortened(label, 77) + '\n' + std::string(3, ' ');
  const std::uint64_t made = columns.simulations && run.has_costly_tests ? run.simulated : run.evaluations;
  text += fmt::format(
      "{} {:>10} {:>7} {:>7} {:>7} {:>7} {:>6}", text::pad(text::columns(label) > width ? "" : label, width), objective,
      fmt::format("{}/{}", run.successes, run.realisations), count_text(run.expected_running_time),
      count_text(static_cast<double>(made)), count_text(static_cast<double>(run.jacobians)), seconds_text(run.seconds));
  if (columns.failures) text += fmt::format(" {:>6}", count_text(static_cast<double>(run.failures), 6));
  if (columns.chi_square)
    text += fmt::format(" {:>6}", run.misfit ? fmt::format("{:.3g}", run.misfit->per_freedom()) : "-");
  if (columns.delta_aicc)
    text += fmt::format(" {:>6}", entry.delta_aicc ? fmt::format("{:.3g}", *entry.delta_aicc) : "-");
  text += '\n';
  if (const std::string reason = flaw(run); !reason.empty()) text += text::hanging("     ", reason) + '\n';
  return text;
}

std::string explanation(const Columns& columns) {
  std::string text =
      "success: realisations at or below the target, or within 0.1 % of the best known objective; ERT: evaluations "
      "spent for one success, failed realisations included; ";
  text += columns.simulations ? "sim: evaluations that simulated the costly tests; " : "total: all evaluations; ";
  text += "Jac: Jacobians, counted beside them; sec: seconds of all realisations together";
  if (columns.failures) text += "; failed: evaluations that failed";
  if (columns.chi_square) text += "; χ²/ν: misfit over stated noise, by degree of freedom, near 1 where both are right";
  return text + ". Runs of one rank stand in the order of their cost, evaluations and Jacobians for one success";
}

std::string ranking_lines(const Summary& summary) {
  const Columns columns = columns_of(summary);
  std::string text, group;
  for (const auto& entry : summary.ranking) {
    const auto& run = summary.runs[entry.run];
    if (run.group != group) {
      group = run.group;
      text += ranked_by_success(summary.runs, group)
                  ? text::hanging("Ranking by ",
                                  fmt::format("success, then ERT, at the target {:g}: {}", *run.target, group))
                  : text::hanging("Ranking by ", group);
      text += '\n';
      text += fmt::format(" # {} {:>10} {:>7} {:>7} {:>7} {:>7} {:>6}{}{}{}\n", text::pad("run", columns.label_width()),
                          "objective", "success", "ERT", columns.simulations ? "sim" : "total", "Jac", "sec",
                          columns.failures ? " failed" : "", columns.chi_square ? "   χ²/ν" : "",
                          columns.delta_aicc ? "  ΔAICc" : "");
    }
    text += row(entry, run, columns, differ_in_constraints(summary));
  }
  return text + text::hanging("   ", explanation(columns)) + '\n';
}

/// "profile (21.9 … 23.1), bootstrap (22 … 22.9), posterior (21.8 … 23), median 22.3"
std::string other_intervals(const Estimate& estimate) {
  const auto end = [](const std::optional<double>& value) { return value ? fmt::format("{:.4g}", *value) : "open"; };
  std::string text;
  if (estimate.profile)
    text = fmt::format("profile ({} … {})", end(estimate.profile->lower), end(estimate.profile->upper));
  if (estimate.bootstrap)
    text += fmt::format("{}bootstrap ({:.4g} … {:.4g})", text.empty() ? "" : ", ", estimate.bootstrap->first,
                        estimate.bootstrap->second);
  if (estimate.posterior)
    text += fmt::format("{}posterior ({:.4g} … {:.4g}), median {:.4g}", text.empty() ? "" : ", ",
                        estimate.posterior->lower, estimate.posterior->upper, estimate.posterior->median);
  return text;
}

/// "misses by 6.9 % of the range (0.12 kPa)" beyond noise; empty where that is not known.
std::string size_text(const RunSummary& run, const Quality& quality) {
  for (const assembly::ChannelSize& one : run.sizes)
    if (!quality.held_out && one.test == quality.test && one.channel == quality.channel)
      return fmt::format(", {} ({:.2g}{})", text::misses_by(one.of_range().rms), one.rms, text::unit_suffix(one.unit));
  return "";
}

std::string quality_text(const Quality& quality) {
  const auto& measure = quality.agreement;
  std::string text = fmt::format("RMSE {:.4g}{}", measure.rmse, text::unit_suffix(quality.unit));
  text += measure.r2 ? fmt::format(", R² {:.5f}", *measure.r2) : std::string(", R² undefined (constant data)");
  if (measure.nmad) text += fmt::format(", NMAD {:.3g} %", *measure.nmad);
  return text;
}

/// "objective 12.1 ± 0.2, mu 18.6 ± 0.3 kPa": mean and standard deviation.
std::string spread_text(const RunSummary& run) {
  const auto one = [](const std::string& name, const SampleStatistics& sample, const std::string& unit) {
    return fmt::format("{} {:.5g} ± {:.2g}{}", name, sample.mean, sample.sd.value_or(0), text::unit_suffix(unit));
  };
  std::vector<std::string> parts{one("objective", run.objectives, "")};
  for (const auto& parameter : run.parameters)
    parts.push_back(one(parameter.name, parameter.over_realisations, parameter.unit));
  return fmt::format("{} (mean ± sd of {}; intervals in statistics.csv)", fmt::join(parts, ", "), run.objectives.count);
}

/// A parameter with a longer name has it on a line of its own.
constexpr std::size_t widest_name = 30;

text::StyledText parameter_lines(const RunSummary& run) {
  std::size_t width = 8;
  for (const auto& parameter : run.parameters) width = std::max(width, text::columns(parameter.name));
  width = std::min(width, widest_name);
  text::StyledText lines;
  for (const auto& parameter : run.parameters) {
    const text::StyledText value = value_text(parameter);
    const bool fits = text::columns(parameter.name) <= width && 2 + width + 2 + text::columns(value.plain()) <= 80;
    lines += fits ? fmt::format("  {}  ", text::pad(parameter.name, width)) : fmt::format("  {}\n    ", parameter.name);
    lines += value;
    lines += "\n";
    if (const auto other = other_intervals(parameter); !other.empty())
      lines += text::hanging("  " + std::string(width + 2, ' '), other) + '\n';
  }
  return lines;
}

text::StyledText run_lines(const RunSummary& run) {
  const std::string how = words_on_ending(run);
  std::string head = run.label;
  if (run.realisations > 1) head += fmt::format(", best of {} realisations", run.realisations);
  text::StyledText lines(text::hanging(head + "  ", how.empty() ? "" : fmt::format("({})", how)) + '\n');
  if (!run.has_result) return lines += text::hanging("  no result: ", run.status.reason()) + '\n';
  if (const auto& optimum = run.certificate.sentence; !optimum.empty())
    lines += text::hanging("  optimum: ", optimum) + '\n';
  lines += parameter_lines(run);
  if (run.objectives.count > 1) lines += text::hanging("  over realisations: ", spread_text(run)) + '\n';
  const std::string side_by_side = hold_out_table(run.quality);
  lines += side_by_side;
  for (const auto& quality : run.quality) {
    if (!side_by_side.empty()) break;
    lines += text::hanging(fmt::format("  {}, {}: ", quality.test, quality.channel),
                           quality_text(quality) + size_text(run, quality)) +
             '\n';
  }
  if (run.size) {
    std::string text = text::misses_by(run.size->rms) + " beyond noise";
    if (run.tolerance) text += "; " + text::against_tolerance(run.size->rms, run.size->upper, *run.tolerance, "stated");
    lines += text::hanging("  in all: ", text) + '\n';
  }
  if (run.misfit) lines += text::hanging("  misfit: ", assembly::in_words(*run.misfit, "stated")) + '\n';
  if (run.misfit_estimated)
    lines += text::hanging("  misfit: ", assembly::in_words(*run.misfit_estimated, "estimated")) + '\n';
  for (const auto& sentence : run.notes) lines += text::hanging("  - ", sentence) + '\n';
  for (const auto& sentence : run.uncertainty) lines += text::hanging("  - ", sentence) + '\n';
  return lines;
}

}  // namespace

text::StyledText value_text(const Estimate& estimate) {
  const std::string unit = text::unit_suffix(estimate.unit);
  text::StyledText text(fmt::format("{:.5g}", estimate.value));
  if (!estimate.ci95) {
    text += unit;
  } else {
    const double below = estimate.value - estimate.ci95->first, above = estimate.ci95->second - estimate.value;
    const bool symmetric = std::abs(above - below) <= 0.02 * std::abs(above + below);
    text += symmetric ? fmt::format(" ± {:.2g}{}", (above + below) / 2, unit)
                      : fmt::format("{} ({:.4g} … {:.4g})", unit, estimate.ci95->first, estimate.ci95->second);
  }
  if (const auto& difference = estimate.difference)
    text += fmt::format(
        "  {} {:+.3g}{}", difference->from, difference->value,
        difference->ci95 ? fmt::format(" ± {:.2g}", (difference->ci95->second - difference->ci95->first) / 2) : "");
  if (estimate.mesh_bias) {
    const std::string bias = fmt::format("mesh {:+.2g}{}", *estimate.mesh_bias, unit);
    text += "  ";
    if (estimate.mesh_bias_matters())
      text.add(bias, text::Emphasis::caution);
    else
      text += bias;
  }
  if (estimate.at_bound != Estimate::Bound::none) {
    text += "  ";
    const bool upper = estimate.at_bound == Estimate::Bound::upper;
    text.add(upper ? "<- at its upper bound" : "<- at its lower bound", text::Emphasis::caution);
    return text;
  }
  const bool closed = estimate.profile && estimate.profile->lower && estimate.profile->upper;
  if (!estimate.ci95 && estimate.assessed && !estimate.identified && !closed)
    text += estimate.held ? "  (held by a constraint)" : "  (not fixed by the data)";
  return text;
}

text::StyledText ranking_table(const Summary& summary) {
  text::StyledText table = warning_lines(summary.warnings);
  table += ranking_lines(summary);
  if (const std::string stability = stability_table(summary); !stability.empty()) table += '\n' + stability;
  for (const auto& entry : summary.ranking) {
    table += "\n";
    table += run_lines(summary.runs[entry.run]);
  }
  if (!summary.identifiability.empty()) table += "\nWhat the data fix, and what they do not\n";
  for (const auto& sentence : summary.identifiability) table += text::hanging("  ", sentence) + '\n';
  return table;
}

}  // namespace tunica::comparison
