// SPDX-License-Identifier: Apache-2.0
#include "listening_socket.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <memory>
#include <string_view>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tunica/error.hpp"

namespace tunica::app {

namespace {

std::string bare(std::string host) {
  if (host.size() > 2 && host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  std::transform(host.begin(), host.end(), host.begin(), [](unsigned char c) { return std::tolower(c); });
  return host;
}

/// "name:4242" and "[::1]:4242" without the port.
std::string without_port(std::string_view authority) {
  const auto bracket = authority.find(']');
  const auto colon = authority.find(':', bracket == std::string_view::npos ? 0 : bracket);
  return bare(std::string(authority.substr(0, colon)));
}

enum class Kind { name, address, loopback };

Kind kind_of(const std::string& host) {
  in_addr four{};
  in6_addr six{};
  if (host == "localhost") return Kind::loopback;
  if (::inet_pton(AF_INET, host.c_str(), &four) == 1)
    return (ntohl(four.s_addr) >> 24U) == 127 ? Kind::loopback : Kind::address;
  if (::inet_pton(AF_INET6, host.c_str(), &six) == 1)
    return IN6_IS_ADDR_LOOPBACK(&six) ? Kind::loopback : Kind::address;
  return Kind::name;
}

bool is_ours(const std::string& host, const std::string& served) {
  const Kind kind = kind_of(host);
  return kind == Kind::loopback || host == served || (kind == Kind::address && kind_of(served) != Kind::loopback);
}

}  // namespace

int listen_on(const std::string& host, int port) {
  addrinfo wishes{};
  wishes.ai_socktype = SOCK_STREAM;
  wishes.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  if (const int problem = ::getaddrinfo(bare(host).c_str(), std::to_string(port).c_str(), &wishes, &found);
      problem != 0)
    throw InputError(fmt::format("--host {}: {}. Give an address of this machine, such as 127.0.0.1 or ::1", host,
                                 ::gai_strerror(problem)));
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> all(found, ::freeaddrinfo);
  for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
    const int descriptor = ::socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC, one->ai_protocol);
    if (descriptor < 0) continue;
    // Not SO_REUSEPORT, which lets two servers share a port unnoticed.
    const int yes = 1;
    ::setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    if (::bind(descriptor, one->ai_addr, one->ai_addrlen) == 0 && ::listen(descriptor, SOMAXCONN) == 0)
      return descriptor;
    ::close(descriptor);
  }
  throw InputError(
      fmt::format("cannot listen on {}:{}: the port is in use, or the address is none of this machine. "
                  "Choose another port with --port, or 0 for any that is free",
                  in_url(host), port));
}

int port_of(int descriptor) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) return -1;
  sockaddr_in four{};
  sockaddr_in6 six{};
  std::memcpy(&four, &address, sizeof four);
  std::memcpy(&six, &address, sizeof six);
  return ntohs(address.ss_family == AF_INET6 ? six.sin6_port : four.sin_port);
}

std::string in_url(const std::string& host) {
  return host.find(':') == std::string::npos || host.front() == '[' ? host : fmt::format("[{}]", host);
}

bool is_of_this_machine(const std::string& host_header, const std::string& origin, const std::string& served) {
  const std::string own = bare(served);
  if (!host_header.empty() && !is_ours(without_port(host_header), own)) return false;
  if (origin.empty()) return true;
  const auto scheme = origin.find("://");
  return scheme != std::string::npos && is_ours(without_port(std::string_view(origin).substr(scheme + 3)), own);
}

}  // namespace tunica::app
