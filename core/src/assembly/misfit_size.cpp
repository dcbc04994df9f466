// SPDX-License-Identifier: Apache-2.0
#include "assembly/misfit_size.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "data/units.hpp"
#include "numerics/distributions.hpp"
#include "text/misfit_words.hpp"
#include "text/units.hpp"

namespace tunica::assembly {
namespace {

/// The noncentrality at which a noncentral χ² stays below `squares` with 5 %.
double noncentrality_bound(double squares, double freedom) {
  constexpr double level = 0.05, quantile = 1.645, plain = 2000;
  if (!(freedom > 0)) return squares;
  // For a large noncentrality the distribution is nearly Gaussian and the exact series is slow. With d = x − ν,
  //   λ − d = q √(2ν + 4λ).
  if (squares > plain) {
    const double q2 = quantile * quantile, d = squares - freedom, root = 4 * d + 4 * q2 + 2 * freedom;
    return root > 0 ? std::max(d + 2 * q2 + quantile * std::sqrt(root), 0.0) : 0;
  }
  if (!(squares > 0)) return 0;
  // Below the 5 % point of the central distribution no noncentrality is small enough.
  if (numerics::chi_squared_below(squares, freedom) < level) return 0;
  return numerics::noncentrality_at(squares, freedom, level);
}

double freedom_of(Eigen::Index rows, Eigen::Index all, std::size_t free) {
  const double share = static_cast<double>(rows) / static_cast<double>(std::max<Eigen::Index>(all, 1));
  return std::max(static_cast<double>(rows) - share * static_cast<double>(free), 0.0);
}

}  // namespace

std::vector<double> observable_ranges(const Layout& layout, const experiment::Experiment& experiment) {
  struct Extent {
    double low = INFINITY, high = -INFINITY;
  };
  std::map<std::tuple<std::string, std::string, std::string>, Extent> extents;
  const auto extent = [&](const MeasuredChannel& view) -> Extent& {
    return extents[{experiment.test(view.test).type, view.observable, view.unit}];
  };
  for (const MeasuredChannel& view : layout.channels)
    for (const double value : view.measured)
      if (!std::isnan(value)) {
        Extent& own = extent(view);
        own.low = std::min(own.low, value);
        own.high = std::max(own.high, value);
      }
  std::vector<double> ranges;
  for (const MeasuredChannel& view : layout.channels) {
    const Extent& own = extent(view);
    ranges.push_back(own.high > own.low ? own.high - own.low : std::max(std::abs(own.high), 1e-300));
  }
  return ranges;
}

double counted_rows(const MeasuredChannel& view) {
  std::set<double> steps;
  double rows = 0;
  for (std::size_t i = 0; i < view.count; ++i) {
    if (!view.fitted[i]) continue;
    if (view.is_point(i))
      steps.insert(view.abscissa[i]);
    else
      ++rows;
  }
  return rows + static_cast<double>(steps.size());
}

MisfitSize::MisfitSize(std::vector<Channel> channels) : channels_(std::move(channels)) {
  for (const Channel& one : channels_) {
    places_.push_back({rows_, static_cast<Eigen::Index>(one.noise.sd.size())});
    rows_ += places_.back().count;
  }
}

double MisfitSize::error_squares(std::size_t channel, const Eigen::VectorXd& residuals) const {
  const Channel& one = channels_[channel];
  double squares = 0, before = 0;
  for (std::size_t k = 0; k < one.noise.sd.size(); ++k) {
    const double phi = one.noise.neighbour.empty() ? 0 : one.noise.neighbour[k];
    const double r = residuals[places_[channel].first + static_cast<Eigen::Index>(k)];
    before = std::sqrt(1 - phi * phi) * r + phi * before;
    squares += std::pow(before * one.noise.sd[k] / one.range, 2);
  }
  return squares;
}

double MisfitSize::squares(double chi2, std::size_t free) const {
  return std::max(chi2 - freedom_of(rows_, rows_, free), 0.0);
}

Size MisfitSize::of(const Eigen::VectorXd& residuals, std::size_t free) const {
  double errors = 0, counted = 0;
  for (std::size_t k = 0; k < channels_.size(); ++k) {
    const auto rows = static_cast<double>(std::max<Eigen::Index>(places_[k].count, 1));
    errors += error_squares(k, residuals) * channels_[k].counted / rows;
    counted += channels_[k].counted;
  }
  const double chi2 = residuals.squaredNorm();
  const double scale = chi2 > 0 ? errors / chi2 / std::max(counted, 1.0) : 0;
  return {std::sqrt(scale * squares(residuals, free)),
          std::sqrt(scale * noncentrality_bound(chi2, freedom_of(rows_, rows_, free)))};
}

std::vector<ChannelSize> MisfitSize::channels(const Eigen::VectorXd& residuals, std::size_t free) const {
  std::vector<ChannelSize> sizes;
  for (std::size_t k = 0; k < channels_.size(); ++k) {
    const auto [first, count] = places_[k];
    const Channel& one = channels_[k];
    const double x = residuals.segment(first, count).squaredNorm();
    const double n = static_cast<double>(std::max<Eigen::Index>(count, 1)), freedom = freedom_of(count, rows_, free);
    const double scale = x > 0 ? error_squares(k, residuals) * one.range * one.range / x / n : 0;
    sizes.push_back({one.test, one.name, one.unit, one.range, std::sqrt(scale * std::max(x - freedom, 0.0)),
                     std::sqrt(scale * noncentrality_bound(x, freedom)), static_cast<std::size_t>(count), one.counted});
  }
  return sizes;
}

Eigen::VectorXd MisfitSize::ranges_over_sigma() const {
  Eigen::VectorXd ratios(rows_);
  Eigen::Index row = 0;
  for (const Channel& one : channels_)
    for (const double sd : one.noise.sd) ratios[row++] = one.range / std::max(sd, 1e-300);
  return ratios;
}

std::optional<double> stated_tolerance(const std::vector<std::pair<std::string, std::string>>& stated,
                                       const ChannelSize& channel) {
  const std::string* text = nullptr;
  for (const auto& [observable, value] : stated)
    if (observable == channel.channel || (observable.empty() && text == nullptr)) text = &value;
  if (text == nullptr) return std::nullopt;
  if (text->ends_with('%')) return data::parse_quantity(*text, "1");
  return data::parse_quantity(*text, channel.unit) / channel.range;
}

double over_rows(const std::vector<ChannelSize>& channels, const std::vector<double>& shares) {
  double sum = 0, rows = 0;
  for (std::size_t k = 0; k < channels.size(); ++k) {
    sum += channels[k].counted * shares[k] * shares[k];
    rows += channels[k].counted;
  }
  return rows > 0 ? std::sqrt(sum / rows) : 0;
}

std::string where_most(const std::vector<ChannelSize>& channels) {
  const auto worst = std::max_element(channels.begin(), channels.end(), [](const ChannelSize& a, const ChannelSize& b) {
    return a.of_range().rms < b.of_range().rms;
  });
  if (worst == channels.end()) return "";
  if (worst->rms <= 0) {
    double most = 0;
    for (const ChannelSize& one : channels) most = std::max(most, one.of_range().upper);
    return most > 0 ? fmt::format("nothing beyond noise, at most {} of the range", text::percent(most))
                    : "nothing beyond noise";
  }
  return fmt::format("most in {}, {}: {:.3g}{} ({} of the range, at most {})", worst->test, worst->channel, worst->rms,
                     text::unit_suffix(worst->unit), text::percent(worst->of_range().rms),
                     text::percent(worst->of_range().upper));
}

}  // namespace tunica::assembly
