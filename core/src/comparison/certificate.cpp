// SPDX-License-Identifier: Apache-2.0
#include "comparison/certificate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "comparison/statistics.hpp"
#include "text/lists.hpp"

namespace tunica::comparison {

namespace {

/// Relative drop of the objective that a success does not allow.
constexpr double not_an_optimum = 1e-3;

std::string fresh_words(const Certificate& certificate) {
  if (!certificate.fresh) return fmt::format("not evaluated again in a fresh process ({})", certificate.missing);
  const auto& fresh = *certificate.fresh;
  if (fresh.around.status.kind() == Status::Kind::failed)
    return fmt::format("it FAILED in a fresh process: {}", fresh.around.status.reason());
  if (fresh.identical) return "re-evaluated identically in a fresh process";
  const bool rounding = calibration::same_objective(fresh.around.objective, fresh.around.objective - fresh.difference);
  return fmt::format("re-evaluated in a fresh process, {} by {:.2g}",
                     rounding ? "equal to rounding: the objective differs" : "where THE OBJECTIVE DIFFERS",
                     fresh.difference);
}

std::string neighbour_words(const calibration::Neighbourhood& around, bool ended_at_target) {
  if (!around.lowest) return "no neighbour could be compared";
  if (!around.better) return "no better neighbour";
  const double drop = around.objective - around.lowest->objective;
  const double share = drop / std::abs(around.objective);
  const char* const finding = share <= not_an_optimum ? ""
                              : ended_at_target       ? "stopped at its target, not at the optimum: "
                                                      : "NOT AN OPTIMUM: ";
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

}  // namespace

void add_agreement(const calibration::Assembly& assembly, const execution::RunResult& result, double best,
                   std::optional<double> target, Certificate& certificate) {
  const auto& parameters = assembly.parameters();
  double threshold = success_threshold({}, best);
  if (target && best <= *target) threshold = std::max(threshold, *target);
  std::vector<double> low, high, unit(parameters.size()), unit_low, unit_high;
  certificate.realisations = result.realisations.size();
  for (const auto& realisation : result.realisations) {
    if (!realisation.best.feasible() || realisation.best.objective > threshold) continue;
    const auto& values = realisation.best.parameters;
    assembly.to_unit(values, unit);
    if (certificate.agreeing++ == 0) low = high = values, unit_low = unit_high = unit;
    for (std::size_t j = 0; j < values.size(); ++j) {
      low[j] = std::min(low[j], values[j]), high[j] = std::max(high[j], values[j]);
      unit_low[j] = std::min(unit_low[j], unit[j]), unit_high[j] = std::max(unit_high[j], unit[j]);
    }
  }
  for (std::size_t j = 0; j < low.size(); ++j)
    certificate.spread.push_back({parameters[j].name, parameters[j].unit, low[j], high[j], unit_high[j] - unit_low[j]});
}

bool alarming(const Certificate& certificate) {
  if (!certificate.fresh) return false;
  const auto& around = certificate.fresh->around;
  if (around.status.kind() == Status::Kind::failed) return true;
  if (!calibration::same_objective(around.objective, around.objective - certificate.fresh->difference)) return true;
  return !certificate.ended_at_target && around.better &&
         around.objective - around.lowest->objective > not_an_optimum * std::abs(around.objective);
}

std::string verdict(const Certificate& certificate) {
  std::vector<std::string> parts{fresh_words(certificate)};
  const bool known = certificate.fresh && certificate.fresh->around.status.kind() != Status::Kind::failed;
  if (known && certificate.fresh->around.status.ok())
    parts.push_back(neighbour_words(certificate.fresh->around, certificate.ended_at_target));
  if (known && !certificate.fresh->around.status.ok()) parts.emplace_back("it BREAKS A CONSTRAINT");
  if (certificate.realisations > 1)
    parts.push_back(fmt::format("{} of {} realisations agree{}", certificate.agreeing, certificate.realisations,
                                spread_words(certificate)));
  parts.push_back(certificate.at_bounds.empty()
                      ? std::string("no bound active")
                      : fmt::format("{} at {}", fmt::join(certificate.at_bounds, ", "),
                                    certificate.at_bounds.size() == 1 ? "its bound" : "their bounds"));
  if (known && certificate.fresh->around.constraints > 0)
    parts.push_back(fmt::format("{} of {} active", certificate.fresh->around.active_constraints,
                                text::counted(certificate.fresh->around.constraints, "constraint", "constraints")));
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace tunica::comparison
