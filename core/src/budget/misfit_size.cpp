// SPDX-License-Identifier: Apache-2.0
#include "budget/misfit_size.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/non_central_chi_squared.hpp>

namespace tunica::budget {
namespace {

/// The noncentrality at which a noncentral χ² stays below `squares` with 5 %.
double noncentrality_bound(double squares, double freedom) {
  constexpr double level = 0.05, quantile = 1.645, plain = 2000;
  if (!(freedom > 0)) return squares;
  // √χ² is nearly Gaussian with variance 1 where it is large; the exact series is slow there.
  if (squares > plain) return std::max(std::pow(std::sqrt(squares) + quantile, 2) - freedom, 0.0);
  if (!(squares > 0)) return 0;
  // Below the 5 % point of the central distribution no noncentrality is small enough.
  const boost::math::non_central_chi_squared_distribution<double> central(freedom, 0);
  if (boost::math::cdf(central, squares) < level) return 0;
  return boost::math::non_central_chi_squared_distribution<double>::find_non_centrality(freedom, squares, level);
}

double freedom_of(const diagnosis::Fit& fit, Eigen::Index rows, Eigen::Index all) {
  const auto free = std::count(fit.at_bound.begin(), fit.at_bound.end(), false);
  const double share = static_cast<double>(rows) / static_cast<double>(std::max<Eigen::Index>(all, 1));
  return std::max(static_cast<double>(rows) - share * static_cast<double>(free), 0.0);
}

}  // namespace

MisfitSize::MisfitSize(const diagnosis::Evidence& evidence) : rows_(evidence.fit.residuals.size()) {
  for (const diagnosis::Curve& curve : evidence.curves) {
    const auto& views = evidence.base->layout().channels;
    const auto view = std::find_if(views.begin(), views.end(), [&](const assembly::MeasuredChannel& one) {
      return one.test == curve.test && one.observable == curve.channel;
    });
    double low = INFINITY, high = -INFINITY;
    for (const double value : view->measured)
      if (!std::isnan(value)) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
    const double range = high > low ? high - low : std::max(std::abs(high), 1e-300);
    const std::vector<double> deviations = diagnosis::row_deviations(*view);
    channels_.push_back(
        {curve.test, curve.channel, view->unit, range, curve.first, curve.count,
         Eigen::Map<const Eigen::VectorXd>(deviations.data(), static_cast<Eigen::Index>(deviations.size()))});
  }
}

double MisfitSize::squares(const diagnosis::Fit& fit) const {
  return std::max(fit.chi2 - freedom_of(fit, rows_, rows_), 0.0);
}

Size MisfitSize::of(const diagnosis::Fit& fit) const {
  double weighed = 0;  // Σ (σ r/range)²
  for (const Channel& one : channels_)
    weighed += (fit.residuals.segment(one.first, one.count).cwiseProduct(one.sigma) / one.range).squaredNorm();
  const double n = static_cast<double>(std::max<Eigen::Index>(rows_, 1));
  const double scale = fit.chi2 > 0 ? weighed / fit.chi2 / n : 0;
  return {std::sqrt(scale * squares(fit)),
          std::sqrt(scale * noncentrality_bound(fit.chi2, freedom_of(fit, rows_, rows_)))};
}

std::vector<ChannelSize> MisfitSize::channels(const diagnosis::Fit& fit) const {
  std::vector<ChannelSize> sizes;
  for (const Channel& one : channels_) {
    const auto r = fit.residuals.segment(one.first, one.count);
    const double x = r.squaredNorm(), n = static_cast<double>(std::max<Eigen::Index>(one.count, 1));
    const double scale = x > 0 ? r.cwiseProduct(one.sigma).squaredNorm() / x / n : 0;
    const double freedom = freedom_of(fit, one.count, rows_);
    sizes.push_back({one.test, one.name, one.unit, one.range, std::sqrt(scale * std::max(x - freedom, 0.0)),
                     std::sqrt(scale * noncentrality_bound(x, freedom)), static_cast<std::size_t>(one.count)});
  }
  return sizes;
}

Eigen::VectorXd MisfitSize::ranges_over_sigma() const {
  Eigen::VectorXd ratios = Eigen::VectorXd::Ones(rows_);
  for (const Channel& one : channels_)
    ratios.segment(one.first, one.count) = (one.range / one.sigma.array().max(1e-300)).matrix();
  return ratios;
}

}  // namespace tunica::budget
