// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/profile.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tunica::cohort_diagnosis {

std::string Profile::key_of_place() const {
  return fmt::format("{}|{}|{}|{}|{}", id, fmt::join(place.tests, ","), place.channel,
                     place.row ? fmt::format("{}", *place.row) : "", place.model);
}

std::string Profile::key() const {
  std::string text = key_of_place();
  for (const auto& [name, value] : setting) text += fmt::format("|{}={}", name, value);
  return text;
}

const Half& Profile::active() const {
  if (!up) return *down;
  return down && down->t > up->t ? *down : *up;
}

double Profile::side() const { return !up || (down && down->t > up->t) ? -1 : 1; }

double Profile::gain() const {
  const double t = std::max(active().t, 0.0);
  return t * t;
}

double Profile::distance() const {
  const Half& half = active();
  return side() * std::max(half.t, 0.0) / half.length;
}

double amplitude_at(const Profile& profile, double distance) {
  return profile.null + (profile.even ? std::sqrt(std::max(distance, 0.0)) : distance);
}

}  // namespace tunica::cohort_diagnosis
