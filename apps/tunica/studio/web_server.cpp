// SPDX-License-Identifier: Apache-2.0
#include "studio/web_server.hpp"

#include <atomic>
#include <chrono>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <sys/socket.h>

#include "http_loop.hpp"
#include "listening_socket.hpp"
#include "open_requests.hpp"
#include "studio/web_socket.hpp"

namespace tunica::app::studio {

namespace {

/// Each connection holds a thread. A browser asks on at most six at a time, streams of events included. It does not
/// count live connections so: a tab beyond `most_live` is refused one, and sends requests.
constexpr std::size_t threads = 24, most_live = 8;

/// A live connection among those of the server, while it lives.
class LivePlace {
 public:
  explicit LivePlace(std::atomic<std::size_t>& taken) : taken_(taken), free_(taken.fetch_add(1) < most_live) {}
  ~LivePlace() { --taken_; }
  LivePlace(const LivePlace&) = delete;
  LivePlace& operator=(const LivePlace&) = delete;
  [[nodiscard]] bool is_free() const { return free_; }

 private:
  std::atomic<std::size_t>& taken_;
  bool free_;
};

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
      if (answer.live) answer = held(answer, request.get_header_value("Sec-WebSocket-Key"));
      hand_over(std::move(answer), response);
    };
    Get(".*", reply);
    Post(".*", reply);
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      auto refusal = service_.refused(request_of(request));
      if (!refusal) return HandlerResponse::Unhandled;
      hand_over(std::move(*refusal), response);
      connection().spend();  // an unread body would be taken for the next request
      return HandlerResponse::Handled;
    });
  }

 private:
  /// Returns once the live connection has ended, or where there are too many.
  WebReply held(const WebReply& reply, const std::string& key) {
    const LivePlace place(live_);
    if (place.is_free())
      talk(connection(), key, reply.live, service_.over);
    else
      return {503, "text/plain; charset=utf-8",
              fmt::format("{} live connections are open, and no more are held; close a tab, or send requests\n",
                          most_live)};
    return {400, "text/plain; charset=utf-8"};
  }

  const WebService& service_;
  std::atomic<std::size_t> live_ = 0;
};

}  // namespace

void serve_web(const WebService& service) {
  const int listening = listen_or_go_on("127.0.0.1", service.port);
  service.listening(port_of(listening));
  Server(service).answer_on(listening, threads);
}

}  // namespace tunica::app::studio
