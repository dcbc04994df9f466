// SPDX-License-Identifier: Apache-2.0
#include "studio/web_socket.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

#include <nettle/base64.h>
#include <nettle/sha1.h>
#include <sys/socket.h>

#include "open_requests.hpp"

namespace tunica::app::studio {

namespace {

enum Kind : unsigned char { text = 1, binary = 2, closing = 8, ping = 9, pong = 10 };

struct Frame {
  unsigned char kind = closing;
  std::string payload;
};

bool read_all(HttpConnection& connection, char* to, std::size_t size) {
  while (size > 0) {
    const ssize_t count = connection.read(to, size);
    if (count <= 0) return false;
    to += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

bool write_all(HttpConnection& connection, std::string_view words) {
  while (!words.empty()) {
    const ssize_t count = connection.write(words.data(), words.size());
    if (count <= 0) return false;
    words.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// A whole frame of a client, whose bytes are masked; nothing where it is none, is a part only, or is too large.
std::optional<Frame> read_frame(HttpConnection& connection) {
  constexpr unsigned whole = 0x80, masked = 0x80;
  constexpr std::size_t two_bytes_follow = 126;
  std::array<unsigned char, 2> head{}, size{};
  std::array<unsigned char, 4> mask{};
  const auto bytes = [&](auto& into) {
    return read_all(connection, reinterpret_cast<char*>(into.data()), into.size());
  };
  if (!bytes(head) || (head[0] & 0xF0U) != whole || (head[1] & masked) == 0) return std::nullopt;
  std::size_t length = head[1] & 0x7FU;
  if (length > two_bytes_follow) return std::nullopt;
  if (length == two_bytes_follow) {
    if (!bytes(size)) return std::nullopt;
    length = size[0] << 8U | size[1];
  }
  Frame frame{static_cast<unsigned char>(head[0] & 0x0FU), std::string(length, '\0')};
  if (!bytes(mask) || !read_all(connection, frame.payload.data(), length)) return std::nullopt;
  for (std::size_t k = 0; k < length; ++k)
    frame.payload[k] = static_cast<char>(static_cast<unsigned char>(frame.payload[k]) ^ mask[k % 4]);
  return frame;
}

/// Whole, and not masked, as a server's are.
std::string frame_of(Kind kind, std::string_view payload) {
  std::string frame(1, static_cast<char>(0x80U | kind));
  int bytes = 0;
  if (payload.size() < 126) {
    frame += static_cast<char>(payload.size());
  } else {
    bytes = payload.size() < 65536 ? 2 : 8;
    frame += static_cast<char>(bytes == 2 ? 126 : 127);
  }
  while (bytes-- > 0) frame += static_cast<char>(payload.size() >> (8U * static_cast<unsigned>(bytes)));
  return frame.append(payload);
}

}  // namespace

std::string accept_of(const std::string& key) {
  const std::string both = key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
  std::array<std::uint8_t, SHA1_DIGEST_SIZE> digest;
  sha1_ctx sum;
  sha1_init(&sum);
  sha1_update(&sum, both.size(), reinterpret_cast<const std::uint8_t*>(both.data()));
  sha1_digest(&sum, digest.size(), digest.data());
  std::string text(BASE64_ENCODE_RAW_LENGTH(SHA1_DIGEST_SIZE), '\0');
  base64_encode_raw(text.data(), digest.size(), digest.data());
  return text;
}

void talk(HttpConnection& connection, const std::string& key, const std::function<WebReply(std::string)>& answer,
          const std::function<bool()>& over) {
  constexpr std::chrono::minutes patience{1};
  bool open = write_all(connection,
                        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                        "Sec-WebSocket-Accept: " +
                            accept_of(key) + "\r\n\r\n");
  auto last = std::chrono::steady_clock::now();
  while (open && !over() && std::chrono::steady_clock::now() - last < patience) {
    if (!connection.wait_for_request(over)) continue;
    auto frame = read_frame(connection);
    if (frame && frame->kind == text) {
      WebReply reply;
      {
        const OpenRequest asked(connection.socket());
        reply = answer(std::move(frame->payload));
      }
      open = write_all(connection, frame_of(reply.status == 200 ? binary : text, reply.body));
      last = std::chrono::steady_clock::now();
    } else if (frame && frame->kind == ping) {
      open = write_all(connection, frame_of(pong, frame->payload));
    } else if (!frame || frame->kind != pong) {
      open = false;
    }
  }
  write_all(connection, frame_of(closing, {}));
  ::shutdown(connection.socket(), SHUT_WR);  // nothing of what the library adds comes behind
  connection.spend();
}

}  // namespace tunica::app::studio
