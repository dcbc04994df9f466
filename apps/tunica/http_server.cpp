// SPDX-License-Identifier: Apache-2.0
#include "http_server.hpp"

#include <cerrno>
#include <chrono>
#include <thread>

#include <fcntl.h>
#include <httplib.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "http_connection.hpp"
#include "listening_socket.hpp"
#include "open_requests.hpp"
#include "supervisor.hpp"

namespace tunica::app {

namespace {

constexpr const char* json_type = "application/json";

/// The library parses and routes; connections are ours, for their limits.
class Server final : public httplib::Server {
 public:
  explicit Server(const HttpService& service) : service_(service) {
    limits_.body += service.largest_body;
    const auto reply = [this](const httplib::Request& request, httplib::Response& response) {
      HttpReply answer;
      {
        const OpenRequest open(connection->socket());
        answer = service_.answer(request.path, request.body);
      }
      response.status = answer.status;
      response.set_content(answer.json, json_type);
    };
    for (const std::string& path : service.got) Get(path, reply);
    for (const std::string& path : service.posted) Post(path, reply);
    set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      const auto refuse = [&](int status, const char* words) {
        response.status = status;
        response.set_content(std::string(R"({"error": {"type": "InvalidInput", "message": ")") + words + "\"}}",
                             json_type);
        connection->spend();  // a body that nobody reads would be taken for the next request
        return HandlerResponse::Handled;
      };
      if (!is_of_this_machine(request.get_header_value("Host"), request.get_header_value("Origin"), service_.host))
        return refuse(403,
                      "the headers Host and Origin name another machine than this one; ask by the address that "
                      "the server has printed");
      if (request.has_header("Content-Encoding")) return refuse(415, "a compressed body is not read; send plain JSON");
      return HandlerResponse::Unhandled;
    });
  }

  void serve(int socket) {
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
  const HttpService& service_;
  HttpLimits limits_;
};
thread_local HttpConnection* Server::connection = nullptr;

/// A predecessor's, with all who wait there, or a new one.
int listen_for(const HttpService& service) {
  int descriptor = supervised::parked();
  if (descriptor < 0) descriptor = listen_on(service.host, service.port);
  ::fcntl(descriptor, F_SETFL, O_NONBLOCK);
  supervised::park(descriptor);
  return descriptor;
}

}  // namespace

void serve_http(const HttpService& service) {
  constexpr int heartbeat = 50;  // ms
  const int listening = listen_for(service);
  answer_open_requests_at_the_end(listening);
  Server server(service);
  httplib::ThreadPool pool(service.threads);
  service.listening(port_of(listening));
  while (!service.over()) {
    pollfd watched{listening, POLLIN, 0};
    if (::poll(&watched, 1, heartbeat) <= 0) continue;
    const int socket = ::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC);
    if (socket >= 0)
      pool.enqueue([&server, socket] { server.serve(socket); });
    else if (errno == EMFILE || errno == ENFILE)  // until one of the connections is closed
      std::this_thread::sleep_for(std::chrono::milliseconds(heartbeat));
  }
  pool.shutdown();
  ::close(listening);
}

}  // namespace tunica::app
