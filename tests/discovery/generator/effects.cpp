// SPDX-License-Identifier: Apache-2.0
#include "effects.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace blind {
namespace {

std::size_t one_of(std::mt19937_64& random, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

/// Largest absolute value of a channel of the bare specimen.
double height(const Specimen& specimen, std::size_t channel) {
  const auto y = observe(specimen.protocol, {specimen.tissue, {}, {}, {}, {}});
  const Channel layout = channels(specimen.protocol)[channel];
  double most = 0;
  for (std::size_t i = layout.first; i < layout.first + layout.count; ++i) most = std::max(most, std::abs(y[i]));
  return most;
}

}  // namespace

double HiddenEffect::amplitude() const {
  return effect->logarithmic ? effect->null * std::exp(sign * distance) : effect->null + sign * distance;
}

const Effect& effect(const std::string& id) {
  std::string known;
  for (const auto* list : {&catalogue(), &outsiders()}) {
    for (const Effect& one : *list) {
      if (one.id == id) return one;
      known += (known.empty() ? "" : ", ") + one.id;
    }
  }
  throw std::invalid_argument("no effect '" + id + "'; known: " + known);
}

HiddenEffect draw(const Effect& effect, const Specimen& specimen, std::mt19937_64& random) {
  using enum Effect::Where;
  HiddenEffect made{.effect = &effect, .target = {}, .nuisance = {}};
  for (const Effect::Nuisance& one : effect.nuisances)
    made.nuisance[one.name] =
        one.choices.empty() ? between_log(random, one.low, one.high) : one.choices[one_of(random, one.choices.size())];
  if (effect.low < effect.null && !effect.even) made.sign = one_of(random, 2) == 0 ? 1 : -1;
  const double end = made.sign > 0 ? effect.high : effect.low;
  made.largest = effect.logarithmic ? std::abs(std::log(end / effect.null)) : std::abs(end - effect.null);
  switch (effect.where) {
    case material:
    case all_tubes:
      break;
    case tube_or_all:  // half of them in one tube
      if (one_of(random, 2) == 0) made.target.tube = one_of(random, tube_count);
      break;
    case strip:
      made.target.strip = one_of(random, strip_count);
      break;
    case channel:
      made.target.channel = one_of(random, channel_count);
      break;
    case points:  // three quarters one row; else a whole curve of diameters, which no other mechanism shifts
      if (one_of(random, 4) == 0) {
        made.target.channel = strip_count + 2 * one_of(random, tube_count);
      } else {
        made.target.channel = one_of(random, channel_count);
        made.target.row = one_of(random, channels(specimen.protocol)[*made.target.channel].count);
      }
  }
  if (made.target.channel) made.largest *= height(specimen, *made.target.channel);
  return made;
}

World world_with(const Specimen& specimen, const std::vector<HiddenEffect>& hidden) {
  World world{specimen.tissue, {}, {}, {}, {}};
  for (const HiddenEffect& one : hidden) one.effect->apply(world, specimen.protocol, one);
  return world;
}

}  // namespace blind
