// SPDX-License-Identifier: Apache-2.0
#include "effects.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bases.hpp"

namespace blind {
namespace {

std::size_t one_of(std::mt19937_64& random, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

/// Largest absolute value of a channel of the bare specimen.
double height(const Specimen& specimen, std::size_t channel) {
  const auto y = observe(specimen.protocol, {specimen.tissue});
  const Channel layout = channels(specimen.protocol)[channel];
  double most = 0;
  for (std::size_t i = layout.first; i < layout.first + layout.count; ++i) most = std::max(most, std::abs(y[i]));
  return most;
}

/// Of rubber without stretch.
double shear_modulus(const Tissue& rubber) {
  return rubber.base == Base::yeoh ? 2 * rubber.c10 : (rubber.mu_1 * rubber.alpha_1 + rubber.mu_2 * rubber.alpha_2) / 2;
}

}  // namespace

bool remembers(const Effect& effect) {
  return effect.id == "stress_softening" || effect.id == "permanent_set" || effect.id == "viscoelasticity" ||
         effect.id == "signal_drift";
}

bool makes_sense(const Effect& effect, const Specimen& specimen) {
  using enum Effect::Where;
  const Base base = specimen.tissue.base;
  const auto is = [&](const std::vector<std::string>& ids) {
    return std::find(ids.begin(), ids.end(), effect.id) != ids.end();
  };
  if (effect.where == all_tubes || effect.where == tube_or_all) return !specimen.protocol.tubes.empty();
  if (effect.where == strip)
    return !specimen.protocol.strips.empty() && !(isotropic(base) && effect.id == "specimen_misalignment");
  if (effect.where != material) return true;
  if (isotropic(base))
    return is({"stress_softening", "viscoelasticity"}) || (base == Base::yeoh && effect.id == "second_invariant");
  if (effect.id == "fibre_dispersion") return base == Base::hgo || base == Base::four_fibre;
  if (is({"axial_fibres", "circumferential_fibres"})) return base != Base::four_fibre;
  return true;
}

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
      if (one_of(random, 2) == 0) made.target.tube = one_of(random, specimen.protocol.tubes.size());
      break;
    case strip:
      made.target.strip = one_of(random, specimen.protocol.strips.size());
      break;
    case channel:
      made.target.channel = one_of(random, channel_count(specimen.protocol));
      break;
    case points:  // three quarters one row; else a whole curve of diameters, which no other mechanism shifts
      if (one_of(random, 4) == 0 && !specimen.protocol.tubes.empty()) {
        made.target.channel = specimen.protocol.strips.size() + 2 * one_of(random, specimen.protocol.tubes.size());
      } else {
        made.target.channel = one_of(random, channel_count(specimen.protocol));
        made.target.row = one_of(random, channels(specimen.protocol)[*made.target.channel].count);
      }
  }
  // What is plausible in kPa is so for a wall of 20 kPa.
  if (isotropic(specimen.tissue.base) && effect.unit == "kPa") made.largest *= shear_modulus(specimen.tissue) / 20;
  if (made.target.channel) made.largest *= height(specimen, *made.target.channel);
  return made;
}

World world_with(const Specimen& specimen, const std::vector<HiddenEffect>& hidden) {
  World world{specimen.tissue};
  world.strips.resize(specimen.protocol.strips.size());
  world.tubes.resize(specimen.protocol.tubes.size());
  world.channels.resize(channel_count(specimen.protocol));
  for (const HiddenEffect& one : hidden) one.effect->apply(world, specimen.protocol, one);
  return world;
}

}  // namespace blind
