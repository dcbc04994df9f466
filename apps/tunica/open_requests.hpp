// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Requests of HTTP that are being answered. Where a plugin ends the process, each gets an answer before: 500 with the
/// plugin's name.
namespace tunica::app {

/// One of them, while it lives. The answer is computed meanwhile, and not yet written.
class OpenRequest {
 public:
  explicit OpenRequest(int socket);
  /// Does not return where the process is about to end and has answered for us.
  ~OpenRequest();
  OpenRequest(const OpenRequest&) = delete;
  OpenRequest& operator=(const OpenRequest&) = delete;

 private:
  std::size_t place_;
  int socket_;
};

/// From here on. The descriptor that listens is closed before, so that nobody who reads the answer is taken in by a
/// process that ends: a successor has a copy of it.
void answer_open_requests_at_the_end(int listening);

}  // namespace tunica::app
