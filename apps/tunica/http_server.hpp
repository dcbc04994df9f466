// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace tunica::app {

/// The response of an HTTP server: JSON with a status.
struct HttpReply {
  int status = 200;
  std::string json;
};

/// Its address and its request handler.
struct HttpService {
  std::string host;
  int port = 0;                          ///< 0 = any that is free
  unsigned threads = 1;                  ///< requests that are answered at a time
  std::size_t largest_body = 0;          ///< bytes of a request that the numbers in it take
  std::vector<std::string> got, posted;  ///< paths asked with GET, with POST
  std::function<HttpReply(const std::string& path, const std::string& body)> answer;  ///< from several threads
  std::function<void(int port)> listening;  ///< called once, when it can be asked
  std::function<bool()> over;               ///< asked again and again; true ends it
};

/// Answers until `over`. Requests of another machine's name, of an endless head or body and of a slow client are
/// refused; one in which a plugin ends the process is answered with 500, and a successor goes on at the same socket.
/// Throws InputError where it cannot listen there. It stands apart because the library's header defines macros that
/// Eigen cannot be read behind.
void serve_http(const HttpService& service);

}  // namespace tunica::app
