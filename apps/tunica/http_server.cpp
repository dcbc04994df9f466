// SPDX-License-Identifier: Apache-2.0
#include "http_server.hpp"

#include <chrono>
#include <thread>

#include <fmt/format.h>
#include <httplib.h>

#include "tunica/error.hpp"

namespace tunica::app {

namespace {

constexpr std::chrono::seconds slow_client(30);
constexpr std::size_t largest_request = std::size_t{16} << 20U;

}  // namespace

void serve_http(const HttpService& service) {
  httplib::Server server;
  server.set_read_timeout(slow_client);
  server.set_write_timeout(slow_client);
  server.set_payload_max_length(largest_request);
  server.new_task_queue = [&service] { return new httplib::ThreadPool(service.threads); };
  // The library would set SO_REUSEPORT, with which two servers share a port and nobody notices.
  server.set_socket_options([](socket_t socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  const auto reply = [&service](const httplib::Request& request, httplib::Response& response) {
    const HttpReply answer = service.answer(request.path, request.body);
    response.status = answer.status;
    response.set_content(answer.json, "application/json");
  };
  for (const std::string& path : service.got) server.Get(path, reply);
  for (const std::string& path : service.posted) server.Post(path, reply);
  int port = service.port;
  if (port == 0)
    port = server.bind_to_any_port(service.host);
  else if (!server.bind_to_port(service.host, port))
    port = -1;
  if (port < 0)
    throw InputError(
        fmt::format("cannot listen on {}:{}: the port is in use, or the address is none of this machine. "
                    "Choose another port with --port, or 0 for any that is free",
                    service.host, service.port));
  service.listening(port);
  std::jthread watch([&](const std::stop_token& ended) {
    // Again and again: before the server listens, stop() does nothing.
    for (; !ended.stop_requested(); std::this_thread::sleep_for(std::chrono::milliseconds(50)))
      if (service.over()) server.stop();
  });
  server.listen_after_bind();
}

}  // namespace tunica::app
