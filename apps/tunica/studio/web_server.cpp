// SPDX-License-Identifier: Apache-2.0
#include "studio/web_server.hpp"

#include <chrono>
#include <optional>
#include <string_view>

#include <sys/socket.h>

#include "http_loop.hpp"
#include "listening_socket.hpp"
#include "open_requests.hpp"
#include "studio/web_socket.hpp"

namespace tunica::app::studio {

namespace {

/// Streams of events hold a thread each, and a browser has at most six connections to a server.
constexpr std::size_t threads = 24;

WebRequest request_of(const httplib::Request& request) {
  return {request.method,
          request.path,
          request.get_param_value("token"),
          request.get_param_value("name"),
          request.get_header_value("Host"),
          request.get_header_value("Origin"),
          request.get_header_value("Cookie"),
          request.get_header_value("Content-Length"),
          request.get_header_value("Content-Encoding"),
          request.get_header_value("Sec-WebSocket-Key"),
          request.body};
}

void hand_over(WebReply&& reply, httplib::Response& response) {
  response.status = reply.status;
  for (const auto& [name, value] : reply.headers) response.set_header(name, value);
  response.set_content(std::move(reply.body), reply.type);
}

/// The library takes a server whose socket it has not opened for one that shuts down, and would send no stream. So this
/// is written here, and the end of the connection is the end of the answer.
void stream(const WebReply& reply, HttpConnection& connection, const std::function<bool()>& over) {
  std::string words = "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nConnection: close\r\n";
  for (const auto& [name, value] : reply.headers) words += name + ": " + value + "\r\n";
  words += "\r\n";
  for (std::optional<std::string> more = ""; more && !over(); more = reply.events()) {
    words += *more;
    for (std::string_view left = words; !left.empty();) {
      const ssize_t count = connection.write(left.data(), left.size());
      if (count <= 0) return connection.spend();
      left.remove_prefix(static_cast<std::size_t>(count));
    }
    words.clear();
  }
  ::shutdown(connection.socket(), SHUT_WR);  // nothing of what the library adds comes behind
  connection.spend();
}

HttpLimits limits_of(const WebService& service) {
  HttpLimits limits;
  limits.body = service.largest_body;
  limits.answer = std::chrono::seconds(90);  // a stream of events ends before, and the browser comes again
  return limits;
}

class Server final : public ConnectionServer {
 public:
  explicit Server(const WebService& service) : ConnectionServer(limits_of(service), service.over), service_(service) {
    const auto reply = [this](const httplib::Request& request, httplib::Response& response) {
      WebReply answer;
      {
        const OpenRequest open(connection().socket());
        answer = service_.answer(request_of(request));
      }
      if (answer.events) stream(answer, connection(), service_.over);
      if (answer.live) talk(connection(), request.get_header_value("Sec-WebSocket-Key"), answer.live, service_.over);
      hand_over(std::move(answer), response);
    };
    Get(".*", reply);
    Post(".*", reply);
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      auto refusal = service_.refused(request_of(request));
      if (!refusal) return HandlerResponse::Unhandled;
      hand_over(std::move(*refusal), response);
      connection().spend();  // a body that nobody reads would be taken for the next request
      return HandlerResponse::Handled;
    });
  }

 private:
  const WebService& service_;
};

}  // namespace

void serve_web(const WebService& service) {
  const int listening = listen_or_go_on("127.0.0.1", service.port);
  service.listening(port_of(listening));
  Server(service).answer_on(listening, threads);
}

}  // namespace tunica::app::studio
