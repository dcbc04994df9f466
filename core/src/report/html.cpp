// SPDX-License-Identifier: Apache-2.0
#include "report/html.hpp"

#include <array>
#include <cctype>

#include <fmt/format.h>
#include <nettle/base64.h>
#include <nettle/sha2.h>

#include "text/escaped.hpp"

namespace tunica::report {

namespace {

/// nlohmann_json serves as UTF-8 decoder: it replaces malformed bytes.
std::string valid_utf8(std::string_view text) {
  const std::string quoted = nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return nlohmann::json::parse(quoted).get<std::string>();
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text::escaped(valid_utf8(text), "\n\t")) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string script_json(const nlohmann::ordered_json& value) {
  std::string result;
  const std::string text = value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '<' || c == '>' || c == '&')
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else if (text.compare(i, 3, "\xE2\x80\xA8") == 0 || text.compare(i, 3, "\xE2\x80\xA9") == 0) {
      result += text[i + 2] == '\xA8' ? "\\u2028" : "\\u2029";
      i += 2;
    } else
      result += c;
  }
  return result;
}

std::string policy_source(std::string_view inline_text) {
  sha256_ctx state;
  sha256_init(&state);
  sha256_update(&state, inline_text.size(), reinterpret_cast<const uint8_t*>(inline_text.data()));
  std::array<uint8_t, SHA256_DIGEST_SIZE> digest{};
  sha256_digest(&state, digest.size(), digest.data());
  std::string text(BASE64_ENCODE_RAW_LENGTH(digest.size()), '\0');
  base64_encode_raw(text.data(), digest.size(), digest.data());
  return "'sha256-" + text + "'";
}

std::string address(std::string_view path) {
  std::string result;
  for (const char c : path)
    result += std::isalnum(static_cast<unsigned char>(c)) || std::string_view("-_./~").find(c) != std::string_view::npos
                  ? std::string(1, c)
                  : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return result;
}

}  // namespace tunica::report
