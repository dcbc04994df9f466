// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/encompassing_noise.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "assembly/growing_noise.hpp"
#include "assembly/restricted_variance.hpp"
#include "diagnosis/evidence/base_fit.hpp"
#include "diagnosis/evidence/gross_rows.hpp"
#include "diagnosis/evidence/moderation.hpp"
#include "diagnosis/evidence/preparation.hpp"
#include "diagnosis/evidence/projection.hpp"
#include "diagnosis/evidence/smooth_columns.hpp"
#include "numerics/distributions.hpp"

namespace tunica::diagnosis {
namespace {

using assembly::known_variance;
using assembly::RestrictedVariance;
using assembly::VarianceProblem;

constexpr Eigen::Index most_signatures = 60;
constexpr double covered = 0.25;           ///< of a projected signature may stay outside the span
constexpr double few = 4;                  ///< degrees of freedom of a channel that is pooled with others
constexpr double apart = 1e-4;             ///< chance of a single row, all rows together
constexpr Eigen::Index one_alone_in = 30;  ///< may stand apart
constexpr double rounding = 1e-9;          ///< of σ is no level

/// Jacobian and smooth shapes, orthonormal.
Eigen::MatrixXd smooth_span(const Evidence& evidence, const Eigen::MatrixXd& J) {
  const Eigen::MatrixXd refit = basis(J, 1e-8), smooth = smooth_columns(evidence.curves, J.rows());
  Eigen::MatrixXd all(J.rows(), refit.cols() + smooth.cols());
  all << refit, smooth;
  return basis(std::move(all), 1e-6);
}

/// The span with the signatures of which it leaves most; lengths are those that a refit leaves.
Eigen::MatrixXd with_signatures(Eigen::MatrixXd span, const Projection& refit,
                                const std::vector<const Eigen::VectorXd*>& signatures) {
  const Eigen::Index n = span.rows(), most = std::max(span.cols(), std::min(n / 2, span.cols() + most_signatures));
  Eigen::MatrixXd left(n, static_cast<Eigen::Index>(signatures.size()));
  Eigen::Index count = 0;
  for (const Eigen::VectorXd* signature : signatures) {
    const Eigen::VectorXd projected = refit.off(*signature);
    const double length = projected.norm();
    if (length > 1e-4 * signature->norm()) left.col(count++) = projected / length;
  }
  left.conservativeResize(n, count);
  left -= span * (span.transpose() * left);
  left -= span * (span.transpose() * left);
  Eigen::Index size = span.cols();
  span.conservativeResize(n, most);
  Eigen::VectorXd lengths = left.colwise().norm();
  while (size < most && count > 0) {
    Eigen::Index k = 0;
    if (!(lengths.maxCoeff(&k) > covered)) break;
    Eigen::VectorXd unit = left.col(k).normalized();
    unit -= span.leftCols(size) * (span.leftCols(size).transpose() * unit);
    unit.normalize();
    span.col(size++) = unit;
    left -= unit * (unit.transpose() * left);
    lengths = left.colwise().norm();
  }
  return span.leftCols(size);
}

/// The open curves of the evidence, by observable, and the unit of σ of each.
struct OpenCurves {
  std::vector<std::size_t> curve;       ///< of the evidence
  std::vector<std::size_t> observable;  ///< of each open curve
  std::vector<double> unit;             ///< by observable: a σ that is common to its channels
};

OpenCurves open_curves(const Evidence& evidence, const Eigen::VectorXd& sd) {
  OpenCurves open;
  std::map<std::string, std::size_t> place;
  for (std::size_t c = 0; c < evidence.curves.size(); ++c) {
    const Curve& curve = evidence.curves[c];
    if (!curve.noise.open()) continue;
    const auto [found, is_new] = place.emplace(curve.channel + " " + curve.noise.unit, place.size());
    if (is_new) open.unit.push_back(sd.segment(curve.first, curve.count).mean());
    open.curve.push_back(c);
    open.observable.push_back(found->second);
  }
  return open;
}

/// Predicted values of the fitted rows, as the level with which noise may grow; 0 if they are only rounding beside σ.
Eigen::VectorXd levels(const Evidence& evidence, const Fit& fit, const Eigen::VectorXd& sd) {
  Eigen::VectorXd level = Eigen::VectorXd::Zero(sd.size());
  for (const Curve& curve : evidence.curves)
    for (const assembly::MeasuredChannel& view : evidence.base->layout().channels)
      if (view.test == curve.test && view.observable == curve.channel)
        for (Eigen::Index i = 0; i < curve.count; ++i) {
          const Eigen::Index row = curve.first + i;
          level[row] = view.measured[curve.rows[static_cast<std::size_t>(i)]];
          if (curve.noise.noise.correlation == 0) level[row] += fit.residuals[row] * sd[row];
          if (std::abs(level[row]) < rounding * sd[row]) level[row] = 0;
        }
  return level;
}

double range_of(const Eigen::VectorXd& level, const Curve& curve) {
  const auto own = level.segment(curve.first, curve.count);
  return own.maxCoeff() - own.minCoeff();
}

/// Rows that differ from the rest by more than chance, found one after the other; each gets its own column.
RestrictedVariance without_single_rows(VarianceProblem& problem, std::vector<bool>& alone) {
  RestrictedVariance found = restricted_variance(problem);
  const Eigen::Index n = problem.residuals.size();
  for (Eigen::Index count = 0; count < std::max<Eigen::Index>(1, n / one_alone_in); ++count) {
    Eigen::Index worst = -1;
    double least = apart / static_cast<double>(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t g = problem.group[static_cast<std::size_t>(i)];
      if (g == known_variance || alone[static_cast<std::size_t>(i)] || !(found.leverage[i] < 0.9)) continue;
      // Student's t of the row, by the variance of the others of its group.
      const double own = found.remainder[i] * found.remainder[i] / (1 - found.leverage[i]);
      const double freedom = found.freedom[g] - 1;
      if (freedom < 3 || found.at_least[g]) continue;
      const double rest = std::max((found.freedom[g] - own) / freedom, 1e-12);
      const double p = 2 * numerics::student_above(std::sqrt(own / rest), freedom);
      if (p < least) {
        least = p;
        worst = i;
      }
    }
    if (worst < 0) break;
    alone[static_cast<std::size_t>(worst)] = true;
    problem.columns.conservativeResize(n, problem.columns.cols() + 1);
    problem.columns.rightCols(1) = Eigen::VectorXd::Unit(n, worst);
    problem.columns = basis(problem.columns, 1e-8);
    found = restricted_variance(problem);
  }
  return found;
}

/// Rows with one variance for each open curve, or one for each observable that has to be pooled.
void set_groups(const Evidence& evidence, const OpenCurves& open, const std::vector<bool>& pooled,
                std::vector<std::size_t>& group_of, VarianceProblem& problem) {
  std::map<std::pair<bool, std::size_t>, std::size_t> place;
  group_of.clear();
  problem.least.clear();
  std::fill(problem.group.begin(), problem.group.end(), known_variance);
  for (std::size_t k = 0; k < open.curve.size(); ++k) {
    const Curve& curve = evidence.curves[open.curve[k]];
    const bool together = pooled[open.observable[k]];
    const std::size_t group =
        place.emplace(std::pair(together, together ? open.observable[k] : k), place.size()).first->second;
    const double least = std::pow(curve.noise.resolution / open.unit[open.observable[k]], 2);
    problem.least.resize(std::max(problem.least.size(), group + 1), 0);
    problem.least[group] = std::max(problem.least[group], least);
    group_of.push_back(group);
    for (Eigen::Index i = 0; i < curve.count; ++i) problem.group[static_cast<std::size_t>(curve.first + i)] = group;
  }
  for (const Curve& curve : evidence.curves)
    for (const GrossRow& gross : evidence.gross)
      for (Eigen::Index i = 0; i < curve.count; ++i)
        if (gross.test == curve.test && gross.channel == curve.channel &&
            gross.row == curve.rows[static_cast<std::size_t>(i)])
          problem.group[static_cast<std::size_t>(curve.first + i)] = known_variance;
}

}  // namespace

bool has_open_noise(const Evidence& evidence) {
  return std::any_of(evidence.curves.begin(), evidence.curves.end(),
                     [](const Curve& curve) { return curve.noise.open(); });
}

Eigen::VectorXd whitened_deviations(const Evidence& evidence) {
  Eigen::VectorXd sd = Eigen::VectorXd::Ones(evidence.fit.residuals.size());
  for (const Curve& curve : evidence.curves)
    for (const assembly::MeasuredChannel& view : evidence.base->layout().channels)
      if (view.test == curve.test && view.observable == curve.channel) {
        const std::vector<double> own = row_deviations(view);
        for (Eigen::Index i = 0; i < curve.count; ++i) sd[curve.first + i] = own[static_cast<std::size_t>(i)];
      }
  return sd;
}

NoiseEstimate encompassing_noise(const Evidence& evidence, const Fit& fit,
                                 const std::vector<const Eigen::VectorXd*>& signatures) {
  const Eigen::Index n = fit.residuals.size();
  const Eigen::VectorXd sd = whitened_deviations(evidence);
  const OpenCurves open = open_curves(evidence, sd);
  const Eigen::MatrixXd J = interior(fit);
  const Eigen::MatrixXd span = with_signatures(smooth_span(evidence, J), Projection(J), signatures);

  // Open channels in rows of equal σ, the unit of their observable.
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(n);
  for (std::size_t k = 0; k < open.curve.size(); ++k) {
    const Curve& curve = evidence.curves[open.curve[k]];
    scale.segment(curve.first, curve.count) = sd.segment(curve.first, curve.count) / open.unit[open.observable[k]];
  }
  VarianceProblem problem;
  problem.columns = basis(scale.asDiagonal() * span, 1e-10);
  problem.residuals = scale.cwiseProduct(fit.residuals);
  problem.group.assign(static_cast<std::size_t>(n), known_variance);
  problem.shape = Eigen::VectorXd::Ones(n);
  std::vector<std::size_t> group_of;  // of each open curve
  std::vector<bool> pooled(open.unit.size(), false), alone(static_cast<std::size_t>(n), false);
  set_groups(evidence, open, pooled, group_of, problem);
  RestrictedVariance found = without_single_rows(problem, alone);
  for (std::size_t k = 0; k < open.curve.size(); ++k)
    if (found.freedom[group_of[k]] < few) pooled[open.observable[k]] = true;
  if (std::find(pooled.begin(), pooled.end(), true) != pooled.end())
    set_groups(evidence, open, pooled, group_of, problem);

  std::vector<std::size_t> observable_of_group(problem.least.size(), 0);
  for (std::size_t k = 0; k < open.curve.size(); ++k) observable_of_group[group_of[k]] = open.observable[k];
  const Eigen::VectorXd level = levels(evidence, fit, sd);
  assembly::GrowingNoise growing = growing_noise(problem, observable_of_group, level);
  std::vector<double> largest(problem.least.size(), 0);  // level of each group, as growing_noise takes it
  for (std::size_t i = 0; i < problem.group.size(); ++i)
    if (const std::size_t g = problem.group[i]; g != known_variance)
      largest[g] = std::max(largest[g], std::abs(level[static_cast<Eigen::Index>(i)]));
  found = restricted_variance(problem);

  // Mean variances of the groups as shares of the squared ranges of their curves.
  std::vector<double> reference(problem.least.size(), 0), mean_shape(problem.least.size(), 0), rows(mean_shape);
  for (std::size_t k = 0; k < open.curve.size(); ++k)
    reference[group_of[k]] = std::max(reference[group_of[k]],
                                      range_of(level, evidence.curves[open.curve[k]]) / open.unit[open.observable[k]]);
  for (std::size_t i = 0; i < problem.group.size(); ++i)
    if (const std::size_t g = problem.group[i]; g != known_variance) {
      mean_shape[g] += problem.shape[static_cast<Eigen::Index>(i)];
      rows[g] += 1;
    }
  std::vector<double> ratios, freedom;
  for (std::size_t g = 0; g < rows.size(); ++g) {
    if (!(found.freedom[g] > least_freedom) || found.at_least[g] || !(reference[g] > 0)) continue;
    ratios.push_back(found.variance[g] * mean_shape[g] / rows[g] / (reference[g] * reference[g]));
    freedom.push_back(found.freedom[g]);
  }
  const Moderation others = moderation_of(ratios, freedom);

  NoiseEstimate estimate{evidence.noise,
                         {scale.cwiseInverse().asDiagonal() * problem.columns, problem.group, others.freedom,
                          std::move(growing.probability), std::move(growing.variance)}};
  for (std::size_t k = 0; k < open.curve.size(); ++k) {
    const Curve& curve = evidence.curves[open.curve[k]];
    const std::size_t g = group_of[k], observable = open.observable[k];
    const bool learned = found.freedom[g] > least_freedom;  // else it stays as it was
    if (!learned || found.at_least[g])
      for (Eigen::Index i = 0; i < curve.count; ++i)
        estimate.from.group[static_cast<std::size_t>(curve.first + i)] = known_variance;
    if (!learned) continue;
    const bool moderated = others.freedom > 0 && reference[g] > 0 && !found.at_least[g];
    const double of_others = others.ratio * reference[g] * reference[g] * rows[g] / std::max(mean_shape[g], 1e-300);
    const double nu = found.freedom[g], d = moderated ? others.freedom : 0;
    const double variance =
        (nu * found.variance[g] + d * of_others) / (nu + d) * open.unit[observable] * open.unit[observable];
    // Without a predicted value, relative noise has no reference.
    const double relative = largest[g] > 0 ? std::sqrt(variance * growing.share[observable]) / largest[g] : 0;
    for (NoiseSource& source : estimate.sources) {
      if (source.test != curve.test || source.channel != curve.channel) continue;
      source.kind = NoiseSource::Kind::encompassing;
      source.noise = {std::sqrt(variance), relative, 0};
      source.noise.absolute = std::max(source.noise.absolute, source.resolution);
      source.freedom = found.at_least[g] ? 0 : nu + d;
    }
  }
  return estimate;
}

Evidence restated(const Inquiry& inquiry, const Evidence& evidence, const NoiseEstimate& estimate) {
  Preparation prepared;
  prepared.run = evidence.run;
  prepared.noise = estimate.sources;
  prepared.experiment =
      without_rows(with_noise(evidence.experiment, evidence.run.tests, estimate.sources), evidence.gross);
  prepared.base = std::make_shared<const assembly::Assembly>(prepared.experiment, prepared.run, inquiry.catalogue);
  const Fit fit = least_squares(*prepared.base, all_variables(*prepared.base), evidence.fit.free,
                                *prepared.base->evaluator().make_workspace(), 200);
  if (!fit.status.ok())
    throw BaseFitFailure("diagnosis: the base model cannot be evaluated where it was fitted: " + fit.status.reason());
  SettledFit settled = settle_noise(inquiry, prepared, fit);
  Evidence found = evidence;
  found.experiment = std::move(settled.experiment);
  found.noise = estimate.sources;
  found.base = std::move(settled.base);
  found.curves = curves_of(*found.base, found.noise);
  found.fit = std::move(settled.fit);
  found.estimated = estimate.from;
  const Eigen::VectorXd to = whitened_deviations(evidence).cwiseQuotient(whitened_deviations(found));
  found.estimated.span = basis(to.asDiagonal() * estimate.from.span, 1e-10);
  return found;
}

}  // namespace tunica::diagnosis
