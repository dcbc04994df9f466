// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/gross_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/math/distributions/normal.hpp>

#include "diagnosis/causes.hpp"
#include "diagnosis/noise_statement.hpp"
#include "diagnosis/refits.hpp"

namespace tunica::diagnosis {
namespace {

constexpr const char* outliers = "outliers";  ///< the mechanism
constexpr double gross_score = 16, gross_contrast = 4;
constexpr Eigen::Index most = 30;          ///< one row in so many
constexpr std::size_t most_of_curve = 10;  ///< one of a curve in so many, or one: more are a shape

std::string words(const std::vector<GrossRow>& rows) {
  std::vector<std::string> all;
  for (const GrossRow& row : rows)
    all.push_back(
        fmt::format("row {} of {}, {} ({}; {:+.1f} σ)", row.row, row.test, row.channel, row.where, row.residual));
  return fmt::format("{}", fmt::join(all, "; "));
}

std::string quantity(double value, const std::string& unit) {
  return unit == "1" || unit.empty() ? fmt::format("{:.4g}", value) : fmt::format("{:.4g} {}", value, unit);
}

/// "stretch 1.25, measured 14 kPa": rows are counted from 0 behind `rows` and `where`, which is hard to find in a file.
std::string where(const Diagnosis& d, const Curve& curve, std::size_t row) {
  for (const assembly::MeasuredChannel& view : d.base->layout().channels)
    if (view.test == curve.test && view.observable == curve.channel)
      return fmt::format("{} {}, measured {}", view.abscissa_name, quantity(view.abscissa[row], view.abscissa_unit),
                         quantity(view.measured[row], view.unit));
  return {};
}

/// How far a residual lies from the straight line through two neighbours (on either side; at an end both on one), in
/// its standard deviations; 0 where a neighbour is almost as large, for then they are part of one shape.
double contrast(const Diagnosis& d, const Curve& curve, Eigen::Index k) {
  if (curve.count < 4) return 0;
  const auto residual = [&](Eigen::Index row) { return -d.fit.residuals[curve.first + row]; };
  const bool first = k == 0, last = k + 1 == curve.count;
  const double near = first ? residual(1) : residual(k - 1), far = first  ? residual(2)
                                                                   : last ? residual(k - 2)
                                                                          : residual(k + 1);
  const double r = residual(k), line = first || last ? 2 * near - far : (near + far) / 2;
  constexpr double alone = 2.5;
  if (std::abs(r) < alone * std::max(std::abs(near), std::abs(far))) return 0;
  return (r - line) / std::sqrt(first || last ? 6.0 : 1.5);
}

}  // namespace

std::vector<GrossRow> gross_rows(const Diagnosis& d) {
  const Eigen::MatrixXd J = interior(d.fit), Q = basis(J, 1e-8);
  std::vector<GrossRow> found;
  for (const Curve& curve : d.curves) {
    std::vector<GrossRow> of_curve;
    for (Eigen::Index k = 0; k < curve.count; ++k) {
      const Eigen::Index i = curve.first + k;
      const double r = -d.fit.residuals[i], free = 1 - Q.row(i).squaredNorm();
      if (!(free > 0.05) || r * r / free < gross_score) continue;
      if (std::abs(contrast(d, curve, k)) > gross_contrast)
        of_curve.push_back({curve.test, curve.channel, curve.rows[static_cast<std::size_t>(k)], r,
                            where(d, curve, curve.rows[static_cast<std::size_t>(k)])});
    }
    if (of_curve.size() <= std::max<std::size_t>(1, static_cast<std::size_t>(curve.count) / most_of_curve))
      found.insert(found.end(), of_curve.begin(), of_curve.end());
  }
  if (static_cast<Eigen::Index>(found.size()) > std::max<Eigen::Index>(1, d.fit.residuals.size() / most)) found.clear();
  std::stable_sort(found.begin(), found.end(),
                   [](const GrossRow& a, const GrossRow& b) { return std::abs(a.residual) > std::abs(b.residual); });
  return found;
}

void leave_out(Diagnosis& d, const std::vector<GrossRow>& rows, const plugins::Catalogue& catalogue) {
  for (auto& test : d.experiment.tests)
    for (auto& [channel, noise] : test.data.noise)
      for (const GrossRow& row : rows)
        if (row.test == test.name && row.channel == channel) noise.gross.push_back(row.row);
  d.gross.insert(d.gross.end(), rows.begin(), rows.end());
  d.base = std::make_unique<assembly::Assembly>(d.experiment, d.run, catalogue);
  d.warnings.push_back(fmt::format("left out as gross errors: {}; look at them in residuals.csv", words(rows)));
}

std::vector<GrossRow> taken_out(const Diagnosis& d) {
  std::vector<GrossRow> rows;
  std::set<std::string> taken;
  if (d.extension)
    for (const auto& test : d.extension->extended->experiment().tests)
      for (const auto& mechanism : test.mechanisms)
        if (mechanism.type == outliers) taken.insert(test.name);
  for (const GrossRow& row : d.gross)
    if (taken.insert(row.test).second) rows.push_back(row);
  return rows;
}

namespace {

/// Where a row lies from what the extension predicts, and its σ, in the unit of its channel.
struct Away {
  double value = 0, sd = 1;
  std::string unit;
};
std::optional<Away> away(const Diagnosis& d, const GrossRow& row) {
  const assembly::Assembly& assembly = d.extension->extended->assembly();
  std::vector<double> predicted(assembly.layout().prediction_count);
  if (!assembly.evaluator().predict(d.extension->fit.free, predicted, {}, *assembly.evaluator().make_workspace()).ok())
    return std::nullopt;
  for (const assembly::MeasuredChannel& view : assembly.layout().channels) {
    if (view.test != row.test || view.observable != row.channel) continue;
    const auto before = static_cast<std::size_t>(
        std::count(view.fitted.begin(), view.fitted.begin() + static_cast<std::ptrdiff_t>(row.row), true));
    return Away{view.measured[row.row] - predicted[view.offset + row.row], row_deviations(view)[before], view.unit};
  }
  return std::nullopt;
}

}  // namespace

std::vector<GrossRow> still_gross(const Diagnosis& d) {
  std::vector<GrossRow> rows = d.gross;
  if (d.extension)
    std::erase_if(rows, [&](const GrossRow& row) {
      const auto found = away(d, row);
      return found && found->value * found->value < gross_score * found->sd * found->sd;
    });
  return rows;
}

std::vector<Cause> causes_of_rows(const Diagnosis& d, const plugins::Catalogue& catalogue) {
  const auto found = catalogue.mechanisms().find(outliers);
  if (!d.extension || found == catalogue.mechanisms().end()) return {};
  const MechanismFactory& mechanism = found->second.factory;
  const double quantile = boost::math::quantile(boost::math::normal(), 0.975);
  std::vector<Cause> causes;
  for (const GrossRow& row : taken_out(d)) {
    const auto far = away(d, row);
    if (!far) continue;
    const double value = far->value, half = quantile * far->sd;
    Cause cause;
    cause.id = outliers, cause.target = {{row.test}, row.channel, row.row};
    cause.amplitude = {mechanism.parameters.front().name, far->unit, value, value - half, value + half, false, true};
    cause.probability = 1, cause.p_value = std::erfc(std::abs(value) / far->sd / std::sqrt(2.0));
    cause.retained = 1, cause.gain = value * value / (far->sd * far->sd);
    explain(cause, mechanism);
    causes.push_back(std::move(cause));
  }
  return causes;
}

void name_gross_rows(Diagnosis& d, const std::vector<GrossRow>& rows, const plugins::Catalogue& catalogue) {
  d.verdict = Verdict::suspect_data;
  d.reasons.push_back(fmt::format("nothing is wrong but {}", words(rows)));
  for (std::size_t k = 0; k < d.directions.size(); ++k) {
    const Direction& direction = d.directions[k];
    const Addition& addition = d.candidates[direction.candidate].hypotheses[direction.hypothesis].addition;
    const GrossRow& worst = rows.front();
    if (addition.target.row != worst.row || addition.target.tests.front() != worst.test ||
        addition.target.channel != worst.channel)
      continue;
    const auto refitted = fit_with(d, {addition}, std::array{score(direction, -d.fit.residuals).amplitude}, catalogue);
    if (!refitted) continue;
    Cause cause = cause_of(d, *refitted, 0, direction, catalogue);
    cause.probability = 1;
    cause.p_value = d.detection.by_candidate[direction.candidate];
    d.named = 1, d.extension = *refitted;
    d.ambiguity_set.push_back(cause.id), d.rivals.push_back(*refitted);
    d.causes.push_back(std::move(cause));
    return;
  }
}

}  // namespace tunica::diagnosis
