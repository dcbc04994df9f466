// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/noise_statement.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/channels.hpp"
#include "assembly/noise.hpp"
#include "assembly/restricted_variance.hpp"
#include "numerics/distributions.hpp"

namespace tunica::diagnosis {
namespace {

/// Deviations from the row means; the factor m/(m − 1) corrects the bias of their variance.
struct Deviations {
  std::vector<double> level, square;  ///< |row mean|, unbiased square
};

/// Twice the negative log likelihood of squares about σ² = a² + (b y)², up to a constant.
double misfit_of(const Deviations& d, double a2, double b2) {
  double sum = 0;
  for (std::size_t i = 0; i < d.square.size(); ++i) {
    const double variance = a2 + b2 * d.level[i] * d.level[i];
    sum += std::log(variance) + d.square[i] / variance;
  }
  return sum;
}

/// a² and b² of σ² = a² + (b y)²: for each ratio b²/a² on a grid the likeliest scale is a mean.
data::Noise fit_variance(const Deviations& d) {
  const auto scale = [&d](double absolute, double relative) {
    double sum = 0;
    for (std::size_t i = 0; i < d.square.size(); ++i)
      sum += d.square[i] / (absolute + relative * d.level[i] * d.level[i]);
    return sum / static_cast<double>(d.square.size());
  };
  const double constant = scale(1, 0), largest = *std::max_element(d.level.begin(), d.level.end());
  double best = misfit_of(d, constant, 0) - 4, a2 = constant, b2 = 0;  // the price of a second parameter
  for (double share = 0.1; largest > 0 && share < 100; share *= 1.3) {
    const double relative = share / (largest * largest), s = scale(1, relative);
    if (const double trial = misfit_of(d, s, s * relative); trial < best) {
      best = trial;
      a2 = s;
      b2 = s * relative;
    }
  }
  return {std::sqrt(a2), std::sqrt(b2), 0};
}

NoiseSource from_replicates(const data::Channel& channel) {
  const double m = static_cast<double>(channel.replicates.size());
  Deviations d;
  for (std::size_t i = 0; i < channel.values.size(); ++i) {
    double sum = 0;
    for (const auto& replicate : channel.replicates) sum += std::pow(replicate[i] - channel.values[i], 2);
    d.level.push_back(std::abs(channel.values[i]));
    d.square.push_back(sum / (m - 1));
  }
  // Means of equal numbers round.
  if (!(*std::max_element(d.square.begin(), d.square.end()) >
        std::pow(1e-12 * *std::max_element(d.level.begin(), d.level.end()), 2)))
    throw InputError(
        fmt::format("channel '{}': the replicates are identical and say nothing about noise. State "
                    "noise.absolute or noise.relative",
                    channel.observable));
  NoiseSource source;
  source.kind = NoiseSource::Kind::replicates;
  source.noise = fit_variance(d);
  source.freedom = (m - 1) * static_cast<double>(channel.values.size());
  return source;
}

/// Σ d_k d_{k+1} and Σ (d_k² + d_{k+1}²)/2 of the standardised deviations of a channel, over pairs of neighbours.
std::pair<double, double> neighbours(const data::Channel& channel, const data::Noise& noise) {
  double products = 0, squares = 0;
  for (const auto& replicate : channel.replicates) {
    double before = 0;
    for (std::size_t i = 0; i < replicate.size(); ++i) {
      const double sd = std::hypot(noise.absolute, noise.relative * channel.values[i]);
      const double now = (replicate[i] - channel.values[i]) / sd;
      if (i > 0) {
        products += before * now;
        squares += (before * before + now * now) / 2;
      }
      before = now;
    }
  }
  return {products, squares};
}

/// Effective degrees of freedom of the difference estimator: its n terms overlap (Gasser et al. 1986: var = 35/9 σ⁴/n).
constexpr double difference_share = 18.0 / 35;

/// The lower bound of σ: rounding to the step of the values, and the accuracy of simulations.
double resolution_of(const data::Channel& channel) {
  constexpr double exact_digits = 1e-5;
  double largest = 0;
  for (const double value : channel.values) largest = std::max(largest, std::abs(value));
  return std::max(assembly::value_step(channel.values) / std::sqrt(12.0), exact_digits * largest);
}

NoiseSource from_differences(const data::Channel& channel, const data::Dataset& dataset,
                             const std::vector<bool>& fitted, const std::string& where) {
  std::vector<double> abscissa;
  if (!dataset.abscissae.empty())
    abscissa = dataset.abscissae.front().second;
  else
    for (std::size_t i = 0; i < dataset.count; ++i) abscissa.push_back(static_cast<double>(i));
  NoiseSource source;
  source.kind = NoiseSource::Kind::differences;
  source.resolution = resolution_of(channel);
  if (!(source.resolution > 0))
    throw InputError(fmt::format("{}: every value is 0, which says nothing about noise. State noise.absolute", where));
  try {
    std::vector<std::string> warnings;
    const auto model = assembly::noise_model(channel, abscissa, fitted, where, warnings);
    source.neighbours = model.sd.front();
    source.neighbours_freedom = std::max(2.0, difference_share * static_cast<double>(model.terms));
  } catch (const InputError&) {  // no rows between neighbours, or all of them on straight lines
  }
  constexpr double guess = 1000;  // times the digits: a hundredth of the largest value
  source.noise.absolute =
      source.neighbours > 0 ? std::max(source.neighbours, source.resolution) : guess * source.resolution;
  source.freedom = std::max(2.0, source.neighbours_freedom);
  return source;
}

std::vector<bool> fitted_without(std::vector<bool> fitted, const std::vector<GrossRow>& gross, const std::string& test,
                                 const std::string& channel) {
  for (const GrossRow& row : gross)
    if (row.test == test && row.channel == channel) fitted[row.row] = false;
  return fitted;
}

/// Correlation of neighbouring deviations in one test.
struct Correlation {
  std::string test;
  double products = 0, squares = 0, freedom = 0;
  [[nodiscard]] double value() const { return products / squares; }
  [[nodiscard]] double sd() const { return 1 / std::sqrt(freedom); }
};

/// One value for all tests if they agree, as on one rig: Σ (ρ − ρ̄)²/sd² within its 95 % point.
void pool(std::vector<Correlation>& correlations) {
  if (correlations.size() < 2) return;
  Correlation all{""};
  for (const Correlation& one : correlations) {
    all.products += one.products;
    all.squares += one.squares;
    all.freedom += one.freedom;
  }
  double spread = 0;
  for (const Correlation& one : correlations) spread += std::pow((one.value() - all.value()) / one.sd(), 2);
  if (spread > numerics::chi_squared_quantile(0.95, static_cast<double>(correlations.size() - 1))) return;
  for (Correlation& one : correlations) {
    one.products = all.products;
    one.squares = all.squares;
    one.freedom = all.freedom;
  }
}

}  // namespace

std::vector<NoiseSource> noise_sources(const experiment::Experiment& experiment, const std::vector<std::string>& tests,
                                       const plugins::Catalogue& catalogue, const std::vector<GrossRow>& gross) {
  std::vector<NoiseSource> sources;
  std::vector<Correlation> correlations;  // one a test with replicates
  for (const experiment::TestEntry& entry : experiment.tests) {
    if (std::find(tests.begin(), tests.end(), entry.name) == tests.end()) continue;
    const auto& observables = catalogue.tests().find(entry.type)->second.factory.observables;
    const data::Dataset dataset = data::read_dataset(entry.data, observables);
    // Held-out rows are excluded; a test that is held out as a whole still needs its own noise.
    const std::vector<bool> fitted =
        entry.hold_out.all ? std::vector<bool>(dataset.count, true) : assembly::fitted_rows(entry, dataset);
    Correlation correlation{entry.name};
    for (const data::Channel& channel : dataset.channels) {
      NoiseSource source;
      if (channel.noise)
        source.noise = *channel.noise;
      else if (channel.replicates.size() > 1)
        source = from_replicates(channel);
      else
        source = from_differences(channel, dataset, fitted_without(fitted, gross, entry.name, channel.observable),
                                  fmt::format("test '{}', channel '{}'", entry.name, channel.observable));
      source.test = entry.name;
      source.channel = channel.observable;
      source.unit = channel.unit;
      if (source.kind == NoiseSource::Kind::replicates) {
        const auto [product, square] = neighbours(channel, source.noise);
        correlation.products += product;
        correlation.squares += square;
        correlation.freedom += source.freedom;
      }
      sources.push_back(source);
    }
    if (correlation.squares > 0) correlations.push_back(correlation);
  }
  pool(correlations);
  for (NoiseSource& source : sources)
    for (const Correlation& correlation : correlations)
      if (source.test == correlation.test && source.kind == NoiseSource::Kind::replicates &&
          std::abs(correlation.value()) > 2 * correlation.sd()) {
        source.noise.correlation = correlation.value();
        source.correlation_sd = correlation.sd() * std::sqrt(1 - correlation.value() * correlation.value());
      }
  return sources;
}

experiment::Experiment with_noise(experiment::Experiment experiment, const std::vector<std::string>& tests,
                                  const std::vector<NoiseSource>& sources) {
  for (experiment::TestEntry& entry : experiment.tests) {
    if (std::find(tests.begin(), tests.end(), entry.name) == tests.end()) continue;
    entry.data.noise.clear();
    for (const NoiseSource& source : sources)
      if (source.test == entry.name) entry.data.noise.emplace_back(source.channel, source.noise);
  }
  return experiment;
}

assembly::NoiseModel row_noise(const assembly::MeasuredChannel& view) {
  data::Noise noise = view.noise.value();
  noise.gross.clear();
  std::vector<std::string> warnings;
  return assembly::noise_model({view.observable, view.unit, view.measured, {}, noise}, view.abscissa, view.fitted,
                               view.test, warnings);
}

std::vector<double> row_deviations(const assembly::MeasuredChannel& view) { return row_noise(view).sd; }

}  // namespace tunica::diagnosis
