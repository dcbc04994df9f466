// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace tunica {

/// Derives a seed from another one and a name.
///
/// Host and optimizers seed every random generator this way, so that results do not depend on the number of threads or
/// on the order of work: the name says what the numbers are for, for example "start 3". Equal arguments give equal
/// seeds; seeds of different names are unrelated. An optimizer usually calls Problem::seed(), which calls this.
///
/// The function is part of the contract: it never changes, so that results of earlier releases can be repeated.
///
/// Method: FNV-1a over the name, mixed with the seed by the finaliser of SplitMix64. Source: Steele, Lea, Flood, Fast
/// splittable pseudorandom number generators, OOPSLA (2014). Thread-safe; allocates nothing.
constexpr std::uint64_t derive_seed(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char character : name) hash = (hash ^ static_cast<unsigned char>(character)) * 0x100000001b3u;
  std::uint64_t z = seed + 0x9e3779b97f4a7c15u * (hash | 1u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace tunica
