// SPDX-License-Identifier: Apache-2.0
#include "comparison/certificate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "comparison/statistics.hpp"
#include "text/lists.hpp"

namespace tunica::comparison {

namespace {

/// Relative drop of the objective that a success does not allow.
constexpr double not_an_optimum = 1e-3;

/// The share by which the best neighbour is lower.
double share_of_drop(const search::Neighbourhood& around) {
  return (around.objective - around.lowest->objective) / std::abs(around.objective);
}

/// A neighbour is lower by more than a success allows, and the search was to go on.
bool leads_down(const Certificate& certificate) {
  const auto& around = certificate.fresh->around;
  return around.better && !certificate.ended_at_target && share_of_drop(around) > not_an_optimum;
}

CertificateVerdict verdict_on(const Certificate& certificate) {
  if (!certificate.fresh) return CertificateVerdict::not_checked;
  const auto& around = certificate.fresh->around;
  if (around.status.kind() == Status::Kind::failed) return CertificateVerdict::failed;
  if (!search::same_objective(around.objective, around.objective - certificate.fresh->difference))
    return CertificateVerdict::objective_differs;
  if (!around.status.ok()) return CertificateVerdict::constraint_broken;
  if (!around.lowest || (!around.better && around.left_out > 0)) return CertificateVerdict::no_neighbours;
  if (!around.better) return CertificateVerdict::confirmed;
  if (leads_down(certificate)) return CertificateVerdict::not_an_optimum;
  return share_of_drop(around) > not_an_optimum ? CertificateVerdict::ended_at_target
                                                : CertificateVerdict::better_neighbour;
}

std::string fresh_words(const Certificate& certificate) {
  if (!certificate.fresh) return fmt::format("not evaluated again in a fresh process ({})", certificate.missing);
  const auto& fresh = *certificate.fresh;
  if (certificate.verdict == CertificateVerdict::failed)
    return "it failed in a fresh process: " + fresh.around.status.reason();
  if (fresh.identical) return "evaluated identically in a fresh process";
  if (certificate.verdict == CertificateVerdict::objective_differs)
    return fmt::format("evaluated again in a fresh process, its objective differs by {:.2g}", fresh.difference);
  return fmt::format("evaluated again in a fresh process, its objective differs by rounding only ({:.2g})",
                     fresh.difference);
}

std::string neighbour_words(const Certificate& certificate) {
  const auto& around = certificate.fresh->around;
  const std::string left_out = around.left_out > 0 ? fmt::format(" (max_time left out {} of {})", around.left_out,
                                                                 around.evaluated + around.left_out)
                                                   : "";
  if (!around.lowest) return "no neighbour could be compared" + left_out;
  if (!around.better) return "no better neighbour" + left_out;
  const double share = share_of_drop(around);
  const char* const finding = share <= not_an_optimum       ? ""
                              : certificate.ended_at_target ? "stopped at its target, not at the optimum: "
                                                            : "not an optimum: ";
  if (around.lowest->step == 0)
    return fmt::format("{}{} from it lowers the objective by {:.2g} %", finding, around.lowest->along, 100 * share);
  return fmt::format("{}a step of {:g} along {} lowers the objective by {:.2g} %", finding, around.lowest->step,
                     around.lowest->along, 100 * share);
}

/// How far apart the parameters of agreeing realisations are, where there are several.
std::string spread_words(const Certificate& certificate) {
  const auto widest = std::max_element(certificate.spread.begin(), certificate.spread.end(),
                                       [](const auto& a, const auto& b) { return a.share < b.share; });
  if (certificate.agreeing < 2 || widest == certificate.spread.end()) return "";
  return fmt::format(", {} within {:.2g} % of its range", widest->name, 100 * widest->share);
}

std::string sentence_on(const Certificate& certificate) {
  std::vector<std::string> parts{fresh_words(certificate)};
  const bool known = certificate.fresh && certificate.verdict != CertificateVerdict::failed;
  if (known)
    parts.push_back(certificate.fresh->around.status.ok() ? neighbour_words(certificate)
                                                          : std::string("it breaks a constraint"));
  if (certificate.realisations > 1)
    parts.push_back(fmt::format("{} of {} realisations agree{}", certificate.agreeing, certificate.realisations,
                                spread_words(certificate)));
  parts.push_back(certificate.at_bounds.empty()
                      ? std::string("no bound active")
                      : fmt::format("{} at {}", text::joined(certificate.at_bounds),
                                    text::agreeing(certificate.at_bounds.size(), "its bound", "their bounds")));
  if (known && certificate.fresh->around.constraints > 0)
    parts.push_back(fmt::format("{} of {} active", certificate.fresh->around.active_constraints,
                                text::counted(certificate.fresh->around.constraints, "constraint", "constraints")));
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

void add_agreement(const assembly::Assembly& assembly, const execution::RunResult& result, double best,
                   std::optional<double> target, Certificate& certificate) {
  const auto& parameters = assembly.layout().parameters;
  double threshold = success_threshold({}, best);
  if (target && best <= *target) threshold = std::max(threshold, *target);
  std::vector<double> low, high, unit(parameters.size()), unit_low, unit_high;
  certificate.realisations = result.realisations.size();
  for (const auto& realisation : result.realisations) {
    if (!realisation.best.feasible() || realisation.best.objective > threshold) continue;
    const auto& values = realisation.best.parameters;
    assembly.box().to_unit(values, unit);
    if (certificate.agreeing++ == 0) {
      low = high = values;
      unit_low = unit_high = unit;
    }
    for (std::size_t j = 0; j < values.size(); ++j) {
      low[j] = std::min(low[j], values[j]);
      high[j] = std::max(high[j], values[j]);
      unit_low[j] = std::min(unit_low[j], unit[j]);
      unit_high[j] = std::max(unit_high[j], unit[j]);
    }
  }
  for (std::size_t j = 0; j < low.size(); ++j)
    certificate.spread.push_back({parameters[j].name, parameters[j].unit, low[j], high[j], unit_high[j] - unit_low[j]});
}

void judge(Certificate& certificate) {
  certificate.verdict = verdict_on(certificate);
  certificate.sentence = sentence_on(certificate);
}

std::optional<execution::Warning> certificate_warning(const std::string& label, const Certificate& certificate) {
  const auto warning = [&](execution::WarningKind kind) {
    return execution::Warning{kind, certificate.sentence, label};
  };
  switch (certificate.verdict) {
    case CertificateVerdict::failed:
      return warning(execution::WarningKind::certificate_failed);
    case CertificateVerdict::objective_differs:
      return warning(execution::WarningKind::objective_differs);
    case CertificateVerdict::not_an_optimum:
      return warning(execution::WarningKind::not_an_optimum);
    case CertificateVerdict::constraint_broken:
      if (leads_down(certificate)) return warning(execution::WarningKind::not_an_optimum);
      return {};
    default:
      return {};
  }
}

}  // namespace tunica::comparison
