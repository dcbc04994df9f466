// SPDX-License-Identifier: Apache-2.0
#include "posterior/bands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "numerics/distributions.hpp"
#include "plugins/calls.hpp"
#include "posterior/convergence.hpp"
#include "posterior/counter_random.hpp"

namespace tunica::posterior {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_numbers = 20'000'000;  ///< predictions that are kept at a time
constexpr std::size_t fewest_draws = 200;

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// σ of every prediction as if it were measured; NaN if it is unknown. The statement of a channel is multiplied by
/// what its fitted rows have of it: less for means of replicates, more where χ² contradicts it.
std::vector<double> deviations(const Question& question) {
  const assembly::Layout& layout = question.assembly.layout();
  std::vector<double> sd(layout.prediction_count, unknown);
  for (const auto& row : question.whitening.rows) sd[row.prediction] = row.sd;
  for (const auto& view : layout.channels) {
    const auto said = [&](std::size_t row) {
      const double y = view.noise->level.empty() ? view.measured[row] : view.noise->level[row];
      return std::hypot(view.noise->absolute, view.noise->relative * y);
    };
    std::vector<double> known, shares;
    for (std::size_t row = 0; row < view.count; ++row)
      if (const double one = sd[view.offset + row]; std::isfinite(one)) {
        known.push_back(one);
        if (view.noise && said(row) > 0) shares.push_back(one / said(row));
      }
    for (std::size_t row = 0; row < view.count; ++row) {
      if (!view.held_out(row)) continue;
      double& one = sd[view.offset + row];
      if (view.noise)
        one = said(row) * (shares.empty() ? question.whitening.widening : median_of(shares));
      else if (!known.empty())
        one = median_of(known);
      if (!(one > 0)) one = unknown;
    }
  }
  return sd;
}

struct Curve {
  std::vector<double> predictions;  ///< empty: could not be simulated
  double factor = 1;                ///< s
  std::optional<Discrepancy::Misfit> misfit = {};
};

/// s of a draw, or what its discrepancy is.
void add_errors(const Question& question, std::span<const double> free, CounterRandom random, Curve& curve) {
  if (question.factor_known && !question.discrepancy) return;
  std::vector<double> residuals(question.whitening.count());
  assembly::whitened_residuals(question.whitening, free, curve.predictions, {}, residuals, {});
  const Eigen::Map<const Eigen::VectorXd> r(residuals.data(),
                                            static_cast<Eigen::Index>(question.whitening.rows.size()));
  if (question.discrepancy) {
    curve.misfit = question.discrepancy->draw(r, random);
    curve.factor = curve.misfit->factor;
  } else {
    curve.factor = std::sqrt(r.squaredNorm() / numerics::chi_squared_quantile(random.uniform(), question.rows()));
  }
}

Bands::Misfit sizes_of(const std::vector<Curve>& curves) {
  std::vector<double> sizes;
  for (const Curve& curve : curves) sizes.push_back(curve.misfit->size);
  std::sort(sizes.begin(), sizes.end());
  return {quantile_of(sizes, 0.025), quantile_of(sizes, 0.5), quantile_of(sizes, 0.975),
          static_cast<double>(std::count(sizes.begin(), sizes.end(), 0.0)) / static_cast<double>(sizes.size())};
}

/// The c at which the mean of Φ((c − ŷ_k)/w_k) is `share`, by Newton's method within a bracket.
double mixture_quantile(const std::vector<double>& centres, const std::vector<double>& widths, double share) {
  double low = std::numeric_limits<double>::infinity(), high = -low, narrowest = low;
  for (std::size_t k = 0; k < centres.size(); ++k) {
    low = std::min(low, centres[k] - 8 * widths[k]);
    high = std::max(high, centres[k] + 8 * widths[k]);
    narrowest = std::min(narrowest, widths[k]);
  }
  double c = 0.5 * (low + high);
  for (int step = 0; step < 100 && high - low > 1e-6 * narrowest; ++step) {
    double below = 0, density = 0;
    for (std::size_t k = 0; k < centres.size(); ++k) {
      const double z = (c - centres[k]) / widths[k];
      below += 0.5 * std::erfc(-z / std::numbers::sqrt2);
      density += std::exp(-0.5 * z * z) / widths[k];
    }
    const auto count = static_cast<double>(centres.size());
    const double error = below / count - share;
    (error > 0 ? high : low) = c;
    const double next = c - error * count * std::sqrt(2 * std::numbers::pi) / density;
    if (std::abs(next - c) < 1e-6 * narrowest) return next;
    c = next > low && next < high ? next : 0.5 * (low + high);
  }
  return c;
}

}  // namespace

Bands bands(const Question& question, const std::vector<Chain>& chains, const std::function<bool()>& is_over,
            bool& complete) {
  const assembly::Layout& layout = question.assembly.layout();
  const std::size_t rows = layout.prediction_count, each = chains.front().draws(), all = chains.size() * each;
  const std::size_t room = std::max(fewest_draws, most_numbers / std::max<std::size_t>(1, rows));
  const std::size_t count = std::min({most_band_draws, all, room});
  std::vector<Curve> curves(count);
  const plugins::Clock::time_point deadline = plugins::deadline_of_this_thread();
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
    const plugins::Call part{nullptr, "analysis", nullptr, nullptr, deadline};
    const plugins::CallScope scope(part);
    if (is_over()) return;
    const std::size_t place = k * all / count;
    const Chain& chain = chains[place / each];
    const std::span<const double> free(&chain.free[place % each * chain.parameters], chain.parameters);
    const auto workspace = question.assembly.evaluator().make_workspace();
    Curve& curve = curves[k];
    curve.predictions.resize(rows);
    if (!question.assembly.evaluator().predict(free, curve.predictions, {}, *workspace).ok())
      return curve.predictions.clear();
    add_errors(question, free, CounterRandom(k), curve);
  });
  if (is_over()) complete = false;
  std::erase_if(curves, [](const Curve& curve) { return curve.predictions.empty(); });
  Bands found;
  for (auto* const one : {&found.lower, &found.median, &found.upper, &found.lowest_measured, &found.highest_measured})
    one->assign(rows, unknown);
  if (curves.empty() || !complete) return found;
  if (question.discrepancy) found.misfit = sizes_of(curves);
  const std::vector<double> sd = deviations(question);
  tbb::parallel_for(std::size_t{0}, rows, [&](std::size_t row) {
    std::vector<double> centres, widths;
    for (const Curve& curve : curves) {
      centres.push_back(curve.predictions[row]);
      widths.push_back(curve.factor * sd[row]);
    }
    std::sort(centres.begin(), centres.end());
    found.lower[row] = quantile_of(centres, 0.025);
    found.median[row] = quantile_of(centres, 0.5);
    found.upper[row] = quantile_of(centres, 0.975);
    if (!std::isfinite(sd[row])) return;
    for (std::size_t k = 0; k < curves.size(); ++k) {
      centres[k] = curves[k].predictions[row];
      if (!curves[k].misfit) continue;
      centres[k] += curves[k].misfit->mean[row];
      widths[k] = std::hypot(widths[k], curves[k].misfit->sd[row]);
    }
    found.lowest_measured[row] = mixture_quantile(centres, widths, 0.025);
    found.highest_measured[row] = mixture_quantile(centres, widths, 0.975);
  });
  for (const auto& view : layout.channels)
    for (std::size_t row = 0; row < view.count; ++row) {
      const std::size_t at = view.offset + row;
      if (!view.held_out(row) || !std::isfinite(found.lowest_measured[at])) continue;
      ++found.held_out.rows;
      found.held_out.inside +=
          view.measured[row] >= found.lowest_measured[at] && view.measured[row] <= found.highest_measured[at] ? 1 : 0;
    }
  return found;
}

}  // namespace tunica::posterior
