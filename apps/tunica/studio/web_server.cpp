// SPDX-License-Identifier: Apache-2.0
#include "studio/web_server.hpp"

#include <chrono>
#include <string_view>
#include <thread>

#include <fcntl.h>
#include <httplib.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "http_connection.hpp"
#include "listening_socket.hpp"
#include "open_requests.hpp"
#include "supervisor.hpp"

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

/// The library parses and routes; connections are ours, for their limits.
class Server final : public httplib::Server {
 public:
  explicit Server(const WebService& service) : service_(service) {
    limits_.body = service.largest_body;
    limits_.answer = std::chrono::seconds(90);  // a stream of events ends before, and the browser comes again
    const auto reply = [this](const httplib::Request& request, httplib::Response& response) {
      WebReply answer;
      {
        const OpenRequest open(connection->socket());
        answer = service_.answer(request_of(request));
      }
      if (answer.events) stream(answer, *connection, service_.over);
      hand_over(std::move(answer), response);
    };
    Get(".*", reply);
    Post(".*", reply);
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      auto refusal = service_.refused(request_of(request));
      if (!refusal) return HandlerResponse::Unhandled;
      hand_over(std::move(*refusal), response);
      connection->spend();  // a body that nobody reads would be taken for the next request
      return HandlerResponse::Handled;
    });
  }

  void serve(int socket) {
    const int yes = 1;  // head and body are two writes: the second would wait for an acknowledgement
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    HttpConnection here(socket, limits_);
    connection = &here;
    bool closed = false;
    while (!closed && !here.is_spent() && here.wait_for_request(service_.over))
      if (!process_request(here, false, closed, [&here](httplib::Request& request) {
            request.ranges.clear();                 // many of them would multiply the answer
            request.headers.erase("Content-Type");  // a form would be taken apart, and has a limit of its own
            here.begin_body();
          }))
        break;
    here.close();
  }

 private:
  static thread_local HttpConnection* connection;
  const WebService& service_;
  HttpLimits limits_;
};
thread_local HttpConnection* Server::connection = nullptr;

}  // namespace

void serve_web(const WebService& service) {
  constexpr int heartbeat = 50;  // ms
  int listening = supervised::parked();
  if (listening < 0) listening = listen_on("127.0.0.1", service.port);
  ::fcntl(listening, F_SETFL, O_NONBLOCK);
  supervised::park(listening);
  answer_open_requests_at_the_end(listening);
  service.listening(port_of(listening));
  Server server(service);
  httplib::ThreadPool pool(threads);
  while (!service.over()) {
    pollfd watched{listening, POLLIN, 0};
    if (::poll(&watched, 1, heartbeat) <= 0) continue;
    const int socket = ::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC);
    if (socket >= 0)
      pool.enqueue([&server, socket] { server.serve(socket); });
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(heartbeat));
  }
  ::close(listening);
  pool.shutdown();
}

}  // namespace tunica::app::studio
