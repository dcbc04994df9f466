// SPDX-License-Identifier: Apache-2.0
// The header of the kernel, whose tcp_info counts bytes; that of the C library, which the HTTP library includes, is
// older and excludes it.
#include "held_socket.hpp"

#include <cstddef>

#include <fcntl.h>
#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace tunica::um_bridge {

HeldSocket::~HeldSocket() {
  if (socket_ >= 0) ::close(socket_);
}

void HeldSocket::hold(int socket) {
  const std::lock_guard lock(mutex_);
  if (socket_ >= 0) ::close(socket_);
  socket_ = ::fcntl(socket, F_DUPFD_CLOEXEC, 0);
}

std::uint64_t HeldSocket::received() const {
  const std::lock_guard lock(mutex_);
  tcp_info info = {};
  socklen_t size = sizeof info;
  if (socket_ < 0 || ::getsockopt(socket_, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return 0;
  return size >= offsetof(tcp_info, tcpi_bytes_received) + sizeof info.tcpi_bytes_received ? info.tcpi_bytes_received
                                                                                           : 0;
}

void HeldSocket::end() const {
  const std::lock_guard lock(mutex_);
  if (socket_ >= 0) ::shutdown(socket_, SHUT_RDWR);
}

}  // namespace tunica::um_bridge
