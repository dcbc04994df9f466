// SPDX-License-Identifier: Apache-2.0
#include "assembly/noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::assembly {
namespace {

std::vector<std::size_t> indices(const std::vector<bool>& fitted) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    if (fitted[i]) rows.push_back(i);
  }
  return rows;
}

/// Under purely relative noise, rows near zero are nearly exact. Even a small offset is a misfit of many σ there.
void warn_of_exact_rows(const std::vector<double>& sd, const std::vector<std::size_t>& rows, const std::string& unit,
                        const std::string& where, std::vector<std::string>& warnings) {
  constexpr double all_but_exact = 1e-3;
  std::vector<double> sorted = sd;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double median = sorted[sorted.size() / 2];
  const auto least = std::min_element(sd.begin(), sd.end());
  const auto exact = std::count_if(sd.begin(), sd.end(), [&](double one) { return one < all_but_exact * median; });
  if (exact == 0) return;
  const std::size_t row = rows[static_cast<std::size_t>(least - sd.begin())];
  warnings.push_back(fmt::format(
      "{}: purely relative noise makes {} almost exact: σ = {:.2g} {} in row {}, while half of the rows have more than "
      "{:.2g}. State noise.absolute, the smallest value that the rig resolves",
      where, exact == 1 ? "a row" : fmt::format("{} rows", exact), *least, unit, row, median));
}

NoiseModel stated(const data::Channel& channel, const std::vector<std::size_t>& rows, const std::string& where,
                  std::vector<std::string>& warnings) {
  const data::Noise& noise = *channel.noise;
  const double replicates = std::max(1.0, static_cast<double>(channel.replicates.size()));
  NoiseModel model;
  double smallest = std::numeric_limits<double>::infinity();
  for (const std::size_t row : rows) {
    const double y = noise.level.empty() ? channel.values[row] : noise.level[row];
    model.sd.push_back(std::hypot(noise.absolute, noise.relative * y) / std::sqrt(replicates));
    if (!std::isfinite(model.sd.back()))
      throw InputError(fmt::format("{}: the stated noise gives σ = ∞ in row {}; lower noise.absolute or noise.relative",
                                   where, row));
    if (model.sd.back() > 0) smallest = std::min(smallest, model.sd.back());
  }
  if (!std::isfinite(smallest)) {
    throw InputError(fmt::format("{}: the stated noise gives σ = 0 in every row; state noise.absolute", where));
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (model.sd[k] > 0) continue;
    model.sd[k] = smallest;
    warnings.push_back(
        fmt::format("{}: row {} measures 0, so purely relative noise gives it σ = 0; it takes the smallest σ "
                    "of the other rows, {:.4g} {}. State noise.absolute",
                    where, rows[k], smallest, channel.unit));
  }
  if (noise.absolute == 0) warn_of_exact_rows(model.sd, rows, channel.unit, where, warnings);
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (std::find(noise.gross.begin(), noise.gross.end(), rows[k]) != noise.gross.end()) model.sd[k] *= 1000;
  if (noise.correlation == 0) return model;
  if (!(std::abs(noise.correlation) < 1)) {
    throw InputError(fmt::format(
        "{}: noise.correlation {} is not between -1 and 1; correct it, or leave it out where rows err independently",
        where, noise.correlation));
  }
  model.neighbour.assign(rows.size(), 0);
  for (std::size_t k = 1; k < rows.size(); ++k) {
    model.neighbour[k] = std::pow(noise.correlation, static_cast<double>(rows[k] - rows[k - 1]));
  }
  return model;
}

/// Variance of a row's value from the replicates, or NaN.
double replicate_variance(const data::Channel& channel, const std::vector<std::size_t>& rows) {
  const auto replicates = static_cast<double>(channel.replicates.size());
  double sum = 0;
  for (const std::size_t row : rows) {
    for (const auto& replicate : channel.replicates) sum += std::pow(replicate[row] - channel.values[row], 2);
  }
  return sum / (static_cast<double>(rows.size()) * (replicates - 1)) / replicates;
}

/// The difference estimator of the header, and how many rows lie strictly between fitted neighbours.
std::pair<double, std::size_t> difference_variance(const data::Channel& channel, std::span<const double> x,
                                                   const std::vector<bool>& fitted) {
  const auto& y = channel.values;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 1; i + 1 < y.size(); ++i) {
    if (!(fitted[i - 1] && fitted[i] && fitted[i + 1])) continue;
    if (!((x[i] - x[i - 1]) * (x[i + 1] - x[i]) > 0)) continue;
    const double a = (x[i + 1] - x[i]) / (x[i + 1] - x[i - 1]), b = 1 - a;
    sum += std::pow(a * y[i - 1] + b * y[i + 1] - y[i], 2) / (a * a + b * b + 1);
    ++count;
  }
  return {count == 0 ? 0 : sum / static_cast<double>(count), count};
}

}  // namespace

NoiseModel noise_model(const data::Channel& channel, std::span<const double> abscissa, const std::vector<bool>& fitted,
                       const std::string& where, std::vector<std::string>& warnings) {
  const std::vector<std::size_t> rows = indices(fitted);
  if (channel.noise) return stated(channel, rows, where, warnings);
  const bool replicated = channel.replicates.size() > 1;
  const auto [variance, terms] = replicated ? std::pair(replicate_variance(channel, rows), rows.size())
                                            : difference_variance(channel, abscissa, fitted);
  if (!(variance > 0)) {
    throw InputError(
        fmt::format("{}: no noise is stated and none can be estimated from the data; state noise.absolute or "
                    "noise.relative",
                    where));
  }
  const double sd = std::sqrt(variance);
  warnings.push_back(fmt::format("{}: no noise is stated; σ = {:.4g} {} was estimated from {}", where, sd, channel.unit,
                                 replicated ? "the replicates" : "differences of neighbouring rows"));
  return {std::vector<double>(rows.size(), sd), {}, true, terms};
}

}  // namespace tunica::assembly
