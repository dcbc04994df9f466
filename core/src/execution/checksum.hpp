// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// The checksum of every record from which work is resumed. It detects every changed digit. It protects against
/// accidents, not against someone who also changes the checksum.
namespace tunica::execution {

inline constexpr std::size_t checksum_digits = 8;

/// CRC-32 of the text (the polynomial of Ethernet and zlib) as eight hexadecimal digits. It detects any change within
/// four neighbouring bytes, and any other change with probability 1 − 2⁻³².
std::string checksum(std::string_view text);

/// The same without a new string: writes `checksum_digits` characters and returns the position after them.
char* put_checksum(char* at, std::string_view text);

/// The JSON object with the member "checksum" in front: that of its compact text without the member.
template <class Json>
Json sealed(const Json& record) {
  Json whole = Json::object();
  whole["checksum"] = checksum(record.dump(-1, ' ', false, Json::error_handler_t::replace));
  whole.update(record);
  return whole;
}

/// Whether a parsed object is what sealed() made. White space and the spelling of numbers do not matter.
template <class Json>
bool intact(const Json& whole) {
  if (!whole.is_object()) return false;
  const auto stated = whole.find("checksum");
  if (stated == whole.end() || !stated->is_string()) return false;
  Json record = whole;
  record.erase("checksum");
  return *stated == checksum(record.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace tunica::execution
