// SPDX-License-Identifier: Apache-2.0
#include "studio/doorkeeper.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <unistd.h>

#include "execution/files.hpp"
#include "studio/project_folder.hpp"
#include "supervisor.hpp"
#include "text/aside.hpp"
#include "text/escaped.hpp"
#include "tunica/error.hpp"

namespace tunica::app::studio {

namespace {

std::string random_digits(std::size_t count) {
  std::string bytes(count / 2, '\0'), digits;
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw InputError(
        "the system gives no random numbers, and without them anybody could guess the address of the page; "
        "start `tunica studio` where getrandom() works");
  for (const char byte : bytes) digits += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return digits;
}

/// Takes as long for a guess that begins well as for one that does not.
bool is_same(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned different = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    different |= static_cast<unsigned char>(a[k]) ^ static_cast<unsigned char>(b[k]);
  return different == 0;
}

/// "a=1; b=2" → the value of a name.
std::string cookie_of(std::string_view header, std::string_view name) {
  while (!header.empty()) {
    const auto end = std::min(header.find(';'), header.size());
    auto one = header.substr(0, end);
    header.remove_prefix(std::min(end + 1, header.size()));
    while (one.starts_with(' ')) one.remove_prefix(1);
    if (one.size() > name.size() && one.starts_with(name) && one[name.size()] == '=')
      return std::string(one.substr(name.size() + 1));
  }
  return {};
}

}  // namespace

/// They lie in memory that the supervisor keeps for a successor, behind the listening socket.
void Doorkeeper::opened_at(int port) {
  port_ = std::to_string(port);
  tokens_.assign(2 * length, '\0');
  int memory = supervised::successor() ? supervised::parked() : -1;
  if (memory < 0 || ::pread(memory, tokens_.data(), tokens_.size(), 0) != static_cast<ssize_t>(tokens_.size())) {
    tokens_ = random_digits(2 * length);
    memory = ::memfd_create("tokens", MFD_CLOEXEC);
    if (memory < 0 || ::pwrite(memory, tokens_.data(), tokens_.size(), 0) < 0) return;
  }
  supervised::park(memory);
}

std::string Doorkeeper::address() const {
  return fmt::format("http://127.0.0.1:{}/?token={}", port_, tokens_.substr(0, length));
}

bool Doorkeeper::is_here(const std::string& authority) const {
  const std::string end = ":" + port_;
  if (authority == "127.0.0.1" + end || authority == "localhost" + end) return true;
  return port_ == "80" && (authority == "127.0.0.1" || authority == "localhost");  // browsers leave that one out
}

std::string Doorkeeper::problem_with(const WebRequest& request) const {
  if (!is_here(request.host))
    return "the header Host names another machine or port than this one; through ssh take one port on both sides, with "
           "`--port N` and `ssh -L N:127.0.0.1:N`";
  if (request.method != "GET" && request.method != "HEAD" && request.method != "POST")
    return "the page asks with GET and POST only";
  if (request.path.starts_with(view().substr(0, 6)))
    return request.method == "GET" && is_same(request.path.substr(0, view().size()), view())
               ? ""
               : "the address of the file has no token, or another one";
  if (!request.origin.empty() && (!request.origin.starts_with("http://") || !is_here(request.origin.substr(7))))
    return "the header Origin names another page than the studio's";
  if ((request.method == "POST" || !request.key.empty()) && request.origin.empty())
    return "the header Origin is missing";
  const std::string own = tokens_.substr(0, length);
  if (!is_same(cookie_of(request.cookie, cookie_name()), own)) return "the token is missing, or it is another one";
  return {};
}

std::optional<WebReply> Doorkeeper::stopped(const WebRequest& request) const {
  if (request.method == "GET" && request.path == "/" && is_here(request.host) &&
      is_same(request.token, tokens_.substr(0, length)))
    return WebReply{
        200,
        "text/html; charset=utf-8",
        "<!doctype html><title>tunica studio</title><meta http-equiv=\"refresh\" content=\"0;url=/\">",
        {{"Set-Cookie", fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict", cookie_name(), request.token)},
         {"Content-Security-Policy", "default-src 'none'; frame-ancestors 'none'"},
         {"X-Content-Type-Options", "nosniff"},
         {"Referrer-Policy", "no-referrer"},
         {"Cache-Control", "no-store"}}};
  const std::string why = problem_with(request);
  if (why.empty()) return std::nullopt;
  return refusal(request, 403, why + "; open the address that `tunica studio` has printed");
}

WebReply refusal(const WebRequest& request, int status, const std::string& why) {
  constexpr std::uintmax_t longest_log = std::uintmax_t{1} << 20U;  // bytes; a page that asks for ever fills no disk
  const std::string line =
      fmt::format("refused: {} {}: {}\n", text::excerpt(request.method), text::excerpt(request.path, 200), why);
  text::aside("{}", line);
  const std::filesystem::path log = own_place() / "refused.log";
  std::error_code none;
  if (const auto size = std::filesystem::file_size(log, none); none || size < longest_log) {
    try {
      execution::AppendFile(log).append(text::escaped(line, "\n"));
    } catch (const execution::WriteFailure&) {  // it is on stderr
    }
  }
  return {status, "text/plain; charset=utf-8", why + "\n", guarded_headers("default-src 'none'")};
}

std::vector<std::pair<std::string, std::string>> guarded_headers(const std::string& policy) {
  return {{"Content-Security-Policy", policy},
          {"X-Content-Type-Options", "nosniff"},
          {"X-Frame-Options", "DENY"},
          {"Referrer-Policy", "same-origin"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Cache-Control", "no-store"}};
}

}  // namespace tunica::app::studio
