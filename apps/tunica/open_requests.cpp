// SPDX-License-Identifier: Apache-2.0
#include "open_requests.hpp"

#include <array>
#include <atomic>
#include <string_view>

#include <sys/socket.h>
#include <unistd.h>

#include "plugins/casualties.hpp"

namespace tunica::app {

namespace {

/// Sockets, each one larger by one; as many as there may be threads.
constexpr int none = 0, taken = -1;  // `taken`: answered at the end of the process
std::array<std::atomic<int>, 1024> places = {};
std::atomic<int> listening_socket = -1;

/// Text in memory that is there already: a signal handler may not ask for any.
class Text {
 public:
  void add(std::string_view more) {
    for (const char c : more)
      if (size_ < memory_.size()) memory_[size_++] = c;
  }
  void add_word(const char* word) {
    for (; *word != 0; ++word)
      add(*word == '"' || *word == '\\' || static_cast<unsigned char>(*word) < ' ' ? "?" : std::string_view(word, 1));
  }
  [[nodiscard]] std::string_view view() const { return {memory_.data(), size_}; }

 private:
  std::array<char, 1024> memory_;
  std::size_t size_ = 0;
};

void answer_all(const plugins::Casualty* casualty) {
  if (const int listening = listening_socket.exchange(-1); listening >= 0) ::close(listening);
  Text text;
  text.add(
      "HTTP/1.1 500 Internal Server Error\r\nContent-Type: application/json\r\nConnection: close\r\n\r\n"
      "{\"error\": {\"type\": \"ModelError\", \"message\": \"");
  if (casualty != nullptr) {
    text.add("plugin '");
    text.add_word(casualty->plugin.data());
    text.add("' ");
    text.add_word(casualty->end.data());
    text.add(" in ");
    text.add_word(casualty->what.data());
    if (casualty->what.data() != std::string_view(plugins::own_thread)) text.add("()");
  } else {
    text.add("memory came to its limit while plugins were evaluated");
  }
  text.add(", while this request was answered. Ask again: what did it is not called again\"}}");
  for (auto& place : places) {
    int held = place.load();
    if (held <= none || !place.compare_exchange_strong(held, taken)) continue;
    const int socket = held - 1;
    [[maybe_unused]] const auto sent =
        ::send(socket, text.view().data(), text.view().size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    ::shutdown(socket, SHUT_WR);
  }
}

}  // namespace

OpenRequest::OpenRequest(int socket) : place_(0), socket_(socket + 1) {
  for (;; place_ = (place_ + 1) % places.size())
    if (int expected = none; places[place_].compare_exchange_strong(expected, socket_)) return;
}

OpenRequest::~OpenRequest() {
  if (int expected = socket_; places[place_].compare_exchange_strong(expected, none)) return;
  for (;;) ::pause();
}

void answer_open_requests_at_the_end(int listening) {
  listening_socket = listening;
  plugins::at_end_of_process = answer_all;
}

}  // namespace tunica::app
