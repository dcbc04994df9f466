// SPDX-License-Identifier: Apache-2.0
#include "http_server.hpp"

#include <string>

#include "http_loop.hpp"
#include "listening_socket.hpp"
#include "open_requests.hpp"

namespace tunica::app {

namespace {

constexpr const char* json_type = "application/json";

HttpLimits limits_of(const HttpService& service) {
  HttpLimits limits;
  limits.body += service.largest_body;
  return limits;
}

class Server final : public ConnectionServer {
 public:
  explicit Server(const HttpService& service) : ConnectionServer(limits_of(service), service.over), service_(service) {
    const auto reply = [this](const httplib::Request& request, httplib::Response& response) {
      HttpReply answer;
      {
        const OpenRequest open(connection().socket());
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
        connection().spend();  // an unread body would be taken for the next request
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

 private:
  const HttpService& service_;
};

}  // namespace

void serve_http(const HttpService& service) {
  const int listening = listen_or_go_on(service.host, service.port);
  Server server(service);
  service.listening(port_of(listening));
  server.answer_on(listening, service.threads);
}

}  // namespace tunica::app
