// SPDX-License-Identifier: Apache-2.0
#include "http_loop.hpp"

#include <cerrno>
#include <chrono>
#include <thread>

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "listening_socket.hpp"
#include "open_requests.hpp"
#include "supervisor.hpp"

namespace tunica::app {

thread_local HttpConnection* ConnectionServer::current = nullptr;

void ConnectionServer::serve(int socket) {
  const int yes = 1;  // head and body are two writes: the second would wait for an acknowledgement
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  HttpConnection here(socket, limits_);
  current = &here;
  bool closed = false;
  while (!closed && !here.is_spent() && here.wait_for_request(over_))
    if (!process_request(here, false, closed, [&here](httplib::Request& request) {
          request.ranges.clear();                 // many of them would multiply the answer
          request.headers.erase("Content-Type");  // a form would be taken apart, and has a limit of its own
          here.begin_body();
        }))
      break;
  here.close();
}

void ConnectionServer::answer_on(int listening, std::size_t threads) {
  constexpr int heartbeat = 50;  // ms
  httplib::ThreadPool pool(threads);
  while (!over_()) {
    pollfd watched{listening, POLLIN, 0};
    if (::poll(&watched, 1, heartbeat) <= 0) continue;
    const int socket = ::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC);
    if (socket >= 0)
      pool.enqueue([this, socket] { serve(socket); });
    else if (errno == EMFILE || errno == ENFILE)  // until one of the connections is closed
      std::this_thread::sleep_for(std::chrono::milliseconds(heartbeat));
  }
  pool.shutdown();
  ::close(listening);
}

int listen_or_go_on(const std::string& host, int port) {
  int descriptor = supervised::parked();
  if (descriptor < 0) descriptor = listen_on(host, port);
  ::fcntl(descriptor, F_SETFL, O_NONBLOCK);
  supervised::park(descriptor);
  answer_open_requests_at_the_end(descriptor);
  return descriptor;
}

}  // namespace tunica::app
