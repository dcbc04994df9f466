// SPDX-License-Identifier: Apache-2.0
#include "cohort/curve_reading.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "data/units.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {

namespace {

/// A place between two rows: x = (1 − share) x[row] + share x[row + 1].
struct Place {
  std::size_t row = 0;
  double share = 0;
};

/// Rows [0, end) of the first loading: until the abscissa has gone farthest from where it began, as long as it goes one
/// way.
std::size_t end_of_loading(const std::vector<double>& x) {
  std::size_t end = std::min<std::size_t>(x.size(), 1);
  double direction = 0;
  for (; end < x.size(); ++end) {
    const double step = x[end] - x[end - 1];
    if (step == 0) continue;
    if (direction == 0) direction = step;
    if (step * direction < 0) break;
  }
  return end;
}

std::optional<Place> place_of(const std::vector<double>& x, std::size_t end, double wanted) {
  for (std::size_t k = 0; k + 1 < end; ++k) {
    const double low = std::min(x[k], x[k + 1]), high = std::max(x[k], x[k + 1]);
    if (wanted < low || wanted > high || low == high) continue;
    return Place{k, (wanted - x[k]) / (x[k + 1] - x[k])};
  }
  return {};
}

using Weights = std::map<std::size_t, double>;

void add(Weights& weights, const Place& place, double factor) {
  weights[place.row] += factor * (1 - place.share);
  weights[place.row + 1] += factor * place.share;
}

/// ∫ y dx over the part [from, to] of the straight line between two neighbouring rows, shares from 0 to 1.
void add_segment(Weights& weights, const std::vector<double>& x, std::size_t row, double from, double to) {
  const double length = (x[row + 1] - x[row]) * (to - from);
  add(weights, {row, from}, length / 2);
  add(weights, {row, to}, length / 2);
}

void add_integral(Weights& weights, const std::vector<double>& x, const Place& from, const Place& to) {
  if (from.row == to.row) return add_segment(weights, x, from.row, from.share, to.share);
  add_segment(weights, x, from.row, from.share, 1);
  for (std::size_t row = from.row + 1; row < to.row; ++row) add_segment(weights, x, row, 0, 1);
  add_segment(weights, x, to.row, 0, to.share);
}

double abscissa_of(const std::string& text, const assembly::MeasuredChannel& channel, const ReadingEntry& entry) {
  try {
    return data::parse_quantity(text, channel.abscissa_unit);
  } catch (const InputError& problem) {
    throw InputError(fmt::format("{}: {}", entry.place, problem.what()));
  }
}

std::string unit_of(const assembly::MeasuredChannel& channel, ReadingKind kind) {
  const bool plain = channel.abscissa_unit.empty() || channel.abscissa_unit == "1";
  if (kind == ReadingKind::value || plain) return channel.unit;
  const bool number = channel.unit.empty() || channel.unit == "1";
  if (kind == ReadingKind::slope) return (number ? "1" : channel.unit) + "/" + channel.abscissa_unit;
  return number ? channel.abscissa_unit : channel.unit + " " + channel.abscissa_unit;
}

}  // namespace

LinearReading read_off(const assembly::MeasuredChannel& channel, const ReadingEntry& entry) {
  LinearReading reading{{}, unit_of(channel, entry.kind), {}};
  const std::size_t end = end_of_loading(channel.abscissa);
  std::vector<Place> places;
  std::vector<double> at;
  for (const std::string& text : entry.at) {
    at.push_back(abscissa_of(text, channel, entry));
    const auto place = place_of(channel.abscissa, end, at.back());
    if (!place) {
      const auto [low, high] =
          std::minmax_element(channel.abscissa.begin(), channel.abscissa.begin() + static_cast<std::ptrdiff_t>(end));
      reading.problem = end == 0 ? "the channel has no rows"
                                 : fmt::format("{} {} lies outside the loading, {:.4g} to {:.4g}",
                                               channel.abscissa_name, text, *low, *high);
      return reading;
    }
    places.push_back(*place);
  }
  Weights weights;
  if (entry.kind == ReadingKind::value) add(weights, places[0], 1);
  if (entry.kind == ReadingKind::slope) {
    if (at[0] == at[1])
      throw InputError(
          fmt::format("{}: both ends of the slope are {}. Give two different ones", entry.place, entry.at[0]));
    add(weights, places[1], 1 / (at[1] - at[0]));
    add(weights, places[0], -1 / (at[1] - at[0]));
  }
  if (entry.kind == ReadingKind::integral) {
    const bool forward =
        places[0].row < places[1].row || (places[0].row == places[1].row && places[0].share <= places[1].share);
    Weights part;
    add_integral(part, channel.abscissa, places[forward ? 0 : 1], places[forward ? 1 : 0]);
    for (const auto& [row, weight] : part) weights[row] += forward ? weight : -weight;
  }
  for (const auto& [row, weight] : weights) reading.weights.emplace_back(channel.offset + row, weight);
  return reading;
}

}  // namespace tunica::cohort
