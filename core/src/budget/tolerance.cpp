// SPDX-License-Identifier: Apache-2.0
#include "budget/tolerance.hpp"

#include <cmath>

#include <fmt/format.h>

#include "data/units.hpp"
#include "tunica/error.hpp"

namespace tunica::budget {
namespace {

using diagnosis::NoiseSource;

/// What is stated for a channel, as a share of its range; none: nothing.
std::optional<double> stated(const diagnosis::Request& request, const ChannelSize& channel) {
  const std::string* text = nullptr;
  for (const auto& [observable, value] : request.tolerance)
    if (observable == channel.channel || (observable.empty() && text == nullptr)) text = &value;
  if (text == nullptr) return std::nullopt;
  if (text->ends_with('%')) return data::parse_quantity(*text, "1");
  return data::parse_quantity(*text, channel.unit) / channel.range;
}

}  // namespace

const char* code_of(Tolerance::Origin origin) {
  switch (origin) {
    case Tolerance::Origin::stated:
      return "stated";
    case Tolerance::Origin::repeats:
      return "repeats";
    case Tolerance::Origin::cohort:
      return "cohort";
    case Tolerance::Origin::standard:
      break;
  }
  return "default";
}

Tolerance tolerance_of(const diagnosis::Request& request, const diagnosis::Evidence& evidence) {
  Tolerance tolerance;
  double sum = 0, rows = 0;
  for (const ChannelSize& channel : MisfitSize(evidence).channels(evidence.fit)) {
    double share = Tolerance{}.share;
    Tolerance::Origin origin = Tolerance::Origin::standard;
    for (const NoiseSource& source : evidence.noise)
      if (source.test == channel.test && source.channel == channel.channel &&
          source.kind == NoiseSource::Kind::replicates) {
        share = source.noise.absolute / channel.range;
        origin = Tolerance::Origin::repeats;
      }
    if (const auto own = stated(request, channel)) {
      share = *own;
      origin = Tolerance::Origin::stated;
    }
    const auto n = static_cast<double>(channel.rows);
    sum += n * share * share;
    rows += n;
    tolerance.origin = std::min(tolerance.origin, origin);
  }
  if (rows > 0) tolerance.share = std::sqrt(sum / rows);
  return tolerance;
}

}  // namespace tunica::budget
