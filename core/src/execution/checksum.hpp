// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// The checksum that stands in every record from which work is resumed. A record with a changed digit is never taken
/// for what was written; it is against accidents, not against somebody who writes another checksum too.
namespace tunica::execution {

inline constexpr std::size_t checksum_digits = 8;

/// CRC-32 of the text (the polynomial of Ethernet and zlib) as eight hexadecimal digits. Any change within four
/// neighbouring bytes gives another one, any other change with a probability of 1 − 2⁻³².
std::string checksum(std::string_view text);

/// The same without a string of its own: writes `checksum_digits` characters and returns the place behind them.
char* put_checksum(char* at, std::string_view text);

/// The JSON object with the member "checksum" in front: that of its compact text without the member.
template <class Json>
Json sealed(const Json& record) {
  Json whole = Json::object();
  whole["checksum"] = checksum(record.dump(-1, ' ', false, Json::error_handler_t::replace));
  whole.update(record);
  return whole;
}

/// Whether an object that was read is what sealed() made. White space and the spelling of a number do not count.
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
