// SPDX-License-Identifier: Apache-2.0
#include "execution/checksum.hpp"

#include <zlib.h>

namespace tunica::execution {

char* put_checksum(char* at, std::string_view text) {
  constexpr const char* digits = "0123456789abcdef";
  const auto value = ::crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size());
  for (int shift = 28; shift >= 0; shift -= 4) *at++ = digits[(value >> shift) & 15U];
  return at;
}

std::string checksum(std::string_view text) {
  std::string digits(checksum_digits, '0');
  put_checksum(digits.data(), text);
  return digits;
}

}  // namespace tunica::execution
