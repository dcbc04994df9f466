// SPDX-License-Identifier: Apache-2.0
#include "world.hpp"

#include <cmath>
#include <numbers>

namespace blind {

std::vector<Channel> channels(const Protocol& protocol) {
  std::vector<Channel> all;
  std::size_t first = 0;
  const auto add = [&](const std::string& test, const char* name, const char* unit, const std::vector<double>& time,
                       const std::vector<double>& path) {
    all.push_back({test, name, unit, first, time.size(), &time, &path});
    first += time.size();
  };
  for (const Strip& strip : protocol.strips) add(strip.name, "stress", "kPa", strip.time, strip.stretch);
  for (const Tube& tube : protocol.tubes) {
    add(tube.name, "outer_diameter_stretch", "-", tube.time, tube.pressure);
    add(tube.name, "axial_force", "mN", tube.time, tube.pressure);
  }
  for (const Sheet& sheet : protocol.sheets) {
    const bool general = sheet.kind == Sheet::Kind::general;
    add(sheet.name, general ? "stress_circumferential" : "stress", "kPa", sheet.time, sheet.around);
    if (general) add(sheet.name, "stress_axial", "kPa", sheet.time, sheet.along);
  }
  return all;
}

std::size_t channel_count(const Protocol& protocol) {
  std::size_t count = protocol.strips.size() + 2 * protocol.tubes.size();
  for (const Sheet& sheet : protocol.sheets) count += sheet.channel_count();
  return count;
}

std::size_t observation_count(const Protocol& protocol) {
  const auto all = channels(protocol);
  return all.back().first + all.back().count;
}

namespace {

template <class Faults>
Faults at(const std::vector<Faults>& all, std::size_t i) {
  return i < all.size() ? all[i] : Faults{};
}

}  // namespace

std::vector<double> observe(const Protocol& protocol, const World& world) {
  std::vector<double> y;
  for (std::size_t i = 0; i < protocol.strips.size(); ++i) {
    const auto stress = recorded_stress(protocol.strips[i], world.tissue, at(world.strips, i));
    y.insert(y.end(), stress.begin(), stress.end());
  }
  for (std::size_t i = 0; i < protocol.tubes.size(); ++i) {
    const TubeRecord tube = record(protocol.tubes[i], world.tissue, at(world.tubes, i));
    y.insert(y.end(), tube.diameter.begin(), tube.diameter.end());
    y.insert(y.end(), tube.force.begin(), tube.force.end());
  }
  for (const Sheet& sheet : protocol.sheets)
    for (const auto& stress : recorded_stresses(sheet, world.tissue)) y.insert(y.end(), stress.begin(), stress.end());
  const auto layout = channels(protocol);
  for (std::size_t k = 0; k < world.channels.size(); ++k) {
    const ChannelFaults& faults = world.channels[k];
    if (faults.drift == 0 && faults.quadratic_drift == 0 && faults.hum == 0) continue;
    const auto& time = *layout[k].time;
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
