// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "studio/web_server.hpp"

namespace tunica::app::studio {

/// The page itself never sends such a request: it is refused with 403, and logged.
class Refused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Who may come in. The address that is printed has a token; with it a browser gets a cookie, which every later request
/// needs. Host and Origin have to be the address itself, so that neither a page of somebody else nor a name that is
/// pointed to this machine (DNS rebinding) gets an answer. Files of the project are shown below /view/, with a second
/// token in the path: they are shown in an origin of their own, which has no cookie and may ask for nothing.
class Doorkeeper {
 public:
  /// Before the first request. Tokens are random, and those of a predecessor where there was one, see
  /// supervised::parked(); the listening socket has to be parked before.
  void opened_at(int port);
  /// The address for the browser, with the token.
  [[nodiscard]] std::string address() const;
  /// Where files of the project are shown: "/view/<token>/".
  [[nodiscard]] std::string view() const { return "/view/" + tokens_.substr(length) + "/"; }

  /// A reply to a refused client, and to a client that brings the token for the first time.
  [[nodiscard]] std::optional<WebReply> stopped(const WebRequest& request) const;

 private:
  static constexpr std::size_t length = 32;  ///< hexadecimal digits: 128 bits
  [[nodiscard]] std::string cookie_name() const { return "tunica_studio_" + port_; }
  [[nodiscard]] bool is_here(const std::string& authority) const;
  [[nodiscard]] std::string problem_with(const WebRequest& request) const;
  std::string tokens_, port_;
};

/// A reply in words, and a line on stderr and in .tunica-studio/refused.log of the project.
WebReply refusal(const WebRequest& request, int status, const std::string& why);

/// Headers of every page and file: they forbid type sniffing, framing and referrers.
std::vector<std::pair<std::string, std::string>> guarded_headers(const std::string& policy);

}  // namespace tunica::app::studio
