// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "strip.hpp"
#include "tube.hpp"

namespace blind {

constexpr std::size_t strip_count = 2, tube_count = 3, channel_count = strip_count + 2 * tube_count;

/// What is done to the specimen: two cyclic strips and three inflations at different axial stretches.
struct Protocol {
  std::array<Strip, strip_count> strips;
  std::array<Tube, tube_count> tubes;
};

/// One measured curve: where it stands among all observations, and what files call it. Strips first, then diameter and
/// force of each tube.
struct Channel {
  std::string test, name, unit;
  std::size_t first, count;
};
std::array<Channel, channel_count> channels(const Protocol& protocol);
const std::array<std::string, strip_count>& strip_names();
const std::array<std::string, tube_count>& tube_names();
std::size_t observation_count(const Protocol& protocol);

/// What may be wrong with the recording of one channel.
struct ChannelFaults {
  double drift = 0;            ///< by the end of the test, linear in time
  double quadratic_drift = 0;  ///< outside the catalogue: quadratic in time
  double hum = 0;              ///< outside: amplitude of an oscillation, three periods a test
};
struct GrossError {
  std::size_t channel, row;
  double value;
};

/// Specimen, rigs and records with whatever is hidden in them.
struct World {
  Tissue tissue;
  std::array<StripFaults, strip_count> strips;
  std::array<TubeFaults, tube_count> tubes;
  std::array<ChannelFaults, channel_count> channels;
  std::vector<GrossError> shifts;
};

/// All observations without noise, channel after channel; NaN where there is no equilibrium.
std::vector<double> observe(const Protocol& protocol, const World& world);

}  // namespace blind
