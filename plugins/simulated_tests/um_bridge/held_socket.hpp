// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>

namespace tunica::um_bridge {

/// The connection that the HTTP library has open, held a second time: it can be looked at and ended while the library
/// waits on it or reads from it, and its number is nobody else's meanwhile. Thread-safe.
class HeldSocket {
 public:
  HeldSocket() = default;
  HeldSocket(const HeldSocket&) = delete;
  HeldSocket& operator=(const HeldSocket&) = delete;
  ~HeldSocket();

  void hold(int socket);
  /// Bytes that the other side has sent, read or not; 0 where the system does not tell.
  [[nodiscard]] std::uint64_t received() const;
  /// A thread that waits on it gets an error at once.
  void end() const;

 private:
  mutable std::mutex mutex_;
  int socket_ = -1;
};

}  // namespace tunica::um_bridge
