// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/gross_causes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "diagnosis/evidence/gross_rows.hpp"
#include "diagnosis/hypotheses/places.hpp"
#include "diagnosis/naming/causes.hpp"
#include "numerics/distributions.hpp"

namespace tunica::diagnosis {
namespace {

/// The mechanism that takes readings out; nullptr: no plugin has one.
const MechanismFactory* taker_of_rows(const plugins::Catalogue& catalogue) {
  for (const auto& [id, entry] : catalogue.mechanisms())
    if (entry.factory.stage == Stage::data && takes(entry.factory, "rows")) return &entry.factory;
  return nullptr;
}

/// How far a row lies from what an extension predicts, and its σ, in the unit of its channel.
struct RowDeviation {
  double value = 0, sd = 1;
  std::string unit;
};

std::optional<RowDeviation> deviation_of(const Refit& refit, const GrossRow& row) {
  const assembly::Assembly& assembly = refit.extension->assembly();
  std::vector<double> predicted(assembly.layout().prediction_count);
  if (!assembly.evaluator().predict(refit.fit.free, predicted, {}, *assembly.evaluator().make_workspace()).ok())
    return std::nullopt;
  for (const assembly::MeasuredChannel& view : assembly.layout().channels) {
    if (view.test != row.test || view.observable != row.channel) continue;
    const auto before = static_cast<std::size_t>(
        std::count(view.fitted.begin(), view.fitted.begin() + static_cast<std::ptrdiff_t>(row.row), true));
    return RowDeviation{view.measured[row.row] - predicted[view.offset + row.row], row_deviations(view)[before],
                        view.unit};
  }
  return std::nullopt;
}

/// Of the rows that were left out, the first of every test that has no such mechanism yet.
std::vector<GrossRow> taken_out(const std::vector<GrossRow>& gross, const Refit& refit, const std::string& outliers) {
  std::set<std::string> taken;
  for (const auto& test : refit.extension->experiment().tests)
    for (const auto& mechanism : test.mechanisms)
      if (mechanism.type == outliers) taken.insert(test.name);
  std::vector<GrossRow> rows;
  for (const GrossRow& row : gross)
    if (taken.insert(row.test).second) rows.push_back(row);
  return rows;
}

Cause cause_of_row(const GrossRow& row, const RowDeviation& far, const MechanismFactory& mechanism) {
  const double quantile = numerics::normal_quantile(0.975);
  const double value = far.value, half = quantile * far.sd;
  Cause cause;
  cause.id = mechanism.id;
  cause.place = {{row.test}, row.channel, row.row, {}, row.file_row};
  cause.group = group_of(mechanism);
  cause.amplitude = {mechanism.parameters.front().name, far.unit, value, value - half, value + half, false, true};
  cause.probability = 1;
  cause.p_value = std::erfc(std::abs(value) / far.sd / std::sqrt(2.0));
  cause.retained = 1;
  cause.gain = value * value / (far.sd * far.sd);
  cause.explanation = explanation_of(cause, mechanism);
  return cause;
}

}  // namespace

std::vector<GrossRow> still_gross(const Analysis& analysis, const Claim& claim) {
  std::vector<GrossRow> rows = analysis.evidence.gross;
  if (claim.best)
    std::erase_if(rows, [&](const GrossRow& row) {
      const auto found = deviation_of(*claim.best, row);
      return found && found->value * found->value < gross_score * found->sd * found->sd;
    });
  return rows;
}

std::vector<Cause> causes_of_rows(const Inquiry& inquiry, const Analysis& analysis, const Claim& claim) {
  const MechanismFactory* const outliers = taker_of_rows(inquiry.catalogue);
  if (!claim.best || outliers == nullptr) return {};
  std::vector<Cause> causes;
  for (const GrossRow& row : taken_out(analysis.evidence.gross, *claim.best, outliers->id))
    if (const auto far = deviation_of(*claim.best, row)) causes.push_back(cause_of_row(row, *far, *outliers));
  return causes;
}

Explanation suspected_rows(const Inquiry& inquiry, const Analysis& analysis, const std::vector<GrossRow>& rows) {
  const Hypotheses& hypotheses = analysis.hypotheses;
  Explanation found;
  found.verdict = Verdict::suspect_data;
  found.reasons.push_back({ReasonKind::gross_rows, fmt::format("nothing is wrong but {}", words_of(rows))});
  const GrossRow& worst = rows.front();
  for (const Direction& direction : hypotheses.directions) {
    const Addition& addition = hypotheses.hypothesis(direction).addition;
    if (addition.place.row != worst.row || addition.place.tests.front() != worst.test ||
        addition.place.channel != worst.channel)
      continue;
    const double amplitude = score(direction, -analysis.evidence.fit.residuals).amplitude;
    const auto refit = fit_with(inquiry, analysis, {addition}, std::array{amplitude});
    if (!refit) continue;
    Cause cause = cause_of(inquiry, analysis, *refit, 0, direction);
    cause.probability = 1;
    cause.p_value = analysis.alarm.detection.by_candidate[direction.candidate];
    found.claim.named = 1;
    found.claim.best = *refit;
    found.claim.ambiguity_set.push_back(cause.id);
    found.claim.rivals.push_back(*refit);
    found.claim.causes.push_back(std::move(cause));
    break;
  }
  return found;
}

}  // namespace tunica::diagnosis
