// SPDX-License-Identifier: Apache-2.0
#include "http_connection.hpp"

#include <algorithm>
#include <cerrno>
#include <utility>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace tunica::app {

bool HttpConnection::wait(short events, Clock::time_point until) const {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
    pollfd watched{socket_, events, 0};
    const int found = ::poll(&watched, 1, static_cast<int>(std::clamp<long long>(left, 0, 1000)));
    if (found > 0) return true;
    if (found < 0 && errno != EINTR) return false;
    if (left <= 0) return false;
  }
}

bool HttpConnection::is_readable() const { return begin_ < end_ || wait(POLLIN, until_); }
bool HttpConnection::is_writable() const { return wait(POLLOUT, Clock::now() + limits_.answer); }

ssize_t HttpConnection::read(char* to, std::size_t size) {
  if (left_ == 0) spent_ = true;
  if (spent_) return -1;
  if (begin_ == end_) {
    if (!wait(POLLIN, until_) || Clock::now() > until_) {
      spent_ = true;
      return -1;
    }
    const ssize_t count = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (count <= 0) return count;
    begin_ = 0;
    end_ = static_cast<std::size_t>(count);
  }
  const std::size_t count = std::min({size, end_ - begin_, left_});
  std::copy_n(buffer_.data() + begin_, count, to);
  begin_ += count;
  left_ -= count;
  return static_cast<ssize_t>(count);
}

ssize_t HttpConnection::write(const char* from, std::size_t size) {
  if (!std::exchange(writing_, true)) until_ = Clock::now() + limits_.answer;
  if (!wait(POLLOUT, until_) || Clock::now() > until_) return -1;
  return ::send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
}

/// A socket that is closed over unread bytes tears the answer away: they are read and forgotten, for a while.
void HttpConnection::close() {
  constexpr std::chrono::seconds patience{1};
  constexpr std::size_t most = std::size_t{1} << 20U;
  ::shutdown(socket_, SHUT_WR);
  const auto limit = Clock::now() + patience;
  for (std::size_t forgotten = 0; spent_ && forgotten < most && Clock::now() < limit && wait(POLLIN, limit);) {
    const ssize_t count = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (count <= 0) break;
    forgotten += static_cast<std::size_t>(count);
  }
  ::close(socket_);
}

void HttpConnection::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

void HttpConnection::get_local_ip_and_port(std::string& ip, int& port) const { get_remote_ip_and_port(ip, port); }

}  // namespace tunica::app
