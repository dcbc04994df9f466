// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/misfit.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tunica::diagnosis {
namespace {

/// Rows of a window on either side of its centre: a fifth of the curve in all.
Eigen::Index half_window(Eigen::Index rows) { return std::max<Eigen::Index>(1, rows / 10); }

/// Means over windows along the rows of a curve, in standard errors of such a mean.
std::vector<double> window_means(const Eigen::VectorXd& r) {
  const Eigen::Index n = r.size(), half = half_window(n);
  std::vector<double> means;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index from = std::max<Eigen::Index>(0, i - half), to = std::min(n, i + half + 1);
    means.push_back(r.segment(from, to - from).sum() / std::sqrt(static_cast<double>(to - from)));
  }
  return means;
}

/// The rows of the windows around the largest mean over which it keeps its sign and at least half its size.
std::pair<std::size_t, std::size_t> region(const std::vector<double>& means) {
  const auto worst =
      std::max_element(means.begin(), means.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  auto first = static_cast<std::size_t>(worst - means.begin()), last = first;
  const auto alike = [&](std::size_t k) { return means[k] * *worst > 0 && std::abs(means[k]) > std::abs(*worst) / 2; };
  while (first > 0 && alike(first - 1)) --first;
  while (last + 1 < means.size() && alike(last + 1)) ++last;
  const auto half = static_cast<std::size_t>(half_window(static_cast<Eigen::Index>(means.size())));
  return {first - std::min(first, half), std::min(last + half, means.size() - 1)};
}

/// Where a field is missed most, and by how much in all.
Misfit described_field(const Evidence& evidence, const Curve& curve, const assembly::MeasuredChannel& view, double p) {
  const Eigen::VectorXd r = evidence.fit.residuals.segment(curve.first, curve.count);
  Eigen::Index worst = 0;
  r.cwiseAbs().maxCoeff(&worst);
  const std::size_t row = curve.rows[static_cast<std::size_t>(worst)];
  const auto* const steps = view.coordinate("step");
  const double step = steps == nullptr ? view.abscissa[row] : (*steps)[row];
  Misfit misfit{curve.test, curve.channel, {}, p, step, step};
  misfit.where = fmt::format(
      "{:.1f} σ on average over {} points, most at {} {:.4g}, x {:.4g} mm, y {:.4g} mm: measured lies {} the "
      "prediction "
      "by {:.1f} σ",
      std::sqrt(r.squaredNorm() / static_cast<double>(r.size())), curve.count,
      steps == nullptr ? view.abscissa_name : "step", step, (*view.coordinate("x"))[row], (*view.coordinate("y"))[row],
      r[worst] < 0 ? "above" : "below", std::abs(r[worst]));
  return misfit;
}

/// The region of a curve where `shape`, in σ, is largest, and what the residuals do there.
Misfit described(const Evidence& evidence, const Curve& curve, const Eigen::VectorXd& shape, double p) {
  const auto& channels = evidence.base->layout().channels;
  const auto view = std::find_if(channels.begin(), channels.end(), [&](const assembly::MeasuredChannel& one) {
    return one.test == curve.test && one.observable == curve.channel;
  });
  if (view->is_point(curve.rows.front())) return described_field(evidence, curve, *view, p);
  const auto [first, last] = region(window_means(shape));
  assembly::DrawnOver over = view->drawn_over;
  // What was measured beside a field has no place in it.
  if (view->is_field()) over = {view->abscissa_name, view->abscissa_unit, view->abscissa, {}};
  double from = INFINITY, to = -INFINITY;
  for (std::size_t k = first; k <= last; ++k) {
    from = std::min(from, over.values[curve.rows[k]]);
    to = std::max(to, over.values[curve.rows[k]]);
  }
  const bool within_one =
      !over.curves.empty() && over.curves[curve.rows[first]] == over.curves[curve.rows[last]];  // curves are contiguous
  const double mean =
      -evidence.fit.residuals
           .segment(curve.first + static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(last - first + 1))
           .mean();
  Misfit misfit{curve.test, curve.channel, {}, p, from, to};
  std::string reach = fmt::format("{:.4g}", from);
  if (std::string end = fmt::format("{:.4g}", to); end != reach) reach += " … " + end;  // held: there is one value
  misfit.where = fmt::format("{} {}{}{}: measured lies {} the prediction by {:.1f} σ on average over {} rows",
                             over.name, reach, over.unit == "1" || over.unit.empty() ? "" : " " + over.unit,
                             within_one ? " at " + over.curves[curve.rows[first]] : "", mean > 0 ? "above" : "below",
                             std::abs(mean), last - first + 1);
  return misfit;
}

}  // namespace

std::vector<Misfit> misfits(const Inquiry& inquiry, const Analysis& analysis, const Claim& claim) {
  const Evidence& evidence = analysis.evidence;
  const Fit& fit = evidence.fit;
  std::vector<std::size_t> order;
  for (std::size_t c = 0; c < evidence.curves.size(); ++c) order.push_back(c);
  const std::vector<double>& p = analysis.alarm.detection.by_curve;
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return p[a] < p[b]; });
  std::vector<Misfit> found;
  for (std::size_t place = 0; place < order.size(); ++place) {
    const Curve& curve = evidence.curves[order[place]];
    if (p[order[place]] * static_cast<double>(order.size() - place) > inquiry.request.alpha) break;
    found.push_back(described(evidence, curve, -fit.residuals.segment(curve.first, curve.count), p[order[place]]));
  }
  if (!found.empty() || !analysis.alarm.raised || !claim.best) return found;
  // No single curve is significant: take the curve of which the cause explains most, and the region.
  const Eigen::VectorXd change = claim.best->fit.residuals - fit.residuals;
  const auto explained = [&](std::size_t c) {
    const Curve& curve = evidence.curves[c];
    return fit.residuals.segment(curve.first, curve.count).squaredNorm() -
           claim.best->fit.residuals.segment(curve.first, curve.count).squaredNorm();
  };
  const std::size_t most =
      *std::max_element(order.begin(), order.end(), [&](auto a, auto b) { return explained(a) < explained(b); });
  const Curve& curve = evidence.curves[most];
  found.push_back(described(evidence, curve, change.segment(curve.first, curve.count), p[most]));
  return found;
}

}  // namespace tunica::diagnosis
