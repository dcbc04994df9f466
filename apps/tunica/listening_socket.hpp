// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tunica::app {

/// Listens on an address of this machine, "127.0.0.1", "::1", "[::1]" or a name; port 0 is any that is free. Returns
/// the descriptor. Throws InputError where it cannot.
int listen_on(const std::string& host, int port);
/// The port that a descriptor listens on.
int port_of(int descriptor);

/// The host as it stands in an address: IPv6 in brackets.
std::string in_url(const std::string& host);

/// Whether a request may come here: its Host header, and its Origin where a browser sends one, have to name this
/// machine. A page of somebody else that a browser shows could otherwise ask (cross-site requests, DNS rebinding).
/// Loopback names and addresses are this machine, and so is the host that is served; where that is no loopback address,
/// every address in figures is, for nobody can rebind those. An empty header was not sent.
bool is_of_this_machine(const std::string& host_header, const std::string& origin, const std::string& served);

}  // namespace tunica::app
