// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sheet.hpp"
#include "strip.hpp"
#include "tube.hpp"

namespace blind {

/// The loading of the specimen:
///   artery  two cyclic strips and three inflations at different axial stretches
///   sheets  planar biaxial extension at five ratios
///   rubber  a strip, equibiaxial extension and pure shear
struct Protocol {
  std::vector<Strip> strips;
  std::vector<Tube> tubes;
  std::vector<Sheet> sheets = {};
};

/// One measured curve: where it stands among all observations, and what files call it. Strips first, then diameter and
/// force of each tube, then the stresses of each sheet.
struct Channel {
  std::string test, name, unit;
  std::size_t first, count;
  const std::vector<double>*time, *path;  ///< of the protocol: when, and what was prescribed
};
std::vector<Channel> channels(const Protocol& protocol);
std::size_t channel_count(const Protocol& protocol);
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
  std::vector<StripFaults> strips = {};      ///< shorter than the protocol: the others are without fault
  std::vector<TubeFaults> tubes = {};        ///< the same
  std::vector<ChannelFaults> channels = {};  ///< the same
  std::vector<GrossError> shifts = {};
};

/// All observations without noise, channel after channel; NaN where there is no equilibrium.
std::vector<double> observe(const Protocol& protocol, const World& world);

}  // namespace blind
