// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include <httplib.h>

#include "http_connection.hpp"

namespace tunica::app {

/// A server that parses and routes as the library does, on connections of ours, for their limits.
class ConnectionServer : public httplib::Server {
 public:
  /// `over` is asked several times a second, whether the server ends.
  ConnectionServer(HttpLimits limits, std::function<bool()> over) : limits_(limits), over_(std::move(over)) {}

  /// Answers on a listening socket, a connection a thread, until it is over. Closes the socket.
  void answer_on(int listening, std::size_t threads);

 protected:
  /// The one that this thread answers.
  [[nodiscard]] static HttpConnection& connection() { return *current; }

 private:
  void serve(int socket);
  static thread_local HttpConnection* current;
  HttpLimits limits_;
  std::function<bool()> over_;
};

/// A predecessor's socket, with all who wait there, or a new one. The next process finds it too, and requests that are
/// open at the end of this one are answered. Throws InputError where the port cannot be had.
int listen_or_go_on(const std::string& host, int port);

}  // namespace tunica::app
