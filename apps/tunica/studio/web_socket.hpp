// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "http_connection.hpp"
#include "studio/web_server.hpp"

/// Questions and answers on one connection that stays open: a request of its own for each move of a slider costs a
/// browser more than the answer does.
namespace tunica::app::studio {

/// What proves to the browser that its key was read: RFC 6455, section 4.2.2.
std::string accept_of(const std::string& key);

/// Takes the connection over, and answers one text after the other until either side ends it, or until a minute passes
/// without a text; pings do not count. A text comes in one frame, within the limits of a request's head. Answers of
/// status 200 go out as bytes, others as text.
void talk(HttpConnection& connection, const std::string& key, const std::function<WebReply(std::string)>& answer,
          const std::function<bool()>& over);

}  // namespace tunica::app::studio
