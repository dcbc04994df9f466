// SPDX-License-Identifier: Apache-2.0
#include "assembly/whitening.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/misfit.hpp"
#include "numerics/distributions.hpp"

namespace tunica::assembly {
namespace {

/// A channel of weight 0 is predicted, but does not inform the parameters.
bool counts(const MeasuredChannel& view) { return view.weight > 0; }

std::size_t fitted_rows(const MeasuredChannel& view) {
  return static_cast<std::size_t>(std::count(view.fitted.begin(), view.fitted.end(), true));
}

/// σ of the rows of a channel without stated noise: the σ of the fit, times √(Σ(e/σ)²/(count (1 − n/rows))).
std::vector<double> deviations_about(const MeasuredChannel& view, std::span<const double> measured,
                                     std::span<const double> predictions, double share_left) {
  std::vector<double> sd = view.sigma.rows.sd;
  double squares = 0, largest = 0;
  for (std::size_t i = 0, k = 0; i < view.count; ++i) {
    if (!view.fitted[i]) continue;
    squares += std::pow((predictions[view.offset + i] - measured[i]) / sd[k++], 2);
    largest = std::max(largest, std::abs(measured[i]));
  }
  const double freedom = std::max(1.0, static_cast<double>(sd.size()) * share_left);
  for (double& one : sd) one = std::max({one * std::sqrt(squares / freedom), 1e-9 * largest, 1e-300});
  return sd;
}

}  // namespace

double Whitening::quantile(std::size_t parameters) const {
  const double freedom = static_cast<double>(count()) - static_cast<double>(parameters);
  return (stated && widening == 1) || freedom < 1 ? numerics::normal_quantile(0.975)
                                                  : numerics::student_quantile(0.975, freedom);
}

Whitening whitening(const Assembly& assembly, std::span<const double> predictions, std::span<const double> measured,
                    bool believe) {
  Whitening result;
  std::size_t fitted = 0, silent = 0;  // rows that count, rows of weight 0
  for (const MeasuredChannel& view : assembly.layout().channels) (counts(view) ? fitted : silent) += fitted_rows(view);
  result.first.push_back(0);
  if (fitted == 0) return result;
  if (const Misfit stated = misfit(assembly, NoiseKind::stated, predictions, measured);
      !believe && stated.contradicts())
    result.widening = stated.times();
  const double share_left = 1 - static_cast<double>(assembly.layout().parameters.size()) / static_cast<double>(fitted);
  for (const MeasuredChannel& view : assembly.layout().channels) {
    if (!counts(view) || fitted_rows(view) == 0) continue;
    const bool stated = view.sigma.stated();
    result.stated = result.stated && stated;
    const std::span<const double> values =
        measured.empty() ? std::span<const double>(view.measured) : measured.subspan(view.offset, view.count);
    const std::vector<double>& neighbours = view.sigma.rows.neighbour;
    std::vector<double> sd = stated ? view.sigma.rows.sd : deviations_about(view, values, predictions, share_left);
    if (stated)
      for (double& one : sd) one *= result.widening;
    std::size_t k = 0;
    for (std::size_t i = 0; i < view.count; ++i) {
      if (!view.fitted[i]) continue;
      const double neighbour = k == 0 || neighbours.empty() ? 0 : neighbours[k];
      result.rows.push_back({view.offset + i, values[i], sd[k], neighbour});
      ++k;
    }
    result.first.push_back(result.rows.size());
  }
  if (assembly.layout().residual_count == fitted + silent) return result;
  for (std::size_t j = 0; j < assembly.layout().parameters.size(); ++j)
    if (const auto& prior = assembly.layout().parameters[j].prior) result.priors.push_back({j, prior->mean, prior->sd});
  return result;
}

void whitened_residuals(const Whitening& whitening, std::span<const double> free, std::span<const double> predictions,
                        std::span<const double> prediction_jacobian, std::span<double> residuals,
                        std::span<double> jacobian) {
  const std::size_t n = free.size();
  for (std::size_t k = 0; k < whitening.rows.size(); ++k) {
    const Whitening::Row& row = whitening.rows[k];
    const double innovation = std::sqrt(1 - row.neighbour * row.neighbour), own = 1 / (row.sd * innovation);
    if (!residuals.empty()) residuals[k] = own * (predictions[row.prediction] - row.measured);
    if (!jacobian.empty())
      for (std::size_t j = 0; j < n; ++j) jacobian[k * n + j] = own * prediction_jacobian[row.prediction * n + j];
    if (row.neighbour == 0) continue;
    const Whitening::Row& before = whitening.rows[k - 1];
    const double previous = row.neighbour / (before.sd * innovation);
    if (!residuals.empty()) residuals[k] -= previous * (predictions[before.prediction] - before.measured);
    if (!jacobian.empty())
      for (std::size_t j = 0; j < n; ++j)
        jacobian[k * n + j] -= previous * prediction_jacobian[before.prediction * n + j];
  }
  std::size_t at = whitening.rows.size();
  for (const Whitening::Prior& prior : whitening.priors) {
    if (!residuals.empty()) residuals[at] = (free[prior.index] - prior.mean) / prior.sd;
    if (!jacobian.empty()) {
      std::fill_n(&jacobian[at * n], n, 0.0);
      jacobian[at * n + prior.index] = 1 / prior.sd;
    }
    ++at;
  }
}

}  // namespace tunica::assembly
