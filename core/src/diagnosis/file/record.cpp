// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/file/record.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "data/quantities.hpp"

namespace tunica::diagnosis {
namespace {

using Kind = data::Quantity::Kind;

/// Stretches outside of this are no measurement.
constexpr double least_stretch = 0.05, largest_stretch = 20;

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

bool all_stretches(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return value >= least_stretch && value <= largest_stretch; });
}

/// What the file has in the column of an observable.
Kind kind_of(const experiment::TestEntry& entry, const std::vector<Observable>& observables,
             std::string_view observable) {
  for (const auto& [name, column] : entry.data.columns)
    if (const auto quantity = data::quantity_named(name, observables);
        quantity && quantity->observable->name == observable)
      return quantity->kind;
  return Kind::own;
}

const Observable* observable_named(const std::vector<Observable>& observables, std::string_view name) {
  for (const Observable& observable : observables)
    if (observable.name == name) return &observable;
  return nullptr;
}

data::Channel* channel_in(data::Dataset& data, std::string_view name) {
  for (data::Channel& channel : data.channels)
    if (channel.observable == name) return &channel;
  return nullptr;
}

data::Noise* noise_in(experiment::TestEntry& entry, std::string_view channel) {
  for (auto& [name, noise] : entry.data.noise)
    if (name == channel) return &noise;
  return nullptr;
}

/// The same σ of every row as a share of a level, times the factors.
void scale_noise(data::Noise& noise, const std::vector<double>& values, const std::vector<double>& factors) {
  std::vector<double> sd(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double level = noise.level.empty() ? values[i] : noise.level[i];
    const double relative = std::isnan(level) ? 0 : noise.relative * level;
    sd[i] = std::hypot(noise.absolute, relative) * std::abs(factors[i]);
  }
  noise.absolute = 0;
  noise.relative = 1;
  noise.level = std::move(sd);
}

}  // namespace

int cauchy_power(std::string_view measure) {
  return measure == "first_piola_kirchhoff" ? 1 : measure == "second_piola_kirchhoff" ? 2 : 0;
}

const std::vector<double>* abscissa_of(const data::Dataset& data, std::string_view name) {
  for (const auto& [observable, values] : data.abscissae)
    if (observable == name) return &values;
  return nullptr;
}

const data::Channel* channel_of(const data::Dataset& data, std::string_view name) {
  for (const data::Channel& channel : data.channels)
    if (channel.observable == name) return &channel;
  return nullptr;
}

Record::Record(experiment::Experiment experiment, const std::vector<std::string>& tests,
               const plugins::Catalogue& catalogue)
    : experiment_(std::move(experiment)), catalogue_(&catalogue) {
  for (experiment::TestEntry& entry : experiment_.tests) {
    if (std::find(tests.begin(), tests.end(), entry.name) == tests.end()) continue;
    entry.data.given = std::make_shared<const data::Dataset>(data::read_dataset(entry.data, observables(entry.name)));
    // They are sorted, and keep this order if their values change.
    entry.data.sorted = false;
  }
}

experiment::TestEntry& Record::test(std::string_view name) {
  return *std::find_if(experiment_.tests.begin(), experiment_.tests.end(),
                       [&](const experiment::TestEntry& entry) { return entry.name == name; });
}

const std::vector<Observable>& Record::observables(std::string_view test) const {
  return catalogue_->tests().find(experiment_.test(test).type)->second.factory.observables;
}

data::Dataset& Record::own_data(experiment::TestEntry& entry) {
  const auto own = std::make_shared<data::Dataset>(*entry.data.given);
  entry.data.given = own;
  return *own;
}

bool Record::set_abscissa(experiment::TestEntry& entry, std::string_view abscissa, std::vector<double> values) {
  const std::vector<Observable>& known = observables(entry.name);
  const Observable* const observable = observable_named(known, abscissa);
  const bool stretch = observable != nullptr && observable->kind == Observable::Kind::stretch;
  if (!all_finite(values) || (stretch && !all_stretches(values))) return false;
  data::Dataset& own = own_data(entry);
  for (auto& [name, old] : own.abscissae) {
    if (name != abscissa) continue;
    // A force over an area is a nominal stress P, and the data have P λ^(1 − power).
    const int power = 1 - cauchy_power(entry.data.stress_measure);
    for (data::Channel& channel : own.channels) {
      const Observable* const stress = observable_named(known, channel.observable);
      if (power == 0 || stress == nullptr || stress->kind != Observable::Kind::stress) continue;
      const Observable* const beside = data::stretch_beside(*stress, known);
      if (beside == nullptr || beside->name != abscissa || kind_of(entry, known, channel.observable) != Kind::force)
        continue;
      std::vector<double> factors(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) factors[i] = std::pow(values[i] / old[i], power);
      if (data::Noise* const noise = noise_in(entry, channel.observable)) scale_noise(*noise, channel.values, factors);
      for (std::size_t i = 0; i < values.size(); ++i) channel.values[i] *= factors[i];
      for (auto& replicate : channel.replicates)
        for (std::size_t i = 0; i < values.size(); ++i) replicate[i] *= factors[i];
    }
    old = std::move(values);
    return true;
  }
  return false;
}

bool Record::map_abscissa(std::string_view name, std::string_view abscissa, const Map& map) {
  experiment::TestEntry& entry = test(name);
  const std::vector<double>* const old = abscissa_of(*entry.data.given, abscissa);
  if (old == nullptr) return false;
  std::vector<double> values;
  for (const double value : *old) values.push_back(map(value));
  return set_abscissa(entry, abscissa, std::move(values));
}

bool Record::scale_channel(std::string_view name, std::string_view channel, const std::vector<double>& factors) {
  experiment::TestEntry& entry = test(name);
  data::Dataset& own = own_data(entry);
  data::Channel* const scaled = channel_in(own, channel);
  data::Noise* const noise = noise_in(entry, channel);
  if (scaled == nullptr || noise == nullptr || !all_finite(factors)) return false;
  scale_noise(*noise, scaled->values, factors);
  for (std::size_t i = 0; i < factors.size(); ++i) scaled->values[i] *= factors[i];
  for (auto& replicate : scaled->replicates)
    for (std::size_t i = 0; i < factors.size(); ++i) replicate[i] *= factors[i];
  return true;
}

bool Record::scale_channel(std::string_view name, std::string_view channel, double factor) {
  return scale_channel(name, channel, std::vector<double>(data(name).count, factor));
}

bool Record::shift_channel(std::string_view name, std::string_view channel, const std::vector<double>& offsets) {
  experiment::TestEntry& entry = test(name);
  data::Dataset& own = own_data(entry);
  data::Channel* const shifted = channel_in(own, channel);
  data::Noise* const noise = noise_in(entry, channel);
  if (shifted == nullptr || noise == nullptr || !all_finite(offsets)) return false;
  scale_noise(*noise, shifted->values, std::vector<double>(offsets.size(), 1.0));
  for (std::size_t i = 0; i < offsets.size(); ++i) shifted->values[i] += offsets[i];
  for (auto& replicate : shifted->replicates)
    for (std::size_t i = 0; i < offsets.size(); ++i) replicate[i] += offsets[i];
  return true;
}

bool Record::exchange_abscissae(std::string_view name, std::string_view one, std::string_view other) {
  experiment::TestEntry& entry = test(name);
  const std::vector<double>*const first = abscissa_of(*entry.data.given, one), *const second = abscissa_of(
                                                                                   *entry.data.given, other);
  if (first == nullptr || second == nullptr) return false;
  std::vector<double> kept = *first, taken = *second;
  return set_abscissa(entry, one, std::move(taken)) && set_abscissa(entry, other, std::move(kept));
}

bool Record::exchange_channels(std::string_view name, std::string_view one, std::string_view other) {
  experiment::TestEntry& entry = test(name);
  data::Dataset& own = own_data(entry);
  data::Channel *const first = channel_in(own, one), *const second = channel_in(own, other);
  data::Noise *const noise = noise_in(entry, one), *const others = noise_in(entry, other);
  if (first == nullptr || second == nullptr || noise == nullptr || others == nullptr) return false;
  std::swap(first->values, second->values);
  std::swap(first->replicates, second->replicates);
  std::swap(*noise, *others);
  return true;
}

void Record::rename_channel(std::string_view name, const std::string& channel, const std::string& to) {
  experiment::TestEntry& entry = test(name);
  if (data::Channel* const renamed = channel_in(own_data(entry), channel)) renamed->observable = to;
  for (auto& [observable, noise] : entry.data.noise)
    if (observable == channel) observable = to;
}

bool Record::scale_time(std::string_view name, double factor) {
  data::Dataset& own = own_data(test(name));
  for (double& time : own.time) time *= factor;
  return !own.time.empty();
}

}  // namespace tunica::diagnosis
