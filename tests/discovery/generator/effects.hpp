// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "specimen.hpp"

namespace blind {

struct Effect;

/// Where an effect sits: nowhere in particular (the material, or all tubes), in one test, in one channel, at one row.
struct Target {
  std::optional<std::size_t> strip, tube, channel, row;
};

/// An effect as it is hidden in one case.
struct HiddenEffect {
  const Effect* effect = nullptr;
  Target target;
  std::map<std::string, double> nuisance;
  double sign = 1, largest = 0;  ///< which side of the null; the largest distance from it that is plausible here
  double distance = 0;           ///< from the null; of the logarithm where the effect says so
  [[nodiscard]] double amplitude() const;
};

/// What can be hidden: the catalogue, and what no catalogue lists.
struct Effect {
  enum class Where { material, all_tubes, tube_or_all, strip, channel, points };
  struct Nuisance {
    std::string name;
    double low, high;                  ///< hidden values lie between
    std::vector<double> grid;          ///< where it is looked for by who judges what the catalogue can explain
    std::vector<double> choices = {};  ///< instead of a range
  };
  std::string id, unit;
  Where where;
  double null, low,
      high;  ///< plausible range of the amplitude; low = null: one side only. Of a channel: shares of its largest value
  std::vector<Nuisance> nuisances = {};
  bool logarithmic = false;  ///< the sides of the null are factors
  bool even = false;         ///< both sides are alike
  std::function<void(World&, const Protocol&, const HiddenEffect&)> apply;
  std::string look_alike = {};  ///< outside the catalogue: what it resembles, if anything
};

/// The mechanism catalogue, by the ids that are public contract; and effects outside of it.
const std::vector<Effect>& catalogue();
const std::vector<Effect>& outsiders();
/// Throws std::invalid_argument with the known ids.
const Effect& effect(const std::string& id);

/// Whether the effect can be hidden there: no fibres in rubber, no tube where there is none, no second of what the base
/// has already.
bool makes_sense(const Effect& effect, const Specimen& specimen);
/// Whether it needs to be known in which order the rows were recorded.
bool remembers(const Effect& effect);

/// Draws target, nuisances and side.
HiddenEffect draw(const Effect& effect, const Specimen& specimen, std::mt19937_64& random);
World world_with(const Specimen& specimen, const std::vector<HiddenEffect>& hidden);

}  // namespace blind
