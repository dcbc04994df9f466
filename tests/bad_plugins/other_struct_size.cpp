// SPDX-License-Identifier: Apache-2.0
#include <cstdint>

// The header of some other version, which ends after two numbers.
struct OlderHeader {
  std::uint32_t struct_size, api;
};

extern "C" __attribute__((visibility("default"))) const OlderHeader* tunica_plugin() {
  static constexpr OlderHeader header{sizeof(OlderHeader), 1};
  return &header;
}
