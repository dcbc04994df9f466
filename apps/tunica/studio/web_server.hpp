// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tunica::app::studio {

/// The request of a browser. Names are decoded; missing parts are empty.
struct WebRequest {
  std::string method, path;
  std::string token, name;  ///< of the query
  std::string host, origin, cookie;
  std::string length = {}, encoding = {};  ///< headers of the body
  std::string key = {};                    ///< of a client that requests a WebSocket
  std::string body = {};
};

struct WebReply {
  int status = 200;
  std::string type = "application/json", body = {};
  std::vector<std::pair<std::string, std::string>> headers = {};
  /// Server-sent events: called again and again for the next words, which are sent at once; nothing ends the answer.
  /// Empty words are skipped.
  std::function<std::optional<std::string>()> events = {};
  /// The connection becomes a WebSocket, see talk(): called for each text that comes.
  std::function<WebReply(std::string)> live = {};
};

struct WebService {
  int port = 0;  ///< 0 = any that is free
  std::size_t largest_body = 0;
  /// Asked before a body is read; a reply refuses the request.
  std::function<std::optional<WebReply>(const WebRequest&)> refused;
  std::function<WebReply(const WebRequest&)> answer;  ///< from several threads
  std::function<void(int port)> listening;            ///< called once, when it can be asked
  std::function<bool()> over;                         ///< asked again and again; true ends it
};

/// Answers on the loopback until `over`, with the limits of HttpConnection. A successor, see supervised::parked(), goes
/// on at the same socket. Throws InputError where it cannot listen. It stands apart because the library's header
/// defines macros that Eigen cannot be read behind.
void serve_web(const WebService& service);

}  // namespace tunica::app::studio
