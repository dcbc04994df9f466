// SPDX-License-Identifier: Apache-2.0
#include "world.hpp"

#include <cmath>
#include <numbers>

namespace blind {

const std::array<std::string, strip_count>& strip_names() {
  static const std::array<std::string, strip_count> names{"circumferential_strip", "axial_strip"};
  return names;
}
const std::array<std::string, tube_count>& tube_names() {
  static const std::array<std::string, tube_count> names{"inflation_low", "inflation_middle", "inflation_high"};
  return names;
}

std::array<Channel, channel_count> channels(const Protocol& protocol) {
  std::array<Channel, channel_count> all;
  std::size_t first = 0, k = 0;
  const auto add = [&](const std::string& test, const std::string& name, const std::string& unit, std::size_t count) {
    all[k++] = {test, name, unit, first, count};
    first += count;
  };
  for (std::size_t i = 0; i < strip_count; ++i)
    add(strip_names()[i], "stress", "kPa", protocol.strips[i].stretch.size());
  for (std::size_t i = 0; i < tube_count; ++i) {
    add(tube_names()[i], "outer_diameter_stretch", "-", protocol.tubes[i].pressure.size());
    add(tube_names()[i], "axial_force", "mN", protocol.tubes[i].pressure.size());
  }
  return all;
}

std::size_t observation_count(const Protocol& protocol) {
  const auto all = channels(protocol);
  return all.back().first + all.back().count;
}

std::vector<double> observe(const Protocol& protocol, const World& world) {
  std::vector<double> y;
  for (std::size_t i = 0; i < strip_count; ++i) {
    const auto stress = recorded_stress(protocol.strips[i], world.tissue, world.strips[i]);
    y.insert(y.end(), stress.begin(), stress.end());
  }
  for (std::size_t i = 0; i < tube_count; ++i) {
    const TubeRecord tube = record(protocol.tubes[i], world.tissue, world.tubes[i]);
    y.insert(y.end(), tube.diameter.begin(), tube.diameter.end());
    y.insert(y.end(), tube.force.begin(), tube.force.end());
  }
  const auto layout = channels(protocol);
  for (std::size_t k = 0; k < channel_count; ++k) {
    const ChannelFaults& faults = world.channels[k];
    if (faults.drift == 0 && faults.quadratic_drift == 0 && faults.hum == 0) continue;
    const auto& time = k < strip_count ? protocol.strips[k].time : protocol.tubes[(k - strip_count) / 2].time;
    for (std::size_t i = 0; i < layout[k].count; ++i) {
      const double share = time[i] / time.back();
      y[layout[k].first + i] += faults.drift * share + faults.quadratic_drift * share * share +
                                faults.hum * std::sin(6 * std::numbers::pi * share);
    }
  }
  for (const GrossError& shift : world.shifts) y[layout[shift.channel].first + shift.row] += shift.value;
  return y;
}

}  // namespace blind
