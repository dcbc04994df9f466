// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace tunica {

/// A sub-seed by name: the same for any number of threads, and unrelated for unrelated names. FNV-1a over the
/// name, mixed with the seed by the finaliser of SplitMix64 (Steele, Lea, Flood 2014).
constexpr std::uint64_t derive_seed(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char character : name) hash = (hash ^ static_cast<unsigned char>(character)) * 0x100000001b3u;
  std::uint64_t z = seed + 0x9e3779b97f4a7c15u * (hash | 1u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace tunica
