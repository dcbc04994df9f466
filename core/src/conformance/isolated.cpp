// SPDX-License-Identifier: Apache-2.0
#include "conformance/isolated.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <limits>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "plugins/casualties.hpp"
#include "tunica/detail/bounded_json.hpp"

#ifdef TUNICA_COVERAGE
extern "C" void __gcov_dump();
#endif

namespace tunica::conformance {
namespace {

// An error may be infinite, but JSON has no infinity.
nlohmann::json number(double value) { return fmt::format("{:.17g}", value); }
// std::stod throws where a number is subnormal.
double number(const nlohmann::json& text) { return std::strtod(text.get_ref<const std::string&>().c_str(), nullptr); }

std::string to_text(const Verdict& verdict) {
  return nlohmann::json{verdict.compared,        number(verdict.worst), number(verdict.tolerance),
                        verdict.counter_example, verdict.skipped,       verdict.note}
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}
Verdict from_text(const std::string& text) {
  const auto json = detail::parse_json(text);
  return {json[0], number(json[1]), number(json[2]), json[3], json[4], json[5]};
}

void write_all(int file, const std::string& text) {
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = ::write(file, text.data() + sent, text.size() - sent);
    if (count < 0 && errno != EINTR) return;
    if (count > 0) sent += static_cast<std::size_t>(count);
  }
}

[[noreturn]] void work(const std::function<Verdict()>& check, int out) {
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  write_all(out, to_text(guarded_check(check)));
  ::close(out);
#ifdef TUNICA_COVERAGE
  __gcov_dump();  // what this process has run; _exit() would lose it
#endif
  ::_exit(0);
}

/// What the process says until it closes its end; false when the time is over first.
bool read_all(int file, double seconds, std::string& text) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  std::array<char, 4096> buffer;
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    if (left.count() <= 0) return false;
    pollfd waiting{file, POLLIN, 0};
    if (::poll(&waiting, 1, static_cast<int>(left.count())) <= 0) continue;
    const ssize_t count = ::read(file, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
}

}  // namespace

Verdict guarded_check(const std::function<Verdict()>& check) {
  try {
    return check();
  } catch (const std::exception& problem) {
    return broken("", problem.what());
  } catch (...) {
    return broken("", "it throws something that is no std::exception");
  }
}

Verdict isolated(const std::function<Verdict()>& check, double seconds) {
  std::array<int, 2> ends{};
  std::fflush(nullptr);
  if (::pipe(ends.data()) != 0) return guarded_check(check);
  const pid_t process = ::fork();
  if (process < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    return guarded_check(check);
  }
  if (process == 0) {
    ::close(ends[0]);
    plugins::casualties = nullptr;  // how this process ends is the verdict, and nothing to avoid
    work(check, ends[1]);
  }
  ::close(ends[1]);
  std::string text;
  const bool answered = read_all(ends[0], seconds, text);
  ::close(ends[0]);
  if (!answered) ::kill(process, SIGKILL);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  if (!answered)
    return broken("", fmt::format("no end after {:g} s: it was stopped; --time-limit gives it longer", seconds));
  if (WIFSIGNALED(status))
    return broken(
        "", fmt::format("the process was ended by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status))));
  if (text.empty())
    return broken("", fmt::format("the process ended with exit code {} amid the check", WEXITSTATUS(status)));
  try {
    return from_text(text);
  } catch (const nlohmann::json::exception&) {
    return broken("", "the process of the check answered with something else than its figures");
  }
}

}  // namespace tunica::conformance
