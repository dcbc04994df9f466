// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <string>

#include <httplib.h>

namespace tunica::app {

/// The limits on a client's request: its size and its duration.
struct HttpLimits {
  std::size_t head = std::size_t{32} << 10U;  ///< bytes of the request line with all headers
  std::size_t body = std::size_t{64} << 10U;  ///< bytes as they are sent, framing of chunks included
  std::chrono::seconds request{30};           ///< from its first byte to its last
  std::chrono::seconds answer{30};            ///< to take it
  std::chrono::seconds idle{5};               ///< between two requests
};

/// A connection as the library reads it, with limits that the library has not: of all headers together, of a body that
/// comes in chunks, and of the time that a request takes however it drips. What goes beyond reads as a closed
/// connection.
class HttpConnection final : public httplib::Stream {
 public:
  HttpConnection(int socket, const HttpLimits& limits) : socket_(socket), limits_(limits) {}

  /// Waits for the first byte of a request; false where none comes. `over` is asked while it waits.
  template <class Over>
  bool wait_for_request(const Over& over);
  /// The headers are read: what follows is the body.
  void begin_body() { left_ = limits_.body; }
  /// Unread bytes remain because they are too many or too slow.
  [[nodiscard]] bool is_spent() const { return spent_; }
  /// What follows is not read.
  void spend() { spent_ = true; }
  /// Closes the connection. The client can still read the answer, even if part of its request was not read.
  void close();

  [[nodiscard]] bool is_readable() const override;
  [[nodiscard]] bool is_writable() const override;
  ssize_t read(char* to, std::size_t size) override;
  ssize_t write(const char* from, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  [[nodiscard]] socket_t socket() const override { return socket_; }

 private:
  using Clock = std::chrono::steady_clock;
  bool wait(short events, Clock::time_point until) const;

  int socket_;
  const HttpLimits& limits_;
  std::array<char, 4096> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< of what is in the buffer and was not read
  std::size_t left_ = 0;             ///< bytes that may be read
  bool spent_ = false, writing_ = false;
  Clock::time_point until_;
};

template <class Over>
bool HttpConnection::wait_for_request(const Over& over) {
  constexpr std::chrono::milliseconds heartbeat{100};
  left_ = limits_.head;
  writing_ = false;
  const auto limit = Clock::now() + limits_.idle;
  while (begin_ == end_ && !wait(1 /* POLLIN */, Clock::now() + heartbeat))
    if (over() || Clock::now() > limit) return false;
  until_ = Clock::now() + limits_.request;
  return true;
}

}  // namespace tunica::app
