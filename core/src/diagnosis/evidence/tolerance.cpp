// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/tolerance.hpp"

#include <algorithm>

namespace tunica::diagnosis {

Tolerance tolerance_of(const Request& request, const Evidence& evidence) {
  Tolerance tolerance;
  std::vector<double> shares;
  const std::vector<ChannelSize> channels = MisfitSize(evidence).channels(evidence.fit);
  for (const ChannelSize& channel : channels) {
    double share = Tolerance{}.share;
    Tolerance::Origin origin = Tolerance::Origin::standard;
    for (const NoiseSource& source : evidence.noise)
      if (source.test == channel.test && source.channel == channel.channel &&
          source.kind == NoiseSource::Kind::replicates) {
        share = source.noise.absolute / channel.range;
        origin = Tolerance::Origin::repeats;
      }
    if (const auto own = assembly::stated_tolerance(request.tolerance, channel)) {
      share = *own;
      origin = Tolerance::Origin::stated;
    }
    shares.push_back(share);
    tolerance.origin = std::min(tolerance.origin, origin);
  }
  if (!channels.empty()) tolerance.share = assembly::over_rows(channels, shares);
  return tolerance;
}

}  // namespace tunica::diagnosis
